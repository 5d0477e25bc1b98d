//! Viscous resistance of the channel between two walls, from a chord into a pore, along arcs that meet both walls at right angles.
//!
//! Lubrication along these arcs: the pressure is constant along an arc, and its gradient along the line through the middles of the arcs is
//! 12 μ q/h³ with the length h of the arc. An arc between ends P and Q at the distance d, whose walls diverge by 2α, has h = d α/sin α. As
//! the line advances, the walls turn by dφ and the ends move by ds = R dφ with dφ ∝ 1/(R cos α + d/2) at a wall of radius R, and the line
//! by (ds1 + ds2)/2 + d (dφ1 + dφ2)/(4 (1 + cos α)). A corner is a wall of radius 0.
//!
//! The exact expansion of Stokes flow in the slope H' of the walls is a resistance of 12/h³ (1 + 6/5 H'²) per length for a channel of the
//! width h = 2 H along a straight axis; here it is 12/h³ (1 + H'²), five sixths of the effect of the slope, and exact for parallel walls.
//! Between floor and lid an arc resists like a duct of its length. Left out: junctions of flows in pores.

use crate::graph::WallPiece;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::curve::{Curve, cross};
use meniscus_geometry::interface::depth::duct_factor;

/// Steps per length over which the width changes by its own size: conductances are accurate to 1e-4.
const STEPS: f64 = 4.0;
/// Rounding error of angles in rad and of relative lengths.
const ROUNDING: f64 = 1e-9;
/// Distance from the center, in widths, at which it counts as reached: the rest adds less than this to a resistance.
const REACHED: f64 = 1e-4;
/// Bound of the number of steps, more than any channel needs: the width grows from step to step.
const MOST_STEPS: usize = 100_000;
/// Bound of the number of corrections of a step's length to the end of a piece, more than needed.
const MOST_CORRECTIONS: usize = 50;

/// A wall from the end of a chord into a pore.
#[derive(Debug, Clone)]
pub(super) struct Wall {
    pieces: Vec<Piece>,
    /// 1 if a left turn is a turn away from the channel, else -1.
    away: f64,
}

/// A part of a wall, parametrized by its length if it is straight, else by its turning angle.
#[derive(Debug, Clone, Copy)]
struct Piece {
    start: Vec2,
    tangent: Vec2,
    /// In m, negative for a concave solid, 0 at a corner; `None` if straight.
    radius: Option<f64>,
    end: f64,
}

impl Wall {
    /// A wall of pieces in order. Its end is a corner, where the wall of another throat begins.
    pub(super) fn new(pieces: &[WallPiece], away: f64, begin: Vec2, along: Vec2) -> Self {
        let mut wall = Self { pieces: Vec::with_capacity(2 * pieces.len() + 1), away };
        let (mut end, mut tangent) = (begin, along);
        for WallPiece { curve, .. } in pieces {
            wall.turn(end, tangent, curve.tangent(0.0));
            let (radius, size) = match *curve {
                Curve::Segment { a, b } => (None, (b - a).norm()),
                Curve::Arc { radius, sweep, .. } => (Some(radius * away * sweep.signum()), sweep.abs()),
            };
            wall.pieces.push(Piece { start: curve.point(0.0), tangent: curve.tangent(0.0), radius, end: size });
            (end, tangent) = (curve.point(1.0), curve.tangent(1.0));
        }
        wall.pieces.push(Piece { start: end, tangent, radius: Some(0.0), end: std::f64::consts::PI });
        wall
    }

    /// A convex corner between two tangents; a concave one is a step of the tangent, without a piece.
    fn turn(&mut self, corner: Vec2, from: Vec2, to: Vec2) {
        let angle = self.away * cross(from, to).atan2(from.dot(&to));
        if angle > ROUNDING {
            self.pieces.push(Piece { start: corner, tangent: from, radius: Some(0.0), end: angle });
        }
    }
}

/// A position on a wall: the piece and the parameter on it.
#[derive(Debug, Clone, Copy)]
struct Position {
    piece: usize,
    at: f64,
}

/// An arc: its ends and derived quantities.
#[derive(Debug, Clone, Copy)]
struct Arc {
    chord: Vec2,
    /// Length of the chord, d.
    d: f64,
    tangents: [Vec2; 2],
    /// Cosine and sine of α, half the angle by which the walls diverge.
    cos: f64,
    sin: f64,
    /// Length of the arc.
    h: f64,
    /// Middle of the arc.
    pub middle: Vec2,
    /// The direction of the flow there.
    direction: Vec2,
}

impl Arc {
    fn between(ends: [Vec2; 2], tangents: [Vec2; 2]) -> Self {
        let ([p, q], [t1, t2]) = (ends, tangents);
        // Walls diverge by less than 3/2 π, and converge by less than π/2: above π both tangents point backwards.
        let (cross, dot) = (cross(t1, t2), t1.dot(&t2));
        let is_beyond = cross < 0.0 && dot < 0.0;
        let (sum, difference) = (t1 + t2, t2 - t1);
        let cos = if is_beyond { -0.5 * sum.norm() } else { 0.5 * sum.norm() };
        let sin = if cross < 0.0 && !is_beyond { -0.5 * difference.norm() } else { 0.5 * difference.norm() };
        // The longer one has the smaller rounding error.
        let direction = if dot > 0.0 { sum / (2.0 * cos) } else { -perpendicular(difference) / (2.0 * sin) };
        let chord = q - p;
        let d = chord.norm();
        // α/sin α by its series if the quotient loses digits.
        let h = if sin.abs() < 1e-4 && cos > 0.0 { d * (1.0 + sin * sin / 6.0) } else { d * sin.atan2(cos) / sin };
        // tan(α/2) = sin α/(1 + cos α).
        let middle = 0.5 * (p + q) + direction * (0.5 * d * sin / (1.0 + cos));
        Self { chord, d, tangents, cos, sin, h, middle, direction }
    }

    /// Area between arc and chord in m², positive if the arc bulges forward.
    fn segment(&self) -> f64 {
        let alpha = self.sin.atan2(self.cos);
        // d²/4 (α - sin α cos α)/sin² α, by its series if the quotient loses digits.
        let shape =
            if alpha.abs() < 1e-2 { alpha / 1.5 } else { (alpha - self.sin * self.cos) / (self.sin * self.sin) };
        0.25 * self.d * self.d * shape
    }

    /// 12/h³ in 1/m3; between floor and lid at the distance b that of a duct, 12/(h b² F(h/b)).
    fn gradient(&self, depth: Option<f64>) -> f64 {
        match depth {
            None => 12.0 / (self.h * self.h * self.h),
            Some(depth) => 12.0 / (self.h * depth * depth * duct_factor(self.h / depth)),
        }
    }
}

/// Derivatives with respect to the length of the middle line: of the positions of both ends, and of the angle between the walls.
struct Rates {
    ends: [f64; 2],
    turn: f64,
}

/// Both walls of a channel, the first one on the right of the flow.
pub(super) struct Channel {
    pub(super) walls: [Wall; 2],
    /// The direction at right angles to the chord, into the pore.
    pub(super) along: Vec2,
    /// Distance between floor and lid in m; `None` in the plane.
    pub(super) depth: Option<f64>,
}

impl Channel {
    fn end(&self, wall: usize, position: Position) -> (Vec2, Vec2) {
        let Wall { pieces, away } = &self.walls[wall];
        let Piece { start, tangent, radius, .. } = pieces[position.piece];
        let Some(radius) = radius else { return (start + tangent * position.at, tangent) };
        let (sin, cos) = (away * position.at * if radius < 0.0 { -1.0 } else { 1.0 }).sin_cos();
        let normal = perpendicular(tangent);
        let arm = normal * (away * radius);
        (start + arm * (1.0 - cos) + tangent * (away * radius * sin), tangent * cos + normal * sin)
    }

    fn arc(&self, positions: [Position; 2]) -> Arc {
        let ((p, t1), (q, t2)) = (self.end(0, positions[0]), self.end(1, positions[1]));
        Arc::between([p, q], [t1, t2])
    }

    /// `None` if arcs no longer advance: walls close around a focus, or straight walls have turned away by more than a right angle.
    fn rates(&self, positions: [Position; 2], arc: &Arc) -> Option<Rates> {
        let Arc { d, cos, .. } = *arc;
        let rate = |wall: usize| match self.walls[wall].pieces[positions[wall].piece].radius {
            None => (cos > -ROUNDING).then(|| (1.0 / cos.max(ROUNDING), 1.0 / cos.max(ROUNDING), 0.0)),
            Some(radius) => {
                let turned = radius * cos + 0.5 * d;
                let least = ROUNDING * (d + radius.abs());
                if radius >= 0.0 {
                    return (turned > least).then(|| (1.0 / turned, radius / turned, 1.0 / turned));
                }
                // Both walls on one circle: every arc meets it at right angles, and both ends move equally.
                let meets = turned.min(-least);
                (turned <= least).then(|| (-1.0 / meets, radius / meets, 1.0 / meets))
            }
        };
        let ((one, length_one, turn_one), (other, length_other, turn_other)) = (rate(0)?, rate(1)?);
        let turn = turn_one + turn_other;
        let advance = 0.5 * (length_one + length_other) + d * turn / (4.0 * (1.0 + cos));
        (advance > 0.0).then(|| Rates { ends: [one / advance, other / advance], turn: turn / advance })
    }

    /// ∫ 12/h³ along the middle line, from the chord until the center of the pore is abreast, in 1/m2.
    pub(super) fn resistance(&self, center: Vec2) -> f64 {
        self.integral(center).0
    }

    /// The same, with the number of steps.
    fn integral(&self, center: Vec2) -> (f64, usize) {
        let mut positions = [Position { piece: 0, at: 0.0 }; 2];
        let (mut sum, mut steps) = (0.0, 0);
        if !self.settle(&mut positions, center, &mut sum) {
            return (sum, steps);
        }
        while steps < MOST_STEPS {
            steps += 1;
            let arc = self.arc(positions);
            let ahead = self.ahead(center, &arc);
            if ahead.is_nan() || ahead <= REACHED * arc.h {
                break;
            }
            let Some(rates) = self.rates(positions, &arc) else { break };
            let scale = arc.h / (2.0 * arc.sin.abs() + (arc.h * rates.turn.abs()).sqrt());
            let Some(step) = self.step(positions, (scale / STEPS).min(ahead), center, &arc, &rates) else { break };
            sum += step.resistance;
            let Some((entered, is_concave)) = self.entered(step.positions, step.ended) else { break };
            if is_concave {
                sum += self.drawn_back(&self.arc(step.positions), &self.arc(entered));
            }
            positions = entered;
            if is_concave && !self.settle(&mut positions, center, &mut sum) {
                break;
            }
        }
        (sum, steps)
    }

    /// Correction by floor and lid where a wall turns towards the channel and the arc recedes over an area that it has passed: 12/b² times the
    /// area over h². In the plane 12/h³ makes it small in a wide channel.
    fn drawn_back(&self, before: &Arc, after: &Arc) -> f64 {
        let area = (after.segment() - before.segment()).min(0.0);
        self.depth.map_or(0.0, |depth| 12.0 * area / (depth * depth * before.h * after.h))
    }

    /// Distance of the middle to the position abreast of the center; 0 if the channel has turned off at nearly a right angle.
    fn ahead(&self, center: Vec2, arc: &Arc) -> f64 {
        /// Cosine of the angle at which no distance is left.
        const OFF: f64 = 0.1;
        let cos = self.along.dot(&arc.direction);
        if cos < OFF { 0.0 } else { self.along.dot(&(center - arc.middle)) / cos }
    }

    /// Both positions, moved to the beginning of the next piece on a wall whose piece has ended, and whether a wall turned towards the channel
    /// there. `None` if a wall has no next piece.
    fn entered(&self, mut positions: [Position; 2], ended: [bool; 2]) -> Option<([Position; 2], bool)> {
        let mut is_concave = false;
        for (wall, position) in positions.iter_mut().enumerate().filter(|&(wall, _)| ended[wall]) {
            let (_, before) = self.end(wall, *position);
            let next = Position { piece: position.piece + 1, at: 0.0 };
            if next.piece == self.walls[wall].pieces.len() {
                return None;
            }
            *position = next;
            let (_, after) = self.end(wall, next);
            is_concave |= self.walls[wall].away * cross(before, after) < -ROUNDING;
        }
        Some((positions, is_concave))
    }

    /// Advances the end that lags behind until the chord has equal angles with both walls. False if a wall ends before.
    fn settle(&self, positions: &mut [Position; 2], center: Vec2, sum: &mut f64) -> bool {
        let lead = |positions: [Position; 2]| {
            let arc = self.arc(positions);
            arc.chord.dot(&(arc.tangents[0] + arc.tangents[1])) / arc.d
        };
        let first = lead(*positions);
        if first.abs() <= ROUNDING {
            return true;
        }
        let lagging = usize::from(first < 0.0);
        let sign = first.signum();
        loop {
            let Position { piece, at } = positions[lagging];
            let end = self.walls[lagging].pieces[piece].end;
            let with = |at: f64| {
                let mut moved = *positions;
                moved[lagging].at = at;
                moved
            };
            let (mut low, mut high) = (at, end);
            let reaches = sign * lead(with(end)) <= 0.0;
            // A double has 53 bits.
            for _ in 0..if reaches { 53 } else { 0 } {
                let middle = 0.5 * (low + high);
                if sign * lead(with(middle)) > 0.0 { low = middle } else { high = middle }
            }
            let (before, after) = (self.arc(*positions), self.arc(with(high)));
            let ahead = self.ahead(center, &before);
            let advance = after.direction.dot(&(after.middle - before.middle)).min(ahead).max(0.0);
            if advance > 0.0 {
                *sum += advance * after.gradient(self.depth);
            }
            *positions = with(high);
            if reaches {
                return true;
            }
            if piece + 1 == self.walls[lagging].pieces.len() {
                return false;
            }
            positions[lagging] = Position { piece: piece + 1, at: 0.0 };
        }
    }

    /// One Runge-Kutta step, shortened to the end of a piece or to the position abreast of the center.
    fn step(&self, positions: [Position; 2], longest: f64, center: Vec2, arc: &Arc, first: &Rates) -> Option<Step> {
        let mut length = longest;
        let end = |wall: usize| self.walls[wall].pieces[positions[wall].piece].end;
        for _ in 0..MOST_CORRECTIONS {
            let Reached { at, rates, resistance } = self.runge_kutta(positions, length, arc, first)?;
            let rounding = |wall: usize| ROUNDING * (at[wall] - positions[wall].at);
            let beyond = |wall: usize| at[wall] - end(wall);
            // The secant from the beginning of the step, and Newton's method close to the end: far from it, Newton's may return to the beginning.
            let to_end = |wall: usize| {
                let newton = length - beyond(wall) / rates[wall];
                let secant = length * (end(wall) - positions[wall].at) / (at[wall] - positions[wall].at);
                if newton > 0.5 * secant && newton < length { newton } else { secant }
            };
            let reached = self.arc([0, 1].map(|wall| Position { at: at[wall], ..positions[wall] }));
            let left = |arc: &Arc| self.along.dot(&(center - arc.middle));
            let to_center =
                (left(&reached) < -REACHED * reached.h).then(|| length * left(arc) / (left(arc) - left(&reached)));
            let ends = [0, 1].into_iter().filter(|&wall| beyond(wall) > rounding(wall)).map(to_end);
            if let Some(shortened) = ends.chain(to_center).reduce(f64::min) {
                length = shortened;
                continue;
            }
            let ended = [0, 1].map(|wall| beyond(wall) >= -rounding(wall));
            let next = |wall: usize| Position { at: if ended[wall] { end(wall) } else { at[wall] }, ..positions[wall] };
            return Some(Step { positions: [next(0), next(1)], ended, resistance });
        }
        None
    }

    fn runge_kutta(&self, positions: [Position; 2], length: f64, arc: &Arc, first: &Rates) -> Option<Reached> {
        let moved = |rates: &[f64; 2], share: f64| {
            [0, 1].map(|wall| Position { at: positions[wall].at + share * length * rates[wall], ..positions[wall] })
        };
        let at = |positions: [Position; 2]| {
            let arc = self.arc(positions);
            Some((self.rates(positions, &arc)?.ends, arc.gradient(self.depth)))
        };
        let (k1, g1) = (first.ends, arc.gradient(self.depth));
        let (k2, g2) = at(moved(&k1, 0.5))?;
        let (k3, g3) = at(moved(&k2, 0.5))?;
        let (k4, g4) = at(moved(&k3, 1.0))?;
        let mean = |wall: usize| (k1[wall] + 2.0 * (k2[wall] + k3[wall]) + k4[wall]) / 6.0;
        let at = [0, 1].map(|wall| positions[wall].at + length * mean(wall));
        Some(Reached { at, rates: k4, resistance: length * (g1 + 2.0 * (g2 + g3) + g4) / 6.0 })
    }
}

/// The result of a Runge-Kutta step, possibly past the ends of pieces.
struct Reached {
    at: [f64; 2],
    /// Derivatives of the positions of both ends there.
    rates: [f64; 2],
    resistance: f64,
}

/// The result of a step.
struct Step {
    positions: [Position; 2],
    ended: [bool; 2],
    resistance: f64,
}

#[cfg(test)]
mod tests;
