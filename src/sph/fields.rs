//! What follows from the positions: volumes, densities, normals, curvature and the forces of interface and lines.
//!
//! Everything here is a function of setting and state alone, so that a resumed run finds the same bits.

use crate::case::{LineDelta, SurfaceForce};
use crate::math::Vec2;
use crate::sph::boundary::shepard;
use crate::sph::domain::Domain;
use crate::sph::images::Images;
use crate::sph::method::Method;
use crate::sph::neighborhood::Neighborhood;
use crate::sph::parallel::{GRAIN, each};
use crate::sph::particles::{Particles, Phase};
use crate::sph::setting::Setting;
use crate::sph::state::FlowState;
use crate::sph::surface_force::fit::{Fitted, InterfaceFit};
use crate::sph::surface_force::jump::{InterfaceCurvature, Jump};
use crate::sph::surface_force::points::{PointFields, Resolution, interface_points};
use crate::sph::surface_force::stencils::Interface;
use crate::sph::terms::{color, curvature, density, pressure_gradient, surface_tension};
use crate::sph::wetting::contact_line::{LineFields, LineParticles};
use crate::sph::wetting::lines::{DetectedLine, Following, LINE_REACH, Line, nearest};

use rayon::prelude::*;

/// Wall particles whose nearest walls face each other by a cosine below this belong to opposite sides of a solid.
const OPPOSITE: f64 = -0.5;

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
    /// Whether both fluids are within the support; also true of walls, which have no color of their own.
    pub mixed: Vec<bool>,
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
    /// Moment of the sums of each fluid particle's pressure gradient, with the pressure jump.
    pub moment: Vec<f64>,
    /// Slip length in m of the wall next to each fluid particle.
    pub slip_length: Vec<f64>,
    /// Number of contact lines that a line force acts on.
    pub contact_lines: usize,
    /// Whether a contact line is where its wall bends.
    pub has_pinned_line: bool,
    /// The contact lines now: the state of the next step.
    pub lines: Vec<Line>,
    /// Receding and advancing angle in rad of the wall next to each fluid particle, NaN where none is in reach.
    pub wall_hysteresis: Vec<[f64; 2]>,
    /// Normal of the wall nearest to each wall particle, into the fluid. Walls rest: found once, as their curvature.
    pub wall_facing: Vec<Vec2>,
    /// Curvature in 1/m of the wall nearest to each wall particle, positive where the solid is convex; 0 at edges.
    pub wall_curvature: Vec<f64>,
}

impl Fields {
    /// All fields but those of the wall particles.
    pub(crate) fn update(&mut self, setting: &Setting, state: &FlowState, neighborhood: &Neighborhood) {
        self.update_bulk(setting, &state.particles, neighborhood);
        self.update_interface(setting, state, neighborhood);
    }

    /// Finds where each wall particle faces and how its wall bends.
    pub(crate) fn face_walls(&mut self, setting: &Setting, particles: &Particles) {
        let walls = &particles.position[particles.moving()..];
        self.wall_facing = walls.iter().map(|&x| (setting.wall)(x).1).collect();
        self.wall_curvature = walls.iter().map(|&x| setting.curvature_of_wall(x)).collect();
    }

    /// Where each wall particle and its images face; zero on the `moving` particles before them.
    pub(crate) fn facing(&self, moving: usize, images: &Images) -> Vec<Vec2> {
        let mut facing = vec![Vec2::zeros(); moving];
        facing.extend_from_slice(&self.wall_facing);
        images.extend_reflected(&mut facing);
        facing
    }

    /// Volumes and densities [Huber2013, Eq. 17], viscosities and wall distances.
    fn update_bulk(&mut self, setting: &Setting, particles: &Particles, neighborhood: &Neighborhood) {
        let (Neighborhood { pairs, images }, Setting { method, wall, .. }) = (neighborhood, setting);
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
        shepard::into_walls(pairs, &self.fluid_volume, moving, &mut self.density);
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
    fn update_interface(&mut self, setting: &Setting, state: &FlowState, neighborhood: &Neighborhood) {
        let (Neighborhood { pairs, images }, method, particles) = (neighborhood, &setting.method, &state.particles);
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
        self.has_pinned_line = false;
        self.lines.clear();
        self.slip_length.clear();
        self.slip_length.resize(fluids, method.no_slip.slip_length);
        if method.tension == 0.0 {
            return;
        }
        let (moving, phase) = (particles.moving(), &particles.phase);
        self.mixed.resize(n, false);
        each(&mut self.mixed, |a| {
            let is_other = |b: usize| b < moving && phase[b] != phase[a];
            a >= moving || pairs.of(a).any(|ab| is_other(images.source(ab.b)))
        });
        color::smoothed_color(pairs, &self.fluid_volume, &sharp, &self.mixed, &mut self.color);
        images.extend(&mut self.color);
        match method.surface_force {
            SurfaceForce::Csf { line_delta } => self.continuum_forces(setting, state, neighborhood, line_delta),
            SurfaceForce::PressureJump { curvature } => {
                self.pressure_jump(setting, state, neighborhood, &sharp, curvature);
            }
        }
        self.slip_near_lines(particles, method, &setting.domain);
    }

    /// Gives walls near contact lines the slip length of lines.
    fn slip_near_lines(&mut self, particles: &Particles, method: &Method, domain: &Domain) {
        let (lines, wall_distance) = (&self.lines, &self.wall_distance);
        each(&mut self.slip_length, |a| {
            let distance = |line: &Line| domain.separation(particles.position[a], line.position).norm();
            let has_wall = wall_distance[a].is_finite();
            let nearest = lines.iter().filter(|_| has_wall).map(distance).fold(f64::INFINITY, f64::min);
            method.no_slip.slip_length_at(nearest)
        });
    }

    /// The paper's forces: normals and curvature in a band, surface force and line force [Huber2013, Eqs. 18-23].
    fn continuum_forces(
        &mut self,
        setting: &Setting,
        state: &FlowState,
        neighborhood: &Neighborhood,
        delta: LineDelta,
    ) {
        let (Neighborhood { pairs, images }, Setting { method, domain, .. }) = (neighborhood, setting);
        let particles = &state.particles;
        let (fluids, moving) = (particles.fluids, particles.moving());
        color::color_gradient(pairs, &self.fluid_volume, &self.color, &mut self.normal[..moving]);
        images.extend_reflected(&mut self.normal);
        curvature::unit_normal(&self.normal[..moving], method.kernel.h, &mut self.unit_normal[..moving]);
        images.extend_reflected(&mut self.unit_normal);
        curvature::curvature(pairs, &self.fluid_volume, &self.unit_normal, &mut self.curvature[..moving]);
        let weight: Vec<f64> = self.density[..fluids].iter().map(|&rho| method.force_weight(rho)).collect();
        surface_tension::surface_force(method.tension, &self.curvature, &self.normal, &weight, &mut self.surface_force);
        if method.wetting.is_none() {
            return;
        }
        let fields = LineFields {
            position: &particles.position,
            velocity: &particles.velocity,
            normal: &self.normal,
            unit_normal: &self.unit_normal,
            wall_distance: &self.wall_distance,
            wall_normal: &self.wall_normal,
            volume: &self.volume,
            weight: &weight,
        };
        let found = LineParticles::find(neighborhood, &fields, &method.kernel, fluids);
        let seen = found.detected_lines(&fields, domain);
        self.contact_lines = found.count();
        self.lines = follow(setting, state, &seen);
        let angles: Vec<f64> = self.lines.iter().map(|line| line.angle).collect();
        found.line_force(&fields, delta, &angles, method.tension, &mut self.line_force);
    }

    /// Sides and curvatures for the pressure jump, fitted where none is `given` (1/m); the normal is the consistent gradient of the smoothed color.
    /// `sharp` is the color of each particle and image, 0 or 1.
    fn pressure_jump(
        &mut self,
        setting: &Setting,
        state: &FlowState,
        neighborhood: &Neighborhood,
        sharp: &[f64],
        given: Option<f64>,
    ) {
        let (Neighborhood { pairs, images }, Setting { method, domain, .. }) = (neighborhood, setting);
        let particles = &state.particles;
        let (fluids, moving) = (particles.fluids, particles.moving());
        let position = &particles.position;
        let r_ab = |a: usize, b: usize| neighborhood.separation(a, b, position, domain);
        let (normal, mixed) = (&mut self.normal[..moving], &self.mixed);
        let mut near = vec![false; moving];
        each(&mut near, |a| {
            let is_mixed = |b: usize| b < moving && mixed[b];
            mixed[a] || pairs.of(a).any(|ab| is_mixed(images.source(ab.b)))
        });
        color::consistent_gradient(pairs, &self.fluid_volume, &near, &self.color, r_ab, normal);
        self.moment.resize(fluids, 0.0);
        pressure_gradient::moment(pairs, &self.volume, r_ab, &mut self.moment);
        images.extend_reflected(&mut self.normal);
        let mut velocity = particles.velocity.clone();
        images.extend_velocity(&mut velocity);
        let fields = PointFields {
            position,
            color: &self.color,
            gradient: &self.normal,
            velocity: &velocity,
            wall_distance: &self.wall_distance,
            wall_normal: &self.wall_normal,
            near: &near,
        };
        let resolution = Resolution { spacing: method.spacing, h: method.kernel.h };
        let points = interface_points(neighborhood, domain, &fields, moving, resolution);
        let interface = Interface::new(&points, domain, resolution, &setting.wall)
            .under(method.curvature_gradient())
            .before(state.last_dt);
        let mut pinned = Vec::new();
        if method.wetting.is_some() {
            let seen = interface.lines();
            self.contact_lines = seen.len();
            self.lines = follow(setting, state, &seen);
            pinned.extend(seen.iter().zip(&self.lines).filter_map(|(line, now)| line.pinned(now.angle)));
        }
        self.has_pinned_line = !pinned.is_empty();
        let lines = &self.lines;
        let angle_at = |x: Vec2, outward: Vec2| {
            // Without a model this is not asked for.
            let Some(model) = setting.spots.model(method, x) else { return std::f64::consts::FRAC_PI_2 };
            let line =
                if model.is_static() { None } else { nearest(lines, domain, x, outward, LINE_REACH * resolution.h) };
            line.map_or_else(|| model.static_angle(), |line| line.angle)
        };
        let mut fit = InterfaceFit::free(&interface);
        if method.wetting.is_some() {
            fit = fit.held_to(&angle_at).with_pinned_lines(&pinned);
        }
        let mut side = sharp.to_vec();
        shepard::into_walls(pairs, &self.fluid_volume, moving, &mut side);
        let gradient = if given.is_some() { Vec2::zeros() } else { method.curvature_gradient() };
        let given = given.map(|curvature| Fitted { curvature, turning: None });
        let curvature = InterfaceCurvature { at: |x: Vec2| given.or_else(|| fit.at(x)), gradient, h: resolution.h };
        let jump = Jump::new(particles, neighborhood, domain, &side, &curvature);
        for (kappa, found) in self.curvature.iter_mut().zip(&jump.curvature) {
            *kappa = if found.is_nan() { 0.0 } else { *found };
        }
        self.jump = Some(jump);
        let range = |a: usize| {
            let model = if self.wall_distance[a].is_finite() { setting.spots.model(method, position[a]) } else { None };
            model.map_or([f64::NAN; 2], |model| model.hysteresis_range())
        };
        self.wall_hysteresis = (0..fluids).map(range).collect();
    }
}

/// Whether the pressures of two particles that are `facing` so are coupled: all but those of wall particles that belong to opposite sides of a thin
/// solid, through which the pressure of one side would reach the other.
pub(crate) fn joined(facing: Vec2, other: Vec2) -> bool {
    facing.dot(&other) > OPPOSITE
}

/// The contact lines now, from those of the step before and from what is `seen` of them.
fn follow(setting: &Setting, state: &FlowState, seen: &[impl DetectedLine]) -> Vec<Line> {
    let Setting { method, domain, spots, .. } = setting;
    let Some(base) = method.wetting else { return Vec::new() };
    let h = method.kernel.h;
    // Nothing happens at a line faster than an interface of the size h moves.
    let mean_over = h / method.capillary_speed() + method.largest_viscosity() * h / method.tension;
    let following = Following {
        domain,
        model: &|x| spots.model(method, x).unwrap_or(base),
        wall_velocity: &|x| spots.velocity(x),
        tension: method.tension,
        viscosity: method.wetting_fluid.viscosity,
        other_viscosity: method.other_fluid.viscosity,
        slip_length: method.no_slip.line_slip_length,
        h,
        mean_over,
    };
    following.follow(&state.lines, seen, state.last_dt)
}
