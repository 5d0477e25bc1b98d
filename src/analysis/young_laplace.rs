//! Menisci under gravity: the Young-Laplace equation of the plane, solved by Runge-Kutta steps from the apex.
//!
//! With the arc length s, the inclination phi and the depth z below the apex: dx/ds = cos phi, dz/ds = sin phi,
//! dphi/ds = kappa_0 + z/l_c², where l_c² = sigma/(d_rho g). The unknown apex curvature kappa_0 follows from the area of a
//! sessile drop or from the distance of two plates by bisection, or from points of a contour by least squares.

use nalgebra::{Matrix3, Vector3};

use super::roots::bisect;
use crate::math::{Vec2, perpendicular};

/// A point of a meniscus under gravity, the apex at the origin and z downward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePoint {
    /// Horizontal distance from the apex in m.
    pub x: f64,
    /// Depth below the apex in m.
    pub z: f64,
    /// Inclination in rad.
    pub inclination: f64,
    /// Area in m² between the apex and here, on one side.
    pub area: f64,
}

/// Steps turn by no more than this (rad), and are no longer than this part of the capillary length: the error of the
/// fourth-order rule is then below 1e-8 of the sizes.
const LARGEST_TURN: f64 = 0.01;
/// Steps after which a profile that has not reached its inclination is given up.
const MOST_STEPS: usize = 200_000;

/// The profile from the apex to the inclination `last` (rad).
///
/// `apex_curvature` in 1/m, above 0; `capillary_length` in m. Empty where the inclination is not reached.
#[must_use]
pub fn profile(apex_curvature: f64, capillary_length: f64, last: f64) -> Vec<ProfilePoint> {
    let stiffness = capillary_length.powi(-2);
    // State: x, z, inclination and the area, of which x dz is added.
    let slope = |[x, z, phi, _]: [f64; 4]| [phi.cos(), phi.sin(), apex_curvature + stiffness * z, x * phi.sin()];
    let add = |y: [f64; 4], k: [f64; 4], by: f64| [0, 1, 2, 3].map(|i| y[i] + by * k[i]);
    let step = |y: [f64; 4], ds: f64| {
        let k1 = slope(y);
        let k2 = slope(add(y, k1, 0.5 * ds));
        let k3 = slope(add(y, k2, 0.5 * ds));
        let k4 = slope(add(y, k3, ds));
        [0, 1, 2, 3].map(|i| y[i] + ds / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
    };
    let point = |y: [f64; 4]| ProfilePoint { x: y[0], z: y[1], inclination: y[2], area: y[3] };
    let mut y = [0.0; 4];
    let mut points = vec![point(y)];
    for _ in 0..MOST_STEPS {
        let turn = apex_curvature + stiffness * y[1];
        let ds = (LARGEST_TURN / turn).min(capillary_length * LARGEST_TURN);
        let next = step(y, ds);
        if next[2] >= last {
            // The last step ends where the inclination is reached.
            let Some(part) = bisect(|part| step(y, part)[2] - last, 0.0, ds) else { return Vec::new() };
            points.push(point(step(y, part)));
            return points;
        }
        y = next;
        points.push(point(y));
    }
    Vec::new()
}

/// A drop on a flat floor under gravity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SessileDrop {
    /// Length of the wetted floor in m.
    pub base: f64,
    /// Height in m.
    pub height: f64,
    /// Curvature at the apex in 1/m.
    pub apex_curvature: f64,
}

/// The drop that ends at the contact angle, with its area in m².
fn drop_from(apex_curvature: f64, capillary_length: f64, angle: f64) -> Option<(SessileDrop, f64)> {
    let points = profile(apex_curvature, capillary_length, angle);
    let end = points.last().filter(|_| points.len() > 1)?;
    Some((SessileDrop { base: 2.0 * end.x, height: end.z, apex_curvature }, 2.0 * end.area))
}

/// The drop of `area` (m²) with the contact `angle` (rad) under gravity of the `capillary_length` (m).
#[must_use]
pub fn sessile_drop(area: f64, capillary_length: f64, angle: f64) -> Option<SessileDrop> {
    // Without gravity the cap's curvature; gravity flattens the apex, for puddles by many orders of magnitude.
    let cap = ((angle - angle.sin() * angle.cos()) / area).sqrt();
    let excess = |logarithm: f64| {
        drop_from(cap * logarithm.exp(), capillary_length, angle).map_or(f64::NAN, |(_, found)| found - area)
    };
    let logarithm = bisect(excess, -40.0, 1.0)?;
    drop_from(cap * logarithm.exp(), capillary_length, angle).map(|(drop, _)| drop)
}

/// Height in m of the lowest point of the meniscus between plates `width` (m) apart over the level outside.
#[must_use]
pub fn rise_between_plates(width: f64, capillary_length: f64, angle: f64) -> Option<f64> {
    let last = std::f64::consts::FRAC_PI_2 - angle;
    let circular = 2.0 * angle.cos() / width;
    let off = |logarithm: f64| {
        let points = profile(circular * logarithm.exp(), capillary_length, last);
        points.last().map_or(f64::NAN, |end| end.x - 0.5 * width)
    };
    let logarithm = bisect(off, -30.0, 1.0)?;
    Some(capillary_length.powi(2) * circular * logarithm.exp())
}

/// A sessile drop fitted to points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SessileFit {
    /// Apex in m.
    pub apex: Vec2,
    /// Curvature at the apex in 1/m.
    pub apex_curvature: f64,
    /// Unit vector of gravity.
    pub down: Vec2,
    /// Capillary length in m.
    pub capillary_length: f64,
    /// Root mean square distance of the points in m.
    pub rms: f64,
    covariance: Matrix3<f64>,
}

impl SessileFit {
    /// Contact angle in degrees with its standard error on a level floor that lies at `depth` (m) below the origin along
    /// gravity; nothing where the profile does not come down to it.
    #[must_use]
    pub fn angle_at(&self, depth: f64) -> Option<[f64; 2]> {
        let angle = |curvature: f64, apex_depth: f64| {
            let points = profile(curvature, self.capillary_length, std::f64::consts::PI);
            let below = depth - apex_depth;
            let k = points.iter().position(|p| p.z >= below)?;
            let (a, b) = (points.get(k.checked_sub(1)?)?, points.get(k)?);
            Some((a.inclination + (b.inclination - a.inclination) * (below - a.z) / (b.z - a.z)).to_degrees())
        };
        let apex_depth = self.apex.dot(&self.down);
        let value = angle(self.apex_curvature, apex_depth)?;
        let steps = [1e-5 * self.apex_curvature, 1e-5 / self.apex_curvature];
        let slope = [
            (angle(self.apex_curvature + steps[0], apex_depth)? - value) / steps[0],
            (angle(self.apex_curvature, apex_depth + steps[1])? - value) / steps[1],
        ];
        let c = &self.covariance;
        let variance =
            slope[0].powi(2) * c[(0, 0)] + slope[1].powi(2) * c[(2, 2)] + 2.0 * slope[0] * slope[1] * c[(0, 2)];
        Some([value, variance.max(0.0).sqrt()])
    }
}

impl SessileFit {
    /// Length in m of the wetted part of a level floor at `depth` (m) below the origin along gravity; nothing where the profile
    /// does not come down to it.
    #[must_use]
    pub fn base_at(&self, depth: f64) -> Option<f64> {
        let points = profile(self.apex_curvature, self.capillary_length, std::f64::consts::PI);
        let below = depth - self.apex.dot(&self.down);
        let k = points.iter().position(|p| p.z >= below)?;
        let (a, b) = (points.get(k.checked_sub(1)?)?, points.get(k)?);
        Some(2.0 * (a.x + (b.x - a.x) * (below - a.z) / (b.z - a.z)))
    }
}

/// Fits a symmetric sessile drop to `points` (m) of its contour, by Gauss-Newton for apex curvature and place of the apex.
///
/// `down` is the unit vector of gravity, `capillary_length` in m. Nothing where there are fewer than six points or the
/// iteration fails.
#[must_use]
pub fn fit_sessile_drop(points: &[Vec2], down: Vec2, capillary_length: f64) -> Option<SessileFit> {
    // Twice the unknowns, as for circles.
    if points.len() < 6 {
        return None;
    }
    let level = perpendicular(down);
    let local: Vec<Vec2> = points.iter().map(|p| Vec2::new(p.dot(&level), p.dot(&down))).collect();
    let circle = super::circle::fit(points).ok()?;
    let center = Vec2::new(circle.center().dot(&level), circle.center().dot(&down));
    let mut p = Vector3::new(circle.curvature.abs(), center.x, center.y - circle.radius());
    let scale = Vector3::new(p[0], circle.radius(), circle.radius());
    let residuals = |p: &Vector3<f64>| distances(&local, p, capillary_length);
    let mut r = residuals(&p)?;
    let cost = |r: &[f64]| r.iter().map(|d| d * d).sum::<f64>();
    let mut inverse = Matrix3::zeros();
    for _ in 0..30 {
        let (normal, right) = gauss_newton_system(&p, &r, &scale, residuals)?;
        inverse = normal.try_inverse()?;
        let mut change = inverse * right;
        let mut next = None;
        // A step that raises the cost is halved.
        for _ in 0..12 {
            let trial = p - change;
            let trial_residuals = if trial[0] > 0.0 { residuals(&trial) } else { None };
            next = trial_residuals.filter(|t| cost(t) <= cost(&r)).map(|t| (trial, t));
            if next.is_some() {
                break;
            }
            change *= 0.5;
        }
        let Some((trial, trial_residuals)) = next else { break };
        let settled = change.component_div(&scale).norm() < 1e-10;
        (p, r) = (trial, trial_residuals);
        if settled {
            break;
        }
    }
    let freedom = (points.len() - 3) as f64;
    Some(SessileFit {
        apex: p[1] * level + p[2] * down,
        apex_curvature: p[0],
        down,
        capillary_length,
        rms: (cost(&r) / points.len() as f64).sqrt(),
        covariance: inverse * (cost(&r) / freedom),
    })
}

/// Normal equations with derivatives by small steps.
fn gauss_newton_system(
    p: &Vector3<f64>,
    r: &[f64],
    scale: &Vector3<f64>,
    residuals: impl Fn(&Vector3<f64>) -> Option<Vec<f64>>,
) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let mut columns = Vec::with_capacity(3);
    for k in 0..3 {
        let mut moved = *p;
        // The square root of rounding is the best step of a one-sided difference; the profile's kinks ask for more.
        let step = 1e-5 * scale[k];
        moved[k] += step;
        columns.push(residuals(&moved)?.iter().zip(r).map(|(a, b)| (a - b) / step).collect::<Vec<f64>>());
    }
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let normal = Matrix3::from_fn(|i, j| dot(&columns[i], &columns[j]));
    Some((normal, Vector3::from_fn(|i, _| dot(&columns[i], r))))
}

/// Signed distances in m of points (horizontal, downward) from the profile, positive outside.
fn distances(points: &[Vec2], p: &Vector3<f64>, capillary_length: f64) -> Option<Vec<f64>> {
    let curve = profile(p[0], capillary_length, std::f64::consts::PI);
    if curve.len() < 2 {
        return None;
    }
    let distance = |q: &Vec2| {
        let q = Vec2::new((q.x - p[1]).abs(), q.y - p[2]);
        let squared = |c: &ProfilePoint| (q - Vec2::new(c.x, c.z)).norm_squared();
        let nearest = curve.iter().min_by(|a, b| squared(a).total_cmp(&squared(b)));
        // The circle of curvature at the nearest vertex stands for the curve between vertices.
        nearest.map_or(0.0, |c| {
            let tangent = Vec2::new(c.inclination.cos(), c.inclination.sin());
            let outward = Vec2::new(tangent.y, -tangent.x);
            let kappa = p[0] + c.z / capillary_length.powi(2);
            let d = q - Vec2::new(c.x, c.z);
            let power = 0.5 * kappa * d.norm_squared() + d.dot(&outward);
            2.0 * power / (1.0 + (1.0 + 2.0 * kappa * power).max(0.0).sqrt())
        })
    };
    Some(points.iter().map(distance).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sessile_drops_of_area_one_have_the_printed_base_and_height() {
        for (degrees, sizes) in [
            (40.0_f64, [(0.1, 2.85937, 0.50960), (1.0, 3.08776, 0.45738), (10.0, 5.21725, 0.21621)]),
            (60.0, [(0.1, 2.22700, 0.63207), (1.0, 2.37639, 0.58245), (10.0, 3.70996, 0.31476)]),
            (90.0, [(0.1, 1.61076, 0.79103), (1.0, 1.73681, 0.73555), (10.0, 2.68281, 0.43890)]),
            (120.0, [(0.1, 1.10866, 0.93412), (1.0, 1.25878, 0.86249), (10.0, 2.14078, 0.52977)]),
        ] {
            for (bond, base, height) in sizes {
                let drop = sessile_drop(1.0, 1.0 / f64::sqrt(bond), degrees.to_radians()).expect("a drop");
                assert!((drop.base - base).abs() < 1.1e-5, "{degrees} Bo {bond}: {drop:?}");
                assert!((drop.height - height).abs() < 1.1e-5, "{degrees} Bo {bond}: {drop:?}");
            }
        }
    }

    #[test]
    fn the_rise_between_plates_has_the_printed_height_in_the_middle() {
        for (degrees, width, height) in
            [(40.0_f64, 0.5, 3.02894), (40.0, 1.0, 1.46356), (60.0, 1.0, 0.95797), (60.0, 2.0, 0.42316)]
        {
            let found = rise_between_plates(width, 1.0, degrees.to_radians()).expect("a meniscus");
            assert!((found - height).abs() < 1.1e-5, "{degrees} {width}: {found}");
        }
    }

    #[test]
    fn a_turned_sessile_drop_is_recovered_from_points_of_its_upper_part() {
        let (lc, angle) = (1.0 / 2.0_f64.sqrt(), 75.0_f64);
        let drop = sessile_drop(1.0, lc, angle.to_radians()).expect("a drop");
        let down = Vec2::new(0.6, -0.8);
        let apex = Vec2::new(0.3, 1.1);
        let curve = profile(drop.apex_curvature, lc, angle.to_radians());
        let upper: Vec<Vec2> = curve
            .iter()
            .filter(|c| c.z < 0.8 * drop.height)
            .step_by(7)
            .flat_map(|c| [-1.0, 1.0].map(|side| apex + side * c.x * perpendicular(down) + c.z * down))
            .collect();
        let mut ordered = upper.clone();
        ordered.sort_by(|a, b| a.dot(&perpendicular(down)).total_cmp(&b.dot(&perpendicular(down))));
        let fit = fit_sessile_drop(&ordered, down, lc).expect("a fit");
        assert!((fit.apex - apex).norm() < 1e-4, "{fit:?}");
        assert!((fit.apex_curvature / drop.apex_curvature - 1.0).abs() < 1e-3, "{fit:?}");
        let base = fit.base_at(apex.dot(&down) + drop.height).expect("a floor below the apex");
        assert!((base / drop.base - 1.0).abs() < 1e-3, "{base} for {}", drop.base);
        let [found, error] = fit.angle_at(apex.dot(&down) + drop.height).expect("a floor below the apex");
        assert!((found - angle).abs() < 0.05 && error < 0.05, "{found} +- {error}");
    }
}
