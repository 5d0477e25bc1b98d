//! The force of the other fluid on the wetting phase: its pressure along the interface, and its friction.
//!
//! F = −∮ (p_n − ρ_n g·x) n dl + F_visc, n out of the wetting phase: without the part of the pressure that is the weight of the fluid
//! displaced. The pressure p_n on the interface is that of the other fluid alone, continued to the contour c = 0.5 by planes
//! fitted to its particles, so that the tension has no part in it. The friction is the sum over pairs that the flow itself uses.
//! Leaves out pressures of the continuum surface force, which are smeared across the interface. The contour lies κ h²/7 inside of the interface.

use nalgebra::{Matrix3, Vector3};

use crate::interface::polyline::Polyline;
use crate::math::Vec2;
use crate::sph::cells::Cells;
use crate::sph::flow::Flow;
use crate::sph::observe::Observation;
use crate::sph::open::OpenSide;
use crate::sph::particles::Phase;

/// The constant in the pressure does nothing only where the interface ends as far out across the force as it begins: by so much of its
/// length it may not.
const OPEN: f64 = 0.02;

/// Walls whose mean velocity differs from that of one by this share of it move alike.
const ALIKE: f64 = 1e-9;

/// The force of the other fluid on the wetting phase along a direction, in N per m of depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StreamForce {
    /// By its pressure, less its buoyancy.
    pub pressure: f64,
    /// By its friction.
    pub friction: f64,
}

/// The stream that the case gives, relative to a wall that moves with the velocity `wall` (m/s), in its direction: of what passes inlets and periodic
/// sides; else from high to low given pressures; else of the other walls, and where all move alike, of the fluid that they leave behind.
pub(crate) fn given(flow: &Flow, wall: Vec2) -> Vec2 {
    let (open, p) = (&flow.config.open, &flow.state.particles);
    let sum = |of: &dyn Fn(&OpenSide) -> Vec2| open.sides.iter().chain(&open.through).map(of).sum::<Vec2>();
    let size = flow.config.domain.bounds.size();
    let area = p.fluids as f64 * flow.config.method.volume;
    let passing = sum(&|side: &OpenSide| side.flow_rate() * size[side.axis()] / area * side.way());
    if passing != Vec2::zeros() {
        return passing - wall;
    }
    let fall = sum(&|side: &OpenSide| side.given_pressure().unwrap_or(0.0) * side.way());
    if fall != Vec2::zeros() {
        return fall;
    }
    let of_walls = &p.velocity[p.moving()..];
    let others = of_walls.iter().sum::<Vec2>() / of_walls.len().max(1) as f64 - wall;
    if others.norm() > ALIKE * wall.norm() { others } else { -wall }
}

/// The force of the other fluid on the wetting phase along the unit vector `ahead`.
///
/// That by the pressure is NaN where the interface ends farther out across `ahead` than it begins (a meniscus
/// between plates), where no particle of the other fluid is in reach of it, and with the continuum surface force.
pub fn along(flow: &Flow, seen: &Observation, ahead: Vec2) -> StreamForce {
    let is_wetting = |a: usize| a < flow.state.particles.fluids && flow.state.particles.phase[a] == Phase::Wetting;
    let view = flow.view();
    let friction = view.viscous_force(is_wetting) + view.friction(|a, _| is_wetting(a));
    let pressure =
        if flow.fields.interface.force.jump().is_some() { by_pressure(flow, &seen.interface, ahead) } else { None };
    StreamForce { pressure: pressure.unwrap_or(f64::NAN), friction: friction.dot(&ahead) }
}

fn by_pressure(flow: &Flow, interface: &[Polyline], ahead: Vec2) -> Option<f64> {
    let p = &flow.state.particles;
    let other: Vec<usize> = (0..p.fluids).filter(|&a| p.phase[a] == Phase::NonWetting).collect();
    let points: Vec<Vec2> = other.iter().map(|&a| p.position[a]).collect();
    let cells = Cells::build(&points, &flow.config.domain, flow.config.method.kernel.support());
    // Without the weight of the fluid displaced, and with the mean gradient that drives a given flow.
    let even = flow.config.method.other_fluid.density * flow.config.method.gravity + flow.view().driving_gradient();
    let (mut force, mut gained, mut length) = (0.0, 0.0, 0.0);
    for line in interface {
        let from = line.points.first()?;
        for (a, b) in line.segments() {
            // The wetting phase is on the left.
            let outwards = Vec2::new(b.y - a.y, a.x - b.x);
            let middle = 0.5 * (a + b);
            let pressure = pressure_at(flow, &cells, &other, middle)? - even.dot(&(middle - from));
            force -= pressure * outwards.dot(&ahead);
            gained += outwards.dot(&ahead);
            length += outwards.norm();
        }
    }
    (gained.abs() <= OPEN * length && length > 0.0).then_some(force)
}

/// The pressure in Pa of the particles `other`, sorted into `cells`, at `x` (m): a plane through them, or their mean where they do not hold one.
fn pressure_at(flow: &Flow, cells: &Cells, other: &[usize], x: Vec2) -> Option<f64> {
    let (kernel, pressure) = (&flow.config.method.kernel, &flow.state.particles.pressure);
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    cells.visit_near(flow.config.domain.wrapped(x), |i, from_particle| {
        let a = other[i as usize];
        let r = -from_particle / kernel.h;
        let row = Vector3::new(1.0, r.x, r.y);
        let w = kernel.w(from_particle.norm());
        matrix += w * row * row.transpose();
        right += w * pressure[a] * row;
    });
    let total = matrix[(0, 0)];
    (total > 0.0).then(|| matrix.cholesky().map_or(right[0] / total, |plane| plane.solve(&right)[0]))
}
