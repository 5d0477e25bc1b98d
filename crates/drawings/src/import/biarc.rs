//! Smooth curves as chains of circular arcs: pairs of arcs (biarcs) that interpolate points and tangents of the curve, bisected to a tolerance. Neighbors
//! share their tangents, so that the chain has corners only where the curve has them.
//!
//! Source: Bolton, Biarc curves, Computer-Aided Design 7 (1975) 89-92; the pair with control arms of equal length. The distance from the curve is of third
//! order in the length of a piece, that of the curvature of first order.

use meniscus_core::math::Vec2;
use meniscus_geometry::curve::cross;

/// Distance of a chain from its curve over the size of the curve.
pub(crate) const TOLERANCE: f64 = 1e-5;
/// Maximum number of bisections of a piece; third-order convergence reaches the rounding of coordinates with far fewer, except at a cusp.
const DEEPEST: u32 = 16;
/// Rounding of distances over the coordinates.
const ROUNDING: f64 = 1e-13;
/// Largest bulge of one arc, that of a quarter circle: beyond, samples of a piece could lie on the wrong side of a circle.
const LARGEST_BULGE: f64 = 0.42;
/// Bulge below which an edge is straight: the sagitta is half of this times the chord.
const STRAIGHT: f64 = 1e-9;
/// Number of points of a piece that are compared with its arcs.
const SAMPLES: usize = 7;

/// A curve with a tangent at each parameter.
pub(crate) trait SmoothCurve {
    /// The point at `t`.
    fn point(&self, t: f64) -> Vec2;
    /// The unit tangent at `t` of the piece after it (`side` 1) or before it (`side` -1); zero if there is none.
    fn tangent(&self, t: f64, side: f64) -> Vec2;
}

/// Appends the chain for `curve` from `from` to `to` to `vertices`, as x, y and bulge: the start of each arc, without the last end. `size` is that of the
/// whole curve.
pub(crate) fn append(curve: &impl SmoothCurve, from: f64, to: f64, size: f64, vertices: &mut Vec<[f64; 3]>) {
    let (a, b) = (curve.point(from), curve.point(to));
    let tolerance = (TOLERANCE * size).max(ROUNDING * (a.amax() + b.amax()));
    halve(curve, [from, to], [a, b], tolerance, DEEPEST, vertices);
}

fn halve(
    curve: &impl SmoothCurve,
    [from, to]: [f64; 2],
    [a, b]: [Vec2; 2],
    tolerance: f64,
    depth: u32,
    vertices: &mut Vec<[f64; 3]>,
) {
    let pair = Biarc::new([a, b], [curve.tangent(from, 1.0), curve.tangent(to, -1.0)]);
    let is_near = |pair: &Biarc| {
        (1..=SAMPLES).all(|k| {
            let t = from + (to - from) * k as f64 / (SAMPLES + 1) as f64;
            pair.distance(curve.point(t)) <= tolerance
        })
    };
    if let Some(pair) = pair.filter(is_near) {
        pair.append(vertices);
    } else if depth == 0 || (b - a).norm() <= tolerance * TOLERANCE {
        vertices.push([a.x, a.y, 0.0]);
    } else {
        let middle = 0.5 * (from + to);
        let joint = curve.point(middle);
        halve(curve, [from, middle], [a, joint], tolerance, depth - 1, vertices);
        halve(curve, [middle, to], [joint, b], tolerance, depth - 1, vertices);
    }
}

/// Two arcs from `a` via `joint` to `b`, by their bulges.
struct Biarc {
    a: Vec2,
    joint: Vec2,
    b: Vec2,
    bulges: [f64; 2],
}

impl Biarc {
    /// The pair with given ends and unit tangents; `None` unless both arcs are moderate.
    fn new([a, b]: [Vec2; 2], [from, to]: [Vec2; 2]) -> Option<Self> {
        let chord = b - a;
        let sum = from + to;
        // The arms of length d from both ends are 2d apart: |chord - d (from + to)| = 2d, a quadratic equation for d.
        let (p, q) = (chord.dot(&sum), 2.0 * (1.0 - from.dot(&to)));
        let arm = chord.norm_squared() / (p + (p * p + q * chord.norm_squared()).sqrt());
        let joint = 0.5 * (a + b + (from - to) * arm);
        let first = bulge_from_tangent(from, joint - a);
        let second = -bulge_from_tangent(-to, joint - b);
        let bulges = [first, second];
        // Also false if a tangent is missing or an arm infinite.
        (arm > 0.0 && arm.is_finite() && bulges.iter().all(|bulge| bulge.abs() <= LARGEST_BULGE)).then_some(Self {
            a,
            joint,
            b,
            bulges,
        })
    }

    /// The distance of `x` from the nearer circle of the two.
    fn distance(&self, x: Vec2) -> f64 {
        let first = distance_to_circle(self.a, self.joint, self.bulges[0], x);
        first.min(distance_to_circle(self.joint, self.b, self.bulges[1], x))
    }

    fn append(&self, vertices: &mut Vec<[f64; 3]>) {
        let Self { a, joint, bulges: [first, second], .. } = *self;
        let is_straight = first.abs().max(second.abs()) < STRAIGHT;
        vertices.push([a.x, a.y, if is_straight { 0.0 } else { first }]);
        if !is_straight {
            vertices.push([joint.x, joint.y, second]);
        }
    }
}

/// The bulge of the arc over `chord` that begins along the unit vector `tangent`.
fn bulge_from_tangent(tangent: Vec2, chord: Vec2) -> f64 {
    // The angle between both is half of the arc's angle; the bulge is the tangent of a quarter of that.
    cross(tangent, chord) / (chord.norm() + tangent.dot(&chord))
}

/// The distance of `x` from the full circle of an arc, by a formula valid for a straight edge too.
fn distance_to_circle(a: Vec2, b: Vec2, bulge: f64, x: Vec2) -> f64 {
    let (chord, middle) = (b - a, 0.5 * (a + b));
    let length = chord.norm();
    if length == 0.0 {
        return (x - a).norm();
    }
    // The arc's half angle has the sine `curvature * length / 2` and this cosine.
    let curvature = 4.0 * bulge / ((1.0 + bulge * bulge) * length);
    let cosine = (1.0 - bulge * bulge) / (1.0 + bulge * bulge);
    // Half the curvature times (squared distance from the center minus squared radius).
    let across = cross(chord, x - a) / length;
    let f = 0.5 * curvature * ((x - middle).norm_squared() - 0.25 * length * length) - cosine * across;
    2.0 * f.abs() / (1.0 + (1.0 + 2.0 * curvature * f).max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::curve::{Curve, unit};

    /// y = sin x.
    struct Wave;

    impl SmoothCurve for Wave {
        fn point(&self, t: f64) -> Vec2 {
            Vec2::new(t, t.sin())
        }
        fn tangent(&self, t: f64, _: f64) -> Vec2 {
            Vec2::new(1.0, t.cos()).normalize()
        }
    }

    fn chain() -> Vec<Curve> {
        let mut vertices = Vec::new();
        append(&Wave, 0.0, 7.0, 7.0, &mut vertices);
        vertices.push([7.0, 7f64.sin(), 0.0]);
        let edge = |pair: &[[f64; 3]]| {
            Curve::from_bulge(Vec2::new(pair[0][0], pair[0][1]), Vec2::new(pair[1][0], pair[1][1]), pair[0][2])
        };
        vertices.windows(2).map(edge).collect()
    }

    #[test]
    fn the_chain_follows_the_curve_within_the_tolerance() {
        let chain = chain();
        let farthest = (0..=1000)
            .map(|k| {
                let x = Wave.point(7.0 * f64::from(k) / 1000.0);
                chain.iter().map(|arc| (arc.project(x).point - x).norm()).fold(f64::INFINITY, f64::min)
            })
            .fold(0.0, f64::max);
        // Between the compared points the distance may be a few percent larger.
        assert!(farthest < 1.1 * TOLERANCE * 7.0 && farthest > 0.0, "{farthest:e}");
        assert!(chain.len() < 80, "{} arcs", chain.len());
    }

    #[test]
    fn neighbors_of_the_chain_share_their_tangents() {
        for pair in chain().windows(2) {
            assert!((pair[0].tangent(1.0) - pair[1].tangent(0.0)).norm() < 1e-9);
        }
    }

    #[test]
    fn the_distance_to_a_circle_holds_for_both_turns_and_for_lines() {
        let (center, radius) = (Vec2::new(3.0, -1.0), 2.0);
        let [a, b] = [0.3, 1.1].map(|angle| center + unit(angle) * radius);
        let bulge = (0.25 * (1.1 - 0.3f64)).tan();
        for x in [Vec2::new(5.5, 0.0), Vec2::new(3.5, -1.0), a] {
            let expected = ((x - center).norm() - radius).abs();
            assert!((distance_to_circle(a, b, bulge, x) - expected).abs() < 1e-14);
            assert!((distance_to_circle(b, a, -bulge, x) - expected).abs() < 1e-14);
        }
        assert!(
            (distance_to_circle(Vec2::zeros(), Vec2::new(2.0, 0.0), 0.0, Vec2::new(9.0, -3.0)) - 3.0).abs() < 1e-15
        );
    }
}
