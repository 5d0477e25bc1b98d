//! `meniscus check`: builds the solver, does a few steps without any file, and reports what a run would be like.

use super::arguments::CheckArguments;
use super::exit::{BUG, DONE, Failure, SOLVER_FAILED};
use super::output::{duration, readable, say, tell};
use super::progress::ProgressDisplay;
use super::run::built;
use super::source;
use crate::case::{Case, Model};
use crate::run::advice::Advice;
use crate::run::checked::{self, Checked};
use crate::run::description::description;
use crate::run::execute::Mode;
use crate::run::numbers::{self, Length, expected_speed};
use crate::run::setup;
use crate::solver::Solver;

/// Bytes of a mebibyte.
const BYTES_PER_MEBIBYTE: f64 = 1048576.0;

/// Reports what a run of the case would be like.
pub(crate) fn check(arguments: &CheckArguments) -> Result<u8, Failure> {
    let source = source::load_case(Some(&arguments.case), &arguments.overrides)?;
    let case = &source.case;
    let mut solver = built(&source, Mode::New)?;
    let checked = tried(case, solver.as_mut())?;
    if arguments.json {
        say(checked.json().map_err(Failure::with(BUG))?);
        return Ok(DONE);
    }
    let Checked { trial: found, warnings, advice } = checked;
    say(&case.title);
    case.depth_text().iter().for_each(|depth| say(format_args!("  depth       {depth}")));
    description(case).iter().for_each(|(name, text)| say(format_args!("  {name:<11} {text}")));
    if let Model::Network(network) = &case.model {
        say(format_args!("  pores       {}", found.unknowns));
        if let Some(memory) = found.memory_bytes {
            say(format_args!("  memory      {:.0} MiB", memory as f64 / BYTES_PER_MEBIBYTE));
        }
        // Time steps end at events, which are not known in advance.
        match network.is_dynamic() {
            true => say(format_args!("  run         until {} s, or where [network.stop] says", readable(case.end))),
            false => {
                say(format_args!("  run         at most {} events, about {}", found.steps, duration(found.duration_s)))
            }
        }
        advice.iter().for_each(print_advice);
        warnings.iter().for_each(say_warning);
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
        // Stability limits the explicit steps of a film, the less the flatter it is: the first steps only give an upper bound of their number.
        Model::ThinFilm(_) if solver.steps_to(case.end).is_none() => {
            say(format_args!(
                "  run         {} s in steps that grow with time, at most about {time}",
                readable(case.end)
            ));
        }
        // When a run becomes steady is not known in advance.
        _ if case.steady.is_some_and(|steady| steady.stop) => {
            say(format_args!("  run         {} s or less, at most about {steps} steps and {time}", readable(case.end)));
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
    if let Model::Sph(sph) = &case.model
        && sph.has_lines_that_slip_by_a_spacing()
    {
        say(format_args!(
            "  lines       contact lines slip by one spacing, and their speeds depend on it: give sph.walls.slip-length, or sph.wetting.cox with \
             the slip length of the wall in nanometers; static states do not depend on it"
        ));
    }
    advice.iter().for_each(print_advice);
    warnings.iter().for_each(say_warning);
    Ok(DONE)
}

fn say_warning(warning: &String) {
    say(format_args!("  WARNING     {warning}"));
}

/// Reports the cost of both models, and which of them is applicable.
fn print_advice(advice: &Advice) {
    let Advice { pores, throats, network_s, .. } = advice;
    say(format_args!("  network     {pores} pores and {throats} throats, found in {}", duration(*network_s)));
    if let Some([narrowest, median]) = advice.widths_over_depth {
        say(format_args!(
            "  w/b         {} in the narrowest throat, {} in the median one: width over depth; a spacing of up to b/sqrt(12) = {} m resolves floor and lid",
            readable(narrowest),
            readable(median),
            readable(advice.narrowest_throat_m / narrowest / 12.0_f64.sqrt())
        ));
    }
    let took = advice.steps.zip(advice.hours);
    let took =
        took.map_or(String::new(), |(steps, hours)| format!(", {steps} steps, about {}", duration(3600.0 * hours)));
    say(format_args!(
        "  direct      {} particles, {:.1} spacings across the narrowest throat{took}",
        advice.particles, advice.spacings_across
    ));
    for pore in &advice.numbers {
        say(format_args!(
            "  {:<11} pore of {} m: Ca = {}, Oh = {}, Bo = {}",
            pore.pore,
            readable(pore.radius_m),
            readable(pore.capillary),
            readable(pore.viscous),
            readable(pore.bond)
        ));
    }
    say(format_args!("  ADVICE      {}", advice.sentence));
}

/// Tries the first steps; shows the progress if they take long.
fn tried(case: &Case, solver: &mut dyn Solver) -> Result<Checked, Failure> {
    /// From this number of particles or nodes on, a step takes a tenth of a second and more.
    const MANY: usize = 100_000;
    let unknowns = solver.statistics().unknowns;
    if unknowns >= MANY {
        tell(format_args!("the first steps of {unknowns} particles are tried: five, or as many as ten seconds allow"));
    }
    let mut display = ProgressDisplay::new();
    let found = checked::check(case, solver, &mut |fraction| display.trial(fraction));
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
