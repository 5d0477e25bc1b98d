//! The keys of a case file and of a shape file, as written: all optional, nothing checked but names and types.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::film::raw::RawThinFilm;
use super::network::raw::RawNetwork;
use crate::geometry::spec::{ShapeSpec, SolidSide};

/// Derives and attributes of every table of a case file or another input file.
macro_rules! tables {
    ($($(#[$outer:meta])* pub struct $name:ident { $($(#[$inner:meta])* pub $field:ident: $kind:ty,)* })*) => {$(
        $(#[$outer])*
        #[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
        pub struct $name {
            $($(#[$inner])*
            #[serde(skip_serializing_if = "Option::is_none")]
            pub $field: Option<$kind>,)*
        }
    )*};
}
pub(crate) use tables;

mod measures;
mod sides;
mod sph;
mod wetting;

pub use measures::{RawExpectation, RawMeasures};
pub use sides::{
    RawOpenSide, RawOpenSides, RawPressureSteps, RawProfile, RawSide, RawSideName, RawSides, RawWallSpeeds,
};
pub use sph::{
    RawCsf, RawFluid, RawInitial, RawInterface, RawLineDelta, RawNumerics, RawPhase, RawPhases, RawPressureJump,
    RawSph, RawSurfaceForce, RawTaylorGreen, RawVelocity, RawViscousStep, RawViscousTerm, RawWalls,
};
pub use wetting::{RawAxis, RawStripes, RawWetting, RawWettingPatch};

tables! {
    /// A case file. SI units everywhere; angles in degrees in keys that end in `-deg`, through the wetting phase.
    pub struct RawCase {
        /// Version of the format: 1.
        pub format: u32,
        /// One line that describes the case.
        pub title: String,
        /// Domain and solids: a shape file, or shapes written here.
        pub geometry: RawGeometry,
        /// Direct simulation by incompressible SPH.
        pub sph: RawSph,
        /// Droplets on a flat wall, by a thin-film equation.
        pub thin_film: RawThinFilm,
        /// Pore network, and displacement of one fluid by another in it.
        pub network: RawNetwork,
        /// Simulated time; not for a quasi-static `[network]`.
        pub time: RawTime,
        /// Files of the run, and how often they are written.
        pub output: RawOutput,
        /// Expected measures; if one is missed, the run ends with exit code 5.
        pub expect: Vec<RawExpectation>,
    }

    /// A shape file: domain and solids.
    pub struct RawShapeFile {
        /// Version of the format: 1.
        pub format: u32,
        /// Lower left corner of the domain in m.
        pub min: [f64; 2],
        /// Upper right corner of the domain in m.
        pub max: [f64; 2],
        /// Whether the shapes are solid (`inside`, the default) or the pore (`outside`).
        pub solid: SolidSide,
        /// The shapes; overlaps are united.
        pub shapes: Vec<ShapeSpec>,
    }

    /// Domain and solids of a case.
    pub struct RawGeometry {
        /// Shape file or drawing.
        pub file: PathBuf,
        /// Unit of the drawing: m, cm, mm, um, nm, in, mil, ft, pt or px (default: that of the file).
        pub unit: String,
        /// Drawing unit in m, in place of `unit`.
        pub scale: f64,
        /// Lower left and upper right corner in m of the part that becomes the domain (default: all).
        pub window: [[f64; 2]; 2],
        /// Layers of an SVG or DXF drawing (default: all).
        pub layers: Vec<String>,
        /// Ends of lines of a DXF drawing that are so near meet, in units of the drawing (default: 1e-6 of its size).
        pub join_within: f64,
        /// Gray value between solid (0, black) and pore (1, white) of a mask (default: that of the image).
        pub threshold: f64,
        /// Side of a mask pixel in m (required for a mask).
        pub pixel_size: f64,
        /// Exchanges solid and pore of the file (default false).
        pub invert: bool,
        /// Reads polygons with vertices on a circle as discs (default true).
        pub recognize_circles: bool,
        /// Polygon corners that turn by less become arcs; 0: none (default 20.0).
        pub smooth_below_deg: f64,
        /// Columns of x, y and radius in a disc list, from 0 (default `[0, 1, 2]`).
        pub columns: [usize; 3],
        /// Separator of a disc list (default: any usual one).
        pub separator: char,
        /// The third column of a disc list holds diameters; required if its header names them (default false).
        pub diameters: bool,
        /// Lower left corner of the domain in m (default: that of the file).
        pub min: [f64; 2],
        /// Upper right corner of the domain in m (default: that of the file).
        pub max: [f64; 2],
        /// Whether the inside or the outside of the shapes is solid; with `file` use `invert` (default `inside`).
        pub solid: SolidSide,
        /// The shapes, united; not with `file`.
        pub shapes: Vec<ShapeSpec>,
    }

    /// How long the simulation runs.
    pub struct RawTime {
        /// End of the simulation in s; with `steady` the latest end.
        pub end: f64,
        /// Ends a run of `[sph]` when it is steady.
        pub steady: RawSteady,
    }

    /// When a simulation counts as steady: what is left to change of each quantity, and how far it moves within the last
    /// window, are both below its tolerance.
    pub struct RawSteady {
        /// Length in s of each of the three compared windows: at least five records, at most a third of the end
        /// (default: a fifth of the elapsed time).
        pub window: f64,
        /// Tolerance of the mean contact angle in degrees (default 0.3).
        pub contact_angle_deg: f64,
        /// Tolerance relative to the capillary pressure, or to tension over the longer side if larger (default 0.005).
        pub capillary_pressure: f64,
        /// Tolerance of the saturation (default 0.001).
        pub saturation: f64,
        /// Viscosity times speed over tension below which particles rest (default 1e-4).
        pub capillary_number: f64,
        /// Relative tolerance of the kinetic energy of flows that do not rest (default 0.005).
        pub kinetic_energy: f64,
        /// Ends the run when steady, or only reports the time (default true).
        pub stop: bool,
    }

    /// What is written and when.
    pub struct RawOutput {
        /// Particles, grid and interface; of a network, menisci and regions (default: 50 records).
        pub vtk: RawVtk,
        /// Rows of `series.csv` (default: 200 records).
        pub series: RawEvery,
        /// Regular grid of the output.
        pub grid: RawGrid,
        /// Saved states; also written on an interrupt or a failure (default: 10 records).
        pub restart: RawEvery,
    }

    /// Files for ParaView.
    pub struct RawVtk {
        /// Time between records in s.
        pub every_time: f64,
        /// Displaced pore volumes between records.
        pub every_pore_volume: f64,
        /// Compression of arrays; meshio does not read `lz4` (default `zlib`).
        pub compression: RawCompression,
    }

    /// A schedule.
    pub struct RawEvery {
        /// Time between records in s.
        pub every_time: f64,
        /// Displaced pore volumes between records.
        pub every_pore_volume: f64,
    }

    /// The regular grid of the output.
    pub struct RawGrid {
        /// Distance of grid nodes over particle spacing; at most the shorter side of the domain, and 2e7 nodes (default 1).
        pub ratio: f64,
    }
}

/// How arrays in VTK files are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RawCompression {
    /// Not at all: read by every program, the largest files.
    None,
    /// By zlib: read by every program.
    Zlib,
    /// By LZ4: read by VTK, ParaView and pyvista, not by meshio.
    Lz4,
}

/// A table without keys: its name says all.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Empty {}
