//! `meniscus check`: builds the solver, does a few steps without any file, and tells what a run would be like.

use std::time::Instant;

use super::arguments::CheckArguments;
use super::exit::{BAD_INPUT, DONE, Failure, SOLVER_FAILED};
use super::output::{duration, readable, say};
use super::source;
use crate::case::checked::{Case, Model};
use crate::run::numbers::{self, Length, expected_speed};
use crate::run::setup;

/// Steps that are tried; the first ones set up what later ones reuse.
const TRIAL_STEPS: usize = 5;

/// Tells what a run of the case would be like.
pub fn check(arguments: &CheckArguments) -> Result<u8, Failure> {
    let source = source::load_case(Some(&arguments.case), &arguments.overrides)?;
    let case = &source.case;
    let mut solver = setup::build(case).map_err(|error| Failure::new(BAD_INPUT, &error))?;
    let clock = Instant::now();
    let mut info = None;
    for _ in 0..TRIAL_STEPS {
        info = Some(solver.step(case.end).map_err(|error| Failure::new(SOLVER_FAILED, &error))?);
        if solver.time() >= case.end {
            break;
        }
    }
    let per_step = clock.elapsed().as_secs_f64() / solver.steps().max(1) as f64;
    say(&case.title);
    let spacing = spacing(case);
    say(format_args!("  particles   {} at a spacing of {} m", solver.statistics().unknowns, readable(spacing)));
    match setup::throat(case) {
        Some(width) => say(format_args!(
            "  throat      {:.1} particles across the narrowest one, {} m",
            width / spacing,
            readable(width)
        )),
        None => say("  throat      none"),
    }
    if let Some(memory) = memory() {
        say(format_args!("  memory      {memory}"));
    }
    if let Some(info) = info {
        let steps = match &case.model {
            Model::Sph(_) => Some((case.end / info.dt).ceil()),
            // Steps of a film grow a millionfold while it comes to rest: the first ones do not tell how long it takes.
            Model::ThinFilm(_) => solver.steps_to(case.end),
        };
        say(format_args!("  time step   {} s, ruled by {}", readable(info.dt), info.limit));
        match steps {
            Some(steps) => say(format_args!(
                "  run         {} s in about {steps} steps, about {}",
                readable(case.end),
                duration(steps * per_step)
            )),
            None => say(format_args!("  run         {} s, in steps that grow with time", readable(case.end))),
        }
    }
    let length = Length::of(case);
    let (speed, formula) = expected_speed(case, length);
    for number in numbers::numbers(case, length, speed) {
        say(format_args!("  {:<11} {:<12} {}", number.symbol, readable(number.value), number.formula));
    }
    say(format_args!("  L           = {} m, {}", readable(length.value), length.name));
    say(format_args!("  U           = {} m/s, {formula}", readable(speed)));
    Ok(DONE)
}

/// Initial distance of particles or nodes in m.
fn spacing(case: &Case) -> f64 {
    match &case.model {
        Model::Sph(sph) => sph.spacing,
        Model::ThinFilm(film) => film.spacing,
    }
}

/// The most memory that the program has used so far, where the system tells.
fn memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kibibytes: f64 =
        status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?.split_whitespace().next()?.parse().ok()?;
    const KIBIBYTES_PER_MEBIBYTE: f64 = 1024.0;
    Some(format!("{:.0} MiB", kibibytes / KIBIBYTES_PER_MEBIBYTE))
}
