//! One time step: predictor, pressure, corrector [Huber2013, section 3.3]. The one place where the order of the terms is decided.
//!
//! [`Flow::step`] is that order; the files beside this one hold its stages.

mod corrector;
mod given_flow;
mod hydrostatic;
mod implicit_viscosity;
mod predictor;
mod pressure;
mod viscous;

use std::time::Instant;

pub(in crate::sph) use self::given_flow::Response;
use crate::math::{Vec2, perpendicular};
use crate::solver::{PartTime, SolverError, StepInfo};
use crate::sph::cells::Cells;
use crate::sph::domain::{Domain, WallQuery};
use crate::sph::fields::{Fields, Neighborhood, Place};
use crate::sph::images::Images;
use crate::sph::method::{Method, ViscousStep};
use crate::sph::open::{self, InteriorPoints, Open};
use crate::sph::pairs::{Pairs, largest};
use crate::sph::particles::Particles;
use crate::sph::poisson::{PressureSolve, parts};
use crate::sph::wetting::lines::Line;
use crate::sph::wetting::wall::WallSpots;

/// The particles are put in the order of their cells every so many steps, so that neighbors are near in memory.
const REORDER_EVERY: u64 = 20;

/// Solves before the first step with open sides: there is no step before to take the slopes of the pressure from. The slope of the
/// fluid answers to that of the buffer by a small share, so that few will do. Without them one does, for the viscous step.
const FIRST_SOLVES: usize = 6;

/// A step is shortened so many times at most; one does where forces accelerate particles.
const MOST_REPEATS: usize = 10;

/// The curvature of a wall is the turn of its normal this far to both sides, over dx.
const TURN_OVER: f64 = 0.25;

/// Walls with more curvature than this, over 1/h, count as edges.
const TIGHTEST: f64 = 0.5;

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
    /// Iterations of all viscous solves.
    pub viscous_iterations: u64,
    /// Steps that were taken again, since a particle would have gone too far.
    pub repeats: u64,
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
    /// Normal of the wall nearest to each wall particle, into the fluid.
    pub wall_facing: Vec<Vec2>,
    /// Curvature in 1/m of the wall nearest to each wall particle, positive where the solid is convex; 0 at edges.
    pub wall_curvature: Vec<f64>,
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
    /// The largest velocity of a particle in m/s, relative to the mean of all.
    fastest: f64,
    /// v_int over particles and images in m/s, without the gravity that goes with the pressure.
    velocity: Vec<Vec2>,
    /// Where the buffers of open sides take the velocity from.
    interior: InteriorPoints,
    /// What comes of the viscous solve.
    damped: Damped,
}

/// The end of a step before the particles move [Huber2013, Eq. 26].
pub(super) struct Corrected {
    /// Velocity of fluid and buffers in m/s.
    velocity: Vec<Vec2>,
    /// Pressure in Pa, without the mean gradients that drive given flows.
    pressure: Vec<f64>,
    /// The way in m that each fluid particle goes for the density-error correction by shifting, empty where there is none.
    drift: Vec<Vec2>,
    /// By how much the mean gradients that drive given flows change, in Pa/m.
    gradient_changes: Vec<f64>,
    /// What unit gradients do.
    responses: Vec<Response>,
}

/// What comes of a viscous solve beside the acceleration; nothing of an explicit step.
#[derive(Default)]
pub(super) struct Damped {
    /// Acceleration of the fluid in m/s² by the pressure before the step.
    by_pressure: Vec<Vec2>,
    /// The share of the step beyond the longest explicit one.
    excess: f64,
    /// Iterations.
    iterations: usize,
}

impl Flow {
    /// The flow at time zero. `wall_depth` in m as `fill` returns it.
    #[must_use]
    pub fn new(
        method: Method,
        domain: Domain,
        wall: WallQuery,
        particles: Particles,
        wall_depth: Vec<f64>,
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
            wall_facing: Vec::new(),
            wall_curvature: Vec::new(),
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
        flow.face_walls();
        flow.prepare();
        let facing = flow.facing();
        flow.particles.part = parts(&flow.pairs, &flow.images, |a, b| pressure::joined(facing[a], facing[b]));
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
        let cells = Cells::build(&points, &self.domain, self.method.kernel.support());
        self.pairs.find_anew(&cells, &points, self.particles.len(), &self.domain, &self.method.kernel);
        let after = Instant::now();
        let neighborhood = Neighborhood { particles: &self.particles, pairs: &self.pairs, images: &self.images };
        self.fields.update_bulk(neighborhood, &self.method, &self.wall);
        let place = Place {
            domain: &self.domain,
            wall: &self.wall,
            spots: &self.spots,
            lines_before: &self.lines,
            dt: self.last.dt,
        };
        self.fields.update_interface(neighborhood, &self.method, &place);
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

    /// Finds where each wall particle faces and how its wall bends; they rest.
    pub(in crate::sph) fn face_walls(&mut self) {
        let walls = &self.particles.position[self.particles.moving()..];
        self.wall_facing = walls.iter().map(|&x| (self.wall)(x).1).collect();
        self.wall_curvature = walls.iter().map(|&x| self.curvature_of_wall(x)).collect();
    }

    /// The turn of the normal along the wall nearest to `x` (m) over its length, in 1/m.
    fn curvature_of_wall(&self, x: Vec2) -> f64 {
        let (distance, normal) = (self.wall)(x);
        let (inside, along) = (x - distance * normal, perpendicular(normal));
        let normal_at = |way: f64| (self.wall)(inside + way * along).1;
        let step = TURN_OVER * self.method.spacing;
        let curvature = (normal_at(step) - normal_at(-step)).dot(&along) / (2.0 * step);
        if curvature.abs() * self.method.kernel.h < TIGHTEST { curvature } else { 0.0 }
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
        self.open.sides.iter_mut().for_each(|side| side.take_step(self.time));
        if self.steps == 0 {
            self.find_first_pressure(until)?;
        }
        let mut predicted = self.predict(until, f64::INFINITY, self.method.viscous_step)?;
        let after_forces = Instant::now();
        let mut corrected = self.end_of(&predicted)?;
        for _ in 0..MOST_REPEATS {
            let velocity = &corrected.velocity;
            let fastest = largest(velocity.len(), |a| velocity[a].norm()).map_or(0.0, |l| l.1);
            let Some(dt) = self.method.shorter_step(predicted.dt, fastest * predicted.dt) else { break };
            predicted = self.predict(until, dt, self.method.viscous_step)?;
            corrected = self.end_of(&predicted)?;
            self.work.repeats += 1;
        }
        self.work.viscous_iterations += predicted.damped.iterations as u64;
        let after_pressure = Instant::now();
        let Corrected { velocity, pressure, drift, gradient_changes, responses } = corrected;
        self.advance(&predicted, velocity, &drift, &responses, until)?;
        self.take_up(pressure, &gradient_changes);
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

    /// Finds the pressure that the viscous step and open sides take from the step before, where there is none: that which the forces at time
    /// zero ask for.
    fn find_first_pressure(&mut self, until: f64) -> Result<(), SolverError> {
        self.start_given_flow()?;
        for _ in 0..if self.open.sides.is_empty() { 1 } else { FIRST_SOLVES } {
            let predicted = self.predict(until, f64::INFINITY, ViscousStep::Explicit)?;
            let corrected = self.end_of(&predicted)?;
            self.take_up(corrected.pressure, &corrected.gradient_changes);
        }
        Ok(())
    }

    /// The end of the step that is predicted so.
    fn end_of(&mut self, predicted: &Predicted) -> Result<Corrected, SolverError> {
        let projected = self.project(predicted)?;
        Ok(self.correct(predicted, projected))
    }

    /// Takes up the pressure (Pa) of a step with the changes of the mean gradients (Pa/m).
    fn take_up(&mut self, pressure: Vec<f64>, gradient_changes: &[f64]) {
        self.particles.pressure = pressure;
        for (through, change) in self.open.through.iter_mut().zip(gradient_changes) {
            through.state.gradient += change;
        }
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
