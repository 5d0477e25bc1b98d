//! The channel of a throat: of constant width, straight from pore center to pore center, or in two straight parts that meet in the middle of the throat.
//!
//! Where two parts meet, the channel turns around its inner corner, with an arc as its outer wall, so that the width stays the same.

use crate::import::drawing::{FillRule, Outline, Ring};
use crate::import::network::model::{Network, Throat};
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::curve::cross;

/// Angles in rad below which a channel is straight.
const STRAIGHT: f64 = 1e-6;

/// The channel of a throat or an opening.
#[derive(Debug, Clone)]
pub(super) struct Channel {
    /// Its outline, counter-clockwise.
    ring: Ring,
    /// The parts of its center line.
    pub(super) parts: Vec<[Vec2; 2]>,
    /// Half of its width in m.
    pub(super) half: f64,
    /// The middle of its narrow part.
    pub(super) neck: Vec2,
}

impl Channel {
    /// Its shape.
    pub(super) fn outline(&self) -> Outline {
        Outline::Area { rings: vec![self.ring.clone()], rule: FillRule::EvenOdd }
    }

    /// A straight channel.
    pub(super) fn straight(ends: [Vec2; 2], half: f64, neck: Vec2) -> Self {
        let [a, b] = ends;
        let across = perpendicular((b - a).normalize()) * half;
        let ring =
            Ring { vertices: [a - across, b - across, b + across, a + across].map(|p| [p.x, p.y, 0.0]).to_vec() };
        Self { ring, parts: vec![ends], half, neck }
    }

    /// A channel through `middle`; `None` if it is straight, or too short for its turn.
    fn bent([a, b]: [Vec2; 2], middle: Vec2, half: f64) -> Option<Self> {
        let [before, after] = [middle - a, b - middle];
        let (u, v) = (before.normalize(), after.normalize());
        let turn = cross(u, v).atan2(u.dot(&v));
        // From the middle to where the turn begins.
        let tangent = half * (0.5 * turn.abs()).tan();
        if !(turn.abs() > STRAIGHT && tangent < before.norm().min(after.norm())) {
            return None;
        }
        let side = turn.signum();
        let (left, right) = (perpendicular(u) * half, perpendicular(v) * half);
        let (from, to) = (middle - u * tangent, middle + v * tangent);
        let inner = from + left * side;
        let [start, end] = [from - left * side, to - right * side];
        let at = |p: Vec2, bulge: f64| [p.x, p.y, bulge];
        let bulge = (0.25 * turn).tan();
        let turning = if side > 0.0 { vec![at(start, bulge), at(end, 0.0)] } else { vec![at(inner, 0.0)] };
        let back = if side > 0.0 { vec![at(inner, 0.0)] } else { vec![at(end, -bulge), at(start, 0.0)] };
        let mut vertices = vec![at(a - left, 0.0)];
        vertices.extend(turning);
        vertices.extend([at(b - right, 0.0), at(b + right, 0.0)]);
        vertices.extend(back);
        vertices.push(at(a + left, 0.0));
        Some(Self { ring: Ring { vertices }, parts: vec![[a, middle], [middle, b]], half, neck: middle })
    }
}

/// The channel of a throat between two pores.
pub(super) fn of_throat(network: &Network, throat: &Throat) -> Channel {
    let ends = network.ends(throat);
    let half = 0.5 * throat.width;
    let bent = throat.middle.and_then(|middle| Channel::bent(ends, middle, half));
    bent.unwrap_or_else(|| {
        // The middle of what the discs of the pores leave.
        let [a, b] = ends;
        let length = (b - a).norm();
        let [first, second] = throat.pores.map(|pore| network.pores[pore].radius);
        let along = (0.5 * (length + first - second)).clamp(0.0, length);
        Channel::straight(ends, half, a + (b - a) * (along / length))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::body::bulged_ring;
    use meniscus_geometry::curve::Curve;

    #[test]
    fn a_bent_channel_keeps_its_width_through_the_turn_to_either_side() {
        let (a, middle) = (Vec2::new(-3.0, 1.0), Vec2::new(0.0, 0.5));
        for b in [Vec2::new(2.0, 3.0), Vec2::new(2.5, -2.0), Vec2::new(-0.5, 3.0)] {
            let channel = Channel::bent([a, b], middle, 0.2).unwrap();
            assert!(channel.ring.area() > 0.0);
            let curves: Vec<Curve> = bulged_ring(&channel.ring.vertices).collect();
            let arcs: Vec<&Curve> = curves.iter().filter(|curve| matches!(curve, Curve::Arc { .. })).collect();
            let [Curve::Arc { center, radius, .. }] = arcs[..] else { panic!("{curves:?}") };
            // The inner corner is the center of the arc, one width from it; walls join the arc smoothly.
            assert!((radius - 0.4).abs() < 1e-14);
            assert!(channel.ring.vertices.iter().any(|v| (Vec2::new(v[0], v[1]) - center).norm() < 1e-14));
            let at = curves.iter().position(|curve| std::ptr::eq(curve, arcs[0])).unwrap();
            for (one, next) in [(at - 1, at), (at, at + 1)] {
                assert!((curves[one].tangent(1.0) - curves[next].tangent(0.0)).norm() < 1e-12);
            }
            let length: f64 = channel.parts.iter().map(|[a, b]| (b - a).norm()).sum();
            // Two rectangles, and a sector between them.
            let turn = arcs[0].length() / 0.4;
            let exact = 0.4 * (length - 2.0 * 0.2 * (0.5 * turn).tan()) + 0.5 * turn * 0.4 * 0.4;
            assert!((channel.ring.area() - exact).abs() < 1e-13, "{} {exact}", channel.ring.area());
        }
    }

    #[test]
    fn a_channel_without_room_for_its_turn_is_refused_as_bent() {
        let ends = [Vec2::new(-1.0, 0.0), Vec2::new(-1.0, 0.2)];
        assert!(Channel::bent(ends, Vec2::zeros(), 0.3).is_none());
        assert!(Channel::bent([Vec2::new(-1.0, 0.0), Vec2::new(1.0, 0.0)], Vec2::zeros(), 0.3).is_none());
        assert!(Channel::bent(ends, ends[0], 0.3).is_none());
    }
}
