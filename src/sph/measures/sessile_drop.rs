//! Base and height of a drop on a wall.

use super::{Subject, measure};
use crate::math::Vec2;
use crate::solver::Measure;

pub fn measures(s: &Subject) -> Vec<Measure> {
    let lines: Vec<_> = s.seen.contact_lines.iter().filter(|line| line.angle_deg.is_finite()).collect();
    // Contours go on beyond a periodic side, so the two ends of one drop need no shortest way.
    let (base, height) = match lines[..] {
        [a, b] => {
            let (from, along) = (a.position, b.position - a.position);
            let distance = |x: &Vec2| along.perp(&(x - from)).abs() / along.norm();
            let points = s.seen.interface.iter().flat_map(|line| &line.points);
            (along.norm(), points.map(distance).fold(f64::NAN, f64::max))
        }
        _ => (f64::NAN, f64::NAN),
    };
    vec![
        measure("base-m", base, "m", None, "distance of the two contact points of the fitted circle"),
        measure(
            "height-m",
            height,
            "m",
            None,
            "largest distance of the c = 0.5 contour from the line through both contact points",
        ),
    ]
}
