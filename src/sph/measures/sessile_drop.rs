//! Base and height of a drop on a wall.

use super::{Subject, measure};
use crate::math::Vec2;
use crate::solver::Measure;

pub fn measures(s: &Subject) -> Vec<Measure> {
    let lines: Vec<_> = s.seen.contact_lines.iter().filter(|line| line.angle_deg.is_finite()).collect();
    let base = match lines[..] {
        // Contours go on beyond a periodic side, so the two ends of one drop need no shortest way.
        [a, b] => (a.position - b.position).norm(),
        _ => f64::NAN,
    };
    let distance = |x: &Vec2| (s.flow.wall)(*x).0;
    let height = s.seen.interface.iter().flat_map(|line| &line.points).map(distance).fold(f64::NAN, f64::max);
    vec![
        measure("base-m", base, "m", None, "distance of the two contact points of the fitted circle"),
        measure("height-m", height, "m", None, "largest wall distance on the c = 0.5 contour"),
    ]
}
