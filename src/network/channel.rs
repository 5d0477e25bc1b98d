//! The channel between two walls as flow sees it: arcs that meet both walls at right angles, from a chord into a pore.
//!
//! Lubrication along these arcs: pressure is taken as equal along an arc, and the gradient is 12 μ q/h³ with the length h of the arc,
//! per length of the line through the middles of the arcs. Arcs between ends P and Q with the distance d, whose walls diverge by 2α, have
//! h = d α/sin α. As the line advances, the walls turn by dφ and the ends move by ds = R dφ with dφ ∝ 1/(R cos α + d/2) at a wall of radius R,
//! and the line by (ds1 + ds2)/2 + d (dφ1 + dφ2)/(4 (1 + cos α)). A corner is a wall of radius 0.
//!
//! Against the exact expansion of Stokes flow in the slope H' of the walls, whose resistance is 12/h³ (1 + 6/5 H'²) per length for a
//! channel of the width h = 2 H along a straight axis, this is 12/h³ (1 + H'²): arcs see the slope of walls, to a sixth of its effect.
//! For parallel walls it is exact. Between a floor and a lid an arc resists as a duct of its length does. Left out: how flows join in pores.

use crate::geometry::curve::{Curve, cross};
use crate::interface::depth::duct_factor;
use crate::math::{Vec2, perpendicular};
use crate::network::graph::WallPiece;

/// Steps per length over which the width changes by its own size: conductances come out within 1e-4.
const STEPS: f64 = 4.0;
/// Angles in rad and shares of lengths below this are rounding.
const ROUNDING: f64 = 1e-9;
/// A center closer than this share of the width is reached: what is left of the way adds less than this to a resistance.
const REACHED: f64 = 1e-4;
/// More steps than any channel takes: the width grows from step to step.
const MOST_STEPS: usize = 100_000;
/// More corrections of a step's length than its end at that of a piece takes.
const MOST_CORRECTIONS: usize = 50;

/// A wall that begins at the end of a chord and leads into a pore.
#[derive(Debug, Clone)]
pub(super) struct Wall {
    pieces: Vec<Piece>,
    /// 1 where the wall turns away from the channel by turning left, else -1.
    away: f64,
}

/// A part of a wall, run through by its length if it is straight, else by the angle of its turn.
#[derive(Debug, Clone, Copy)]
struct Piece {
    start: Vec2,
    tangent: Vec2,
    /// In m, below 0 where the solid is concave, 0 at a corner; none where it is straight.
    radius: Option<f64>,
    end: f64,
}

impl Wall {
    /// A wall of pieces in order. Beyond its end it is a corner: there the wall of another throat begins.
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

/// A place on a wall: the piece and how far along it.
#[derive(Debug, Clone, Copy)]
struct Place {
    piece: usize,
    at: f64,
}

/// Where the arc stands: its ends and what follows from them.
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
    middle: Vec2,
    /// The direction of the flow there.
    direction: Vec2,
}

impl Arc {
    fn between(ends: [Vec2; 2], tangents: [Vec2; 2]) -> Self {
        let ([p, q], [t1, t2]) = (ends, tangents);
        // Walls diverge by less than 3/2 π, and converge by less than π/2: beyond π both tangents point backwards.
        let (cross, dot) = (cross(t1, t2), t1.dot(&t2));
        let is_beyond = cross < 0.0 && dot < 0.0;
        let (sum, difference) = (t1 + t2, t2 - t1);
        let cos = if is_beyond { -0.5 * sum.norm() } else { 0.5 * sum.norm() };
        let sin = if cross < 0.0 && !is_beyond { -0.5 * difference.norm() } else { 0.5 * difference.norm() };
        // Rounding is least in the longer one of both.
        let direction = if dot > 0.0 { sum / (2.0 * cos) } else { -perpendicular(difference) / (2.0 * sin) };
        let chord = q - p;
        let d = chord.norm();
        // α/sin α by its series where the quotient loses digits.
        let h = if sin.abs() < 1e-4 && cos > 0.0 { d * (1.0 + sin * sin / 6.0) } else { d * sin.atan2(cos) / sin };
        // tan(α/2) = sin α/(1 + cos α).
        let middle = 0.5 * (p + q) + direction * (0.5 * d * sin / (1.0 + cos));
        Self { chord, d, tangents, cos, sin, h, middle, direction }
    }

    /// Area between arc and chord in m², above 0 where the arc bulges ahead.
    fn segment(&self) -> f64 {
        let alpha = self.sin.atan2(self.cos);
        // d²/4 (α - sin α cos α)/sin² α, by its series where the quotient loses digits.
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

/// How fast both ends move along their pieces, per length of the middle line, and how fast the walls turn from each other.
struct Rates {
    ends: [f64; 2],
    turn: f64,
}

/// Both walls of a channel, the first one on the right of the flow.
pub(super) struct Channel {
    pub(super) walls: [Wall; 2],
    /// The direction at right angles to the chord, into the pore.
    pub(super) along: Vec2,
    /// Distance of floor and lid in m; none in the plane.
    pub(super) depth: Option<f64>,
}

impl Channel {
    fn end(&self, wall: usize, place: Place) -> (Vec2, Vec2) {
        let Wall { pieces, away } = &self.walls[wall];
        let Piece { start, tangent, radius, .. } = pieces[place.piece];
        let Some(radius) = radius else { return (start + tangent * place.at, tangent) };
        let (sin, cos) = (away * place.at * if radius < 0.0 { -1.0 } else { 1.0 }).sin_cos();
        let normal = perpendicular(tangent);
        let arm = normal * (away * radius);
        (start + arm * (1.0 - cos) + tangent * (away * radius * sin), tangent * cos + normal * sin)
    }

    fn arc(&self, places: [Place; 2]) -> Arc {
        let ((p, t1), (q, t2)) = (self.end(0, places[0]), self.end(1, places[1]));
        Arc::between([p, q], [t1, t2])
    }

    /// None where arcs no longer advance: walls that close around a focus, or straight ones that have turned away by more than a right angle.
    fn rates(&self, places: [Place; 2], arc: &Arc) -> Option<Rates> {
        let Arc { d, cos, .. } = *arc;
        let rate = |wall: usize| match self.walls[wall].pieces[places[wall].piece].radius {
            None => (cos > -ROUNDING).then(|| (1.0 / cos.max(ROUNDING), 1.0 / cos.max(ROUNDING), 0.0)),
            Some(radius) => {
                let turned = radius * cos + 0.5 * d;
                let least = ROUNDING * (d + radius.abs());
                if radius >= 0.0 {
                    return (turned > least).then(|| (1.0 / turned, radius / turned, 1.0 / turned));
                }
                // Both walls on one circle: every arc meets it at right angles, and both ends move alike.
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

    /// The same, with the number of steps that it took.
    fn integral(&self, center: Vec2) -> (f64, usize) {
        let mut places = [Place { piece: 0, at: 0.0 }; 2];
        let (mut sum, mut steps) = (0.0, 0);
        if !self.settle(&mut places, center, &mut sum) {
            return (sum, steps);
        }
        while steps < MOST_STEPS {
            steps += 1;
            let arc = self.arc(places);
            let ahead = self.ahead(center, &arc);
            if ahead.is_nan() || ahead <= REACHED * arc.h {
                break;
            }
            let Some(rates) = self.rates(places, &arc) else { break };
            let scale = arc.h / (2.0 * arc.sin.abs() + (arc.h * rates.turn.abs()).sqrt());
            let Some(step) = self.step(places, (scale / STEPS).min(ahead), center, (&arc, &rates)) else { break };
            sum += step.resistance;
            let Some((entered, is_concave)) = self.entered(step.places, step.ended) else { break };
            if is_concave {
                sum += self.drawn_back(&self.arc(step.places), &self.arc(entered));
            }
            places = entered;
            if is_concave && !self.settle(&mut places, center, &mut sum) {
                break;
            }
        }
        (sum, steps)
    }

    /// What floor and lid resist less where an arc draws back over an area that it has passed, as a wall turns towards the channel: 12/b² times the area over
    /// h². In the plane 12/h³ makes it small where the channel is wide.
    fn drawn_back(&self, before: &Arc, after: &Arc) -> f64 {
        let area = (after.segment() - before.segment()).min(0.0);
        self.depth.map_or(0.0, |depth| 12.0 * area / (depth * depth * before.h * after.h))
    }

    /// How far the middle has to go until the center is abreast of it; 0 where the channel has turned off at nearly a right angle.
    fn ahead(&self, center: Vec2, arc: &Arc) -> f64 {
        /// Cosine of the angle at which nothing is left of the way ahead.
        const OFF: f64 = 0.1;
        let cos = self.along.dot(&arc.direction);
        if cos < OFF { 0.0 } else { self.along.dot(&(center - arc.middle)) / cos }
    }

    /// Both places, that of a wall whose piece has ended at the beginning of its next one, and whether a wall turned towards the channel
    /// there. None where a wall has no next piece.
    fn entered(&self, mut places: [Place; 2], ended: [bool; 2]) -> Option<([Place; 2], bool)> {
        let mut is_concave = false;
        for (wall, place) in places.iter_mut().enumerate().filter(|&(wall, _)| ended[wall]) {
            let (_, before) = self.end(wall, *place);
            let next = Place { piece: place.piece + 1, at: 0.0 };
            if next.piece == self.walls[wall].pieces.len() {
                return None;
            }
            *place = next;
            let (_, after) = self.end(wall, next);
            is_concave |= self.walls[wall].away * cross(before, after) < -ROUNDING;
        }
        Some((places, is_concave))
    }

    /// Advances the end that lags behind until the chord leans as much on one wall as on the other. False where a wall ends before.
    fn settle(&self, places: &mut [Place; 2], center: Vec2, sum: &mut f64) -> bool {
        let lead = |places: [Place; 2]| {
            let arc = self.arc(places);
            arc.chord.dot(&(arc.tangents[0] + arc.tangents[1])) / arc.d
        };
        let first = lead(*places);
        if first.abs() <= ROUNDING {
            return true;
        }
        let lagging = usize::from(first < 0.0);
        let sign = first.signum();
        loop {
            let Place { piece, at } = places[lagging];
            let end = self.walls[lagging].pieces[piece].end;
            let with = |at: f64| {
                let mut moved = *places;
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
            let (before, after) = (self.arc(*places), self.arc(with(high)));
            let ahead = self.ahead(center, &before);
            let advance = after.direction.dot(&(after.middle - before.middle)).min(ahead).max(0.0);
            if advance > 0.0 {
                *sum += advance * after.gradient(self.depth);
            }
            *places = with(high);
            if reaches {
                return true;
            }
            if piece + 1 == self.walls[lagging].pieces.len() {
                return false;
            }
            places[lagging] = Place { piece: piece + 1, at: 0.0 };
        }
    }

    /// One step of the method of Runge and Kutta, shortened to the end of a piece or to where the center is abreast.
    fn step(&self, places: [Place; 2], longest: f64, center: Vec2, (arc, first): (&Arc, &Rates)) -> Option<Step> {
        let mut length = longest;
        let end = |wall: usize| self.walls[wall].pieces[places[wall].piece].end;
        for _ in 0..MOST_CORRECTIONS {
            let Reached { at, rates, resistance } = self.runge_kutta(places, length, arc, first)?;
            let rounding = |wall: usize| ROUNDING * (at[wall] - places[wall].at);
            let beyond = |wall: usize| at[wall] - end(wall);
            // The secant from the beginning of the step, and Newton's method close to the end: far from it, Newton's may come down at the beginning.
            let to_end = |wall: usize| {
                let newton = length - beyond(wall) / rates[wall];
                let secant = length * (end(wall) - places[wall].at) / (at[wall] - places[wall].at);
                if newton > 0.5 * secant && newton < length { newton } else { secant }
            };
            let reached = self.arc([0, 1].map(|wall| Place { at: at[wall], ..places[wall] }));
            let left = |arc: &Arc| self.along.dot(&(center - arc.middle));
            let to_center =
                (left(&reached) < -REACHED * reached.h).then(|| length * left(arc) / (left(arc) - left(&reached)));
            let ends = [0, 1].into_iter().filter(|&wall| beyond(wall) > rounding(wall)).map(to_end);
            if let Some(shortened) = ends.chain(to_center).reduce(f64::min) {
                length = shortened;
                continue;
            }
            let ended = [0, 1].map(|wall| beyond(wall) >= -rounding(wall));
            let place = |wall: usize| Place { at: if ended[wall] { end(wall) } else { at[wall] }, ..places[wall] };
            return Some(Step { places: [place(0), place(1)], ended, resistance });
        }
        None
    }

    fn runge_kutta(&self, places: [Place; 2], length: f64, arc: &Arc, first: &Rates) -> Option<Reached> {
        let moved = |rates: &[f64; 2], share: f64| {
            [0, 1].map(|wall| Place { at: places[wall].at + share * length * rates[wall], ..places[wall] })
        };
        let at = |places: [Place; 2]| {
            let arc = self.arc(places);
            Some((self.rates(places, &arc)?.ends, arc.gradient(self.depth)))
        };
        let (k1, g1) = (first.ends, arc.gradient(self.depth));
        let (k2, g2) = at(moved(&k1, 0.5))?;
        let (k3, g3) = at(moved(&k2, 0.5))?;
        let (k4, g4) = at(moved(&k3, 1.0))?;
        let mean = |wall: usize| (k1[wall] + 2.0 * (k2[wall] + k3[wall]) + k4[wall]) / 6.0;
        let at = [0, 1].map(|wall| places[wall].at + length * mean(wall));
        Some(Reached { at, rates: k4, resistance: length * (g1 + 2.0 * (g2 + g3) + g4) / 6.0 })
    }
}

/// What a step of the method of Runge and Kutta has reached, beyond the ends of pieces too.
struct Reached {
    at: [f64; 2],
    /// How fast both ends move there.
    rates: [f64; 2],
    resistance: f64,
}

/// What a step has reached.
struct Step {
    places: [Place; 2],
    ended: [bool; 2],
    resistance: f64,
}

#[cfg(test)]
mod tests;
