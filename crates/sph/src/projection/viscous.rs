//! Viscous forces between particles and on walls.

use crate::boundary::no_slip::WallDepth;
use crate::fields::Fields;
use crate::images::Field;
use crate::terms::transposed_stress::TransposedStress;
use crate::terms::viscosity::Viscous;
use crate::view::View;
use meniscus_case::ViscousTerm;
use meniscus_core::math::{Mat2, Vec2};

impl View<'_, Fields> {
    /// The particle fields of the viscous sums.
    pub(super) fn viscous(&self) -> Viscous<'_> {
        let f = &self.fields.bulk;
        Viscous { volume: &f.volume, density: &f.density, viscosity: &f.viscosity }
    }

    /// The acceleration of the fluid particles in m/s² by friction, without the transposed part of the stress; `v_ab(a, b)` in m/s.
    fn friction_by(&self, v_ab: impl Fn(usize, usize) -> Vec2 + Sync) -> Vec<Vec2> {
        let (pairs, fluids) = (&self.neighborhood.pairs, self.state.particles.fluids);
        match self.config.method.numerics.viscous_term {
            ViscousTerm::Morris | ViscousTerm::Stress => self.viscous().morris(pairs, v_ab, fluids),
            ViscousTerm::Szewc => self.viscous().szewc(pairs, v_ab, fluids),
        }
    }

    /// The viscous acceleration of the fluid particles in m/s², with the transposed `stress` where there is one.
    pub(super) fn viscous_acceleration(&self, velocity: &Field<Vec2>, stress: Option<&TransposedStress>) -> Vec<Vec2> {
        let f = &self.fields.bulk;
        let mut acceleration = self.friction_by(|a, b| self.velocity_difference(velocity, a, b));
        if let Some(stress) = stress {
            let forces = stress.force(velocity, acceleration.len());
            let both = acceleration.iter_mut().zip(forces).enumerate();
            both.for_each(|(a, (by, force))| *by += force / (f.density[a] * f.volume[a]));
        }
        if self.config.method.plates.is_some() {
            acceleration.iter_mut().enumerate().for_each(|(a, by)| *by -= self.plate_rate(a) * velocity[a]);
        }
        acceleration
    }

    /// 12 μ/(ρ b²) in 1/s: the rate at which floor and lid decelerate a particle, 0 without them \[GondretRabaud1997\].
    ///
    /// μ is the arithmetic mean by the smoothed color, the resistance of layers in series. With the viscosity of each phase, particles of the less
    /// viscous one would overtake those of the other, since the kernel does not resolve the change of the pressure gradient between them.
    pub(super) fn plate_rate(&self, a: usize) -> f64 {
        let (method, color) = (&self.config.method, self.fields.interface.color[a]);
        let viscosity = color * method.wetting_fluid.viscosity + (1.0 - color) * method.other_fluid.viscosity;
        method.plates.map_or(0.0, |plates| plates.friction * viscosity / self.fields.bulk.density[a])
    }

    /// The transposed part of the stress, `None` if the method lacks it or the fluids have the same viscosity.
    pub(super) fn transposed_stress(&self) -> Option<TransposedStress<'_>> {
        let (method, f) = (&self.config.method, &self.fields.bulk);
        let viscosities = [method.wetting_fluid, method.other_fluid].map(|fluid| method.profile() * fluid.viscosity);
        if method.numerics.viscous_term != ViscousTerm::Stress {
            return None;
        }
        let moving = self.state.particles.moving();
        TransposedStress::new(&self.neighborhood.pairs, &f.volume, &f.viscosity, moving, viscosities)
    }

    /// The largest viscous rate in 1/s, see [`Viscous::rate`].
    pub fn viscous_rate(&self) -> f64 {
        let rate =
            self.viscous().rate(&self.neighborhood.pairs, |a, b| self.stretch(a, b), self.state.particles.fluids);
        rate.iter().enumerate().fold(0.0, |m: f64, (a, r)| m.max(r + 0.5 * self.plate_rate(a)))
    }

    /// The viscous force in N per m of depth that fluid exerts on walls, from the fluid particles (by index) on the wall particles
    /// (by position in m) that `is_meant` selects.
    pub fn friction(&self, is_meant: impl Fn(usize, Vec2) -> bool + Sync) -> Vec2 {
        let (particles, f) = (&self.state.particles, &self.fields.bulk);
        let (moving, velocity) = (particles.moving(), self.velocity());
        let v_ab = |a: usize, b: usize| {
            let source = self.neighborhood.images.source(b);
            let counts = source >= moving && is_meant(a, particles.position[source]);
            if counts { self.velocity_difference(&velocity, a, b) } else { Vec2::zeros() }
        };
        // The transposed part of the stress has no force on walls.
        let acceleration = self.friction_by(v_ab);
        -acceleration.iter().enumerate().map(|(a, by)| f.density[a] * f.volume[a] * by).sum::<Vec2>()
    }

    /// The viscous force in N per m of depth on the fluid particles that `is_meant` selects, by fluid and walls around them.
    pub(crate) fn viscous_force(&self, is_meant: impl Fn(usize) -> bool) -> Vec2 {
        let (f, acceleration) =
            (&self.fields.bulk, self.viscous_acceleration(&self.velocity(), self.transposed_stress().as_ref()));
        let meant = acceleration.iter().enumerate().filter(|(a, _)| is_meant(*a));
        meant.map(|(a, by)| f.density[a] * f.volume[a] * by).sum()
    }

    /// v_a − v_b in m/s, stretched at walls, see [`NoSlip`](crate::boundary::no_slip::NoSlip).
    fn velocity_difference(&self, velocity: &Field<Vec2>, a: usize, b: usize) -> Vec2 {
        let v_ab = velocity[a] - velocity[b];
        let (distance, normal) = (self.fields.bulk.wall_distance[a], self.fields.bulk.wall_normal[a]);
        if distance.is_infinite() {
            return v_ab;
        }
        let slip_length = self.fields.interface.slip_length[a];
        self.wall_depth(b)
            .map_or(v_ab, |depth| self.config.method.no_slip.difference(v_ab, distance, normal, depth, slip_length))
    }

    /// The matrix that stretches v_a − v_b as in [`Self::velocity_difference`], with `of` applied to each stretch.
    pub(super) fn stretch_matrix(&self, a: usize, b: usize, of: impl Fn(f64) -> f64) -> Mat2 {
        let Some(depth) = self.wall_depth(b) else { return Mat2::identity() };
        let (f, no_slip) = (&self.fields.bulk, &self.config.method.no_slip);
        let slip_length = self.fields.interface.slip_length[a];
        let [along, across] = no_slip.stretches(f.wall_distance[a], depth, slip_length).map(of);
        let normal = f.wall_normal[a];
        Mat2::from_diagonal_element(along) + (across - along) * normal * normal.transpose()
    }

    /// The largest |v_ab| over the velocity difference: β at walls, 1 between fluid particles.
    fn stretch(&self, a: usize, b: usize) -> f64 {
        let distance = self.fields.bulk.wall_distance[a];
        self.wall_depth(b).map_or(1.0, |depth| self.config.method.no_slip.stretch(distance, depth))
    }

    /// Depth of a wall particle or its image and curvature of the wall, `None` for fluid.
    fn wall_depth(&self, b: usize) -> Option<WallDepth> {
        let wall = self.neighborhood.images.source(b).checked_sub(self.state.particles.moving())?;
        Some(WallDepth { depth: self.state.wall_depth[wall], curvature: self.fields.walls.curvature[wall] })
    }
}
