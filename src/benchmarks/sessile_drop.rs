//! Base, height and, under gravity, the angle of a drop on a wall (C1 and C2 of the benchmarks).

use crate::analysis::laws::drops::cap;
use crate::analysis::young_laplace::sessile_drop;
use crate::interface::contact::ContactLine;
use crate::math::Vec2;
use crate::solver::Measure;
use crate::sph::measures::{Group, Subject, measure};

/// Measures of its table `[sph.measure.sessile-drop]`.
pub const GROUP: Group = Group::of(measures);

/// A wall is level where its normal points up to this cosine.
const LEVEL: f64 = 1.0 - 1e-6;

fn measures(s: &Subject) -> Vec<Measure> {
    let (base, height) = extent(s);
    let mut found = vec![
        measure("base-m", base, "m", None, "distance of the two contact points of the fitted meniscus"),
        measure(
            "height-m",
            height,
            "m",
            None,
            "largest distance of the c = 0.5 contour from the line through both contact points",
        ),
    ];
    let more = if s.flow.setting.method.gravity == Vec2::zeros() {
        as_a_cap(s, (base, height))
    } else {
        under_gravity(s, (base, height))
    };
    found.extend(more);
    found
}

/// Base and height in m, NaN where there are not two contact lines with an angle.
fn extent(s: &Subject) -> (f64, f64) {
    let lines: Vec<_> = s.seen.lines_with_angle().collect();
    // Contours go on beyond a periodic side, so the two ends of one drop need no shortest way.
    match lines[..] {
        [a, b] => {
            let (from, along) = (a.position, b.position - a.position);
            let distance = |x: &Vec2| along.perp(&(x - from)).abs() / along.norm();
            let points = s.seen.interface.iter().flat_map(|line| &line.points);
            (along.norm(), points.map(distance).fold(f64::NAN, f64::max))
        }
        _ => (f64::NAN, f64::NAN),
    }
}

/// Base and height (m) of a drop of either phase over those of the circular segment.
fn as_a_cap(s: &Subject, (base, height): (f64, f64)) -> Vec<Measure> {
    let through_wetting = s.flow.setting.method.wetting.map_or(f64::NAN, |wetting| wetting.static_angle());
    let is_wetting = s.seen.lines_with_angle().map(|line| line.curvature).sum::<f64>() > 0.0;
    let areas = &s.seen.areas;
    let exact = if is_wetting {
        cap(areas.wetting, through_wetting)
    } else {
        cap(areas.non_wetting, std::f64::consts::PI - through_wetting)
    };
    let over = "over that of the circular segment with the same area and the requested angle";
    vec![
        measure("base-ratio", base / exact.base, "", None, &format!("base {over}")),
        measure("height-ratio", height / exact.height, "", None, &format!("height {over}")),
    ]
}

/// Base and height (m) of a drop on a level floor over those of the exact solution under gravity.
fn under_gravity(s: &Subject, (base, height): (f64, f64)) -> Vec<Measure> {
    let m = &s.flow.setting.method;
    let force = m.curvature_gradient();
    let is_on_floor = |line: &ContactLine| -(s.flow.setting.wall)(line.position).1.dot(&force.normalize()) > LEVEL;
    let asked_for = m.wetting.map_or(f64::NAN, |wetting| wetting.static_angle());
    let exact = sessile_drop(s.seen.areas.wetting, force.norm().sqrt().recip(), asked_for);
    let exact = exact.filter(|_| s.seen.lines_with_angle().all(is_on_floor));
    let ratio = |found: f64, exact: Option<f64>| exact.map_or(f64::NAN, |exact| found / exact);
    let over =
        "over that of the Young-Laplace equation with the same area, the requested angle and gravity, on a level floor";
    vec![
        measure("base-ratio", ratio(base, exact.map(|e| e.base)), "", None, &format!("base {over}")),
        measure("height-ratio", ratio(height, exact.map(|e| e.height)), "", None, &format!("height {over}")),
    ]
}
