//! One time step: predictor, pressure, corrector [Huber2013, section 3.3]. The one place where the order of the terms is decided.

use std::time::Instant;

use crate::math::Vec2;
use crate::solver::{PartTime, SolverError, StepInfo};
use crate::sph::cells::Cells;
use crate::sph::domain::Domain;
use crate::sph::fields::{Fields, Place};
use crate::sph::images::Images;
use crate::sph::method::{Method, PressureGradient, ViscousTerm};
use crate::sph::open::{self, Feet, Open, Prescribed};
use crate::sph::pairs::{Pairs, each, largest};
use crate::sph::particles::Particles;
use crate::sph::poisson::{PressureSolve, Unknowns, assemble, give, parts};
use crate::sph::terms::divergence::divergence;
use crate::sph::terms::pressure_gradient;
use crate::sph::terms::viscosity::Viscous;
use crate::sph::time_step::landing;
use crate::sph::wetting::lines::Line;
use crate::sph::wetting::wall::WallSpots;

/// The particles are put in the order of their cells every so many steps, so that neighbors are near in memory.
const REORDER_EVERY: u64 = 20;

/// Above this density ratio the multigrid keeps light and heavy particles apart.
const LARGEST_SMOOTH_RATIO: f64 = 5.0;

/// Kind of the particles with a given pressure for the multigrid: apart from light (1) and heavy (0) ones.
const GIVEN: u8 = 2;

/// Solves before the first step with open sides: there is no step before to take the slopes of the pressure from. The slope of the
/// fluid answers to that of the buffer by a small share, so that few will do.
const FIRST_SOLVES: usize = 6;

/// The signed distance in m (above 0 in the pore) and the wall normal at a point.
pub type WallQuery = Box<dyn Fn(Vec2) -> (f64, Vec2) + Send + Sync>;

/// Counts of the solver's work.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Work {
    /// Steps done by this process.
    pub steps: u64,
    /// Iterations of the last pressure solve.
    pub last_iterations: usize,
    /// Iterations of all pressure solves.
    pub iterations: u64,
    /// Relative residual of the last pressure solve.
    pub residual: f64,
    /// Particles set back from a wall.
    pub set_back: u64,
    /// Wall time of neighbors, forces, pressure matrix and solve, move in s.
    pub seconds: [f64; 4],
}

/// Names of the parts that `Work::seconds` counts.
pub const PARTS: [&str; 4] = ["neighbors", "forces", "pressure", "move"];

/// The state of a simulation and all that follows from it.
pub struct Flow {
    /// Constants.
    pub method: Method,
    /// Box and sides.
    pub domain: Domain,
    /// Wall distance and normal.
    pub wall: WallQuery,
    /// Wetting models and velocities of the walls.
    pub spots: WallSpots,
    /// The contact lines as the last step left them; those of the present positions are among the fields.
    pub lines: Vec<Line>,
    /// The particles.
    pub particles: Particles,
    /// Depth of each wall particle in m.
    pub wall_depth: Vec<f64>,
    /// Open sides and what passed through them.
    pub open: Open,
    /// Time in s.
    pub time: f64,
    /// Steps since time zero.
    pub steps: u64,
    /// Last step.
    pub last: StepInfo,
    /// Fields at the present positions.
    pub fields: Fields,
    /// Pairs at the present positions.
    pub pairs: Pairs,
    /// Images at the present positions.
    pub images: Images,
    /// Pressure solver.
    pub pressure: PressureSolve,
    /// Counts.
    pub work: Work,
}

/// The intermediate state of a step [Huber2013, Eq. 25].
pub(super) struct Predicted {
    pub(super) dt: f64,
    pub(super) limit: &'static str,
    /// v_int over particles and images in m/s.
    velocity: Vec<Vec2>,
    /// Where the buffers of open sides take the velocity from.
    feet: Feet,
}

impl Flow {
    /// The flow at time zero. `wall_depth` in m as `fill` returns it.
    #[must_use]
    pub fn new(
        method: Method,
        domain: Domain,
        wall: WallQuery,
        (particles, wall_depth): (Particles, Vec<f64>),
        open: Open,
    ) -> Self {
        let mut flow = Self {
            method,
            domain,
            wall,
            spots: WallSpots::default(),
            lines: Vec::new(),
            particles,
            wall_depth,
            open,
            time: 0.0,
            steps: 0,
            last: StepInfo { dt: 0.0, limit: "none" },
            fields: Fields::default(),
            pairs: Pairs::default(),
            images: Images::default(),
            pressure: PressureSolve::default(),
            work: Work::default(),
        };
        flow.order_walls();
        flow.prepare();
        flow.particles.part = parts(&flow.pairs, &flow.images);
        flow
    }

    /// The same flow at time zero with walls that differ or move.
    #[must_use]
    pub fn with_walls(mut self, spots: WallSpots) -> Self {
        self.spots = spots;
        self.prepare();
        self
    }

    /// All that follows from the positions: neighbors, volumes, normals, forces of interface and lines.
    pub fn prepare(&mut self) {
        let start = Instant::now();
        if self.steps.is_multiple_of(REORDER_EVERY) {
            let fluids = &self.particles.position[..self.particles.fluids];
            let order = Cells::build(fluids, &self.domain, self.method.kernel.support()).order().to_vec();
            self.reorder(
                order.iter().map(|&i| i as usize).chain(self.particles.fluids..self.particles.len()).collect(),
            );
        }
        let mut points = self.particles.position.clone();
        self.images = Images::append(&mut points, &self.domain, self.method.kernel.support());
        // The old pairs go first: both at once would be the most memory of the whole step.
        self.pairs = Pairs::default();
        self.pairs = Pairs::find(&points, self.particles.len(), &self.domain, &self.method.kernel);
        let after = Instant::now();
        let neighborhood = (&self.particles, &self.pairs, &self.images);
        self.fields.update_bulk(neighborhood, &self.method, &self.wall);
        let place = Place { domain: &self.domain, wall: &self.wall, spots: &self.spots };
        self.fields.update_interface(neighborhood, &self.method, &place, (&self.lines, self.last.dt));
        self.work.seconds[0] += (after - start).as_secs_f64();
        self.work.seconds[1] += after.elapsed().as_secs_f64();
    }

    fn order_walls(&mut self) {
        let moving = self.particles.moving();
        let walls = &self.particles.position[moving..];
        let order = Cells::build(walls, &self.domain, self.method.kernel.support()).order().to_vec();
        self.wall_depth = order.iter().map(|&i| self.wall_depth[i as usize]).collect();
        self.reorder((0..moving).chain(order.iter().map(|&i| i as usize + moving)).collect());
    }

    fn reorder(&mut self, order: Vec<usize>) {
        self.particles.reorder(&order);
    }

    /// Does one step that ends at `until` (s) or before.
    ///
    /// # Errors
    /// See [`SolverError`]; positions, velocities and time are then those before the step.
    pub fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        let start = Instant::now();
        let predicted = self.predict(until)?;
        let after_forces = Instant::now();
        if self.steps == 0 && !self.open.sides.is_empty() {
            for _ in 0..FIRST_SOLVES {
                self.particles.pressure = self.project(&predicted)?;
            }
        }
        let pressure = self.project(&predicted)?;
        let after_pressure = Instant::now();
        let velocity = self.correct(&predicted, &pressure);
        self.advance(&predicted, velocity, until)?;
        self.particles.pressure = pressure;
        if !self.open.sides.is_empty() {
            open::exchange(&mut self.particles, &self.open.sides, &mut self.open.ledger, self.method.spacing);
        }
        self.work.seconds[1] += (after_forces - start).as_secs_f64();
        self.work.seconds[2] += (after_pressure - after_forces).as_secs_f64();
        self.work.seconds[3] += after_pressure.elapsed().as_secs_f64();
        self.work.steps += 1;
        self.lines = std::mem::take(&mut self.fields.lines);
        self.prepare();
        Ok(self.last)
    }

    /// The predictor: viscosity, body force, surface force and line force [Huber2013, Eq. 25].
    fn predict(&self, until: f64) -> Result<Predicted, SolverError> {
        let (particles, fluids, moving) = (&self.particles, self.particles.fluids, self.particles.moving());
        let mut velocity = particles.velocity.clone();
        self.images.extend_velocity(&mut velocity);
        let (viscous, rate) = self.viscous_acceleration(&velocity);
        let (fastest, speed) = largest(moving, |a| particles.velocity[a].norm()).unwrap_or((0, 0.0));
        let step = self.method.time_step(speed, rate);
        let smallest = self.method.smallest_time_step(rate);
        if !(step.dt >= smallest) {
            let place = particles.position.get(fastest).copied().unwrap_or_default();
            let (time, step_number) = (self.time, self.steps);
            return Err(SolverError::TimeStep {
                dt: step.dt,
                smallest,
                limit: step.limit,
                time,
                step: step_number,
                place,
            });
        }
        let step = landing(step, self.time, until);
        let background = self.background_acceleration(speed);
        let f = &self.fields;
        each(&mut velocity[..fluids], |a| {
            let forces = (f.surface_force[a] + f.line_force[a]) / f.density[a];
            particles.velocity[a] + step.dt * (viscous[a] + self.method.gravity + forces + background[a])
        });
        let feet = Feet::new(particles, &self.open.sides, &self.domain, &self.method.kernel);
        self.set_buffer_velocity(&feet, &mut velocity);
        // Walls move along themselves only: of that no volume flows, also where a moving wall ends at one at rest.
        velocity[moving..particles.len()].fill(Vec2::zeros());
        self.images.extend_velocity(&mut velocity);
        Ok(Predicted { dt: step.dt, limit: step.limit, velocity, feet })
    }

    /// The viscous acceleration of the fluid particles in m/s² and the largest viscous rate in 1/s.
    fn viscous_acceleration(&self, velocity: &[Vec2]) -> (Vec<Vec2>, f64) {
        let (fluids, f) = (self.particles.fluids, &self.fields);
        let viscous = Viscous { volume: &f.volume, density: &f.density, viscosity: &f.viscosity };
        let stretch = |a: usize, b: usize| self.stretch(a, b);
        let v_ab = |a: usize, b: usize| self.velocity_difference(velocity, a, b);
        let mut acceleration = vec![Vec2::zeros(); fluids];
        match self.method.viscous_term {
            ViscousTerm::Stress => {
                viscous.morris(&self.pairs, v_ab, &mut acceleration);
                viscous.transposed(&self.pairs, v_ab, &mut acceleration);
            }
            ViscousTerm::Morris => viscous.morris(&self.pairs, v_ab, &mut acceleration),
            ViscousTerm::Szewc => viscous.szewc(&self.pairs, v_ab, &mut acceleration),
        }
        let mut rate = vec![0.0; fluids];
        viscous.rate(&self.pairs, stretch, &mut rate);
        (acceleration, rate.iter().fold(0.0, |m: f64, r| m.max(*r)))
    }

    /// v_a − v_b in m/s, at walls as these stretch it.
    fn velocity_difference(&self, velocity: &[Vec2], a: usize, b: usize) -> Vec2 {
        let v_ab = velocity[a] - velocity[b];
        let (distance, normal) = (self.fields.wall_distance[a], self.fields.wall_normal[a]);
        self.depth(b).map_or(v_ab, |depth| self.method.no_slip.difference(v_ab, normal, distance, depth))
    }

    /// The largest |v_ab| over the velocity difference: β at walls, 1 between fluid particles.
    fn stretch(&self, a: usize, b: usize) -> f64 {
        self.depth(b).map_or(1.0, |depth| self.method.no_slip.stretch(self.fields.wall_distance[a], depth))
    }

    /// Depth in m of a wall particle or its image, none for fluid.
    fn depth(&self, b: usize) -> Option<f64> {
        let source = self.images.source(b);
        source.checked_sub(self.particles.moving()).map(|wall| self.wall_depth[wall])
    }

    /// The viscous force in N per m of depth that fluid exerts on walls, from the fluid particles and to the wall particles that
    /// `is_meant` takes by the index and by the place (m).
    #[must_use]
    pub fn friction(&self, is_meant: impl Fn(usize, Vec2) -> bool + Sync) -> Vec2 {
        let (particles, fluids, f) = (&self.particles, self.particles.fluids, &self.fields);
        let moving = particles.moving();
        let mut velocity = particles.velocity.clone();
        self.images.extend_velocity(&mut velocity);
        let viscous = Viscous { volume: &f.volume, density: &f.density, viscosity: &f.viscosity };
        let v_ab = |a: usize, b: usize| {
            let source = self.images.source(b);
            let counts = source >= moving && is_meant(a, particles.position[source]);
            if counts { self.velocity_difference(&velocity, a, b) } else { Vec2::zeros() }
        };
        let mut acceleration = vec![Vec2::zeros(); fluids];
        match self.method.viscous_term {
            // Walls take the viscosity of the fluid that sees them, so that the transposed part does not act there.
            ViscousTerm::Morris | ViscousTerm::Stress => viscous.morris(&self.pairs, v_ab, &mut acceleration),
            ViscousTerm::Szewc => viscous.szewc(&self.pairs, v_ab, &mut acceleration),
        }
        -acceleration.iter().enumerate().map(|(a, by)| f.density[a] * f.volume[a] * by).sum::<Vec2>()
    }

    /// The viscous force in N per m of depth on the fluid particles that `is_meant` takes, by fluid and walls around them.
    #[must_use]
    pub fn viscous_force(&self, is_meant: impl Fn(usize) -> bool) -> Vec2 {
        let mut velocity = self.particles.velocity.clone();
        self.images.extend_velocity(&mut velocity);
        let (acceleration, _) = self.viscous_acceleration(&velocity);
        let f = &self.fields;
        let meant = acceleration.iter().enumerate().filter(|(a, _)| is_meant(*a));
        meant.map(|(a, by)| f.density[a] * f.volume[a] * by).sum()
    }

    /// Sets the velocities of buffer particles from those of the fluid in `velocity` (m/s): the given one at inlets, at sides with a
    /// given pressure the normal part of that at the foot, so that it goes on along the normal.
    fn set_buffer_velocity(&self, feet: &Feet, velocity: &mut [Vec2]) {
        for (i, b) in self.particles.buffer().enumerate() {
            let x = self.particles.position[b];
            let Some(side) = self.open.sides.iter().find(|side| side.beyond(x) >= 0.0) else { continue };
            velocity[b] = side.given_velocity(x).unwrap_or_else(|| {
                let at_foot = feet.value(i, velocity).unwrap_or_default();
                side.velocity(side.inwards() * at_foot[side.axis()])
            });
        }
    }

    /// Whether the divergence at particle `a` counts: deep beyond an open side the sums see no fluid, and no neighbors at its end.
    fn sees_the_fluid(&self, a: usize) -> bool {
        let (x, support) = (self.particles.position[a], self.method.kernel.support());
        self.open.sides.iter().all(|side| side.beyond(x) < support)
    }

    /// The background pressure p_0 in Pa for a flow of the given `speed` (m/s).
    fn background_pressure(&self, speed: f64) -> f64 {
        let m = &self.method;
        let scale = if m.tension > 0.0 { m.tension / m.kernel.h } else { m.mean_density() * speed * speed };
        m.background_pressure * scale
    }

    fn background_acceleration(&self, speed: f64) -> Vec<Vec2> {
        let mut acceleration = vec![Vec2::zeros(); self.particles.fluids];
        if self.method.pressure_gradient() == PressureGradient::Difference && self.method.background_pressure > 0.0 {
            let over_density = self.background_pressure(speed) / self.method.mean_density();
            pressure_gradient::background(&self.pairs, &self.fields.volume, over_density, &mut acceleration);
        }
        acceleration
    }

    /// The pressure that makes the end of the step free of divergence [Huber2013, Eqs. 29-31], mean zero over each part in which
    /// no open side gives it.
    ///
    /// The right side gives a share γ of the density error back per step (the drift source, which the paper lacks).
    fn project(&mut self, predicted: &Predicted) -> Result<Vec<f64>, SolverError> {
        let (n, fluids, dt) = (self.particles.len(), self.particles.fluids, predicted.dt);
        let (method, f) = (&self.method, &self.fields);
        let mut source = vec![0.0; n];
        divergence(&self.pairs, &f.volume, &predicted.velocity, &mut source);
        let (drift, v_0) = (method.drift_source / (dt * dt), method.volume);
        let mut b = vec![0.0; n];
        each(&mut b, |a| {
            let crowding = if a < fluids { v_0 / f.volume[a] - 1.0 } else { 0.0 };
            if !self.sees_the_fluid(a) {
                return 0.0;
            }
            -f.volume[a] * (source[a] / dt - drift * crowding)
        });
        let mut matrix = std::mem::take(&mut self.pressure.matrix);
        assemble(&mut matrix, (&self.pairs, &self.images), &f.volume, &f.density);
        if let Some(jump) = &f.jump {
            jump.subtract_from(&mut b, &matrix, &self.pairs, method.tension);
        }
        let jump = |b: usize| f.jump.as_ref().map_or(f64::NAN, |jump| method.tension * jump.curvature[b]);
        let prescribed = Prescribed::new(&self.particles, &self.open.sides, jump, method.kernel.h);
        let given = |a: usize| prescribed.of(a, fluids);
        let mut kind = self.kinds();
        let mut anchored = vec![false; self.particles.part.iter().max().map_or(0, |last| *last as usize + 1)];
        for a in self.particles.buffer().filter(|&a| given(a).is_some()) {
            anchored[self.particles.part[a] as usize] = true;
            kind[a] = GIVEN;
        }
        give(&mut matrix, &mut b, |a| given(a).map(|p| p - prescribed.reference));
        self.pressure.matrix = matrix;
        let part = &self.particles.part;
        let position = &self.particles.position;
        let unknowns = Unknowns { position, kind: &kind, part, anchored: &anchored, spacing: method.spacing };
        let offset = |a: usize| if anchored[part[a] as usize] { prescribed.reference } else { 0.0 };
        let relative = |a: usize| if given(a).is_some() { 0.0 } else { self.particles.pressure[a] - offset(a) };
        let mut p: Vec<f64> = (0..n).map(relative).collect();
        let convergence = self.pressure.solve(&unknowns, &self.fields.volume[..n], &mut b, &mut p, method.tolerance);
        p.iter_mut().enumerate().for_each(|(a, p)| *p = given(a).unwrap_or(*p + offset(a)));
        self.work.last_iterations = convergence.iterations;
        self.work.iterations += convergence.iterations as u64;
        self.work.residual = convergence.residual;
        if !(convergence.residual <= method.tolerance.residual) {
            return Err(SolverError::NotConverged {
                system: "the pressure equation",
                residual: convergence.residual,
                tolerance: method.tolerance.residual,
                iterations: convergence.iterations,
                time: self.time,
                step: self.steps,
            });
        }
        Ok(p)
    }

    /// 0 in and near the heavy fluid, 1 in and near the light one, so that the multigrid keeps them apart.
    fn kinds(&self) -> Vec<u8> {
        let (w, o) = (self.method.wetting_fluid.density, self.method.other_fluid.density);
        let is_jump = self.method.density_ratio() > LARGEST_SMOOTH_RATIO;
        let between = if is_jump { (w * o).sqrt() } else { 0.0 };
        self.fields.density[..self.particles.len()].iter().map(|&rho| u8::from(rho < between)).collect()
    }

    /// The corrector: the velocity of fluid and buffers at the end of the step [Huber2013, Eq. 26].
    fn correct(&self, predicted: &Predicted, pressure: &[f64]) -> Vec<Vec2> {
        let (fluids, f) = (self.particles.fluids, &self.fields);
        let mut p = pressure.to_vec();
        let mut acceleration = vec![Vec2::zeros(); fluids];
        let form = self.method.pressure_gradient();
        if form != PressureGradient::Difference {
            // The constant matters in these forms: all pressures at or above the background order the particles.
            let speed = largest(fluids, |a| self.particles.velocity[a].norm()).map_or(0.0, |l| l.1);
            let lowest = p.iter().fold(f64::INFINITY, |m, p| m.min(*p));
            let shift = self.background_pressure(speed) - lowest;
            p.iter_mut().for_each(|p| *p += shift);
        }
        self.images.extend(&mut p);
        let (pairs, volume, density) = (&self.pairs, &f.volume, &f.density);
        match form {
            PressureGradient::Symmetric => pressure_gradient::symmetric(pairs, volume, density, &p, &mut acceleration),
            PressureGradient::Weighted => pressure_gradient::weighted(pairs, volume, density, &p, &mut acceleration),
            PressureGradient::Difference => {
                let jump = |a: usize, b: usize| f.jump.as_ref().map_or(0.0, |jump| self.method.tension * jump.of(a, b));
                pressure_gradient::difference(pairs, volume, density, &p, jump, &mut acceleration);
            }
        }
        let corrected = acceleration.iter().zip(&predicted.velocity).map(|(a, v)| v + predicted.dt * a);
        let mut velocity: Vec<Vec2> =
            corrected.chain(std::iter::repeat_n(Vec2::zeros(), self.particles.open)).collect();
        self.set_buffer_velocity(&predicted.feet, &mut velocity);
        velocity
    }

    /// Wall time by part in s.
    #[must_use]
    pub fn part_times(&self) -> Vec<PartTime> {
        PARTS.iter().zip(self.work.seconds).map(|(part, seconds)| PartTime { part, seconds }).collect()
    }

    /// Bytes held per particle by pairs, matrix, hierarchy and fields.
    #[must_use]
    pub fn bytes(&self) -> usize {
        // Sixteen numbers of fields and particles, and ten of work space in step and solve, of 8 bytes or a pair of them.
        let fields = self.particles.len() * (16 + 10) * 8 * 3 / 2;
        self.pairs.bytes() + self.pressure.bytes() + fields
    }
}
