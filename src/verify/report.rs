//! The tables of the verified throats, and the measured values that a network can read.

use std::path::{Path, PathBuf};

use super::fluids::Fluids;
use super::page::page;
use super::results::{Direct, Row, Status};
use super::subdomain::Subdomain;
use super::subject::Subject;
use crate::study::table::Table;
use meniscus_case::network::measured::{Measured, MeasuredThroat};
use meniscus_network::graph::Throat;
use meniscus_output::{FileError, atomic};

/// The output.
#[derive(Debug)]
pub(crate) struct Written {
    /// The table of throats for the terminal.
    pub table: Table,
    /// The page.
    pub page: PathBuf,
    /// Number of throats that use the measured pressure.
    pub replaced: usize,
    /// The file that a network can read.
    pub measured: PathBuf,
}

/// Writes `verify.csv`, `verify.html`, `entry_pressures.csv` and `measured.json`.
pub(crate) fn write(
    folder: &Path,
    subject: &Subject,
    rows: &[Row],
    spacings: &[u32],
    fluids: &Fluids,
    title: &str,
) -> Result<Written, FileError> {
    let path = |name: &str| folder.join(name);
    let table = short(subject, rows);
    atomic::write(&path("verify.csv"), &full(subject, rows, spacings, fluids).csv()?)?;
    atomic::write(&path("entry_pressures.csv"), &pressures(rows).csv()?)?;
    let measured = measured(subject, rows, fluids);
    let replaced = measured.throats.len();
    // Writing numbers and text cannot fail.
    let text = serde_json::to_vec_pretty(&measured).unwrap_or_default();
    atomic::write(&path("measured.json"), &text)?;
    let html = page(title, &table, rows);
    atomic::write(&path("verify.html"), html.as_bytes())?;
    Ok(Written { table, page: path("verify.html"), replaced, measured: path("measured.json") })
}

fn measured(subject: &Subject, rows: &[Row], fluids: &Fluids) -> Measured {
    let one = |row: &Row| {
        let (Some(Direct { value, .. }), Ok(subdomain)) = (row.pressure, &row.planned.subdomain) else {
            return None;
        };
        Some(MeasuredThroat {
            index: row.planned.chosen.throat,
            formula_curvature: subdomain.meniscus.curvature,
            entry_curvature: fluids.in_plane(value),
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

/// The entry pressures of all verified throats, measured if they replace the formula.
fn pressures(rows: &[Row]) -> Table {
    let value = |row: &Row| row.pressure.filter(|_| row.is_replaced()).map_or(row.pressure_formula, |one| one.value);
    Table::of(
        rows,
        &[
            ("throat", &|row| row.planned.chosen.number.to_string()),
            ("entry_pressure_Pa", &|row| exact(Some(value(row)))),
            ("used", &|row| used(row).to_owned()),
        ],
    )
}

fn joined(spacings: &[u32]) -> String {
    spacings.iter().map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

/// `verify.csv`, in full precision.
fn full(subject: &Subject, rows: &[Row], spacings: &[u32], fluids: &Fluids) -> Table {
    let across = joined(spacings);
    let throat = |row: &Row, value: fn(&Throat) -> f64| exact(Some(value(subject.throat(row.planned.chosen.throat))));
    let subdomain =
        |row: &Row, text: &dyn Fn(&Subdomain) -> String| row.planned.subdomain.as_ref().map_or(String::new(), text);
    Table::of(
        rows,
        &[
            ("throat", &|row| row.planned.chosen.number.to_string()),
            ("x_m", &|row| throat(row, |throat| throat.middle().x)),
            ("y_m", &|row| throat(row, |throat| throat.middle().y)),
            ("w_m", &|row| throat(row, |throat| throat.width)),
            ("kappa_1_per_m", &|row| throat(row, |throat| throat.curvatures[0])),
            ("kappa_2_per_m", &|row| throat(row, |throat| throat.curvatures[1])),
            ("theta_deg", &|row| subdomain(row, &|subdomain| exact(Some(subdomain.angle.to_degrees())))),
            ("pc_formula_Pa", &|row| exact(Some(row.pressure_formula))),
            ("pc_direct_Pa", &|row| exact(row.pressure.map(|direct| direct.value))),
            ("pc_direct_error_Pa", &|row| exact(row.pressure.and_then(|direct| direct.error))),
            ("pc_difference_percent", &|row| exact(percent(row.pressure_difference()))),
            ("g_formula_m2", &|row| exact(row.planned.conductance)),
            ("g_direct_m2", &|row| exact(row.conductance.map(|direct| direct.value))),
            ("g_direct_error_m2", &|row| exact(row.conductance.and_then(|direct| direct.error))),
            ("g_difference_percent", &|row| exact(percent(row.conductance_difference()))),
            ("spacings_across", &|_| across.clone()),
            ("particles", &|row| row.particles.map_or(String::new(), |count| format!("{count}"))),
            ("wall_time_s", &|row| exact(Some(row.wall_time))),
            ("status", &|row| row.status.to_string()),
            ("flow_status", &|row| row.flow_status.to_string()),
            ("used", &|row| used(row).to_owned()),
            ("touch_pressure_Pa", &|row| exact(row.planned.touches.map(|curvature| fluids.pressure(curvature)))),
            ("walls_left_out", &|row| subdomain(row, &|subdomain| subdomain.left_out.to_string())),
            ("chosen", &|row| row.planned.chosen.reason.clone()),
        ],
    )
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

/// The table of throats for the terminal.
fn short(subject: &Subject, rows: &[Row]) -> Table {
    let width = |row: &Row| subject.throat(row.planned.chosen.throat).width;
    let angle = |row: &Row| row.planned.subdomain.as_ref().ok().map(|subdomain| subdomain.angle.to_degrees());
    let status = |row: &Row| match (&row.status, &row.flow_status) {
        (Status::Ok, Status::Ok) => "ok".to_owned(),
        (Status::Ok, flow) => format!("ok; flow {flow}"),
        (status, _) => status.to_string(),
    };
    Table::of(
        rows,
        &[
            ("throat", &|row| row.planned.chosen.number.to_string()),
            ("width in µm", &|row| number(Some(MICROMETERS * width(row)), 2)),
            ("angle in deg", &|row| number(angle(row), 1)),
            ("pressure in Pa: formula", &|row| number(Some(row.pressure_formula), 1)),
            ("direct", &|row| with_error(row.pressure, &|value| format!("{value:.1}"))),
            ("difference in %", &|row| number(percent(row.pressure_difference()), 2)),
            ("conductance in m²: formula", &|row| {
                row.planned.conductance.map_or("–".to_owned(), |value| format!("{value:.3e}"))
            }),
            ("direct", &|row| with_error(row.conductance, &|value| format!("{value:.3e}"))),
            ("difference in %", &|row| number(percent(row.conductance_difference()), 1)),
            ("particles", &|row| number(row.particles, 0)),
            ("time in s", &|row| number(Some(row.wall_time), 1)),
            ("status", &status),
            ("used", &|row| used(row).to_owned()),
        ],
    )
}

/// One line for each throat with a problem.
pub(crate) fn notes(rows: &[Row], fluids: &Fluids, spacings: &[u32]) -> Vec<String> {
    let touch = |row: &Row| {
        let curvature = row.planned.touches?;
        let number = row.planned.chosen.number;
        Some(format!(
            "throat {number}: the {} phase touches another wall at {:.1} Pa, before the burst verified here",
            fluids.invading.name(),
            fluids.pressure(curvature)
        ))
    };
    rows.iter().filter_map(touch).chain(of_chip(rows, fluids, spacings)).collect()
}

/// The limits of the verification with floor and lid.
fn of_chip(rows: &[Row], fluids: &Fluids, spacings: &[u32]) -> Vec<String> {
    let (Some(chip), Some(across)) = (fluids.chip, spacings.iter().max()) else { return Vec::new() };
    let layer = chip.depth.distance() / 12.0_f64.sqrt();
    let coarse =
        |row: &&Row| row.planned.subdomain.as_ref().is_ok_and(|subdomain| subdomain.width > layer * f64::from(*across));
    let mut found = vec![
        "both sides curve menisci over the depth, and thin them by corner films below 45 degrees, by the same formula: what is verified is the curvature in \
         the plane, the friction and the numbers, not that formula"
            .to_owned(),
    ];
    let coarse: Vec<String> = rows.iter().filter(coarse).map(|row| row.planned.chosen.number.to_string()).collect();
    if !coarse.is_empty() {
        found.push(format!(
            "throats {}: the finest spacing is above depth/sqrt(12), {layer:.2e} m, the layer in which the flow slows down beside walls, so that the direct \
             conductance is too large by some percent; take more spacings across",
            coarse.join(", ")
        ));
    }
    found
}
