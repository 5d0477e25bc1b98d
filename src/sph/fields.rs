//! What follows from the positions: volumes, densities, normals, curvature and the forces of interface and lines.
//!
//! Everything here is a function of the particles alone, so that a resumed run finds the same bits.

use crate::math::Vec2;
use crate::sph::boundary::carry;
use crate::sph::domain::Domain;
use crate::sph::images::Images;
use crate::sph::method::Method;
use crate::sph::pairs::{GRAIN, Pairs};
use crate::sph::particles::{Particles, Phase};
use crate::sph::projection::WallQuery;
use crate::sph::surface_force::SurfaceForce;
use crate::sph::surface_force::fit::InterfaceFit;
use crate::sph::surface_force::jump::Jump;
use crate::sph::surface_force::points::{PointFields, interface_points};
use crate::sph::terms::{color, curvature, density, surface_tension};
use crate::sph::wetting::Wetting;
use crate::sph::wetting::contact_line::{LineFields, line_force};

use rayon::prelude::*;

/// Fields over particles and images; forces over fluid particles only.
#[derive(Debug, Clone, Default)]
pub struct Fields {
    /// Volume V_a in m²; on walls the lattice's V_0.
    pub volume: Vec<f64>,
    /// V_a on fluid, 0 on walls.
    pub fluid_volume: Vec<f64>,
    /// ρ_a in kg/m³; on walls that of the fluid nearby.
    pub density: Vec<f64>,
    /// Dynamic viscosity in Pa s, 0 on walls.
    pub viscosity: Vec<f64>,
    /// Smoothed color; carried into the walls.
    pub color: Vec<f64>,
    /// n_a in 1/m.
    pub normal: Vec<Vec2>,
    /// n̂_a, zero where not valid.
    pub unit_normal: Vec<Vec2>,
    /// κ_a in 1/m.
    pub curvature: Vec<f64>,
    /// Continuum surface force in N/m³.
    pub surface_force: Vec<Vec2>,
    /// Contact line force in N/m³.
    pub line_force: Vec<Vec2>,
    /// Distance to the wall in m: of fluid and buffer particles with a wall in reach, else infinite.
    pub wall_distance: Vec<f64>,
    /// Wall normal into the fluid, zero far away.
    pub wall_normal: Vec<Vec2>,
    /// Sides and curvatures for the pressure jump, in that form of the surface force.
    pub jump: Option<Jump>,
    /// Number of contact lines that a line force acts on.
    pub contact_lines: usize,
}

impl Fields {
    /// Volumes and densities [Huber2013, Eq. 17], viscosities and wall distances.
    pub fn update_bulk(
        &mut self,
        (particles, pairs, images): (&Particles, &Pairs, &Images),
        method: &Method,
        wall: impl Fn(Vec2) -> (f64, Vec2) + Sync,
    ) {
        let (n, fluids, moving) = (particles.len(), particles.fluids, particles.moving());
        // Buffer particles see no neighbors beyond the far end: they have the volume of the lattice.
        self.volume.resize(n, 0.0);
        density::volume(pairs, &mut self.volume[..fluids]);
        self.volume[fluids..n].fill(method.volume);
        images.extend(&mut self.volume);
        self.fluid_volume.clear();
        self.fluid_volume.extend((0..n).map(|a| if a < moving { self.volume[a] } else { 0.0 }));
        images.extend(&mut self.fluid_volume);

        let mass = |a: usize| method.fluid(particles.phase[a]).density * method.volume;
        self.density.clear();
        self.density.extend((0..n).map(|a| if a < moving { mass(a) / self.volume[a] } else { method.mean_density() }));
        images.extend(&mut self.density);
        carry::into_walls(pairs, &self.fluid_volume, moving, &mut self.density);
        images.extend(&mut self.density);
        self.viscosity.clear();
        self.viscosity
            .extend((0..n).map(|a| if a < moving { method.fluid(particles.phase[a]).viscosity } else { 0.0 }));
        images.extend(&mut self.viscosity);

        let nearest: Vec<(f64, Vec2)> = (0..moving)
            .into_par_iter()
            .with_min_len(GRAIN)
            .map(|a| {
                let has_wall = pairs.of(a).any(|ab| images.source(ab.b) >= moving);
                if has_wall { wall(particles.position[a]) } else { (f64::INFINITY, Vec2::zeros()) }
            })
            .collect();
        (self.wall_distance, self.wall_normal) = nearest.into_iter().unzip();
    }

    /// Normals, curvature and the forces of interface and contact lines [Huber2013, Eqs. 18-23].
    pub fn update_interface(
        &mut self,
        neighborhood: (&Particles, &Pairs, &Images),
        method: &Method,
        domain: &Domain,
        wall: &WallQuery,
    ) {
        let (particles, pairs, images) = neighborhood;
        let (n, fluids) = (particles.len(), particles.fluids);
        for field in [&mut self.surface_force, &mut self.line_force] {
            field.clear();
            field.resize(fluids, Vec2::zeros());
        }
        for field in [&mut self.normal, &mut self.unit_normal] {
            field.clear();
            field.resize(n, Vec2::zeros());
        }
        self.curvature.clear();
        self.curvature.resize(n, 0.0);
        let mut sharp: Vec<f64> = particles.phase.iter().map(|p: &Phase| p.color()).collect();
        images.extend(&mut sharp);
        self.color.clear();
        self.color.extend_from_slice(&sharp[..n]);
        self.jump = None;
        self.contact_lines = 0;
        if method.tension == 0.0 {
            return;
        }
        color::smoothed_color(pairs, &self.fluid_volume, &sharp, &mut self.color);
        images.extend(&mut self.color);
        match method.surface_force {
            SurfaceForce::Csf => self.continuum_forces(neighborhood, method),
            SurfaceForce::PressureJump => self.pressure_jump(neighborhood, &sharp, method, (domain, wall)),
        }
    }

    /// The paper's forces: normals and curvature in a band, surface force and line force [Huber2013, Eqs. 18-23].
    fn continuum_forces(&mut self, (particles, pairs, images): (&Particles, &Pairs, &Images), method: &Method) {
        let (fluids, moving) = (particles.fluids, particles.moving());
        color::color_gradient(pairs, &self.fluid_volume, &self.color, &mut self.normal[..moving]);
        images.extend_reflected(&mut self.normal);
        curvature::unit_normal(&self.normal[..moving], method.kernel.h, &mut self.unit_normal[..moving]);
        images.extend_reflected(&mut self.unit_normal);
        curvature::curvature(pairs, &self.fluid_volume, &self.unit_normal, &mut self.curvature[..moving]);
        let weight: Vec<f64> = self.density[..fluids].iter().map(|&rho| method.force_weight(rho)).collect();
        surface_tension::surface_force(method.tension, &self.curvature, &self.normal, &weight, &mut self.surface_force);
        if let Some(wetting) = &method.wetting {
            let fields = LineFields {
                normal: &self.normal,
                unit_normal: &self.unit_normal,
                wall_distance: &self.wall_distance,
                wall_normal: &self.wall_normal,
                volume: &self.volume,
                weight: &weight,
            };
            let law = (wetting, method.tension);
            self.contact_lines = line_force(pairs, images, &fields, &method.kernel, law, &mut self.line_force);
        }
    }
    /// Sides and curvatures for the pressure jump; the normal is the consistent gradient of the smoothed color.
    fn pressure_jump(
        &mut self,
        (particles, pairs, images): (&Particles, &Pairs, &Images),
        sharp: &[f64],
        method: &Method,
        (domain, wall): (&Domain, &WallQuery),
    ) {
        let (moving, position) = (particles.moving(), &particles.position);
        let r_ab = |a: usize, b: usize| domain.separation(position[a], images.position(b, position));
        let normal = &mut self.normal[..moving];
        color::consistent_gradient(pairs, &self.fluid_volume, &self.color, r_ab, normal);
        images.extend_reflected(&mut self.normal);
        let fields = PointFields {
            position,
            color: &self.color,
            gradient: &self.normal,
            wall_distance: &self.wall_distance,
            wall_normal: &self.wall_normal,
        };
        let lengths = (method.spacing, method.kernel.h);
        let points = interface_points((pairs, images), domain, &fields, moving, lengths);
        let angle = method.wetting.as_ref().map(Wetting::static_angle);
        let fit = InterfaceFit::new(&points, domain, lengths, angle, wall);
        let mut side = sharp.to_vec();
        carry::into_walls(pairs, &self.fluid_volume, moving, &mut side);
        let mut jump = Jump::default();
        jump.update((pairs, images, moving), &side, position, &fit);
        for (kappa, found) in self.curvature.iter_mut().zip(&jump.curvature) {
            *kappa = if found.is_nan() { 0.0 } else { *found };
        }
        self.jump = Some(jump);
    }
}
