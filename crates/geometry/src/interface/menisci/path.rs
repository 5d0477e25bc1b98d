//! The menisci between two walls, from behind the throat to ahead of it, as one path.
//!
//! A meniscus with contacts P on the left and Q on the right leaves the walls in the directions μ_l and μ_r. Both make the angle β with the chord d = Q − P,
//! so that its polar angle is ψ = (μ_l + μ_r − π)/2, and the curvature is k = 2 sin β/|d|. In the plane of both contacts' parameters this is a curve, which
//! is followed in both directions from the chord of the throat. On every pair of pieces it has a closed form and is monotonic in both parameters, as are the
//! positions where k is extremal: there center, circle and walls are symmetric. Hence k is monotonic between neighboring stations.

use std::f64::consts::PI;

use crate::curve::cross;
use crate::interface::menisci::circle::{Circle, Condition, meets_round, meets_straight};
use crate::interface::menisci::extremes::extreme_circles;
use crate::interface::menisci::wall::{Piece, Shape, wrapped};
use meniscus_core::math::halved;

/// A contact on each wall: the piece, and the parameter on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contacts {
    pub(crate) left: (usize, f64),
    pub(crate) right: (usize, f64),
}

/// A meniscus of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Station {
    pub(crate) contacts: Contacts,
    /// Angle β between chord and interface, above 0 where the meniscus bulges into the defending phase.
    pub(crate) bend: f64,
    pub(crate) curvature: f64,
}

/// A part of the path on one pair of pieces along which the curvature is monotonic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leg {
    pub(crate) start: Station,
    pub(crate) end: Station,
}

/// The pieces of both walls.
#[derive(Debug, Clone)]
pub(super) struct Walls {
    pub(crate) left: Vec<Piece>,
    pub(crate) right: Vec<Piece>,
}

/// Parameters nearer to an end than this are set to the end: rounding of the closed forms.
const SNAP: f64 = 1e-12;

fn snapped(s: f64) -> f64 {
    if s.abs() < SNAP {
        0.0
    } else if (s - 1.0).abs() < SNAP {
        1.0
    } else {
        s
    }
}

/// Direction in which the path is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sense {
    Forward,
    Backward,
}

impl Walls {
    pub(crate) fn station(&self, contacts: Contacts) -> Station {
        let (l, r) = (&self.left[contacts.left.0], &self.right[contacts.right.0]);
        let d = r.point(contacts.right.1) - l.point(contacts.left.1);
        let psi = d.y.atan2(d.x);
        // The mean of both sides, so that mirrored walls give the same number.
        let one = wrapped(l.direction(contacts.left.1) - psi);
        let other = one + wrapped(psi + PI - r.direction(contacts.right.1) - one);
        let bend = 0.5 * (one + other);
        Station { contacts, bend, curvature: 2.0 * bend.sin() / d.norm() }
    }

    pub(crate) fn circle(&self, station: &Station) -> Circle {
        let Contacts { left: (i, s), right: (j, t) } = station.contacts;
        let (l, r) = (&self.left[i], &self.right[j]);
        // The position of an edge is exact.
        let (piece, s) = if r.is_edge() && !l.is_edge() { (r, t) } else { (l, s) };
        Circle::through(piece.point(s), piece.inward(s), station.curvature)
    }

    /// All menisci that can be reached from the chord, in the order of the advance. The last leg may go on beyond a half turn.
    pub(crate) fn path(&self, chord: (usize, usize)) -> Vec<Leg> {
        let Some(start) = self.start(chord) else { return Vec::new() };
        let mut path = self.follow(start, Sense::Backward);
        path.reverse();
        path.extend(self.follow(start, Sense::Forward));
        if path.is_empty() { vec![Leg { start, end: start }] } else { path }
    }

    /// A meniscus with both contacts at the chord; else one with a contact at the chord, or nearest to it along a wall, and of two such menisci the one whose
    /// other contact is nearer to the chord.
    fn start(&self, chord: (usize, usize)) -> Option<Station> {
        let (m, n) = (self.left.len(), self.right.len());
        if m == 0 || n == 0 {
            return None;
        }
        if let Some(contacts) = self.on_chord(chord) {
            return Some(self.station(contacts));
        }
        let end = |index: usize, len: usize| if index < len { (index, 0.0) } else { (len - 1, 1.0) };
        let answered = |on: &Piece, (piece, s): (&Piece, f64)| {
            let s = snapped(on.answer(piece.point(s), piece.direction(s))?);
            (0.0..=1.0).contains(&s).then_some(s)
        };
        let of_left = outward(chord.0, m).find_map(|i| {
            let left = end(i, m);
            let known = (&self.left[left.0], left.1);
            let found = |j: usize| answered(self.right.get(j)?, known).map(|t| Contacts { left, right: (j, t) });
            outward(chord.1, n).find_map(found)
        });
        let of_right = || {
            outward(chord.1, n).find_map(|j| {
                let right = end(j, n);
                let known = (&self.right[right.0], right.1);
                let found = |i: usize| answered(self.left.get(i)?, known).map(|s| Contacts { left: (i, s), right });
                outward(chord.0, m).find_map(found)
            })
        };
        let off_chord = |contacts: &Contacts| {
            let (left, right) = (&self.left[contacts.left.0], &self.right[contacts.right.0]);
            left.advance_at(contacts.left.1).abs() + right.advance_at(contacts.right.1).abs()
        };
        let nearest = of_left.into_iter().chain(of_right()).min_by(|a, b| off_chord(a).total_cmp(&off_chord(b)));
        nearest.map(|contacts| self.station(contacts))
    }

    /// The contacts at both ends of the chord, if the walls have a common bend there: at an edge a range of bends is admissible.
    fn on_chord(&self, chord: (usize, usize)) -> Option<Contacts> {
        let end = |index: usize, pieces: &[Piece]| if index < pieces.len() { (index, 0.0) } else { (index - 1, 1.0) };
        let (left, right) = (end(chord.0, &self.left), end(chord.1, &self.right));
        let (l, r) = (&self.left[left.0], &self.right[right.0]);
        let d = r.point(right.1) - l.point(left.1);
        let psi = d.y.atan2(d.x);
        // Middle and half width of the range of bends.
        let range = |piece: &Piece, s: f64, bend: &dyn Fn(f64) -> f64| {
            let [from, to] = if piece.is_edge() { piece.direction } else { [piece.direction(s); 2] };
            (wrapped(bend(0.5 * (from + to))), 0.5 * (to - from).abs())
        };
        let (of_left, of_right) = (range(l, left.1, &|mu| mu - psi), range(r, right.1, &|mu| psi + PI - mu));
        let low = (of_left.0 - of_left.1).max(of_right.0 - of_right.1);
        let high = (of_left.0 + of_left.1).min(of_right.0 + of_right.1);
        // Tolerance for rounding of directions.
        if !(low <= high + SNAP) {
            return None;
        }
        let bend = 0.5 * (low + high);
        let at = |piece: &Piece, s: f64, mu: f64| if piece.is_edge() { held(piece.parameter(mu), 0.0, 1.0) } else { s };
        let (s, t) = (at(l, left.1, psi + bend), at(r, right.1, psi + PI - bend));
        Some(Contacts { left: (left.0, s), right: (right.0, t) })
    }

    fn follow(&self, start: Station, sense: Sense) -> Vec<Leg> {
        let mut path = Vec::new();
        let mut now = start;
        // The path visits each pair of pieces a few times at most; the bound ends closed loops.
        for _ in 0..8 * (self.left.len() + self.right.len()) {
            let Some(cell) = self.cell_ahead(&now, sense) else { break };
            let Some(exit) = self.far_side(&cell) else { break };
            let mut inner: Vec<Station> = self.extremes(&cell, &exit).into_iter().flatten().collect();
            if inner.len() == 2 && cell.is_beyond(&inner[0], &inner[1]) {
                inner.swap(0, 1);
            }
            let mut last = Station { contacts: cell.contacts, ..now };
            for station in inner.into_iter().chain([exit]) {
                let leg = Leg { start: last, end: station };
                let turn = self.turn(&leg);
                // Beyond half a turn the curvature of the arc would be infinite.
                if turn.abs() > PI {
                    if sense == Sense::Forward {
                        // Towards a half turn ahead the curvature falls: the throat is passed, and few ask where that turn is.
                        let falls = turn > 0.0 && last.curvature > 0.0;
                        path.push(if falls { leg } else { self.before_infinity(leg) });
                    }
                    return path;
                }
                path.push(match sense {
                    Sense::Forward => leg,
                    Sense::Backward => Leg { start: station, end: last },
                });
                last = station;
            }
            now = exit;
        }
        path
    }

    /// The bend at the end of a leg without whole turns taken off.
    fn turn(&self, leg: &Leg) -> f64 {
        leg.start.bend + self.change_of_bend(&leg.start, &leg.end)
    }

    /// A leg up to a half turn, if it goes on.
    pub(crate) fn up_to_half_turn(&self, leg: &Leg) -> Leg {
        if self.turn(leg).abs() > PI { self.before_infinity(*leg) } else { *leg }
    }

    /// The part of a leg in which arcs turn by less than half a turn, within 1e-6.
    fn before_infinity(&self, leg: Leg) -> Leg {
        const TURN: f64 = PI * (1.0 - 1e-6);
        let bend = |share: f64| {
            let station = self.station(self.share(&leg, share));
            self.turn(&Leg { end: station, ..leg })
        };
        // A double has a 53-bit significand.
        let [low, _] = halved([0.0, 1.0], 53, |share| bend(share).abs() < TURN);
        Leg { end: self.station(self.share(&leg, low)), ..leg }
    }

    /// The position at a fraction of a leg, measured by the contact that moves farther on its piece.
    pub(crate) fn share(&self, leg: &Leg, share: f64) -> Contacts {
        let (start, end) = (leg.start.contacts, leg.end.contacts);
        let (i, j) = (end.left.0, end.right.0);
        let (l, r) = (&self.left[i], &self.right[j]);
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let (s, t) = (mix(start.left.1, end.left.1), mix(start.right.1, end.right.1));
        if is_one_circle(l, r) {
            Contacts { left: (i, s), right: (j, t) }
        } else if (end.left.1 - start.left.1).abs() >= (end.right.1 - start.right.1).abs() {
            let t = r.answer(l.point(s), l.direction(s)).unwrap_or(t);
            Contacts { left: (i, s), right: (j, held(t, start.right.1, end.right.1)) }
        } else {
            let s = l.answer(r.point(t), r.direction(t)).unwrap_or(s);
            Contacts { left: (i, held(s, start.left.1, end.left.1)), right: (j, t) }
        }
    }

    /// β = (μ_l − μ_r + π)/2 up to a constant: its change within a pair of pieces.
    fn change_of_bend(&self, from: &Station, to: &Station) -> f64 {
        let (from, to) = (from.contacts, to.contacts);
        let (left, right) = (&self.left[to.left.0], &self.right[to.right.0]);
        let turn = |piece: &Piece, from: f64, to: f64| (to - from) * (piece.direction[1] - piece.direction[0]);
        0.5 * (turn(left, from.left.1, to.left.1) - turn(right, from.right.1, to.right.1))
    }

    /// The pair of pieces that the path enters, and the signs of both contacts' motion there.
    fn cell_ahead(&self, now: &Station, sense: Sense) -> Option<Cell> {
        let mut contacts = now.contacts;
        // At a corner of four pairs at most three changes are needed.
        for _ in 0..4 {
            let signs = self.motion(contacts, sense);
            let left = entered(contacts.left, signs.0, self.left.len())?;
            let right = entered(contacts.right, signs.1, self.right.len())?;
            if (left, right) == (contacts.left, contacts.right) {
                return Some(Cell { contacts, signs });
            }
            contacts = Contacts { left, right };
        }
        None
    }

    /// The signs of both contacts' motion along the path: the level line of F = μ_l + μ_r − 2 ψ − π, with F > 0 on the side of its left contact.
    fn motion(&self, contacts: Contacts, sense: Sense) -> (f64, f64) {
        let (l, r) = (&self.left[contacts.left.0], &self.right[contacts.right.0]);
        if is_one_circle(l, r) {
            return if sense == Sense::Forward { (1.0, 1.0) } else { (-1.0, -1.0) };
        }
        let d = r.point(contacts.right.1) - l.point(contacts.left.1);
        let ((p, turn_l), (q, turn_r)) = (l.rates(contacts.left.1), r.rates(contacts.right.1));
        let square = d.norm_squared();
        let left = turn_l + 2.0 * cross(d, p) / square;
        let right = turn_r - 2.0 * cross(d, q) / square;
        match sense {
            Sense::Forward => (-right, left),
            Sense::Backward => (right, -left),
        }
    }

    /// Where the path leaves a pair of pieces.
    fn far_side(&self, cell: &Cell) -> Option<Station> {
        let Contacts { left: (i, s), right: (j, t) } = cell.contacts;
        let (l, r) = (&self.left[i], &self.right[j]);
        let far = |sign: f64| if sign > 0.0 { 1.0 } else { 0.0 };
        let (s_far, t_far) = (far(cell.signs.0), far(cell.signs.1));
        if is_one_circle(l, r) {
            return Some(self.station(Contacts { left: (i, s_far), right: (j, t_far) }));
        }
        let t_there = r.answer(l.point(s_far), l.direction(s_far));
        let s_there = l.answer(r.point(t_far), r.direction(t_far));
        // The distance by which an answer lies outside the rest of the piece.
        let outside = |answer: Option<f64>, from: f64, to: f64| {
            answer.map_or(f64::INFINITY, |x| (from.min(to) - x).max(x - from.max(to)).max(0.0))
        };
        let (out_t, out_s) = (outside(t_there, t, t_far), outside(s_there, s, s_far));
        // More than rounding: the pieces meet, or the path ends.
        const ROUNDING: f64 = 1e-6;
        let (s, t) = if out_t <= out_s && out_t < ROUNDING {
            (s_far, held(t_there?, t, t_far))
        } else if out_s < ROUNDING {
            (held(s_there?, s, s_far), t_far)
        } else {
            return None;
        };
        Some(self.station(Contacts { left: (i, s), right: (j, t) }))
    }

    /// Positions of the extremal curvatures strictly between entry and exit of a pair of pieces.
    fn extremes(&self, cell: &Cell, exit: &Station) -> [Option<Station>; 2] {
        let Contacts { left: (i, s0), right: (j, t0) } = cell.contacts;
        let ((_, s1), (_, t1)) = (exit.contacts.left, exit.contacts.right);
        if is_one_circle(&self.left[i], &self.right[j]) {
            return [None, None];
        }
        extreme_circles(&self.left[i], &self.right[j]).map(|circle| {
            let contacts = self.contacts((i, j), &circle?)?;
            let (s, t) = (contacts.left.1, contacts.right.1);
            let inside = |x: f64, a: f64, b: f64| x > a.min(b) && x < a.max(b);
            let mut station = (inside(s, s0, s1) && inside(t, t0, t1)).then(|| self.station(contacts))?;
            station.curvature = circle?.k;
            Some(station)
        })
    }

    /// The contacts of a circle that meets both pieces, possibly outside them. `None` for two straight pieces, where k does not determine the position.
    pub(crate) fn contacts(&self, (i, j): (usize, usize), circle: &Circle) -> Option<Contacts> {
        let (l, r) = (&self.left[i], &self.right[j]);
        let (s, t) = match (turned(l, circle), turned(r, circle)) {
            (Some(s), Some(t)) => (s, t),
            (Some(s), None) => (s, r.answer(l.point(s), l.direction(s))?),
            (None, Some(t)) => (l.answer(r.point(t), r.direction(t))?, t),
            (None, None) => return None,
        };
        Some(Contacts { left: (i, s), right: (j, t) })
    }
}

/// A pair of pieces that the path enters at `contacts`.
struct Cell {
    contacts: Contacts,
    signs: (f64, f64),
}

impl Cell {
    /// Whether `a` lies beyond `b` on the path.
    fn is_beyond(&self, a: &Station, b: &Station) -> bool {
        self.signs.0.signum() * (a.contacts.left.1 - b.contacts.left.1)
            + self.signs.1.signum() * (a.contacts.right.1 - b.contacts.right.1)
            > 0.0
    }
}

/// Whether two pieces are arcs of one circle with one contact angle: a meniscus meets both at that angle wherever its contacts are, and its
/// curvature depends on their distance alone. Its contacts are taken to reach the ends of both at once.
fn is_one_circle(l: &Piece, r: &Piece) -> bool {
    // Rounding of centers, radii and angles.
    const ROUNDING: f64 = 1e-9;
    let (Shape::Turn { center, radius }, Shape::Turn { center: other, radius: size }) = (l.shape, r.shape) else {
        return false;
    };
    let slack = ROUNDING * radius.abs();
    let is_same = (center - other).norm() <= slack && (radius - size).abs() <= slack;
    !l.is_edge() && !r.is_edge() && is_same && (l.angle - r.angle).abs() <= ROUNDING
}

/// The indices 0 to `len` ordered by their distance from `from`.
fn outward(from: usize, len: usize) -> impl Iterator<Item = usize> {
    (0..=len)
        .flat_map(move |k| [Some(from + k), from.checked_sub(k).filter(|_| k > 0)])
        .flatten()
        .filter(move |&i| i <= len)
}

/// The piece and parameter from which a contact continues, given the sign of its motion; `None` at the end of the wall.
fn entered((index, s): (usize, f64), sign: f64, len: usize) -> Option<(usize, f64)> {
    if s >= 1.0 && sign > 0.0 {
        (index + 1 < len).then_some((index + 1, 0.0))
    } else if s <= 0.0 && sign < 0.0 {
        index.checked_sub(1).map(|index| (index, 1.0))
    } else {
        Some((index, s))
    }
}

/// The number clamped to the range between two others.
pub(super) fn held(x: f64, a: f64, b: f64) -> f64 {
    snapped(x.clamp(a.min(b), a.max(b)))
}

/// The parameter of a circle's contact on a circular piece, or at an edge.
fn turned(piece: &Piece, circle: &Circle) -> Option<f64> {
    let Shape::Turn { center, radius } = piece.shape else { return None };
    // X − k c = k R n + v, where v is n rotated by the contact angle.
    let x = circle.x - center * circle.k;
    let (sin, cos) = piece.angle.sin_cos();
    let turn = (-piece.hand.sign() * sin).atan2(circle.k * radius + cos);
    Some(piece.parameter(x.y.atan2(x.x) - turn - piece.offset))
}

/// The condition to meet a piece at its contact angle.
pub(super) fn meets(piece: &Piece) -> Condition {
    let cos = piece.angle.cos();
    match piece.shape {
        Shape::Straight { a, .. } => meets_straight(a, piece.normal(0.0), cos),
        Shape::Turn { center, radius } => meets_round(center, radius, cos),
    }
}
