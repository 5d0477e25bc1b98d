//! Checks of `[time]`, `[output]` and `[[expect]]` against the model of the case.

use super::case_file::{Model, RawCase};
use super::measure_groups::Offer;
use super::measures::{offers, unmeasured};
use super::network::NetworkDisplacement;
use super::output::{Compression, Expectation, Output, RawExpectation};
use super::steady::{FEWEST_ROWS, SteadyStop, WINDOWS};
use meniscus_core::input::{Checker, Problem};
use meniscus_core::math::{rounded_down, rounded_up};
use meniscus_geometry::spec::GeometrySpec;

/// Most records of one kind: more files than a folder should hold.
const MOST_RECORDS: f64 = 1.0e5;

/// Most nodes of the grid of the output, which has about 25 numbers per node: as many as particles in the largest direct simulation.
const MOST_NODES: f64 = 2.0e7;

/// Default number of records of a run.
const VTK_RECORDS: f64 = 50.0;
const SERIES_RECORDS: f64 = 200.0;
const RESTART_RECORDS: f64 = 10.0;

/// Whether the clock of the case is the displaced pore volume.
fn is_quasi_static(raw: &RawCase) -> bool {
    raw.network.as_ref().is_some_and(|network| network.dynamic.is_none())
}

/// The end of the simulation in s; for a quasi-static network the largest displacement in pore volumes.
pub(super) fn end(checker: &mut Checker, raw: &RawCase, model: Option<&Model>) -> Option<f64> {
    if is_quasi_static(raw) {
        if raw.time.is_some() {
            checker.refuse(
                "time",
                "a quasi-static displacement has no time: its clock is the displaced pore volume",
                "leave out [time]; the displacement ends when it is complete, or by [network.stop]; [network.dynamic] makes it time-dependent",
            );
        }
        let Some(Model::Network(network)) = model else { return None };
        // Films continue to the last pressure after the displacement is complete.
        const BEYOND: f64 = 1e-9;
        // No half cycle can displace more than the whole pore space.
        let end = |it: &NetworkDisplacement| {
            f64::from(it.process.half_cycles()) * if it.has_films() { 1.0 + BEYOND } else { 1.0 }
        };
        return Some(network.displacement.as_ref().map_or(0.0, end));
    }
    let end = raw.time.as_ref().and_then(|time| time.end);
    checker.require("time.end", end, "end = 0.01 # s")
}

/// What is written and when; `end` and `size`, width and height of the domain in spacings, are missing if they were wrong.
pub(super) fn output(checker: &mut Checker, raw: &mut RawCase, end: Option<f64>, size: Option<[f64; 2]>) -> Output {
    let by_volume = is_quasi_static(raw);
    let output = raw.output.get_or_insert_default();
    let ratio = output.grid.as_ref().and_then(|grid| grid.ratio);
    if raw.network.is_none() {
        output.grid.get_or_insert_default().ratio.get_or_insert(1.0);
    } else if output.grid.is_some() {
        checker.refuse("output.grid", "a network has no grid", "leave this out");
    }
    if let (Some(ratio), Some(size)) = (ratio, size) {
        grid(checker, ratio, size);
    }
    // In a network, each half cycle has as many records as another run.
    let end = if by_volume { end.map(|end| (end, end.max(1.0))) } else { end.map(|end| (end, 1.0)) };
    let clock = if by_volume { &VOLUME } else { &TIME };
    let mut every = |table, [time, volume]: [&mut Option<f64>; 2], records| {
        let (given, other) = if by_volume { (volume, time) } else { (time, volume) };
        *given.insert(every(checker, clock, table, [*given, *other], end, records))
    };
    let vtk = output.vtk.get_or_insert_default();
    let series = output.series.get_or_insert_default();
    let restart = output.restart.get_or_insert_default();
    Output {
        vtk_every: every("output.vtk", [&mut vtk.every_time, &mut vtk.every_pore_volume], VTK_RECORDS),
        vtk_compression: *vtk.compression.get_or_insert(Compression::Zlib),
        series_every: every("output.series", [&mut series.every_time, &mut series.every_pore_volume], SERIES_RECORDS),
        restart_every: every(
            "output.restart",
            [&mut restart.every_time, &mut restart.every_pore_volume],
            RESTART_RECORDS,
        ),
        grid_ratio: ratio.unwrap_or(1.0),
    }
}

/// Refuses a grid of too many nodes, and one without a cell along a side of the domain.
fn grid(checker: &mut Checker, ratio: f64, [width, height]: [f64; 2]) {
    let nodes = width * height / (ratio * ratio);
    if nodes > MOST_NODES {
        checker.refuse(
            "output.grid.ratio",
            format!(
                "a ratio of {ratio:?} gives a grid of {nodes:.1e} nodes in each record, more than {MOST_NODES:.0e}"
            ),
            format!("a ratio of {:.2} or more would do", (width * height / MOST_NODES).sqrt() + 0.005),
        );
    }
    let largest = width.min(height);
    // The domain is an integer number of spacings up to rounding.
    if ratio > largest * (1.0 + 1e-9) {
        checker.refuse(
            "output.grid.ratio",
            format!(
                "the nodes of the grid would be {ratio:?} spacings apart, and the domain is {largest:.1} spacings wide"
            ),
            "leave the ratio out, or take a smaller one",
        );
    }
}

/// Unit and keys of the intervals between records.
struct RecordClock {
    key: &'static str,
    other: &'static str,
    what: &'static str,
    unit: &'static str,
}

const TIME: RecordClock =
    RecordClock { key: "every-time", other: "every-pore-volume", what: "a time in s", unit: " s" };

const VOLUME: RecordClock = RecordClock {
    key: "every-pore-volume",
    other: "every-time",
    what: "a number of displaced pore volumes",
    unit: " pore volumes",
};

/// The interval between records, from the values of its key and of the key of the other clock; `end` is that of the run and the number of its parts with
/// `records` each.
fn every(
    checker: &mut Checker,
    clock: &RecordClock,
    table: &str,
    [given, other]: [Option<f64>; 2],
    end: Option<(f64, f64)>,
    records: f64,
) -> f64 {
    let path = format!("{table}.{}", clock.key);
    let (end_or_one, parts) = end.unwrap_or((1.0, 1.0));
    let default = if end_or_one > 0.0 { end_or_one / (records * parts) } else { 1.0 / records };
    let path_of_other = format!("{table}.{}", clock.other);
    if checker.is_given(&path_of_other, other.as_ref()) {
        checker.refuse(
            path_of_other,
            format!("the records of this case cannot be scheduled by `{}`", clock.other),
            format!("write {} = ... # {}", clock.key, clock.what),
        );
    }
    let Some(interval) = given else { return default };
    let Some((end, _)) = end else { return interval };
    let (count, unit) = (end / interval, clock.unit);
    if count > MOST_RECORDS {
        checker.refuse(
            path,
            format!("{interval:?}{unit} would give {count:.0} records until the end at {end:?}{unit}, more than {MOST_RECORDS:.0}"),
            format!("write every {:.2e}{unit} or less often", end / MOST_RECORDS),
        );
    }
    interval
}

/// The complete expectations; `model` and `geometry` are missing if they were wrong.
pub(super) fn expectations(
    checker: &mut Checker,
    raw: &mut RawCase,
    model: Option<&Model>,
    geometry: Option<&GeometrySpec>,
) -> Vec<Expectation> {
    let is_steady = raw.time.as_ref().is_some_and(|time| time.steady.is_some());
    let offers = model.map(|model| offers(model, geometry, is_steady));
    let raw = raw.expect.get_or_insert_default().iter().enumerate();
    let offers = model.zip(offers.as_deref()).map(|(model, offers)| (model.table(), offers));
    let one = |(index, raw)| expectation(checker, &format!("expect[{index}]"), raw, offers);
    raw.filter_map(one).collect()
}

/// One of them; `offers` are the table of the model and the measures of all models.
fn expectation(
    checker: &mut Checker,
    at: &str,
    raw: &RawExpectation,
    offers: Option<(&'static str, &[Offer])>,
) -> Option<Expectation> {
    match (raw.measure.as_deref(), offers) {
        (Some(name), _) if name.trim().is_empty() => {
            checker.refuse(format!("{at}.measure"), "expected the name of a measure, found nothing", "");
        }
        (Some(name), Some((table, offers))) => {
            if let Some((message, help)) = unmeasured(name, offers) {
                let problem = Problem::new(format!("{at}.measure"), message, help);
                // What is wrong in the table of the model may be what gives the measure.
                let given_elsewhere = offers.iter().any(|offer| offer.names.contains(&name));
                checker.problems.push(if given_elsewhere { problem.caused_by(table) } else { problem });
            }
        }
        _ => {}
    }
    Some(Expectation { measure: raw.measure.clone()?, value: raw.value?, tolerance: raw.tolerance? })
}

/// Checks `[time.steady]`; `end` in s is missing if it was wrong.
pub(super) fn steady(
    checker: &mut Checker,
    raw: &mut RawCase,
    end: Option<f64>,
    output: &Output,
) -> Option<SteadyStop> {
    let given = &mut raw.time.as_mut()?.steady;
    let steady = given.as_mut()?;
    if raw.sph.is_none() {
        if raw.network.is_none() {
            checker.refuse(
                "time.steady",
                "only [sph] detects a steady state",
                "leave this out; the run ends at time.end",
            );
        }
        *given = None;
        return None;
    }
    let default = SteadyStop::default();
    let found = SteadyStop {
        window: steady.window,
        contact_angle: steady.contact_angle_deg.get_or_insert(default.contact_angle.to_degrees()).to_radians(),
        capillary_pressure: *steady.capillary_pressure.get_or_insert(default.capillary_pressure),
        saturation: *steady.saturation.get_or_insert(default.saturation),
        capillary_number: *steady.capillary_number.get_or_insert(default.capillary_number),
        kinetic_energy: *steady.kinetic_energy.get_or_insert(default.kinetic_energy),
        stop: *steady.stop.get_or_insert(default.stop),
    };
    if let (Some(window), Some(end)) = (steady.window, end) {
        check_window(checker, window, end, output.series_every);
    }
    Some(found)
}

/// Three windows must fit into the run, and enough rows of the series into a window.
fn check_window(checker: &mut Checker, window: f64, end: f64, series_every: f64) {
    if WINDOWS * window > end {
        checker.refuse(
            "time.steady.window",
            format!("three windows of {window:?} s do not fit into a run of {end:?} s"),
            format!("a window of {:.2e} s or less would do, or leave the key out", rounded_down(end / WINDOWS)),
        );
    } else if window < FEWEST_ROWS * series_every {
        checker.refuse(
            "time.steady.window",
            format!(
                "a window of {window:?} s holds fewer than {FEWEST_ROWS} rows of the series, one in {series_every:?} s"
            ),
            format!(
                "a window of {:.2e} s or more would do, or a row of the series every {:.2e} s",
                rounded_up(FEWEST_ROWS * series_every),
                rounded_down(window / FEWEST_ROWS)
            ),
        );
    }
}
