//! `[time.steady]`: when a run counts as steady. Checks and the way back into a case file.

use super::checked::Output;
use super::raw::{RawCase, RawSteady};
use crate::input::Checker;

/// Fewest rows of the series in a window: fewer tell no spread.
pub const FEWEST_ROWS: f64 = 5.0;

/// Windows that are compared.
pub const WINDOWS: f64 = 3.0;

/// When a run counts as steady, and whether it then ends.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct SteadyStop {
    /// Length in s of each of the three windows; absent: a share of the time so far.
    pub window: Option<f64>,
    /// Tolerance of the contact angle in rad.
    pub contact_angle: f64,
    /// Tolerance of the capillary pressure over its value.
    pub capillary_pressure: f64,
    /// Tolerance of the saturation.
    pub saturation: f64,
    /// Largest viscosity × speed/tension at which all particles count as at rest.
    pub capillary_number: f64,
    /// Tolerance of the kinetic energy over its value.
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

/// Checks `[time.steady]`; `end` in s is missing where it was wrong.
pub(super) fn steady(checker: &mut Checker, raw: &RawCase, end: Option<f64>, output: &Output) -> Option<SteadyStop> {
    let steady = raw.time.as_ref()?.steady.as_ref()?;
    if raw.sph.is_none() {
        if raw.network.is_none() {
            checker.refuse(
                "time.steady",
                "only [sph] tells when it is steady",
                "leave this out; the run ends at time.end",
            );
        }
        return None;
    }
    let default = SteadyStop::default();
    let mut within = |key: &str, given: Option<f64>, range: (f64, f64), what: &str, default: f64| {
        checker.within(&format!("time.steady.{key}"), given, range, what).unwrap_or(default)
    };
    let share = (1.0e-9, 1.0);
    let degrees = default.contact_angle.to_degrees();
    let angle = within("contact-angle-deg", steady.contact_angle_deg, (1.0e-6, 90.0), "an angle in degrees", degrees);
    let found = SteadyStop {
        window: steady.window,
        contact_angle: angle.to_radians(),
        capillary_pressure: within(
            "capillary-pressure",
            steady.capillary_pressure,
            share,
            "a change over the value",
            default.capillary_pressure,
        ),
        saturation: within("saturation", steady.saturation, share, "a change", default.saturation),
        capillary_number: within(
            "capillary-number",
            steady.capillary_number,
            (0.0, 1.0),
            "a capillary number",
            default.capillary_number,
        ),
        kinetic_energy: within(
            "kinetic-energy",
            steady.kinetic_energy,
            share,
            "a change over the value",
            default.kinetic_energy,
        ),
        stop: steady.stop.unwrap_or(default.stop),
    };
    let window = checker.positive("time.steady.window", steady.window, "a time in s");
    if let (Some(window), Some(end)) = (window, end) {
        check_window(checker, window, end, output.series_every);
    }
    Some(found)
}

/// Three windows must fit into the run, and rows of the series into a window.
fn check_window(checker: &mut Checker, window: f64, end: f64, series_every: f64) {
    if WINDOWS * window > end {
        checker.refuse(
            "time.steady.window",
            format!("three windows of {window:?} s do not fit into a run of {end:?} s"),
            format!("a window of {:.2e} s or less would do, or leave the key out", end / WINDOWS),
        );
    } else if window < FEWEST_ROWS * series_every {
        checker.refuse(
            "time.steady.window",
            format!(
                "a window of {window:?} s holds fewer than {FEWEST_ROWS} rows of the series, one in {series_every:?} s"
            ),
            format!(
                "a window of {:.2e} s or more would do, or a row of the series every {:.2e} s",
                FEWEST_ROWS * series_every,
                window / FEWEST_ROWS
            ),
        );
    }
}

/// The table that loads to the same.
pub(super) fn raw(steady: &SteadyStop) -> RawSteady {
    RawSteady {
        window: steady.window,
        contact_angle_deg: Some(steady.contact_angle.to_degrees()),
        capillary_pressure: Some(steady.capillary_pressure),
        saturation: Some(steady.saturation),
        capillary_number: Some(steady.capillary_number),
        kinetic_energy: Some(steady.kinetic_energy),
        stop: Some(steady.stop),
    }
}
