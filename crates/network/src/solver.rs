//! The [`Solver`] of a quasi-static displacement. Its clock counts the displaced pore volumes of all half cycles in place of time.
//!
//! One step performs one event at the clock reading before it and then advances the clock to the volume displaced after it. So a record
//! between two events shows the state after the first of them.

use std::sync::Arc;
use std::time::Instant;

use super::cycles::Cycles;
use super::displacement::EventKind;
use super::measures::Costly;
use super::model::{Configuration, Model};
use super::occupation::Occupation;
use super::{flow, layers, measures, openpnm, pictures, playback, state, summary, tables, warnings};
use meniscus_core::diagram::{Diagram, RegionMap};
use meniscus_core::playback::Playback;
use meniscus_core::snapshot::{Cloud, Layer, Lines, Snapshot};
use meniscus_core::solver::{
    Clock, Made, Measure, PartTime, Results, Sample, Series, Solver, SolverError, StateError, Statistics, StepInfo,
};
use meniscus_core::table::Table;

/// A network with its displacement.
#[derive(Debug, Clone)]
pub struct NetworkSolver {
    pub(super) model: Model,
    clock: f64,
    steps_before: u64,
    /// Wall times of extraction and displacement in s.
    pub(super) seconds: [f64; 2],
}

/// Label of the clock.
const DISPLACED: Clock = Clock { name: "displaced pore volumes", symbol: "V", unit: "pore volumes" };

impl NetworkSolver {
    /// A network in its initial state.
    pub(crate) fn new(config: Configuration, cycles: Option<Cycles>) -> Self {
        Self { model: Model::new(config, cycles), clock: 0.0, steps_before: 0, seconds: [0.0; 2] }
    }

    /// The same with the wall time of its extraction in s.
    pub(crate) fn timed(mut self, extraction: f64) -> Self {
        self.seconds[0] = extraction;
        self
    }

    /// The static configuration.
    pub fn config(&self) -> &Configuration {
        &self.model.config
    }

    /// The displacement; `None` if the network is only extracted.
    pub fn cycles(&self) -> Option<&Cycles> {
        self.model.cycles.as_ref()
    }

    /// The displacement, if all is found of it.
    fn whole(&self) -> Option<&Cycles> {
        self.cycles().filter(|_| self.config().is_whole())
    }

    fn count(&self, kind: EventKind) -> f64 {
        let history = self.cycles().map_or(&[][..], Cycles::history);
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
        self.cycles().is_none_or(|cycles| cycles.is_done)
    }

    fn steps(&self) -> u64 {
        self.cycles().map_or(0, |cycles| cycles.steps)
    }

    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        let (clock, before) = (Instant::now(), self.clock);
        let Some(cycles) = &mut self.model.cycles else { return Ok(StepInfo { dt: 0.0, limit: "end" }) };
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
            interface: self.whole().map(|cycles| layers::menisci(cycles.menisci())),
        }
    }

    fn outline(&self) -> Lines<'_> {
        outline(self.config())
    }

    fn sample(&self) -> Vec<Sample> {
        let sample = |name, value| Sample { name, value };
        let mut row = vec![
            // Displaced share of the pore space, summed over half cycles
            sample("displaced_pore_volumes", self.clock),
            // Number of events and starts of half cycles
            sample("step", self.steps() as f64),
        ];
        if let Some(cycles) = &self.model.cycles {
            let pressure = |applied| self.model.config.pressure(cycles.half_cycle().invading, applied);
            let invaded = summary::invaded_pores(&self.model.config, &cycles.occupation_without_films());
            row.extend([
                // With a displacement, as all that follow: number of the half cycle, from 1
                sample("half_cycle", (cycles.half_cycle_index() + 1) as f64),
                // Wetting saturation
                sample("saturation", cycles.saturation()),
                // Applied capillary pressure
                sample("capillary_pressure_Pa", cycles.applied().map_or(f64::NAN, pressure)),
                // Share of the pore space whose displaced phase has no path to the outlet
                sample("trapped_saturation", cycles.trapped_saturation()),
                // Number of pores that the invading phase came to hold in this half cycle
                sample("invaded_pores", invaded as f64),
                // Number of events of this kind so far
                sample("bursts", self.count(EventKind::Burst)),
                sample("touches", self.count(EventKind::Touch)),
                sample("overlaps", self.count(EventKind::Overlap)),
            ]);
            if cycles.has_films() {
                // With `films`: number of snap-offs so far
                row.push(sample("snap_offs", self.count(EventKind::SnapOff)));
                // With `films`: the part of the saturation in films
                row.push(sample("film_saturation", cycles.film_saturation()));
            }
        }
        row
    }

    fn measures(&self, _series: &Series) -> Vec<Measure> {
        measures::all(&self.model, Costly::of(self.config()))
    }

    fn warnings(&self, _: &Series) -> Vec<String> {
        warnings::warnings(&self.model.config)
    }

    fn diagrams(&self) -> Vec<Diagram> {
        pictures::diagrams(&self.model)
    }

    fn layers(&self) -> Vec<Layer<'_>> {
        if !self.config().is_whole() {
            return Vec::new();
        }
        vec![layers::regions(&self.model.config, self.cycles().map(Cycles::occupation).as_ref())]
    }

    fn region_map(&self) -> Option<RegionMap> {
        if !self.config().is_whole() {
            return None;
        }
        let (config, cycles) = (self.config(), self.cycles());
        let occupation = cycles.map(Cycles::occupation);
        let displaced = cycles.zip(occupation.as_ref());
        let displaced = displaced.map(|(it, occupation)| (occupation, it.all_menisci(config), it.progress(config)));
        Some(pictures::region_map(config, displaced))
    }

    fn playback(&self) -> Option<Playback> {
        self.whole().map(|cycles| playback::playback(&self.model, cycles))
    }

    fn results(&self) -> Results<'_> {
        let (config, cycles) = (self.config(), self.cycles());
        let mut results = results_with(&self.model, cycles.map(Cycles::occupation));
        if let Some(cycles) = cycles {
            results.tables.push(Box::new(|| tables::events(config, cycles)));
            let with_films = config.tension.filter(|_| cycles.has_films());
            results.tables.extend(
                with_films.map(|tension| -> Made<'_, Table> {
                    Box::new(move || tables::capillary_pressure(cycles, tension))
                }),
            );
        }
        if !config.is_whole() {
            return results;
        }
        // Before the others are made, since it takes as much memory as all of them.
        results
            .tables
            .extend(flow::table(&self.model).map(|table| -> Made<'_, Table> { Box::new(move || table.clone()) }));
        results.documents.extend(state::documents(&self.model));
        results
    }

    fn state(&self) -> Vec<u8> {
        // On restart the same events are repeated in the same order. Encoding two numbers cannot fail.
        postcard::to_stdvec(&(self.clock, self.steps())).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> Result<(), StateError> {
        let (clock, steps) = postcard::from_bytes(state).map_err(|error| StateError(error.to_string()))?;
        let Configuration { network, pores, .. } = self.config();
        self.model.cycles = self.cycles().and_then(|cycles| cycles.restarted(network, pores));
        if let Some(cycles) = &mut self.model.cycles {
            while cycles.steps < steps {
                if cycles.advance().is_none() && cycles.steps < steps {
                    let found = cycles.steps;
                    return Err(StateError(format!("it is the result of {steps} steps, and there are {found}")));
                }
            }
        }
        (self.clock, self.steps_before) = (clock, steps);
        Ok(())
    }

    fn steps_to(&self, _end: f64) -> Option<f64> {
        // Upper bound: each event of a half cycle fills one element, or closes or opens a throat.
        Some(self.cycles().map_or(0.0, |cycles| {
            let throats = if cycles.has_films() { self.model.config.network.throats.len() } else { 0 };
            let events = (cycles.displacement.elements().len() + throats) * cycles.half_cycles().len();
            (events as f64 - cycles.steps as f64).max(0.0)
        }))
    }

    fn statistics(&self) -> Statistics {
        let counts = [("bursts", EventKind::Burst), ("touches", EventKind::Touch), ("overlaps", EventKind::Overlap)];
        let parts = ["network: extraction", "network: displacement"].into_iter().zip(self.seconds);
        Statistics {
            unknowns: self.model.config.pores.main_region.len(),
            steps: self.steps() - self.steps_before,
            parts: parts.map(|(part, seconds)| PartTime { part, seconds }).collect(),
            counts: counts.into_iter().map(|(name, kind)| (name, self.count(kind))).collect(),
        }
    }
}

/// The walls for files; none where only the curve is wanted.
pub(super) fn outline(config: &Configuration) -> Lines<'_> {
    if config.is_whole() { config.outline.as_ref().clone() } else { Lines::default() }
}

/// The results at the end, without events.
pub(super) fn results_with<'a>(model: &'a Model, occupation: Option<Occupation<'a>>) -> Results<'a> {
    if !model.config.is_whole() {
        return Results { documents: vec![summary::network_json(model)], ..Results::default() };
    }
    let occupation = occupation.map(Arc::new);
    let (of_pores, of_throats, of_layer) = (occupation.clone(), occupation.clone(), occupation);
    Results {
        tables: vec![
            Box::new(move || tables::pores(&model.config, of_pores.as_deref())),
            Box::new(move || tables::throats(model, of_throats.as_deref())),
            Box::new(|| openpnm::table(model)),
        ],
        layers: vec![
            Box::new(move || layers::pores(&model.config, of_layer.as_deref())),
            Box::new(|| layers::throats(model)),
        ],
        documents: vec![summary::network_json(model)],
    }
}
