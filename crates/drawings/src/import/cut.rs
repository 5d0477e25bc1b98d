//! Shapes cut exactly at the sides of a window.
//!
//! The parts beyond a wall side are invisible, so that shapes stay complete there. Beyond an open side walls continue straight, as the solvers require: the
//! shape is cut along the side and its section extruded. At a periodic side the drawing ends, and its part in the window is repeated. Arcs stay arcs.

use crate::import::drawing::{FillRule, Ring, shape_of};
use crate::import::nest::regions;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::body::{Body, bulged_ring};
use meniscus_geometry::curve::Curve;
use meniscus_geometry::spec::GeometrySpec;

/// Vertices nearer to a side than this fraction of the window's longer side are on it.
pub(crate) const ON_SIDE: f64 = 1e-9;

/// Treatment of shapes beyond a side of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Beyond {
    /// They stay unchanged: a wall hides them, or nothing is beyond.
    #[default]
    Whole,
    /// They continue straight: an open side.
    Straight,
    /// They end: a periodic side.
    Nothing,
}

/// Parameters from 0 to 1 at which a curve crosses the line where coordinate `axis` equals `at`.
pub(crate) fn crossings(curve: &Curve, axis: usize, at: f64) -> Vec<f64> {
    match *curve {
        Curve::Segment { a, b } => {
            let u = (at - a[axis]) / (b[axis] - a[axis]);
            if 0.0 < u && u < 1.0 { vec![u] } else { Vec::new() }
        }
        Curve::Arc { center, radius, start, sweep } => {
            let height = (at - center[axis]) / radius;
            if !(height.abs() < 1.0) {
                return Vec::new();
            }
            // The line is crossed at two angles symmetric about the axis.
            let middle = if axis == 0 { 0.0 } else { std::f64::consts::FRAC_PI_2 };
            let mut found: Vec<f64> = [middle - height.acos(), middle + height.acos()]
                .into_iter()
                .map(|angle| ((angle - start) * sweep.signum()).rem_euclid(std::f64::consts::TAU) / sweep.abs())
                .filter(|u| 0.0 < *u && *u < 1.0)
                .collect();
            found.sort_by(f64::total_cmp);
            found
        }
    }
}

/// Cuts the shapes at the sides of the domain: left, right, bottom, top. Returns the numbers of shapes that were cut and of failures.
pub fn cut_at_sides(spec: &mut GeometrySpec, beyond: [Beyond; 4]) -> (usize, usize) {
    let domain = Bounds { min: Vec2::from(spec.min), max: Vec2::from(spec.max) };
    let (mut shapes, mut done, mut failed) = (Vec::with_capacity(spec.shapes.len()), 0, 0);
    for shape in spec.shapes.drain(..) {
        let bodies = Body::of(&shape, 0, domain);
        if beyond == [Beyond::Whole; 4] || !bodies.iter().any(|body| is_cut(body, domain, beyond)) {
            shapes.push(shape);
            continue;
        }
        let parts: Option<Vec<Vec<Ring>>> = bodies.iter().map(|body| rings_of(body, domain, beyond)).collect();
        match parts {
            Some(parts) => {
                done += 1;
                let cut = parts.iter().flat_map(|rings| regions(rings, FillRule::EvenOdd));
                shapes.extend(cut.map(|(outer, holes)| shape_of(outer, holes)));
            }
            None => {
                failed += 1;
                shapes.push(shape);
            }
        }
    }
    spec.shapes = shapes;
    (done, failed)
}

/// Whether a body crosses or touches a side at which it is to be cut. Infinite walls continue anyway.
fn is_cut(body: &Body, domain: Bounds, beyond: [Beyond; 4]) -> bool {
    let near = ON_SIDE * domain.size().max();
    let b = body.bounds;
    let crosses = [
        b.min.x <= domain.min.x + near,
        b.max.x >= domain.max.x - near,
        b.min.y <= domain.min.y + near,
        b.max.y >= domain.max.y - near,
    ];
    !body.is_endless() && (0..4).any(|side| beyond[side] != Beyond::Whole && crosses[side])
}

/// The rings of a body, cut at all sides; `None` if they do not close.
fn rings_of(body: &Body, domain: Bounds, beyond: [Beyond; 4]) -> Option<Vec<Ring>> {
    let mut rings = loops(&body.curves)?;
    for (side, what) in beyond.into_iter().enumerate().filter(|(_, what)| *what != Beyond::Whole) {
        let (axis, is_upper) = (side / 2, side % 2 == 1);
        let at = if is_upper { domain.max[axis] } else { domain.min[axis] };
        let length = domain.size().max();
        let far = (what == Beyond::Straight).then_some(if is_upper { at + length } else { at - length });
        rings = Line { axis, at, is_upper, far, near: ON_SIDE * length }.cut(&rings)?;
    }
    Some(rings)
}

/// The closed rings of consecutive curves.
fn loops(curves: &[Curve]) -> Option<Vec<Ring>> {
    let (mut rings, mut open) = (Vec::new(), Ring::default());
    let mut first: Option<Vec2> = None;
    for curve in curves {
        // Arcs above a half circle are divided in two, as their bulge would lose digits.
        let parts = match curve {
            Curve::Arc { sweep, .. } if sweep.abs() > std::f64::consts::PI => 2,
            _ => 1,
        };
        for k in 0..parts {
            let part = curve.part(f64::from(k) / f64::from(parts), f64::from(k + 1) / f64::from(parts));
            open.vertices.push(part.vertex());
        }
        let begin = *first.get_or_insert(curve.point(0.0));
        let size = 1e-9 * (curve.bounds().size().max() + (begin - curve.point(1.0)).norm()).max(begin.norm());
        if curve.is_closed() || (curve.point(1.0) - begin).norm() <= size {
            rings.push(std::mem::take(&mut open));
            first = None;
        }
    }
    open.vertices.is_empty().then_some(rings)
}

/// A side along which rings are cut.
struct Line {
    axis: usize,
    at: f64,
    is_upper: bool,
    /// Coordinate to which the section is extruded.
    far: Option<f64>,
    near: f64,
}

/// Consecutive edges of a ring within the window, from side to side.
struct Run {
    vertices: Vec<[f64; 3]>,
    end: Vec2,
}

impl Line {
    fn cut(&self, rings: &[Ring]) -> Option<Vec<Ring>> {
        let (mut whole, mut runs) = (Vec::new(), Vec::new());
        for ring in rings {
            self.runs(ring, &mut whole, &mut runs);
        }
        let next = self.followers(&runs)?;
        let mut used = vec![false; runs.len()];
        for first in 0..runs.len() {
            let (mut ring, mut i) = (Ring::default(), first);
            while !used[i] {
                used[i] = true;
                ring.vertices.extend(&runs[i].vertices);
                let (from, to) = (runs[i].end, self.start(&runs[next[i]]));
                ring.vertices.push([from.x, from.y, 0.0]);
                if let Some(far) = self.far {
                    for mut corner in [from, to] {
                        corner[self.axis] = far;
                        ring.vertices.push([corner.x, corner.y, 0.0]);
                    }
                }
                i = next[i];
            }
            if !ring.vertices.is_empty() {
                whole.push(ring.without_doubled(self.near).0);
            }
        }
        Some(whole)
    }

    fn is_inside(&self, x: Vec2) -> bool {
        if self.is_upper { x[self.axis] < self.at } else { x[self.axis] > self.at }
    }

    /// The point moved onto the side if it is there within rounding.
    fn snapped(&self, mut x: Vec2) -> Vec2 {
        if (x[self.axis] - self.at).abs() <= self.near {
            x[self.axis] = self.at;
        }
        x
    }

    fn runs(&self, ring: &Ring, whole: &mut Vec<Ring>, runs: &mut Vec<Run>) {
        let n = ring.vertices.len();
        let mut pieces: Vec<(Vec2, f64, bool)> = Vec::with_capacity(n);
        let corners: Vec<[f64; 3]> = ring
            .vertices
            .iter()
            .map(|&[x, y, bulge]| {
                let p = self.snapped(Vec2::new(x, y));
                [p.x, p.y, bulge]
            })
            .collect();
        for (curve, &[x, y, bulge]) in bulged_ring(&corners).zip(&corners) {
            let mut parameters = vec![0.0];
            let end = self.near / curve.length();
            parameters.extend(crossings(&curve, self.axis, self.at).into_iter().filter(|u| end < *u && *u < 1.0 - end));
            parameters.push(1.0);
            for (k, pair) in parameters.windows(2).enumerate() {
                let mut from = if k == 0 { Vec2::new(x, y) } else { curve.point(pair[0]) };
                if k > 0 {
                    from[self.axis] = self.at;
                }
                let part = if bulge == 0.0 { 0.0 } else { (bulge.atan() * (pair[1] - pair[0])).tan() };
                pieces.push((from, part, self.is_inside(curve.point(0.5 * (pair[0] + pair[1])))));
            }
        }
        let count = pieces.len();
        let Some(begin) = (0..count).find(|&i| pieces[i].2 && !pieces[(i + count - 1) % count].2) else {
            if pieces.iter().any(|piece| piece.2) {
                whole.push(ring.clone());
            }
            return;
        };
        let mut open: Option<Run> = None;
        for k in 0..=count {
            let (from, bulge, is_inside) = pieces[(begin + k) % count];
            match &mut open {
                Some(run) if is_inside && k < count => run.vertices.push([from.x, from.y, bulge]),
                Some(_) => {
                    if let Some(mut run) = open.take() {
                        run.end = from;
                        runs.push(run);
                    }
                }
                None if is_inside && k < count => {
                    open = Some(Run { vertices: vec![[from.x, from.y, bulge]], end: from });
                }
                None => {}
            }
        }
    }

    fn start(&self, run: &Run) -> Vec2 {
        run.vertices.first().map_or(run.end, |v| Vec2::new(v[0], v[1]))
    }

    /// The run that follows each one around a solid section of the side; `None` if ends do not pair.
    fn followers(&self, runs: &[Run]) -> Option<Vec<usize>> {
        let along = 1 - self.axis;
        // The solid is on the left of a run that leaves the window, so that its section extends upwards on the right and the bottom side.
        let end_is_lower = self.is_upper == (self.axis == 0);
        let mut ends: Vec<(f64, bool, usize)> = Vec::with_capacity(2 * runs.len());
        for (i, run) in runs.iter().enumerate() {
            ends.push((self.start(run)[along], false, i));
            ends.push((run.end[along], true, i));
        }
        ends.sort_by(|a, b| {
            a.0.total_cmp(&b.0).then((a.1 != end_is_lower).cmp(&(b.1 != end_is_lower))).then(a.2.cmp(&b.2))
        });
        let mut next = vec![usize::MAX; runs.len()];
        for pair in ends.chunks(2) {
            let [low, high] = pair else { return None };
            let (end, start) = if end_is_lower { (low, high) } else { (high, low) };
            if !end.1 || start.1 {
                return None;
            }
            next[end.2] = start.2;
        }
        next.iter().all(|&i| i != usize::MAX).then_some(next)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::import::drawing::seen::bar;
    use crate::import::nest::circle;
    use meniscus_geometry::Geometry;
    use meniscus_geometry::spec::{Disc, ShapeSpec, SolidSide};

    fn spec(shapes: Vec<ShapeSpec>) -> GeometrySpec {
        GeometrySpec { min: [0.0, 0.0], max: [4.0, 3.0], solid: SolidSide::Inside, shapes }
    }

    fn disc(x: f64, y: f64, radius: f64) -> ShapeSpec {
        ShapeSpec::Disc(Disc { center: [x, y], radius })
    }

    fn straight(sides: [bool; 4]) -> [Beyond; 4] {
        sides.map(|is_open| if is_open { Beyond::Straight } else { Beyond::Whole })
    }

    #[test]
    fn a_disc_that_crosses_an_open_side_goes_on_straight_and_is_the_same_within() {
        for (center, side, out) in [
            ([3.8, 1.2], 1, Vec2::x()),
            ([0.3, 1.7], 0, -Vec2::x()),
            ([2.2, 2.6], 3, Vec2::y()),
            ([1.9, 0.1], 2, -Vec2::y()),
        ] {
            let whole = spec(vec![disc(center[0], center[1], 0.7)]);
            let mut cut_spec = whole.clone();
            let mut sides = [false; 4];
            sides[side] = true;
            assert_eq!(cut_at_sides(&mut cut_spec, straight(sides)), (1, 0));
            let (a, b) = (Geometry::unchecked(&whole), Geometry::unchecked(&cut_spec));
            assert!((a.porosity().value - b.porosity().value).abs() < 1e-12, "side {side}");
            let domain = a.bounds();
            for k in 0..200 {
                let share = (f64::from(k) + 0.5) / 200.0;
                let mut x = domain.min + domain.size() * share;
                let axis = side / 2;
                x[axis] = if side % 2 == 1 { domain.max[axis] } else { domain.min[axis] };
                let inside = a.signed_distance(x - 1e-6 * out) > 0.0;
                for beyond in [1e-6, 0.3, 1.0] {
                    assert_eq!(b.signed_distance(x + beyond * out) > 0.0, inside, "side {side}, {x:?}, {beyond}");
                }
            }
        }
    }

    #[test]
    fn a_disc_at_a_corner_of_two_open_sides_goes_on_beyond_both() {
        let mut cut_spec = spec(vec![disc(4.0, 3.0, 1.0)]);
        cut_at_sides(&mut cut_spec, straight([false, true, false, true]));
        let g = Geometry::unchecked(&cut_spec);
        for (x, is_pore) in [([5.0, 2.5], false), ([5.0, 1.5], true), ([3.5, 4.0], false), ([2.5, 4.0], true)] {
            assert_eq!(g.signed_distance(Vec2::from(x)) > 0.0, is_pore, "{x:?}");
        }
    }

    #[test]
    fn a_comb_is_cut_into_its_teeth_and_a_ring_into_two_walls() {
        let comb = [[1.0, 0.5], [6.0, 0.5], [6.0, 2.5], [1.0, 2.5], [1.0, 2.0], [5.0, 2.0], [5.0, 1.0], [1.0, 1.0]];
        let comb = Ring { vertices: comb.map(|[x, y]| [x, y, 0.0]).to_vec() };
        let mut teeth = spec(vec![shape_of(comb, Vec::new())]);
        cut_at_sides(&mut teeth, [Beyond::Whole, Beyond::Nothing, Beyond::Whole, Beyond::Whole]);
        assert_eq!(teeth.shapes.len(), 2);
        let [outer, hole] = [1.0, 0.5].map(|radius| circle(Vec2::new(3.5, 1.5), radius));
        let mut walls = spec(vec![shape_of(outer, vec![hole])]);
        let before = Geometry::unchecked(&walls).porosity().value;
        cut_at_sides(&mut walls, straight([false, true, false, false]));
        let g = Geometry::unchecked(&walls);
        assert!((g.porosity().value - before).abs() < 1e-12);
        assert!(g.signed_distance(Vec2::new(4.5, 1.5)) < 0.0 && g.signed_distance(Vec2::new(3.5, 1.5)) > 0.0);
    }

    #[test]
    fn a_shape_that_ends_on_the_side_goes_on_and_one_whole_within_is_left_alone() {
        let block = shape_of(bar(3.0, 1.0, 1.0, 1.0), Vec::new());
        let mut cut_spec = spec(vec![block, disc(1.0, 1.0, 0.5)]);
        assert_eq!(cut_at_sides(&mut cut_spec, straight([true; 4])), (1, 0));
        assert_eq!(cut_spec.shapes[1], disc(1.0, 1.0, 0.5));
        assert!(Geometry::unchecked(&cut_spec).signed_distance(Vec2::new(4.5, 1.5)) < -0.4);
    }
}
