//! Smooth curves through noisy points: minimum of the sum of squared distances plus λ times that of squared second differences (Whittaker 1923), along a line
//! or around a ring.

use crate::math::{Vec2, perpendicular};

/// Number of decay lengths of a weight beyond the seam of a ring: e^(−16/√2) = 1e-5 of the noise of a pixel.
const SEAM: f64 = 16.0;

/// Equidistant points with a distance of about `spacing` along a polygon; first and last point of an open one are kept.
pub(super) fn resampled(points: &[Vec2], is_closed: bool, spacing: f64) -> Vec<Vec2> {
    let mut line = points.to_vec();
    if is_closed {
        line.extend(points.first());
    }
    let length: f64 = line.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let count = (length / spacing).round().max(4.0);
    let step = length / count;
    let mut found = Vec::with_capacity(count as usize + 1);
    let mut travelled = 0.0;
    for w in line.windows(2) {
        let piece = (w[1] - w[0]).norm();
        while (found.len() as f64) * step <= travelled + piece && found.len() < count as usize && piece > 0.0 {
            found.push(w[0].lerp(&w[1], (found.len() as f64 * step - travelled) / piece));
        }
        travelled += piece;
    }
    if !is_closed {
        found.extend(line.last());
    }
    found
}

/// The smooth curve at the same points; `reach` is the length, in points, over which noise is averaged: λ is its fourth power.
pub(super) fn smoothed(points: &[Vec2], is_closed: bool, reach: f64) -> Vec<Vec2> {
    let lambda = reach.powi(4);
    if !is_closed {
        return whittaker(points, lambda);
    }
    let (count, seam) = (points.len(), (SEAM * reach).ceil() as usize + 2);
    let around: Vec<Vec2> = (0..count + 2 * seam).map(|k| points[(k + count * seam - seam) % count]).collect();
    whittaker(&around, lambda)[seam..seam + count].to_vec()
}

/// Solves (I + λ DᵀD) s = p, D the second differences, by the L D Lᵀ factorization of the band matrix.
fn whittaker(points: &[Vec2], lambda: f64) -> Vec<Vec2> {
    let n = points.len();
    if n < 3 {
        return points.to_vec();
    }
    // Row i of DᵀD, from its definition: each second difference i-1, i, i+1 adds 1, -2, 1.
    let has = |k: usize| f64::from(u8::from(k >= 1 && k + 1 < n));
    let diagonal = |i: usize| {
        let before = if i >= 1 { has(i - 1) } else { 0.0 };
        1.0 + lambda * (before + 4.0 * has(i) + has(i + 1))
    };
    let first = |i: usize| -2.0 * lambda * (has(i) + has(i + 1));
    let second = |i: usize| lambda * has(i + 1);
    let (mut d, mut e, mut f) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let mut z = points.to_vec();
    for i in 0..n {
        let (d1, e1) = if i >= 1 { (d[i - 1], e[i - 1]) } else { (0.0, 0.0) };
        let (d2, f2) = if i >= 2 { (d[i - 2], f[i - 2]) } else { (0.0, 0.0) };
        d[i] = diagonal(i) - d1 * e1 * e1 - d2 * f2 * f2;
        let f1 = if i >= 1 { f[i - 1] } else { 0.0 };
        e[i] = if i + 1 < n { (first(i) - d1 * e1 * f1) / d[i] } else { 0.0 };
        f[i] = if i + 2 < n { second(i) / d[i] } else { 0.0 };
        if i >= 1 {
            let by = z[i - 1] * e1;
            z[i] -= by;
        }
        if i >= 2 {
            let by = z[i - 2] * f2;
            z[i] -= by;
        }
    }
    for i in (0..n).rev() {
        z[i] /= d[i];
        if i + 1 < n {
            let by = z[i + 1] * e[i];
            z[i] -= by;
        }
        if i + 2 < n {
            let by = z[i + 2] * f[i];
            z[i] -= by;
        }
    }
    z
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
    use crate::geometry::curve::unit;

    #[test]
    fn a_straight_line_stays_as_it_is_whatever_the_reach() {
        let line: Vec<Vec2> = (0..50).map(|k| Vec2::new(f64::from(k), 0.3 * f64::from(k))).collect();
        for reach in [1.0, 5.0, 30.0] {
            let smooth = smoothed(&line, false, reach);
            // Rounding grows with the condition number of the band matrix, 16 times the fourth power of the reach.
            let error = line.iter().zip(&smooth).map(|(p, q)| (p - q).norm()).fold(0.0, f64::max);
            assert!(error < 1e-15 * 16.0 * reach.powi(4) * 50.0 + 1e-12, "{error:e}");
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
            // The seam adds e^(-16/√2).
            assert!((found - expected).abs() < 2e-5, "{k} {found} {expected}");
        }
    }
}
