//! `meniscus check`: builds the solver, does a few steps without any file, and tells what a run would be like.

use super::arguments::CheckArguments;
use super::exit::{BUG, DONE, Failure, SOLVER_FAILED};
use super::output::{duration, readable, say, tell};
use super::progress::ProgressDisplay;
use super::run::built;
use super::source;
use crate::case::checked::{Case, Model};
use crate::run::numbers::{self, Length, expected_speed};
use crate::run::setup;
use crate::run::trial::{Trial, trial};
use crate::solver::Solver;

/// Bytes of a mebibyte.
const BYTES_PER_MEBIBYTE: f64 = 1048576.0;

/// Tells what a run of the case would be like.
pub fn check(arguments: &CheckArguments) -> Result<u8, Failure> {
    let source = source::load_case(Some(&arguments.case), &arguments.overrides)?;
    let case = &source.case;
    let mut solver = built(case)?;
    let found = tried(case, solver.as_mut())?;
    if arguments.json {
        let text = serde_json::to_string_pretty(&found).map_err(|error| Failure::new(BUG, &error))?;
        say(text);
        return Ok(DONE);
    }
    say(&case.title);
    if let Model::Network(_) = &case.model {
        say(format_args!("  pores       {}", found.unknowns));
        if let Some(memory) = found.memory_bytes {
            say(format_args!("  memory      {:.0} MiB", memory as f64 / BYTES_PER_MEBIBYTE));
        }
        say(format_args!("  run         at most {} events, about {}", found.steps, duration(found.duration_s)));
        return Ok(DONE);
    }
    let spacing = spacing(case);
    say(format_args!("  particles   {} at a spacing of {} m", found.unknowns, readable(spacing)));
    match setup::throat(case) {
        Some(width) => say(format_args!(
            "  throat      {:.1} particles across the narrowest one, {} m",
            width / spacing,
            readable(width)
        )),
        None => say("  throat      none"),
    }
    if let Some(memory) = found.memory_bytes {
        say(format_args!("  memory      {:.0} MiB", memory as f64 / BYTES_PER_MEBIBYTE));
    }
    say(format_args!("  time step   {} s, ruled by {}", readable(found.time_step_s), found.limit));
    let (steps, time) = (found.steps, duration(found.duration_s));
    match &case.model {
        // Stability bounds the explicit steps of a film, the less the flatter it is: the first ones tell only the most it can take.
        Model::ThinFilm(_) if solver.steps_to(case.end).is_none() => {
            say(format_args!(
                "  run         {} s in steps that grow with time, at most about {time}",
                readable(case.end)
            ));
        }
        _ => say(format_args!("  run         {} s in about {steps} steps, about {time}", readable(case.end))),
    }
    let length = Length::of(case);
    let (speed, formula) = expected_speed(case, length);
    for number in numbers::numbers(case, length, speed) {
        say(format_args!("  {:<11} {:<12} {}", number.symbol, readable(number.value), number.formula));
    }
    say(format_args!("  L           = {} m, {}", readable(length.value), length.name));
    say(format_args!("  U           = {} m/s, {formula}", readable(speed)));
    for warning in setup::warnings(case, solver.as_ref()) {
        say(format_args!("  WARNING     {warning}"));
    }
    Ok(DONE)
}

/// Tries the first steps; says so before and in between where they take long.
fn tried(case: &Case, solver: &mut dyn Solver) -> Result<Trial, Failure> {
    /// From so many particles or nodes on a step takes a tenth of a second and more.
    const MANY: usize = 100_000;
    let unknowns = solver.statistics().unknowns;
    if unknowns >= MANY {
        tell(format_args!("the first steps of {unknowns} particles are tried: five, or as many as ten seconds allow"));
    }
    let mut display = ProgressDisplay::new();
    let found = trial(case, solver, &mut |share| display.tried(share));
    display.finish();
    found.map_err(|error| Failure::new(SOLVER_FAILED, &error))
}

/// Initial distance of particles or nodes in m.
fn spacing(case: &Case) -> f64 {
    match &case.model {
        Model::Sph(sph) => sph.spacing,
        Model::ThinFilm(film) => film.spacing,
        Model::Network(_) => 0.0,
    }
}
