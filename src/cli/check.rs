//! `meniscus check`: builds the solver, does a few steps without any file, and reports what a run would be like.

use std::fmt::Display;
use std::time::Instant;

use super::arguments::CheckArguments;
use super::exit::{BUG, DONE, Failure, SOLVER_FAILED};
use super::output::{duration, readable, say, tell};
use super::progress::ProgressDisplay;
use super::run::built;
use super::source;
use crate::run::advice::Advice;
use crate::run::checked::{self, Checked};
use crate::run::description::{description, slip_of_lines};
use crate::run::execute::Mode;
use crate::run::numbers::{self, Length, expected_speed};
use crate::run::setup;
use meniscus_case::{Case, Model};
use meniscus_core::solver::Solver;

/// Bytes of a mebibyte.
const BYTES_PER_MEBIBYTE: f64 = 1048576.0;

/// Reports what a run of the case would be like.
pub(crate) fn check(arguments: &CheckArguments) -> Result<u8, Failure> {
    let clock = Instant::now();
    let source = source::load_case(Some(&arguments.case), &arguments.overrides)?;
    let case = &source.case;
    let mut solver = built(&source, Mode::New)?;
    let checked = tried(case, solver.as_mut(), clock.elapsed().as_secs_f64())?;
    if arguments.json {
        say(checked.json().map_err(Failure::with(BUG))?);
        return Ok(DONE);
    }
    let Checked { trial: found, warnings, advice } = checked;
    say(&case.title);
    case.depth_text().iter().for_each(|depth| row("depth", depth));
    description(case).iter().for_each(|(name, text)| row(name, text));
    let memory = found.memory_bytes.map(|bytes| format!("{:.0} MiB", bytes as f64 / BYTES_PER_MEBIBYTE));
    let (end, steps, time) = (readable(case.end), found.steps, duration(found.duration_s));
    if let Model::Network(network) = &case.model {
        row("pores", found.unknowns);
        memory.iter().for_each(|memory| row("memory", memory));
        // Time steps end at events, which are not known in advance.
        match network.is_dynamic() {
            true => row("run", format_args!("until {end} s, or where [network.stop] says")),
            false => row("run", format_args!("at most {steps} events, in less than {time}")),
        }
        advice.iter().for_each(print_advice);
        warnings.iter().for_each(|warning| row("WARNING", warning));
        return Ok(DONE);
    }
    let spacing = spacing(case);
    row("particles", format_args!("{} at a spacing of {} m", found.unknowns, readable(spacing)));
    let throat = setup::throat(case)
        .map(|width| format!("{:.1} particles across the narrowest one, {} m", width / spacing, readable(width)));
    row("throat", throat.as_deref().unwrap_or("none"));
    memory.iter().for_each(|memory| row("memory", memory));
    row("time step", format_args!("{} s, ruled by {}", readable(found.time_step_s), found.limit));
    match &case.model {
        // Stability limits the explicit steps of a film, the less the flatter it is: the first steps only give an upper bound of their number.
        Model::ThinFilm(_) if solver.steps_to(case.end).is_none() => {
            row("run", format_args!("{end} s in steps that grow with time, at most about {time}"));
        }
        // When a run becomes steady or breaks through is not known in advance.
        _ if found.is_upper_bound => {
            row("run", format_args!("{end} s or less, in less than {steps} steps and {time}"));
        }
        _ => row("run", format_args!("{end} s in about {steps} steps, about {time}")),
    }
    let length = Length::of(case);
    let (speed, formula) = expected_speed(case, length);
    for number in numbers::numbers(case, length, speed) {
        row(number.symbol, format_args!("{:<12} {}", readable(number.value), number.formula));
    }
    row("L", format_args!("= {} m, {}", readable(length.value), length.name));
    row("U", format_args!("= {} m/s, {formula}", readable(speed)));
    slip_of_lines(case).iter().for_each(|slip| row("lines", slip));
    advice.iter().for_each(print_advice);
    warnings.iter().for_each(|warning| row("WARNING", warning));
    Ok(DONE)
}

/// A line of the report.
fn row(name: &str, text: impl Display) {
    say(format_args!("  {name:<11} {text}"));
}

/// Reports the cost of both models, and which of them is applicable.
fn print_advice(advice: &Advice) {
    let Advice { pores, throats, network_s, particles, spacings_across, .. } = advice;
    row("network", format_args!("{pores} pores and {throats} throats, found in {}", duration(*network_s)));
    if let Some([narrowest, median]) = advice.widths_over_depth {
        let resolving = readable(advice.narrowest_throat_m / narrowest / 12.0_f64.sqrt());
        let (narrowest, median) = (readable(narrowest), readable(median));
        row(
            "w/b",
            format_args!(
                "{narrowest} in the narrowest throat, {median} in the median one: width over depth; a spacing of up to b/sqrt(12) = {resolving} m resolves floor and lid"
            ),
        );
    }
    let took = advice.steps.zip(advice.hours);
    let took =
        took.map_or(String::new(), |(steps, hours)| format!(", {steps} steps, about {}", duration(3600.0 * hours)));
    row(
        "direct",
        format_args!("{particles} particles, {spacings_across:.1} spacings across the narrowest throat{took}"),
    );
    for pore in &advice.numbers {
        let [radius, ca, oh, bo] = [pore.radius_m, pore.capillary, pore.viscous, pore.bond].map(readable);
        row(pore.pore, format_args!("pore of {radius} m: Ca = {ca}, Oh = {oh}, Bo = {bo}"));
    }
    row("ADVICE", &advice.sentence);
}

/// Tries the first steps; shows the progress if they take long.
fn tried(case: &Case, solver: &mut dyn Solver, built_s: f64) -> Result<Checked, Failure> {
    /// From this number of particles or nodes on, a step takes a tenth of a second and more.
    const MANY: usize = 100_000;
    let unknowns = solver.statistics().unknowns;
    if unknowns >= MANY {
        tell(format_args!("the first steps of {unknowns} particles are tried: five, or as many as ten seconds allow"));
    }
    let mut display = ProgressDisplay::new();
    let found = checked::check(case, solver, built_s, &mut |fraction| display.trial(fraction));
    display.finish();
    found.map_err(Failure::with(SOLVER_FAILED))
}

/// Initial spacing of particles or nodes in m.
fn spacing(case: &Case) -> f64 {
    match &case.model {
        Model::Sph(sph) => sph.spacing,
        Model::ThinFilm(film) => film.spacing,
        Model::Network(_) => 0.0,
    }
}
