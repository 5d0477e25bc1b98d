//! Properties of a fluid, and the state in which they are asked for.

/// Atmospheric pressure in Pa.
pub(super) const ATMOSPHERE: f64 = 101_325.0;

/// Properties of a fluid in one state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Properties {
    /// Density in kg/m³.
    pub density: f64,
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
    /// Surface tension against air in N/m, if tabulated.
    pub tension: Option<f64>,
}

/// The state of a fluid, as far as a case gives it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct State {
    /// Temperature in °C; `None`: the lowest tabulated one, at most 20.
    pub celsius: Option<f64>,
    /// Pressure in Pa; `None`: atmospheric.
    pub pascal: Option<f64>,
    /// Mass fraction of the solute: salt in brine, glycerol in its mixture with water.
    pub mass_fraction: Option<f64>,
}

/// Why a state is not one of a preset.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// The key of the fluid that is wrong or missing.
    pub key: &'static str,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: String,
}
