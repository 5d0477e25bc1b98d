//! The passage of a meniscus between the two walls of a throat: its position, its burst, its contact with a third wall.
//!
//! All menisci that meet the walls at their contact angles form a path from behind the throat to ahead of it (see `path`). As the pressure rises slowly a
//! meniscus moves to the first position on the path that has the applied curvature; where the curvature of the path falls, it jumps (Haines jump). At the end
//! of the largest rise of the curvature it bursts and has passed the throat.
//!
//! Not included: contact of a meniscus with its own two walls ahead of its contacts (in deep notches below 90 degrees); films; gravity.

use crate::curve::{Curve, cross};
use crate::interface::menisci::circle::{Circle, circles, has_curvature};
use crate::interface::menisci::meniscus::Meniscus;
use crate::interface::menisci::obstacle::Obstacle;
use crate::interface::menisci::path::{Contacts, Leg, Station, Walls, held, meets};
use crate::interface::menisci::wall::{Contact, Hand, Piece, Wall, pieces};
use meniscus_core::math::{Vec2, halved};

/// The two walls of a throat and all menisci between them.
#[derive(Debug, Clone)]
pub struct Passage {
    left: Wall,
    right: Wall,
    walls: Walls,
    origin: Vec2,
    scale: f64,
    /// The stable part of the path: along the largest rise of the curvature, up to the burst.
    path: Vec<Leg>,
    /// The rest of the path: menisci of a given area, which are unstable at fixed pressure.
    beyond: Vec<Leg>,
    lowest: Option<Station>,
    highest: Option<Station>,
}

impl Passage {
    /// The passage between two walls, viewed in the direction of advance: curves of the left wall run with the advance, those of the right wall against it.
    /// The cost grows with the number of parts.
    pub fn new(mut left: Wall, mut right: Wall) -> Self {
        for wall in [&mut left, &mut right] {
            wall.behind = wall.behind.min(wall.parts.len());
        }
        let (origin, other) = (chord_end(&left, Hand::Left), chord_end(&right, Hand::Right));
        let (origin, other) = (origin.unwrap_or_default(), other.unwrap_or_default());
        let width = (other - origin).norm();
        let scale = if width > 0.0 { width } else { 1.0 };
        let (left_pieces, left_chord) = pieces(&left, Hand::Left, origin, scale);
        let (right_pieces, right_chord) = pieces(&right, Hand::Right, origin, scale);
        let walls = Walls { left: left_pieces, right: right_pieces };
        let (lowest, highest, path, beyond) = stable_part(walls.path((left_chord, right_chord)));
        Self { left, right, walls, origin, scale, path, beyond, lowest, highest }
    }

    /// The left wall.
    pub fn left(&self) -> &Wall {
        &self.left
    }

    /// The right wall.
    pub fn right(&self) -> &Wall {
        &self.right
    }

    /// The meniscus of the largest curvature in the throat: beyond it the throat is passed \[CieplakRobbins1988\]. It may lie at the end of a wall.
    pub fn burst(&self) -> Option<Meniscus> {
        self.highest.map(|station| self.meniscus(&station))
    }

    /// The meniscus of the smallest curvature before the burst: below it the meniscus recedes from the throat.
    pub fn lowest(&self) -> Option<Meniscus> {
        self.lowest.map(|station| self.meniscus(&station))
    }

    /// The advancing meniscus at the curvature `k` (1/m): the first position on the path where the curvature reaches it. The lowest meniscus if all have a
    /// larger curvature, `None` beyond the burst.
    pub fn at(&self, k: f64) -> Option<Meniscus> {
        let (lowest, highest) = (self.lowest?, self.highest?);
        // The curvature returned by `burst` must give the burst, whatever its last digit.
        let slack = 8.0 * f64::EPSILON * highest.curvature.abs();
        let k = if (k * self.scale - highest.curvature).abs() <= slack { highest.curvature } else { k * self.scale };
        if k <= lowest.curvature {
            return Some(self.meniscus(&lowest));
        }
        let rise = self.path.iter().find(|leg| leg.end.curvature >= k)?;
        Some(self.meniscus(&self.walls.on_leg(rise, k)))
    }

    /// The smallest curvature, at most `up_to` (1/m), at which the meniscus touches a third wall \[CieplakRobbins1988\]. Independent of the contact angle
    /// there.
    pub fn touch(&self, obstacle: &[Curve], up_to: f64) -> Option<f64> {
        let up_to = up_to * self.scale;
        let lowest = self.lowest.filter(|lowest| lowest.curvature <= up_to)?;
        if obstacle.iter().any(|curve| self.meniscus(&lowest).touches_ahead(curve)) {
            return Some(lowest.curvature / self.scale);
        }
        let obstacle = Obstacle::new(obstacle, self.origin, self.scale);
        // The curvature needed to get there: the maximum along the path so far.
        let mut reached = lowest.curvature;
        for leg in self.path.iter().take_while(|leg| leg.start.curvature <= up_to) {
            if let Some((_, k)) = obstacle.first_contacts(&self.walls, leg) {
                let k = reached.max(k);
                return (k <= up_to).then_some(k / self.scale);
            }
            reached = reached.max(leg.end.curvature);
            if reached > up_to {
                break;
            }
        }
        None
    }

    /// The meniscus that first touches a line ahead as the area that has passed the throat grows, also beyond the burst: along the walls as far as it meets
    /// both at their contact angles, then with its contacts at their last positions. The line is an open side with the pore on its right.
    pub fn reach(&self, line: &Curve) -> Option<Meniscus> {
        let obstacle = Obstacle::new(&[*line], self.origin, self.scale);
        let mut legs = self.path.iter().chain(&self.beyond).map(|leg| self.walls.up_to_half_turn(leg));
        if let Some((contacts, k)) = legs.find_map(|leg| obstacle.first_contacts(&self.walls, &leg)) {
            return Some(self.meniscus(&Station { curvature: k, ..self.walls.station(contacts) }));
        }
        let last = self.beyond.last().or(self.path.last()).map(|leg| self.walls.up_to_half_turn(leg).end);
        let last = last.or(self.highest)?;
        let last = self.meniscus(&last);
        last.grown_to(line.point(0.0), line.normal(0.5)).or(Some(last))
    }

    /// Whether a point lies ahead of the line through the chord of the throat, by more than rounding: two menisci pinned at the same edge, in throats on both
    /// sides of it, have a common point there.
    pub(crate) fn is_ahead(&self, x: Vec2) -> bool {
        // Fraction of the chord; of the intersection of arcs that are nearly tangent only half of the digits are accurate.
        const ROUNDING: f64 = 1e-6;
        let chord = chord_end(&self.right, Hand::Right).unwrap_or_default() - self.origin;
        cross(chord, x - self.origin) > ROUNDING * chord.norm_squared()
    }

    /// Area in m² swept by the meniscus from the chord of the throat: between chord, walls and arc.
    pub fn swept_area(&self, meniscus: &Meniscus) -> f64 {
        let (p, q) = (self.origin, chord_end(&self.right, Hand::Right).unwrap_or_default());
        let along = |wall: &Wall, contact: &Contact, hand: Hand| {
            let (first, last) = (wall.behind, contact.part);
            let begin = if hand == Hand::Left { 0.0 } else { 1.0 };
            let part = |i: usize, from: f64, to: f64| {
                let area = wall.parts[i].curve.part(from.min(to), from.max(to)).area_about(p);
                if (to - from) * (1.0 - 2.0 * begin) < 0.0 { -area } else { area }
            };
            if last >= first {
                let whole: f64 = (first..last).map(|i| part(i, begin, 1.0 - begin)).sum();
                whole + part(last, begin, contact.u)
            } else {
                let whole: f64 = (last + 1..first).map(|i| part(i, 1.0 - begin, begin)).sum();
                whole + part(last, 1.0 - begin, contact.u)
            }
        };
        let walls = along(&self.left, &meniscus.left, Hand::Left) + along(&self.right, &meniscus.right, Hand::Right);
        let triangle = |a: Vec2, b: Vec2| 0.5 * cross(a - p, b - p);
        triangle(p, q) - walls + triangle(meniscus.right.point, meniscus.left.point) + meniscus.area_from_chord()
    }

    fn meniscus(&self, station: &Station) -> Meniscus {
        let local = self.walls.meniscus(station);
        let contact = |contact: Contact| Contact {
            point: self.origin + contact.point * self.scale,
            advance: contact.advance * self.scale,
            ..contact
        };
        Meniscus {
            curvature: local.curvature / self.scale,
            left: contact(local.left),
            right: contact(local.right),
            bend: local.bend,
        }
    }
}

impl Walls {
    pub(super) fn meniscus(&self, station: &Station) -> Meniscus {
        let Contacts { left: (i, s), right: (j, t) } = station.contacts;
        let (left, right) = (contact(&self.left[i], s), contact(&self.right[j], t));
        Meniscus { curvature: station.curvature, left, right, bend: station.bend }
    }

    /// The meniscus of curvature `k` on a leg whose curvatures bracket k.
    fn on_leg(&self, leg: &Leg, k: f64) -> Station {
        let Contacts { left: (i, _), right: (j, _) } = leg.end.contacts;
        let found = circles([meets(&self.left[i]), meets(&self.right[j]), has_curvature(k)]);
        let contacts = found.into_iter().flatten().find_map(|circle| self.contacts_on(leg, &circle));
        let station = self.station(contacts.unwrap_or_else(|| self.bisect(leg, k)));
        Station { curvature: k, ..station }
    }

    /// The contacts of a circle if both lie on a leg.
    pub(super) fn contacts_on(&self, leg: &Leg, circle: &Circle) -> Option<Contacts> {
        let (start, end) = (leg.start.contacts, leg.end.contacts);
        let contacts = self.contacts((end.left.0, end.right.0), circle)?;
        // Rounding; a double root has only half the digits.
        const SLACK: f64 = 1e-7;
        let inside = |x: f64, a: f64, b: f64| x > a.min(b) - SLACK && x < a.max(b) + SLACK;
        let left = inside(contacts.left.1, start.left.1, end.left.1);
        (left && inside(contacts.right.1, start.right.1, end.right.1)).then(|| Contacts {
            left: (contacts.left.0, held(contacts.left.1, start.left.1, end.left.1)),
            right: (contacts.right.0, held(contacts.right.1, start.right.1, end.right.1)),
        })
    }

    fn bisect(&self, leg: &Leg, k: f64) -> Contacts {
        // One halving per bit of the significand.
        let is_below = |share: f64| self.station(self.share(leg, share)).curvature < k;
        let [_, high] = halved([0.0, 1.0], 52, |share| is_below(share) == (leg.start.curvature < k));
        self.share(leg, high)
    }
}

fn contact(piece: &Piece, s: f64) -> Contact {
    let u = if piece.is_edge() { 1.0 } else { s };
    let u = match piece.hand {
        Hand::Left => u,
        Hand::Right => 1.0 - u,
    };
    Contact { part: piece.part, u, point: piece.point(s), advance: piece.advance_at(s) }
}

/// The end of the throat's chord on a wall.
fn chord_end(wall: &Wall, hand: Hand) -> Option<Vec2> {
    let begin = if hand == Hand::Left { 0.0 } else { 1.0 };
    let ahead = wall.parts.get(wall.behind).map(|part| part.curve.point(begin));
    ahead.or_else(|| wall.parts.last().map(|part| part.curve.point(1.0 - begin)))
}

/// The ends of the largest rise of the curvature along the path, the legs in between, and those beyond. Curvatures fall behind the throat, and again ahead of
/// it: larger ones far behind do not belong to the throat.
fn stable_part(mut path: Vec<Leg>) -> (Option<Station>, Option<Station>, Vec<Leg>, Vec<Leg>) {
    let Some(start) = path.first().map(|leg| leg.start) else { return (None, None, path, Vec::new()) };
    // Each end with the number of legs before it.
    let mut low = (start, 0);
    let (mut lowest, mut highest) = (low, low);
    for (i, leg) in path.iter().enumerate() {
        let end = (leg.end, i + 1);
        if end.0.curvature <= low.0.curvature {
            low = end;
        }
        if end.0.curvature - low.0.curvature > highest.0.curvature - lowest.0.curvature {
            (lowest, highest) = (low, end);
        }
    }
    let beyond = path.split_off(highest.1);
    path.drain(..lowest.1);
    (Some(lowest.0), Some(highest.0), path, beyond)
}

/// Reference quantities for tests.
#[cfg(test)]
impl Passage {
    /// The same throat traversed in the opposite direction with the phases exchanged: its burst is minus the smallest curvature of this passage.
    pub(crate) fn reversed(&self) -> Self {
        use crate::interface::menisci::wall::WallPart;
        use std::f64::consts::PI;
        let turned = |wall: &Wall| {
            let part = |part: &WallPart| WallPart { angle: PI - part.angle, ..*part };
            let parts: Vec<_> = wall.parts.iter().rev().map(part).collect();
            Wall { behind: parts.len() - wall.behind.min(parts.len()), parts }
        };
        Self::new(turned(&self.right), turned(&self.left))
    }
}
