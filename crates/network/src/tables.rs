//! `pores.csv`, `throats.csv` and `events.csv`: SI units, one row per pore, throat or event.

use super::cycles::{Cycles, Entry, FluidPhase, Invasion, Outcome};
use super::films::CurvePoint;
use super::graph::{Opening, Throat};
use super::model::{Configuration, Model};
use super::occupation::Occupation;
use super::summary::{PoreState, pore_states};
use meniscus_core::math::Vec2;
use meniscus_core::table::{Cells, Column, Table};

pub(super) fn numbers(name: &'static str, values: impl IntoIterator<Item = f64>) -> Column {
    Column { name, cells: Cells::Numbers(values.into_iter().collect()) }
}

pub(super) fn counts(name: &'static str, values: impl IntoIterator<Item = usize>) -> Column {
    Column { name, cells: Cells::Counts(values.into_iter().collect()) }
}

pub(super) fn flags(name: &'static str, values: impl IntoIterator<Item = bool>) -> Column {
    Column { name, cells: Cells::Flags(values.into_iter().collect()) }
}

pub(super) fn indices(name: &'static str, values: impl IntoIterator<Item = Option<usize>>) -> Column {
    Column { name, cells: Cells::Indices(values.into_iter().collect()) }
}

pub(super) fn words(name: &'static str, values: impl IntoIterator<Item = &'static str>) -> Column {
    Column { name, cells: Cells::Words(values.into_iter().collect()) }
}

/// The pores of a throat of the network.
pub(super) fn pores_of(config: &Configuration, throat: &Throat) -> [usize; 2] {
    throat.regions.map(|region| config.pores.pore_of[region])
}

/// Center of a pore in m.
pub(super) fn center(config: &Configuration, pore: usize) -> Vec2 {
    config.network.regions[config.pores.main_region[pore]].center
}

/// Inscribed radius of a pore in m.
pub(super) fn radius(config: &Configuration, pore: usize) -> f64 {
    config.network.regions[config.pores.main_region[pore]].radius
}

/// The throats that were not dissolved.
pub(super) fn kept(config: &Configuration) -> impl Iterator<Item = &Throat> {
    config.pores.throats.iter().map(|&throat| &config.network.throats[throat])
}

/// The vector `from` to `to`, of the nearest image in a periodic domain.
fn nearest(config: &Configuration, from: Vec2, to: Vec2) -> Vec2 {
    let (mut vector, size) = (to - from, config.bounds.size());
    for axis in (0..2).filter(|&axis| config.periodic[axis]) {
        vector[axis] -= size[axis] * (vector[axis] / size[axis]).round();
    }
    vector
}

/// The vectors from the middle of a throat to the centers of both pores.
pub(super) fn arms(config: &Configuration, throat: &Throat) -> [Vec2; 2] {
    pores_of(config, throat).map(|pore| nearest(config, throat.middle(), center(config, pore)))
}

/// Length of a throat in m, from pore center to pore center through its middle.
pub(super) fn length(config: &Configuration, throat: &Throat) -> f64 {
    arms(config, throat).iter().map(|arm| arm.norm()).sum()
}

/// Lengths of wall of the pores in m.
pub(super) fn wall_lengths(config: &Configuration) -> Vec<f64> {
    let mut lengths = vec![0.0; config.pores.main_region.len()];
    for (region, &pore) in config.network.regions.iter().zip(&config.pores.pore_of) {
        lengths[pore] += region.wall_length;
    }
    lengths
}

/// Number of throats of each pore, openings included; a throat from a pore to itself counts twice.
fn coordination(config: &Configuration) -> Vec<usize> {
    let mut numbers = vec![0; config.pores.main_region.len()];
    kept(config).flat_map(|throat| pores_of(config, throat)).for_each(|pore| numbers[pore] += 1);
    openings(config).for_each(|(_, pore)| numbers[pore] += 1);
    numbers
}

/// The openings with their pores.
pub(super) fn openings(config: &Configuration) -> impl Iterator<Item = (&Opening, usize)> {
    config.network.openings.iter().map(|opening| (opening, config.pores.pore_of[opening.region]))
}

/// Whether any region of a pore is one of these.
fn of_pores(config: &Configuration, regions: &[bool]) -> Vec<bool> {
    let mut found = vec![false; config.pores.main_region.len()];
    regions.iter().zip(&config.pores.pore_of).for_each(|(is, &pore)| found[pore] |= is);
    found
}

/// `pores.csv`.
pub(crate) fn pores(config: &Configuration, occupation: Option<&Occupation>) -> Table {
    let all = || 0..config.pores.main_region.len();
    let mut columns = vec![
        // Number of the pore, from 0
        counts("pore", all()),
        // Center, the maximum of the wall distance
        numbers("x_m", all().map(|pore| center(config, pore).x)),
        numbers("y_m", all().map(|pore| center(config, pore).y)),
        // Wall distance of the center
        numbers("inscribed_radius_m", all().map(|pore| radius(config, pore))),
        // Area of its region
        numbers("area_m2", config.pores.area.iter().copied()),
        // Length of wall of its region
        numbers("wall_length_m", wall_lengths(config)),
        // Number of throats and openings, a throat from a pore to itself counting twice
        counts("coordination_number", coordination(config)),
        // Whether it opens at the inlet
        flags("inlet", of_pores(config, &config.at_inlet())),
        // Whether it opens at the outlet
        flags("outlet", of_pores(config, &config.at_outlet())),
    ];
    if let Some(depth) = config.network.depth {
        // With [`geometry.depth`](../tutorials/depth.md), after `area_m2`: area times depth
        columns.insert(5, numbers("volume_m3", config.pores.area.iter().map(|area| depth * area)));
    }
    if let Some(occupation) = occupation {
        let states = pore_states(config, occupation);
        columns.extend(state_columns(config, occupation.invading, &states));
        if let Some(films) = &occupation.films {
            let mut volumes = vec![0.0; config.pores.main_region.len()];
            for (element, volume) in occupation.elements().iter().zip(&films.volume) {
                volumes[config.pores.pore_of[element.region]] += volume;
            }
            // With `films`, as the last column: volume of its films
            columns.push(numbers("film_volume_m3", volumes));
        }
    }
    Table { name: "pores", columns }
}

fn state_columns(config: &Configuration, invading: FluidPhase, states: &[PoreState]) -> [Column; 5] {
    let of =
        |value: fn(&Invasion) -> f64| states.iter().map(move |state| state.invasion.as_ref().map_or(f64::NAN, value));
    [
        // With a displacement, as all that follow: phase that holds more than half of the pore
        words("phase", states.iter().map(|state| state.fluid.name())),
        // Event of the last half cycle by which the invading phase held more than half; 0 at the start, empty if never
        indices("sequence", states.iter().map(|state| state.invasion.map(|invasion| invasion.sequence))),
        // Whether more than half is trapped defending phase
        flags("trapped", states.iter().map(|state| state.is_trapped)),
        numbers(
            // Applied capillary pressure at the event `sequence`
            "invasion_capillary_pressure_Pa",
            of(|invasion| invasion.applied).map(|applied| config.pressure(invading, applied)),
        ),
        // Displaced share of the pore space after the event `sequence`
        numbers("displaced_saturation_at_invasion", of(|invasion| invasion.displaced)),
    ]
}

/// `throats.csv`.
pub(crate) fn throats(model: &Model, occupation: Option<&Occupation>) -> Table {
    let config = &model.config;
    let of = |value: fn(&Throat) -> f64| kept(config).map(value);
    let mut columns = vec![
        // Number of the throat, from 0
        counts("throat", 0..config.pores.throats.len()),
        // Its pores, maybe the same
        counts("pore_1", kept(config).map(|throat| pores_of(config, throat)[0])),
        counts("pore_2", kept(config).map(|throat| pores_of(config, throat)[1])),
        // Its middle
        numbers("x_m", of(|throat| throat.middle().x)),
        numbers("y_m", of(|throat| throat.middle().y)),
        // Distance of the wall contacts
        numbers("width_m", of(|throat| throat.width)),
        // Length from pore center to pore center through the middle
        numbers("length_m", kept(config).map(|throat| length(config, throat))),
        // Wall contacts
        numbers("contact_1_x_m", of(|throat| throat.contacts[0].x)),
        numbers("contact_1_y_m", of(|throat| throat.contacts[0].y)),
        numbers("contact_2_x_m", of(|throat| throat.contacts[1].x)),
        numbers("contact_2_y_m", of(|throat| throat.contacts[1].y)),
        // Number of the shape at each wall contact; the sides left, right, bottom and top follow the last shape
        counts("wall_1", kept(config).map(|throat| throat.shapes[0] as usize)),
        counts("wall_2", kept(config).map(|throat| throat.shapes[1] as usize)),
        // Curvature of the wall at each contact, positive where the solid is convex; empty at an edge
        numbers("wall_curvature_1_per_m", of(|throat| finite(throat.curvatures[0]))),
        numbers("wall_curvature_2_per_m", of(|throat| finite(throat.curvatures[1]))),
    ];
    let conductances = model.conductances();
    let of_kept = |factor: f64| config.pores.throats.iter().map(move |&throat| factor * conductances[throat]);
    // [Flow per depth times viscosity over pressure difference](../network/theory.md#conductance-and-permeability)
    columns.push(numbers("conductance_m2", of_kept(1.0)));
    if let Some(depth) = config.network.depth {
        // With `geometry.depth`: the same for the whole flow
        columns.push(numbers("conductance_m3", of_kept(depth)));
    }
    if let Some(pressures) = model.entry_pressures() {
        // Entry pressure in drainage, at the receding angle
        columns.push(numbers("entry_pressure_Pa", config.pores.throats.iter().map(|&throat| pressures[throat])));
    }
    if let Some(occupation) = occupation {
        // Event of the last half cycle by which it was passed
        columns.push(indices("sequence", sequences(config, occupation)));
    }
    Table { name: "throats", columns }
}

/// The curvature of a vertex is infinite, without a number in the table.
pub(super) fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::NAN }
}

/// For each throat the event that passed it.
fn sequences(config: &Configuration, occupation: &Occupation) -> Vec<Option<usize>> {
    let mut passed = vec![None; config.network.throats.len()];
    for (sequence, throat) in (1..).zip(&occupation.passed) {
        if let Some(throat) = *throat {
            passed[throat].get_or_insert(sequence);
        }
    }
    config.pores.throats.iter().map(|&throat| passed[throat]).collect()
}

/// The number of each throat of the network among those not dissolved.
pub(super) fn numbers_of_throats(config: &Configuration) -> Vec<Option<usize>> {
    let mut number_of = vec![None; config.network.throats.len()];
    config.pores.throats.iter().enumerate().for_each(|(number, &throat)| number_of[throat] = Some(number));
    number_of
}

/// `events.csv` of a quasi-static displacement.
pub(crate) fn events(config: &Configuration, cycles: &Cycles) -> Table {
    let number_of = numbers_of_throats(config);
    let rows = rows(cycles);
    let all = || rows.iter();
    let process = |half_cycle: usize| cycles.half_cycles()[half_cycle].invading.process();
    let pressures = |of: fn(&Entry) -> f64| {
        all().map(move |row| {
            let pressure = |entry| config.pressure(cycles.half_cycles()[row.half_cycle].invading, of(entry));
            row.event.map_or(f64::NAN, pressure)
        })
    };
    let throat = |row: &Row| row.event.and_then(|entry| number_of[entry.throat?]);
    let mut table = Table {
        name: "events",
        columns: vec![
            // Number of the half cycle, from 1
            counts("half_cycle", all().map(|row| row.half_cycle + 1)),
            // `drainage` or `imbibition`
            words("process", all().map(|row| process(row.half_cycle))),
            // Number of the event in its half cycle, 0 at the beginning
            counts("sequence", all().map(|row| row.sequence)),
            // `burst`, `touch`, `overlap`; with `films` `snap-off`, `reconnection`; `beginning`: openings of the inlet filled, without a pressure
            words("event", all().map(|row| row.event.map_or(BEGINNING, |entry| entry.kind.name()))),
            // Passed throat; empty within a pore, or for a throat that the merge dissolved
            indices("throat", all().map(throat)),
            // Capillary pressure of this event
            numbers("meniscus_pressure_Pa", pressures(|entry| entry.curvature)),
            // Applied capillary pressure: the extreme so far
            numbers("capillary_pressure_Pa", pressures(|entry| entry.applied)),
            // Wetting saturation after the event
            numbers("saturation", all().map(|row| row.saturation[0])),
        ],
    };
    if cycles.has_films() {
        // With `films`: the part of the saturation in films
        table.columns.push(numbers("film_saturation", all().map(|row| row.saturation[1])));
    }
    table
}

/// Name of the row at the start of a half cycle, after the initial filling of elements open at its inlet.
pub(super) const BEGINNING: &str = "beginning";

/// A row of the events.
struct Row<'c> {
    half_cycle: usize,
    sequence: usize,
    /// `None` at the start.
    event: Option<&'c Entry>,
    /// Saturation of the wetting phase, and the part of it in films.
    saturation: [f64; 2],
}

/// The initial state of each half cycle, and its events.
fn rows(cycles: &Cycles) -> Vec<Row<'_>> {
    let of_half = |(half_cycle, outcome): (usize, &Outcome)| {
        let saturation = [outcome.first_saturation[1], outcome.first_film_saturation];
        let first = Row { half_cycle, sequence: 0, event: None, saturation };
        let events = cycles.history().iter().filter(move |entry| entry.half_cycle == half_cycle);
        let row = move |(entry, sequence): (_, usize)| {
            let &Entry { saturation, film_saturation, .. } = entry;
            Row { half_cycle, sequence, event: Some(entry), saturation: [saturation, film_saturation] }
        };
        std::iter::once(first).chain(events.zip(1..).map(row))
    };
    cycles.record.outcomes.iter().enumerate().flat_map(of_half).collect()
}

/// `capillary_pressure.csv`: the curve with the films at every pressure, with the tension in N/m.
pub(crate) fn capillary_pressure(cycles: &Cycles, tension: f64) -> Table {
    let curve = &cycles.record.curve;
    let process = |point: &CurvePoint| cycles.half_cycles()[point.half_cycle].invading.process();
    Table {
        name: "capillary_pressure",
        columns: vec![
            // Number of the half cycle, from 1
            counts("half_cycle", curve.iter().map(|point| point.half_cycle + 1)),
            // `drainage` or `imbibition`
            words("process", curve.iter().map(process)),
            // Applied capillary pressure
            numbers("capillary_pressure_Pa", curve.iter().map(|point| tension * point.curvature)),
            // Wetting saturation
            numbers("saturation", curve.iter().map(|point| point.saturation)),
            // The part of the saturation in films
            numbers("film_saturation", curve.iter().map(|point| point.film_saturation)),
        ],
    }
}
