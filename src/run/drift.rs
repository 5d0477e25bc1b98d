//! How far a quantity of the series may still be from its end, and how fast it moves.
//!
//! With the means m₁, m₂, m₃ over three equal windows that end at the last row, an exponential approach leaves |d₂| r/(1 − r), d₁ = m₂ − m₁,
//! d₂ = m₃ − m₂, r = d₂/d₁, cut off at [`steady::SLOWEST`]. A quantity that swings, so that d₁ and d₂ may differ in sign, is
//! off by half of its range in the last window at most.

use super::steady::{self, last_windows, range};
use crate::case::checked::SteadyStop;
use crate::solver::Series;

/// How a quantity moves at the end of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// How far it may be from its end, in its unit.
    pub left: f64,
    /// Its rate over the last window, in its unit per s.
    pub rate: f64,
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
        (left.is_finite() && rate.is_finite()).then_some(Self { left, rate })
    }

    /// The same for a quantity that cannot leave the range `[least, most]`, and has come to `value`.
    #[must_use]
    pub fn within(self, [least, most]: [f64; 2], value: f64) -> Self {
        Self { left: self.left.min((value - least).max(most - value)), ..self }
    }
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
        assert_eq!(Drift::of(&series(|_| 60.0), "angle"), Some(Drift { left: 0.0, rate: 0.0 }));
    }

    #[test]
    fn what_is_left_does_not_exceed_what_is_possible() {
        let emptying = Drift::of(&series(|t| 1.0 - 0.8 * t), "angle").unwrap();
        assert!(emptying.left > 1.0, "{emptying:?}");
        assert_eq!(emptying.within([0.0, 1.0], 0.2).left, 0.8);
        assert_eq!(emptying.within([f64::NEG_INFINITY, f64::INFINITY], 0.2), emptying);
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
