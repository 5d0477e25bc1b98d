//! Whether a run is steady, from the rows of its series alone, so that a resumed run decides like an uninterrupted one.
//!
//! Three windows of equal length `w` end at the present row. With the means m₁, m₂, m₃ of a quantity over them, an exponential approach to its end leaves |d₂|
//! r/(1 − r) after the last one, d₁ = m₂ − m₁, d₂ = m₃ − m₂, r = |d₂/d₁|. The ratio is cut off at [`SLOWEST`]: if slower, or without a decay, the remaining
//! change is nine times the last one, and if d₁ and d₂ differ in sign, as at the turning point of an oscillation, nine times the larger one. A quantity is
//! steady if the remaining change and the range of its values in the last window are both within its tolerance; a run is steady if all its quantities are.

use serde::Serialize;

use meniscus_case::{FEWEST_ROWS, SteadyStop};
use meniscus_core::math::{SLOWEST, remaining};
use meniscus_core::solver::{Quantity, Series, Watched};

/// Length of a window relative to the elapsed time, if the case gives none: slow changes have that much longer to show.
pub(crate) const SHARE: f64 = 0.2;

/// Rows nearer to the end of a window than this fraction of it are on it.
const SAME: f64 = 1.0e-6;

/// The state of a quantity at a row.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Change {
    /// Column of `series.csv`.
    pub column: &'static str,
    /// Mean over the last window, in the unit of the column.
    pub mean: f64,
    /// The larger of the remaining change and the range in the last window; for a speed, its largest value.
    pub change: f64,
    /// Largest change of a steady run.
    pub tolerance: f64,
}

impl Change {
    /// Whether it is steady.
    pub(crate) fn is_steady(&self) -> bool {
        self.change <= self.tolerance
    }
}

/// Whether a run is steady, and what still changes.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub struct Steadiness {
    /// Time in s of the first row at which all quantities were steady; `None` if there was none.
    pub at_s: Option<f64>,
    /// Length in s of each of the three windows at the last row.
    pub window_s: f64,
    /// The quantities at that row, or at the last row of a run that never became steady; empty if the run was too short to decide.
    pub quantities: Vec<Change>,
}

impl Steadiness {
    /// What still changes and by how much, as text.
    pub(crate) fn unsettled(&self) -> String {
        let changing = self.quantities.iter().filter(|one| !one.is_steady());
        let words = changing.map(|one| {
            let (column, mean) = (one.column, one.mean);
            if one.change.is_nan() {
                return format!("{column} was not measured in all records");
            }
            format!("{column}, {mean:.4e}, may change by {:.1e} ({:.1e} allowed)", one.change, one.tolerance)
        });
        words.collect::<Vec<_>>().join("; ")
    }

    /// The first steady row of a series, or its last row.
    pub(crate) fn of(series: &Series, watched: &[Watched], steady: &SteadyStop) -> Self {
        let times: Vec<f64> = series.rows.iter().filter_map(|row| row.first().copied()).collect();
        let found = (1..=times.len()).map(|rows| changes(&series.rows[..rows], &series.columns, watched, steady));
        let mut last = Vec::new();
        for (time, changes) in times.iter().zip(found) {
            let is_steady = all_steady(&changes);
            last = changes;
            if is_steady {
                return Self { at_s: Some(*time), window_s: window(*time, steady), quantities: last };
            }
        }
        let window_s = window(times.last().copied().unwrap_or(0.0), steady);
        Self { at_s: None, window_s, quantities: last }
    }
}

/// Whether a run is steady at the last row of its series.
pub(crate) fn is_steady(series: &Series, watched: &[Watched], steady: &SteadyStop) -> bool {
    all_steady(&changes(&series.rows, &series.columns, watched, steady))
}

fn all_steady(changes: &[Change]) -> bool {
    !changes.is_empty() && changes.iter().all(Change::is_steady)
}

fn window(time: f64, steady: &SteadyStop) -> f64 {
    steady.window.unwrap_or(SHARE * time)
}

/// The state of each quantity that exists at the last of `rows`; none if a window has too few of them.
fn changes(rows: &[Vec<f64>], columns: &[String], watched: &[Watched], steady: &SteadyStop) -> Vec<Change> {
    let windows = |name: &str| {
        let windows = Windows::of(rows, columns, name, steady)?;
        windows.values.iter().flatten().any(|value| !value.is_nan()).then_some(windows)
    };
    watched.iter().filter_map(|one| Some(change(one, &windows(one.column)?, steady, &windows))).collect()
}

/// A column in the three windows that end at the last row.
pub(super) struct Windows {
    /// Its values.
    pub(super) values: [Vec<f64>; 3],
    /// Their means.
    pub(super) means: [f64; 3],
}

impl Windows {
    /// `None` if there is no such column, or if a window has too few rows.
    pub(super) fn of(rows: &[Vec<f64>], columns: &[String], column: &str, steady: &SteadyStop) -> Option<Self> {
        let column = columns.iter().position(|one| one == column)?;
        let values = last_windows(rows, steady)?.map(|rows| rows.iter().map(|row| row[column]).collect::<Vec<f64>>());
        let means = values.each_ref().map(|values| values.iter().sum::<f64>() / values.len() as f64);
        Some(Self { values, means })
    }
}

/// The rows of the three windows that end at the last row.
fn last_windows<'r>(rows: &'r [Vec<f64>], steady: &SteadyStop) -> Option<[&'r [Vec<f64>]; 3]> {
    let now = *rows.last()?.first()?;
    let length = window(now, steady);
    // A window includes its end, not its start.
    let after = |time: f64| rows.partition_point(|row| row[0] <= time + SAME * length);
    let [a, b, c] = [3.0, 2.0, 1.0].map(|count| now - count * length);
    // Three windows since time zero, the row of which has no motion yet.
    if a < -SAME * length {
        return None;
    }
    let windows = [&rows[after(a)..after(b)], &rows[after(b)..after(c)], &rows[after(c)..]];
    windows.iter().all(|rows| rows.len() as f64 >= FEWEST_ROWS).then_some(windows)
}

fn change(
    watched: &Watched,
    Windows { values, means }: &Windows,
    steady: &SteadyStop,
    others: &dyn Fn(&str) -> Option<Windows>,
) -> Change {
    let mean = means[2];
    if let Quantity::Energy { speed, capillary_speed: Some(capillary_speed) } = watched.kind
        && let Some(speeds) = others(speed)
    {
        let largest = speeds.values[2].iter().copied().fold(0.0, f64::max);
        let tolerance = steady.capillary_number * capillary_speed;
        if largest <= tolerance {
            return Change { column: speed, mean: speeds.means[2], change: largest, tolerance };
        }
    }
    let tolerance = match watched.kind {
        Quantity::Angle { .. } => steady.contact_angle.to_degrees(),
        Quantity::Pressure { scale } => steady.capillary_pressure * mean.abs().max(scale),
        Quantity::Saturation => steady.saturation,
        Quantity::Energy { .. } => steady.kinetic_energy * mean.abs(),
    };
    let range = range(&values[2]);
    // A value missing in one of the windows leaves the decision open.
    let change = if means.iter().all(|mean| mean.is_finite()) { left(*means).max(range) } else { f64::NAN };
    Change { column: watched.column, mean, change, tolerance }
}

/// The largest minus the smallest of `values`.
pub(super) fn range(values: &[f64]) -> f64 {
    let over = |pick: fn(f64, f64) -> f64, from: f64| values.iter().copied().fold(from, pick);
    over(f64::max, f64::NEG_INFINITY) - over(f64::min, f64::INFINITY)
}

/// The remaining change after the last of three windows with these means.
pub(super) fn left([first, second, third]: [f64; 3]) -> f64 {
    let [before, last] = [second - first, third - second];
    if before * last < 0.0 {
        return remaining(before.abs().max(last.abs()), SLOWEST);
    }
    // Both changes are zero.
    remaining(last, if last == 0.0 { 0.0 } else { last / before })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const ROWS: u32 = 200;

    const ANGLE: [Watched; 1] = [Watched {
        column: "contact_angle_deg",
        kind: Quantity::Angle {
            energy: "kinetic_energy_J_per_m",
            length: "interface_length_m",
            tension: 0.02,
            at_rest: None,
            pins: false,
        },
    }];

    /// A series of one second with one quantity.
    fn series(column: &str, value: impl Fn(f64) -> f64) -> Series {
        let times = (0..=ROWS).map(|row| f64::from(row) / f64::from(ROWS));
        Series {
            columns: vec!["time_s".into(), column.into()],
            rows: times.map(|time| vec![time, value(time)]).collect(),
        }
    }

    fn angle(value: impl Fn(f64) -> f64) -> Steadiness {
        Steadiness::of(&series("contact_angle_deg", value), &ANGLE, &SteadyStop::default())
    }

    /// A drop that oscillates about its angle, or creeps to it: `change` in degrees decays within `decay` s, while the phase advances by `swing` rad. Speeds
    /// are those of a drop whose `Oh` is 0.035 if it oscillates by 3.7 rad within a decay, as in `cases/sessile-drop.toml`.
    fn drop_to_rest(change: f64, decay: f64, swing: f64) -> (Steadiness, impl Fn(f64) -> f64) {
        let value = move |time: f64| change * (-time / decay).exp() * (swing * time / decay).cos();
        let slope = move |time: f64| {
            let (sine, cosine) = (swing * time / decay).sin_cos();
            (change.to_radians() / decay * (-time / decay).exp() * (cosine + swing * sine)).abs()
        };
        let mut drop = series("contact_angle_deg", value);
        drop.columns.extend(["max_speed_m_per_s".into(), "kinetic_energy_J_per_m".into()]);
        for row in &mut drop.rows {
            // Half the radius moves with the rate of the angle; lengths in radii, the capillary time is 1.28 over the frequency.
            let speed = 0.5 * slope(row[0]);
            row.extend([speed, speed * speed]);
        }
        let viscous_time = 0.035 * 3.7 / swing * 1.28 * decay / swing;
        let kind = Quantity::Energy { speed: "max_speed_m_per_s", capillary_speed: Some(1.0 / viscous_time) };
        let watched = [ANGLE[0], Watched { column: "kinetic_energy_J_per_m", kind }];
        (Steadiness::of(&drop, &watched, &SteadyStop::default()), value)
    }

    proptest! {
        #[test]
        fn an_approach_that_is_steady_has_no_more_to_go_than_the_tolerance(
            change in -60.0..60.0_f64, decay in 0.005..1.0_f64
        ) {
            let value = |time: f64| change * (-time / decay).exp();
            if let Some(time) = angle(value).at_s {
                // A change that had hardly started at the first decisive row cannot be distinguished from rest.
                prop_assert!(value(time).abs() < 0.3 || time < 0.13, "{} degrees at {time} s", value(time));
            }
        }

        #[test]
        fn a_swing_that_is_steady_has_no_more_to_go_than_the_tolerance(
            change in 5.0..60.0_f64, frequency in 0.5..3.0_f64, swing in 0.3..8.0_f64
        ) {
            let decay = swing / 10.0_f64.powf(frequency);
            let (steady, value) = drop_to_rest(change, decay, swing);
            if let Some(time) = steady.at_s {
                let left = (0..400).map(|i| value(time + f64::from(i) * 0.02 * decay).abs()).fold(0.0, f64::max);
                prop_assert!(left < 0.3, "{left} degrees at {time} s");
            }
        }
    }

    #[test]
    fn a_fast_approach_is_steady_long_before_the_end() {
        let steady = angle(|time| 60.0 + 30.0 * (-time / 0.02).exp());
        // Ten time constants: five would leave 0.2 degrees.
        assert!(steady.at_s.is_some_and(|time| time < 0.2), "{steady:?}");
    }

    #[test]
    fn creep_is_never_steady_however_slow_it_becomes() {
        for speed in [3.0, 10.0, 30.0] {
            assert_eq!(angle(|time| 60.0 + speed * time).at_s, None, "{speed} degrees per second");
            assert_eq!(angle(|time| 60.0 + speed * (time + 0.01).ln()).at_s, None, "{speed} degrees by logarithm");
        }
        let creeping = angle(|time| 60.0 + 3.0 * time);
        assert!(creeping.unsettled().contains("contact_angle_deg"), "{}", creeping.unsettled());
    }

    #[test]
    fn a_window_that_is_given_is_kept() {
        let steady = SteadyStop { window: Some(0.1), ..SteadyStop::default() };
        let quasi_static = series("contact_angle_deg", |_| 60.0);
        assert_eq!(Steadiness::of(&quasi_static, &ANGLE, &steady).at_s, Some(0.3));
        // Five rows in a fifth of the time.
        assert_eq!(angle(|_| 60.0).at_s, Some(24.0 / 200.0));
    }

    #[test]
    fn a_quantity_that_comes_and_goes_is_not_steady_and_one_that_is_nowhere_does_not_count() {
        assert_eq!(angle(|time| if ((time * 40.0) as u32).is_multiple_of(2) { 60.0 } else { f64::NAN }).at_s, None);
        assert_eq!(angle(|_| f64::NAN), Steadiness { at_s: None, window_s: 0.2, quantities: Vec::new() });
    }

    #[test]
    fn particles_rest_below_a_capillary_number_and_flows_by_their_energy() {
        let energy = |capillary_speed| {
            let kind = Quantity::Energy { speed: "max_speed_m_per_s", capillary_speed };
            [Watched { column: "kinetic_energy_J_per_m", kind }]
        };
        let mut motion = series("kinetic_energy_J_per_m", |time| (-2.0 * time / 0.1).exp());
        motion.columns.push("max_speed_m_per_s".into());
        motion.rows.iter_mut().for_each(|row| row.push(row[1].sqrt()));
        let steady = SteadyStop::default();
        // It never becomes steady relative to its value, but is below 1e-4 of 300 m/s after 0.35 s, and one window later all of the window is.
        assert_eq!(Steadiness::of(&motion, &energy(None), &steady).at_s, None);
        let rest = Steadiness::of(&motion, &energy(Some(300.0)), &steady);
        assert!(rest.at_s.is_some_and(|time| (0.42..0.46).contains(&time)), "{rest:?}");
        assert_eq!(rest.quantities[0].column, "max_speed_m_per_s");
    }

    #[test]
    fn the_first_steady_row_is_the_row_at_which_a_run_would_have_stopped() {
        let whole = series("contact_angle_deg", |time| 60.0 + 30.0 * (-time / 0.03).exp());
        let steady = SteadyStop::default();
        let found = Steadiness::of(&whole, &ANGLE, &steady).at_s;
        let up_to = |rows: usize| Series { rows: whole.rows[..rows].to_vec(), ..whole.clone() };
        let stop = (1..=whole.rows.len()).find(|&rows| is_steady(&up_to(rows), &ANGLE, &steady));
        assert_eq!(stop.map(|rows| whole.rows[rows - 1][0]), found);
    }
}
