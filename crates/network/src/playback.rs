//! A displacement as data to play, from event to event.

use super::cycles::Cycles;
use super::displacement::{Displacement, Element, Phase};
use super::dynamic::measures;
use super::dynamic::model::DynamicModel;
use super::model::{Configuration, Model};
use super::pictures::process_name;
use super::tables::{self, numbers_of_throats};
use meniscus_case::FluidPhase;
use meniscus_core::diagram::Frame;
use meniscus_core::playback::{Change, Edge, Holding, Passage, PlayedArea, Playback, Stage};
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
            });
            first += outcome.events + 1;
        }
        stages
    }
}

/// A quasi-static displacement.
pub(crate) fn playback(model: &Model, cycles: &Cycles) -> Playback {
    Playback {
        events: with(tables::events(&model.config, cycles), OF_EVENTS),
        curve: tables::capillary_pressure(&model.config, cycles).map(|curve| with(curve, OF_CURVE)),
        stages: cycles.stages(),
        changes: cycles.record.changes.clone(),
        ..drawing(model, &cycles.displacement)
    }
}

/// A displacement in time: an element counts as filled from the event on by which the invading phase entered it.
pub(crate) fn in_time(model: &DynamicModel) -> Playback {
    let (dynamic, config) = (&model.dynamic, &model.quasi_static.config);
    let wetting_invades = model.invading == FluidPhase::Wetting;
    let open = config.sides.map(super::pictures::through);
    Playback {
        events: with(measures::events(model), OF_EVENTS),
        stages: vec![Stage { name: model.invading.process().to_owned(), first: 0, wetting_invades, open }],
        changes: dynamic.changes(),
        ..drawing(&model.quasi_static, dynamic.displacement())
    }
}

/// The static part.
fn drawing(model: &Model, displacement: &Displacement) -> Playback {
    let config = &model.config;
    let number_of = numbers_of_throats(config);
    let elements = displacement.elements().iter().enumerate();
    let area = |(index, element): (usize, &Element)| PlayedArea {
        boundary: boundary(displacement, index, element),
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

/// The boundary of an element: its curves, or where these do not close its outline.
fn boundary(displacement: &Displacement, index: usize, element: &Element) -> Vec<Edge> {
    let Some(rim) = displacement.rim(index) else {
        let edge = |point: &meniscus_core::math::Vec2| Edge { start: (*point).into(), sweep: 0.0, is_wall: false };
        return element.outline.iter().map(edge).collect();
    };
    rim.iter().flat_map(|(curve, is_wall)| edges(curve, *is_wall)).collect()
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
