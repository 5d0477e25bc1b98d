//! A case file as a whole: its table, the checked case, and the case as one file.

use super::film::{RawThinFilm, ThinFilm};
use super::network::{NetworkResults, PoreNetwork, RawNetwork};
use super::output::{Expectation, Output, RawExpectation, RawOutput, RawTime};
use super::shapes::RawGeometry;
use super::side::Sides;
use super::sph::{RawSph, Sph};
use super::steady::SteadyStop;
use meniscus_core::input::tables::{Key, tables};
use meniscus_geometry::spec::{GeometrySpec, ShapeSpec};

tables! {
    /// A case file. SI units everywhere; angles in degrees in keys that end in `-deg`, through the wetting phase.
    pub(crate) struct RawCase {
        /// Version of the format: 1.
        pub format: u32 => Key::required("format = 1"),
        /// One line that describes the case.
        pub title: String => Key::required("title = \"what the case shows\""),
        /// Domain and solids: a shape file, or shapes written here.
        pub geometry: RawGeometry => Key::required("[geometry] with file, or min, max and shapes"),
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
}

/// A case that can be run.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Case {
    /// One line that describes the case.
    pub title: String,
    /// Domain and solids.
    pub geometry: GeometrySpec,
    /// Depth of the chip (distance between floor and lid) in m; `None` in the plane, where all is per meter of depth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depth: Option<f64>,
    /// The model that solves it.
    pub model: Model,
    /// End of the simulation in s; for a network, the upper limit of the displacement in pore volumes.
    pub end: f64,
    /// When the run counts as steady, and whether it then ends (`[time.steady]`); `None`: it continues to its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steady: Option<SteadyStop>,
    /// What is written and when.
    pub output: Output,
    /// Expected measures.
    pub expect: Vec<Expectation>,
}

impl Case {
    /// Whether only the curve of a network is wanted, without fields and pictures.
    pub fn is_curve_alone(&self) -> bool {
        matches!(&self.model, Model::Network(network) if network.results == NetworkResults::Curve)
    }

    /// The same with all results of its network.
    pub fn with_all_results(&self) -> Self {
        let mut case = self.clone();
        if let Model::Network(network) = &mut case.model {
            network.results = NetworkResults::All;
        }
        case
    }

    /// The dimension of its pressures, volumes and rates, in one line; `None` for a film on a wall.
    pub fn depth_text(&self) -> Option<String> {
        match (&self.model, self.depth) {
            (Model::ThinFilm(_), _) => None,
            (_, None) => {
                Some("plane, per meter of depth; a chip of finite depth has other pressures: geometry.depth".to_owned())
            }
            (_, Some(depth)) => {
                // Rounded to the nanometer: products of decimals have trailing nines.
                let um = (1e9 * depth).round() / 1e3;
                Some(format!("{um} um, with the curvature and the friction of floor and lid"))
            }
        }
    }
}

/// The models.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Direct simulation by incompressible SPH.
    Sph(Box<Sph>),
    /// Droplets on a flat wall by a thin-film equation (`[thin-film]`).
    ThinFilm(Box<ThinFilm>),
    /// A pore network and a quasi-static displacement in it (`[network]`).
    Network(Box<PoreNetwork>),
}

impl Model {
    /// The sides of its domain; `None` for a film on a wall.
    pub fn sides(&self) -> Option<&Sides> {
        match self {
            Self::Sph(sph) => Some(&sph.sides),
            Self::Network(network) => Some(&network.sides),
            Self::ThinFilm(_) => None,
        }
    }

    /// Its table in a case file.
    pub(crate) fn table(&self) -> &'static str {
        match self {
            Self::Sph(_) => "sph",
            Self::ThinFilm(_) => "thin-film",
            Self::Network(_) => "network",
        }
    }
}

/// A checked case as TOML, with defaults, presets, overrides and files resolved: it loads to the same case.
///
/// `raw` are its tables, to which the checks have added all defaults. In place of the shapes of `case` it can have none.
pub(super) fn text(mut raw: RawCase, case: &Case, shapes: Vec<ShapeSpec>) -> String {
    let &GeometrySpec { min, max, solid, .. } = &case.geometry;
    raw.geometry = Some(RawGeometry {
        min: Some(min),
        max: Some(max),
        solid: Some(solid),
        shapes: Some(shapes),
        depth: case.depth,
        ..RawGeometry::default()
    });
    // Every value of a checked case can be written as TOML: numbers, texts and tables with text keys.
    toml::to_string(&raw).unwrap_or_default()
}
