//! The network as the simulation loop sees it. Its clock is no time: it counts the displaced pore volumes of all half cycles.
//!
//! One step does one event, which takes place when the clock stands at the volume displaced before it; the clock then runs to the
//! volume displaced after it. So a record between two events shows the state after the first of them.

use std::cell::OnceCell;
use std::sync::Arc;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::conductance::conductances;
use super::cycles::Cycles;
use super::displacement::{Conditions, Displacement, EventKind};
use super::graph::{Network, Pores};
use super::occupation::Occupation;
use super::{flow, layers, measures, openpnm, pictures, state, summary, tables, warnings};
use crate::case::Side;
use crate::diagram::Diagram;
use crate::math::{Bounds, Vec2};
use crate::snapshot::{Cloud, Layer, Lines, Snapshot};
use crate::solver::{
    Clock, Measure, PartTime, Results, Sample, Series, Solver, SolverError, StateError, Statistics, StepInfo,
};

/// What stands still: the network and what is known of its walls and fluids.
#[derive(Debug, Clone)]
pub struct Setting {
    /// The network.
    pub network: Arc<Network>,
    /// Its regions joined to pores.
    pub pores: Arc<Pores>,
    /// The domain.
    pub bounds: Bounds,
    /// Whether it is joined along x and y.
    pub periodic: [bool; 2],
    /// The side that is the inlet: left, right, bottom, top are 0 to 3.
    pub inlet: Option<usize>,
    /// The side that is the outlet.
    pub outlet: Option<usize>,
    /// The walls, for pictures.
    pub outline: Lines<'static>,
    /// Pore area over the area of the domain.
    pub porosity: f64,
    /// Interfacial tension in N/m.
    pub tension: Option<f64>,
    /// Viscosities of the wetting and the non-wetting phase in Pa s, where they are given.
    pub viscosities: [Option<f64>; 2],
    /// Conditions of a drainage, for entry pressures.
    pub entry: Option<Conditions>,
    /// The hash of the geometry in hexadecimal digits.
    pub geometry_hash: String,
    /// The left, right, bottom and top side.
    pub sides: [Side; 4],
}

/// A network with all that is needed to observe it.
#[derive(Debug, Clone)]
pub struct NetworkSolver {
    setting: Setting,
    cycles: Option<Cycles>,
    entry_curvatures: OnceCell<Vec<f64>>,
    conductances: OnceCell<Vec<f64>>,
    clock: f64,
    steps_before: u64,
    seconds: [f64; 2],
}

/// All that the future depends on: events are done anew, the same ones in the same order.
#[derive(Serialize, Deserialize)]
struct Saved {
    clock: f64,
    steps: u64,
}

/// What the clock counts.
const DISPLACED: Clock = Clock { name: "displaced pore volumes", symbol: "V", unit: "pore volumes" };

impl NetworkSolver {
    /// A network with nothing displaced yet.
    pub(crate) fn new(setting: Setting, cycles: Option<Cycles>) -> Self {
        Self {
            setting,
            cycles,
            entry_curvatures: OnceCell::new(),
            conductances: OnceCell::new(),
            clock: 0.0,
            steps_before: 0,
            seconds: [0.0; 2],
        }
    }

    /// The same with the time that its extraction took, in s.
    pub(crate) fn timed(mut self, extraction: f64) -> Self {
        self.seconds[0] = extraction;
        self
    }

    /// The time that its extraction took, in s.
    pub(crate) fn extraction_time(&self) -> f64 {
        self.seconds[0]
    }

    /// What stands still.
    pub fn setting(&self) -> &Setting {
        &self.setting
    }

    /// The displacement; none where the network is extracted only.
    pub fn cycles(&self) -> Option<&Cycles> {
        self.cycles.as_ref()
    }

    /// Curvatures at which drainage enters the throats of the network, in 1/m; none where no angle is known.
    pub(crate) fn entry_curvatures(&self) -> Option<&[f64]> {
        let Setting { network, pores, entry, .. } = &self.setting;
        let conditions = entry.as_ref()?;
        let throats = network.throats.len();
        let find = || {
            let known = self.cycles.as_ref().map(Cycles::displacement).filter(|it| it.events() == conditions.events);
            let new = || Displacement::new(network, pores, conditions.clone()).entry_curvatures(conditions, throats);
            known.map_or_else(new, |displacement| displacement.entry_curvatures(conditions, throats))
        };
        Some(self.entry_curvatures.get_or_init(find))
    }

    /// Number of throats of the network whose measured entry pressure takes the place of that of the formula under some conditions.
    pub(crate) fn measured_throats(&self, conditions: &Conditions) -> usize {
        let Setting { network, pores, .. } = &self.setting;
        let (throats, formula) = (network.throats.len(), Conditions { measured: Vec::new(), ..conditions.clone() });
        let displacement = Displacement::new(network, pores, formula.clone());
        let [with, without] = [conditions, &formula].map(|given| displacement.entry_curvatures(given, throats));
        with.iter().zip(&without).filter(|(with, without)| with.is_finite() && with != without).count()
    }

    /// The conductances of all throats of the network.
    pub(crate) fn conductances(&self) -> &[f64] {
        self.conductances.get_or_init(|| conductances(&self.setting.network))
    }

    /// What is left at the end but for events.
    pub(super) fn results_with(&self, occupation: Option<&Occupation>) -> Results<'_> {
        let mut results = Results {
            tables: tables::all(self, occupation),
            layers: layers::pores_and_throats(self, occupation),
            documents: vec![summary::network_json(self)],
            mosaics: pictures::mosaics(&self.setting, occupation),
        };
        results.tables.push(openpnm::table(self));
        results
    }

    fn count(&self, kind: EventKind) -> f64 {
        let history = self.cycles.as_ref().map_or(&[][..], Cycles::history);
        history.iter().filter(|entry| entry.kind == kind).count() as f64
    }
}

impl Solver for NetworkSolver {
    fn time(&self) -> f64 {
        self.clock
    }

    fn clock(&self) -> Clock {
        DISPLACED
    }

    fn is_done(&self) -> bool {
        self.cycles.as_ref().is_none_or(Cycles::is_done)
    }

    fn steps(&self) -> u64 {
        self.cycles.as_ref().map_or(0, Cycles::steps)
    }

    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        let (clock, before) = (Instant::now(), self.clock);
        let Some(cycles) = &mut self.cycles else { return Ok(StepInfo { dt: 0.0, limit: "end" }) };
        let limit = if before < cycles.displaced() { "record" } else { cycles.advance().unwrap_or("end") };
        self.clock = cycles.displaced().min(until).max(before);
        self.seconds[1] += clock.elapsed().as_secs_f64();
        Ok(StepInfo { dt: self.clock - before, limit })
    }

    fn snapshot(&self) -> Snapshot<'_> {
        Snapshot {
            time: self.clock,
            step: self.steps(),
            particles: Cloud::default(),
            grid: None,
            interface: self.cycles.as_ref().map(|cycles| layers::menisci(cycles.menisci())),
        }
    }

    fn outline(&self) -> Lines<'_> {
        self.setting.outline.clone()
    }

    fn sample(&self) -> Vec<Sample> {
        let sample = |name, value| Sample { name, value };
        let mut row = vec![sample("displaced_pore_volumes", self.clock), sample("step", self.steps() as f64)];
        if let Some(cycles) = &self.cycles {
            let tension = self.setting.tension.unwrap_or(f64::NAN);
            let invaded = summary::invaded_pores(&self.setting, &cycles.occupation());
            row.extend([
                sample("half_cycle", (cycles.half_cycle_index() + 1) as f64),
                sample("saturation", cycles.saturation()),
                sample("capillary_pressure_Pa", cycles.applied().map_or(f64::NAN, |applied| tension * applied)),
                sample("trapped_saturation", cycles.trapped_saturation()),
                sample("invaded_pores", invaded as f64),
                sample("bursts", self.count(EventKind::Burst)),
                sample("touches", self.count(EventKind::Touch)),
                sample("overlaps", self.count(EventKind::Overlap)),
            ]);
        }
        row
    }

    fn measures(&self, _series: &Series) -> Vec<Measure> {
        measures::all(self)
    }

    fn warnings(&self, _: &Series) -> Vec<String> {
        warnings::warnings(&self.setting)
    }

    fn diagrams(&self) -> Vec<Diagram> {
        pictures::diagrams(self)
    }

    fn layers(&self) -> Vec<Layer<'_>> {
        vec![layers::regions(&self.setting, self.cycles.as_ref().map(Cycles::occupation).as_ref())]
    }

    fn results(&self) -> Results<'_> {
        let occupation = self.cycles.as_ref().map(Cycles::occupation);
        let mut results = self.results_with(occupation.as_ref());
        results.tables.extend(self.cycles.as_ref().map(|cycles| tables::events(&self.setting, cycles)));
        results.documents.extend(state::documents(self));
        results.tables.extend(flow::table(self));
        results
    }

    fn state(&self) -> Vec<u8> {
        let saved = Saved { clock: self.clock, steps: self.steps() };
        // Two numbers can always be encoded.
        postcard::to_stdvec(&saved).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> Result<(), StateError> {
        let saved: Saved = postcard::from_bytes(state).map_err(|error| StateError(error.to_string()))?;
        self.cycles = self.cycles.as_ref().and_then(Cycles::restarted);
        if let Some(cycles) = &mut self.cycles {
            while cycles.steps() < saved.steps {
                if cycles.advance().is_none() && cycles.steps() < saved.steps {
                    return Err(StateError(format!(
                        "it is the result of {} steps, and there are {}",
                        saved.steps,
                        cycles.steps()
                    )));
                }
            }
        }
        self.steps_before = saved.steps;
        self.clock = saved.clock;
        Ok(())
    }

    fn steps_to(&self, _end: f64) -> Option<f64> {
        // At most, each event of a half cycle fills one element.
        let elements = |cycles: &Cycles| cycles.displacement().elements().len() * cycles.half_cycles().len();
        Some(self.cycles.as_ref().map_or(0.0, |cycles| (elements(cycles) as f64 - cycles.steps() as f64).max(0.0)))
    }

    fn statistics(&self) -> Statistics {
        let counts = [("bursts", EventKind::Burst), ("touches", EventKind::Touch), ("overlaps", EventKind::Overlap)];
        let parts = ["network: extraction", "network: displacement"].into_iter().zip(self.seconds);
        Statistics {
            unknowns: self.setting.pores.main_region.len(),
            steps: self.steps() - self.steps_before,
            parts: parts.map(|(part, seconds)| PartTime { part, seconds }).collect(),
            counts: counts.into_iter().map(|(name, kind)| (name, self.count(kind))).collect(),
        }
    }
}

/// The vector `from` to `to`, the shorter way round where the domain is periodic.
pub(super) fn nearest(setting: &Setting, from: Vec2, to: Vec2) -> Vec2 {
    let (mut way, size) = (to - from, setting.bounds.size());
    for axis in (0..2).filter(|&axis| setting.periodic[axis]) {
        way[axis] -= size[axis] * (way[axis] / size[axis]).round();
    }
    way
}
