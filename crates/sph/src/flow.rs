//! A flow: its configuration, its state, the fields derived from these, and the pressure solver.
//!
//! [`Flow::step`](crate::projection) advances it by one time step.

use std::time::Instant;

use crate::bulk::BulkFields;
use crate::cells::Cells;
use crate::configuration::Configuration;
use crate::fields::Fields;
use crate::neighborhood::Neighborhood;
use crate::open::GivenFlow;
use crate::particles::Particles;
use crate::poisson::{PressureSolve, parts};
use crate::state::FlowState;
use crate::surface_force::interface_fields;
use crate::view::View;
use crate::walls::WallFields;
use crate::wetting::lines::TrackedLine;
use meniscus_core::math::Vec2;
use meniscus_core::solver::StateError;

/// The particles are sorted by cell every so many steps, so that neighbors are close in memory.
const REORDER_EVERY: u64 = 20;

/// Names of the parts that `Work::seconds` counts.
pub const PARTS: [&str; 4] = ["neighbors", "forces", "pressure", "move"];

/// A flow at one time.
pub struct Flow {
    /// Configuration; it changes with time only as the case prescribes.
    pub config: Configuration,
    /// State from which a step starts, as saved for restart.
    pub state: FlowState,
    /// Pairs and images at the present positions, derived from the state.
    pub neighborhood: Neighborhood,
    /// Volumes, densities, normals and forces at the present positions, derived from the state.
    pub fields: Fields,
    /// The contact lines at the present positions, which the next step stores in the state.
    pub lines: Vec<TrackedLine>,
    /// Matrix and workspace of the pressure solve. No step depends on what the previous one left in it.
    pub pressure: PressureSolve,
    /// Counts, for reports only.
    pub work: Work,
}

/// Counts of the solver's work.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Work {
    /// Steps taken by this process.
    pub steps: u64,
    /// Iterations of the last pressure solve.
    pub last_iterations: usize,
    /// Iterations of all pressure solves.
    pub iterations: u64,
    /// Relative residual of the last pressure solve.
    pub residual: f64,
    /// Iterations of all viscous solves.
    pub viscous_iterations: u64,
    /// Steps that were repeated because a particle would have moved too far.
    pub repeats: u64,
    /// Particles set back from a wall.
    pub set_back: u64,
    /// Wall time of neighbors, forces, pressure matrix and solve, move in s.
    pub seconds: [f64; 4],
}

impl Flow {
    /// The flow at time zero. `wall_depth` in m as returned by `fill`.
    pub(crate) fn new(config: Configuration, particles: Particles, wall_depth: Vec<f64>) -> Self {
        let mut state = FlowState::new(particles, wall_depth, config.open.through.len());
        order_walls(&mut state, &config);
        let mut flow = Self {
            config,
            state,
            neighborhood: Neighborhood::default(),
            fields: Fields::default(),
            lines: Vec::new(),
            pressure: PressureSolve::default(),
            work: Work::default(),
        };
        flow.fields.walls = WallFields::of(&flow.config, &flow.state.particles);
        flow.prepare();
        let Neighborhood { pairs, images } = &flow.neighborhood;
        let joined = flow.fields.walls.joined(flow.state.particles.moving(), images);
        flow.state.particles.part = parts(pairs, images, joined);
        flow
    }

    /// The state as bytes.
    pub fn save(&self) -> Vec<u8> {
        // Serializing numbers to memory cannot fail, and `load` rejects an empty state.
        postcard::to_stdvec(&self.state).unwrap_or_default()
    }

    /// Restores a saved state and recomputes all fields derived from it.
    ///
    /// # Errors
    /// [`StateError`] if the bytes are not the state of a flow with the same number of particles.
    pub fn load(&mut self, bytes: &[u8]) -> Result<(), StateError> {
        let mut state: FlowState = postcard::from_bytes(bytes).map_err(|e| StateError(format!("{e}")))?;
        let (saved, own) = (&state.particles, &self.state.particles);
        let is_open = !self.config.open.sides.is_empty();
        let same_fluid = saved.len() == own.len() && saved.fluids == own.fluids;
        if saved.walls != own.walls || !(is_open || same_fluid) {
            let (found, expected) = (saved.len(), own.len());
            return Err(StateError(format!("it has {found} particles, the case has {expected}")));
        }
        // A side that the saved run did not have starts from its initial values.
        state.given_flows.resize(self.state.given_flows.len(), GivenFlow::default());
        self.state = state;
        self.fields.walls = WallFields::of(&self.config, &self.state.particles);
        self.prepare();
        Ok(())
    }

    /// Computes all that is derived from the state: neighbors, volumes, normals, forces of interface and contact lines.
    pub fn prepare(&mut self) {
        let start = Instant::now();
        let Self { config, state, neighborhood, fields, lines, .. } = self;
        if state.steps.is_multiple_of(REORDER_EVERY) {
            order_fluid(&mut state.particles, config);
        }
        neighborhood.update(&state.particles.position, &config.domain, &config.method.kernel);
        let after = Instant::now();
        let found = View { config, state, neighborhood, fields: &() };
        fields.bulk = BulkFields::of(&found);
        (fields.interface, *lines) = interface_fields(&found.with(&fields.bulk));
        self.work.seconds[0] += (after - start).as_secs_f64();
        self.work.seconds[1] += after.elapsed().as_secs_f64();
    }

    /// Read access to the flow.
    pub fn view(&self) -> View<'_, Fields> {
        let Self { config, state, neighborhood, fields, .. } = self;
        View { config, state, neighborhood, fields }
    }

    /// Read access to the flow, with the pressure solver and the work counts.
    pub(crate) fn solving(&mut self) -> (View<'_, Fields>, &mut PressureSolve, &mut Work) {
        let Self { config, state, neighborhood, fields, pressure, work, .. } = self;
        (View { config, state, neighborhood, fields }, pressure, work)
    }

    /// Memory in bytes of pairs, matrix, hierarchy and fields.
    pub fn bytes(&self) -> usize {
        // Per particle 16 quantities of fields and particles and 10 of workspace in step and solve, scalars or vectors of 8 bytes a component.
        let fields = self.state.particles.len() * (16 + 10) * 8 * 3 / 2;
        self.neighborhood.pairs.bytes() + self.pressure.bytes() + fields
    }
}

/// Sorts the fluid particles by cell.
fn order_fluid(particles: &mut Particles, config: &Configuration) {
    let order = order_of_cells(&particles.position[..particles.fluids], config);
    particles.reorder(&order.into_iter().chain(particles.fluids..particles.len()).collect::<Vec<usize>>());
}

/// Sorts the wall particles by cell.
fn order_walls(state: &mut FlowState, config: &Configuration) {
    let moving = state.particles.moving();
    let order = order_of_cells(&state.particles.position[moving..], config);
    state.wall_depth = order.iter().map(|&i| state.wall_depth[i]).collect();
    state.particles.reorder(&(0..moving).chain(order.iter().map(|i| i + moving)).collect::<Vec<usize>>());
}

fn order_of_cells(points: &[Vec2], config: &Configuration) -> Vec<usize> {
    let cells = Cells::build(points, &config.domain, config.method.kernel.support());
    cells.order.iter().map(|&i| i as usize).collect()
}
