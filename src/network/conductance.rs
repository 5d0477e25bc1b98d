//! Hydraulic conductance of a throat: the flow per depth is g Δp/μ, g in m².
//!
//! Lubrication: 1/g = ∫ 12/h³ ds along the throat. Between two convex walls of curvatures κ1 and κ2, h = w + (κ1 + κ2) s²/2 and
//! g = w^(5/2) √(κ1 + κ2)/(4.5 π √2), the leading term of close cylinders. It holds where the width has tripled before the pores' centers;
//! elsewhere h is taken across the throat's direction between the walls themselves, from center to center, cut where a wall has turned
//! away by 80 degrees.
//!
//! Left out: the turns that the flow takes in pores, which lubrication does not see. Square arrays of discs come out 6, 10, 13 and 18 %
//! high at solid fractions of 0.6, 0.5, 0.4 and 0.3, and more below: see [`LOWEST_SOLID_FRACTION`].

use std::f64::consts::{PI, SQRT_2};

use crate::geometry::curve::Curve;
use crate::math::{Vec2, perpendicular};
use crate::network::graph::{Edge, Network, WallPiece};

/// Below this solid fraction lubrication in throats does not give permeabilities within 20 %.
pub const LOWEST_SOLID_FRACTION: f64 = 0.3;

/// The angle in rad by which a wall may turn away from the throat's direction.
const TURNED_AWAY: f64 = 80.0 / 180.0 * PI;

/// How a conductance was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// Both walls as parabolas.
    Parabola,
    /// The width between the walls, integrated.
    Integral,
    /// A slit in a thin wall, g = π w²/32: nothing of the integral is left where edges face each other.
    Orifice,
}

/// The conductance of a throat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conductance {
    /// Flow per depth times viscosity over pressure difference, in m².
    pub value: f64,
    /// How it was found.
    pub method: Method,
}

/// The conductances of all throats.
#[must_use]
pub fn conductances(network: &Network) -> Vec<Conductance> {
    let mut ends = vec![[None, None]; network.throats.len()];
    for (region, edges) in network.regions.iter().map(|region| &region.edges).enumerate() {
        for (index, edge) in edges.iter().enumerate() {
            if let Edge::Throat { throat, end, .. } = edge
                && let Some(slot) = ends.get_mut(*throat).and_then(|ends| ends.get_mut(*end))
            {
                *slot = Some((region, index));
            }
        }
    }
    let of = |throat: usize| of_ends(network, throat, ends[throat].map(|end| end.and_then(|end| half(network, end))));
    (0..network.throats.len()).map(of).collect()
}

fn of_ends(network: &Network, throat: usize, halves: [Option<Half>; 2]) -> Conductance {
    let throat = &network.throats[throat];
    let w = throat.width;
    let sum: f64 = throat.curvatures.iter().sum();
    let halves: Vec<&Half> = halves.iter().flatten().collect();
    // w + κ s²/2 = 3 w.
    let tripled = 2.0 * (w / sum).sqrt();
    let is_convex = sum.is_finite() && throat.curvatures.iter().all(|&curvature| curvature > 0.0);
    if is_convex && halves.iter().all(|half| half.to_center >= tripled) {
        return Conductance { value: w.powf(2.5) * sum.sqrt() / (4.5 * PI * SQRT_2), method: Method::Parabola };
    }
    let resistance: f64 = halves.iter().map(|half| half.resistance()).sum();
    let orifice = 32.0 / (PI * w * w);
    if resistance > orifice {
        Conductance { value: 1.0 / resistance, method: Method::Integral }
    } else {
        Conductance { value: 1.0 / orifice, method: Method::Orifice }
    }
}

/// One half of a throat: from its chord into a region.
struct Half {
    /// Distance of the region's center from the chord, along the throat.
    to_center: f64,
    /// Where the walls stand across the throat, on both of its sides.
    sides: [Vec<Profile>; 2],
}

/// A piece of wall as a height over the way along the throat.
#[derive(Debug, Clone, Copy)]
struct Profile {
    from: f64,
    to: f64,
    shape: ProfileShape,
}

#[derive(Debug, Clone, Copy)]
enum ProfileShape {
    Straight { at_from: f64, slope: f64 },
    Round { center: [f64; 2], radius: f64, side: f64 },
}

impl Profile {
    fn height(&self, s: f64) -> f64 {
        match self.shape {
            ProfileShape::Straight { at_from, slope } => at_from + slope * (s - self.from),
            ProfileShape::Round { center: [along, across], radius, side } => {
                across + side * ((radius - (s - along)) * (radius + (s - along))).max(0.0).sqrt()
            }
        }
    }
}

/// The half that begins at an edge of a region.
fn half(network: &Network, (region, index): (usize, usize)) -> Option<Half> {
    let region = &network.regions[region];
    let count = region.edges.len();
    let Edge::Throat { from, to, .. } = region.edges[index] else { return None };
    let across = (to - from).try_normalize(0.0)?;
    // The pore lies on the right of the loop.
    let frame = Frame { origin: 0.5 * (from + to), along: -perpendicular(across), across };
    let wall = |edge: &Edge| match edge {
        Edge::Wall(pieces) => pieces.clone(),
        Edge::Throat { .. } | Edge::Opening { .. } => Vec::new(),
    };
    let ahead = wall(&region.edges[(index + 1) % count]);
    let backwards = |piece: &WallPiece| WallPiece { curve: piece.curve.reversed(), ..*piece };
    let behind: Vec<WallPiece> = wall(&region.edges[(index + count - 1) % count]).iter().rev().map(backwards).collect();
    let to_center = frame.along.dot(&(region.center - frame.origin)).max(0.0);
    Some(Half { to_center, sides: [frame.profile(&ahead), frame.profile(&behind)] })
}

/// Coordinates along and across a throat.
struct Frame {
    origin: Vec2,
    along: Vec2,
    across: Vec2,
}

impl Frame {
    fn local(&self, x: Vec2) -> [f64; 2] {
        [self.along.dot(&(x - self.origin)), self.across.dot(&(x - self.origin))]
    }

    /// The pieces of a wall from the chord on, up to where it has turned away.
    fn profile(&self, wall: &[WallPiece]) -> Vec<Profile> {
        let mut profile = Vec::new();
        for WallPiece { curve, .. } in wall {
            let tangent = curve.tangent(0.0);
            let turn = crate::geometry::curve::cross(self.along, tangent).atan2(self.along.dot(&tangent));
            if turn.abs() > TURNED_AWAY {
                break;
            }
            let ([from, at_from], [end, at_end]) = (self.local(curve.point(0.0)), self.local(curve.point(1.0)));
            match *curve {
                Curve::Segment { .. } => {
                    let shape = ProfileShape::Straight { at_from, slope: (at_end - at_from) / (end - from) };
                    profile.push(Profile { from, to: end, shape });
                }
                Curve::Arc { center, radius, sweep, .. } => {
                    let u = ((TURNED_AWAY.copysign(sweep) - turn) / sweep).min(1.0);
                    let center = self.local(center);
                    let [to, _] = self.local(curve.point(u));
                    let [_, middle] = self.local(curve.point(0.5 * u));
                    let shape = ProfileShape::Round { center, radius, side: (middle - center[1]).signum() };
                    profile.push(Profile { from, to, shape });
                    if u < 1.0 {
                        break;
                    }
                }
            }
        }
        profile
    }
}

impl Half {
    /// ∫ 12/h³ ds in 1/m².
    fn resistance(&self) -> f64 {
        let [one, other] = &self.sides;
        let mut sum = 0.0;
        let (mut i, mut j) = (0, 0);
        let mut s = 0.0;
        while let (Some(a), Some(b)) = (one.get(i), other.get(j)) {
            let end = a.to.min(b.to).min(self.to_center);
            if end > s {
                let integrand = |s: f64| 12.0 / (a.height(s) - b.height(s)).abs().powi(3);
                sum += integral(&integrand, s, end, gauss(&integrand, s, end), 0);
                s = end;
            }
            if end >= self.to_center {
                break;
            }
            if a.to <= b.to { i += 1 } else { j += 1 }
        }
        sum
    }
}

/// The integral by halving until both halves add up to the whole.
fn integral(f: &impl Fn(f64) -> f64, a: f64, b: f64, whole: f64, depth: usize) -> f64 {
    // Relative; conductances are not that exact. At the deepest level an interval is rounding.
    const TOLERANCE: f64 = 1e-9;
    const DEEPEST: usize = 40;
    let middle = 0.5 * (a + b);
    let (left, right) = (gauss(f, a, middle), gauss(f, middle, b));
    if depth >= DEEPEST || (left + right - whole).abs() <= TOLERANCE * (left + right).abs() {
        return left + right;
    }
    integral(f, a, middle, left, depth + 1) + integral(f, middle, b, right, depth + 1)
}

/// Gauss' rule of five points.
fn gauss(f: &impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    const POINTS: [(f64, f64); 3] = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let pair = |&(x, weight): &(f64, f64)| {
        if x == 0.0 { weight * f(middle) } else { weight * (f(middle - half * x) + f(middle + half * x)) }
    };
    half * POINTS.iter().map(pair).sum::<f64>()
}
