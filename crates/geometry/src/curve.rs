//! Oriented segments and circular arcs, the pieces of all walls: solid on the left, pore on the right.
//!
//! Points are given by a parameter `u` from 0 (start) to 1 (end). A full circle is an arc that ends at its start.

use std::f64::consts::{FRAC_PI_2, TAU};

use meniscus_core::math::{Bounds, Vec2, perpendicular};

/// A segment or an arc, solid on the left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curve {
    /// A straight piece.
    Segment {
        /// Start in m.
        a: Vec2,
        /// End in m.
        b: Vec2,
    },
    /// A circular arc, counter-clockwise (convex solid) if `sweep` is above 0.
    Arc {
        /// Center in m.
        center: Vec2,
        /// Radius in m.
        radius: f64,
        /// Polar angle of the start in rad.
        start: f64,
        /// Signed angle from start to end in rad, at most 2π in magnitude.
        sweep: f64,
    },
}

/// The nearest point of a curve.
#[derive(Debug, Clone, Copy)]
pub struct ClosestPoint {
    /// Parameter, 0 to 1; exactly 0 or 1 if the nearest point is an end.
    pub u: f64,
    /// Position in m.
    pub point: Vec2,
}

/// The unit vector at the polar angle `angle` in rad.
pub fn unit(angle: f64) -> Vec2 {
    Vec2::new(angle.cos(), angle.sin())
}

/// The z component of the cross product.
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

impl Curve {
    /// A full circle: the surface of a disc.
    pub fn circle(center: Vec2, radius: f64) -> Self {
        Self::Arc { center, radius, start: 0.0, sweep: TAU }
    }

    /// The arc that leaves `a` along the unit tangent `t` and ends at `b`; a segment if it is straight.
    pub(crate) fn arc_from_tangent(a: Vec2, t: Vec2, b: Vec2) -> Self {
        // A bend below this (sagitta / chord) is lost in the rounding of the center.
        const STRAIGHT: f64 = 1e-7;
        let chord = b - a;
        let bend = cross(t, chord);
        if bend.abs() < STRAIGHT * chord.norm() {
            return Self::Segment { a, b };
        }
        let center = a + perpendicular(t) * (chord.norm_squared() / (2.0 * bend));
        let from = a - center;
        Self::Arc { center, radius: from.norm(), start: from.y.atan2(from.x), sweep: 2.0 * bend.atan2(t.dot(&chord)) }
    }

    /// The edge from `a` to `b` with the given bulge, the tangent of a quarter of its signed angle; a segment if it is 0.
    pub fn from_bulge(a: Vec2, b: Vec2, bulge: f64) -> Self {
        let angle = 2.0 * bulge.atan();
        Self::arc_from_tangent(a, nalgebra::Rotation2::new(-angle) * (b - a).normalize(), b)
    }

    /// Its representation by numbers: both ends of a segment, or center, radius, start and sweep of an arc.
    pub fn numbers(&self) -> Vec<f64> {
        match *self {
            Self::Segment { a, b } => vec![a.x, a.y, b.x, b.y],
            Self::Arc { center, radius, start, sweep } => vec![center.x, center.y, radius, start, sweep],
        }
    }

    /// The curve of these [`numbers`](Self::numbers); `None` if there is no such curve.
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        if !numbers.iter().all(|number| number.is_finite()) {
            return None;
        }
        match *numbers {
            [ax, ay, bx, by] => Some(Self::Segment { a: Vec2::new(ax, ay), b: Vec2::new(bx, by) }),
            [x, y, radius, start, sweep] if radius > 0.0 && sweep.abs() <= TAU => {
                Some(Self::Arc { center: Vec2::new(x, y), radius, start, sweep })
            }
            _ => None,
        }
    }

    /// Whether this is a full circle, which has no ends.
    pub fn is_closed(&self) -> bool {
        // Only exact circles are constructed with this sweep.
        matches!(self, Self::Arc { sweep, .. } if sweep.abs() >= TAU)
    }

    /// Length in m.
    pub fn length(&self) -> f64 {
        match self {
            Self::Segment { a, b } => (b - a).norm(),
            Self::Arc { radius, sweep, .. } => radius * sweep.abs(),
        }
    }

    /// The point at `u`.
    pub fn point(&self, u: f64) -> Vec2 {
        match self {
            Self::Segment { a, b } => a + (b - a) * u,
            Self::Arc { center, radius, start, sweep } => center + unit(start + sweep * u) * *radius,
        }
    }

    /// Its start with its bulge.
    pub fn vertex(&self) -> [f64; 3] {
        let bulge = if let Self::Arc { sweep, .. } = self { (0.25 * sweep).tan() } else { 0.0 };
        let start = self.point(0.0);
        [start.x, start.y, bulge]
    }

    /// The unit tangent at `u`.
    pub fn tangent(&self, u: f64) -> Vec2 {
        match self {
            Self::Segment { a, b } => (b - a).try_normalize(0.0).unwrap_or_else(Vec2::x),
            Self::Arc { start, sweep, .. } => perpendicular(unit(start + sweep * u)) * sweep.signum(),
        }
    }

    /// The unit normal at `u`, out of the solid.
    pub fn normal(&self, u: f64) -> Vec2 {
        -perpendicular(self.tangent(u))
    }

    /// The nearest point to `x`. The center of an arc is equidistant from all its points: the midpoint is returned.
    pub fn project(&self, x: Vec2) -> ClosestPoint {
        #[cfg(test)]
        work::count();
        match *self {
            Self::Segment { a, b } => {
                let d = b - a;
                let u = ((x - a).dot(&d) / d.norm_squared()).clamp(0.0, 1.0);
                // An exact end keeps shared vertices recognizable.
                let point = if u == 1.0 { b } else { a + d * u };
                ClosestPoint { u, point }
            }
            Self::Arc { center, radius, start, sweep } => {
                let r = x - center;
                let distance = r.norm();
                if distance == 0.0 {
                    return ClosestPoint { u: 0.5, point: self.point(0.5) };
                }
                let angle = r.y.atan2(r.x);
                let turned = ((angle - start) * sweep.signum()).rem_euclid(TAU) / sweep.abs();
                if turned <= 1.0 {
                    return ClosestPoint { u: turned, point: center + r * (radius / distance) };
                }
                // The nearer end is the one at the smaller angle.
                let (past_end, before_start) = (turned - 1.0, TAU / sweep.abs() - turned);
                let u = if before_start <= past_end { 0.0 } else { 1.0 };
                ClosestPoint { u, point: self.point(u) }
            }
        }
    }

    /// The smallest box around the curve.
    pub fn bounds(&self) -> Bounds {
        #[cfg(test)]
        work::count();
        let (p, q) = (self.point(0.0), self.point(1.0));
        let mut bounds = Bounds { min: p.inf(&q), max: p.sup(&q) };
        if let Self::Arc { center, radius, start, sweep } = *self {
            for (k, direction) in [Vec2::x(), Vec2::y(), -Vec2::x(), -Vec2::y()].into_iter().enumerate() {
                let turned = (FRAC_PI_2 * k as f64 - start) * sweep.signum();
                if turned.rem_euclid(TAU) <= sweep.abs() {
                    let extreme = center + direction * radius;
                    bounds.min = bounds.min.inf(&extreme);
                    bounds.max = bounds.max.sup(&extreme);
                }
            }
        }
        bounds
    }

    /// A box around the curve: of an arc that of its whole circle, which takes less time than [`Self::bounds`].
    pub fn enclosing_box(&self) -> Bounds {
        match *self {
            Self::Segment { a, b } => Bounds { min: a.inf(&b), max: a.sup(&b) },
            Self::Arc { center, radius, .. } => {
                Bounds { min: center.add_scalar(-radius), max: center.add_scalar(radius) }
            }
        }
    }

    /// The piece between two parameters; `to` may exceed 1 on a full circle.
    pub fn part(&self, from: f64, to: f64) -> Self {
        match *self {
            Self::Segment { .. } => Self::Segment { a: self.point(from), b: self.point(to) },
            Self::Arc { center, radius, start, sweep } => {
                Self::Arc { center, radius, start: start + sweep * from, sweep: sweep * (to - from) }
            }
        }
    }

    /// The same points in reverse order: solid and pore are exchanged.
    pub fn reversed(&self) -> Self {
        match *self {
            Self::Segment { a, b } => Self::Segment { a: b, b: a },
            Self::Arc { center, radius, start, sweep } => {
                Self::Arc { center, radius, start: start + sweep, sweep: -sweep }
            }
        }
    }

    /// The curve shifted by `by`.
    pub fn shifted(&self, by: Vec2) -> Self {
        match *self {
            Self::Segment { a, b } => Self::Segment { a: a + by, b: b + by },
            Self::Arc { center, radius, start, sweep } => Self::Arc { center: center + by, radius, start, sweep },
        }
    }

    /// The curve rotated by `angle` (rad) about the origin, then shifted by `by`.
    pub fn placed(&self, angle: f64, by: Vec2) -> Self {
        let turn = |v: Vec2| nalgebra::Rotation2::new(angle) * v + by;
        match *self {
            Self::Segment { a, b } => Self::Segment { a: turn(a), b: turn(b) },
            Self::Arc { center, radius, start, sweep } => {
                Self::Arc { center: turn(center), radius, start: start + angle, sweep }
            }
        }
    }

    /// The signed angle in rad that the curve subtends at `x`; over a closed outline 2π times its winding number.
    pub fn winding(&self, x: Vec2) -> f64 {
        let (a, b) = (self.point(0.0) - x, self.point(1.0) - x);
        let chord = cross(a, b).atan2(a.dot(&b));
        let Self::Arc { center, radius, sweep, .. } = *self else { return chord };
        if self.is_closed() {
            return if (x - center).norm() < radius { sweep } else { 0.0 };
        }
        // From a point between chord and arc the arc subtends an angle opposite in sign to that of its chord. The sign is that of the angle, which is valid
        // on the chord too, where the cross product is a zero of either sign.
        let is_between = (x - center).norm() < radius && chord * sweep < 0.0;
        if is_between { chord + sweep.signum() * TAU } else { chord }
    }

    /// ½ ∫ (x dy − y dx) about `origin`, in m²: summed over a closed outline it is the area on its left (Green).
    pub fn area_about(&self, origin: Vec2) -> f64 {
        match *self {
            Self::Segment { a, b } => 0.5 * cross(a - origin, b - origin),
            Self::Arc { center, radius, sweep, .. } => {
                let chord = self.point(1.0) - self.point(0.0);
                0.5 * (radius * radius * sweep + cross(center - origin, chord))
            }
        }
    }
}

/// Counts operations on curves, so that tests can measure how the work grows with their number.
#[cfg(test)]
pub(crate) mod work {
    use std::cell::Cell;

    thread_local! {
        static DONE: Cell<u64> = const { Cell::new(0) };
    }

    pub(crate) fn count() {
        DONE.set(DONE.get() + 1);
    }

    /// Bounding boxes and nearest points of curves computed by this thread during `job`.
    pub(crate) fn of(job: impl FnOnce()) -> u64 {
        let before = DONE.get();
        job();
        DONE.get() - before
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_of_a_whole_circle_holds_each_of_its_arcs() {
        let circle = |start, sweep| Curve::Arc { center: Vec2::new(1.0, -2.0), radius: 0.7, start, sweep };
        let arcs = (0..24).map(|k| circle(f64::from(k) * 0.3, f64::from(k - 12) * 0.5));
        for curve in arcs.chain([Curve::Segment { a: Vec2::new(2.0, 1.0), b: Vec2::new(-1.0, 3.0) }]) {
            let whole = curve.enclosing_box().grown(5e-16);
            assert_eq!(whole.united(&curve.bounds()), whole, "{curve:?}");
        }
    }

    #[test]
    fn an_arc_from_a_tangent_ends_where_it_should() {
        let (a, t, b) = (Vec2::new(1.0, 2.0), unit(0.3), Vec2::new(2.0, 1.5));
        let arc = Curve::arc_from_tangent(a, t, b);
        assert!((arc.point(0.0) - a).norm() < 1e-14);
        assert!((arc.point(1.0) - b).norm() < 1e-14);
        assert!((arc.tangent(0.0) - t).norm() < 1e-14);
    }

    #[test]
    fn a_circle_encloses_its_area_and_its_box() {
        let circle = Curve::circle(Vec2::new(3.0, -1.0), 2.0);
        assert!((circle.area_about(Vec2::zeros()) - 2.0 * TAU).abs() < 1e-12);
        let bounds = circle.bounds();
        assert!((bounds.min - Vec2::new(1.0, -3.0)).norm() < 1e-12);
        assert!((bounds.max - Vec2::new(5.0, 1.0)).norm() < 1e-12);
    }

    #[test]
    fn the_normal_of_a_counter_clockwise_circle_points_outwards() {
        let circle = Curve::circle(Vec2::zeros(), 2.0);
        assert!((circle.normal(0.1) - unit(0.1 * TAU)).norm() < 1e-14);
        assert!((circle.reversed().normal(0.1) + circle.reversed().point(0.1) / 2.0).norm() < 1e-14);
    }

    #[test]
    fn the_nearest_point_of_an_arc_may_be_an_end() {
        let arc = Curve::Arc { center: Vec2::zeros(), radius: 1.0, start: 0.0, sweep: TAU / 4.0 };
        let closest = arc.project(Vec2::new(0.5, -1.0));
        assert_eq!(closest.u, 0.0);
        assert!((closest.point - Vec2::x()).norm() < 1e-15);
    }
}
