//! A displacement as it is played: the events of the table, and at the end what the picture shows.

use crate::cases::{loaded, named, to_the_end};
use meniscus::run::setup;
use meniscus_core::diagram::{RegionMap, Tone};
use meniscus_core::playback::{Holding, Playback};
use meniscus_core::solver::Solver;
use meniscus_core::table::Table;

/// What an area holds at the end, with the row since which it does.
fn at_the_end(playback: &Playback) -> Vec<(Holding, usize)> {
    let mut held = vec![(Holding::Defending, 0); playback.areas.len()];
    let mut stages = playback.stages[1..].iter().peekable();
    for change in &playback.changes {
        let row = change.row as usize;
        if stages.next_if(|stage| stage.first <= row).is_some() {
            held.fill((Holding::Defending, row));
        }
        held[change.area as usize] = (change.holding, row);
    }
    held
}

/// The displaced share of the pore space after each row of the last half cycle.
fn displaced(playback: &Playback) -> Vec<f64> {
    let all: f64 = playback.areas.iter().map(|area| area.area).sum();
    let (rows, first) = (playback.events.columns[0].cells.len(), playback.stages.last().unwrap().first);
    let after = |row: usize| {
        let until = |change: &&meniscus_core::playback::Change| {
            change.holding == Holding::Invaded && (first..=row).contains(&(change.row as usize))
        };
        playback.changes.iter().filter(until).map(|it| playback.areas[it.area as usize].area).sum::<f64>() / all
    };
    (0..rows).map(|row| if row < first { f64::NAN } else { after(row) }).collect()
}

fn events(solver: &dyn Solver) -> Table {
    solver.results().tables.into_iter().map(|made| made()).find(|table| table.name == "events").unwrap()
}

fn check_of_events(playback: &Playback, table: &Table) {
    for column in &playback.events.columns {
        let same = table.columns.iter().find(|it| it.name == column.name).unwrap();
        // Missing values are not equal to themselves.
        assert_eq!(format!("{:?}", column.cells), format!("{:?}", same.cells), "{}", column.name);
    }
}

fn check_of_areas(playback: &Playback, map: &RegionMap, shares: Option<&[f64]>) {
    assert_eq!(playback.areas.len(), map.areas.len());
    for (index, ((holding, row), area)) in at_the_end(playback).into_iter().zip(&map.areas).enumerate() {
        match (holding, area.tone) {
            (Holding::Invaded, Tone::Value(value)) => {
                let exact = shares.map_or(value, |shares| shares[row]);
                assert!((value - exact).abs() < 1e-12, "area {index}: {value} and {exact}");
            }
            (Holding::Defending, Tone::Class(0))
            | (Holding::Trapped, Tone::Class(1))
            | (Holding::Before, Tone::Class(2)) => {}
            // Menisci bulge into more than half of what no event has entered.
            (Holding::Defending | Holding::Trapped, Tone::Class(2)) if shares.is_none() => {}
            (holding, tone) => panic!("area {index}: {holding:?} and {tone:?}"),
        }
    }
}

#[test]
fn the_last_event_leaves_what_the_picture_shows() {
    for (name, set) in [
        ("drainage", &[][..]),
        ("cycle", &[]),
        ("films", &[]),
        ("films", &["network.films=\"joined\""]),
        ("films", &["network.process=\"drainage\"", "network.stop.capillary-pressure=8000"]),
    ] {
        let solver = to_the_end(&loaded(&named(name), set));
        let playback = solver.playback().unwrap();
        check_of_events(&playback, &events(solver.as_ref()));
        check_of_areas(&playback, &solver.region_map().unwrap(), Some(&displaced(&playback)));
    }
}

#[test]
fn a_displacement_in_time_ends_as_the_picture_shows() {
    for name in ["dynamic", "spontaneous-imbibition"] {
        let mut solver = setup::build(&loaded(&named(name), &[]).case).unwrap();
        while !solver.is_done() {
            solver.step(solver.time() + 0.01).unwrap();
        }
        let playback = solver.playback().unwrap();
        check_of_events(&playback, &events(solver.as_ref()));
        check_of_areas(&playback, &solver.region_map().unwrap(), None);
    }
}

#[test]
fn boundaries_close_and_enclose_their_areas() {
    let playback = to_the_end(&loaded(&named("drainage"), &[])).playback().unwrap();
    for area in &playback.areas {
        let next = area.boundary.iter().cycle().skip(1);
        let part = |(edge, next): (&meniscus_core::playback::Edge, &meniscus_core::playback::Edge)| {
            let ([ax, ay], [bx, by], angle) = (edge.start, next.start, edge.sweep);
            // The triangle with the origin, and the segment of the circle beyond the chord.
            let radius = if angle == 0.0 { 0.0 } else { 0.5 * (bx - ax).hypot(by - ay) / (0.5 * angle).sin().abs() };
            0.5 * (ax * by - ay * bx) + 0.5 * radius * radius * (angle - angle.sin())
        };
        let enclosed: f64 = area.boundary.iter().zip(next).map(part).sum();
        assert!((enclosed.abs() / area.area - 1.0).abs() < 1e-9, "{enclosed} and {}", area.area);
    }
}

#[test]
fn films_have_a_width_by_edge_and_a_curvature_by_row() {
    let playback = to_the_end(&loaded(&named("films"), &[])).playback().unwrap();
    let films = playback.films.as_ref().unwrap();
    let edges: usize = playback.areas.iter().map(|area| area.boundary.len()).sum();
    assert_eq!((films.widths.len(), films.parts.len()), (edges, edges));
    assert_eq!((films.largest.len(), films.heads.len()), (playback.areas.len(), playback.areas.len()));
    let walls = playback.areas.iter().flat_map(|area| &area.boundary).map(|edge| edge.is_wall);
    assert!(walls.zip(&films.widths).all(|(is_wall, width)| is_wall == (*width > 0.0)));
    let rows = playback.events.columns[0].cells.len();
    assert_eq!(films.curvatures.len(), rows);
    assert!(films.kept.iter().all(|kept| (kept.row as usize) < rows) && !films.kept.is_empty());
}
