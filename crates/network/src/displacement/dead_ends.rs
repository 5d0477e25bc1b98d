//! Dead ends of a loop: passages bounded by one wall on both sides that do not widen past their mouth.
//!
//! The wall distance does not rise from the mouth to the end, so no saddle separates a dead end from its pore. Its menisci have an event
//! nevertheless: they enter at the largest curvature between both of its walls. A mouth is the chord between a point where a wall turns into
//! the passage and the facing wall; from there on both walls are parallel within a small angle. Chords of mouths divide a loop as segments
//! do. Notches shallower than half of their width, and wedges, are not dead ends.

use std::f64::consts::PI;

use super::divide::holds_segment;
use super::loops::{Crossing, GateId, Loop, WallPoint, after, before, turn};
use crate::graph::{Stretch, WallPiece};
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;

/// Least angle in rad by which an edge turns into a passage.
const TURNS_IN: f64 = 0.2;
/// Largest angle in rad between both walls of a dead end.
const CONVERGES: f64 = 0.6;
/// Free radius around the middle of the chord over half its length: below 1 since walls may converge by that angle.
const FREE: f64 = 0.95;
/// Maximum number of chords examined per stretch of wall, the longest dead ends first.
const MOST_CHORDS: usize = 64;

/// The chord across the mouth of a dead end, from where the wall enters to where it leaves.
struct Mouth {
    wall: usize,
    from: WallPoint,
    to: WallPoint,
    /// Length of the wall in between in m.
    length: f64,
}

impl Mouth {
    /// Order: the longest dead end first, for one dead end the shortest chord.
    fn order(a: &Self, b: &Self) -> std::cmp::Ordering {
        let chord = |mouth: &Self| (mouth.to.point - mouth.from.point).norm();
        b.length.total_cmp(&a.length).then(chord(a).total_cmp(&chord(b)))
    }
}

/// The loop without its dead ends, and the dead ends. `center` is that of the inscribed circle of the region. Segments are numbered from
/// `segments` on, which is advanced.
pub(super) fn cut_dead_ends(whole: Loop, center: Vec2, segments: &mut usize) -> Vec<Loop> {
    let is_bent = |wall: &Stretch| turns(wall).iter().filter(|turn| **turn < 0.0).sum::<f64>() < CONVERGES - PI;
    if whole.has_seam || whole.crossings.len() != whole.walls.len() || !whole.walls.iter().any(is_bent) {
        return vec![whole];
    }
    let mut found = Vec::new();
    let mut left = whole;
    while let Some(mouth) = mouth(&left, center) {
        let [rest, dead_end] = left.cut_within(&mouth, *segments);
        *segments += 1;
        found.push(dead_end);
        left = rest;
    }
    found.insert(0, left);
    found
}

/// Turning angles of a wall in rad, positive to the left, alternating between each piece and the joint after it.
fn turns(wall: &[WallPiece]) -> Vec<f64> {
    let mut found = Vec::with_capacity(2 * wall.len());
    for (k, piece) in wall.iter().enumerate() {
        found.push(if let Curve::Arc { sweep, .. } = piece.curve { sweep } else { 0.0 });
        found.push(wall.get(k + 1).map_or(0.0, |next| turn(&piece.curve, &next.curve)));
    }
    found
}

/// The mouth of the longest dead end of a loop.
fn mouth(part: &Loop, center: Vec2) -> Option<Mouth> {
    let mut mouths: Vec<Mouth> = (0..part.walls.len()).flat_map(|wall| chords(part, wall)).collect();
    mouths.sort_by(Mouth::order);
    let curves = part.curves();
    mouths.into_iter().find(|mouth| {
        let (p, q) = (mouth.from.point, mouth.to.point);
        let (middle, half) = (0.5 * (p + q), 0.5 * (q - p).norm());
        let is_apart = |piece: &WallPiece| (piece.curve.project(middle).point - middle).norm() >= FREE * half;
        let is_free = || part.walls.iter().flat_map(|wall| wall.iter()).all(is_apart);
        let is_outside = || {
            let inner = inner(&part.walls[mouth.wall], mouth);
            let closing = Curve::Segment { a: q, b: p };
            let winding: f64 = inner.iter().map(|piece| piece.curve.winding(center)).sum();
            (winding + closing.winding(center)).abs() < PI
        };
        is_free() && is_outside() && holds_segment(&curves, 0, p, q)
    })
}

/// The chords between a point where a wall turns into a passage and the facing wall.
fn chords(part: &Loop, wall: usize) -> Vec<Mouth> {
    let pieces = &part.walls[wall];
    let turns = turns(pieces);
    let length = |pieces: &[WallPiece]| pieces.iter().map(|piece| piece.curve.length()).sum::<f64>();
    let is_convex = |k: usize| matches!(pieces[k].curve, Curve::Arc { sweep, .. } if sweep > 0.0);
    // Joints at which the wall turns in, followed forwards and backwards.
    let enters = |k: usize| k > 0 && (turns[2 * k - 1] > TURNS_IN || (is_convex(k - 1) && !is_convex(k)));
    let leaves =
        |k: usize| k + 1 < pieces.len() && (turns[2 * k + 1] > TURNS_IN || (is_convex(k + 1) && !is_convex(k)));
    let mut found = Vec::new();
    for first in 0..pieces.len() {
        let mut turned = turns[2 * first];
        for last in first + 1..pieces.len() {
            turned += turns[2 * last - 1] + turns[2 * last];
            // Two walls that meet in an edge form a wedge.
            let is_wedge = last == first + 1;
            if is_wedge || (turned + PI).abs() > CONVERGES || !(enters(first) || leaves(last)) {
                continue;
            }
            let (p, q) = (pieces[first].curve.point(0.0), pieces[last].curve.point(1.0));
            let start = WallPoint { piece: first, u: 0.0, point: p };
            let end = WallPoint { piece: last, u: 1.0, point: q };
            let between = length(&pieces[first..=last]);
            let mut add = |from, to| found.push(Mouth { wall, from, to, length: between });
            // The facing wall may continue past the edge.
            if enters(first) {
                let closest = pieces[last].curve.project(p);
                if closest.u > 0.0 {
                    add(start, WallPoint { piece: last, u: closest.u, point: closest.point });
                }
            }
            if leaves(last) {
                let closest = pieces[first].curve.project(q);
                if closest.u < 1.0 {
                    add(WallPoint { piece: first, u: closest.u, point: closest.point }, end);
                }
            }
        }
    }
    found.sort_by(Mouth::order);
    found.truncate(MOST_CHORDS);
    found
}

/// The wall of a dead end.
fn inner(wall: &[WallPiece], mouth: &Mouth) -> Stretch {
    let Mouth { from, to, .. } = mouth;
    after(&before(wall, *to), *from)
}

impl Loop {
    /// The loop without a dead end, and the dead end.
    fn cut_within(&self, mouth: &Mouth, segment: usize) -> [Self; 2] {
        let Mouth { wall, from, to, .. } = mouth;
        let crossing =
            |side: u8, from: Vec2, to: Vec2| Crossing { gate: GateId::Segment(segment as u32, side), from, to };
        let mut rest = self.clone();
        rest.walls[*wall] = before(&self.walls[*wall], *from);
        rest.walls.insert(wall + 1, after(&self.walls[*wall], *to));
        rest.crossings.insert(*wall, crossing(0, from.point, to.point));
        let dead_end = Self {
            walls: vec![inner(&self.walls[*wall], mouth)],
            crossings: vec![crossing(1, to.point, from.point)],
            ..Self::default()
        };
        [rest, dead_end]
    }
}
