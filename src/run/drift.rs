//! Remaining change of a quantity of the series, and its rate.
//!
//! With the means m₁, m₂, m₃ over three equal windows that end at the last row, an exponential approach leaves |d₂| r/(1 − r), d₁ = m₂ − m₁, d₂ = m₃ − m₂, r =
//! d₂/d₁, cut off at [`meniscus_core::math::SLOWEST`]. A quantity that oscillates, so that d₁ and d₂ may differ in sign, is off by half of its range in the last window at
//! most. An angle that approaches the one at rest has that whole distance left: spreading is a power law, which three windows do not determine.
//!
//! A contact angle can overshoot and return: a flow that loses the kinetic energy E can do the work E on an interface of the length L, and so turn it by up to
//! √(2E/(σL)). E is at most the kinetic energy of the whole domain in the last window.

use super::steady::{self, Windows, range};
use meniscus_case::SteadyStop;
use meniscus_core::solver::{Quantity, Series, Watched};

/// The motion of a quantity at the end of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drift {
    /// Remaining change, in its unit.
    pub(crate) left: f64,
    /// Its rate over the last window, in its unit per s.
    pub(crate) rate: f64,
    /// Possible change due to the flow, in its unit, however slowly it moves.
    pub(crate) by_flow: f64,
    /// Distance from the only value at which it can be at rest, in its unit; 0 if there are others.
    pub(crate) off: f64,
}

impl Drift {
    /// The drift of a column of `series` over windows of a fifth of the time; `None` if it is not known in each of them.
    pub(crate) fn of(series: &Series, column: &str) -> Option<Self> {
        let (times, windows) = (windows(series, series.columns.first()?)?, windows(series, column)?);
        let [first, second, third] = windows.means;
        let (before, last) = (second - first, third - second);
        let approach = if before * last > 0.0 { steady::left(windows.means) } else { 0.0 };
        let left = approach.max(0.5 * range(&windows.values[2]));
        let rate = slope(&times, &windows);
        (left.is_finite() && rate.is_finite()).then_some(Self { left, rate, by_flow: 0.0, off: 0.0 })
    }

    /// The drift of a watched quantity that has reached `value`.
    pub(crate) fn of_watched(series: &Series, Watched { column, kind }: Watched, value: f64) -> Option<Self> {
        let mut drift = Self::of(series, column)?;
        if let Quantity::Angle { energy, length, tension, at_rest, pins } = kind {
            let length = series.column(length).last().unwrap_or(f64::NAN);
            let turn = (2.0 * energy_to_lose(series, energy) / (tension * length)).sqrt().to_degrees();
            drift.by_flow = if turn.is_finite() { turn } else { 0.0 };
            let distance = at_rest.map_or(0.0, |[least, most]| value.clamp(least, most) - value);
            let windows = windows(series, column)?;
            if approaches(&windows, distance) || range(&windows.values.concat()) > MOVED * distance.abs() {
                drift.left = drift.left.max(distance.abs());
            }
            drift.off = if pins { 0.0 } else { distance.abs() };
        }
        Some(drift.within(kind.range(), value))
    }

    /// The same for a quantity of a standard uncertainty `known` at one time: if it is farther from the only value at which it can be at rest than its error
    /// explains, it is not at rest, however slowly it moves.
    pub(crate) fn beside(self, known: f64) -> Self {
        let is_off = self.off > FAR * known && self.off > FARTHEST_ERROR;
        Self { left: if is_off { self.left.max(self.off) } else { self.left }, ..self }
    }

    /// The same for a length that follows a column of the `series`, `size` now, and has the signed `way` to go to the only value at which it can be at rest,
    /// the column the way `of_column`: all of it is left if it goes there, turned back on its way, or is still far.
    pub(crate) fn over(self, series: &Series, column: &str, of_column: f64, way: f64, size: f64) -> Self {
        let moves = |windows: Windows| {
            approaches(&windows, of_column) || range(&windows.values.concat()) > MOVED * of_column.abs()
        };
        let goes = windows(series, column).is_some_and(moves) || way.abs() > FARTHEST_SHARE * size.abs();
        Self { left: if goes { self.left.max(way.abs()) } else { self.left }, ..self }
    }

    /// The same for a quantity that changes by `factor` times as much.
    pub(crate) fn times(self, factor: f64) -> Self {
        let size = factor.abs();
        Self { left: size * self.left, rate: factor * self.rate, by_flow: size * self.by_flow, off: size * self.off }
    }

    /// The same for a quantity confined to the range `[least, most]`, which has reached `value`.
    fn within(self, [least, most]: [f64; 2], value: f64) -> Self {
        let possible = (value - least).max(most - value);
        Self { left: self.left.min(possible), by_flow: self.by_flow.min(possible), ..self }
    }
}

/// Number of uncertainties by which an angle at rest may be off.
const FAR: f64 = 3.0;

/// Degrees by which it may be off, however small its uncertainty.
const FARTHEST_ERROR: f64 = 1.5;

/// Fraction of itself by which a length at rest may be off.
const FARTHEST_SHARE: f64 = 0.03;

/// Fraction of the remaining change by which an angle that oscillates about its end moved within three windows.
const MOVED: f64 = 0.5;

/// A column in the last three windows.
fn windows(series: &Series, column: &str) -> Option<Windows> {
    Windows::of(&series.rows, &series.columns, column, &SteadyStop::default())
}

/// Whether a column approaches a known end over the signed `distance`: its mean moves there from window to window, in the last by more than [`NOISE`] of the range
/// in the window and by more than [`SLOWEST`] of the distance.
///
/// Spreading is a power law: an exponential through three windows ends long before the angle at rest.
fn approaches(windows: &Windows, distance: f64) -> bool {
    let [first, second, third] = windows.means;
    let (before, now) = ((second - first) * distance.signum(), (third - second) * distance.signum());
    before > 0.0 && now > NOISE * range(&windows.values[2]) && now > SLOWEST * distance.abs()
}

/// Fraction of the range within a window by which its mean moves if that is not noise; a straight line moves by all of it.
const NOISE: f64 = 0.5;

/// Fraction of the distance to its end by which a quantity moves in a window; a slower one is at rest elsewhere, within its error.
const SLOWEST: f64 = 0.01;

/// The kinetic energy of a column that is still to be dissipated, in its unit; 0 if it does not fall.
fn energy_to_lose(series: &Series, column: &str) -> f64 {
    let Some(drift) = Drift::of(series, column).filter(|drift| drift.rate < 0.0) else { return 0.0 };
    drift.left.min(windows(series, column).map_or(0.0, |windows| windows.values[2].iter().copied().fold(0.0, f64::max)))
}

/// Least-squares slope of a column over the time in the last window.
fn slope(times: &Windows, column: &Windows) -> f64 {
    let moment = |of: &Windows| -> f64 {
        times.values[2].iter().zip(&of.values[2]).map(|(t, x)| (t - times.means[2]) * (x - of.means[2])).sum()
    };
    moment(column) / moment(times)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(value: impl Fn(f64) -> f64) -> Series {
        let rows = (0..=100).map(|i| f64::from(i) / 100.0).map(|t| vec![t, value(t)]).collect();
        Series { columns: vec!["time_s".into(), "angle".into()], rows }
    }

    #[test]
    fn what_is_left_covers_the_way_to_the_end() {
        for decay in [0.05, 0.2, 0.5] {
            let found = Drift::of(&series(|t| 25.0 + 30.0 * (-t / decay).exp()), "angle").unwrap();
            let left = 30.0 * (-1.0 / decay).exp();
            assert!(found.left >= 0.99 * left && found.left < 6.0 * left + 1e-4, "{decay}: {found:?}, {left}");
            assert!(found.rate <= 0.0);
        }
    }

    #[test]
    fn a_quantity_that_swings_may_be_off_by_its_swing_and_one_at_rest_by_nothing() {
        let swing = Drift::of(&series(|t| 60.0 + (40.0 * t).sin()), "angle").unwrap();
        assert!(swing.left > 0.9, "{swing:?}");
        assert_eq!(Drift::of(&series(|_| 60.0), "angle"), Some(Drift { left: 0.0, rate: 0.0, by_flow: 0.0, off: 0.0 }));
    }

    #[test]
    fn what_is_left_does_not_exceed_what_is_possible() {
        let emptying = Drift::of(&series(|t| 1.0 - 0.8 * t), "angle").unwrap();
        assert!(emptying.left > 1.0, "{emptying:?}");
        assert_eq!(emptying.within([0.0, 1.0], 0.2).left, 0.8);
        assert_eq!(emptying.within([f64::NEG_INFINITY, f64::INFINITY], 0.2), emptying);
    }

    #[test]
    fn an_angle_may_turn_by_what_the_flow_can_still_do() {
        let turn = |energy: fn(f64) -> f64| {
            let found = of_angle(|_| 22.4, energy, None);
            assert!(found.left < 1e-12 && found.rate.abs() < 1e-12, "{found:?}");
            found.by_flow
        };
        let by = |energy: f64| (2.0 * energy / (0.02 * 4.0e-3)).sqrt().to_degrees();
        let end = (-3.0_f64).exp();
        let found = turn(|t| 1.0e-7 * (-3.0 * t).exp());
        assert!(found >= by(1.0e-7 * end) && found <= 1.2 * by(1.0e-7 * end), "{found}");
        // Never more than there is, and nothing for a flow that accelerates or continues.
        let found = turn(|t| 1.0e-7 * (1.0 - t));
        assert!(found > 0.0 && found <= by(0.2e-7), "{found}");
        assert_eq!([turn(|t| 1.0e-7 * t), turn(|_| 1.0e-7)], [0.0, 0.0]);
    }

    /// The drift of an angle over the time 1, with a kinetic energy and the angles at rest if they are known.
    fn of_angle(angle: impl Fn(f64) -> f64, energy: fn(f64) -> f64, at_rest: Option<[f64; 2]>) -> Drift {
        let rows = (1..=100).map(|i| f64::from(i) / 100.0).map(|t| vec![t, angle(t), energy(t), 4.0e-3]).collect();
        let columns = ["time_s", "angle", "energy", "length"].map(str::to_owned).to_vec();
        let kind = Quantity::Angle { energy: "energy", length: "length", tension: 0.02, at_rest, pins: false };
        Drift::of_watched(&Series { columns, rows }, Watched { column: "angle", kind }, angle(1.0)).unwrap()
    }

    /// The drift of an angle with angles at rest from the first to the second of `end`, and its value at the end.
    fn spreading(angle: impl Fn(f64) -> f64, end: [f64; 2]) -> (Drift, f64) {
        (of_angle(&angle, |_| 0.0, Some(end)), angle(1.0))
    }

    #[test]
    fn an_angle_that_spreads_by_a_power_law_is_as_far_from_its_end_as_from_the_angle_at_rest() {
        for exponent in [0.1, 0.2, 3.0 / 7.0, 0.6] {
            for (end, excess) in [(8.0, 1.1), (10.0, 3.2), (40.0, 5.0), (120.0, 10.0), (60.0, -4.0)] {
                let (drift, value) = spreading(|t| end + excess * t.powf(-exponent), [end; 2]);
                assert!(drift.left >= 0.999 * (value - end).abs(), "{exponent} {end} {excess}: {drift:?}");
                // With hysteresis, the nearest angle at rest is reached sooner.
                let (less, _) = spreading(|t| end + excess * t.powf(-exponent), [end - 9.0, end + 9.0]);
                assert!(less.left < drift.left || excess > 9.0, "{exponent} {end} {excess}: {less:?}");
            }
        }
    }

    #[test]
    fn an_angle_that_turns_back_is_as_far_from_its_end_as_from_the_angle_at_rest() {
        for periods in [0.5, 0.75, 1.0, 1.5] {
            for decay in [0.3, 1.0, 3.0] {
                let angle = |t: f64| 60.0 + 25.0 * (-decay * t).exp() * (std::f64::consts::TAU * periods * t).cos();
                let (drift, value) = spreading(angle, [60.0; 2]);
                assert!(drift.left >= 0.999 * (value - 60.0).abs(), "{periods} {decay}: {value} {drift:?}");
            }
        }
    }

    #[test]
    fn an_angle_far_from_the_only_one_at_which_it_rests_is_not_at_rest_however_slow() {
        let (drift, _) = spreading(|t| 13.17 + 0.01 * (500.0 * t).sin(), [10.0; 2]);
        assert!(drift.left < 0.05 && drift.beside(0.05).left > 3.1, "{drift:?}");
        assert_eq!(drift.beside(2.0), drift);
        let (near, _) = spreading(|_| 61.0, [60.0; 2]);
        assert_eq!(near.beside(0.05), near);
    }

    #[test]
    fn an_angle_at_rest_beside_the_requested_one_has_an_error_and_no_motion() {
        let noise = |t: f64| 0.02 * (700.0 * t).sin();
        for rest in [[40.0; 2], [80.0; 2], [59.0, 59.5]] {
            let (drift, _) = spreading(|t| 60.0 + noise(t), rest);
            assert!(drift.left < 0.05, "{rest:?}: {drift:?}");
            let (drift, _) = spreading(|t| 60.0 + noise(t) + 20.0 * (-60.0 * t).exp(), rest);
            assert!(drift.left < 0.05, "{rest:?}: {drift:?}");
        }
    }

    #[test]
    fn too_few_records_and_missing_values_tell_nothing() {
        let mut short = series(|_| 60.0);
        short.rows.truncate(3);
        assert_eq!(Drift::of(&short, "angle"), None);
        assert_eq!(Drift::of(&series(|_| f64::NAN), "angle"), None);
        assert_eq!(Drift::of(&series(|_| 60.0), "pressure"), None);
    }
}
