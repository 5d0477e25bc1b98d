//! First contact of an advancing meniscus with a third wall: circles under three conditions, in closed form.

use std::f64::consts::PI;

use crate::curve::Curve;
use crate::interface::menisci::circle::{Circle, Condition, circles, meets_round, meets_straight, roots};
use crate::interface::menisci::path::{Contacts, Leg, Walls, meets};
use crate::interface::menisci::wall::{Shape, wrapped};
use meniscus_core::math::{Bounds, Vec2};

/// A wall that a meniscus may touch, lengths over the throat width.
pub(super) struct Obstacle {
    curves: Vec<(Curve, Bounds)>,
}

/// Fraction of a piece by which a point of tangency may lie outside it by rounding. Corners between pieces are tested separately.
const SLACK: f64 = 1e-9;

impl Obstacle {
    pub(crate) fn new(curves: &[Curve], origin: Vec2, scale: f64) -> Self {
        let local = |curve: &Curve| match *curve {
            Curve::Segment { a, b } => Curve::Segment { a: (a - origin) / scale, b: (b - origin) / scale },
            Curve::Arc { center, radius, start, sweep } => {
                Curve::Arc { center: (center - origin) / scale, radius: radius / scale, start, sweep }
            }
        };
        Self { curves: curves.iter().map(local).map(|curve| (curve, curve.bounds())).collect() }
    }

    /// The position of the meniscus at first contact along a leg, and its curvature.
    pub(crate) fn first_contacts(&self, walls: &Walls, leg: &Leg) -> Option<(Contacts, f64)> {
        let boxed = swept_box(walls, leg);
        let mut first: Option<(f64, Contacts, f64)> = None;
        for (curve, bounds) in &self.curves {
            if (0..2).any(|i| bounds.max[i] < boxed.min[i] || boxed.max[i] < bounds.min[i]) {
                continue;
            }
            let ends = if curve.is_closed() {
                [None, None]
            } else {
                [0.0, 1.0].map(|u| Some(meets_round(curve.point(u), 0.0, 1.0)))
            };
            let conditions = [Some(touches(curve)), ends[0], ends[1]];
            for (which, condition) in conditions.into_iter().enumerate() {
                let Some(condition) = condition else { continue };
                for (contacts, circle) in candidates(walls, leg, condition) {
                    let meniscus = walls.meniscus(&walls.station(contacts));
                    let point = match which {
                        0 => touching_point(curve, &circle),
                        end => Some(curve.point(end as f64 - 1.0)),
                    };
                    if point.is_some_and(|point| meniscus.contains(point) && !meniscus.lies_behind_at(point)) {
                        let order = order_on(leg, &contacts);
                        if first.is_none_or(|(earliest, ..)| order < earliest) {
                            first = Some((order, contacts, circle.k));
                        }
                    }
                }
            }
        }
        first.map(|(_, contacts, k)| (contacts, k))
    }
}

/// A bounding box of all menisci of a leg.
fn swept_box(walls: &Walls, leg: &Leg) -> Bounds {
    let [a, b] = [leg.start, leg.end].map(|station| walls.meniscus(&station).curve().bounds());
    let both = Bounds { min: a.min.inf(&b.min), max: a.max.sup(&b.max) };
    // Arcs in between may protrude by the bulge of the walls.
    both.grown(0.25 * both.size().norm())
}

/// The distance of a position along a leg, for comparison.
fn order_on(leg: &Leg, contacts: &Contacts) -> f64 {
    let share = |x: f64, a: f64, b: f64| if a == b { 0.0 } else { (x - a) / (b - a) };
    let (start, end) = (leg.start.contacts, leg.end.contacts);
    share(contacts.left.1, start.left.1, end.left.1).max(share(contacts.right.1, start.right.1, end.right.1))
}

/// The menisci of a leg that satisfy one more condition.
fn candidates(walls: &Walls, leg: &Leg, condition: Condition) -> Vec<(Contacts, Circle)> {
    let Contacts { left: (i, _), right: (j, _) } = leg.end.contacts;
    let (l, r) = (&walls.left[i], &walls.right[j]);
    if matches!((l.shape, r.shape), (Shape::Straight { .. }, Shape::Straight { .. })) {
        return between_lines(walls, leg, condition);
    }
    let found = circles([meets(l), meets(r), condition]).into_iter().flatten();
    found.filter_map(|circle| Some((walls.contacts_on(leg, &circle)?, circle))).collect()
}

/// Between straight walls β is constant and the chord is linear in the fraction along the leg: the condition times the chord is quadratic in it.
fn between_lines(walls: &Walls, leg: &Leg, condition: Condition) -> Vec<(Contacts, Circle)> {
    let value = |share: f64| {
        let station = walls.station(walls.share(leg, share));
        let circle = walls.circle(&station);
        let sum =
            condition[0] * circle.x.x + condition[1] * circle.x.y + condition[2] * circle.y + condition[3] * circle.k;
        (sum - condition[4]) * walls.meniscus(&station).chord()
    };
    let (f0, f1, f2) = (value(0.0), value(0.5), value(1.0));
    let (a, b, c) = (2.0 * (f0 - 2.0 * f1 + f2), 4.0 * f1 - 3.0 * f0 - f2, f0);
    let shares = roots(a, 0.5 * b, c, 0.0).into_iter().flatten();
    shares
        .filter(|share| (-SLACK..=1.0 + SLACK).contains(share))
        .map(|share| {
            let station = walls.station(walls.share(leg, share.clamp(0.0, 1.0)));
            (station.contacts, walls.circle(&station))
        })
        .collect()
}

/// The condition to be tangent to a curve.
fn touches(curve: &Curve) -> Condition {
    match *curve {
        Curve::Segment { a, .. } => meets_straight(a, curve.normal(0.5), 1.0),
        Curve::Arc { center, radius, sweep, .. } => meets_round(center, radius * sweep.signum(), 1.0),
    }
}

/// The point of tangency of a circle with the line or circle of a curve, if it lies on the curve.
fn touching_point(curve: &Curve, circle: &Circle) -> Option<Vec2> {
    match *curve {
        Curve::Segment { a, b } => {
            // The wall normal points from the point of tangency to the center: t·X = k t·x.
            let along = b - a;
            let square = along.norm_squared();
            let u = if circle.k.abs() * square.sqrt() > 1e-9 {
                (along.dot(&circle.x) / circle.k - along.dot(&a)) / square
            } else {
                return None;
            };
            (-SLACK..=1.0 + SLACK).contains(&u).then(|| a + along * u)
        }
        Curve::Arc { center, radius, start, sweep } => {
            let signed = radius * sweep.signum();
            let toward = (circle.x - center * circle.k) * (circle.k * signed + 1.0).signum();
            let normal = toward.y.atan2(toward.x);
            let polar = if sweep < 0.0 { normal + PI } else { normal };
            let u = 0.5 + wrapped(polar - start - 0.5 * sweep) / sweep;
            (-SLACK..=1.0 + SLACK).contains(&u).then(|| center + crate::curve::unit(polar) * radius)
        }
    }
}
