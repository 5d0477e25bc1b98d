//! The [`Solver`] of a dynamic displacement. Its clock is the time in s; one step ends at an event or at a record.

use std::time::Instant;

use super::model::DynamicModel;
use super::{Breakthrough, Drive, Dynamic, StepEnd};
use super::{measures, playback};
use crate::cycles::FluidPhase;
use crate::displacement::{Division, Element, EventKind};
use crate::laplacian::FlowError;
use crate::model::Model;
use crate::solver::{NetworkSolver, outline, results_with};
use crate::{layers, pictures, summary, warnings};
use meniscus_case::network::Stop;
use meniscus_core::diagram::{Diagram, RegionMap};
use meniscus_core::math::Vec2;
use meniscus_core::playback::Playback;
use meniscus_core::snapshot::{Cloud, Layer, Lines, Snapshot};
use meniscus_core::solver::{
    Measure, PartTime, Results, Sample, Series, Solver, SolverError, StateError, Statistics, StepInfo,
};

/// A network with a dynamic displacement.
pub struct DynamicSolver {
    model: DynamicModel,
    stop: Stop,
    is_closed: bool,
    steps_before: u64,
    /// Wall times of extraction and displacement in s.
    seconds: [f64; 2],
}

impl DynamicSolver {
    /// A displacement in its initial state.
    pub(crate) fn new(quasi_static: NetworkSolver, dynamic: Dynamic, invading: FluidPhase, stop: Stop) -> Self {
        let NetworkSolver { model: quasi_static, seconds, .. } = quasi_static;
        Self {
            model: DynamicModel { quasi_static, dynamic, invading },
            stop,
            is_closed: false,
            steps_before: 0,
            seconds,
        }
    }

    /// By element: saturation of the invading phase.
    pub fn shares(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.model.dynamic.displacement().elements().len()).map(|element| self.model.dynamic.share(element))
    }

    /// The network, without a displacement.
    pub(crate) fn quasi_static(&self) -> &Model {
        &self.model.quasi_static
    }

    /// The elements of the pore space.
    pub fn elements(&self) -> &[Element] {
        self.model.dynamic.displacement().elements()
    }

    /// The division of the pore space into elements.
    pub(crate) fn division(&self) -> Division {
        self.model.dynamic.displacement().division()
    }

    /// When the invading phase reached the outlet.
    pub fn breakthrough(&self) -> Option<Breakthrough> {
        self.model.dynamic.breakthrough()
    }

    /// The invading phase.
    pub fn invading(&self) -> FluidPhase {
        self.model.invading
    }

    fn is_whole(&self) -> bool {
        self.model.quasi_static.config.is_whole()
    }

    fn count(&self, kind: EventKind) -> f64 {
        self.model.dynamic.history().iter().filter(|event| event.kind == kind).count() as f64
    }

    fn failed(&self, error: FlowError) -> SolverError {
        SolverError::BlowUp {
            what: error.to_string(),
            time: self.model.dynamic.time(),
            step: self.model.dynamic.state.steps,
            position: Vec2::zeros(),
        }
    }
}

impl Solver for DynamicSolver {
    fn time(&self) -> f64 {
        self.model.dynamic.time()
    }

    fn is_done(&self) -> bool {
        let Self { model, stop, .. } = self;
        self.is_closed
            || (stop.breakthrough && model.dynamic.breakthrough().is_some())
            || stop.saturation.is_some_and(|wetting| model.saturation() >= model.invading.saturation(wetting))
            || stop.injected.is_some_and(|end| model.injected() >= end)
    }

    fn steps(&self) -> u64 {
        self.model.dynamic.state.steps
    }

    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        let (clock, before) = (Instant::now(), self.model.dynamic.time());
        // Not past the volume to be injected.
        let left = self.stop.injected.map_or(f64::INFINITY, |end| end - self.model.injected());
        let until = match self.model.dynamic.terms().drive {
            Drive::Rate(rate) if left.is_finite() => {
                until.min(before + left * self.model.dynamic.space.pore_area / rate)
            }
            _ => until,
        };
        let ended = self.model.dynamic.advance(until).map_err(|error| self.failed(error));
        self.seconds[1] += clock.elapsed().as_secs_f64();
        let ended = ended?;
        self.is_closed = ended == StepEnd::Closed;
        let limit = match ended {
            StepEnd::Event => "event",
            StepEnd::Time => "record",
            StepEnd::Closed => "end",
        };
        Ok(StepInfo { dt: self.model.dynamic.time() - before, limit })
    }

    fn steps_to(&self, _end: f64) -> Option<f64> {
        // A step ends at an event: an element is entered at one and full at another, and few are invaded twice.
        Some((2.0 * self.elements().len() as f64 - self.steps() as f64).max(0.0))
    }

    fn snapshot(&self) -> Snapshot<'_> {
        Snapshot {
            time: self.time(),
            step: self.steps(),
            particles: Cloud::default(),
            grid: None,
            interface: self.is_whole().then(|| layers::menisci(self.model.dynamic.menisci())),
        }
    }

    fn outline(&self) -> Lines<'_> {
        outline(&self.model.quasi_static.config)
    }

    fn sample(&self) -> Vec<Sample> {
        let sample = |name, value| Sample { name, value };
        let (pressure, inflow) = self.model.dynamic.drive_now();
        let fingers = self.model.dynamic.fingers(&self.model.quasi_static.config);
        let depth = self.model.quasi_static.config.network.depth;
        vec![
            // Time
            sample("time_s", self.time()),
            // Number of steps
            sample("step", self.steps() as f64),
            // Area that passed the inlet over that of the pores
            sample("injected_pore_volumes", self.model.injected()),
            // Wetting saturation
            sample("saturation", self.model.wetting_saturation()),
            // Pressure at the inlet minus that at the outlet
            sample("pressure_difference_Pa", pressure),
            match depth {
                // Flow into the inlet, in m³/s with `geometry.depth`
                Some(depth) => sample("inflow_m3_per_s", depth * inflow),
                None => sample("inflow_m2_per_s", inflow),
            },
            // Viscosity of the invading phase times the flow per depth into the inlet, over the length of that side and the tension
            sample("capillary_number", self.model.capillary_number()),
            // Length of the menisci
            sample("interface_length_m", self.model.dynamic.interface_length()),
            // Mean width of fingers on lines across the flow
            sample("finger_width_m", fingers.width),
            // Mean number of fingers on lines across the flow
            sample("fingers", fingers.count),
            sample(
                // Number of pores that the invading phase came to hold
                "invaded_pores",
                summary::invaded_pores(&self.model.quasi_static.config, &self.model.occupation()) as f64,
            ),
            // Number of events of this kind so far
            sample("bursts", self.count(EventKind::Burst)),
            sample("touches", self.count(EventKind::Touch)),
            sample("overlaps", self.count(EventKind::Overlap)),
        ]
    }

    fn measures(&self, series: &Series) -> Vec<Measure> {
        measures::all(&self.model, series)
    }

    fn warnings(&self, _: &Series) -> Vec<String> {
        let mut found = warnings::warnings(&self.model.quasi_static.config);
        if self.is_closed {
            found.push("the injected phase can no longer flow out: the displacement ended there".to_owned());
        }
        found.extend(measures::at_rest(&self.model.dynamic));
        found.extend(measures::films_left(&self.model));
        found
    }

    fn diagrams(&self) -> Vec<Diagram> {
        measures::diagrams(&self.model)
    }

    fn layers(&self) -> Vec<Layer<'_>> {
        if !self.is_whole() {
            return Vec::new();
        }
        vec![layers::regions(&self.model.quasi_static.config, Some(&self.model.occupation()))]
    }

    fn region_map(&self) -> Option<RegionMap> {
        if !self.is_whole() {
            return None;
        }
        let (occupation, menisci) = (self.model.occupation(), self.model.dynamic.menisci());
        let displaced = (&occupation, menisci, self.model.progress());
        Some(pictures::region_map(&self.model.quasi_static.config, Some(displaced)))
    }

    fn playback(&self) -> Option<Playback> {
        self.is_whole().then(|| playback::in_time(&self.model))
    }

    fn results(&self) -> Results<'_> {
        let mut results = results_with(&self.model.quasi_static, Some(self.model.occupation()));
        results.tables.push(Box::new(|| measures::events(&self.model)));
        results
    }

    fn state(&self) -> Vec<u8> {
        // Encoding numbers and lists cannot fail.
        postcard::to_stdvec(&self.model.dynamic.state).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> Result<(), StateError> {
        let state = postcard::from_bytes(state).map_err(|error| StateError(error.to_string()))?;
        self.model.dynamic.restore(state).map_err(StateError)?;
        self.steps_before = self.model.dynamic.state.steps;
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        let parts = ["network: extraction", "network: displacement"].into_iter().zip(self.seconds);
        Statistics {
            unknowns: self.model.quasi_static.config.pores.main_region.len(),
            steps: self.steps() - self.steps_before,
            parts: parts.map(|(part, seconds)| PartTime { part, seconds }).collect(),
            counts: vec![
                ("bursts", self.count(EventKind::Burst)),
                ("touches", self.count(EventKind::Touch)),
                ("overlaps", self.count(EventKind::Overlap)),
                ("network-solves", self.model.dynamic.state.solves as f64),
            ],
        }
    }
}
