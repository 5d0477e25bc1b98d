//! The ranges of numbers in a case file, as the schema tells them to editors. The checks tell them to everyone; a test holds both and the
//! reference together.

use serde_json::{Value, json};

/// A range of numbers.
pub(super) enum Range {
    /// Above a limit.
    Above(f64),
    /// At or above a limit.
    AtLeast(f64),
    /// From one limit to the other, both among them.
    Within(f64, f64),
    /// Between two limits, neither among them.
    Between(f64, f64),
}

use Range::{Above, AtLeast, Between, Within};

impl Range {
    /// The keywords of JSON Schema that say it.
    pub(super) fn keywords(&self) -> Vec<(&'static str, Value)> {
        match *self {
            Above(limit) => vec![("exclusiveMinimum", number(limit))],
            AtLeast(limit) => vec![("minimum", number(limit))],
            Within(low, high) => vec![("minimum", number(low)), ("maximum", number(high))],
            Between(low, high) => vec![("exclusiveMinimum", number(low)), ("exclusiveMaximum", number(high))],
        }
    }
}

/// A whole number without a decimal point, as people write it.
fn number(value: f64) -> Value {
    if value.fract() == 0.0 && value.abs() < 1.0e6 { json!(value as i64) } else { json!(value) }
}

/// Tables, by the name of their type, their keys and the ranges of these.
pub(super) const RANGES: [(&str, &str, Range); 63] = [
    ("RawHysteresisRange", "advancing-angle-deg", Within(0.0, 180.0)),
    ("RawContactAngle", "contact-angle-deg", Within(0.0, 180.0)),
    ("RawCoxVoinov", "contact-angle-deg", Within(0.0, 180.0)),
    ("RawCoxVoinov", "slip-length", Above(0.0)),
    ("RawDroplet", "height", Above(0.0)),
    ("RawDynamic", "largest-step", Within(1e-6, 1.0)),
    ("RawDynamic", "pressure-drop", Above(0.0)),
    ("RawDynamic", "rate", Above(0.0)),
    ("RawEvery", "every-pore-volume", Above(0.0)),
    ("RawEvery", "every-time", Above(0.0)),
    ("RawExpectation", "tolerance", Above(0.0)),
    ("RawFilmGrid", "step-share", Within(1e-5, 0.1)),
    ("RawFilmParticles", "tolerance", Within(1e-12, 0.001)),
    ("RawFluid", "density", Above(0.0)),
    ("RawFluid", "temperature-c", Within(20.0, 25.0)),
    ("RawFluid", "viscosity", Above(0.0)),
    ("RawGeometry", "pixel-size", Above(0.0)),
    ("RawGeometry", "scale", Above(0.0)),
    ("RawGeometry", "smooth-below-deg", Within(0.0, 90.0)),
    ("RawGeometry", "threshold", Between(0.0, 1.0)),
    ("RawGrid", "ratio", Within(0.25, 100.0)),
    ("RawInterface", "tension", AtLeast(0.0)),
    ("RawLineFriction", "contact-angle-deg", Within(0.0, 180.0)),
    ("RawLineFriction", "friction", Above(0.0)),
    ("RawMolecularKinetic", "contact-angle-deg", Within(0.0, 180.0)),
    ("RawMolecularKinetic", "frequency", Above(0.0)),
    ("RawMolecularKinetic", "jump-length", Above(0.0)),
    ("RawMolecularKinetic", "temperature-c", Within(-100.0, 500.0)),
    ("RawNetwork", "cycles", Within(1.0, 100.0)),
    ("RawNetwork", "persistence", Within(0.5, 1.0)),
    ("RawNumerics", "background-pressure", Within(0.0, 1000.0)),
    ("RawNumerics", "density-error-shifting", Within(0.0, 1.0)),
    ("RawNumerics", "density-error-correction", Within(0.0, 1.0)),
    ("RawNumerics", "pressure-tolerance", Within(1e-13, 0.1)),
    ("RawNumerics", "shifting", Within(0.0, 100.0)),
    ("RawNumerics", "anti-clustering", Within(0.0, 1.0)),
    ("RawNumerics", "time-step-factor", Within(0.001, 10.0)),
    ("RawNumerics", "wall-stretch", Within(1.0, 1000.0)),
    ("RawOpenSide", "flow-rate", Above(0.0)),
    ("RawOpenSide", "velocity", Above(0.0)),
    ("RawPartialWetting", "contact-angle-deg", Within(0.1, 45.0)),
    ("RawPressureSteps", "every-time", Above(0.0)),
    ("RawPressureSteps", "rise", Above(0.0)),
    ("RawSph", "reference-length", Above(0.0)),
    ("RawSph", "smoothing-ratio", Within(1.0, 3.0)),
    ("RawSph", "spacing", Above(0.0)),
    ("RawSteady", "capillary-number", Within(0.0, 1.0)),
    ("RawSteady", "capillary-pressure", Within(1e-9, 1.0)),
    ("RawSteady", "contact-angle-deg", Within(1e-6, 90.0)),
    ("RawSteady", "kinetic-energy", Within(1e-9, 1.0)),
    ("RawSteady", "saturation", Within(1e-9, 1.0)),
    ("RawStop", "injected", Above(0.0)),
    ("RawStop", "saturation", Within(0.0, 1.0)),
    ("RawStripes", "width", Above(0.0)),
    ("RawTaylorGreen", "speed", Above(0.0)),
    ("RawThinFilm", "tension", Above(0.0)),
    ("RawTime", "end", Within(1e-15, 1e9)),
    ("RawVtk", "every-pore-volume", Above(0.0)),
    ("RawVtk", "every-time", Above(0.0)),
    ("RawWalls", "line-slip-length", AtLeast(0.0)),
    ("RawWalls", "slip-length", AtLeast(0.0)),
    ("RawWettingPatch", "advancing-angle-deg", Within(0.0, 180.0)),
    ("RawWettingPatch", "contact-angle-deg", Within(0.0, 180.0)),
];
