//! The force of the other fluid on the wetting phase: pressure along the interface, and viscous friction.
//!
//! F = −∮ (p_n − ρ_n g·x) n dl + F_visc, n out of the wetting phase: without the hydrostatic part of the pressure (buoyancy).
//! The pressure p_n on the interface is that of the other fluid alone, extrapolated to the contour c = 0.5 by planes
//! fitted to its particles, so that the capillary pressure does not contribute. The friction is the same sum over pairs as in the flow.
//! Not available with the continuum surface force, which smears the pressure across the interface. The contour lies κ h²/7 inside the interface.

use nalgebra::{Matrix3, Vector3};

use crate::cells::Cells;
use crate::flow::Flow;
use crate::observe::Observation;
use crate::open::OpenSide;
use crate::particles::Phase;
use meniscus_core::math::Vec2;
use meniscus_geometry::interface::polyline::Polyline;

/// The constant in the pressure drops out only if ∫ n dl along the force vanishes over the interface: up to this fraction of its length it may
/// not.
const OPEN: f64 = 0.02;

/// Walls move as one if their mean velocity differs from that of a single wall by less than this fraction of it.
const ALIKE: f64 = 1e-9;

/// The force of the other fluid on the wetting phase along a direction, in N per m of depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StreamForce {
    /// From pressure, without buoyancy.
    pub pressure: f64,
    /// From viscous friction.
    pub friction: f64,
}

/// A vector along the stream that the case prescribes, relative to a wall with velocity `wall` (m/s): by the flow through inlets and periodic
/// sides; else from high to low given pressure; else by the motion of the other walls, and if all move as one, by that of the fluid relative to them.
pub fn given(flow: &Flow, wall: Vec2) -> Vec2 {
    let (open, p) = (&flow.config.open, &flow.state.particles);
    let sum = |of: &dyn Fn(&OpenSide) -> Vec2| open.sides.iter().chain(&open.through).map(of).sum::<Vec2>();
    let size = flow.config.domain.bounds.size();
    let area = p.fluids as f64 * flow.config.method.volume;
    let passing = sum(&|side: &OpenSide| side.flow_rate() * size[side.axis()] / area * side.inward());
    if passing != Vec2::zeros() {
        return passing - wall;
    }
    let fall = sum(&|side: &OpenSide| side.given_pressure().unwrap_or(0.0) * side.inward());
    if fall != Vec2::zeros() {
        return fall;
    }
    let of_walls = &p.velocity[p.moving()..];
    let others = of_walls.iter().sum::<Vec2>() / of_walls.len().max(1) as f64 - wall;
    if others.norm() > ALIKE * wall.norm() { others } else { -wall }
}

/// The force of the other fluid on the wetting phase along the unit vector `ahead`.
///
/// The pressure part is NaN if ∫ n·`ahead` dl does not vanish over the interface (a meniscus between plates), if a part of
/// the interface has no particle of the other fluid in reach, and with the continuum surface force.
pub fn along(flow: &Flow, observed: &Observation, ahead: Vec2) -> StreamForce {
    let is_wetting = |a: usize| a < flow.state.particles.fluids && flow.state.particles.phase[a] == Phase::Wetting;
    let view = flow.view();
    let friction = view.viscous_force(is_wetting) + view.friction(|a, _| is_wetting(a));
    let pressure =
        if flow.fields.interface.force.jump().is_some() { by_pressure(flow, &observed.interface, ahead) } else { None };
    StreamForce { pressure: pressure.unwrap_or(f64::NAN), friction: friction.dot(&ahead) }
}

fn by_pressure(flow: &Flow, interface: &[Polyline], ahead: Vec2) -> Option<f64> {
    let p = &flow.state.particles;
    let other: Vec<usize> = (0..p.fluids).filter(|&a| p.phase[a] == Phase::NonWetting).collect();
    let points: Vec<Vec2> = other.iter().map(|&a| p.position[a]).collect();
    let cells = Cells::build(&points, &flow.config.domain, flow.config.method.kernel.support());
    // Without the hydrostatic part, and with the mean gradient that drives a given flow.
    let uniform_gradient =
        flow.config.method.other_fluid.density * flow.config.method.gravity + flow.view().driving_gradient();
    let (mut force, mut projected, mut length) = (0.0, 0.0, 0.0);
    for line in interface {
        let from = line.points.first()?;
        for (a, b) in line.segments() {
            // The wetting phase is on the left.
            let outwards = Vec2::new(b.y - a.y, a.x - b.x);
            let middle = 0.5 * (a + b);
            let pressure = pressure_at(flow, &cells, &other, middle)? - uniform_gradient.dot(&(middle - from));
            force -= pressure * outwards.dot(&ahead);
            projected += outwards.dot(&ahead);
            length += outwards.norm();
        }
    }
    (projected.abs() <= OPEN * length && length > 0.0).then_some(force)
}

/// The pressure in Pa of the particles `other`, sorted into `cells`, at `x` (m): a fitted plane, or their mean where they do not determine one.
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
