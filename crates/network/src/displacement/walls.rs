//! The walls along which a meniscus advances through a gate, and the walls ahead that it may touch.
//!
//! Behind and ahead of the gate a contact line can follow the wall up to the next concave corner, where it meets another wall, and up to the
//! widest point of the pore on a concave arc: that nearest to its center, or, where the arc is about this center, that abreast of it. If the
//! next gate leads to a third wall, a convex wall is followed past it by up to half a turn: menisci above 90 degrees burst with contacts far
//! ahead. If it leads back to the other wall of the same passage, the next throat between both begins, and the wall ends for this one. Positions are in the frame of the element that the meniscus enters.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::loops::{Crossing, turn};
use super::mesh::Mesh;
use crate::graph::WallPiece;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::curve::Curve;

/// Rounding error, in rad, of right turns of a smooth wall.
const SMOOTH: f64 = 1e-6;

/// The walls of a gate, oriented by the direction of advance.
#[derive(Debug, Clone, Default)]
pub(super) struct GateWalls {
    /// Pieces on the left, in order behind and ahead of the chord; their curves are directed with the advance.
    pub(crate) left: Sides,
    /// Pieces on the right; their curves are directed against the advance.
    pub(crate) right: Sides,
    /// All other walls of the element ahead.
    pub(crate) ahead: Vec<WallPiece>,
}

/// One wall on both sides of a chord, each side in the order away from the chord.
#[derive(Debug, Clone, Default)]
pub(super) struct Sides {
    /// Against the advance.
    pub(crate) behind: Vec<WallPiece>,
    /// With the advance.
    pub(crate) ahead: Vec<WallPiece>,
}

/// Part of a stretch of wall followed from one of its ends, in this order, and the rest of it.
struct Followed {
    parts: Vec<WallPiece>,
    rest: Vec<WallPiece>,
}

/// The walls of a gate for a meniscus that enters the loop at its end `to`. `centers` are those of the regions.
pub(super) fn gate_walls(mesh: &Mesh, gate: usize, to: usize, centers: &[Vec2]) -> GateWalls {
    let sides = mesh.gates[gate];
    let (into, slot) = sides.crossings[to];
    let (out_of, old_slot) = sides.crossings[1 - to];
    // From the frame of the loop behind to that of the loop ahead.
    let shift = if to == 1 { sides.shift } else { -sides.shift };
    let ahead = ends(mesh, into, slot, centers[mesh.region_of[into]]);
    let behind = ends(mesh, out_of, old_slot, centers[mesh.region_of[out_of]]);
    let moved = |parts: Vec<WallPiece>| parts.into_iter().map(|part| part.shifted(shift)).collect::<Vec<_>>();
    // The wall that leads to the chord on one side continues after the chord on the other side.
    let left = Sides { behind: moved(behind.before.parts), ahead: ahead.after.parts };
    let right = Sides { behind: moved(behind.after.parts), ahead: ahead.before.parts };
    let mut others = ahead.others;
    others.extend(ahead.before.rest);
    others.extend(ahead.after.rest);
    let own: Vec<Curve> =
        [&left, &right].into_iter().flat_map(|s| s.behind.iter().chain(&s.ahead)).map(|p| p.curve).collect();
    let ahead = others.into_iter().map(|piece| untrimmed(piece, &own)).collect();
    GateWalls { left, right, ahead }
}

/// The walls of a loop beside one of its crossings.
struct Ends {
    /// The wall that ends at the crossing, followed backwards.
    before: Followed,
    /// The wall that begins after it.
    after: Followed,
    /// The other walls.
    others: Vec<WallPiece>,
}

fn ends(mesh: &Mesh, index: usize, slot: usize, center: Vec2) -> Ends {
    let part = &mesh.loops[index];
    let count = part.walls.len();
    let next = (slot + 1) % count;
    let Crossing { from, to, .. } = part.crossings[slot];
    let widest = Widest { center, into: -perpendicular(to - from) };
    let mut others: Vec<WallPiece> =
        (0..count).filter(|&k| k != slot && k != next).flat_map(|k| part.walls[k].iter().copied()).collect();
    let seams = (0..part.crossings.len()).flat_map(|k| [part.wall_before(k), part.wall_after(k)]);
    if let Some(seam) = seams.into_iter().find(|seam| *seam != Vec2::zeros()) {
        let beyond = |by: Vec2| others.iter().map(|piece| piece.shifted(by)).collect::<Vec<_>>();
        let both = [beyond(seam), beyond(-seam)].concat();
        others.extend(both);
    }
    // Around a periodic domain the other wall of a passage may be an image of the same one.
    let goes_around = part.wall_before(slot) != part.wall_after(slot);
    if slot != next || goes_around {
        let follow_on = |wall: usize, backwards: bool| {
            let by = if backwards { part.wall_before(slot) } else { part.wall_after(slot) };
            let stretch: Vec<WallPiece> = part.walls[wall].iter().map(|piece| piece.shifted(by)).collect();
            let mut followed = follow(&stretch, backwards, &widest);
            if (count > 2 || goes_around) && followed.rest.is_empty() {
                extend(mesh, index, wall, by, backwards, &mut followed.parts);
            }
            followed
        };
        return Ends { before: follow_on(slot, true), after: follow_on(next, false), others };
    }
    // One wall all around: each side has its half.
    let (first, second) = halves(&part.walls[slot]);
    Ends { before: follow(&second, true, &widest), after: follow(&first, false, &widest), others }
}

/// Follows a wall past the gate at the end of its stretch, as long as it is convex and up to half a turn.
fn extend(mesh: &Mesh, mut index: usize, mut wall: usize, by: Vec2, backwards: bool, parts: &mut Vec<WallPiece>) {
    if let Some(last) = parts.last_mut().filter(|last| last.circle().is_some()) {
        last.curve = half_around(&last.curve, backwards);
        return;
    }
    let mut turned: f64 = parts.iter().map(|piece| sweep(&piece.curve)).sum();
    let mut offset = by;
    // A wall has at most as many stretches as there are crossings.
    for _ in 0..mesh.gates.len() + mesh.loops.len() {
        let crossing = if backwards { wall + mesh.loops[index].walls.len() - 1 } else { wall };
        let crossing = crossing % mesh.loops[index].walls.len();
        let Some((beyond, twin, shift)) = mesh.twin(index, crossing) else { return };
        let (here, there) = (&mesh.loops[index], &mesh.loops[beyond]);
        offset -= if backwards { here.wall_after(crossing) } else { here.wall_before(crossing) };
        offset -= shift;
        offset += if backwards { there.wall_before(twin) } else { there.wall_after(twin) };
        wall = if backwards { twin } else { (twin + 1) % there.walls.len() };
        index = beyond;
        let pieces = &mesh.loops[index].walls[wall];
        for k in 0..pieces.len() {
            let piece = pieces[if backwards { pieces.len() - 1 - k } else { k }].shifted(offset);
            if let Some(last) = parts.last() {
                let (one, next) = if backwards { (&piece.curve, &last.curve) } else { (&last.curve, &piece.curve) };
                turned += turn(one, next);
                if turn(one, next) < -SMOOTH {
                    return;
                }
            }
            turned += sweep(&piece.curve);
            if sweep(&piece.curve) < 0.0 {
                return;
            }
            parts.push(piece);
            if turned > PI {
                return;
            }
        }
    }
}

/// The signed turning angle of a curve in rad.
fn sweep(curve: &Curve) -> f64 {
    match curve {
        Curve::Segment { .. } => 0.0,
        Curve::Arc { sweep, .. } => *sweep,
    }
}

/// A stretch of wall, cut in its middle.
fn halves(wall: &[WallPiece]) -> (Vec<WallPiece>, Vec<WallPiece>) {
    let middle = 0.5 * wall.iter().map(|piece| piece.curve.length()).sum::<f64>();
    let (mut first, mut second, mut passed) = (Vec::new(), Vec::new(), 0.0);
    for piece in wall {
        let length = piece.curve.length();
        if passed + length <= middle {
            first.push(*piece);
        } else if passed >= middle {
            second.push(*piece);
        } else {
            let u = (middle - passed) / length;
            let cut = |curve: Curve| WallPiece::part_of(&curve, curve, piece.shape);
            first.push(cut(piece.curve.part(0.0, u)));
            second.push(cut(piece.curve.part(u, 1.0)));
        }
        passed += length;
    }
    (first, second)
}

/// Where a pore is widest, seen from a gate.
struct Widest {
    /// The center of its inscribed circle in m.
    center: Vec2,
    /// The direction through the gate into the pore.
    into: Vec2,
}

impl Widest {
    /// The parameter of a concave arc up to which the pore widens, for a wall followed forwards or backwards.
    fn on(&self, arc: &Curve, backwards: bool) -> f64 {
        // Distance of two centers over the radius below which they are one.
        const SAME_CENTER: f64 = 1e-4;
        // Fraction of an arc that is rounding.
        const ROUNDING: f64 = 1e-9;
        let Curve::Arc { center, radius, start, sweep } = *arc else { return arc.project(self.center).u };
        if (center - self.center).norm() > SAME_CENTER * radius {
            return arc.project(self.center).u;
        }
        // A wall on the left of the advance runs with it and turns to the right: abreast of the center it has the direction of the advance.
        let abreast = (self.into.y.atan2(self.into.x) + FRAC_PI_2) + if backwards { PI } else { 0.0 };
        let near = if backwards { start + sweep } else { start };
        // The angle to turn from the near end of the arc until abreast, below 0 if that is behind.
        let turned = (abreast - near) * if backwards { -sweep.signum() } else { sweep.signum() };
        let ahead = (turned + PI).rem_euclid(TAU) - PI;
        let share = (ahead / sweep.abs()).clamp(0.0, 1.0);
        let share = if share < ROUNDING { 0.0 } else { share };
        if backwards { 1.0 - share } else { share }
    }
}

/// Follows a stretch of wall from its start, or backwards from its end.
fn follow(wall: &[WallPiece], backwards: bool, widest: &Widest) -> Followed {
    let mut parts: Vec<WallPiece> = Vec::new();
    let order: Vec<usize> = if backwards { (0..wall.len()).rev().collect() } else { (0..wall.len()).collect() };
    for (step, &k) in order.iter().enumerate() {
        let piece = wall[k];
        let is_concave_corner = parts.last().is_some_and(|last| {
            let (one, next) = if backwards { (&piece.curve, &last.curve) } else { (&last.curve, &piece.curve) };
            turn(one, next) < -SMOOTH
        });
        if is_concave_corner {
            return Followed { parts, rest: order[step..].iter().map(|&k| wall[k]).collect() };
        }
        let is_concave = matches!(piece.curve, Curve::Arc { sweep, .. } if sweep < 0.0);
        if is_concave {
            let widest = widest.on(&piece.curve, backwards);
            let (kept, left) = if backwards { (widest < 1.0, widest > 0.0) } else { (widest > 0.0, widest < 1.0) };
            let part = |from: f64, to: f64| WallPiece { curve: piece.curve.part(from, to), ..piece };
            if kept {
                parts.push(if backwards { part(widest, 1.0) } else { part(0.0, widest) });
            }
            if left {
                let mut rest = vec![if backwards { part(0.0, widest) } else { part(widest, 1.0) }];
                rest.extend(order[step + 1..].iter().map(|&k| wall[k]));
                return Followed { parts, rest };
            }
            continue;
        }
        parts.push(piece);
    }
    Followed { parts, rest: Vec::new() }
}

/// A disc from the near end of an arc of it as far as the opposite point.
fn half_around(arc: &Curve, backwards: bool) -> Curve {
    match *arc {
        Curve::Arc { center, radius, start, sweep } => {
            let half = PI.copysign(sweep);
            let start = if backwards { start + sweep - half } else { start };
            Curve::Arc { center, radius, start, sweep: half }
        }
        segment @ Curve::Segment { .. } => segment,
    }
}

/// A disc ahead is taken as a whole, unless it is one of the walls along which the meniscus moves.
fn untrimmed(piece: WallPiece, own: &[Curve]) -> WallPiece {
    let whole = piece.circle().filter(|circle| own.iter().all(|curve| !is_same(curve, circle)));
    whole.map_or(piece, |curve| WallPiece { curve, ..piece })
}

/// Whether two arcs are on the same circle; arcs are only copied and shifted by whole periods.
pub(super) fn is_same(a: &Curve, b: &Curve) -> bool {
    const ROUNDING: f64 = 1e-9;
    match (a, b) {
        (Curve::Arc { center, radius, .. }, Curve::Arc { center: other, radius: r, .. }) => {
            (center - other).norm() <= ROUNDING * radius && (radius - r).abs() <= ROUNDING * radius
        }
        _ => false,
    }
}
