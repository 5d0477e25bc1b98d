//! The table of the verified throats, and what a network can take up from it.

use std::path::{Path, PathBuf};

use super::event_results::EventRow;
use super::page::page;
use super::results::{Direct, Row, Status};
use super::subject::Subject;
use crate::case::network::measured::{Measured, MeasuredThroat};
use crate::io::{FileError, atomic};
use crate::network::cycles::FluidPhase;
use crate::study::table::Table;

/// What was written.
#[derive(Debug)]
pub(crate) struct Written {
    /// The table for people.
    pub table: Table,
    /// That of the events; none where none was chosen.
    pub events: Option<Table>,
    /// The page.
    pub page: PathBuf,
    /// How many throats take the measured pressure.
    pub replaced: usize,
    /// The file that a network takes up.
    pub measured: PathBuf,
}

/// Writes `verify.csv`, `verify.html`, `entry_pressures.csv` and `measured.json`, and of events `verify_events.csv`.
pub(crate) fn write(
    folder: &Path,
    subject: &Subject,
    rows: &[Row],
    events: &[EventRow],
    spacings: &[u32],
    title: &str,
) -> Result<Written, FileError> {
    let path = |name: &str| folder.join(name);
    let table = short(subject, rows);
    atomic::write(&path("verify.csv"), &full(subject, rows, spacings).csv()?)?;
    atomic::write(&path("entry_pressures.csv"), &pressures(rows).csv()?)?;
    let measured = measured(subject, rows);
    let replaced = measured.throats.len();
    // Numbers and texts can always be written.
    let text = serde_json::to_vec_pretty(&measured).unwrap_or_default();
    atomic::write(&path("measured.json"), &text)?;
    let of_events = (!events.is_empty()).then(|| short_events(events));
    if of_events.is_some() {
        atomic::write(&path("verify_events.csv"), &full_events(events, spacings).csv()?)?;
    }
    let html = page(title, (&table, rows), of_events.as_ref().map(|table| (table, events)));
    atomic::write(&path("verify.html"), html.as_bytes())?;
    Ok(Written { table, events: of_events, page: path("verify.html"), replaced, measured: path("measured.json") })
}

fn measured(subject: &Subject, rows: &[Row]) -> Measured {
    let one = |row: &Row| {
        let (Some(Direct { value, .. }), Ok(cut_out)) = (row.pressure, &row.planned.cut_out) else {
            return None;
        };
        Some(MeasuredThroat {
            index: row.planned.chosen.throat,
            formula_curvature: cut_out.meniscus.curvature,
            entry_curvature: value / subject.tension,
        })
    };
    Measured {
        geometry_hash: subject.geometry_hash().to_owned(),
        throats: rows.iter().filter(|row| row.is_replaced()).filter_map(one).collect(),
    }
}

fn exact(value: Option<f64>) -> String {
    value.filter(|value| value.is_finite()).map_or(String::new(), |value| format!("{value:?}"))
}

fn percent(value: Option<f64>) -> Option<f64> {
    value.map(|value| 100.0 * value)
}

fn used(row: &Row) -> &'static str {
    if row.is_replaced() { "measured" } else { "formula" }
}

/// The entry pressures of all verified throats, the measured one where it is used.
fn pressures(rows: &[Row]) -> Table {
    let line = |row: &Row| {
        let value = row.pressure.filter(|_| row.is_replaced()).map_or(row.pressure_formula, |direct| direct.value);
        vec![row.planned.chosen.number.to_string(), exact(Some(value)), used(row).to_owned()]
    };
    let heads = ["throat", "entry_pressure_Pa", "used"].map(str::to_owned).to_vec();
    Table { heads, rows: rows.iter().map(line).collect() }
}

/// All digits.
fn full(subject: &Subject, rows: &[Row], spacings: &[u32]) -> Table {
    let heads = [
        "throat",
        "x_m",
        "y_m",
        "w_m",
        "kappa_1_per_m",
        "kappa_2_per_m",
        "theta_deg",
        "pc_formula_Pa",
        "pc_direct_Pa",
        "pc_direct_error_Pa",
        "pc_difference_percent",
        "g_formula_m2",
        "g_direct_m2",
        "g_direct_error_m2",
        "g_difference_percent",
        "spacings_across",
        "particles",
        "wall_time_s",
        "status",
        "flow_status",
        "used",
        "touch_pressure_Pa",
        "walls_left_out",
        "chosen",
    ];
    let across: Vec<String> = spacings.iter().map(ToString::to_string).collect();
    let line = |row: &Row| {
        let throat = subject.throat(row.planned.chosen.throat);
        let middle = 0.5 * (throat.contacts[0] + throat.contacts[1]);
        let cut_out = row.planned.cut_out.as_ref().ok();
        vec![
            row.planned.chosen.number.to_string(),
            exact(Some(middle.x)),
            exact(Some(middle.y)),
            exact(Some(throat.width)),
            exact(Some(throat.curvatures[0])),
            exact(Some(throat.curvatures[1])),
            exact(cut_out.map(|cut_out| cut_out.angle.to_degrees())),
            exact(Some(row.pressure_formula)),
            exact(row.pressure.map(|direct| direct.value)),
            exact(row.pressure.and_then(|direct| direct.error)),
            exact(percent(row.pressure_difference())),
            exact(row.planned.conductance),
            exact(row.conductance.map(|direct| direct.value)),
            exact(row.conductance.and_then(|direct| direct.error)),
            exact(percent(row.conductance_difference())),
            across.join(" "),
            row.particles.map_or(String::new(), |count| format!("{count}")),
            exact(Some(row.wall_time)),
            row.status.to_string(),
            row.flow_status.to_string(),
            used(row).to_owned(),
            exact(row.planned.touches.map(|curvature| subject.tension * curvature)),
            cut_out.map_or(String::new(), |cut_out| cut_out.left_out.to_string()),
            row.planned.chosen.reason.clone(),
        ]
    };
    Table { heads: heads.map(str::to_owned).to_vec(), rows: rows.iter().map(line).collect() }
}

/// All digits of the events.
fn full_events(rows: &[EventRow], spacings: &[u32]) -> Table {
    let heads = [
        "event",
        "kind",
        "throat",
        "x_m",
        "y_m",
        "w_m",
        "theta_deg",
        "pressure_formula_Pa",
        "pressure_direct_Pa",
        "pressure_direct_error_Pa",
        "difference_Pa",
        "difference_over_tension_per_width_percent",
        "spacings_across",
        "particles",
        "wall_time_s",
        "status",
        "walls_left_out",
        "chosen",
    ];
    let across: Vec<String> = spacings.iter().map(ToString::to_string).collect();
    let line = |row: &EventRow| {
        let planned = row.planned;
        let cut_out = planned.cut_out.as_ref().ok();
        vec![
            planned.number.to_string(),
            planned.kind.name().to_owned(),
            planned.throat.map_or(String::new(), |throat| throat.to_string()),
            exact(cut_out.map(|cut_out| cut_out.frame.middle.x)),
            exact(cut_out.map(|cut_out| cut_out.frame.middle.y)),
            exact(cut_out.map(|cut_out| cut_out.width)),
            exact(cut_out.map(|cut_out| cut_out.angle.to_degrees())),
            exact(Some(row.formula)),
            exact(row.direct.map(|direct| direct.value)),
            exact(row.direct.and_then(|direct| direct.error)),
            exact(row.difference()),
            exact(percent(row.relative_difference())),
            across.join(" "),
            row.particles.map_or(String::new(), |count| format!("{count}")),
            exact(Some(row.wall_time)),
            row.status.to_string(),
            cut_out.map_or(String::new(), |cut_out| cut_out.left_out.to_string()),
            planned.reason.clone(),
        ]
    };
    Table { heads: heads.map(str::to_owned).to_vec(), rows: rows.iter().map(line).collect() }
}

const MICROMETERS: f64 = 1e6;

fn number(value: Option<f64>, digits: usize) -> String {
    match value.filter(|value| value.is_finite()) {
        Some(value) => format!("{value:.digits$}"),
        None => "–".to_owned(),
    }
}

fn with_error(direct: Option<Direct>, scale: &dyn Fn(f64) -> String) -> String {
    match direct {
        Some(Direct { value, error: Some(error) }) => format!("{} ± {}", scale(value), scale(error)),
        Some(Direct { value, error: None }) => scale(value),
        None => "–".to_owned(),
    }
}

/// The table of the events for people.
fn short_events(rows: &[EventRow]) -> Table {
    let heads = [
        "event",
        "kind",
        "throat",
        "width in µm",
        "angle in deg",
        "pressure in Pa: formula",
        "direct",
        "difference in Pa",
        "in % of tension/width",
        "particles",
        "time in s",
        "status",
    ];
    let line = |row: &EventRow| {
        let planned = row.planned;
        let cut_out = planned.cut_out.as_ref().ok();
        vec![
            planned.number.to_string(),
            planned.kind.name().to_owned(),
            planned.throat.map_or("–".to_owned(), |throat| throat.to_string()),
            number(cut_out.map(|cut_out| MICROMETERS * cut_out.width), 2),
            number(cut_out.map(|cut_out| cut_out.angle.to_degrees()), 1),
            number(Some(row.formula), 1),
            with_error(row.direct, &|value| format!("{value:.1}")),
            number(row.difference(), 1),
            number(percent(row.relative_difference()), 1),
            number(row.particles, 0),
            number(Some(row.wall_time), 1),
            row.status.to_string(),
        ]
    };
    Table { heads: heads.map(str::to_owned).to_vec(), rows: rows.iter().map(line).collect() }
}

/// The table for people.
fn short(subject: &Subject, rows: &[Row]) -> Table {
    let heads = [
        "throat",
        "width in µm",
        "angle in deg",
        "pressure in Pa: formula",
        "direct",
        "difference in %",
        "conductance in m²: formula",
        "direct",
        "difference in %",
        "particles",
        "time in s",
        "status",
        "used",
    ];
    let line = |row: &Row| {
        let width = subject.throat(row.planned.chosen.throat).width;
        let angle = row.planned.cut_out.as_ref().ok().map(|cut_out| cut_out.angle.to_degrees());
        let status = match (&row.status, &row.flow_status) {
            (Status::Ok, Status::Ok) => "ok".to_owned(),
            (Status::Ok, flow) => format!("ok; flow {flow}"),
            (status, _) => status.to_string(),
        };
        vec![
            row.planned.chosen.number.to_string(),
            number(Some(MICROMETERS * width), 2),
            number(angle, 1),
            number(Some(row.pressure_formula), 1),
            with_error(row.pressure, &|value| format!("{value:.1}")),
            number(percent(row.pressure_difference()), 2),
            row.planned.conductance.map_or("–".to_owned(), |value| format!("{value:.3e}")),
            with_error(row.conductance, &|value| format!("{value:.3e}")),
            number(percent(row.conductance_difference()), 1),
            number(row.particles, 0),
            number(Some(row.wall_time), 1),
            status,
            used(row).to_owned(),
        ]
    };
    Table { heads: heads.map(str::to_owned).to_vec(), rows: rows.iter().map(line).collect() }
}

/// One line for each throat that is not as it should be.
pub(crate) fn notes(rows: &[Row], tension: f64, invading: FluidPhase) -> Vec<String> {
    let touch = |row: &Row| {
        let curvature = row.planned.touches?;
        let number = row.planned.chosen.number;
        Some(format!(
            "throat {number}: the {} phase touches another wall at {:.1} Pa, before the burst that is verified here",
            invading.name(),
            tension * curvature
        ))
    };
    rows.iter().filter_map(touch).collect()
}
