//! The SPH solver of the simulation loop.

use std::sync::OnceLock;

use crate::flow::{Flow, PARTS};
use crate::frozen::FrozenInterface;
use crate::measures::{DiscOf, Group, Subject, all, columns, has_passed, permeability, relative, samples_of_chip};
use crate::observe::Observation;
use crate::output;
use crate::particles::{Particles, relative_speed};
use crate::stages::Stages;
use crate::unresolved::wetted_by_largest_part;
use crate::warnings::warnings;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_core::snapshot::{Lines, Snapshot};
use meniscus_core::solver::{
    Measure, PartTime, Quantity, Results, Sample, Series, Solver, SolverError, StateError, Statistics, StepInfo,
    Watched,
};
use meniscus_core::table::Document;
use meniscus_geometry::analysis::phases::{PhaseAreas, density_error};
use meniscus_geometry::interface::lengths::WallSample;

/// A flow with what is needed to observe it.
pub struct SphSolver {
    /// The flow.
    pub flow: Flow,
    /// Areas of the phases at time zero.
    start: PhaseAreas,
    /// Observation of the present state, computed on first use.
    observed: OnceLock<Observation>,
    surroundings: Surroundings,
    /// The flows with a frozen interface, one after the other, and the number of the present one.
    frozen: Option<(FrozenInterface, usize)>,
    /// Measures in addition to those of every run.
    groups: Vec<Group>,
}

/// Generator of a document from the particles and the capillary pressure in Pa.
pub(crate) type StateExport = Box<dyn Fn(&Particles, f64) -> Document<'static> + Send + Sync>;

/// The fixed surroundings of the flow.
pub(crate) struct Surroundings {
    /// Outline of the solids.
    pub(crate) outline: Lines<'static>,
    /// Samples of the wall for the wetted length.
    pub(crate) wall_samples: Vec<WallSample>,
    /// The discs among the solids.
    pub(crate) discs: Vec<DiscOf>,
    /// The axis-aligned rectangles among the solids.
    pub(crate) plates: Vec<Bounds>,
    /// Speeds of the walls at the left, right, bottom and top side in m/s.
    pub(crate) wall_speeds: [f64; 4],
    /// Whether walls may have edges, where contact lines pin: not without solids in the box.
    pub(crate) has_edges: bool,
    /// Body forces that act one after the other, for measurements of permeability.
    pub(crate) stages: Option<Stages>,
    /// Whether the run ends when the invading phase has passed another open side.
    pub(crate) stops_at_breakthrough: bool,
    /// Whether the run ends when the drop is off the walls.
    pub(crate) stops_at_detachment: bool,
    /// Spacing of grid nodes in m.
    pub(crate) grid_spacing: f64,
    /// If the flow started from the state of a network: the state that it returns.
    pub(crate) state_export: Option<StateExport>,
}

impl SphSolver {
    /// Smallest and largest angle in degrees at which every contact line is at rest, of a flow driven by its interface alone.
    fn angles_at_rest(&self) -> Option<[f64; 2]> {
        let config = &self.flow.config;
        let is_driven = config.method.gravity != Vec2::zeros()
            || !config.open.sides.is_empty()
            || !config.open.through.is_empty()
            || self.surroundings.wall_speeds != [0.0; 4]
            || self.surroundings.stages.is_some();
        let model = config.method.wetting.filter(|_| !is_driven && config.method.patches.is_empty())?;
        Some(model.hysteresis_range().map(f64::to_degrees))
    }

    /// A solver at time zero.
    pub(crate) fn new(flow: Flow, surroundings: Surroundings) -> Self {
        let observed = Observation::of(&flow, &surroundings.wall_samples);
        let (start, observed) = (observed.areas, OnceLock::from(observed));
        let mut solver = Self { flow, start, observed, surroundings, frozen: None, groups: Vec::new() };
        solver.update_force();
        solver
    }

    /// A solver at time zero of the flows with a frozen interface, one after the other.
    pub(crate) fn beside(interface: FrozenInterface, surroundings: Surroundings) -> Self {
        let first = interface.flows[0]();
        Self { frozen: Some((interface, 0)), ..Self::new(first, surroundings) }
    }

    /// The solver with the columns and measures of `groups`.
    pub fn measuring(self, groups: Vec<Group>) -> Self {
        Self { groups, ..self }
    }

    /// Starts the flow of the present stage with a frozen interface, if the stage has changed.
    fn update_flow(&mut self) {
        if let (Some((interface, present)), Some(stages)) = (&mut self.frozen, &self.surroundings.stages) {
            let stage = stages.stage(self.flow.state.time);
            if stage != *present {
                self.flow = interface.flow(stage, &self.flow);
                *present = stage;
            }
        }
    }

    /// Sets the body force of the present stage, if several act one after the other.
    fn update_force(&mut self) {
        if let Some(stages) = &self.surroundings.stages {
            self.flow.config.method.gravity = stages.force(self.flow.state.time);
            self.flow.config.since = stages.since(self.flow.state.time);
        }
    }

    /// Observation of the present flow, computed at most once per step for series, files and report.
    pub(crate) fn observe(&self) -> &Observation {
        self.observed.get_or_init(|| Observation::of(&self.flow, &self.surroundings.wall_samples))
    }

    fn kinetic_energy(&self) -> f64 {
        let (p, m) = (&self.flow.state.particles, &self.flow.config.method);
        let energy = |a: usize| 0.5 * m.fluid(p.phase[a]).density * m.volume * p.velocity[a].norm_squared();
        (0..p.fluids).map(energy).sum()
    }

    fn subject<'a>(&'a self, series: &'a Series) -> Subject<'a> {
        let around = &self.surroundings;
        Subject {
            flow: &self.flow,
            observed: self.observe(),
            start: self.start,
            series,
            discs: &around.discs,
            plates: &around.plates,
            wall_speeds: around.wall_speeds,
            stages: around.stages.as_ref(),
            is_frozen: self.frozen.is_some(),
        }
    }

    fn momentum(&self) -> Vec2 {
        let (p, m) = (&self.flow.state.particles, &self.flow.config.method);
        (0..p.fluids).map(|a| m.fluid(p.phase[a]).density * m.volume * p.velocity[a]).sum()
    }
}

impl Solver for SphSolver {
    fn time(&self) -> f64 {
        self.flow.state.time
    }

    fn is_done(&self) -> bool {
        let around = &self.surroundings;
        (around.stops_at_breakthrough && has_passed(&self.flow))
            || (around.stops_at_detachment && wetted_by_largest_part(&self.flow) == 0.0)
    }

    fn steps(&self) -> u64 {
        self.flow.state.steps
    }

    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        self.observed.take();
        self.update_flow();
        self.update_force();
        let time = self.flow.state.time;
        self.flow.step(self.surroundings.stages.as_ref().map_or(until, |stages| stages.stop(time, until)))
    }

    fn snapshot(&self) -> Snapshot<'_> {
        output::snapshot(&self.flow, self.observe(), self.surroundings.grid_spacing)
    }

    fn outline(&self) -> Lines<'_> {
        self.surroundings.outline.clone()
    }

    fn sample(&self) -> Vec<Sample> {
        let (flow, observed) = (&self.flow, self.observe());
        let fluids = flow.state.particles.fluids;
        let [error, _] = density_error(&flow.fields.bulk.volume[..fluids], flow.config.method.volume);
        let speed = flow.state.particles.fluid_speed();
        let momentum = self.momentum();
        let row = [
            // Time
            ("time_s", flow.state.time),
            // Number of steps
            ("step", flow.state.steps as f64),
            // Last time step
            ("dt_s", flow.state.last_dt),
            // Area of the wetting phase over that of both
            ("saturation", observed.areas.saturation()),
            // Length of the interface
            ("interface_length_m", observed.interface_length()),
            // Length of wall under the wetting phase
            ("wetted_length_m", observed.wetted_length),
            // Pressure of the non-wetting phase minus that of the wetting phase
            ("capillary_pressure_Pa", observed.capillary_pressure.value),
            // Mean contact angle
            ("contact_angle_deg", observed.angle().mean_deg),
            // Kinetic energy per depth
            ("kinetic_energy_J_per_m", self.kinetic_energy()),
            // Largest speed
            ("max_speed_m_per_s", speed),
            // Largest speed relative to the mean velocity of both fluids
            ("max_relative_speed_m_per_s", relative_speed(&flow.state.particles.velocity[..fluids])),
            // Root mean square of `V_0/V − 1`
            ("density_error", error),
            // Iterations of the last pressure solve
            ("ppe_iterations", flow.work.last_iterations as f64),
            // Area of the wetting phase
            ("wetting_area_m2", observed.areas.wetting),
            // Area of the non-wetting phase
            ("non_wetting_area_m2", observed.areas.non_wetting),
            // Number of contact lines
            ("contact_lines", observed.contact_lines.len() as f64),
            // Number of connected parts of the wetting phase
            ("wetting_blobs", observed.wetting_blobs.len() as f64),
            // Number of parts of either phase with fewer than 20 particles
            ("small_pieces", observed.small_pieces as f64),
            // Momentum per depth
            ("momentum_x_kg_per_m_s", momentum.x),
            ("momentum_y_kg_per_m_s", momentum.y),
        ];
        let more = columns(flow, observed, self.surroundings.stages.is_some(), &self.groups);
        let mut row: Vec<Sample> = row.into_iter().chain(more).map(|(name, value)| Sample { name, value }).collect();
        row.extend(samples_of_chip(flow, &row));
        row
    }

    fn watched(&self) -> Vec<Watched> {
        let (m, size) = (&self.flow.config.method, self.flow.config.domain.bounds.size());
        let capillary_speed =
            (m.tension > 0.0).then(|| m.tension / m.wetting_fluid.viscosity.max(m.other_fluid.viscosity));
        let energy = "kinetic_energy_J_per_m";
        let kind = Quantity::Energy { speed: "max_speed_m_per_s", capillary_speed };
        let mut watched = vec![Watched { column: energy, kind }];
        if m.tension > 0.0 {
            // The capillary pressure of an interface with the radius of the domain size.
            let pressure = Quantity::Pressure { scale: m.tension / size.max() };
            watched.push(Watched { column: "capillary_pressure_Pa", kind: pressure });
            watched.push(Watched { column: "saturation", kind: Quantity::Saturation });
            let at_rest = self.angles_at_rest();
            let angle = Quantity::Angle {
                energy,
                length: "interface_length_m",
                tension: m.tension,
                at_rest,
                pins: self.surroundings.has_edges,
            };
            watched.push(Watched { column: "contact_angle_deg", kind: angle });
        }
        watched
    }

    fn measures(&self, series: &Series) -> Vec<Measure> {
        all(&self.subject(series), &self.groups)
    }

    fn warnings(&self, series: &Series) -> Vec<String> {
        let subject = self.subject(series);
        let of_permeability = permeability::warnings(&subject).into_iter().chain(relative::warnings(&subject));
        let of_groups = self.groups.iter().flat_map(|group| (group.warnings)(&subject));
        let of_flow = warnings(&self.flow, self.observe(), series);
        of_flow.into_iter().chain(of_permeability).chain(of_groups).collect()
    }

    fn results(&self) -> Results<'_> {
        let of_now = |export: &StateExport| export(&self.flow.state.particles, self.observe().capillary_pressure.value);
        let back = self.surroundings.state_export.as_ref().map(of_now);
        Results { documents: back.into_iter().collect(), ..Results::default() }
    }

    fn state(&self) -> Vec<u8> {
        // Serializing numbers to memory cannot fail.
        let mut bytes = postcard::to_stdvec(&self.start).unwrap_or_default();
        if let Some((_, present)) = &self.frozen {
            bytes.extend(postcard::to_stdvec(present).unwrap_or_default());
        }
        bytes.extend(self.flow.save());
        bytes
    }

    fn restore(&mut self, state: &[u8]) -> Result<(), StateError> {
        self.observed.take();
        let unreadable = |error: postcard::Error| StateError(error.to_string());
        let (start, mut flow) = postcard::take_from_bytes(state).map_err(unreadable)?;
        if let Some((interface, present)) = &mut self.frozen {
            (*present, flow) = postcard::take_from_bytes(flow).map_err(unreadable)?;
            self.flow = interface.flow(*present, &self.flow);
        }
        self.flow.load(flow)?;
        self.start = start;
        self.update_force();
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        let work = &self.flow.work;
        let per_step = |count: u64| count as f64 / work.steps.max(1) as f64;
        Statistics {
            unknowns: self.flow.state.particles.len(),
            steps: work.steps,
            parts: PARTS.iter().zip(work.seconds).map(|(part, seconds)| PartTime { part, seconds }).collect(),
            counts: vec![
                ("fluid-particles", self.flow.state.particles.fluids as f64),
                ("ppe-iterations-per-step", per_step(work.iterations)),
                ("viscous-iterations-per-step", per_step(work.viscous_iterations)),
                ("ppe-relative-residual", work.residual),
                ("bytes-per-particle", self.flow.bytes() as f64 / self.flow.state.particles.len().max(1) as f64),
                ("repeated-steps", work.repeats as f64),
                ("particles-set-back-from-walls", work.set_back as f64),
            ],
        }
    }
}
