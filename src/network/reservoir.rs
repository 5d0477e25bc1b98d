//! `swof.inc` and `sgof.inc`: saturation functions for reservoir simulators, in METRIC units, at states after events of the last half cycle.
//!
//! With water as the wetting and oil as the non-wetting phase, SWOF lists S_w, k_rw, k_ro and p_o - p_w by rising S_w; with liquid as the
//! wetting and gas as the non-wetting phase, SGOF lists S_g, k_rg, k_rl and p_g - p_l by rising S_g.

use std::fmt::Write;

use super::cycles::Cycles;
use super::flow::relative_after;
use super::model::{Configuration, Model};
use crate::table::Document;

/// Pa in a bar, the unit of pressure in METRIC decks.
const BAR: f64 = 1.0e5;
/// Maximum number of rows.
const ROWS: usize = 40;
/// Resolution of saturations, as written: closer ones share a row.
const LEAST_STEP: f64 = 1.0e-6;

/// A state of the last half cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct State {
    /// Number of its events so far; `None` before the initial filling of elements open at the inlet.
    events: Option<usize>,
    /// Saturation of the wetting phase.
    saturation: f64,
    /// p_n - p_w in Pa.
    pressure: f64,
}

/// A row: saturation of the wetting phase, relative permeabilities of the wetting and the non-wetting phase, p_n - p_w in Pa.
pub(super) type Row = [f64; 4];

/// The files requested by the case; none if nothing flows from inlet to outlet.
pub(crate) fn documents(model: &Model) -> Vec<Document> {
    let tables = model.config.tables;
    let Some(cycles) = model.cycles.as_ref().filter(|_| !tables.is_empty()) else { return Vec::new() };
    let rows = rows(model, cycles);
    if rows.is_empty() {
        return Vec::new();
    }
    let process = format!("{} {}", cycles.half_cycle().name(), cycles.half_cycle_index() / 2 + 1);
    let swof = tables.swof.then(|| Document { name: "swof.inc", text: swof(&rows, &process) });
    let sgof = tables.sgof.then(|| Document { name: "sgof.inc", text: sgof(&rows, &process) });
    swof.into_iter().chain(sgof).collect()
}

/// The rows by rising saturation of the wetting phase.
fn rows(model: &Model, cycles: &Cycles) -> Vec<Row> {
    let states = chosen(states(&model.config, cycles));
    let events: Vec<Option<usize>> = states.iter().map(|state| state.events).collect();
    let relative = relative_after(model, &events);
    let row = |(state, [_, wetting, other]): (&State, [f64; 3])| [state.saturation, wetting, other, state.pressure];
    let mut rows: Vec<Row> = states.iter().zip(relative).map(row).collect();
    rows.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // The conductance of a phase does not fall with its saturation, except by rounding.
    for k in 1..rows.len() {
        rows[k][1] = rows[k][1].max(rows[k - 1][1]);
        rows[k][2] = rows[k][2].min(rows[k - 1][2]);
    }
    rows
}

/// The initial state of the last half cycle, and the last state at each of its saturations.
fn states(config: &Configuration, cycles: &Cycles) -> Vec<State> {
    let half_cycle = cycles.half_cycle_index();
    let entries: Vec<_> = cycles.history().iter().filter(|entry| entry.half_cycle == half_cycle).collect();
    let pressure = |applied: f64| config.pressure(cycles.half_cycle().invading, applied);
    let first = entries.first().map_or(f64::NAN, |entry| pressure(entry.applied));
    // Manifolds do not count in saturations, so in a region the initial filling displaces nothing.
    let events = config.region.map(|_| 0);
    let saturation = cycles.outcomes()[half_cycle].first_saturation[0];
    let mut found = vec![State { events, saturation, pressure: first }];
    for (entry, events) in entries.into_iter().zip(1..) {
        let state = State { events: Some(events), saturation: entry.saturation, pressure: pressure(entry.applied) };
        match found.last_mut() {
            Some(last) if (last.saturation - state.saturation).abs() < LEAST_STEP => {
                *last = State { saturation: last.saturation, ..state }
            }
            _ => found.push(state),
        }
    }
    found
}

/// A limited number of them, including the first and the last one, at saturations spaced as evenly as possible.
fn chosen(states: Vec<State>) -> Vec<State> {
    let [Some(first), Some(last)] = [states.first(), states.last()].map(|end| end.copied()) else { return states };
    let step = (last.saturation - first.saturation).abs() / (ROWS - 1) as f64;
    let mut kept: Vec<State> = Vec::new();
    for state in states {
        let is_far = |other: State| (state.saturation - other.saturation).abs() >= step;
        let is_last = state == last;
        if is_last && kept.len() > 1 && kept.last().is_some_and(|&it| !is_far(it)) {
            kept.pop();
        }
        if is_last || kept.last().is_none_or(|&it| is_far(it)) {
            kept.push(state);
        }
    }
    kept
}

/// The keyword SWOF.
fn swof(rows: &[Row], process: &str) -> String {
    let [low, high] = ends(rows);
    let mut text = format!(
        "-- Water (wetting) and oil (non-wetting) along {process} of a pore network.\n\
         -- METRIC units: Pcow = p_o - p_w in bar; saturations and relative permeabilities have none.\n\
         -- End points: Sw from {:.6} to {:.6}; krow = {:.6} and krw = {:.6} at the first, krw = {:.6} and krow = {:.6} at the last.\n{}\
         SWOF\n--       Sw          krw         krow         Pcow\n",
        low[0],
        high[0],
        low[2],
        low[1],
        high[1],
        high[2],
        unfinished(low[1], high[2], ["krw", "krow"])
    );
    for [saturation, wetting, other, pressure] in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{saturation:>10.6} {wetting:>12.8} {other:>12.8} {:>14.6e}", pressure / BAR);
    }
    text + "/\n"
}

/// The keyword SGOF.
fn sgof(rows: &[Row], process: &str) -> String {
    let [low, high] = ends(rows);
    let mut text = format!(
        "-- Gas (non-wetting) and liquid (wetting) along {process} of a pore network.\n\
         -- METRIC units: Pcog = p_g - p_l in bar; saturations and relative permeabilities have none.\n\
         -- End points: Sg from {:.6} to {:.6}; krog = {:.6} and krg = {:.6} at the first, krg = {:.6} and krog = {:.6} at the last.\n{}\
         SGOF\n--       Sg          krg         krog         Pcog\n",
        1.0 - high[0],
        1.0 - low[0],
        high[1],
        high[2],
        low[2],
        low[1],
        unfinished(high[2], low[1], ["krg", "krog"])
    );
    for [saturation, wetting, other, pressure] in rows.iter().rev() {
        let gas = 1.0 - saturation;
        let _ = writeln!(text, "{gas:>10.6} {other:>12.8} {wetting:>12.8} {:>14.6e}", pressure / BAR);
    }
    text + "/\n"
}

/// The rows of the smallest and of the largest saturation of the wetting phase.
fn ends(rows: &[Row]) -> [Row; 2] {
    [rows.first(), rows.last()].map(|row| row.copied().unwrap_or([f64::NAN; 4]))
}

/// A comment if a phase still flows at its end of the table, where simulators expect zero.
fn unfinished(first: f64, last: f64, [of_first, of_last]: [&str; 2]) -> String {
    let comment = |value: f64, name: &str, end: &str| {
        if value > 0.0 {
            format!(
                "-- {name} is not 0 at the {end} saturation: the displacement ended while this phase still flowed, or began so.\n"
            )
        } else {
            String::new()
        }
    };
    comment(first, of_first, "first") + &comment(last, of_last, "last")
}
