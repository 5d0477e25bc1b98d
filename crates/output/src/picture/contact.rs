//! The interface at walls: where the smoothing of the color bends it, its fitted curve takes over up to the wall.

use meniscus_core::math::Vec2;
use meniscus_core::snapshot::Lines;

/// Length of the bent end in particle spacings: the reach of the smoothing.
const BENT: f64 = 2.0;
/// Length in spacings along which the curve is fitted.
const FITTED: f64 = 4.0;
/// Most that the curve is continued, in spacings, and the length of its segments.
const REACH: f64 = 4.0;
const STEP: f64 = 0.1;
/// Largest distance in spacings of an end from the wall on which it lies.
const AT_WALL: f64 = 0.5;

/// A line with its ends at walls replaced by the continuation of what is farther away; `spacing` in m.
pub(super) fn to_walls(line: &[Vec2], outline: &Lines<'_>, spacing: f64) -> Vec<Vec2> {
    let is_closed = line.first() == line.last();
    let length: f64 = line.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    // Both ends must leave something of the line.
    if is_closed || !(length > 2.0 * (BENT + FITTED) * spacing) {
        return line.to_vec();
    }
    let mut turned = line.to_vec();
    for _ in 0..2 {
        turned = with_last_end(turned, outline, spacing);
        turned.reverse();
    }
    turned
}

/// The same at the last vertex only.
fn with_last_end(line: Vec<Vec2>, outline: &Lines<'_>, spacing: f64) -> Vec<Vec2> {
    let Some(&end) = line.last() else { return line };
    let walls = walls_within((BENT + REACH) * spacing, end, outline);
    if !walls.iter().any(|wall| distance(end, *wall) < AT_WALL * spacing) {
        return line;
    }
    let kept = before_end(&line, BENT * spacing);
    let Some(curve) = Parabola::fit(&line[..kept], FITTED * spacing) else { return line };
    let steps = (BENT + REACH) / STEP;
    let mut added: Vec<Vec2> = Vec::new();
    for k in 0..steps as u32 {
        let [from, to] = [k, k + 1].map(|k| curve.at(f64::from(k) * STEP * spacing));
        if let Some(contact) = walls.iter().find_map(|wall| crossing([from, to], *wall)) {
            added.push(contact);
            // A curve that ends elsewhere is no continuation.
            let is_near = (contact - end).norm() < REACH * spacing;
            return if is_near { line[..kept].iter().copied().chain(added).collect() } else { line };
        }
        added.push(to);
    }
    line
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
    segments.filter(|wall| distance(of, *wall) < reach).collect()
}

fn distance(x: Vec2, [a, b]: [Vec2; 2]) -> f64 {
    let along = b - a;
    let fraction = (along.dot(&(x - a)) / along.norm_squared()).clamp(0.0, 1.0);
    (x - a - if fraction.is_finite() { fraction * along } else { Vec2::zeros() }).norm()
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
    fn lines_without_a_wall_closed_ones_and_short_ones_stay() {
        let drop = bent_drop();
        assert_eq!(to_walls(&drop, &Lines::default(), 1.0), drop);
        assert_eq!(to_walls(&drop, &floor(), 5.0), drop);
        let closed: Vec<Vec2> = drop.iter().copied().chain([drop[0]]).collect();
        assert_eq!(to_walls(&closed, &floor(), 1.0), closed);
    }
}
