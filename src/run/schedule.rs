//! Times of the records: the stops of a run in s, each an integer multiple of its interval, and the end.
//!
//! Times come from a multiplication, never from a sum, and depend on the present time only, so that a resumed run stops at the same times as an uninterrupted
//! one. Stops that differ only by rounding are one stop.

use meniscus_case::Output;

/// Times closer than this fraction of the shortest interval are one: far above rounding, far below a time step.
const SAME: f64 = 1.0e-9;

/// The records due at a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Due {
    /// A row of the series.
    pub(crate) series: bool,
    /// VTK files.
    pub(crate) vtk: bool,
    /// The saved state.
    pub(crate) restart: bool,
}

impl Due {
    /// All, as at the start and at the end.
    pub(crate) const ALL: Self = Self { series: true, vtk: true, restart: true };
    /// The records of a failed run: the last valid state to look at and to start from.
    pub(crate) const LAST_GOOD_STATE: Self = Self { series: false, vtk: true, restart: true };
    /// The record that an interrupted run needs to be resumed.
    pub(crate) const TO_RESUME: Self = Self { series: false, vtk: false, restart: true };
}

/// A time that the solver must meet exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stop {
    /// Time in s.
    pub time: f64,
    /// The records due then.
    pub due: Due,
}

/// The stops of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Schedule {
    series: f64,
    vtk: f64,
    restart: f64,
    end: f64,
}

impl Schedule {
    /// The stops of a run that ends at `end` in s.
    pub(crate) fn new(output: &Output, end: f64) -> Self {
        Self { series: output.series_every, vtk: output.vtk_every, restart: output.restart_every, end }
    }

    /// The end in s.
    pub(crate) fn end(&self) -> f64 {
        self.end
    }

    /// The first stop after `time` in s; `None` if the run is over. At the end everything is due.
    pub(crate) fn next_after(&self, time: f64) -> Option<Stop> {
        if time >= self.end {
            return None;
        }
        let slack = SAME * self.series.min(self.vtk).min(self.restart).min(self.end);
        let [series, vtk, restart] = [self.series, self.vtk, self.restart].map(|every| self.next(every, time + slack));
        let first = series.min(vtk).min(restart);
        if first >= self.end - slack {
            return Some(Stop { time: self.end, due: Due::ALL });
        }
        let due = |next: f64| next <= first + slack;
        Some(Stop { time: first, due: Due { series: due(series), vtk: due(vtk), restart: due(restart) } })
    }

    /// The first multiple of `every` after `time`, at most the end.
    fn next(&self, every: f64, time: f64) -> f64 {
        if !(every > 0.0 && every < self.end) {
            return self.end;
        }
        // The quotient may round up to the next integer: start one below and test.
        let below = (time / every).floor() - 1.0;
        (0..=3)
            .map(|i| multiple(below + f64::from(i), every))
            .find(|&next| next > time)
            .unwrap_or(self.end)
            .min(self.end)
    }
}

/// `count` times `every` without the rounding error of the product, which would show in every file: 4.5e-6 for 4.499999999999999e-6.
fn multiple(count: f64, every: f64) -> f64 {
    // One digit less than the accuracy of a product.
    let product = count * every;
    format!("{product:.13e}").parse().unwrap_or(product)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn schedule(series: f64, vtk: f64, restart: f64, end: f64) -> Schedule {
        Schedule { series, vtk, restart, end }
    }

    fn stops(schedule: &Schedule) -> Vec<Stop> {
        std::iter::successors(schedule.next_after(0.0), |stop| schedule.next_after(stop.time)).collect()
    }

    #[test]
    fn intervals_that_differ_by_rounding_share_their_stops() {
        let all = stops(&schedule(0.1, 0.3, 0.6, 1.2));
        assert_eq!(all.len(), 12);
        assert_eq!(all.iter().filter(|stop| stop.due.vtk).count(), 4);
        assert_eq!(all.iter().filter(|stop| stop.due.restart).count(), 2);
        assert!(all.iter().all(|stop| stop.due.series));
        assert_eq!(all.last().map(|stop| stop.time), Some(1.2));
    }

    #[test]
    fn stops_are_the_numbers_that_people_write() {
        let all = stops(&schedule(7.5e-7, 1.0, 1.0, 1.5e-4));
        assert_eq!((all.len(), all[5].time, all[17].time), (200, 4.5e-6, 1.35e-5));
    }

    #[test]
    fn an_interval_beyond_the_end_leaves_the_end() {
        assert_eq!(stops(&schedule(f64::INFINITY, 5.0, 2.0, 1.0)), [Stop { time: 1.0, due: Due::ALL }]);
    }

    proptest! {
        #[test]
        fn stops_rise_to_the_end_and_none_is_lost(
            series in 1.0e-3..0.5_f64, vtk in 1.0e-3..0.5_f64, restart in 1.0e-3..2.0_f64, scale in -9..3
        ) {
            let unit = 10_f64.powi(scale);
            let schedule = schedule(series * unit, vtk * unit, restart * unit, unit);
            let all = stops(&schedule);
            let shortest = series.min(vtk).min(restart) * unit;
            for pair in all.windows(2) {
                prop_assert!(pair[1].time - pair[0].time > 0.5 * SAME * shortest);
            }
            let last = all.last().unwrap();
            prop_assert_eq!((last.time, last.due), (unit, Due::ALL));
            let expected = (1.0 / vtk - SAME).ceil() as usize;
            prop_assert_eq!(all.iter().filter(|stop| stop.due.vtk).count(), expected);
        }

        #[test]
        fn a_run_resumed_between_stops_meets_the_same_stops(at in 0.0..1.0) {
            let schedule = schedule(0.01, 0.03, 0.25, 1.0);
            let rest: Vec<Stop> = stops(&schedule).into_iter().filter(|stop| stop.time > at + 1.0e-10).collect();
            let resumed: Vec<Stop> =
                std::iter::successors(schedule.next_after(at), |stop| schedule.next_after(stop.time)).collect();
            prop_assert_eq!(rest, resumed);
        }
    }
}
