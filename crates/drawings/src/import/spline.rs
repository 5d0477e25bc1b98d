//! B-spline curves, including rational ones (NURBS), and the interpolating cubic spline.
//!
//! Source: Piegl and Tiller, The NURBS Book, 2nd ed., Springer 1997: algorithms A3.1, A4.1 by de Boor's triangle.

use super::affine::Affine;
use super::biarc::SmoothCurve;
use meniscus_core::math::{Bounds, Vec2};

/// The highest degree; programs write 3 and rarely 5.
pub(crate) const HIGHEST_DEGREE: usize = 11;

/// A rational B-spline curve.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BSpline {
    degree: usize,
    knots: Vec<f64>,
    /// The control points.
    pub(crate) points: Vec<Vec2>,
    weights: Vec<f64>,
}

impl BSpline {
    /// A checked curve: matching number of knots, in non-decreasing order, weights above 0. Without weights: all are 1.
    pub(crate) fn new(degree: usize, knots: Vec<f64>, points: Vec<Vec2>, weights: Vec<f64>) -> Result<Self, String> {
        if degree == 0 || degree > HIGHEST_DEGREE {
            return Err(format!("degree {degree}"));
        }
        if points.len() <= degree {
            return Err(format!("{} control points for degree {degree}", points.len()));
        }
        if knots.len() != points.len() + degree + 1 {
            return Err(format!("{} knots for {} control points and degree {degree}", knots.len(), points.len()));
        }
        if knots.iter().any(|knot| !knot.is_finite()) || knots.windows(2).any(|pair| pair[1] < pair[0]) {
            return Err("knots that fall".to_owned());
        }
        if !(knots[degree] < knots[points.len()]) {
            return Err("knots that are all the same".to_owned());
        }
        let weights = if weights.is_empty() { vec![1.0; points.len()] } else { weights };
        if weights.len() != points.len() {
            return Err(format!("{} weights for {} control points", weights.len(), points.len()));
        }
        if let Some(weight) = weights.iter().find(|weight| !(**weight > 0.0 && weight.is_finite())) {
            return Err(format!("weight {weight}"));
        }
        Ok(Self { degree, knots, points, weights })
    }

    /// The intervals of the parameter on which the curve is smooth.
    pub(crate) fn spans(&self) -> Vec<[f64; 2]> {
        let inner = &self.knots[self.degree..=self.points.len()];
        inner.windows(2).filter(|pair| pair[0] < pair[1]).map(|pair| [pair[0], pair[1]]).collect()
    }

    /// The image under an affine map, by those of the control points, also for rational curves.
    pub(crate) fn mapped(&self, map: &Affine) -> Self {
        Self { points: self.points.iter().map(|&point| map.apply(point)).collect(), ..self.clone() }
    }

    /// The same points in reverse order.
    pub(crate) fn reversed(&self) -> Self {
        Self {
            degree: self.degree,
            knots: self.knots.iter().rev().map(|knot| -knot).collect(),
            points: self.points.iter().rev().copied().collect(),
            weights: self.weights.iter().rev().copied().collect(),
        }
    }

    /// Width and height of the box around the control points.
    pub(crate) fn extent(&self) -> f64 {
        Bounds::around(self.points.iter().copied()).map_or(0.0, |bounds| bounds.size().norm())
    }

    /// The last span whose knots enclose `t`; at an inner knot the one on the given side.
    fn span(&self, t: f64, side: f64) -> usize {
        let (low, high) = (self.degree, self.points.len() - 1);
        let holds = |knot: f64| if side < 0.0 { knot < t } else { knot <= t };
        let after = self.knots[low + 1..=high].partition_point(|&knot| holds(knot));
        low + after
    }

    /// Point and derivative at `t`.
    fn evaluate(&self, t: f64, side: f64) -> (Vec2, Vec2) {
        let (p, k) = (self.degree, self.span(t, side));
        // Homogeneous control points, relative to the first one so that distant coordinates lose no digits.
        let origin = self.points[k - p];
        let mut triangle = [[0.0; 3]; HIGHEST_DEGREE + 1];
        for (j, entry) in triangle[..=p].iter_mut().enumerate() {
            let (point, weight) = (self.points[k - p + j] - origin, self.weights[k - p + j]);
            *entry = [point.x * weight, point.y * weight, weight];
        }
        let mut slope = [0.0; 3];
        for level in 1..=p {
            if level == p {
                let width = self.knots[k + 1] - self.knots[k];
                slope = std::array::from_fn(|i| p as f64 * (triangle[p][i] - triangle[p - 1][i]) / width);
            }
            for j in (level..=p).rev() {
                let (left, right) = (self.knots[k - p + j], self.knots[k + 1 + j - level]);
                let share = (t - left) / (right - left);
                triangle[j] = std::array::from_fn(|i| (1.0 - share) * triangle[j - 1][i] + share * triangle[j][i]);
            }
        }
        let [x, y, weight] = triangle[p];
        let point = Vec2::new(x, y) / weight;
        let derivative = (Vec2::new(slope[0], slope[1]) - point * slope[2]) / weight;
        (point + origin, derivative)
    }
}

impl SmoothCurve for BSpline {
    fn point(&self, t: f64) -> Vec2 {
        self.evaluate(t, 1.0).0
    }

    fn tangent(&self, t: f64, side: f64) -> Vec2 {
        self.evaluate(t, side).1.try_normalize(0.0).unwrap_or_else(Vec2::zeros)
    }
}

/// The cubic spline through `points` in order as Bezier pieces, twice differentiable, with the parameter proportional to the chord length. Ends have the
/// given directions, or zero curvature by default; a closed one is periodic.
pub(crate) fn through_points(points: &[Vec2], is_closed: bool, directions: [Option<Vec2>; 2]) -> Vec<[Vec2; 4]> {
    let mut points = points.to_vec();
    points.dedup();
    if is_closed && points.len() > 2 && points.first() != points.last() {
        points.push(points[0]);
    }
    let n = points.len();
    if n < 2 {
        return Vec::new();
    }
    let is_closed = is_closed && n > 3;
    let widths: Vec<f64> = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    let slopes: Vec<Vec2> = points.windows(2).zip(&widths).map(|(pair, width)| (pair[1] - pair[0]) / *width).collect();
    // Unknown: the derivatives at the points. Row i: [before, here, after] and its right-hand side.
    let inner = |before: usize, after: usize| {
        let (h0, h1) = (widths[before], widths[after]);
        ([h1, 2.0 * (h0 + h1), h0], (slopes[before] * h1 + slopes[after] * h0) * 3.0)
    };
    let end = |direction: Option<Vec2>, slope: Vec2| match direction {
        Some(direction) => (1.0, 0.0, direction),
        None => (2.0, 1.0, slope * 3.0),
    };
    let derivatives = if is_closed {
        let rows: Vec<_> = (0..n - 1).map(|i| inner((i + n - 2) % (n - 1), i)).collect();
        let mut derivatives = solve_cyclic(&rows);
        derivatives.push(derivatives[0]);
        derivatives
    } else {
        let mut rows: Vec<_> = (1..n - 1).map(|i| inner(i - 1, i)).collect();
        let (here, after, right) = end(directions[0], slopes[0]);
        rows.insert(0, ([0.0, here, after], right));
        let (here, before, right) = end(directions[1], slopes[n - 2]);
        rows.push(([before, here, 0.0], right));
        solve(&rows)
    };
    let piece = |i: usize| {
        let third = widths[i] / 3.0;
        let (a, b) = (points[i], points[i + 1]);
        [a, a + derivatives[i] * third, b - derivatives[i + 1] * third, b]
    };
    (0..n - 1).map(piece).collect()
}

type Row = ([f64; 3], Vec2);

/// Thomas algorithm.
fn solve(rows: &[Row]) -> Vec<Vec2> {
    let mut after = Vec::with_capacity(rows.len());
    let mut solution: Vec<Vec2> = Vec::with_capacity(rows.len());
    for (i, &([before, here, next], right)) in rows.iter().enumerate() {
        let (c, x) = if i == 0 { (0.0, Vec2::zeros()) } else { (after[i - 1], solution[i - 1]) };
        let pivot = here - before * c;
        after.push(next / pivot);
        solution.push((right - x * before) / pivot);
    }
    for i in (0..rows.len().saturating_sub(1)).rev() {
        let next = solution[i + 1];
        solution[i] -= next * after[i];
    }
    solution
}

/// The same for cyclic tridiagonal systems, by the Sherman-Morrison formula.
fn solve_cyclic(rows: &[Row]) -> Vec<Vec2> {
    let n = rows.len();
    let (corner_first, corner_last) = (rows[0].0[0], rows[n - 1].0[2]);
    let gamma = -rows[0].0[1];
    let mut open = rows.to_vec();
    open[0].0[1] -= gamma;
    open[n - 1].0[1] -= corner_first * corner_last / gamma;
    let mut unit = open.clone();
    for (i, row) in unit.iter_mut().enumerate() {
        let entry = if i == 0 {
            gamma
        } else if i == n - 1 {
            corner_last
        } else {
            0.0
        };
        row.1 = Vec2::new(entry, 0.0);
    }
    let (y, z) = (solve(&open), solve(&unit));
    let ratio = corner_first / gamma;
    let share = (y[0] + y[n - 1] * ratio) / (1.0 + z[0].x + ratio * z[n - 1].x);
    y.iter().zip(&z).map(|(y, z)| y - share * z.x).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::curve::unit;
    use std::f64::consts::{FRAC_1_SQRT_2, TAU};

    /// A quarter of the unit circle as a rational quadratic curve.
    fn quarter() -> BSpline {
        let points = vec![Vec2::x(), Vec2::new(1.0, 1.0), Vec2::y()];
        BSpline::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], points, vec![1.0, FRAC_1_SQRT_2, 1.0]).unwrap()
    }

    #[test]
    fn a_rational_quarter_lies_on_the_circle_and_its_tangent_along_it() {
        for curve in [quarter(), quarter().reversed()] {
            let [from, to] = curve.spans()[0];
            for k in 0..=10 {
                let t = from + (to - from) * f64::from(k) / 10.0;
                assert!((curve.point(t).norm() - 1.0).abs() < 1e-15);
                assert!(curve.tangent(t, 1.0).dot(&curve.point(t)).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_spline_with_inner_knots_equals_the_sum_over_its_basis() {
        // Third degree over 0, 1, 2, 3, unequal knots; compared with the Cox-de Boor recursion.
        let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.5, 3.0, 3.0, 3.0, 3.0];
        let points: Vec<Vec2> = (0..6).map(|i| Vec2::new(f64::from(i), f64::from(i * i % 5))).collect();
        let curve = BSpline::new(3, knots.clone(), points.clone(), Vec::new()).unwrap();
        fn basis(knots: &[f64], i: usize, p: usize, t: f64) -> f64 {
            if p == 0 {
                return f64::from(u8::from(knots[i] <= t && t < knots[i + 1]));
            }
            let part = |over: f64, under: f64| if under == 0.0 { 0.0 } else { over / under };
            part(t - knots[i], knots[i + p] - knots[i]) * basis(knots, i, p - 1, t)
                + part(knots[i + p + 1] - t, knots[i + p + 1] - knots[i + 1]) * basis(knots, i + 1, p - 1, t)
        }
        for t in [0.0, 0.3, 1.0, 1.2, 1.5, 2.9] {
            let expected = (0..6).fold(Vec2::zeros(), |sum, i| sum + points[i] * basis(&knots, i, 3, t));
            assert!((curve.point(t) - expected).norm() < 1e-14, "{t}");
            let secant = (curve.point(t + 1e-6) - curve.point(t)).normalize();
            assert!((curve.tangent(t, 1.0) - secant).norm() < 1e-4);
        }
        assert_eq!(curve.spans(), [[0.0, 1.0], [1.0, 1.5], [1.5, 3.0]]);
    }

    #[test]
    fn the_closed_spline_through_points_of_a_circle_is_nearly_the_circle() {
        let points: Vec<Vec2> = (0..16).map(|k| unit(TAU * f64::from(k) / 16.0)).collect();
        let pieces = through_points(&points, true, [None, None]);
        assert_eq!(pieces.len(), 16);
        for [a, b, c, d] in pieces {
            let middle = (a + (b + c) * 3.0 + d) / 8.0;
            // The error of a cubic spline scales as the fourth power of the angle: (2π/16)⁴/384 = 6e-5.
            assert!((middle.norm() - 1.0).abs() < 1e-4);
            assert!((b - a).dot(&a).abs() < 1e-12, "tangents are those of the circle by symmetry");
        }
    }

    #[test]
    fn a_spline_with_given_ends_begins_and_ends_as_told() {
        let points = [Vec2::zeros(), Vec2::new(1.0, 1.0), Vec2::new(3.0, 0.0)];
        let pieces = through_points(&points, false, [Some(Vec2::y()), Some(-Vec2::y())]);
        assert!((pieces[0][1] - pieces[0][0]).normalize().metric_distance(&Vec2::y()) < 1e-14);
        assert!((pieces[1][3] - pieces[1][2]).normalize().metric_distance(&-Vec2::y()) < 1e-14);
        // Twice differentiable: a - 2 b + c over the squared width agrees at the joint.
        let bend = |[a, b, c]: [Vec2; 3], width: f64| (a - b * 2.0 + c) / (width * width);
        let (h0, h1) = (2f64.sqrt(), 5f64.sqrt());
        let before = bend([pieces[0][1], pieces[0][2], pieces[0][3]], h0);
        assert!((before - bend([pieces[1][0], pieces[1][1], pieces[1][2]], h1)).norm() < 1e-14);
    }

    #[test]
    fn what_is_no_spline_is_told_apart() {
        let points = || vec![Vec2::zeros(), Vec2::x(), Vec2::y()];
        let message = |degree, knots: &[f64], weights: &[f64]| {
            BSpline::new(degree, knots.to_vec(), points(), weights.to_vec()).unwrap_err()
        };
        assert_eq!(message(0, &[], &[]), "degree 0");
        assert_eq!(message(3, &[0.0; 7], &[]), "3 control points for degree 3");
        assert_eq!(message(2, &[0.0, 1.0], &[]), "2 knots for 3 control points and degree 2");
        assert_eq!(message(2, &[0.0, 0.0, 0.0, 1.0, f64::NAN, 1.0], &[]), "knots that fall");
        assert_eq!(message(2, &[1.0; 6], &[]), "knots that are all the same");
        assert_eq!(message(2, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &[1.0, 0.0, 1.0]), "weight 0");
    }
}
