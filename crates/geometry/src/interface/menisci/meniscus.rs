//! A meniscus: the arc of a circle, or a straight line, between its contacts with two walls.

use crate::curve::{Curve, cross};
use crate::interface::menisci::crossing::{SLACK, meetings};
use crate::interface::menisci::wall::Contact;
use crate::intersect::circle_circle;
use meniscus_core::math::{Vec2, perpendicular};

/// Arcs with a smaller angle between chord and interface, in rad, are treated as straight where the center of their circle is needed.
const STRAIGHT: f64 = 1e-6;

/// An interface between two walls, viewed in the direction of advance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meniscus {
    /// Signed curvature in 1/m, above 0 where it bulges into the defending phase: capillary pressure over interfacial tension.
    pub curvature: f64,
    /// Contact with the left wall.
    pub left: Contact,
    /// Contact with the right wall.
    pub right: Contact,
    /// Signed angle between the chord of both contacts and the interface in rad, half the central angle of the arc; its magnitude exceeds π/2 if the arc is
    /// more than half a circle.
    pub bend: f64,
}

impl Meniscus {
    /// Distance between both contacts in m.
    pub fn chord(&self) -> f64 {
        (self.right.point - self.left.point).norm()
    }

    /// Center of its circle in m; `None` if it is straight.
    pub(crate) fn center(&self) -> Option<Vec2> {
        let d = self.right.point - self.left.point;
        let tan = self.bend.tan();
        (tan != 0.0)
            .then(|| self.left.point + 0.5 * (d - perpendicular(d) / tan))
            .filter(|c| c.x.is_finite() && c.y.is_finite())
    }

    /// The arc from the left to the right contact, the defending phase on its left.
    pub fn curve(&self) -> Curve {
        let d = self.right.point - self.left.point;
        let tangent = nalgebra::Rotation2::new(self.bend) * d.normalize();
        Curve::arc_from_tangent(self.left.point, tangent, self.right.point)
    }

    /// The point at a fraction of the arc length from the left to the right contact.
    pub(crate) fn point(&self, share: f64) -> Vec2 {
        let d = self.right.point - self.left.point;
        // Chord of a fraction of the arc; for a flat arc equal to that fraction.
        let ratio = if self.bend.abs() < 1e-8 { share } else { (share * self.bend).sin() / self.bend.sin() };
        self.left.point + nalgebra::Rotation2::new((1.0 - share) * self.bend) * d * ratio
    }

    /// `count` points from the left contact to the right one, both included.
    pub fn points(&self, count: usize) -> Vec<Vec2> {
        let last = count.saturating_sub(1).max(1) as f64;
        (0..count).map(|i| self.point(i as f64 / last)).collect()
    }

    /// Area between the arc and its chord in m², above 0 where it bulges into the defending phase.
    pub(crate) fn area_from_chord(&self) -> f64 {
        let b = self.bend;
        // (b − sin b cos b)/sin² b; its series where the difference would lose digits.
        let shape = if b.abs() < 1e-3 {
            b * (2.0 / 3.0 + b * b * (4.0 / 45.0))
        } else {
            (b - b.sin() * b.cos()) / b.sin().powi(2)
        };
        0.25 * self.chord().powi(2) * shape
    }

    /// The arc between the same contacts that is tangent to a line ahead through `point` with the normal `inwards`; `None` if this one touches it already.
    ///
    /// With the half chord a, its midpoint at the distance D from the line, ν the cosine between the advance and the direction to the line, and the center s
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

    /// Whether it touches a curve elsewhere than at one of its own contacts behind the throat.
    pub(super) fn touches_ahead(&self, curve: &Curve) -> bool {
        meetings(&self.curve(), curve).into_iter().flatten().any(|x| !self.lies_behind_at(x))
    }

    /// Whether a contact behind the throat is at a point. Where solids share a corner, a wall ahead starts there too, on their other side.
    pub(super) fn lies_behind_at(&self, x: Vec2) -> bool {
        /// Fraction of the chord within which points coincide; where an arc meets a wall at 0 degrees only half of the digits are accurate.
        const SAME: f64 = 1e-6;
        let is_at = |contact: &Contact| contact.advance < 0.0 && (contact.point - x).norm() <= SAME * self.chord();
        is_at(&self.left) || is_at(&self.right)
    }

    /// The intersections of two arcs.
    pub(super) fn meetings(&self, other: &Self) -> [Option<Vec2>; 2] {
        // Circles of nearly flat arcs have no usable center.
        let centers = self.center().zip(other.center());
        let Some((one, two)) = centers.filter(|_| self.bend.abs().min(other.bend.abs()) > STRAIGHT) else {
            return meetings(&self.curve(), &other.curve());
        };
        let [r1, r2] = [(self.left.point - one).norm(), (other.left.point - two).norm()];
        circle_circle(one, r1, two, r2, SLACK).map(|x| x.filter(|x| self.contains(*x) && other.contains(*x)))
    }

    /// Whether a point of its circle (or line) lies on the arc between both contacts.
    pub(super) fn contains(&self, x: Vec2) -> bool {
        let d = self.right.point - self.left.point;
        let from = x - self.left.point;
        // The far part of the circle of a nearly straight arc is out of range.
        if self.bend.abs() < STRAIGHT {
            let along = from.dot(&d);
            return along >= 0.0 && along <= d.norm_squared();
        }
        self.bend * cross(d, from) >= 0.0
    }
}
