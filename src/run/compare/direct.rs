//! The direct simulation of a comparison: an ordinary run in its own folder, each record of which is compared with the network.

use std::sync::atomic::AtomicBool;

use super::comparison::Side;
use super::pair::{CompareError, Task};
use super::states::States;
use super::track::{Grid, Record, Track};
use crate::run::execute::{Job, Mode, RunError, case_hash, execute};
use crate::run::folder;
use crate::run::folder_error::FolderError;
use crate::run::report::{Report, Status};
use crate::run::setup;
use crate::run::simulation::{Progress, Watcher};
use meniscus_case::network::state::NetworkState;
use meniscus_case::{Case, FluidPhase};
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{Snapshot, Values};
use meniscus_core::solver::Solver;
use meniscus_output::FileError;
use meniscus_sph::measures::open::{DRIVING_PRESSURE, PRESSURE_DIFFERENCE};

/// Number of the non-wetting phase in the field `phase`; the wetting one is 0.
const NON_WETTING: i64 = 1;
/// Number of wall particles.
const SOLID: i64 = 2;
/// Subfolder of the run in that of the comparison.
pub(crate) const RUN: &str = "direct";

/// Runs the direct simulation of a task to its end, or resumes it.
pub(crate) fn track(
    task: &Task<'_>,
    state: &NetworkState,
    grid: &Grid,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<Track, CompareError> {
    let case = recorded(task.pair.direct, task.pair.records);
    let folder = task.folder.join(RUN);
    let (mut solver, states) = match task.mode {
        Mode::New => (setup::build(&case)?, States::new(task.folder)),
        Mode::Resume => {
            let (saved, _claim) = folder::resume(&folder, case_hash(&case)?).map_err(RunError::from)?;
            let states = States::up_to(saved.time, task.folder, grid);
            let states = states.map_err(|error| RunError::from(FolderError::Damaged { error }))?;
            (setup::build_to_resume(&case)?, states)
        }
    };
    let drive = if task.pair.is_in_time() { DRIVING_PRESSURE } else { PRESSURE_DIFFERENCE };
    let mut recorder = Recorder { watcher, states, grid, invading: state.invading, drive };
    let job = Job { case: &case, resolved: task.resolved, folder, mode: task.mode };
    let report = execute(&job, solver.as_mut(), interrupt, &mut recorder)?.report;
    match report.status {
        Status::Interrupted => return Err(CompareError::Interrupted),
        Status::Failed => return Err(CompareError::Failed(report.error.unwrap_or_default())),
        Status::Done | Status::ExpectationFailed => {}
    }
    let breakthrough = task.pair.is_in_time().then(|| breakthrough(&report)).flatten();
    let filled = vec![None; state.elements.len()];
    let mut track = Track { filled, breakthrough, totals: totals(report), ..Track::default() };
    for record in recorder.states.records {
        // Elements are filled that the invading phase holds in more than half of their cells.
        let mut shares = vec![[0_usize; 2]; state.elements.len()];
        for (&(_, element), &invaded) in grid.cells.iter().zip(&record.invaded) {
            shares[element][usize::from(invaded)] += 1;
        }
        track.add(record, |element| shares[element][1] > shares[element][0]);
    }
    Ok(track)
}

/// Time of breakthrough in s, and the saturation of the invading phase then.
fn breakthrough(report: &Report) -> Option<[f64; 2]> {
    let value = |name: &str| report.measures.get(name).and_then(|reading| reading.value);
    Some([value("breakthrough-time-s")?, value("saturation-at-breakthrough")?])
}

/// The case with `records` rows of its series: each is a compared state.
fn recorded(case: &Case, records: usize) -> Case {
    let mut case = case.clone();
    case.output.series_every = case.end / records as f64;
    case
}

/// Stores the state at each record, and passes each step on to another watcher.
struct Recorder<'a> {
    watcher: &'a mut dyn Watcher,
    states: States,
    grid: &'a Grid,
    invading: FluidPhase,
    /// Column of the driving pressure, if the case has it.
    drive: &'static str,
}

impl Watcher for Recorder<'_> {
    fn stepped(&mut self, progress: &Progress) {
        self.watcher.stepped(progress);
    }

    fn recorded(&mut self, solver: &dyn Solver) -> Result<(), FileError> {
        self.states.add(as_record(solver, self.grid, self.invading, self.drive))
    }
}

/// The cost of the simulation, its permeability and its warnings.
fn totals(report: Report) -> Side {
    Side {
        wall_time_s: report.wall_time_s.total,
        processor_time_s: report.cpu_s,
        unknowns: report.solver.unknowns,
        steps: report.steps,
        permeability_m2: report.measures.get("permeability-m2").and_then(|reading| reading.value),
        warnings: report.warnings,
        ..Side::default()
    }
}

fn as_record(solver: &dyn Solver, grid: &Grid, invading: FluidPhase, drive: &str) -> Record {
    let sample = solver.sample();
    let value = |name: &str| sample.iter().find(|it| it.name == name).map_or(f64::NAN, |it| it.value);
    // If the pressure rises in steps, it is the prescribed one, of the invading phase minus the other.
    let sign = if invading == FluidPhase::NonWetting || drive == DRIVING_PRESSURE { 1.0 } else { -1.0 };
    let given = Some(sign * value(drive)).filter(|pressure| pressure.is_finite());
    Record {
        time: solver.time(),
        saturation: value("saturation"),
        pressure: given.unwrap_or_else(|| value("capillary_pressure_Pa")),
        invaded: invaded(&solver.snapshot(), grid, invading),
    }
}

/// For each cell, whether the nearest fluid particle is of the invading phase.
fn invaded(snapshot: &Snapshot<'_>, grid: &Grid, invading: FluidPhase) -> Vec<bool> {
    let wanted = if invading == FluidPhase::NonWetting { NON_WETTING } else { 0 };
    let phases = snapshot.particles.fields.iter().find(|field| field.name == "phase").map(|field| &field.values);
    let Some(Values::Integer(phases)) = phases else { return vec![false; grid.cells.len()] };
    let (cell, [columns, rows]) = (grid.cell(), grid.counts);
    let cell_at = |x: Vec2| {
        let at = (x - grid.bounds.min).component_div(&cell);
        [at.x.floor() as i64, at.y.floor() as i64]
    };
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); columns * rows];
    for (a, &x) in snapshot.particles.points.iter().enumerate().filter(|(a, _)| phases[*a] != SOLID) {
        let [i, j] = cell_at(x);
        if (0..columns as i64).contains(&i) && (0..rows as i64).contains(&j) {
            around[j as usize * columns + i as usize].push(a);
        }
    }
    let nearest = |x: Vec2| {
        let [i, j] = cell_at(x);
        // Rings of cells: one beyond the first that has a particle, because a nearer one may be there.
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

/// The index offsets of a square ring.
fn square(ring: i64) -> impl Iterator<Item = (i64, i64)> {
    (-ring..=ring)
        .flat_map(move |j| (-ring..=ring).map(move |i| (i, j)))
        .filter(move |(i, j)| i.abs().max(j.abs()) == ring)
}
