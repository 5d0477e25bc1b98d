//! A dynamic displacement as the simulation loop sees it. Its clock is the time in s; one step ends at an event or at a record.

use std::time::Instant;

use super::measures;
use super::{Drive, Dynamic, StepEnd};
use crate::diagram::Diagram;
use crate::math::Vec2;
use crate::network::cycles::FluidPhase;
use crate::network::displacement::EventKind;
use crate::network::laplacian::FlowError;
use crate::network::occupation::Occupation;
use crate::network::solver::NetworkSolver;
use crate::network::{layers, summary, warnings};
use crate::snapshot::{Cloud, Layer, Lines, Snapshot};
use crate::solver::{
    Measure, PartTime, Results, Sample, Series, Solver, SolverError, StateError, Statistics, StepInfo,
};

/// Where a displacement in time ends before its last record.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct End {
    /// When the invading phase reaches the outlet.
    pub at_breakthrough: bool,
    /// When the invading phase fills this share of the pore space.
    pub at_saturation: Option<f64>,
    /// When so many pore volumes have passed the inlet.
    pub at_injected: Option<f64>,
}

/// A network with a displacement in time.
pub(crate) struct DynamicSolver {
    /// The network, with nothing displaced.
    pub(crate) still: NetworkSolver,
    /// The displacement.
    pub(crate) dynamic: Dynamic,
    /// The phase that comes in.
    pub(crate) invading: FluidPhase,
    end: End,
    is_closed: bool,
    steps_before: u64,
    seconds: f64,
}

impl DynamicSolver {
    /// The displacement at its beginning.
    pub(crate) fn new(still: NetworkSolver, dynamic: Dynamic, invading: FluidPhase, end: End) -> Self {
        Self { still, dynamic, invading, end, is_closed: false, steps_before: 0, seconds: 0.0 }
    }

    /// Pore volumes of the invading phase that have passed the inlet.
    pub(crate) fn injected(&self) -> f64 {
        self.dynamic.state.passed[0] / self.dynamic.pore_area
    }

    /// Share of the pore space that the invading phase holds.
    pub(crate) fn saturation(&self) -> f64 {
        self.dynamic.invading_area() / self.dynamic.pore_area
    }

    /// μ U/σ with the viscosity of the invading phase and the flow into the inlet over the length of its side.
    pub(crate) fn capillary_number(&self) -> f64 {
        let (_, inflow) = self.dynamic.drive_now();
        let terms = self.dynamic.terms();
        terms.viscosity[0] * inflow / (self.side() * terms.tension)
    }

    /// Length of the side of the inlet in m.
    pub(crate) fn side(&self) -> f64 {
        let setting = self.still.setting();
        setting.inlet.map_or(f64::NAN, |inlet| setting.bounds.size()[1 - inlet / 2])
    }

    fn occupation(&self) -> Occupation<'_> {
        let elements = self.dynamic.displacement().elements();
        let name = match self.invading {
            FluidPhase::NonWetting => "drainage",
            FluidPhase::Wetting => "imbibition",
        };
        Occupation {
            elements,
            invading: self.invading,
            share: (0..elements.len()).map(|element| self.dynamic.share(element)).collect(),
            trapped: self.dynamic.trapped(),
            invasions: self.dynamic.invasions(),
            passed: self.dynamic.history().iter().map(|event| event.throat).collect(),
            menisci: self.dynamic.menisci(),
            note: format!(
                "{name} at t = {:.3e} s: {:.3} pore volumes injected, Ca {:.1e}",
                self.dynamic.time(),
                self.injected(),
                self.capillary_number()
            ),
        }
    }

    fn count(&self, kind: EventKind) -> f64 {
        self.dynamic.history().iter().filter(|event| event.kind == kind).count() as f64
    }

    fn failed(&self, error: FlowError) -> SolverError {
        SolverError::BlowUp {
            what: error.to_string(),
            time: self.dynamic.time(),
            step: self.dynamic.state.steps,
            place: Vec2::zeros(),
        }
    }
}

impl Solver for DynamicSolver {
    fn time(&self) -> f64 {
        self.dynamic.time()
    }

    fn is_done(&self) -> bool {
        let has_broken_through = self.end.at_breakthrough && self.dynamic.breakthrough().is_some();
        self.is_closed
            || has_broken_through
            || self.end.at_saturation.is_some_and(|end| self.saturation() >= end)
            || self.end.at_injected.is_some_and(|end| self.injected() >= end)
    }

    fn steps(&self) -> u64 {
        self.dynamic.state.steps
    }

    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        let (clock, before) = (Instant::now(), self.dynamic.time());
        // No further than what is to be injected.
        let left = self.end.at_injected.map_or(f64::INFINITY, |end| end - self.injected());
        let until = match self.dynamic.terms().drive {
            Drive::Rate(rate) if left.is_finite() => until.min(before + left * self.dynamic.pore_area / rate),
            _ => until,
        };
        let ended = self.dynamic.advance(until).map_err(|error| self.failed(error));
        self.seconds += clock.elapsed().as_secs_f64();
        let ended = ended?;
        self.is_closed = ended == StepEnd::Closed;
        let limit = match ended {
            StepEnd::Event => "event",
            StepEnd::Time => "record",
            StepEnd::Closed => "end",
        };
        Ok(StepInfo { dt: self.dynamic.time() - before, limit })
    }

    fn snapshot(&self) -> Snapshot<'_> {
        Snapshot {
            time: self.time(),
            step: self.steps(),
            particles: Cloud::default(),
            grid: None,
            interface: Some(layers::menisci(self.dynamic.menisci())),
        }
    }

    fn outline(&self) -> Lines<'_> {
        self.still.outline()
    }

    fn sample(&self) -> Vec<Sample> {
        let sample = |name, value| Sample { name, value };
        let saturation = self.saturation();
        let wetting = if self.invading == FluidPhase::Wetting { saturation } else { 1.0 - saturation };
        let (pressure, inflow) = self.dynamic.drive_now();
        let fingers = self.dynamic.fingers(self.still.setting());
        vec![
            sample("time_s", self.time()),
            sample("step", self.steps() as f64),
            sample("injected_pore_volumes", self.injected()),
            sample("saturation", wetting),
            sample("pressure_difference_Pa", pressure),
            sample("inflow_m2_per_s", inflow),
            sample("capillary_number", self.capillary_number()),
            sample("interface_length_m", self.dynamic.interface_length()),
            sample("finger_width_m", fingers.width),
            sample("fingers", fingers.count),
            sample("invaded_pores", summary::invaded_pores(self.still.setting(), &self.occupation()) as f64),
            sample("bursts", self.count(EventKind::Burst)),
            sample("touches", self.count(EventKind::Touch)),
            sample("overlaps", self.count(EventKind::Overlap)),
        ]
    }

    fn measures(&self, series: &Series) -> Vec<Measure> {
        measures::all(self, series)
    }

    fn warnings(&self, _: &Series) -> Vec<String> {
        let mut found = warnings::warnings(self.still.setting());
        if self.is_closed {
            found.push("the injected phase has no way out any more: the displacement ended there".to_owned());
        }
        found
    }

    fn diagrams(&self) -> Vec<Diagram> {
        measures::diagrams(self)
    }

    fn layers(&self) -> Vec<Layer<'_>> {
        vec![layers::regions(self.still.setting(), Some(&self.occupation()))]
    }

    fn results(&self) -> Results<'_> {
        let mut results = self.still.results_with(Some(&self.occupation()));
        results.tables.push(measures::events(self));
        results
    }

    fn state(&self) -> Vec<u8> {
        // Numbers and lists of them can always be encoded.
        postcard::to_stdvec(&self.dynamic.state).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> Result<(), StateError> {
        let state = postcard::from_bytes(state).map_err(|error| StateError(error.to_string()))?;
        self.dynamic.restore(state).map_err(StateError)?;
        self.steps_before = self.dynamic.state.steps;
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        Statistics {
            unknowns: self.still.setting().pores.main_region.len(),
            steps: self.steps() - self.steps_before,
            parts: vec![
                PartTime { part: "network: extraction", seconds: self.still.extraction_time() },
                PartTime { part: "network: displacement", seconds: self.seconds },
            ],
            counts: vec![
                ("bursts", self.count(EventKind::Burst)),
                ("touches", self.count(EventKind::Touch)),
                ("overlaps", self.count(EventKind::Overlap)),
                ("network-solves", self.dynamic.state.solves as f64),
            ],
        }
    }
}
