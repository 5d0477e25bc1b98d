//! One case, run for a few steps with all its files, and what is looked for in them.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use meniscus::run::execute::{Job, Mode, execute};
use meniscus::run::report::Status;
use meniscus::run::setup;
use meniscus::run::simulation::{Progress, Watcher};
use meniscus_case as case;
use meniscus_core::input::{InputError, Overrides};
use meniscus_core::snapshot::{Field, Snapshot, Values};

use crate::places::without_place;
use crate::seeds::is_small;

/// Steps of a run.
const STEPS: u64 = 4;
/// Most iterations of a linear solver in a step, and most times that a step is repeated with a shorter one.
const MOST_ITERATIONS: f64 = 20_000.0;
const MOST_REPEATS: f64 = 60.0;

/// How a case ended.
pub enum Ending {
    Refused,
    TooLarge,
    Ran,
    Failed(String),
    Bad(String),
}

/// Asks the run to stop after so many steps.
struct Stopper<'a> {
    flag: &'a AtomicBool,
    steps: u64,
}

impl Watcher for Stopper<'_> {
    fn stepped(&mut self, _: &Progress) {
        self.steps += 1;
        self.flag.store(self.steps >= STEPS, Ordering::Relaxed);
    }
}

/// The ending of a refusal, which is to name the file and a place in it.
fn refused(error: &InputError, folder: &Path) -> Ending {
    without_place(error, folder).map_or(Ending::Refused, Ending::Bad)
}

/// Checks and runs `case.toml` in a folder.
pub fn run(folder: &Path) -> Ending {
    let loaded = match case::load(&folder.join("case.toml"), &Overrides::default()) {
        Ok(loaded) => loaded,
        Err(error) => return refused(&error, folder),
    };
    if !is_small(&loaded.case) {
        return Ending::TooLarge;
    }
    if let Err(error) = loaded.refuse(setup::problems(&loaded.case)) {
        return refused(&error, folder);
    }
    let mut solver = match setup::build(&loaded.case) {
        Ok(solver) => solver,
        Err(error) => {
            return match loaded.refuse(error.problems()) {
                Err(refusal) => refused(&refusal, folder),
                Ok(()) => Ending::Bad(format!("refused without a place: {error}")),
            };
        }
    };
    let flag = AtomicBool::new(false);
    let mut stopper = Stopper { flag: &flag, steps: 0 };
    let out = folder.join("out");
    let job = Job { case: &loaded.case, resolved: &loaded.resolved, folder: out.clone(), mode: Mode::New };
    let finished = match execute(&job, solver.as_mut(), &flag, &mut stopper) {
        Ok(finished) => finished,
        Err(error) => return Ending::Bad(format!("no report: {error}")),
    };
    if stopper.steps > STEPS {
        return Ending::Bad(format!("{} steps after the interrupt", stopper.steps - STEPS));
    }
    for (name, count) in solver.statistics().counts {
        let most = match name {
            "ppe-iterations-per-step" | "viscous-iterations-per-step" => MOST_ITERATIONS,
            "repeated-steps" => MOST_REPEATS * STEPS as f64,
            _ => f64::INFINITY,
        };
        if !(count <= most) {
            return Ending::Bad(format!("{name} = {count}"));
        }
    }
    if let Some(what) = not_finite(&solver.snapshot()).or_else(|| not_finite_in_texts(&out)) {
        return Ending::Bad(what);
    }
    match finished.report.status {
        Status::Failed => match finished.report.error {
            Some(error) if !error.contains("NaN") => Ending::Failed(error),
            error => Ending::Bad(format!("it failed with the message {error:?}")),
        },
        _ => Ending::Ran,
    }
}

/// The name of a field of a snapshot that holds a number that is none.
fn not_finite(snapshot: &Snapshot<'_>) -> Option<String> {
    let bad = |field: &Field<'_>| match &field.values {
        Values::Scalar(values) => values.iter().any(|value| !value.is_finite()),
        Values::Vector(values) => values.iter().any(|value| !(value.x.is_finite() && value.y.is_finite())),
        Values::Integer(_) => false,
    };
    let grid = snapshot.grid.iter().flat_map(|grid| &grid.fields);
    let lines = snapshot.interface.iter().flat_map(|lines| &lines.fields);
    let fields = snapshot.particles.fields.iter().chain(grid).chain(lines);
    let bad = fields.filter(|field| bad(field)).map(|field| field.name).next();
    let points =
        snapshot.particles.points.iter().chain(snapshot.interface.iter().flat_map(|lines| lines.points.iter()));
    let is_lost = points.into_iter().any(|point| !(point.x.is_finite() && point.y.is_finite()));
    bad.or(is_lost.then_some("points")).map(|name| format!("numbers that are none in `{name}`"))
}

/// A text file of the output with a number that is none: tables leave those fields empty, reports have `null` there.
fn not_finite_in_texts(folder: &Path) -> Option<String> {
    for entry in std::fs::read_dir(folder).ok()? {
        let path = entry.ok()?.path();
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let is_none = |field: &str| field.parse::<f64>().is_ok_and(|number| !number.is_finite());
        let is_bad = match path.extension().unwrap_or_default().to_string_lossy().as_ref() {
            "csv" => text.split([',', '\n']).any(is_none),
            "json" => serde_json::from_str::<serde_json::Value>(&text).is_err(),
            _ => false,
        };
        if is_bad {
            return Some(format!("numbers that are none in {}", path.file_name()?.to_string_lossy()));
        }
    }
    None
}
