//! Smooth curves through noisy points: minimum of the sum of squared distances plus λ times that of squared second differences (Whittaker 1923), along a line
//! or around a ring.

use faer::linalg::solvers::Solve;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side};

use meniscus_core::math::{Vec2, factor_in_one_thread, perpendicular};

/// Weights of a second difference.
const WEIGHTS: [f64; 3] = [1.0, -2.0, 1.0];

/// Number of solutions of the equations of a smooth curve, of which all but the first are corrections.
const SOLUTIONS: usize = 3;

/// Points along a contour, at equal distances within each part.
pub(super) struct Samples {
    pub(crate) points: Vec<Vec2>,
    /// Arc length of each along the contour, from its first point.
    pub(crate) along: Vec<f64>,
    /// Indices of the first point of each part, and the end.
    pub(crate) parts: Vec<usize>,
    pub(crate) is_closed: bool,
}

/// Points with a distance of about `spacing` along a polygon. A closed one has a part from each of the vertices in `starts` to the next; an open one keeps its
/// first and last point.
pub(super) fn resampled(points: &[Vec2], starts: Option<&[usize]>, spacing: f64) -> Samples {
    let n = points.len();
    let mut lengths = vec![0.0];
    for k in 0..n {
        lengths.push(lengths[k] + (points[(k + 1) % n] - points[k]).norm());
    }
    let is_closed = starts.is_some();
    let (starts, end) = (starts.unwrap_or(&[0]), lengths[if is_closed { n } else { n - 1 }]);
    let at = |s: f64| {
        let k = lengths.partition_point(|&far| far <= s).clamp(1, n) - 1;
        let piece = (lengths[k + 1] - lengths[k]).max(f64::MIN_POSITIVE);
        points[k].lerp(&points[(k + 1) % n], ((s - lengths[k]) / piece).min(1.0))
    };
    let mut found = Samples { points: Vec::new(), along: Vec::new(), parts: vec![0], is_closed };
    for (i, &start) in starts.iter().enumerate() {
        let from = lengths[start];
        let to = starts.get(i + 1).map_or(lengths[starts[0]] + end, |&next| lengths[next]);
        let count = ((to - from) / spacing).round().max(4.0) as usize;
        for k in 0..count {
            let s = from + (to - from) * k as f64 / count as f64;
            let s = if s >= end { s - end } else { s };
            found.points.push(at(s));
            found.along.push(s);
        }
        found.parts.push(found.points.len());
    }
    if !is_closed {
        found.points.extend(points.last());
        found.along.push(end);
    }
    found
}

/// The smooth curve at the same points: the solution of (I + λ DᵀD) s = p, D the second differences; `reach` is the length, in points, over which noise is
/// averaged: λ is its fourth power.
pub(super) fn smoothed(points: &[Vec2], is_closed: bool, reach: f64) -> Vec<Vec2> {
    let (n, lambda) = (points.len(), reach.powi(4));
    // The points of each second difference.
    let triples = (0..if is_closed { n } else { n.saturating_sub(2) }).map(|k| [k, (k + 1) % n, (k + 2) % n]);
    let entry = |at: [usize; 3], [i, j]: [usize; 2]| Triplet::new(at[i], at[j], lambda * WEIGHTS[i] * WEIGHTS[j]);
    let penalty = triples.clone().flat_map(|at| (0..9).map(move |k| entry(at, [k / 3, k % 3])));
    let entries: Vec<_> = (0..n).map(|k| Triplet::new(k, k, 1.0)).chain(penalty).collect();
    factor_in_one_thread();
    let matrix = SparseColMat::try_new_from_triplets(n, n, &entries).ok();
    let Some(factor) = matrix.and_then(|matrix| matrix.sp_cholesky(Side::Lower).ok()) else { return points.to_vec() };
    let mut smooth = vec![Vec2::zeros(); n];
    // The condition number of the matrix is 16 λ: what is left of the equations is solved for again.
    for _ in 0..SOLUTIONS {
        let mut left: Vec<Vec2> = points.iter().zip(&smooth).map(|(p, s)| p - s).collect();
        for at in triples.clone() {
            let bend: Vec2 = (0..3).map(|i| smooth[at[i]] * WEIGHTS[i]).sum();
            (0..3).for_each(|i| left[at[i]] -= bend * (lambda * WEIGHTS[i]));
        }
        let correction = factor.solve(Mat::from_fn(n, 2, |k, axis| left[k][axis]));
        smooth.iter_mut().enumerate().for_each(|(k, s)| *s += Vec2::new(correction[(k, 0)], correction[(k, 1)]));
    }
    smooth
}

/// The unit tangents of a smooth curve at its points.
pub(super) fn tangents(points: &[Vec2], is_closed: bool) -> Vec<Vec2> {
    let n = points.len();
    let at = |k: isize| {
        if is_closed { points[k.rem_euclid(n as isize) as usize] } else { points[k.clamp(0, n as isize - 1) as usize] }
    };
    (0..n as isize).map(|k| (at(k + 1) - at(k - 1)).try_normalize(0.0).unwrap_or_else(Vec2::x)).collect()
}

/// The points displaced by `by` to the right of the direction of travel: out of the solid.
pub(super) fn moved_out(points: &[Vec2], tangents: &[Vec2], by: f64) -> Vec<Vec2> {
    points.iter().zip(tangents).map(|(p, &t)| p - perpendicular(t) * by).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::curve::unit;

    #[test]
    fn a_straight_line_stays_as_it_is_whatever_the_reach() {
        let line: Vec<Vec2> = (0..50).map(|k| Vec2::new(f64::from(k), 0.3 * f64::from(k))).collect();
        for reach in [1.0, 5.0, 30.0] {
            let smooth = smoothed(&line, false, reach);
            // Rounding grows with the square of the reach where the equations are solved for what is left.
            let error = line.iter().zip(&smooth).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
            assert!(error < 1e-15 * reach.powi(2) * 50.0, "{error:e}");
        }
    }

    #[test]
    fn a_wave_around_a_ring_is_damped_as_the_penalty_says() {
        let count = 400;
        let step = std::f64::consts::TAU / f64::from(count);
        let reach: f64 = 6.0;
        let wave = |k: f64| -> Vec<Vec2> { (0..count).map(|i| unit(step * k * f64::from(i))).collect() };
        for k in [1.0, 5.0, 20.0] {
            let smooth = smoothed(&wave(k), true, reach);
            let expected = 1.0 / (1.0 + (reach * 2.0 * (0.5 * step * k).sin()).powi(4));
            let found = smooth[17].norm();
            assert!((found - expected).abs() < 1e-12, "{k} {found} {expected}");
        }
    }
}
