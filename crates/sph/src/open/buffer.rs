//! Buffers beyond open sides: initial filling, and the exchange of particles with the fluid.

use crate::open::boundary_fluxes::BoundaryFluxes;
use crate::open::side::OpenSide;
use crate::particles::{Particles, Phase};
use meniscus_core::math::{Bounds, Vec2};

/// Minimum distance of a new particle from others, in units of dx: otherwise a row that moved outwards and back would become overcrowded.
const ROOM: f64 = 0.5;

/// Surroundings of the buffers at time zero.
pub(crate) struct Around<'a> {
    /// The box.
    pub(crate) bounds: Bounds,
    /// Spacing of the lattice along x and y in m.
    pub(crate) step: Vec2,
    /// Depth of wall layers in m.
    pub(crate) support: f64,
    /// Sides that are walls: left, right, bottom, top.
    pub(crate) walls: [bool; 4],
    /// Signed distance in m; beyond open sides that of the nearest point on the side.
    pub(crate) signed_distance: &'a dyn Fn(Vec2) -> f64,
    /// Phase of a fluid particle.
    pub(crate) phase: &'a dyn Fn(Vec2) -> Phase,
}

/// A row of particles along the normal of a side.
struct Row {
    /// Coordinate along the side in m.
    y: f64,
    /// Spacing of its particles in m.
    step: f64,
    /// Number of particles.
    count: usize,
    /// Whether it lies in an opening.
    is_open: bool,
}

/// The rows of a side from its lower end: rows of equal width fill each opening and each solid between two of them; solids at the ends of the
/// side extend as far as `around` requires.
fn rows(side: &OpenSide, around: &Around) -> Vec<Row> {
    let (along, axis) = (1 - side.axis(), side.axis());
    let (min, max, spacing) = (around.bounds.min[along], around.bounds.max[along], around.step[along]);
    let deep = (side.depth / around.step[axis]).round() as usize;
    let solid = |y: f64| Row { y, step: around.step[axis], count: deep, is_open: false };
    let equal = |from: f64, to: f64, count: usize| {
        (0..count).map(move |j| from + (to - from) * (j as f64 + 0.5) / count as f64)
    };
    // Walls at the ends of the side are extended as well; beyond mirrors and periodic sides there are copies.
    let end = |number: usize, edge: f64, outer: f64| {
        let length = (outer - edge).abs();
        let (length, count) = if around.walls[2 * along + number] {
            let count = ((length + around.support) / spacing).ceil();
            (count * spacing, count as usize)
        } else {
            (length, (length / spacing).round() as usize)
        };
        let outwards = if number == 0 { -1.0 } else { 1.0 };
        equal(edge, edge + outwards * length, count).map(solid).collect::<Vec<Row>>()
    };
    let [Some(first), Some(last)] = [side.openings.first(), side.openings.last()] else { return Vec::new() };
    let mut rows: Vec<Row> = end(0, first.from, min).into_iter().rev().collect();
    for (i, opening) in side.openings.iter().enumerate() {
        if let Some(before) = i.checked_sub(1).map(|before| side.openings[before].to) {
            let count = ((opening.from - before) / spacing).round().max(1.0) as usize;
            rows.extend(equal(before, opening.from, count).map(solid));
        }
        let (step, count) = (side.spacing_in(opening), side.count_in(opening));
        let open = |y: f64| Row { y, step, count, is_open: true };
        rows.extend(equal(opening.from, opening.to, opening.rows(side.row_spacing)).map(open));
    }
    rows.extend(end(1, last.to, max));
    rows
}

/// Fills the buffers, and extends the walls beyond the open sides; appends the depths of the new wall particles to `wall_depth` (m).
pub(crate) fn fill(particles: &mut Particles, wall_depth: &mut Vec<f64>, sides: &[OpenSide], around: &Around) {
    let (fluids, before) = (particles.fluids, particles.len());
    let (mut buffer, mut walls) = (Vec::new(), Vec::new());
    for side in sides {
        let (along, axis) = (1 - side.axis(), side.axis());
        for row in rows(side, around) {
            let mut y = Vec2::zeros();
            y[along] = row.y;
            for i in 0..row.count {
                let x = side.projected(y, (i as f64 + 0.5) * row.step);
                let d = (around.signed_distance)(x);
                if row.is_open {
                    buffer.push(particles.len());
                    let at_side = side.projected(x, -0.5 * around.step[axis]);
                    let phase = side.inflow_phase.unwrap_or_else(|| (around.phase)(at_side));
                    particles.append(phase, x);
                } else if d > -around.support {
                    walls.push(particles.len());
                    wall_depth.push((-d).max(0.0));
                    particles.append(Phase::Solid, x);
                }
            }
        }
    }
    let order: Vec<usize> = (0..fluids).chain(buffer.iter().copied()).chain(fluids..before).chain(walls).collect();
    particles.arrange(&order, fluids, buffer.len());
}

/// Adds the area that came in through sides with a given velocity while the particles of their buffers moved from the positions `from` (m).
pub(crate) fn note_passed(from: &[Vec2], particles: &Particles, sides: &[OpenSide], fluxes: &mut BoundaryFluxes) {
    for b in particles.buffer() {
        let Some(side) = sides.iter().find(|side| side.overshoot(from[b]) >= 0.0) else { continue };
        if side.given_pressure().is_none() {
            let inwards = side.overshoot(from[b]) - side.overshoot(particles.position[b]);
            fluxes.passed[side.number] += inwards * side.cell / side.depth_at(from[b]);
        }
    }
}

/// Turns particles that crossed an open side from fluid into buffer particles or back \[Tafuni2018; Hirschler2016\]. `spacing` in m.
pub(crate) fn exchange(particles: &mut Particles, sides: &[OpenSide], fluxes: &mut BoundaryFluxes, spacing: f64) {
    let (mut fluid, mut buffer, mut entered) = (Vec::new(), Vec::new(), Vec::new());
    for a in 0..particles.fluids {
        match sides.iter().find(|side| side.overshoot(particles.position[a]) > 0.0) {
            Some(side) => {
                fluxes.count_outflow(side.number, particles.phase[a]);
                buffer.push(a);
            }
            None => fluid.push(a),
        }
    }
    for b in particles.buffer() {
        let x = particles.position[b];
        let Some(side) = sides.iter().max_by(|s, t| s.overshoot(x).total_cmp(&t.overshoot(x))) else {
            continue;
        };
        let beyond = side.overshoot(x);
        if beyond < 0.0 {
            fluxes.count_inflow(side.number, particles.phase[b]);
            entered.push((b, side));
        } else if beyond < side.depth_at(x) {
            buffer.push(b);
        }
    }
    if entered.is_empty() && fluid.len() + buffer.len() == particles.moving() && fluid.len() == particles.fluids {
        return;
    }
    for (b, side) in entered {
        fluid.push(b);
        let x = particles.position[b];
        let end = side.projected(x, side.overshoot(x) + side.depth_at(x));
        let room = ROOM * spacing;
        if buffer.iter().all(|&c| (particles.position[c] - end).norm_squared() > room * room) {
            buffer.push(particles.len());
            particles.append_like(b, side.inflow_phase.unwrap_or(particles.phase[b]), end, fluxes.new_id());
        }
    }
    // New particles come after the walls in memory until `arrange`.
    let walls = particles.moving()..particles.moving() + particles.walls;
    let order: Vec<usize> = fluid.iter().chain(&buffer).copied().chain(walls).collect();
    particles.arrange(&order, fluid.len(), buffer.len());
}
