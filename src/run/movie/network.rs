//! Frames of a network, which is computed again: first for what all frames have in common, then to draw them.

use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;

use super::ended::Written;
use super::failure::MovieFailure;
use crate::run::records::Records;
use crate::run::report::Status;
use crate::run::schedule::Schedule;
use crate::run::setup;
use crate::run::simulation::{Outcome, Progress, Simulation, Watcher};
use meniscus_case::{Case, Model};
use meniscus_core::diagram::RegionMap;
use meniscus_core::solver::Solver;
use meniscus_output::FileError;
use meniscus_output::movie::Movie;
use meniscus_output::picture::{MapScene, Picture, PictureError};
use rayon::prelude::*;

/// Number of frames to aim at.
const FRAMES: f64 = 100.0;

/// Receives the map at every so many rows of the series and at the end, and the fraction of the run that is done.
struct Frames<'a> {
    every: usize,
    rows: usize,
    end: f64,
    take: &'a mut dyn FnMut(RegionMap) -> Result<(), MovieFailure>,
    progress: &'a mut dyn FnMut(f64),
    failure: Option<MovieFailure>,
}

impl Watcher for Frames<'_> {
    fn stepped(&mut self, step: &Progress) {
        (self.progress)(step.time / step.end);
    }

    fn recorded(&mut self, solver: &dyn Solver) -> Result<(), FileError> {
        let is_end = solver.is_done() || solver.time() >= self.end;
        if self.failure.is_none()
            && (is_end || self.rows.is_multiple_of(self.every))
            && let Some(map) = solver.region_map()
        {
            self.failure = (self.take)(map).err();
        }
        self.rows += 1;
        Ok(())
    }
}

/// The movie of a network with a displacement, and a note if it is not that of the run.
pub(super) fn movie(
    case: &Case,
    written: &Written,
    progress: &mut dyn FnMut(f64),
) -> Result<(Movie, Vec<String>), MovieFailure> {
    let (case, every) = with_frames(case, written);
    let case = &case;
    let mut solver = setup::build(case)?;
    let mut scenes: BTreeMap<usize, MapScene> = BTreeMap::new();
    let mut see = |map: RegionMap| {
        let found = MapScene::of(&map);
        let all = scenes.get(&map.part).map_or_else(|| found.clone(), |scene| scene.clone().with(&found));
        scenes.insert(map.part, all);
        Ok(())
    };
    run(case, every, solver.as_mut(), &mut see, &mut |done| progress(0.2 * done))?;
    let is_same = solver.time() == written.clock.value && solver.steps() == written.steps;
    let note =
        "the displacement is not the same as in the folder, which version {} of the program wrote; run the case again";
    let notes = if is_same { Vec::new() } else { vec![note.replace("{}", &written.version)] };
    let mut solver = setup::build(case)?;
    let mut drawing = Drawing { title: &case.title, scenes: &scenes, waiting: Vec::new(), movie: Movie::default() };
    let mut draw = |map: RegionMap| drawing.take(map);
    run(case, every, solver.as_mut(), &mut draw, &mut |done| progress(0.2 + 0.8 * done))?;
    drawing.draw()?;
    Ok((drawing.movie, notes))
}

/// Draws maps, as many at once as there are threads.
struct Drawing<'a> {
    title: &'a str,
    scenes: &'a BTreeMap<usize, MapScene>,
    /// Maps that differ, and how often each came.
    waiting: Vec<(RegionMap, u32)>,
    movie: Movie,
}

impl Drawing<'_> {
    fn take(&mut self, map: RegionMap) -> Result<(), MovieFailure> {
        // Between events nothing changes.
        if let Some((_, times)) = self.waiting.last_mut().filter(|(last, _)| *last == map) {
            *times += 1;
            return Ok(());
        }
        if self.waiting.len() == rayon::current_num_threads() {
            self.draw()?;
        }
        self.waiting.push((map, 1));
        Ok(())
    }

    /// Draws those that wait.
    fn draw(&mut self) -> Result<(), MovieFailure> {
        let scene = |map: &RegionMap| self.scenes.get(&map.part).cloned().unwrap_or_else(|| MapScene::of(map));
        let drawn = self.waiting.par_iter().map(|(map, times)| Ok((scene(map).draw(map, self.title)?, *times)));
        let drawn: Vec<(Picture, u32)> = drawn.collect::<Result<_, PictureError>>()?;
        self.waiting.clear();
        Ok(drawn.iter().try_for_each(|(picture, times)| self.movie.push(picture, *times))?)
    }
}

/// The case up to where the run came, and after how many rows of its series there is a frame, about [`FRAMES`] in all. In time, the rows stay those of the run,
/// which ends its steps at them: it comes to the same bits.
fn with_frames(case: &Case, written: &Written) -> (Case, usize) {
    let mut case = case.clone();
    let is_in_time = matches!(&case.model, Model::Network(network) if network.is_dynamic());
    if !is_in_time && written.clock.value > 0.0 {
        case.output.series_every = written.clock.value / FRAMES;
    }
    let rows = written.clock.value / case.output.series_every;
    if matches!(written.status, Status::Interrupted | Status::Failed) {
        case.end = written.clock.value;
    }
    (case, (rows / FRAMES).round().max(1.0) as usize)
}

/// Runs a case in memory, with the map of each frame.
fn run(
    case: &Case,
    every: usize,
    solver: &mut dyn Solver,
    take: &mut dyn FnMut(RegionMap) -> Result<(), MovieFailure>,
    progress: &mut dyn FnMut(f64),
) -> Result<(), MovieFailure> {
    let mut frames = Frames { every, rows: 0, end: case.end, take, progress, failure: None };
    let (mut records, interrupt) = (Records::default(), AtomicBool::new(false));
    let schedule = Schedule::new(&case.output, case.end);
    let mut simulation = Simulation {
        solver,
        schedule,
        steady: case.steady,
        records: &mut records,
        interrupt: &interrupt,
        watcher: &mut frames,
    };
    simulation.begin()?;
    let outcome = simulation.run()?;
    match (frames.failure, outcome) {
        (Some(failure), _) => Err(failure),
        // The frames up to a failure of the run are those that there are.
        (None, Outcome::Done | Outcome::Interrupted | Outcome::Failed(_)) => Ok(()),
    }
}
