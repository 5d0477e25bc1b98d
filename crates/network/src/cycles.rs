//! Half cycles of drainage and imbibition: the invading phase, the end of each, and the history of events.
//!
//! In the first half cycle the invading phase enters a pore space full of the other one. Each further half cycle starts from the final
//! state of the previous one, with phases, inlet and outlet exchanged.

use std::sync::Arc;

use super::displacement::{Beginning, Displacement, Division, EventKind, Phase};
use super::films::{CurvePoint, Films};
use super::graph::{Network, Pores};
pub(crate) use super::half_cycle::HalfCycle;
use super::moment::Moment;
use super::region::Counted;
pub use meniscus_case::FluidPhase;
use meniscus_case::network::FilmModel;
use meniscus_core::playback::{Change, KeptFilm};

/// An event.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// Index of its half cycle.
    pub half_cycle: usize,
    /// Its type.
    pub kind: EventKind,
    /// Index in the network of the throat that was passed.
    pub throat: Option<usize>,
    /// Curvature of the meniscus towards the wetting phase in 1/m.
    pub curvature: f64,
    /// Applied curvature towards the wetting phase in 1/m: the capillary pressure p_n - p_w over the tension.
    pub applied: f64,
    /// Saturation of the wetting phase afterwards.
    pub saturation: f64,
    /// Corner films afterwards as a fraction of the pore space, part of the saturation.
    pub film_saturation: f64,
}

/// The filling of an element in the present half cycle.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Invasion {
    /// Number of the event within its half cycle, from 1; 0 for elements filled initially through openings of the inlet.
    pub sequence: usize,
    /// Applied curvature towards the wetting phase in 1/m; NaN initially.
    pub applied: f64,
    /// Fraction of the pore space displaced in this half cycle, including this event.
    pub displaced: f64,
}

/// Summary of a half cycle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Number of its events.
    pub(crate) events: usize,
    /// At breakthrough: applied curvature in 1/m and saturation of the invading phase.
    pub breakthrough: Option<(f64, f64)>,
    /// Initial saturation of the wetting phase, before and after elements open at the inlet are filled.
    pub(crate) first_saturation: [f64; 2],
    /// Films after that, as a fraction of the pore space.
    pub(crate) first_film_saturation: f64,
    /// Final applied curvature in the plane in 1/m, after all events, if films follow it.
    pub(crate) last: Option<f64>,
}

/// What has happened in the half cycles so far.
#[derive(Debug, Clone, Default)]
pub struct Record {
    /// All events.
    pub(crate) history: Vec<Entry>,
    /// The filling of each element in the present half cycle.
    pub(crate) invasions: Vec<Option<Invasion>>,
    /// Summaries of the half cycles that have started.
    pub outcomes: Vec<Outcome>,
    /// The curve of capillary pressure over saturation, with films that follow the pressure.
    pub(crate) curve: Vec<CurvePoint>,
    /// The moment after first breakthrough.
    breakthrough: Option<Arc<Moment>>,
    /// What elements came to hold.
    pub(super) changes: Vec<Change>,
    /// Of the corner films, (p_n - p_w)/σ in 1/m by row and those that keep another one.
    pub(super) film_curvatures: Vec<f64>,
    pub(super) kept_films: Vec<KeptFilm>,
}

/// A displacement in half cycles.
#[derive(Debug, Clone)]
pub struct Cycles {
    half_cycles: Vec<HalfCycle>,
    initial: Option<Arc<Beginning>>,
    pore_area: f64,
    /// The areas to which saturations refer.
    pub(crate) counted: Arc<Counted>,
    /// The displacement of the present half cycle.
    pub displacement: Displacement,
    pub(super) half_cycle: usize,
    /// Whether the displacement is over.
    pub(crate) is_done: bool,
    /// Number of calls of [`advance`](Self::advance) up to this state.
    pub(crate) steps: u64,
    /// Area of the wetting phase in the whole domain and in the region of saturations.
    wetting_area: f64,
    pub(super) counted_wetting: f64,
    /// Displaced area, now and at the start of the present half cycle.
    displaced_area: f64,
    displaced_before: f64,
    /// The films in corners, and their volume over the depth in m².
    pub(super) films: Option<Films>,
    pub(super) film_area: f64,
    pub record: Record,
}

/// Rounding error of saturations, which are sums of areas.
const ROUNDING: f64 = 1.0e-12;

pub(super) fn tidy(saturation: f64) -> f64 {
    if saturation < ROUNDING {
        0.0
    } else if saturation > 1.0 - ROUNDING {
        1.0
    } else {
        saturation
    }
}

impl Cycles {
    /// The start of the first half cycle, in a pore space full of the defending phase or with the phases of `initial`; `None` without half
    /// cycles. `division`, if given, is that of the network for the events of the half cycles. Saturations refer to the areas of `count`.
    pub(crate) fn new(
        network: &Network,
        pores: &Pores,
        half_cycles: Vec<HalfCycle>,
        initial: Option<Arc<Beginning>>,
        division: Option<&Division>,
        count: impl FnOnce(&Displacement) -> Counted,
    ) -> Option<Self> {
        let first = half_cycles.first()?;
        let conditions = first.conditions.clone();
        let displacement = match (&initial, division) {
            (Some(initial), _) => Displacement::beginning(network, pores, conditions, initial),
            (None, Some(division)) => Displacement::within(division, conditions),
            (None, None) => Displacement::new(network, pores, conditions),
        };
        let area = |element: usize| displacement.elements()[element].area;
        let elements = displacement.elements().len();
        let is_held = |element: usize| initial.as_ref().is_some_and(|initial| initial.invaded[element]);
        let pore_area: f64 = (0..elements).map(area).sum();
        let invading_area: f64 = (0..elements).filter(|&element| is_held(element)).map(area).sum();
        let counted = count(&displacement);
        let of_wetting =
            |invading: f64, all: f64| if first.invading == FluidPhase::Wetting { invading } else { all - invading };
        let wetting_area = of_wetting(invading_area, pore_area);
        let counted_wetting = of_wetting(counted.area_of(is_held), counted.sum);
        let before: Vec<Phase> =
            (0..elements).map(|element| if is_held(element) { Phase::Invading } else { Phase::Defending }).collect();
        let shares = (0..elements).map(|element| counted.share(&displacement, element)).collect();
        let films = first.films.clone().map(|terms| Films::new(&displacement, first.invading, terms, shares));
        let films = films.map(|films| films.begun(first.invading, initial.as_deref()));
        let mut cycles = Self {
            films,
            film_area: 0.0,
            initial,
            displacement,
            pore_area,
            half_cycle: 0,
            is_done: false,
            steps: 0,
            wetting_area,
            counted_wetting,
            counted: Arc::new(counted),
            displaced_area: 0.0,
            displaced_before: 0.0,
            record: Record { invasions: vec![None; elements], ..Record::default() },
            half_cycles,
        };
        cycles.begin(&before);
        Some(cycles)
    }

    /// Accounts for the initial filling of a half cycle; `before` are the phases of the elements without it.
    fn begin(&mut self, before: &[Phase]) {
        let saturation = self.saturation();
        self.displaced_before = self.displaced_area;
        self.record.invasions.iter_mut().for_each(|invasion| *invasion = None);
        let filled: Vec<usize> = (0..before.len())
            .filter(|&element| {
                before[element] == Phase::Defending && self.displacement.phase(element) == Phase::Invading
            })
            .collect();
        self.displace(&filled);
        self.note_beginning(&filled);
        let displaced = (self.displaced_area - self.displaced_before) / self.pore_area;
        for element in filled {
            self.record.invasions[element] = Some(Invasion { sequence: 0, applied: f64::NAN, displaced });
        }
        self.update_all_films();
        self.note_films();
        let first_saturation = [saturation, self.saturation()];
        // Openings have no entry pressure, so there is none to record.
        let breakthrough = self.displacement.reached_outlet().then(|| (f64::NAN, self.invading_saturation()));
        let first_film_saturation = self.film_saturation();
        self.record.outcomes.push(Outcome {
            first_saturation,
            first_film_saturation,
            breakthrough,
            ..Outcome::default()
        });
    }

    /// Saturation of the invading phase.
    fn invading_saturation(&self) -> f64 {
        self.half_cycle().invading.saturation(self.saturation())
    }

    /// Adds the areas of elements that the invading phase filled.
    fn displace(&mut self, elements: &[usize]) {
        let area: f64 = elements.iter().map(|&element| self.displacement.elements()[element].area).sum();
        self.displaced_area += area;
        let sign = if self.half_cycle().invading == FluidPhase::Wetting { 1.0 } else { -1.0 };
        self.wetting_area += sign * area;
        self.counted_wetting += sign * elements.iter().map(|&element| self.counted.areas[element]).sum::<f64>();
    }

    /// The same displacement in its initial state, in its network.
    pub(crate) fn restarted(&self, network: &Network, pores: &Pores) -> Option<Self> {
        let counted = |_: &Displacement| Counted::clone(&self.counted);
        Self::new(network, pores, self.half_cycles.clone(), self.initial.clone(), None, counted)
    }

    /// Trapped saturation at the end of the same displacement with films that are connected in another way.
    pub(crate) fn trapped_with(&self, network: &Network, pores: &Pores, films: FilmModel) -> Option<f64> {
        let half_cycles = self.half_cycles.iter().map(|half| half.with_films(films, network)).collect();
        let counted = |_: &Displacement| Counted::clone(&self.counted);
        let division = self.displacement.division();
        let mut other = Self::new(network, pores, half_cycles, self.initial.clone(), Some(&division), counted)?;
        while other.advance().is_some() {}
        Some(other.trapped_saturation())
    }

    /// How films are connected, if corners can hold any.
    pub(crate) fn film_model(&self) -> Option<FilmModel> {
        let model = self.half_cycles[0].film_model;
        self.half_cycles.iter().any(|half| half.corners.is_some()).then_some(model)
    }

    /// Performs the next event, or starts the next half cycle; `None` if the displacement is over.
    pub fn advance(&mut self) -> Option<&'static str> {
        if self.is_done {
            return None;
        }
        self.steps += 1;
        if self.has_ended_early() {
            return self.turn();
        }
        let Some(event) = self.displacement.next() else {
            self.raise_to_final_pressure();
            return self.turn();
        };
        self.set_film_curvature(event.applied);
        self.displace(&event.elements);
        self.update_films();
        let half = &self.half_cycles[self.half_cycle];
        let (curvature, half_cycle) = (half.invading.towards_wetting(event.curvature), self.half_cycle);
        let (saturation, applied) = (self.saturation(), half.invading.towards_wetting(event.applied));
        let displaced = (self.displaced_area - self.displaced_before) / self.pore_area;
        self.record.outcomes[self.half_cycle].events += 1;
        let sequence = self.record.outcomes[self.half_cycle].events;
        for &element in &event.elements {
            self.record.invasions[element] = Some(Invasion { sequence, applied, displaced });
        }
        if self.record.outcomes[self.half_cycle].breakthrough.is_none() && self.displacement.reached_outlet() {
            self.record.outcomes[self.half_cycle].breakthrough = Some((applied, self.invading_saturation()));
        }
        let film_saturation = self.film_saturation();
        let (kind, throat) = (event.kind, event.throat);
        self.record.history.push(Entry { half_cycle, kind, throat, curvature, applied, saturation, film_saturation });
        if self.record.breakthrough.is_none() && self.displacement.reached_outlet() {
            self.record.breakthrough = Some(Arc::new(self.moment()));
        }
        self.note_changes(&event.elements);
        Some(event.kind.name())
    }

    /// The present moment.
    pub fn moment(&self) -> Moment {
        Moment {
            displacement: self.displacement.clone(),
            half_cycle: self.half_cycle,
            events: self.record.outcomes[self.half_cycle].events,
            applied: self.applied(),
            saturation: tidy(self.wetting_area / self.pore_area),
        }
    }

    /// The moment after first breakthrough.
    pub fn breakthrough(&self) -> Option<&Moment> {
        self.record.breakthrough.as_deref()
    }

    fn has_ended_early(&self) -> bool {
        let HalfCycle { invading, stop, .. } = self.half_cycle();
        let has_broken_through = self.record.outcomes[self.half_cycle].breakthrough.is_some();
        let reaches = |wetting: f64| self.invading_saturation() >= invading.saturation(wetting);
        (stop.breakthrough && has_broken_through) || stop.saturation.is_some_and(reaches)
    }

    fn turn(&mut self) -> Option<&'static str> {
        let Some(next) = self.half_cycles.get(self.half_cycle + 1) else {
            self.is_done = true;
            return None;
        };
        let reversed = |element: usize| match self.displacement.phase(element) {
            Phase::Defending => Phase::Invading,
            Phase::Invading => Phase::Defending,
        };
        let before: Vec<Phase> = (0..self.record.invasions.len()).map(reversed).collect();
        self.half_cycle += 1;
        self.displacement = self.displacement.clone().reverse(next.conditions.clone());
        let terms = next.films.clone();
        self.films = self.films.take().map(|films| films.with_terms(&self.displacement, terms));
        self.begin(&before);
        Some("reversal")
    }

    /// The half cycle in progress, or the last one.
    pub fn half_cycle(&self) -> &HalfCycle {
        &self.half_cycles[self.half_cycle]
    }

    /// Its index.
    pub fn half_cycle_index(&self) -> usize {
        self.half_cycle
    }

    /// All half cycles.
    pub fn half_cycles(&self) -> &[HalfCycle] {
        &self.half_cycles
    }

    /// Displaced pore volumes of all half cycles, a sum of areas over the pore area.
    pub(crate) fn displaced(&self) -> f64 {
        self.displaced_area / self.pore_area
    }

    /// Saturation of the wetting phase, including corner films.
    pub fn saturation(&self) -> f64 {
        tidy((self.counted_wetting + self.film_area) / self.counted.sum)
    }

    /// Saturation of the trapped defending phase.
    pub fn trapped_saturation(&self) -> f64 {
        let trapped = self.counted.area_of(|element| self.displacement.is_trapped(element));
        let films = self.films.as_ref().map_or(0.0, |films| match self.half_cycle().invading {
            FluidPhase::NonWetting => films.kept_area(&self.displacement),
            FluidPhase::Wetting => -films.trapped_area(&self.displacement),
        });
        (trapped + films) / self.counted.sum
    }

    /// Saturation of trapped ganglia that their own head would move; `None` without gravity.
    pub(crate) fn movable_saturation(&self) -> Option<f64> {
        let half = self.half_cycle();
        half.conditions.gravity?;
        let movable = self.displacement.movable(&half.returning);
        Some(self.counted.area_of(|element| movable[element]) / self.counted.sum)
    }

    /// All events so far.
    pub fn history(&self) -> &[Entry] {
        &self.record.history
    }

    /// The applied curvature towards the wetting phase in 1/m; `None` before the first event of a half cycle.
    pub fn applied(&self) -> Option<f64> {
        let last = self.record.outcomes.get(self.half_cycle).and_then(|outcome| outcome.last);
        let event = self.record.history.last().filter(|entry| entry.half_cycle == self.half_cycle);
        last.or(event.map(|entry| entry.applied))
    }
}
