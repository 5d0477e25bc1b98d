//! `[time.steady]`: when a run counts as steady.

use meniscus_core::input::tables::{Key, tables};

tables! {
    /// When a simulation counts as steady: the remaining change of each quantity, and its range within the last window, are both below its tolerance.
    pub(crate) struct RawSteady {
        /// Length in s of each of the three compared windows: at least five records, at most a third of the end
        /// (default: a fifth of the elapsed time).
        pub window: f64 => Key::positive("a time in s"),
        /// Tolerance of the mean contact angle in degrees (default 0.3).
        pub contact_angle_deg: f64 => Key::within("an angle in degrees", 1.0e-6, 90.0),
        /// Tolerance relative to the capillary pressure, or to tension over the longer side if larger (default 0.005).
        pub capillary_pressure: f64 => Key::within("a change over the value", 1.0e-9, 1.0),
        /// Tolerance of the saturation (default 0.001).
        pub saturation: f64 => Key::within("a change", 1.0e-9, 1.0),
        /// Viscosity times speed over tension below which particles are at rest (default 1e-4).
        pub capillary_number: f64 => Key::within("a capillary number", 0.0, 1.0),
        /// Relative tolerance of the kinetic energy of flows that do not come to rest (default 0.005).
        pub kinetic_energy: f64 => Key::within("a change over the value", 1.0e-9, 1.0),
        /// Ends the run when steady, or only reports the time (default true).
        pub stop: bool,
    }
}

/// Fewest rows of the series in a window: fewer do not show the range.
pub const FEWEST_ROWS: f64 = 5.0;

/// Windows that are compared.
pub(crate) const WINDOWS: f64 = 3.0;

/// When a run counts as steady, and whether it then ends.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct SteadyStop {
    /// Length in s of each of the three windows; `None`: a fraction of the elapsed time.
    pub window: Option<f64>,
    /// Tolerance of the contact angle in rad.
    pub contact_angle: f64,
    /// Relative tolerance of the capillary pressure.
    pub capillary_pressure: f64,
    /// Tolerance of the saturation.
    pub saturation: f64,
    /// Largest viscosity × speed/tension at which all particles count as at rest.
    pub capillary_number: f64,
    /// Relative tolerance of the kinetic energy.
    pub kinetic_energy: f64,
    /// Whether the run ends when it is steady.
    pub stop: bool,
}

impl Default for SteadyStop {
    fn default() -> Self {
        Self {
            window: None,
            contact_angle: 0.3_f64.to_radians(),
            capillary_pressure: 5.0e-3,
            saturation: 1.0e-3,
            capillary_number: 1.0e-4,
            kinetic_energy: 5.0e-3,
            stop: true,
        }
    }
}
