//! Body forces that act one after the other in one run, to measure the linear response of a creeping flow to each.
//!
//! The force depends on time alone, so that a resumed run switches it as an uninterrupted one does.

use meniscus_core::math::Vec2;
use meniscus_core::solver::Series;

/// Times closer than this fraction of a stage count as equal: far above the rounding of records, far below a time step.
const SAME: f64 = 1.0e-9;

/// Stages of equal length, each with a body force along one axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Stages {
    /// Axis of the force in each stage, 0 for x and 1 for y.
    axes: Vec<usize>,
    /// Body force per mass in m/s², whose components act one after the other.
    force: Vec2,
    /// Length of a stage in s.
    length: f64,
}

impl Stages {
    /// The nonzero components of `force` (m/s²), x first, for equal times until `end` (s); `None` without a force.
    pub(crate) fn new(force: Vec2, end: f64) -> Option<Self> {
        let axes: Vec<usize> = (0..2).filter(|&axis| force[axis] != 0.0).collect();
        let length = end / axes.len() as f64;
        (!axes.is_empty()).then_some(Self { axes, force, length })
    }

    /// The `force` (m/s²), which is along one axis, in `times` stages of equal length until `end` (s), each with a new flow. `None` without a force.
    pub(crate) fn repeated(force: Vec2, times: usize, end: f64) -> Option<Self> {
        let of_one = Self::new(force, end)?;
        let axis = of_one.axes[0];
        Some(Self { axes: vec![axis; times], force, length: end / times as f64 })
    }

    /// The axes in the order of their stages.
    pub(crate) fn axes(&self) -> &[usize] {
        &self.axes
    }

    /// Body force per mass in m/s² of the step that starts at `time` (s).
    pub(crate) fn force(&self, time: f64) -> Vec2 {
        self.force_of(self.stage(time))
    }

    /// The stage of the step that starts at `time` (s).
    pub(crate) fn stage(&self, time: f64) -> usize {
        (1..self.axes.len()).filter(|&stage| self.starts_by(stage, time)).count()
    }

    /// Start in s of the stage of the step that starts at `time` (s).
    pub(crate) fn since(&self, time: f64) -> f64 {
        self.start(self.stage(time))
    }

    /// Body force per mass in m/s² of a stage; zero beyond the last one.
    pub(crate) fn force_of(&self, stage: usize) -> Vec2 {
        let acts = |axis| self.axes.get(stage) == Some(&axis);
        Vec2::from_fn(|axis, _| if acts(axis) { self.force[axis] } else { 0.0 })
    }

    /// The end of a step from `time` (s) to `until` (s), or the next change of the force if that comes first.
    pub(crate) fn stop(&self, time: f64, until: f64) -> f64 {
        let starts = (1..self.axes.len()).filter(|&stage| !self.starts_by(stage, time));
        starts.map(|stage| self.start(stage)).fold(until, |stop, start| {
            let is_before = start < stop - SAME * self.length;
            if is_before { start } else { stop }
        })
    }

    /// The rows of the series within a stage, from the one at its start to the one at its end.
    pub(crate) fn rows<'s>(&self, series: &'s Series, stage: usize) -> Vec<&'s [f64]> {
        let slack = SAME * self.length;
        let (from, to) = (self.start(stage) - slack, self.start(stage + 1) + slack);
        series.rows.iter().map(Vec::as_slice).filter(|row| (from..=to).contains(&row[0])).collect()
    }

    fn start(&self, stage: usize) -> f64 {
        stage as f64 * self.length
    }

    fn starts_by(&self, stage: usize, time: f64) -> bool {
        time >= self.start(stage) - SAME * self.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turning() -> Stages {
        Stages::new(Vec2::new(2.0, 3.0), 1.0).unwrap()
    }

    #[test]
    fn the_force_turns_once_at_half_the_time() {
        let halfway = 0.1 + 0.2 + 0.2 - f64::EPSILON;
        for (time, force) in [(0.0, [2.0, 0.0]), (0.4999, [2.0, 0.0]), (halfway, [0.0, 3.0]), (1.0, [0.0, 3.0])] {
            assert_eq!(turning().force(time), Vec2::from(force), "at {time} s");
        }
    }

    #[test]
    fn steps_land_on_the_turn_without_a_sliver() {
        let (almost, hardly) = (0.5 - f64::EPSILON, 0.5 + f64::EPSILON);
        for (time, until, stop) in
            [(0.0, 0.3, 0.3), (0.3, 0.7, 0.5), (0.5, 0.7, 0.7), (0.3, hardly, hardly), (almost, 0.7, 0.7)]
        {
            assert_eq!(turning().stop(time, until), stop, "from {time} s");
        }
    }

    #[test]
    fn a_force_along_one_axis_acts_all_the_time() {
        let stages = Stages::new(Vec2::new(0.0, -3.0), 1.0).unwrap();
        assert_eq!(stages.axes(), [1]);
        assert_eq!([0.0, 0.1, 0.9].map(|time| stages.force(time)), [Vec2::new(0.0, -3.0); 3]);
        assert_eq!(stages.stop(0.3, 0.7), 0.7);
        assert_eq!(Stages::new(Vec2::zeros(), 1.0), None);
    }

    #[test]
    fn a_force_that_is_repeated_begins_anew_at_each_third() {
        let stages = Stages::repeated(Vec2::new(0.0, 3.0), 3, 0.9).unwrap();
        assert_eq!([0.0, 0.29, 0.3, 0.6, 0.9].map(|time| stages.stage(time)), [0, 0, 1, 2, 2]);
        assert_eq!([0.0, 0.7].map(|time| stages.force(time)), [Vec2::new(0.0, 3.0); 2]);
        assert!((stages.stop(0.2, 0.5) - 0.3).abs() < 1e-12);
    }

    #[test]
    fn rows_belong_to_the_stage_that_they_end() {
        let stages = turning();
        let rows = [0.0, 0.25, 0.5, 0.75, 1.0].map(|time| vec![time]).to_vec();
        let series = Series { columns: vec!["time_s".into()], rows };
        let times = |stage| stages.rows(&series, stage).iter().map(|row| row[0]).collect::<Vec<f64>>();
        assert_eq!((times(0), times(1)), (vec![0.0, 0.25, 0.5], vec![0.5, 0.75, 1.0]));
    }
}
