//! Checks of a case: end, output, expectations.

use super::checked::{Compression, Expectation, Model, Output};
use super::measures::{Offer, offers, unmeasured};
use super::raw::{RawCase, RawCompression, RawEvery, RawExpectation};
use crate::geometry::spec::GeometrySpec;
use crate::input::Checker;

/// Most records of one kind: more files than a folder should hold.
const MOST_RECORDS: f64 = 1.0e5;

/// Most nodes of the grid of the output, which has some 25 numbers in each: as many as particles in the largest direct simulation.
const MOST_NODES: f64 = 2.0e7;

/// End times in s: beyond these the schedule would lose its digits.
const END_RANGE: (f64, f64) = (1.0e-15, 1.0e9);

/// Records of a run where the case says nothing.
const VTK_RECORDS: f64 = 50.0;
const SERIES_RECORDS: f64 = 200.0;
const RESTART_RECORDS: f64 = 10.0;

/// Whether the clock of the case counts displaced pore volumes.
fn is_quasi_static(raw: &RawCase) -> bool {
    raw.network.as_ref().is_some_and(|network| network.dynamic.is_none())
}

/// The end of the simulation in s; of a quasi-static network the most that it can displace, in pore volumes.
pub(super) fn end(checker: &mut Checker, raw: &RawCase, model: Option<&Model>) -> Option<f64> {
    if is_quasi_static(raw) {
        if raw.time.is_some() {
            checker.refuse(
                "time",
                "a quasi-static displacement has no time: its clock is the displaced pore volume",
                "leave out [time]; the displacement ends by itself, or where [network.stop] says; [network.dynamic] makes it one in time",
            );
        }
        let Some(Model::Network(network)) = model else { return None };
        // No half cycle can displace more than the whole pore space.
        let half_cycles = network.displacement.as_ref().map_or(0, |displacement| displacement.process.half_cycles());
        return Some(f64::from(half_cycles));
    }
    let end = raw.time.as_ref().and_then(|time| time.end);
    let end = checker.require_positive("time.end", end, "end = 0.01 # s", "an end time in s");
    checker.within("time.end", end, END_RANGE, "an end time in s")
}

/// What is written and when; `end` and `size`, width and height of the domain in spacings, are missing where they were wrong.
pub(super) fn output(checker: &mut Checker, raw: &RawCase, end: Option<f64>, size: Option<[f64; 2]>) -> Output {
    let output = raw.output.clone().unwrap_or_default();
    let by_volume = is_quasi_static(raw);
    let ratio = output.grid.as_ref().and_then(|grid| grid.ratio);
    if raw.network.is_some() && output.grid.is_some() {
        checker.refuse("output.grid", "a network has no grid", "leave this out");
    }
    let ratio = checker.within("output.grid.ratio", ratio, (0.25, 100.0), "grid distance over particle spacing");
    if let (Some(ratio), Some(size)) = (ratio, size) {
        grid(checker, ratio, size);
    }
    // Of a network, each half cycle has as many records as another run.
    let end = if by_volume { end.map(|end| (end, end.max(1.0))) } else { end.map(|end| (end, 1.0)) };
    let clock = if by_volume { &VOLUME } else { &TIME };
    let vtk = output
        .vtk
        .as_ref()
        .map(|vtk| RawEvery { every_time: vtk.every_time, every_pore_volume: vtk.every_pore_volume });
    let mut every = |table, raw, records| every(checker, clock, (table, raw), end, records);
    Output {
        vtk_every: every("output.vtk", vtk.as_ref(), VTK_RECORDS),
        vtk_compression: match output.vtk.as_ref().and_then(|vtk| vtk.compression) {
            None | Some(RawCompression::Zlib) => Compression::Zlib,
            Some(RawCompression::None) => Compression::None,
            Some(RawCompression::Lz4) => Compression::Lz4,
        },
        series_every: every("output.series", output.series.as_ref(), SERIES_RECORDS),
        restart_every: every("output.restart", output.restart.as_ref(), RESTART_RECORDS),
        grid_ratio: ratio.unwrap_or(1.0),
    }
}

/// Refuses a grid of too many nodes, and one that has no cell along a side of the domain.
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
    // The domain is a whole number of spacings up to rounding.
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

/// How intervals between records are written.
struct RecordClock {
    key: &'static str,
    other: &'static str,
    value: fn(&RawEvery) -> [Option<f64>; 2],
    what: &'static str,
    unit: &'static str,
}

const TIME: RecordClock = RecordClock {
    key: "every-time",
    other: "every-pore-volume",
    value: |raw| [raw.every_time, raw.every_pore_volume],
    what: "a time in s",
    unit: " s",
};

const VOLUME: RecordClock = RecordClock {
    key: "every-pore-volume",
    other: "every-time",
    value: |raw| [raw.every_pore_volume, raw.every_time],
    what: "a number of displaced pore volumes",
    unit: " pore volumes",
};

/// The interval between records; `end` is that of the run and the number of its parts with `records` each.
fn every(
    checker: &mut Checker,
    clock: &RecordClock,
    (table, raw): (&str, Option<&RawEvery>),
    end: Option<(f64, f64)>,
    records: f64,
) -> f64 {
    let path = format!("{table}.{}", clock.key);
    let (end_or_one, parts) = end.unwrap_or((1.0, 1.0));
    let default = if end_or_one > 0.0 { end_or_one / (records * parts) } else { 1.0 / records };
    let [given, other] = raw.map_or([None; 2], clock.value);
    if other.is_some() {
        checker.refuse(
            format!("{table}.{}", clock.other),
            format!("the records of this case are not counted by `{}`", clock.other),
            format!("write {} = ... # {}", clock.key, clock.what),
        );
    }
    let Some(interval) = checker.positive(&path, given, clock.what) else { return default };
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

/// The expectations that are whole; `model` and `geometry` are missing where they were wrong.
pub(super) fn expectations(
    checker: &mut Checker,
    raw: &RawCase,
    model: Option<&Model>,
    geometry: Option<&GeometrySpec>,
) -> Vec<Expectation> {
    let is_steady = raw.time.as_ref().is_some_and(|time| time.steady.is_some());
    let offers = model.map(|model| offers(model, geometry, is_steady));
    let raw = raw.expect.iter().flatten().enumerate();
    let one = |(index, raw)| expectation(checker, &format!("expect[{index}]"), raw, offers.as_deref());
    raw.filter_map(one).collect()
}

fn expectation(checker: &mut Checker, at: &str, raw: &RawExpectation, offers: Option<&[Offer]>) -> Option<Expectation> {
    let measure = checker.require(&format!("{at}.measure"), raw.measure.clone(), "measure = \"contact-angle-deg\"");
    let value = checker.require(&format!("{at}.value"), raw.value, "value = 40.0");
    let path = format!("{at}.tolerance");
    let tolerance = checker.require_positive(&path, raw.tolerance, "tolerance = 3.0", "a tolerance");
    match (measure.as_deref(), offers) {
        (Some(name), _) if name.trim().is_empty() => {
            checker.refuse(format!("{at}.measure"), "expected the name of a measure, found nothing", "");
        }
        (Some(name), Some(offers)) => {
            if let Some((message, help)) = unmeasured(name, offers) {
                checker.refuse(format!("{at}.measure"), message, help);
            }
        }
        _ => {}
    }
    Some(Expectation { measure: measure?, value: value?, tolerance: tolerance? })
}
