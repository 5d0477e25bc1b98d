//! A meniscus: the arc of a circle, or a straight line, between its contacts with two walls.

use crate::geometry::curve::{Curve, cross};
use crate::interface::menisci::crossing::{circle_circle, meetings};
use crate::interface::menisci::wall::Contact;
use crate::math::{Vec2, perpendicular};

/// Arcs of a smaller angle between chord and interface, in rad, count as straight where their circle's center is asked for.
const STRAIGHT: f64 = 1e-6;

/// An interface between two walls, seen in the direction of advance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meniscus {
    /// Signed curvature in 1/m, above 0 where it bulges into the defending phase: capillary pressure over tension.
    pub curvature: f64,
    /// Contact with the left wall.
    pub left: Contact,
    /// Contact with the right wall.
    pub right: Contact,
    /// Signed angle between the chord of both contacts and the interface in rad, half the angle of the arc; more than π/2 in size where
    /// the arc is more than half a circle.
    pub bend: f64,
}

impl Meniscus {
    /// Distance of both contacts in m.
    pub(crate) fn chord(&self) -> f64 {
        (self.right.point - self.left.point).norm()
    }

    /// Center of its circle in m; nothing where it is straight.
    pub(crate) fn center(&self) -> Option<Vec2> {
        let d = self.right.point - self.left.point;
        let tan = self.bend.tan();
        (tan != 0.0)
            .then(|| self.left.point + 0.5 * (d - perpendicular(d) / tan))
            .filter(|c| c.x.is_finite() && c.y.is_finite())
    }

    /// The arc from the left contact to the right one, the defending phase on its left.
    pub(crate) fn curve(&self) -> Curve {
        let d = self.right.point - self.left.point;
        let tangent = nalgebra::Rotation2::new(self.bend) * d.normalize();
        Curve::arc_from_tangent(self.left.point, tangent, self.right.point)
    }

    /// The point at a share of the way from the left contact to the right one.
    pub(crate) fn point(&self, share: f64) -> Vec2 {
        let d = self.right.point - self.left.point;
        // The chord of a share of the arc; of a flat one it is that share.
        let ratio = if self.bend.abs() < 1e-8 { share } else { (share * self.bend).sin() / self.bend.sin() };
        self.left.point + nalgebra::Rotation2::new((1.0 - share) * self.bend) * d * ratio
    }

    /// `count` points from the left contact to the right one, both included.
    pub(crate) fn points(&self, count: usize) -> Vec<Vec2> {
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count).map(|i| self.point(i as f64 / last)).collect()
    }

    /// Area between the arc and its chord in m², above 0 where it bulges into the defending phase.
    pub(crate) fn area_from_chord(&self) -> f64 {
        let b = self.bend;
        // (b − sin b cos b)/sin² b; its series below the size where the difference loses digits.
        let shape = if b.abs() < 1e-3 {
            b * (2.0 / 3.0 + b * b * (4.0 / 45.0))
        } else {
            (b - b.sin() * b.cos()) / b.sin().powi(2)
        };
        0.25 * self.chord().powi(2) * shape
    }

    /// The arc between the same contacts that touches a line ahead through `point` with the normal `inwards`; none where this one does already.
    ///
    /// With the half chord a, its middle at the distance D from the line, the advance at the angle of cosine ν to the way there, and the center s
    /// ahead of the chord: a² + s² = (D − s ν)².
    pub(super) fn grown_to(&self, point: Vec2, inwards: Vec2) -> Option<Self> {
        let (p, q) = (self.left.point, self.right.point);
        let half = 0.5 * self.chord();
        let distance = (0.5 * (p + q) - point).dot(&inwards);
        let ahead = -perpendicular((q - p).try_normalize(0.0)?).dot(&inwards);
        let square = distance * distance - half * half * (1.0 - ahead * ahead);
        let below = distance * ahead + square.max(0.0).sqrt();
        if !(distance > 0.0 && square > 0.0 && below > 0.0) {
            return None;
        }
        let center = (distance * distance - half * half) / below;
        let radius = half.hypot(center);
        let bend = (-center / radius).acos();
        (bend > self.bend).then(|| Self { curvature: 1.0 / radius, bend, ..*self })
    }

    /// The same, but for a point where the meniscus itself stands behind its throat.
    pub(super) fn touches_ahead(&self, curve: &Curve) -> bool {
        meetings(&self.curve(), curve).into_iter().flatten().any(|x| !self.stands_behind_at(x))
    }

    /// Whether a contact behind the throat is at a point. Where solids share a corner, a wall ahead begins there too, on the other side of them.
    pub(super) fn stands_behind_at(&self, x: Vec2) -> bool {
        /// Share of the chord within which points are one; where an arc meets a wall at 0 degrees they are rounded to half of the digits.
        const SAME: f64 = 1e-6;
        let is_at = |contact: &Contact| contact.advance < 0.0 && (contact.point - x).norm() <= SAME * self.chord();
        is_at(&self.left) || is_at(&self.right)
    }

    /// The points that two arcs have in common.
    pub(super) fn meetings(&self, other: &Self) -> [Option<Vec2>; 2] {
        // Circles of nearly flat arcs have no center to reckon with.
        let centers = self.center().zip(other.center());
        let Some((one, two)) = centers.filter(|_| self.bend.abs().min(other.bend.abs()) > STRAIGHT) else {
            return meetings(&self.curve(), &other.curve());
        };
        let [r1, r2] = [(self.left.point - one).norm(), (other.left.point - two).norm()];
        circle_circle(one, r1, two, r2).map(|x| x.filter(|x| self.holds(*x) && other.holds(*x)))
    }

    /// Whether a point of its circle (or line) lies on the arc between both contacts.
    pub(super) fn holds(&self, x: Vec2) -> bool {
        let d = self.right.point - self.left.point;
        let from = x - self.left.point;
        // Of nearly straight arcs the far part of the circle is out of reach.
        if self.bend.abs() < STRAIGHT {
            let along = from.dot(&d);
            return along >= 0.0 && along <= d.norm_squared();
        }
        self.bend * cross(d, from) >= 0.0
    }
}
