//! The data of the page as JSON.
//!
//! Coordinates are integers of 16 bits: a corner of the drawing plus a step of the longer side over 65535.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::columns::{Columns, Packed, columns};
use meniscus_core::diagram::{Color, Through, colors};
use meniscus_core::playback::{Change, Edge, Holding, Playback, PlayedFilms, Stage};
use serde::Serialize;

/// In place of the angle of an edge that is no wall.
const NO_WALL: i16 = i16::MIN;

/// The largest angle, half a turn, as an integer.
const HALF_TURN: f64 = 32_000.0;

#[derive(Serialize)]
struct Data<'a> {
    title: &'a str,
    colors: BTreeMap<&'static str, Vec<String>>,
    runs: Vec<Run<'a>>,
}

#[derive(Serialize)]
struct Run<'a> {
    title: &'a str,
    /// Lower left and upper right corner in m.
    bounds: [[f64; 2]; 2],
    periodic: [bool; 2],
    /// Depth of the chip in m.
    depth: Option<f64>,
    /// The position in m that the coordinates (0, 0) stand for, and the step.
    origin: [f64; 2],
    step: f64,
    areas: Columns,
    passages: Columns,
    pores: Columns,
    throats: Columns,
    events: Columns,
    curve: Option<Columns>,
    stages: Vec<StageOfRun<'a>>,
    changes: Columns,
    films: Option<Columns>,
}

#[derive(Serialize)]
struct StageOfRun<'a> {
    name: &'a str,
    first: usize,
    wetting_invades: bool,
    /// `in`, `out` or nothing at the left, right, bottom and top side.
    open: [&'static str; 4],
    /// Row at which the invading phase is at the outlet.
    breakthrough: Option<usize>,
}

/// The data of named runs.
pub(super) fn json(title: &str, runs: &[(&str, &Playback)]) -> String {
    let runs = runs.iter().map(|(title, playback)| run(title, playback)).collect();
    // Writing numbers, text and lists cannot fail.
    serde_json::to_string(&Data { title, colors: all_colors(), runs }).unwrap_or_default()
}

fn all_colors() -> BTreeMap<&'static str, Vec<String>> {
    let one = |name, color: Color| (name, vec![css(color)]);
    let many = |name, bar: &[Color]| (name, bar.iter().map(|&color| css(color)).collect());
    BTreeMap::from([
        one("wetting", colors::WETTING),
        one("wetting_trapped", colors::WETTING_TRAPPED),
        one("wetting_before", colors::WETTING_BEFORE),
        many("wetting_in_order", colors::WETTING_IN_ORDER),
        one("non_wetting", colors::NON_WETTING),
        one("non_wetting_trapped", colors::NON_WETTING_TRAPPED),
        one("non_wetting_before", colors::NON_WETTING_BEFORE),
        many("non_wetting_in_order", colors::NON_WETTING_IN_ORDER),
        one("solid", colors::SOLID),
        one("wall", colors::WALL),
        one("meniscus", colors::MENISCUS),
        one("mark", colors::MARK),
    ])
}

fn css([red, green, blue]: Color) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Positions as integers.
struct Grid {
    origin: [f64; 2],
    step: f64,
}

impl Grid {
    fn around(points: impl Iterator<Item = [f64; 2]>) -> Self {
        let mut ends = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for point in points {
            for axis in 0..2 {
                ends[0][axis] = ends[0][axis].min(point[axis]);
                ends[1][axis] = ends[1][axis].max(point[axis]);
            }
        }
        let longest = (ends[1][0] - ends[0][0]).max(ends[1][1] - ends[0][1]);
        Self { origin: ends[0], step: longest / f64::from(u16::MAX) }
    }

    /// A column of coordinates along an axis. The type is that of all, so that it does not depend on their size.
    fn column(&self, axis: usize, points: impl Iterator<Item = [f64; 2]>) -> Packed {
        Packed::counts(points.map(|point| ((point[axis] - self.origin[axis]) / self.step).round() as usize))
    }
}

fn run<'a>(title: &'a str, playback: &'a Playback) -> Run<'a> {
    let edges = || playback.areas.iter().flat_map(|area| &area.boundary);
    let starts = || edges().map(|edge| edge.start);
    let corners = playback.frame.bounds.into_iter();
    let grid = Grid::around(starts().chain(playback.passages.iter().flat_map(|it| it.ends)).chain(corners));
    let areas = Columns::from([
        ("edges", Packed::counts(playback.areas.iter().map(|area| area.boundary.len()))),
        ("x", grid.column(0, starts())),
        ("y", grid.column(1, starts())),
        ("sweep", Packed::short(edges().map(sweep))),
        ("pore", Packed::counts(playback.areas.iter().map(|area| area.pore))),
        ("area_m2", Packed::numbers(playback.areas.iter().map(|area| area.area))),
    ]);
    let end = |end: usize, axis: usize| grid.column(axis, playback.passages.iter().map(move |it| it.ends[end]));
    let passages = Columns::from([
        ("one", Packed::counts(playback.passages.iter().map(|it| it.areas[0]))),
        ("other", Packed::counts(playback.passages.iter().map(|it| it.areas[1]))),
        ("throat", Packed::indices(playback.passages.iter().map(|it| it.throat))),
        ("x1", end(0, 0)),
        ("y1", end(0, 1)),
        ("x2", end(1, 0)),
        ("y2", end(1, 1)),
    ]);
    Run {
        title,
        bounds: playback.frame.bounds,
        periodic: playback.frame.periodic,
        depth: playback.depth,
        origin: grid.origin,
        step: grid.step,
        areas,
        passages,
        pores: columns(&playback.pores),
        throats: columns(&playback.throats),
        events: columns(&playback.events),
        curve: playback.curve.as_ref().map(columns),
        stages: playback.stages.iter().map(stage).collect(),
        changes: changes(&playback.changes),
        films: playback.films.as_ref().map(films),
    }
}

fn sweep(edge: &Edge) -> i16 {
    // At most half a turn, so within the range.
    if edge.is_wall { (edge.sweep / PI * HALF_TURN).round() as i16 } else { NO_WALL }
}

fn stage(stage: &Stage) -> StageOfRun<'_> {
    let word = |open| match open {
        Some(Through::In) => "in",
        Some(Through::Out) => "out",
        None => "",
    };
    StageOfRun {
        name: &stage.name,
        first: stage.first,
        wetting_invades: stage.wetting_invades,
        open: stage.open.map(word),
        breakthrough: stage.breakthrough,
    }
}

fn films(films: &PlayedFilms) -> Columns {
    let numbers = |values: &[f64]| Packed::numbers(values.iter().copied());
    Columns::from([
        ("width", numbers(&films.widths)),
        ("part", Packed::counts(films.parts.iter().copied())),
        ("largest", numbers(&films.largest)),
        ("head", numbers(&films.heads)),
        ("curvature", numbers(&films.curvatures)),
        ("kept_row", Packed::counts(films.kept.iter().map(|kept| kept.row as usize))),
        ("kept_area", Packed::counts(films.kept.iter().map(|kept| kept.area as usize))),
        ("kept_part", Packed::counts(films.kept.iter().map(|kept| kept.part as usize))),
        ("kept_curvature", Packed::numbers(films.kept.iter().map(|kept| kept.curvature))),
    ])
}

/// Changes with the number of rows since the last one.
fn changes(changes: &[Change]) -> Columns {
    let before = std::iter::once(0).chain(changes.iter().map(|change| change.row));
    let steps = changes.iter().zip(before).map(|(change, before)| change.row.saturating_sub(before) as usize);
    let number = |holding| match holding {
        Holding::Defending => 0,
        Holding::Trapped => 1,
        Holding::Before => 2,
        Holding::Invaded => 3,
    };
    Columns::from([
        ("rows", Packed::counts(steps)),
        ("area", Packed::counts(changes.iter().map(|change| change.area as usize))),
        ("holding", Packed::counts(changes.iter().map(|change| number(change.holding)))),
    ])
}
