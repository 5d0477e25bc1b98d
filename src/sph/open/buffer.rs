//! The buffers beyond open sides: how they are filled, and how particles pass between them and the fluid.

use crate::math::{Bounds, Vec2};
use crate::sph::open::{Ledger, OpenSide};
use crate::sph::particles::{Particles, Phase};

/// A new particle needs so much room, in units of dx: less would crowd a file that came back in after a single move outwards.
const ROOM: f64 = 0.5;

/// What stands around the buffers at time zero.
pub struct Around<'a> {
    /// The box.
    pub bounds: Bounds,
    /// Distance of neighboring lattice points in m.
    pub step: Vec2,
    /// Depth of wall layers in m.
    pub support: f64,
    /// Sides that are walls: left, right, bottom, top.
    pub walls: [bool; 4],
    /// Signed distance in m; beyond open sides that of the place on the side.
    pub signed_distance: &'a dyn Fn(Vec2) -> f64,
    /// Phase of a fluid particle.
    pub phase: &'a dyn Fn(Vec2) -> Phase,
}

/// Fills the buffers, and carries the walls on beyond the open sides; `wall_depth` in m gets the depths of the new wall particles.
pub fn fill(particles: &mut Particles, wall_depth: &mut Vec<f64>, sides: &[OpenSide], around: &Around) {
    let (fluids, before) = (particles.fluids, particles.len());
    let (mut buffer, mut walls) = (Vec::new(), Vec::new());
    for side in sides {
        let (along, axis) = (1 - side.axis(), side.axis());
        let size = around.bounds.size()[along];
        let count = (size / around.step[along]).round() as i64;
        // Walls at the ends of the side go on as well; beyond mirrors and periodic sides stand copies.
        let more = |end: usize| {
            if around.walls[2 * along + end] { (around.support / around.step[along]).ceil() as i64 } else { 0 }
        };
        let deep = (side.depth / around.step[axis]).round() as i64;
        for j in -more(0)..count + more(1) {
            for i in 0..deep {
                let mut x = Vec2::zeros();
                x[along] = around.bounds.min[along] + (j as f64 + 0.5) * around.step[along];
                let x = side.placed(x, (i as f64 + 0.5) * around.step[axis]);
                let d = (around.signed_distance)(x);
                if d > 0.0 && (0..count).contains(&j) {
                    buffer.push(particles.len());
                    let at_side = side.placed(x, -0.5 * around.step[axis]);
                    let phase = side.enters.unwrap_or_else(|| (around.phase)(at_side));
                    particles.append(phase, x);
                } else if d <= 0.0 && d > -around.support {
                    walls.push(particles.len());
                    wall_depth.push(-d);
                    particles.append(Phase::Solid, x);
                }
            }
        }
    }
    let order: Vec<usize> = (0..fluids).chain(buffer.iter().copied()).chain(fluids..before).chain(walls).collect();
    particles.arrange(&order, fluids, buffer.len());
}

/// Lets the particles that crossed an open side change from fluid to buffer or back; `spacing` in m.
pub fn exchange(particles: &mut Particles, sides: &[OpenSide], ledger: &mut Ledger, spacing: f64) {
    let (mut fluid, mut buffer, mut entered) = (Vec::new(), Vec::new(), Vec::new());
    for a in 0..particles.fluids {
        match sides.iter().find(|side| side.beyond(particles.position[a]) > 0.0) {
            Some(side) => {
                ledger.leaves(side.number, particles.phase[a]);
                buffer.push(a);
            }
            None => fluid.push(a),
        }
    }
    for b in particles.buffer() {
        let x = particles.position[b];
        let Some(side) = sides.iter().max_by(|s, t| s.beyond(x).total_cmp(&t.beyond(x))) else { continue };
        let beyond = side.beyond(x);
        if beyond < 0.0 {
            ledger.comes(side.number, particles.phase[b]);
            entered.push((b, side));
        } else if beyond < side.depth {
            buffer.push(b);
        }
    }
    if entered.is_empty() && fluid.len() + buffer.len() == particles.moving() && fluid.len() == particles.fluids {
        return;
    }
    for (b, side) in entered {
        fluid.push(b);
        let x = particles.position[b];
        let end = side.placed(x, side.beyond(x) + side.depth);
        let room = ROOM * spacing;
        if buffer.iter().all(|&c| (particles.position[c] - end).norm_squared() > room * room) {
            buffer.push(particles.len());
            particles.append_like(b, side.enters.unwrap_or(particles.phase[b]), end, ledger.name());
        }
    }
    // New particles stand behind the walls until they are put in their place.
    let walls = particles.moving()..particles.moving() + particles.walls;
    let order: Vec<usize> = fluid.iter().chain(&buffer).copied().chain(walls).collect();
    particles.arrange(&order, fluid.len(), buffer.len());
}
