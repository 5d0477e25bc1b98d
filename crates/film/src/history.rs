//! The path of a contact line, recorded at times equidistant in the logarithm, and fits to it. Scaled.
//!
//! Records of a case are equidistant in time, which is unsuitable for a droplet whose steps grow by a factor of a million.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::profile::exponent;

/// Records per decade of time.
const PER_DECADE: f64 = 40.0;
/// Frames per decade of time.
const FRAMES_PER_DECADE: f64 = 10.0;
/// The first record.
const FIRST: f64 = 1.0e-4;
/// The Cox-Voinov law is fitted to records in this window of scaled time. Its two constants depend on the window, which is therefore fixed.
pub(crate) const WINDOW: (f64, f64) = (1.0e-2, 1.0);
/// Coefficient of the law in units of the scaled speed 3 Ca: θ³ = θₑ³ + 9 Ca ln(x/d).
pub(crate) const COX_VOINOV: f64 = 3.0;
/// Minimum number of records for a fit.
const FEWEST: usize = 8;

/// The contact line at one time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Record {
    pub time: f64,
    /// Position of the contact line.
    pub(crate) position: f64,
    /// Slope of the apparent contact angle.
    pub(crate) slope: f64,
    /// Position of the last particle, if there are particles.
    pub(crate) last: Option<f64>,
}

/// The film at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Frame {
    pub time: f64,
    /// Heights at fixed positions.
    pub heights: Vec<f64>,
    /// Positions of some particles on the right, ascending up to the last one; empty without particles.
    pub particles: Vec<f64>,
}

/// Records and frames up to now.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct History {
    /// In the order of time.
    pub(crate) records: Vec<Record>,
    /// In the order of time.
    pub(crate) frames: Vec<Frame>,
}

/// A fitted Cox-Voinov law: θ³ = θₑ³ + c v ln(x/d).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CoxVoinov {
    /// c.
    pub(crate) factor: f64,
    /// d.
    pub(crate) length: f64,
    /// Root mean square residual of θ³.
    pub(crate) error: f64,
}

impl History {
    /// Whether a record is due at `time`.
    pub(crate) fn is_due(&self, time: f64) -> bool {
        is_next(PER_DECADE, time, self.records.last().map(|last| last.time))
    }

    /// Whether a frame is due at `time`.
    pub(crate) fn is_frame_due(&self, time: f64) -> bool {
        is_next(FRAMES_PER_DECADE, time, self.frames.last().map(|last| last.time))
    }

    /// Exponent of the growth of a length in time, from `start` on.
    pub(crate) fn exponent(&self, start: f64, length: impl Fn(&Record) -> Option<f64>) -> Option<f64> {
        let later = self.records.iter().filter(|record| record.time >= start);
        exponent(later.filter_map(|record| Some((record.time, length(record)?))))
    }

    /// The Cox-Voinov law for the equilibrium slope `rest`, by linear least squares in c and c ln d over the window, and the fitted data: speed, position and
    /// cubed slope of the contact line.
    pub(crate) fn cox_voinov(&self, rest: f64) -> Option<(CoxVoinov, Vec<[f64; 3]>)> {
        let found: Vec<[f64; 3]> = self
            .records
            .windows(3)
            .filter(|w| (WINDOW.0..=WINDOW.1).contains(&w[1].time))
            .map(|w| {
                let (before, after) = (w[1].time - w[0].time, w[2].time - w[1].time);
                let (rise, next) = ((w[1].position - w[0].position) / before, (w[2].position - w[1].position) / after);
                [(rise * after + next * before) / (before + after), w[1].position, w[1].slope.powi(3)]
            })
            .collect();
        let term = |&[speed, position, cube]: &[f64; 3]| [speed * position.ln(), -speed, cube - rest.powi(3)];
        let points: Vec<[f64; 3]> = found.iter().map(term).collect();
        if points.len() < FEWEST {
            return None;
        }
        let sum = |i: usize, j: usize| points.iter().map(|p| p[i] * p[j]).sum::<f64>();
        let matrix = Matrix2::new(sum(0, 0), sum(0, 1), sum(0, 1), sum(1, 1));
        let solution = matrix.try_inverse()? * Vector2::new(sum(0, 2), sum(1, 2));
        let off = |p: &[f64; 3]| (p[0] * solution.x + p[1] * solution.y - p[2]).powi(2);
        let error = (points.iter().map(off).sum::<f64>() / points.len() as f64).sqrt();
        Some((CoxVoinov { factor: solution.x, length: (solution.y / solution.x).exp(), error }, found))
    }
}

/// Whether a time is the first one in its interval of a decade.
fn is_next(per_decade: f64, time: f64, last: Option<f64>) -> bool {
    let interval = |time: f64| (per_decade * (time / FIRST).log10()).floor();
    time >= FIRST && last.is_none_or(|last| interval(time) > interval(last))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_due_forty_times_a_decade() {
        let mut history = History::default();
        let mut time = 1.0e-5;
        while time < 1.0 {
            if history.is_due(time) {
                history.records.push(Record { time, position: time.powf(0.2), slope: 1.0, last: None });
            }
            time *= 1.001;
        }
        assert_eq!(history.records.len(), 160);
        assert!((history.exponent(0.0, |r| Some(r.position)).unwrap() - 0.2).abs() < 1.0e-12);
        assert_eq!((history.exponent(0.0, |r| r.last), exponent([(1.0, 2.0)])), (None, None));
    }

    #[test]
    fn a_line_that_moves_by_the_law_of_cox_and_voinov_gives_back_its_constants() {
        let (factor, length) = (3.0, 0.4);
        // x = t^(1/10), its speed x/(10 t).
        let record = |i: i32| {
            let time = 1.0e-3 * 10_f64.powf(f64::from(i) / 400.0);
            let position = time.powf(0.1);
            let cube = 1.0 + factor * 0.1 * position / time * (position / length).ln();
            Record { time, position, slope: cube.cbrt(), last: None }
        };
        let history = History { records: (0..1400).map(record).collect(), frames: Vec::new() };
        let (found, _) = history.cox_voinov(1.0).unwrap();
        // Speeds from differences over 1/400 of a decade.
        assert!((found.factor / factor - 1.0).abs() < 1.0e-3 && (found.length / length - 1.0).abs() < 1.0e-3);
        assert!(found.error < 1.0e-3);
    }
}
