//! Level passages: sections of the medial axis along which the wall distance is constant.
//!
//! They occur between parallel segments, concentric arcs, and an arc about a vertex. Consecutive sections form one passage. It is one throat if the distance
//! increases, or the domain ends, beyond both of its ends; one pore if it decreases beyond both; a closed one is a pore and a throat at opposite points. It
//! is represented by its midpoint within the domain.

use std::collections::HashMap;

use crate::critical::opposite::{Opposite, slack};
use crate::critical::shift::{Shift, minus};
use crate::critical::slope::{Along, Slope, slope};
use crate::critical::walls::{Contact, Walls};
use crate::curve::{Curve, cross};
use crate::intersect::intersections;
use meniscus_core::math::{Vec2, perpendicular};

/// A section along one segment or arc.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    axis: Curve,
    along: [Along; 2],
}

/// Kinds of ends of a level passage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum End {
    Rises,
    Falls,
    Open,
    Closed,
}

/// Kinds of critical points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// A saddle of the wall distance.
    Saddle(Opposite),
    Maximum(Opposite),
}

/// Whether opposite points lie on a level passage.
pub(crate) enum Passage {
    /// They do not: a point by itself.
    Point,
    /// They do: its critical points, none if the passage is known, two if it is closed.
    Level(Vec<Kind>),
}

/// Finds level passages, each once.
#[derive(Default)]
pub(crate) struct Classifier {
    /// Known sections by the indices of their two walls, with the images of those.
    known: HashMap<[usize; 2], Vec<([Shift; 2], Curve)>>,
}

impl Classifier {
    /// The level passage through the midpoint of two opposite points with its `slopes`.
    pub(crate) fn classify(&mut self, walls: &Walls, at: &Opposite, slopes: &[Slope; 2]) -> Passage {
        if slopes.iter().all(|slope| !matches!(slope, Slope::Level(_))) {
            return Passage::Point;
        }
        let is_known =
            slopes.iter().any(|slope| matches!(slope, Slope::Level(along) if self.is_known(walls, at, along)));
        // Just beyond the end of a level passage, which is found from within it.
        let is_beyond = || !at.is_empty(walls);
        Passage::Level(if is_known || is_beyond() { Vec::new() } else { self.passage(walls, at) })
    }

    /// The critical points of a new level passage: none, one, or two if it is closed.
    fn passage(&mut self, walls: &Walls, at: &Opposite) -> Vec<Kind> {
        let t = perpendicular(at.across());
        let (ahead, first) = follow(walls, at, t);
        let (mut passage, ends) = if first == End::Closed {
            (ahead, [End::Closed; 2])
        } else {
            let (behind, second) = follow(walls, at, -t);
            let back = |s: Stretch| Stretch { axis: s.axis.reversed(), ..s };
            (behind.into_iter().rev().map(back).chain(ahead).collect(), [first, second])
        };
        passage.retain(|stretch| stretch.axis.length() > 0.0);
        for stretch in &passage {
            let [a, b] = stretch.along.map(|along| base(&along));
            let (walls_of, shifts) = if a.0 <= b.0 { ([a.0, b.0], [a.1, b.1]) } else { ([b.0, a.0], [b.1, a.1]) };
            self.known.entry(walls_of).or_default().push((shifts, stretch.axis));
        }
        if ends == [End::Closed; 2] {
            let length: f64 = passage.iter().map(|stretch| stretch.axis.length()).sum();
            return [
                opposite_at(walls, &passage, 0.25 * length).map(Kind::Saddle),
                opposite_at(walls, &passage, 0.75 * length).map(Kind::Maximum),
            ]
            .into_iter()
            .flatten()
            .collect();
        }
        let length: f64 = passage.iter().map(|stretch| stretch.axis.length()).sum();
        let middle = opposite_at(walls, &passage, 0.5 * length).unwrap_or(*at);
        decide(ends, &middle).into_iter().collect()
    }

    fn is_known(&self, walls: &Walls, at: &Opposite, along: &[Along; 2]) -> bool {
        // Relative variation of the width of a level passage.
        const NEAR: f64 = 1e-5;
        let [a, b] = along.map(|along| base(&along));
        let (a, b) = if a.0 <= b.0 { (a, b) } else { (b, a) };
        let Some(known) = self.known.get(&[a.0, b.0]) else { return false };
        known.iter().any(|(shifts, axis)| {
            let by = minus(shifts[0], a.1);
            let x = at.center + walls.offset(by);
            minus(shifts[1], b.1) == by && (axis.project(x).point - x).norm() < NEAR * at.half
        })
    }
}

/// The slopes of the wall distance from the midpoint of two opposite points to both sides.
pub(crate) fn slopes(walls: &Walls, at: &Opposite) -> [Slope; 2] {
    let t = perpendicular(at.across());
    [slope(walls, at, t), slope(walls, at, -t)]
}

/// The kind of opposite points off level passages; `None` if they are not critical.
pub(crate) fn decided(walls: &Walls, at: &Opposite) -> Option<Kind> {
    decide(slopes(walls, at).map(|slope| end(&slope)), at)
}

fn base(along: &Along) -> (usize, Shift) {
    match along {
        Along::Piece(link) => (link.wall, link.shift),
        Along::Vertex(contact, _) => (contact.wall, contact.shift),
    }
}

fn end(slope: &Slope) -> End {
    match slope {
        Slope::Rises | Slope::Level(_) => End::Rises,
        Slope::Falls => End::Falls,
        Slope::Open => End::Open,
    }
}

fn decide(ends: [End; 2], at: &Opposite) -> Option<Kind> {
    match ends {
        [End::Falls, End::Falls] => Some(Kind::Maximum(*at)),
        [End::Falls, _] | [_, End::Falls] => None,
        _ => Some(Kind::Saddle(*at)),
    }
}

/// The opposite points at an arc length (m) along a passage.
fn opposite_at(walls: &Walls, passage: &[Stretch], length: f64) -> Option<Opposite> {
    let mut passed = 0.0;
    for (k, stretch) in passage.iter().enumerate() {
        let here = stretch.axis.length();
        if passed + here >= length || k + 1 == passage.len() {
            let x = stretch.axis.point(((length - passed) / here).clamp(0.0, 1.0));
            return Some(Opposite::between(stretch.along.map(|along| contact(walls, &along, x))));
        }
        passed += here;
    }
    None
}

/// The wall point of a level passage nearest to `x` on its axis.
fn contact(walls: &Walls, along: &Along, x: Vec2) -> Contact {
    match *along {
        Along::Vertex(contact, _) => contact,
        Along::Piece(link) => {
            let curve = walls.curve(link.wall, link.shift);
            let u = walls.snapped(&curve, curve.project(x).u);
            walls.at_vertex(Contact { wall: link.wall, shift: link.shift, u, point: curve.point(u) })
        }
    }
}

/// Follows a level passage from opposite points along the unit vector `t` to its end.
fn follow(walls: &Walls, from: &Opposite, t: Vec2) -> (Vec<Stretch>, End) {
    let (mut at, mut t) = (*from, t);
    let mut passed = Vec::new();
    // A passage has at most two sections per piece and image; more indicate a loop caused by rounding.
    for _ in 0..4 * walls.walls.len() + 16 {
        let along = match slope(walls, &at, t) {
            Slope::Level(along) => along,
            other => return (passed, end(&other)),
        };
        let Some(axis) = axis(walls, &at, t, &along) else { return (passed, End::Rises) };
        let (until, hits) = first_hit(walls, &axis, &along, at.half);
        let (until, opens) = match leaving(walls, &axis, until) {
            Some(u) => (u, true),
            None => (until, false),
        };
        let axis = axis.part(0.0, until);
        if let Some(u) = passes(walls, &axis, from, passed.is_empty()) {
            passed.push(Stretch { axis: axis.part(0.0, u), along });
            return (passed, End::Closed);
        }
        passed.push(Stretch { axis, along });
        if opens {
            return (passed, End::Open);
        }
        if hits {
            return (passed, End::Falls);
        }
        let x = axis.point(1.0);
        at = Opposite::between(along.map(|along| contact(walls, &along, x)));
        t = axis.tangent(1.0);
    }
    (passed, End::Closed)
}

/// The parameter at which an axis returns to the start of the passage; the first axis begins there.
fn passes(walls: &Walls, axis: &Curve, from: &Opposite, is_first: bool) -> Option<f64> {
    const NEAR: f64 = 1e-6;
    let near = NEAR * from.half;
    let home = walls.wrapped(axis.point(0.5)).1;
    let begin = walls.wrapped(from.center).0;
    // A section is no longer than a period: if an image lies on it, it is the one nearest to its midpoint.
    let steps = |i: usize| if walls.periodic[i] { -1..=1 } else { 0..=0 };
    let images = steps(0).flat_map(|dx| steps(1).map(move |dy| [home[0] + dx, home[1] + dy]));
    images
        .map(|shift| begin + walls.offset(shift))
        .filter_map(|x| {
            let closest = axis.project(x);
            // The starting point of a closed axis is also its end.
            let u = if is_first && closest.u * axis.length() <= near && axis.is_closed() { 1.0 } else { closest.u };
            let counts = (closest.point - x).norm() <= near && (!is_first || u * axis.length() > near);
            counts.then_some(u)
        })
        .min_by(f64::total_cmp)
}

/// The axis from opposite points along `t` until one of the walls ends.
fn axis(walls: &Walls, at: &Opposite, t: Vec2, along: &[Along; 2]) -> Option<Curve> {
    let center = along.iter().find_map(|along| match along {
        Along::Vertex(contact, _) => Some(contact.point),
        Along::Piece(link) => match walls.curve(link.wall, link.shift) {
            Curve::Arc { center, .. } => Some(center),
            Curve::Segment { .. } => None,
        },
    });
    let Some(center) = center else {
        let length = (0..2).map(|i| remaining(walls, &at.contacts[i], &along[i], t)).fold(f64::INFINITY, f64::min);
        // Between two corners `t` deviates from the direction of the walls by rounding, which a long passage amplifies.
        let tangent = |along: &Along| match along {
            Along::Piece(link) => walls.curve(link.wall, link.shift).tangent(0.5),
            Along::Vertex(..) => t,
        };
        let with_t = |tangent: Vec2| tangent * tangent.dot(&t).signum();
        let direction = along.iter().map(|along| with_t(tangent(along))).sum::<Vec2>().normalize();
        return (length > 0.0).then(|| Curve::Segment { a: at.center, b: at.center + direction * length });
    };
    let spoke = at.center - center;
    let sign = cross(spoke, t).signum();
    let angle = (0..2).map(|i| remaining(walls, &at.contacts[i], &along[i], t)).fold(f64::INFINITY, f64::min);
    let start = spoke.y.atan2(spoke.x);
    let sweep = sign * angle.min(std::f64::consts::TAU);
    (angle > 0.0).then_some(Curve::Arc { center, radius: spoke.norm(), start, sweep })
}

/// Remaining extent of a wall from a contact along `t`: a length in m on a segment, else an angle in rad.
fn remaining(walls: &Walls, contact: &Contact, along: &Along, t: Vec2) -> f64 {
    match *along {
        Along::Vertex(_, angle) => angle,
        Along::Piece(link) => {
            let curve = walls.curve(link.wall, link.shift);
            if curve.is_closed() {
                return std::f64::consts::TAU;
            }
            let own = (contact.wall, contact.shift) == (link.wall, link.shift);
            let is_forward = curve.tangent(if own { contact.u } else { 1.0 }).dot(&t) > 0.0;
            let u = if own { contact.u } else { 1.0 };
            match curve {
                Curve::Segment { a, b } => (if is_forward { b } else { a } - contact.point).norm(),
                Curve::Arc { sweep, .. } => sweep.abs() * if is_forward { 1.0 - u } else { u },
            }
        }
    }
}

/// The first point on an axis beyond which a third wall is nearer than the two walls of the passage, at about `half` (m), as a parameter; 1 and `false` if
/// there is none.
fn first_hit(walls: &Walls, axis: &Curve, along: &[Along; 2], half: f64) -> (f64, bool) {
    // Walls that are parallel within rounding of directions converge over a long passage, which does not end it.
    let of_both =
        |x: Vec2| along.iter().map(|along| (contact(walls, along, x).point - x).norm()).fold(f64::INFINITY, f64::min);
    let middle = axis.point(0.5);
    let reach = 0.5 * axis.length() + half + slack(walls, half);
    let mut parameters = vec![0.0, 1.0];
    for (wall, shift) in walls.within(middle, reach) {
        for offset in offsets(&walls.curve(wall, shift), half) {
            intersections(axis, &offset, walls.tolerance, &mut parameters);
        }
    }
    parameters.sort_by(f64::total_cmp);
    for pair in parameters.windows(2) {
        let shortest = 10.0 * walls.tolerance / axis.length();
        let x = axis.point(0.5 * (pair[0] + pair[1]));
        if pair[1] - pair[0] > shortest && walls.distance(x) < half.min(of_both(x)) - 2.0 * slack(walls, half) {
            return (pair[0], true);
        }
    }
    (1.0, false)
}

/// The curves at a distance (m) from a piece.
fn offsets(curve: &Curve, distance: f64) -> Vec<Curve> {
    let mut found = match *curve {
        Curve::Segment { .. } => vec![curve.shifted(curve.normal(0.5) * distance)],
        Curve::Arc { center, radius, sweep, .. } => {
            let grown = radius + sweep.signum() * distance;
            if grown > 0.0 { vec![Curve::circle(center, grown)] } else { Vec::new() }
        }
    };
    if !curve.is_closed() {
        found.extend([0.0, 1.0].map(|u| Curve::circle(curve.point(u), distance)));
    }
    found
}

/// The first parameter up to `until` at which an axis leaves the domain along a non-periodic direction.
fn leaving(walls: &Walls, axis: &Curve, until: f64) -> Option<f64> {
    let domain = walls.domain;
    let far = domain.grown(domain.size().norm());
    let mut parameters = Vec::new();
    for i in (0..2).filter(|&i| !walls.periodic[i]) {
        for level in [domain.min[i], domain.max[i]] {
            let (mut a, mut b) = (far.min, far.max);
            (a[i], b[i]) = (level, level);
            intersections(axis, &Curve::Segment { a, b }, walls.tolerance, &mut parameters);
        }
    }
    parameters.retain(|&u| u <= until);
    parameters.sort_by(f64::total_cmp);
    parameters.push(until);
    let mut from = 0.0;
    for &to in &parameters {
        let x = axis.point(0.5 * (from + to));
        if to > from && !walls.is_within(x) {
            return Some(from);
        }
        from = to;
    }
    None
}
