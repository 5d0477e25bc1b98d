//! `meniscus compare` of two networks: both displacements on one page, with one slider.

use std::num::NonZeroUsize;
use std::path::Path;

use super::exit::{DONE, EXPECTATION_FAILED, Failure, USAGE};
use super::interrupt;
use super::output::{readable, say, tell};
use super::progress::ProgressDisplay;
use super::run::{built, ending, failure, new_folder};
use super::threads::pool;
use crate::run::compare::CompareError;
use crate::run::compare::networks::{RUNS, mode_in, write};
use crate::run::execute::{Finished, Job, Mode, execute};
use crate::run::folder;
use crate::run::source::Source;
use meniscus_core::playback::Playback;

/// Where both run, and how.
pub(super) struct Runs<'a> {
    /// The output folder, if given.
    pub(super) out: Option<&'a Path>,
    /// Whether an interrupted comparison continues.
    pub(super) resume: bool,
    /// Number of threads; all cores if not given.
    pub(super) threads: Option<NonZeroUsize>,
}

/// Runs both networks and writes their page.
pub(super) fn compare(both: &[Source; 2], arguments: &Runs<'_>) -> Result<u8, Failure> {
    let mode = if arguments.resume { Mode::Resume } else { Mode::New };
    let out = new_folder(arguments.out, &format!("{}-compare", both[1].name), mode);
    let claim = if arguments.resume { folder::reopen(&out, &out.join(RUNS[0])) } else { folder::create(&out) };
    let _claim = claim.map_err(Failure::with(USAGE))?;
    tell(format_args!("{} | {} -> {}", both[0].case.title, both[1].case.title, out.display()));
    let mut played = Vec::new();
    for (source, name) in both.iter().zip(RUNS) {
        let (finished, playback) = run(source, &out.join(name), arguments)?;
        let code = ending(&finished)?;
        if code != DONE && code != EXPECTATION_FAILED {
            say(format_args!("interrupted; the same command with --out {} --resume continues it", out.display()));
            return Ok(code);
        }
        played.push((finished, playback));
    }
    let [(one, first), (other, second)] = &played[..] else { return Ok(DONE) };
    let titles = [&both[0].case.title, &both[1].case.title];
    let page = write([(titles[0], first), (titles[1], second)], &out).map_err(Failure::with(USAGE))?;
    summary(one, other);
    match page {
        Ok(path) => say(format_args!("  page        {}", path.display())),
        Err(too_many) => say(format_args!("  page        none: {too_many}")),
    }
    Ok(DONE)
}

/// Runs one of both in a folder of its own.
fn run(source: &Source, folder: &Path, arguments: &Runs<'_>) -> Result<(Finished, Playback), Failure> {
    let mode = mode_in(folder, arguments.resume);
    pool(arguments.threads)?.install(|| {
        let mut solver = built(source, mode)?;
        if solver.playback().is_none() {
            let is_curve = source.case.is_curve_alone();
            let error = if is_curve { CompareError::NoPage } else { CompareError::NoNetwork };
            let problems = error.problems().map_or_else(Vec::new, |(_, problems)| problems);
            return Err(source.refused_for(problems).into());
        }
        let job = Job { case: &source.case, resolved: &source.resolved, folder: folder.to_path_buf(), mode };
        let mut display = ProgressDisplay::new();
        let finished = execute(&job, solver.as_mut(), &interrupt::flag(), &mut display);
        display.finish();
        let finished = finished.map_err(|error| failure(&error))?;
        let playback = solver.playback().ok_or_else(|| Failure::new(USAGE, CompareError::NoNetwork))?;
        Ok((finished, playback))
    })
}

/// A value with four digits, or a count.
fn shown(value: f64) -> String {
    if value.fract() == 0.0 { format!("{value}") } else { readable(value) }
}

/// The measures that both have.
fn summary(one: &Finished, other: &Finished) {
    say(format_args!("  {:<34} {:<16} {}", "", RUNS[0], RUNS[1]));
    for (name, reading) in &one.report.measures {
        let second = other.report.measures.get(name).and_then(|it| it.value);
        if let (Some(first), Some(second)) = (reading.value, second) {
            let [first, second] = [first, second].map(shown);
            say(format_args!("{}", format!("  {name:<34} {first:<16} {second} {}", reading.unit).trim_end()));
        }
    }
}
