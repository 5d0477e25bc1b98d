//! How far a quantity of the series may still be from its end, and how fast it moves.
//!
//! With the means m₁, m₂, m₃ over three equal windows that end at the last row, an exponential approach leaves |d₂| r/(1 − r), d₁ = m₂ − m₁,
//! d₂ = m₃ − m₂, r = d₂/d₁, cut off at [`steady::SLOWEST`]. A quantity that swings, so that d₁ and d₂ may differ in sign, is
//! off by half of its range in the last window at most.
//!
//! A contact angle can pass its end and turn back: a flow that loses the kinetic energy E can do the work E on an interface of the length L, and
//! so turn it by up to √(2E/(σL)). E is at most what the whole domain has in the last window.

use super::steady::{self, last_windows, range};
use crate::case::checked::SteadyStop;
use crate::solver::{Quantity, Series, Watched};

/// How a quantity moves at the end of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// How far it may be from its end, in its unit.
    pub left: f64,
    /// Its rate over the last window, in its unit per s.
    pub rate: f64,
    /// How far the flow may still carry it, in its unit, however little it moves.
    pub by_flow: f64,
}

impl Drift {
    /// The drift of a column of `series` over windows of a fifth of the time; none where it is not known in each of them.
    #[must_use]
    pub fn of(series: &Series, column: &str) -> Option<Self> {
        let index = series.columns.iter().position(|one| one == column)?;
        let windows = last_windows(&series.rows, &SteadyStop::default())?;
        let values = windows.map(|rows| rows.iter().map(|row| row[index]).collect::<Vec<f64>>());
        let [first, second, third] = [0, 1, 2].map(|i| values[i].iter().sum::<f64>() / values[i].len() as f64);
        let (before, last) = (second - first, third - second);
        let approach = if before * last > 0.0 { steady::left([first, second, third]) } else { 0.0 };
        let left = approach.max(0.5 * range(&values[2]));
        let rate = slope(windows[2], index);
        (left.is_finite() && rate.is_finite()).then_some(Self { left, rate, by_flow: 0.0 })
    }

    /// The drift of a watched quantity that has come to `value`.
    #[must_use]
    pub fn of_watched(series: &Series, Watched { column, kind }: Watched, value: f64) -> Option<Self> {
        let mut drift = Self::of(series, column)?;
        if let Quantity::Angle { energy, length, tension } = kind {
            let length = series.column(length).last().unwrap_or(f64::NAN);
            let turn = (2.0 * energy_to_lose(series, energy) / (tension * length)).sqrt().to_degrees();
            drift.by_flow = if turn.is_finite() { turn } else { 0.0 };
        }
        Some(drift.within(kind.range(), value))
    }

    /// The same for a quantity that changes by `factor` times as much.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { left: factor.abs() * self.left, rate: factor * self.rate, by_flow: factor.abs() * self.by_flow }
    }

    /// The same for a quantity that cannot leave the range `[least, most]`, and has come to `value`.
    fn within(self, [least, most]: [f64; 2], value: f64) -> Self {
        let possible = (value - least).max(most - value);
        Self { left: self.left.min(possible), by_flow: self.by_flow.min(possible), ..self }
    }
}

/// What of the kinetic energy in a column is still to be lost, in its unit; 0 where it does not fall.
fn energy_to_lose(series: &Series, column: &str) -> f64 {
    let Some(drift) = Drift::of(series, column).filter(|drift| drift.rate < 0.0) else { return 0.0 };
    let index = series.columns.iter().position(|one| one == column);
    let last = last_windows(&series.rows, &SteadyStop::default()).map(|windows| windows[2]);
    let values = index.zip(last).map(|(index, rows)| rows.iter().map(move |row| row[index]));
    drift.left.min(values.into_iter().flatten().fold(0.0, f64::max))
}

/// Slope of the straight line of least squares through a column of `rows` over the time in their first column.
fn slope(rows: &[Vec<f64>], column: usize) -> f64 {
    let count = rows.len() as f64;
    let mean = |column: usize| rows.iter().map(|row| row[column]).sum::<f64>() / count;
    let (time, value) = (mean(0), mean(column));
    let moment =
        |column: usize, about: f64| rows.iter().map(|row| (row[0] - time) * (row[column] - about)).sum::<f64>();
    moment(column, value) / moment(0, time)
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
        assert_eq!(Drift::of(&series(|_| 60.0), "angle"), Some(Drift { left: 0.0, rate: 0.0, by_flow: 0.0 }));
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
            let rows = (0..=100).map(|i| f64::from(i) / 100.0).map(|t| vec![t, 22.4, energy(t), 4.0e-3]).collect();
            let columns = ["time_s", "angle", "energy", "length"].map(str::to_owned).to_vec();
            let kind = Quantity::Angle { energy: "energy", length: "length", tension: 0.02 };
            let found = Drift::of_watched(&Series { columns, rows }, Watched { column: "angle", kind }, 22.4).unwrap();
            assert!(found.left < 1e-12 && found.rate.abs() < 1e-12, "{found:?}");
            found.by_flow
        };
        let by = |energy: f64| (2.0 * energy / (0.02 * 4.0e-3)).sqrt().to_degrees();
        let end = (-3.0_f64).exp();
        let found = turn(|t| 1.0e-7 * (-3.0 * t).exp());
        assert!(found >= by(1.0e-7 * end) && found <= 1.2 * by(1.0e-7 * end), "{found}");
        // Never more than there is, and nothing of a flow that speeds up or goes on.
        let found = turn(|t| 1.0e-7 * (1.0 - t));
        assert!(found > 0.0 && found <= by(0.2e-7), "{found}");
        assert_eq!([turn(|t| 1.0e-7 * t), turn(|_| 1.0e-7)], [0.0, 0.0]);
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
