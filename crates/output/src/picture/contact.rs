//! The interface at walls: where the smoothing of the color bends it, its fitted curve takes over up to the wall.

use meniscus_core::math::{Vec2, distance_to_segment};
use meniscus_core::snapshot::Lines;

/// Length of the bent end in particle spacings: the reach of the smoothing.
const BENT: f64 = 2.0;
/// Length in spacings along which the curve is fitted; half of it must be there, and this number of vertices.
const FITTED: f64 = 4.0;
const LEAST: usize = 4;
/// Most that the curve is continued, in spacings, and the length of its segments.
const REACH: f64 = 4.0;
const STEP: f64 = 0.1;
/// Largest distance in spacings of an end from the wall on which it lies.
const AT_WALL: f64 = 0.5;

/// A line with its ends at walls replaced by the continuation of what is farther away; `spacing` in m.
pub(super) fn to_walls(line: &[Vec2], outline: &Lines<'_>, spacing: f64) -> Vec<Vec2> {
    let turned = |line: &[Vec2]| line.iter().rev().copied().collect::<Vec<_>>();
    let is_closed = line.first() == line.last();
    let (last, first) = (before_end(line, BENT * spacing), line.len() - before_end(&turned(line), BENT * spacing));
    if is_closed || first + LEAST > last || length(&line[first..last]) < 0.5 * FITTED * spacing {
        return line.to_vec();
    }
    let between = &line[first..last];
    let continued = |inner: &[Vec2], end: &[Vec2]| {
        let found = end.last().and_then(|&end| continuation(inner, end, outline, spacing));
        found.unwrap_or_else(|| end.to_vec())
    };
    let (start, end) = (turned(&line[..first]), &line[last..]);
    let start = continued(&turned(between), &start);
    [turned(&start), between.to_vec(), continued(between, end)].concat()
}

fn length(line: &[Vec2]) -> f64 {
    line.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// The vertices that continue a line to the wall on which `end` lies; `None` if it lies on none, or if the line does not come near it.
fn continuation(line: &[Vec2], end: Vec2, outline: &Lines<'_>, spacing: f64) -> Option<Vec<Vec2>> {
    let walls = walls_within((BENT + REACH) * spacing, end, outline);
    if !walls.iter().any(|wall| distance_to_segment(end, *wall) < AT_WALL * spacing) {
        return None;
    }
    let curve = Parabola::fit(line, FITTED * spacing)?;
    let steps = (BENT + REACH) / STEP;
    let mut added: Vec<Vec2> = Vec::new();
    for k in 0..steps as u32 {
        let [from, to] = [k, k + 1].map(|k| curve.at(f64::from(k) * STEP * spacing));
        if let Some(contact) = walls.iter().find_map(|wall| crossing([from, to], *wall)) {
            added.push(contact);
            return ((contact - end).norm() < REACH * spacing).then_some(added);
        }
        added.push(to);
    }
    None
}

/// Number of vertices up to an arc length before the last one.
fn before_end(line: &[Vec2], length: f64) -> usize {
    let mut left = length;
    let mut kept = line.len();
    while kept > 1 && left > 0.0 {
        left -= (line[kept - 1] - line[kept - 2]).norm();
        kept -= 1;
    }
    kept
}

/// A curve through a point with a tangent and a curvature there: y = b x + c x².
struct Parabola {
    origin: Vec2,
    along: Vec2,
    b: f64,
    c: f64,
}

impl Parabola {
    /// The curve through the last vertex of a line that fits those before it within a `length` in m best; `None` for less than three.
    fn fit(line: &[Vec2], length: f64) -> Option<Self> {
        let origin = *line.last()?;
        let window = &line[before_end(line, length)..line.len() - 1];
        let along = (origin - *window.first()?).try_normalize(0.0)?;
        let local = |x: &Vec2| [along.dot(&(x - origin)), along.perp(&(x - origin))];
        let sum = |of: fn([f64; 2]) -> f64| window.iter().map(|x| of(local(x))).sum::<f64>();
        let (x2, x3, x4) = (sum(|[x, _]| x.powi(2)), sum(|[x, _]| x.powi(3)), sum(|[x, _]| x.powi(4)));
        let (xy, x2y) = (sum(|[x, y]| x * y), sum(|[x, y]| x * x * y));
        let determinant = x2 * x4 - x3 * x3;
        (window.len() > 1 && determinant > 0.0).then(|| Self {
            origin,
            along,
            b: (x4 * xy - x3 * x2y) / determinant,
            c: (x2 * x2y - x3 * xy) / determinant,
        })
    }

    fn at(&self, x: f64) -> Vec2 {
        let across = Vec2::new(-self.along.y, self.along.x);
        self.origin + x * self.along + (self.b * x + self.c * x * x) * across
    }
}

/// The segments of the outline that come within a distance in m of a point.
fn walls_within(reach: f64, of: Vec2, outline: &Lines<'_>) -> Vec<[Vec2; 2]> {
    let segments = outline.lines.iter().flat_map(|line| line.windows(2));
    let point = |index: u32| outline.points.get(index as usize).copied();
    let segments = segments.filter_map(|pair| Some([point(pair[0])?, point(pair[1])?]));
    segments.filter(|wall| distance_to_segment(of, *wall) < reach).collect()
}

/// Where two segments cross.
fn crossing([a, b]: [Vec2; 2], [from, to]: [Vec2; 2]) -> Option<Vec2> {
    let (one, other) = (b - a, to - from);
    let determinant = one.perp(&other);
    let [u, v] = [other, one].map(|along| (from - a).perp(&along) / determinant);
    ([u, v].iter().all(|share| (0.0..=1.0).contains(share))).then(|| a + u * one)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floor() -> Lines<'static> {
        let points = vec![Vec2::new(-10.0, 0.0), Vec2::new(10.0, 0.0)];
        Lines { points: points.into(), lines: vec![vec![0, 1]], fields: Vec::new() }
    }

    /// A drop of radius 10 that meets the floor at 60 degrees, from left to right, its ends bent upright within one and a half spacings.
    fn bent_drop() -> Vec<Vec2> {
        let half = std::f64::consts::FRAC_PI_3;
        let arc = (-100..=100).map(|i| f64::from(i) / 100.0 * half);
        let circle = arc.map(|t| Vec2::new(10.0 * t.sin(), 10.0 * (t.cos() - 0.5)));
        let bent = |x: Vec2| Vec2::new(x.x - x.x.signum() * 0.2 * (1.5 - x.y).max(0.0), x.y);
        circle.map(bent).collect()
    }

    #[test]
    fn ends_at_a_wall_continue_the_curve_before_them() {
        let line = to_walls(&bent_drop(), &floor(), 1.0);
        let expected = 10.0 * std::f64::consts::FRAC_PI_3.sin();
        for (end, side) in [(line[0], -1.0), (line[line.len() - 1], 1.0)] {
            assert!(end.y.abs() < 1e-12 && (end.x - side * expected).abs() < 0.05, "{end}");
        }
        let radii = line.iter().map(|x| (x - Vec2::new(0.0, -5.0)).norm());
        assert!(radii.into_iter().all(|r| (r - 10.0).abs() < 0.05));
    }

    #[test]
    fn a_meniscus_in_a_throat_of_eight_spacings_is_straightened_at_both_ends() {
        let points = [-10.0, 10.0].into_iter().flat_map(|x| [Vec2::new(x, 0.0), Vec2::new(x, 8.0)]);
        let mut walls = Lines { points: points.collect(), lines: vec![vec![0, 2], vec![1, 3]], fields: Vec::new() };
        walls.lines.push(vec![0, 1]);
        let bend = |y: f64| 0.2 * (1.5 - y).max(0.0) + 0.2 * (y - 6.5).max(0.0);
        let line: Vec<Vec2> = (0..=16).map(|k| 0.5 * f64::from(k)).map(|y| Vec2::new(bend(y), y)).collect();
        let found = to_walls(&line, &walls, 1.0);
        assert!(found.iter().all(|x| x.x.abs() < 1e-12), "{found:?}");
        assert_eq!([found[0].y, found[found.len() - 1].y], [0.0, 8.0]);
    }

    #[test]
    fn lines_without_a_wall_closed_ones_and_short_ones_stay() {
        let drop = bent_drop();
        assert_eq!(to_walls(&drop, &Lines::default(), 1.0), drop);
        assert_eq!(to_walls(&drop, &floor(), 5.0), drop);
        assert_eq!(to_walls(&drop[..1], &floor(), 1.0), drop[..1]);
        assert!(to_walls(&[], &floor(), 1.0).is_empty());
        let closed: Vec<Vec2> = drop.iter().copied().chain([drop[0]]).collect();
        assert_eq!(to_walls(&closed, &floor(), 1.0), closed);
    }
}
