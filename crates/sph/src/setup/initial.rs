//! The state at time zero: phases, velocities and pressures.

use std::f64::consts::TAU;

use super::walls::wall_velocity;
use crate::open::Open;
use crate::particles::Particles;
use meniscus_case::{Case, InitialVelocity, Sph};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{GeometrySpec, ShapeSpec, SolidSide};

/// Shapes of the initial wetting phase as a geometry: the distance is negative inside them.
pub fn region(case: &Case, shapes: &[ShapeSpec]) -> Geometry {
    Geometry::unchecked(&GeometrySpec { shapes: shapes.to_vec(), solid: SolidSide::Inside, ..case.geometry.clone() })
}

/// Sets velocities and pressures. Beyond open sides both are those of the side; `inside` maps positions beyond a side to the side. Fluid at
/// rest with a given flow through periodic sides starts with the parabolic profile, where one is given.
pub(super) fn set(
    particles: &mut Particles,
    sph: &Sph,
    Open { sides, through, .. }: &Open,
    inside: impl Fn(Vec2) -> Vec2,
    bounds: Bounds,
) {
    for a in 0..particles.moving() {
        let x = particles.position[a];
        let given = sides.iter().filter(|side| side.overshoot(x) > 0.0).find_map(|side| side.given_velocity(x));
        let initial = || match sph.initial.velocity {
            InitialVelocity::Rest => through.iter().filter_map(|side| side.parabola(x)).sum(),
            moving => velocity(&moving, inside(x), bounds),
        };
        particles.velocity[a] = given.unwrap_or_else(initial);
    }
    for a in particles.moving()..particles.len() {
        particles.velocity[a] = wall_velocity(sph.wall_speeds, inside(particles.position[a]), bounds);
    }
    // The pressure gradients at the sides start from zero: each particle has the pressure of the nearest side.
    for a in 0..particles.len() {
        let x = particles.position[a];
        let given = sides.iter().filter_map(|side| Some((side.overshoot(x), side.given_pressure()?)));
        particles.pressure[a] = given.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, pressure)| pressure);
    }
}

fn velocity(initial: &InitialVelocity, x: Vec2, bounds: Bounds) -> Vec2 {
    match *initial {
        InitialVelocity::Rest => Vec2::zeros(),
        InitialVelocity::Uniform(v) => v,
        InitialVelocity::TaylorGreen(speed) => {
            let phase = (x - bounds.min).component_div(&bounds.size()) * TAU;
            speed * Vec2::new(-phase.x.cos() * phase.y.sin(), phase.x.sin() * phase.y.cos())
        }
    }
}
