//! A displacement as data to play, from event to event.

use super::cycles::{Cycles, Entry};
use super::displacement::{Displacement, Element, Phase, RimCurve, edges as edges_of};
use super::model::{Configuration, Model};
use super::pictures::process_name;
use super::tables::{self, numbers_of_throats};
use meniscus_case::FluidPhase;
use meniscus_core::diagram::Frame;
use meniscus_core::playback::{Change, Edge, Holding, KeptFilm, Passage, Playback, PlayedArea, PlayedFilms, Stage};
use meniscus_core::table::Table;
use meniscus_geometry::curve::Curve;

/// Columns of the tables that are played.
const OF_PORES: &[&str] = &["inscribed_radius_m", "area_m2", "volume_m3"];
const OF_THROATS: &[&str] = &["width_m", "length_m", "conductance_m2", "conductance_m3", "entry_pressure_Pa"];
const OF_EVENTS: &[&str] = &[
    "time_s",
    "event",
    "throat",
    "meniscus_pressure_Pa",
    "capillary_pressure_Pa",
    "pressure_difference_Pa",
    "saturation",
    "film_saturation",
];
const OF_CURVE: &[&str] = &["half_cycle", "capillary_pressure_Pa", "saturation"];

/// The columns of a table of events that are played.
pub(crate) fn events(table: Table) -> Table {
    with(table, OF_EVENTS)
}

fn with(mut table: Table, columns: &[&str]) -> Table {
    table.columns.retain(|column| columns.contains(&column.name));
    table
}

impl Cycles {
    /// The row of the last event, or of the beginning of the half cycle.
    fn row(&self) -> u32 {
        // Events number far fewer than 2^32.
        (self.record.history.len() + self.half_cycle) as u32
    }

    /// Notes what elements hold at the beginning of a half cycle, of which these were just filled.
    pub(super) fn note_beginning(&mut self, filled: &[usize]) {
        let row = self.row();
        // What was trapped before this is known from the state.
        self.displacement.take_lost();
        let mut is_new = vec![false; self.displacement.elements().len()];
        filled.iter().for_each(|&element| is_new[element] = true);
        for (element, is_new) in is_new.into_iter().enumerate() {
            let holding = match self.displacement.phase(element) {
                Phase::Invading if is_new => Holding::Invaded,
                Phase::Invading => Holding::Before,
                Phase::Defending if self.displacement.is_trapped(element) => Holding::Trapped,
                Phase::Defending => continue,
            };
            self.record.changes.push(Change { row, area: element as u32, holding });
        }
    }

    /// Notes the elements that the last event filled, and those trapped since.
    pub(super) fn note_changes(&mut self, filled: &[usize]) {
        let row = self.row();
        let lost = self.displacement.take_lost();
        let change = |holding| move |&element: &usize| Change { row, area: element as u32, holding };
        self.record.changes.extend(filled.iter().map(change(Holding::Invaded)));
        self.record.changes.extend(lost.iter().map(change(Holding::Trapped)));
        self.note_films();
    }

    /// Notes the thickness of films after the last event.
    pub(super) fn note_films(&mut self) {
        let row = self.row();
        let Some(films) = &mut self.films else { return };
        self.record.film_curvatures.resize(row as usize + 1, f64::NAN);
        self.record.film_curvatures[row as usize] = films.curvature;
        let kept = |(area, part, curvature)| KeptFilm { row, area: area as u32, part: part as u32, curvature };
        self.record.kept_films.extend(films.log.drain(..).map(kept));
    }

    /// The films along the edges of areas.
    fn played_films(&self) -> Option<PlayedFilms> {
        let films = self.films.as_ref()?;
        let record = &self.record;
        let mut played = PlayedFilms {
            curvatures: record.film_curvatures.clone(),
            kept: record.kept_films.clone(),
            ..PlayedFilms::default()
        };
        for element in 0..self.displacement.elements().len() {
            let [largest, head] = films.limits(element);
            played.largest.push(largest);
            played.heads.push(head);
            for (curve, wall) in rim(&self.displacement, element) {
                let along = |(piece, shape)| films.along(&self.displacement, element, piece, shape);
                let (width, part) = wall.map_or((0.0, 0), along);
                // As many as the edges of the curve.
                for _ in edges(&curve, wall.is_some()) {
                    played.widths.push(width);
                    played.parts.push(part);
                }
            }
        }
        Some(played)
    }

    /// Number of events of a half cycle until the first with this applied curvature and saturation of the invading phase; 0 without a curvature.
    fn events_until(&self, half_cycle: usize, (applied, saturation): (f64, f64)) -> usize {
        let invading = self.half_cycles()[half_cycle].invading;
        let mut events = self.history().iter().filter(|entry| entry.half_cycle == half_cycle);
        let is_found = |it: &Entry| it.applied == applied && invading.saturation(it.saturation) == saturation;
        events.position(is_found).map_or(0, |before| before + 1)
    }

    fn stages(&self) -> Vec<Stage> {
        let mut first = 0;
        let mut stages = Vec::new();
        for (index, outcome) in self.record.outcomes.iter().enumerate() {
            let half = &self.half_cycles()[index];
            stages.push(Stage {
                name: process_name(self, index),
                first,
                wetting_invades: half.invading == FluidPhase::Wetting,
                open: half.open_sides(),
                breakthrough: outcome.breakthrough.map(|found| first + self.events_until(index, found)),
            });
            first += outcome.events + 1;
        }
        stages
    }
}

/// A quasi-static displacement.
pub(crate) fn playback(model: &Model, cycles: &Cycles) -> Playback {
    let tension = model.config.tension.filter(|_| cycles.has_films());
    Playback {
        events: events(tables::events(&model.config, cycles)),
        curve: tension.map(|tension| with(tables::capillary_pressure(cycles, tension), OF_CURVE)),
        stages: cycles.stages(),
        changes: cycles.record.changes.clone(),
        films: cycles.played_films(),
        ..drawing(model, &cycles.displacement)
    }
}

/// The static part.
pub(crate) fn drawing(model: &Model, displacement: &Displacement) -> Playback {
    let config = &model.config;
    let number_of = numbers_of_throats(config);
    let elements = displacement.elements().iter().enumerate();
    let area = |(index, element): (usize, &Element)| PlayedArea {
        boundary: rim(displacement, index).iter().flat_map(|(curve, wall)| edges(curve, wall.is_some())).collect(),
        area: element.area,
        pore: config.pores.pore_of[element.region],
    };
    let passages = displacement.joints().into_iter().map(|joint| Passage {
        areas: joint.elements,
        ends: joint.ends.map(Into::into),
        throat: joint.throat.and_then(|throat| number_of[throat]),
    });
    Playback {
        frame: frame(config),
        areas: elements.map(area).collect(),
        passages: passages.collect(),
        pores: with(tables::pores(config, None), OF_PORES),
        throats: with(tables::throats(model, None), OF_THROATS),
        events: Table { name: "events", columns: Vec::new() },
        curve: None,
        stages: Vec::new(),
        changes: Vec::new(),
        films: None,
        depth: config.network.depth,
    }
}

fn frame(config: &Configuration) -> Frame {
    Frame {
        bounds: [config.bounds.min.into(), config.bounds.max.into()],
        open: config.sides.map(super::pictures::through),
        periodic: config.periodic,
    }
}

/// The boundary of an element: its curves, or where these do not close its outline without walls.
fn rim(displacement: &Displacement, index: usize) -> Vec<RimCurve> {
    displacement.rim(index).unwrap_or_else(|| {
        let outline = displacement.outline(index);
        edges_of(&outline).map(|(a, b)| (Curve::Segment { a, b }, None)).collect()
    })
}

/// A curve as edges of at most half a turn.
fn edges(curve: &Curve, is_wall: bool) -> Vec<Edge> {
    let sweep = match curve {
        Curve::Segment { .. } => 0.0,
        Curve::Arc { sweep, .. } => *sweep,
    };
    let parts = (sweep.abs() / std::f64::consts::PI).ceil().max(1.0);
    let edge = |k: usize| Edge { start: curve.point(k as f64 / parts).into(), sweep: sweep / parts, is_wall };
    (0..parts as usize).map(edge).collect()
}
