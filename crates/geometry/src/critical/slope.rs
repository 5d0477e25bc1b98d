//! Variation of the wall distance along the medial axis from the midpoint of two opposite wall points.
//!
//! With the signed curvatures k (convex solid above 0) of the walls towards that side and half their distance h, twice the distance along the axis has the
//! second derivative k₁ / (1 + k₁ h) + k₂ / (1 + k₂ h), where a vertex counts as k → ∞. A third wall point at the same distance makes it decrease
//! immediately. If the sum vanishes the passage is level.

use crate::critical::opposite::{Opposite, SAME_DIRECTION, SAME_DISTANCE, TIE, slack};
use crate::critical::walls::{Contact, Link, Sides, Walls};
use crate::curve::Curve;
use meniscus_core::math::{Vec2, perpendicular};

/// The wall of a level passage on one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Along {
    Piece(Link),
    /// A vertex, about which the passage rotates by at most this angle in rad.
    Vertex(Contact, f64),
}

/// Variation of the wall distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Slope {
    /// It increases.
    Rises,
    /// It decreases.
    Falls,
    /// The domain ends there.
    Open,
    /// It is constant, along these two walls.
    Level([Along; 2]),
}

/// The variation of the wall distance from the midpoint of opposite points along the unit vector `t`, normal to the line between them.
pub(crate) fn slope(walls: &Walls, at: &Opposite, t: Vec2) -> Slope {
    if leaves(walls, at.center, t) {
        return Slope::Open;
    }
    let across = at.across();
    let slack = slack(walls, at.half);
    // A wall ahead is reached after its excess distance over the cosine of its direction.
    let blocks = |contact: &Contact| {
        let v = contact.point - at.center;
        let distance = v.norm();
        let ahead = v.dot(&t) / distance;
        ahead > 0.0 && at.leads_elsewhere(v / distance) && distance - at.half <= (TIE * at.half * ahead).max(slack)
    };
    if walls.contacts(at.center, at.half * (1.0 + TIE) + slack).iter().any(blocks) {
        return Slope::Falls;
    }
    let sides = [side(walls, &at.contacts[0], across, t), side(walls, &at.contacts[1], -across, t)];
    let [Some((first, k1)), Some((second, k2))] = sides.map(|side| bend(side, at.half)) else { return Slope::Falls };
    if (k1 + k2).abs() > SAME_DISTANCE.max(SAME_DIRECTION * k1.abs()) {
        return if k1 + k2 > 0.0 { Slope::Rises } else { Slope::Falls };
    }
    Slope::Level([first, second])
}

/// The wall, and its contribution k h / (1 + k h) to the second derivative; `None` if it turns towards the pore.
fn bend(side: Side, half: f64) -> Option<(Along, f64)> {
    match side {
        Side::Towards => None,
        Side::Away(contact, angle) => Some((Along::Vertex(contact, angle), 1.0)),
        Side::Smooth(_, k) if 1.0 + k * half <= SAME_DIRECTION => None,
        Side::Smooth(link, k) => Some((Along::Piece(link), k * half / (1.0 + k * half))),
    }
}

/// Continuation of a wall from a contact.
enum Side {
    /// It turns towards the pore.
    Towards,
    /// It turns away by this angle in rad; the contact stays at the vertex.
    Away(Contact, f64),
    /// It continues along a piece of this signed curvature in 1/m.
    Smooth(Link, f64),
}

fn side(walls: &Walls, contact: &Contact, normal: Vec2, t: Vec2) -> Side {
    let is_forward = t.dot(&perpendicular(normal)) > 0.0;
    let [before, after] = walls.around(contact);
    let Some(link) = (if is_forward { after } else { before }) else {
        // The wall is cut there: its straight continuation turns away.
        return Side::Away(*contact, std::f64::consts::FRAC_PI_2);
    };
    let curve = walls.curve(link.wall, link.shift);
    let is_within = curve.is_closed() || (contact.u > 0.0 && contact.u < 1.0);
    let direction = match is_forward {
        _ if is_within => t,
        true => curve.tangent(0.0),
        false => -curve.tangent(1.0),
    };
    let away = (-direction.dot(&normal)).atan2(direction.dot(&t));
    if away > SAME_DIRECTION {
        Side::Away(*contact, away)
    } else if away < -SAME_DIRECTION {
        Side::Towards
    } else {
        Side::Smooth(link, curvature(&curve))
    }
}

/// The signed curvature of a wall in 1/m, above 0 if the solid is convex.
pub fn curvature(curve: &Curve) -> f64 {
    match *curve {
        Curve::Segment { .. } => 0.0,
        Curve::Arc { radius, sweep, .. } => sweep.signum() / radius,
    }
}

/// Whether a step along `t` from `x` leaves the domain through a side that is neither periodic nor a wall.
fn leaves(walls: &Walls, x: Vec2, t: Vec2) -> bool {
    let y = walls.wrapped(x).0;
    (0..2).filter(|&i| !walls.periodic[i]).any(|i| {
        (t[i] > SAME_DIRECTION && y[i] > walls.domain.max[i] - walls.tolerance)
            || (t[i] < -SAME_DIRECTION && y[i] < walls.domain.min[i] + walls.tolerance)
    })
}

/// Whether both points lie on one side at which walls are cut: the gap between them is an opening, not a throat.
pub(crate) fn is_opening(walls: &Walls, at: &Opposite) -> bool {
    let on = |i: usize, level: f64| at.contacts.iter().all(|c| (c.point[i] - level).abs() <= 10.0 * walls.tolerance);
    walls.sides == Sides::Cut
        && (0..2).filter(|&i| !walls.periodic[i]).any(|i| on(i, walls.domain.min[i]) || on(i, walls.domain.max[i]))
}
