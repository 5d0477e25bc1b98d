//! The direct simulation of a comparison, from record to record.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use super::{CompareError, Grid, Pair, Record, Track};
use crate::case::network::state::NetworkState;
use crate::case::raw::RawPhase;
use crate::math::Vec2;
use crate::run::processor_time::ProcessorTime;
use crate::run::setup;
use crate::run::simulation::{Progress, Watcher};
use crate::snapshot::{Snapshot, Values};
use crate::solver::{Series, Solver};
use crate::sph::measures::open::PRESSURE_DIFFERENCE;

/// Number of the non-wetting phase in the field `phase`; the wetting one is 0.
const NON_WETTING: i64 = 1;
/// Number of wall particles.
const SOLID: i64 = 2;

/// Runs the direct simulation of a pair to its end.
pub fn track(
    pair: &Pair<'_>,
    (state, grid): (&NetworkState, &Grid),
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<Track, CompareError> {
    let (case, records) = (pair.direct, pair.records);
    let (clock, processor_time) = (Instant::now(), ProcessorTime::start());
    let mut solver = setup::build(case)?;
    let mut track = Track {
        records: Vec::new(),
        filled: vec![None; state.elements.len()],
        wall_time_s: 0.0,
        processor_time_s: None,
        unknowns: solver.statistics().unknowns,
        steps: 0,
        permeability: None,
        warnings: Vec::new(),
    };
    for record in 0..=records {
        let until = case.end * record as f64 / records as f64;
        while solver.time() < until {
            if interrupt.load(Ordering::Relaxed) {
                return Err(CompareError::Interrupted);
            }
            let step = solver.step(until)?;
            watcher.stepped(&Progress::after(solver.as_ref(), step, case.end));
        }
        track.add(&as_record(solver.as_ref(), grid, state.invading), grid);
    }
    track.wall_time_s = clock.elapsed().as_secs_f64();
    track.processor_time_s = processor_time.seconds();
    track.steps = solver.steps();
    let measures = solver.measures(&Series::default());
    let permeability = measures.iter().find(|it| it.name == "permeability-m2").map(|it| it.value);
    track.permeability = permeability.filter(|value| value.is_finite());
    track.warnings = setup::warnings(case, solver.as_ref(), &Series::default());
    Ok(track)
}

impl Track {
    /// Adds a record, and notes which elements are filled by more than half of their cells.
    fn add(&mut self, record: &Record, grid: &Grid) {
        let mut shares = vec![[0_usize; 2]; self.filled.len()];
        for (&(_, element), &invaded) in grid.cells.iter().zip(&record.invaded) {
            shares[element][usize::from(invaded)] += 1;
        }
        let number = self.records.len();
        for (filled, [without, with]) in self.filled.iter_mut().zip(shares) {
            if with > without {
                filled.get_or_insert(number);
            }
        }
        self.records.push(record.clone());
    }
}

fn as_record(solver: &dyn Solver, grid: &Grid, invading: RawPhase) -> Record {
    let sample = solver.sample();
    let value = |name: &str| sample.iter().find(|it| it.name == name).map_or(f64::NAN, |it| it.value);
    // Where the pressure rises in steps, it is the one given, of the invading phase less the other.
    let sign = if invading == RawPhase::NonWetting { 1.0 } else { -1.0 };
    let given = Some(sign * value(PRESSURE_DIFFERENCE)).filter(|pressure| pressure.is_finite());
    Record {
        saturation: value("saturation"),
        pressure: given.unwrap_or_else(|| value("capillary_pressure_Pa")),
        invaded: invaded(&solver.snapshot(), grid, invading),
    }
}

/// For each cell whether the nearest fluid particle is of the invading phase.
fn invaded(snapshot: &Snapshot<'_>, grid: &Grid, invading: RawPhase) -> Vec<bool> {
    let wanted = if invading == RawPhase::NonWetting { NON_WETTING } else { 0 };
    let phases = snapshot.particles.fields.iter().find(|field| field.name == "phase").map(|field| &field.values);
    let Some(Values::Integer(phases)) = phases else { return vec![false; grid.cells.len()] };
    let (cell, [columns, rows]) = (grid.cell(), grid.counts);
    let place = |x: Vec2| {
        let at = (x - grid.bounds.min).component_div(&cell);
        [at.x.floor() as i64, at.y.floor() as i64]
    };
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); columns * rows];
    for (a, &x) in snapshot.particles.points.iter().enumerate().filter(|(a, _)| phases[*a] != SOLID) {
        let [i, j] = place(x);
        if (0..columns as i64).contains(&i) && (0..rows as i64).contains(&j) {
            around[j as usize * columns + i as usize].push(a);
        }
    }
    let nearest = |x: Vec2| {
        let [i, j] = place(x);
        // Rings of cells around: one farther than the first that holds a particle, which may be nearer there.
        let mut found: Option<(f64, usize)> = None;
        let mut last = i64::from(u16::MAX);
        let mut ring = 0;
        while ring <= last && ring < (columns + rows) as i64 {
            for (di, dj) in square(ring) {
                let (i, j) = (i + di, j + dj);
                if !(0..columns as i64).contains(&i) || !(0..rows as i64).contains(&j) {
                    continue;
                }
                for &a in &around[j as usize * columns + i as usize] {
                    let distance = (snapshot.particles.points[a] - x).norm_squared();
                    if found.is_none_or(|(least, _)| distance < least) {
                        found = Some((distance, a));
                    }
                }
            }
            if found.is_some() && last == i64::from(u16::MAX) {
                last = ring + 1;
            }
            ring += 1;
        }
        found.is_some_and(|(_, a)| phases[a] == wanted)
    };
    grid.cells.iter().map(|&(cell, _)| nearest(grid.middle(cell))).collect()
}

/// The places of a ring of squares around a square.
fn square(ring: i64) -> impl Iterator<Item = (i64, i64)> {
    (-ring..=ring)
        .flat_map(move |j| (-ring..=ring).map(move |i| (i, j)))
        .filter(move |(i, j)| i.abs().max(j.abs()) == ring)
}
