//! Base, height and, under gravity, the angle of a drop on a wall (C1 and C2 of the benchmarks). Half a drop beside a symmetry side is completed by its
//! mirror image.
//!
//! Exact under gravity: the two-dimensional Young-Laplace equation, solved by Runge-Kutta steps from the apex. With the arc length s, the inclination phi and
//! the depth z below the apex: dx/ds = cos phi, dz/ds = sin phi, dphi/ds = kappa_0 + z/l_c², where l_c² = sigma/(d_rho g). The unknown apex curvature kappa_0
//! follows from the area of the drop by bisection.

use meniscus_core::math::Vec2;
use meniscus_core::solver::{Measure, measure};
use meniscus_geometry::analysis::roots::bisect;
use meniscus_geometry::interface::cap::cap;
use meniscus_geometry::interface::contact::{ACCURACY, ContactLine};
use meniscus_sph::domain::{ImageVelocity, Mirror};
use meniscus_sph::flow::Flow;
use meniscus_sph::measures::{Columns, Subject};
use meniscus_sph::observe::Observation;

const BASE: &str = "base_m";
const HEIGHT: &str = "height_m";

/// A point of a meniscus under gravity, the apex at the origin and z downward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ProfilePoint {
    /// Horizontal distance from the apex in m.
    pub(crate) x: f64,
    /// Depth below the apex in m.
    pub(crate) z: f64,
    /// Area in m² between the apex and this point, on one side.
    pub(crate) area: f64,
}

/// Upper bound of the rotation (rad) per step and of its length over the capillary length: the error of the fourth-order rule is then below 1e-8 of the sizes.
const LARGEST_TURN: f64 = 0.01;
/// Maximum number of steps to reach the inclination.
const MOST_STEPS: usize = 200_000;

/// The profile from the apex to the inclination `last` (rad).
///
/// `apex_curvature` in 1/m, above 0; `capillary_length` in m. Empty if the inclination is not reached.
pub(crate) fn profile(apex_curvature: f64, capillary_length: f64, last: f64) -> Vec<ProfilePoint> {
    let stiffness = capillary_length.powi(-2);
    // State: x, z, inclination and the area, the integral of x dz.
    let slope = |[x, z, phi, _]: [f64; 4]| [phi.cos(), phi.sin(), apex_curvature + stiffness * z, x * phi.sin()];
    let add = |y: [f64; 4], k: [f64; 4], by: f64| [0, 1, 2, 3].map(|i| y[i] + by * k[i]);
    let step = |y: [f64; 4], ds: f64| {
        let k1 = slope(y);
        let k2 = slope(add(y, k1, 0.5 * ds));
        let k3 = slope(add(y, k2, 0.5 * ds));
        let k4 = slope(add(y, k3, ds));
        [0, 1, 2, 3].map(|i| y[i] + ds / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
    };
    let point = |y: [f64; 4]| ProfilePoint { x: y[0], z: y[1], area: y[3] };
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
pub(crate) struct SessileDrop {
    /// Length of the wetted floor in m.
    pub(crate) base: f64,
    /// Height in m.
    pub(crate) height: f64,
}

/// The drop that ends at the contact angle, with its area in m².
fn drop_from(apex_curvature: f64, capillary_length: f64, angle: f64) -> Option<(SessileDrop, f64)> {
    let points = profile(apex_curvature, capillary_length, angle);
    let end = points.last().filter(|_| points.len() > 1)?;
    Some((SessileDrop { base: 2.0 * end.x, height: end.z }, 2.0 * end.area))
}

/// The drop of `area` (m²) with the contact `angle` (rad) under gravity, for a `capillary_length` in m.
pub(crate) fn sessile_drop(area: f64, capillary_length: f64, angle: f64) -> Option<SessileDrop> {
    // Search starts from the curvature of the cap without gravity; gravity flattens the apex, for puddles by many orders of magnitude.
    let cap = ((angle - angle.sin() * angle.cos()) / area).sqrt();
    let excess = |logarithm: f64| {
        drop_from(cap * logarithm.exp(), capillary_length, angle).map_or(f64::NAN, |(_, found)| found - area)
    };
    let logarithm = bisect(excess, -40.0, 1.0)?;
    drop_from(cap * logarithm.exp(), capillary_length, angle).map(|(drop, _)| drop)
}

/// A wall is horizontal if the cosine between its normal and the vertical exceeds this.
const LEVEL: f64 = 1.0 - 1e-6;

/// Lower bound of the sine for flat menisci, of a few degrees: their ends follow from the fit rather than from the contour there.
const SMALLEST_SINE: f64 = 0.05;

/// A length with its standard uncertainty at one time, in m.
#[derive(Debug, Clone, Copy)]
struct Length {
    value: f64,
    uncertainty: f64,
}

/// Extent of a drop, NaN unless there are two contact lines with an angle.
#[derive(Debug, Clone, Copy)]
struct Extent {
    base: Length,
    height: Length,
}

impl Extent {
    /// The observed extent, including the mirror image beyond a symmetry side.
    fn of(flow: &Flow, observation: &Observation) -> Self {
        // As for the angle: the contour may be displaced by this much, uniformly. Both ends then move outward, farther for a flat drop.
        let off = ACCURACY * flow.config.method.kernel.h;
        let lines: Vec<ContactLine> = observation.lines_with_angle().copied().chain(image(flow, observation)).collect();
        // Contours continue across periodic sides, so the distance of the two ends of a drop needs no minimum image.
        let [a, b] = &lines[..] else {
            let none = Length { value: f64::NAN, uncertainty: f64::NAN };
            return Self { base: none, height: none };
        };
        let (from, along) = (a.position, b.position - a.position);
        let distance = |x: &Vec2| along.perp(&(x - from)).abs() / along.norm();
        let points = observation.interface.iter().flat_map(|line| &line.points);
        let along_wall = |line: &ContactLine| off / line.angle_deg.to_radians().sin().max(SMALLEST_SINE);
        Self {
            base: Length { value: along.norm(), uncertainty: along_wall(a) + along_wall(b) },
            height: Length { value: points.map(distance).fold(f64::NAN, f64::max), uncertainty: off },
        }
    }
}

/// The symmetry side at which the interface of a half drop ends: its only contact line has a mirror image there.
fn mirror(flow: &Flow, observation: &Observation) -> Option<Mirror> {
    let [interface] = &observation.interface[..] else { return None };
    if observation.lines_with_angle().count() != 1 {
        return None;
    }
    let ends = [*interface.points.first()?, *interface.points.last()?];
    let distance =
        |mirror: &Mirror| ends.map(|x| (x[mirror.axis] - mirror.at).abs()).into_iter().fold(f64::INFINITY, f64::min);
    let symmetric = flow.config.domain.mirrors.iter().filter(|mirror| mirror.image == ImageVelocity::Mirrored);
    let nearest = symmetric.copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    (distance(&nearest) < flow.config.method.kernel.support()).then_some(nearest)
}

/// The mirror image of the contact line of a half drop.
fn image(flow: &Flow, observation: &Observation) -> Option<ContactLine> {
    let mirror = mirror(flow, observation)?;
    let mut line = *observation.lines_with_angle().next()?;
    line.position[mirror.axis] = 2.0 * mirror.at - line.position[mirror.axis];
    Some(line)
}

/// Areas in m² of wetting and non-wetting phase; for a half drop beside a symmetry side those of the whole one.
fn areas(s: &Subject) -> [f64; 2] {
    let whole = if mirror(s.flow, s.observed).is_some() { 2.0 } else { 1.0 };
    [whole * s.observed.areas.wetting, whole * s.observed.areas.non_wetting]
}

pub(super) fn columns(flow: &Flow, observation: &Observation) -> Columns {
    let Extent { base, height } = Extent::of(flow, observation);
    vec![(BASE, base.value), (HEIGHT, height.value)]
}

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let Extent { base, height } = Extent::of(s.flow, s.observed);
    let of_base = "distance of the two contact points of the fitted meniscus";
    let of_height = "largest distance of the c = 0.5 contour from the line through both contact points";
    let (exact, over) = if s.flow.config.method.gravity == Vec2::zeros() { as_a_cap(s) } else { under_gravity(s) };
    let (of_base_ratio, of_height_ratio) = (format!("base {over}"), format!("height {over}"));
    let over_base = |length: f64| length / exact.base;
    let over_height = |length: f64| length / exact.height;
    let [base_bar, height_bar] = [base, height].map(|length| length.uncertainty);
    vec![
        measure("base-m", base.value, "m")
            .by(of_base)
            .with_uncertainty(base_bar)
            .moving_with(BASE, 1.0)
            .resting_at(exact.base),
        measure("height-m", height.value, "m")
            .by(of_height)
            .with_uncertainty(height_bar)
            .moving_with(HEIGHT, 1.0)
            .resting_at(exact.height),
        measure("base-ratio", over_base(base.value), "")
            .by(&of_base_ratio)
            .with_uncertainty(over_base(base_bar))
            .moving_with(BASE, over_base(1.0))
            .resting_at(1.0),
        measure("height-ratio", over_height(height.value), "")
            .by(&of_height_ratio)
            .with_uncertainty(over_height(height_bar))
            .moving_with(HEIGHT, over_height(1.0))
            .resting_at(1.0),
    ]
}

/// The exact drop of either phase without gravity, and its description.
fn as_a_cap(s: &Subject) -> (SessileDrop, &'static str) {
    let through_wetting = s.flow.config.method.wetting.map_or(f64::NAN, |wetting| wetting.static_angle());
    let is_wetting = s.observed.lines_with_angle().map(|line| line.curvature).sum::<f64>() > 0.0;
    let [wetting, non_wetting] = areas(s);
    let exact = if is_wetting {
        cap(wetting, through_wetting)
    } else {
        cap(non_wetting, std::f64::consts::PI - through_wetting)
    };
    let over = "over that of the circular segment with the same area and the requested angle";
    (SessileDrop { base: exact.base, height: exact.height }, over)
}

/// The exact drop on a horizontal floor under gravity, NaN on other walls, and its description.
fn under_gravity(s: &Subject) -> (SessileDrop, &'static str) {
    let m = &s.flow.config.method;
    let force = m.curvature_gradient();
    let is_on_floor = |line: &ContactLine| -(s.flow.config.wall)(line.position).1.dot(&force.normalize()) > LEVEL;
    let angle = m.wetting.map_or(f64::NAN, |wetting| wetting.static_angle());
    let exact = sessile_drop(areas(s)[0], force.norm().sqrt().recip(), angle);
    let exact = exact.filter(|_| s.observed.lines_with_angle().all(is_on_floor));
    let over =
        "over that of the Young-Laplace equation with the same area, the requested angle and gravity, on a level floor";
    (exact.unwrap_or(SessileDrop { base: f64::NAN, height: f64::NAN }), over)
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::interface::arc::Arc;

    /// Height in m of the lowest point of the meniscus between plates `width` (m) apart above the level outside.
    fn rise_between_plates(width: f64, capillary_length: f64, angle: f64) -> Option<f64> {
        let last = std::f64::consts::FRAC_PI_2 - angle;
        let circular = 2.0 * angle.cos() / width;
        let off = |logarithm: f64| {
            let points = profile(circular * logarithm.exp(), capillary_length, last);
            points.last().map_or(f64::NAN, |end| end.x - 0.5 * width)
        };
        let logarithm = bisect(off, -30.0, 1.0)?;
        Some(capillary_length.powi(2) * circular * logarithm.exp())
    }

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
    fn the_end_of_a_flat_puddle_is_found_from_four_capillary_lengths_of_it() {
        let length = 0.316;
        for (apex_curvature, degrees) in [(1e-3, 60.0_f64), (0.02, 120.0)] {
            let side = profile(apex_curvature, length, degrees.to_radians());
            let floor = side.last().unwrap().z;
            let points: Vec<Vec2> = side.iter().rev().map(|p| Vec2::new(p.x, -p.z)).collect();
            let mut arc_length = 0.0;
            let mut last = points[0];
            let used = points.iter().filter(|x| {
                arc_length += (**x - last).norm();
                last = **x;
                x.y > -0.8 * floor && arc_length < 4.0 * length
            });
            let used: Vec<Vec2> = used.step_by(8).copied().collect();
            let arc = Arc::fit(&used, Vec2::new(0.0, -length.powi(-2)), length).unwrap();
            assert!(arc.middle.rms < 1e-4, "{degrees}: {:e}", arc.middle.rms);
            let arc_length = (points[0] - used[0]).norm();
            let back = arc.walk(used[0], -arc_length);
            let off = arc.normal_at(points[0]).dot(&Vec2::y()) + degrees.to_radians().cos();
            assert!((back - points[0]).norm() < 0.02 * length && off.abs() < 2e-3, "{degrees}: {back:?}, {off}");
        }
    }
}
