//! Least-squares circle through points along a curve, with standard errors; a straight line is the circle of curvature 0.
//!
//! The initial guess is Pratt's algebraic fit (Pratt 1987; Newton's iteration for its eigenvalue by Chernov 2010). Then Gauss-Newton minimizes the sum of
//! squared distances in the parameters curvature, direction of the normal and offset (Karimäki 1991), which stay regular as the radius goes to infinity.
//! Standard errors come from the residuals; where neighboring residuals are correlated, the effective number of points is (1 - r)/(1 + r) times their number,
//! with r the lag-one correlation. Points have equal weights; outliers are not rejected.

use nalgebra::{Matrix3, Matrix4, Vector3, Vector4};

use meniscus_core::math::{Vec2, perpendicular};

/// Why a circle could not be fitted.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CircleError {
    /// Three unknowns need at least three points.
    #[error("a circle needs at least 3 points, found {0}")]
    TooFewPoints(usize),
    /// Points that coincide or are not finite.
    #[error("the points do not determine a circle")]
    Degenerate,
}

/// A fitted circle or straight line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CircleFit {
    /// Curvature in 1/m: positive where the points turn to the left in their order.
    pub(crate) curvature: f64,
    /// A point of the circle near the middle of the points, in m.
    pub(crate) at: Vec2,
    /// Unit normal at `at`, on the left of the points in their order; towards the center where `curvature` is positive.
    pub(crate) normal: Vec2,
    /// Root mean square of the distances of the points in m.
    pub rms: f64,
    /// Number of points.
    pub(crate) count: usize,
    /// Covariance of curvature (1/m), turn of the normal (rad) and shift of the point along the normal (m).
    pub(crate) covariance: Matrix3<f64>,
}

impl CircleFit {
    /// Signed distance in m of `x` from the circle, positive on the side of `normal`.
    pub(crate) fn distance(&self, x: Vec2) -> f64 {
        -Parameters::of(self).distance(x - self.at)
    }

    /// Unit normal at `x` (near the circle), on the left of the points in their order.
    pub(crate) fn normal_at(&self, x: Vec2) -> Vec2 {
        let to_center = self.normal - self.curvature * (x - self.at);
        to_center / to_center.norm()
    }

    /// The point of the circle at the arc length `length` (m) from the point nearest to `from`, in the order of the points.
    pub(crate) fn walk(&self, from: Vec2, length: f64) -> Vec2 {
        let normal = self.normal_at(from);
        let start = from - self.distance(from) * normal;
        let tangent = -perpendicular(normal);
        let turn = self.curvature * length;
        // sin(a)/a and (1 - cos(a))/a, regular at zero.
        let sine = if turn.abs() < 1e-4 { 1.0 - turn * turn / 6.0 } else { turn.sin() / turn };
        let versine = if turn.abs() < 1e-4 { 0.5 * turn } else { (1.0 - turn.cos()) / turn };
        start + length * (sine * tangent + versine * normal)
    }

    /// The same circle with its three parameters changed by `change` (1/m, rad, m).
    pub(crate) fn perturbed(&self, change: Vector3<f64>) -> Self {
        let turn = nalgebra::Rotation2::new(change[1]);
        let normal = turn * self.normal;
        Self { curvature: self.curvature + change[0], at: self.at + change[2] * self.normal, normal, ..*self }
    }
}

/// Curvature, direction of the normal and offset along it, in a frame whose origin is near the circle.
#[derive(Debug, Clone, Copy)]
struct Parameters {
    curvature: f64,
    direction: f64,
    offset: f64,
}

impl Parameters {
    fn of(fit: &CircleFit) -> Self {
        Self { curvature: fit.curvature, direction: fit.normal.y.atan2(fit.normal.x), offset: 0.0 }
    }

    fn normal(&self) -> Vec2 {
        Vec2::new(self.direction.cos(), self.direction.sin())
    }

    /// Half the power of the point `y` times the curvature: zero on the circle, positive outside it for positive curvature.
    fn power(&self, y: Vec2) -> f64 {
        let z = y - self.offset * self.normal();
        0.5 * self.curvature * z.norm_squared() - z.dot(&self.normal())
    }

    /// |y - center| times |curvature|, guarded against rounding at the center.
    fn reduced_radius(&self, power: f64) -> f64 {
        (1.0 + 2.0 * self.curvature * power).max(1e-12).sqrt()
    }

    /// Signed distance of `y`, positive away from the center.
    fn distance(&self, y: Vec2) -> f64 {
        let power = self.power(y);
        2.0 * power / (1.0 + self.reduced_radius(power))
    }

    /// Derivatives of the distance with respect to the three parameters.
    fn gradient(&self, y: Vec2) -> Vector3<f64> {
        let (u, power) = (self.normal(), self.power(y));
        let s = self.reduced_radius(power);
        let z = y - self.offset * u;
        let by_curvature = 0.5 * z.norm_squared() / s - 2.0 * power * power / (s * (1.0 + s) * (1.0 + s));
        let by_direction = -(1.0 + self.curvature * self.offset) * y.dot(&perpendicular(u)) / s;
        let by_offset = (1.0 + self.curvature * (self.offset - y.dot(&u))) / s;
        Vector3::new(by_curvature, by_direction, by_offset)
    }

    fn changed(&self, change: &Vector3<f64>) -> Self {
        Self {
            curvature: self.curvature + change[0],
            direction: self.direction + change[1],
            offset: self.offset + change[2],
        }
    }

    fn cost(&self, points: &[Vec2]) -> f64 {
        points.iter().map(|&y| self.distance(y).powi(2)).sum()
    }
}

/// Fits a circle to `points` (m), given in order along the curve \[Chernov2010; Karimaki1991\].
///
/// # Errors
/// If there are fewer than three points, or points that coincide or are not finite.
pub(crate) fn fit(points: &[Vec2]) -> Result<CircleFit, CircleError> {
    if points.len() < 3 {
        return Err(CircleError::TooFewPoints(points.len()));
    }
    let count = points.len() as f64;
    let centroid = points.iter().sum::<Vec2>() / count;
    let scale = (points.iter().map(|p| (p - centroid).norm_squared()).sum::<f64>() / count).sqrt();
    if !(scale.is_finite() && scale > 0.0) {
        return Err(CircleError::Degenerate);
    }
    // The origin is a point of the curve itself, where the normal is defined even for a full circle.
    let nearest = |best: usize, i: usize| {
        if (points[i] - centroid).norm_squared() < (points[best] - centroid).norm_squared() { i } else { best }
    };
    let middle = (0..points.len()).fold(0, nearest);
    let origin = points[middle];
    let reduced: Vec<Vec2> = points.iter().map(|p| (p - origin) / scale).collect();
    let start = pratt(&reduced).ok_or(CircleError::Degenerate)?;
    let chord = reduced[(middle + 1).min(points.len() - 1)] - reduced[middle.saturating_sub(1)];
    let solution = oriented(gauss_newton(start, &reduced), chord);
    let covariance = covariance(&solution, &reduced).ok_or(CircleError::Degenerate)?;
    let units = Matrix3::from_diagonal(&Vector3::new(1.0 / scale, 1.0, scale));
    Ok(CircleFit {
        curvature: solution.curvature / scale,
        at: origin + scale * solution.offset * solution.normal(),
        normal: solution.normal(),
        rms: scale * (solution.cost(&reduced) / count).sqrt(),
        count: points.len(),
        covariance: units * covariance * units,
    })
}

/// The same circle with the normal on the left of the direction `chord`.
fn oriented(p: Parameters, chord: Vec2) -> Parameters {
    if p.normal().dot(&perpendicular(chord)) >= 0.0 {
        return p;
    }
    Parameters { curvature: -p.curvature, direction: p.direction + std::f64::consts::PI, offset: -p.offset }
}

/// Pratt's algebraic fit \[Pratt1987\], `None` if the points coincide. Least squares of a |y|² + b.y + c with |b|² - 4 a c = 1.
fn pratt(points: &[Vec2]) -> Option<Parameters> {
    let count = points.len() as f64;
    let center = points.iter().sum::<Vec2>() / count;
    let mut moments = Matrix4::<f64>::zeros();
    for y in points {
        let z = y - center;
        let row = Vector4::new(z.norm_squared(), z.x, z.y, 1.0);
        moments += row * row.transpose() / count;
    }
    let constraint = Matrix4::new(0.0, 0.0, 0.0, -2.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -2.0, 0.0, 0.0, 0.0);
    let eigen = (moments - pratt_eigenvalue(&moments) * constraint).symmetric_eigen();
    let (least, _) = eigen.eigenvalues.map(f64::abs).argmin();
    let v: Vector4<f64> = eigen.eigenvectors.column(least).into_owned();
    let norm = v[1] * v[1] + v[2] * v[2] - 4.0 * v[0] * v[3];
    if !(norm.is_finite() && norm > 0.0) {
        return None;
    }
    let v = v / norm.sqrt();
    // From the centroid's frame to the frame of the points.
    let linear = Vec2::new(v[1], v[2]) - 2.0 * v[0] * center;
    let constant = v[0] * center.norm_squared() - v[1] * center.x - v[2] * center.y + v[3];
    let slope = linear.norm();
    let (direction, offset) = ((-linear.y).atan2(-linear.x), 2.0 * constant / (slope + 1.0));
    Some(Parameters { curvature: 2.0 * v[0], direction, offset })
}

/// Smallest non-negative eigenvalue of Pratt's problem, from the moments about the centroid.
fn pratt_eigenvalue(m: &Matrix4<f64>) -> f64 {
    let (zz, xz, yz, xx, xy, yy) = (m[(0, 0)], m[(0, 1)], m[(0, 2)], m[(1, 1)], m[(1, 2)], m[(2, 2)]);
    let z = xx + yy;
    let covariance = xx * yy - xy * xy;
    let a2 = 4.0 * covariance - 3.0 * z * z - zz;
    let a1 = zz * z + 4.0 * covariance * z - xz * xz - yz * yz - z * z * z;
    let a0 = xz * xz * yy + yz * yz * xx - zz * covariance - 2.0 * xz * yz * xy + z * z * covariance;
    let mut x = 0.0;
    // Newton from 0 approaches the root monotonically; a hundred steps are far more than it ever needs.
    for _ in 0..100 {
        let value = a0 + x * (a1 + x * (a2 + 4.0 * x * x));
        let slope = a1 + x * (2.0 * a2 + 16.0 * x * x);
        let next = x - value / slope;
        if !next.is_finite() || next < 0.0 || (next - x).abs() <= 1e-14 * z {
            break;
        }
        x = next;
    }
    x
}

fn gauss_newton(start: Parameters, points: &[Vec2]) -> Parameters {
    let mut best = start;
    let mut cost = best.cost(points);
    // Levenberg-Marquardt damping: exact data need none, noisy short arcs a little.
    let mut damping = 1e-9;
    for _ in 0..60 {
        let (normal, right) = normal_equations(&best, points);
        let damped = normal + damping * Matrix3::from_diagonal(&normal.diagonal());
        let Some(change) = damped.lu().solve(&right) else { break };
        let next = best.changed(&change);
        let next_cost = next.cost(points);
        if next_cost.is_finite() && next_cost <= cost {
            let settled = change.norm() < 1e-13 || cost - next_cost <= 1e-15 * cost;
            (best, cost) = (next, next_cost);
            damping *= 0.1;
            if settled {
                break;
            }
        } else {
            damping = (damping * 10.0).max(1e-9);
            if damping > 1e6 {
                break;
            }
        }
    }
    best
}

/// JᵀJ of the Jacobian and the right-hand side of a Gauss-Newton step.
fn normal_equations(p: &Parameters, points: &[Vec2]) -> (Matrix3<f64>, Vector3<f64>) {
    points.iter().fold((Matrix3::zeros(), Vector3::zeros()), |(normal, right), &y| {
        let g = p.gradient(y);
        (normal + g * g.transpose(), right - g * p.distance(y))
    })
}

fn covariance(p: &Parameters, points: &[Vec2]) -> Option<Matrix3<f64>> {
    let inverse = normal_equations(p, points).0.try_inverse()?;
    let residuals: Vec<f64> = points.iter().map(|&y| p.distance(y)).collect();
    Some(inverse * variance_of(&residuals))
}

/// Effective variance of the residuals of a fit with three unknowns, in order along a curve, corrected for their correlation.
pub(super) fn variance_of(residuals: &[f64]) -> f64 {
    let sum: f64 = residuals.iter().map(|r| r * r).sum();
    let lagged: f64 = residuals.windows(2).map(|w| w[0] * w[1]).sum();
    // Neighboring residuals of a smoothed field are correlated; the bound 0.9 keeps the error bar finite.
    let correlation = if sum > 0.0 { (lagged / sum).clamp(0.0, 0.9) } else { 0.0 };
    // Three points leave no degree of freedom; one avoids a division by zero.
    let freedom = (residuals.len() as f64 - 3.0).max(1.0);
    sum / freedom * (1.0 + correlation) / (1.0 - correlation)
}

/// Reference quantities for tests.
#[cfg(test)]
impl CircleFit {
    /// Center in m, which is not finite for a straight line.
    pub(crate) fn center(&self) -> Vec2 {
        self.at + self.normal / self.curvature
    }

    /// Standard error of the curvature in 1/m.
    pub(crate) fn curvature_error(&self) -> f64 {
        self.covariance[(0, 0)].max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(center: Vec2, radius: f64, from: f64, to: f64, count: usize) -> Vec<Vec2> {
        (0..count)
            .map(|i| {
                let a = from + (to - from) * i as f64 / (count - 1) as f64;
                center + radius * Vec2::new(a.cos(), a.sin())
            })
            .collect()
    }

    /// Uncorrelated numbers spread evenly over [-1, 1].
    fn noise(i: usize) -> f64 {
        let x = (i as f64 * 12.9898 + 4.1414).sin() * 43_758.545_3;
        2.0 * (x - x.floor()) - 1.0
    }

    /// [Chernov2010; Karimaki1991]
    #[test]
    fn exact_arcs_of_any_extent_are_recovered() {
        let center = Vec2::new(3.0e-4, -2.0e-4);
        for extent in [0.05, 0.5, 2.0, 6.0] {
            let fit = fit(&arc(center, 2.0e-4, 0.3, 0.3 + extent, 25)).expect("a circle");
            let allowed = 1e-9 / extent.powi(2);
            assert!((fit.curvature * 2.0e-4 - 1.0).abs() < allowed, "extent {extent}: {}", fit.curvature);
            assert!((fit.center() - center).norm() < 2.0e-4 * allowed * 10.0, "extent {extent}");
        }
    }

    #[test]
    fn a_clockwise_arc_has_negative_curvature() {
        let fit = fit(&arc(Vec2::zeros(), 2.0, 1.0, -0.5, 12)).expect("a circle");
        assert!((fit.curvature + 0.5).abs() < 1e-9);
        assert!(fit.center().norm() < 1e-8);
    }

    #[test]
    fn a_straight_line_has_curvature_zero_and_finite_errors() {
        let points: Vec<Vec2> = (0..20).map(|i| Vec2::new(0.1 * f64::from(i), 1.0 - 0.05 * f64::from(i))).collect();
        let fit = fit(&points).expect("a line");
        assert!(fit.curvature.abs() < 1e-10, "curvature {}", fit.curvature);
        assert!(fit.normal.dot(&(points[1] - points[0])).abs() < 1e-12);
        assert!(fit.curvature_error().is_finite());
    }

    /// [Karimaki1991]
    #[test]
    fn scatter_of_noisy_arcs_agrees_with_the_standard_error() {
        let (mut off, mut claimed) = (0.0, 0.0);
        let trials = 200;
        for trial in 0..trials {
            let clean = arc(Vec2::zeros(), 1.0, 0.0, 1.5, 40);
            let points: Vec<Vec2> =
                clean.iter().enumerate().map(|(i, p)| p * (1.0 + 0.01 * noise(97 * trial + i))).collect();
            let fit = fit(&points).expect("a circle");
            off += (fit.curvature - 1.0).powi(2);
            claimed += fit.curvature_error().powi(2);
        }
        let ratio = (off / claimed).sqrt();
        // 200 samples scatter by 5 %; the correction for correlated neighbors widens the estimate a little.
        assert!((0.7..1.2).contains(&ratio), "scatter over claimed error {ratio}");
    }

    #[test]
    fn walking_along_the_circle_stays_on_it() {
        let fit = fit(&arc(Vec2::new(1.0, 1.0), 0.5, 0.0, 2.0, 20)).expect("a circle");
        let from = Vec2::new(1.5, 1.0);
        let quarter = fit.walk(from, 0.5 * std::f64::consts::FRAC_PI_2);
        assert!((quarter - Vec2::new(1.0, 1.5)).norm() < 1e-9, "{quarter:?}");
        assert!((fit.distance(Vec2::new(1.0, 1.1)) - 0.4).abs() < 1e-9);
    }

    #[test]
    fn points_that_coincide_are_refused() {
        assert_eq!(fit(&[Vec2::zeros(); 5]), Err(CircleError::Degenerate));
        assert_eq!(fit(&[Vec2::zeros(); 2]), Err(CircleError::TooFewPoints(2)));
    }
}
