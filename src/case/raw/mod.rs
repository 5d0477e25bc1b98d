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
pub use wetting::{
    RawAngleWindow, RawAxis, RawContactAngle, RawCoxVoinov, RawLineFriction, RawMolecularKinetic, RawStripes,
    RawWetting, RawWettingPatch,
};

tables! {
    /// A case file. SI units everywhere; angles in degrees in keys that end in `-deg`, through the wetting phase.
    pub struct RawCase {
        /// Version of the format: 1.
        pub format: u32,
        /// One line that says what the case shows.
        pub title: String,
        /// Domain and solids: a shape file, or shapes written here.
        pub geometry: RawGeometry,
        /// Direct simulation by incompressible SPH.
        pub sph: RawSph,
        /// Droplets on a flat wall, by a thin-film equation.
        pub thin_film: RawThinFilm,
        /// A pore network and a quasi-static displacement in it.
        pub network: RawNetwork,
        /// How long the simulation runs; not with `[network]`.
        pub time: RawTime,
        /// What is written and when.
        pub output: RawOutput,
        /// Measures that must come out as said; otherwise the run ends with exit code 5.
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
        /// Shape file, relative to the case file.
        pub file: PathBuf,
        /// Unit of the drawing: m, cm, mm, um, nm, in, mil, ft, pt or px; needed where the file names none.
        pub unit: String,
        /// Length of the drawing unit in m, in place of `unit`.
        pub scale: f64,
        /// Part of the drawing that becomes the domain, lower left and upper right corner in m; shapes are cut at open and periodic sides.
        pub window: [[f64; 2]; 2],
        /// Layers of the drawing that are read (default: all).
        pub layers: Vec<String>,
        /// Gray value between solid and pore of a mask, from 0 (black) to 1 (white).
        pub threshold: f64,
        /// Side of a pixel of a mask in m.
        pub pixel_size: f64,
        /// Whether solid and pore of the file change places (default: no).
        pub invert: bool,
        /// Whether polygons whose vertices lie on a circle are read as discs (default: yes).
        pub recognize_circles: bool,
        /// Vertices of drawings that turn by less than this many degrees become arcs (default 20; 0: none).
        pub smooth_below_deg: f64,
        /// Columns of x, y and radius in a list of discs, the first one being 0.
        pub columns: [usize; 3],
        /// The character between the columns of a list of discs.
        pub separator: char,
        /// Whether the third column of a list of discs holds diameters (default: no).
        pub diameters: bool,
        /// Lower left corner of the domain in m; with `file`, in place of the file's.
        pub min: [f64; 2],
        /// Upper right corner of the domain in m; with `file`, in place of the file's.
        pub max: [f64; 2],
        /// Whether the shapes are solid (`inside`, the default) or the pore (`outside`); not with `file`, see `invert`.
        pub solid: SolidSide,
        /// The shapes; overlaps are united; not with `file`.
        pub shapes: Vec<ShapeSpec>,
    }

    /// How long the simulation runs.
    pub struct RawTime {
        /// End of the simulation in s.
        pub end: f64,
        /// Ends the simulation when it is steady, and at `end` at the latest; with `[sph]`.
        pub steady: RawSteady,
    }

    /// When a simulation counts as steady: what is left to change of each quantity, and how far it moves within the last
    /// window, are both below its tolerance.
    pub struct RawSteady {
        /// Length in s of each of the three windows that are compared (default: a fifth of the time so far).
        pub window: f64,
        /// Tolerance of the mean contact angle in degrees (default 0.3).
        pub contact_angle_deg: f64,
        /// Tolerance of the capillary pressure over its value (default 0.005).
        pub capillary_pressure: f64,
        /// Tolerance of the saturation (default 0.001).
        pub saturation: f64,
        /// Largest viscosity x speed / tension at which all particles count as at rest (default 1e-4).
        pub capillary_number: f64,
        /// Tolerance of the kinetic energy over its value, for flows that do not come to rest (default 0.005).
        pub kinetic_energy: f64,
        /// Whether the run ends when it is steady (default), or only says so.
        pub stop: bool,
    }

    /// What is written and when.
    pub struct RawOutput {
        /// Particle, grid and interface files (default: 50 records; with `[network]`: 50 in each half cycle).
        pub vtk: RawVtk,
        /// Rows of series.csv (default: 200 records; with `[network]`: 200 in each half cycle).
        pub series: RawEvery,
        /// The regular grid.
        pub grid: RawGrid,
        /// Files to resume from (default: 10 records).
        pub restart: RawEvery,
    }

    /// Files for ParaView.
    pub struct RawVtk {
        /// Time between records in s.
        pub every_time: f64,
        /// Displaced pore volumes between records, with `[network]`.
        pub every_pore_volume: f64,
        /// How the arrays in the files are compressed (default `zlib`).
        pub compression: RawCompression,
    }

    /// A schedule.
    pub struct RawEvery {
        /// Time between records in s.
        pub every_time: f64,
        /// Displaced pore volumes between records, with `[network]`.
        pub every_pore_volume: f64,
    }

    /// The regular grid of the output.
    pub struct RawGrid {
        /// Distance of grid nodes over the particle spacing (default 1).
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
