//! `meniscus compare`: a network and a direct simulation of one geometry, or two networks, side by side.

use std::path::PathBuf;

use clap::Args;

use super::compare_networks::{self, Runs};
use super::exit::{DONE, Failure, INTERRUPTED, SOLVER_FAILED, USAGE};
use super::output::{duration, readable, say, tell};
use super::progress::ProgressDisplay;
use super::run::new_folder;
use super::threads::pool;
use super::{interrupt, source};
use crate::run::compare::{
    CompareError, Comparison, DIRECT_RUN, Of, PAGE, Pair, Side, Task, compare as run_both, write,
};
use crate::run::execute::Mode;
use crate::run::folder;
use meniscus_case::Model;

/// `compare`.
#[derive(Debug, Args)]
pub(crate) struct CompareArguments {
    /// Case file with [network] and an inlet
    pub(crate) network: PathBuf,
    /// Case file with [sph] and two fluids, of the same geometry; or another one with [network] and an inlet
    pub(crate) direct: PathBuf,
    /// States of the direct simulation that are compared
    #[arg(long, value_name = "N", default_value = "100")]
    pub(crate) records: std::num::NonZeroUsize,
    /// Output folder, new or empty; if not given: out/NAME-compare, out/NAME-compare-2, ..., NAME being that of the direct case
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Continue an interrupted comparison in its folder
    #[arg(long)]
    pub(crate) resume: bool,
    /// Number of threads; all cores if not given. The results do not depend on it
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<std::num::NonZeroUsize>,
}

/// Runs both cases, writes the page, the numbers and the curves, and prints the results.
pub(crate) fn compare(arguments: &CompareArguments) -> Result<u8, Failure> {
    let network = source::load_case(Some(&arguments.network), &[])?;
    let direct = source::load_case(Some(&arguments.direct), &[])?;
    if [&network, &direct].iter().all(|source| matches!(source.case.model, Model::Network(_))) {
        let CompareArguments { out, resume, threads, .. } = arguments;
        let runs = Runs { out: out.as_deref(), resume: *resume, threads: *threads };
        return compare_networks::compare(&[network, direct], &runs);
    }
    let mode = if arguments.resume { Mode::Resume } else { Mode::New };
    let out = new_folder(arguments.out.as_deref(), &format!("{}-compare", direct.name), mode);
    let claim = if arguments.resume { folder::reopen(&out, &out.join(DIRECT_RUN)) } else { folder::create(&out) };
    let _claim = claim.map_err(Failure::with(USAGE))?;
    tell(format_args!("{} | {} -> {}", network.case.title, direct.case.title, out.display()));
    let pair = Pair { network: &network.case, direct: &direct.case, records: arguments.records.get() };
    let task = Task { pair, resolved: &direct.resolved, folder: &out, mode };
    let found = pool(arguments.threads)?.install(|| {
        let mut display = ProgressDisplay::new();
        let found = run_both(&task, &interrupt::flag(), &mut display);
        display.finish();
        found.map(Some).or_else(|error| match (&error, error.problems()) {
            (CompareError::Interrupted, _) => Ok(None),
            (_, Some((Of::Network, problems))) => Err(network.refused_for(problems).into()),
            (_, Some((Of::Direct, problems))) => Err(direct.refused_for(problems).into()),
            (CompareError::Run(_), _) => Err(Failure::new(USAGE, &error)),
            _ => Err(Failure::new(SOLVER_FAILED, &error)),
        })
    })?;
    let Some(found) = found else {
        say(format_args!("interrupted; the same command with --out {} --resume continues it", out.display()));
        return Ok(INTERRUPTED);
    };
    write(&found, &out).map_err(Failure::with(USAGE))?;
    summary(&found);
    say(format_args!("  page        {}", out.join(PAGE).display()));
    Ok(DONE)
}

fn summary(found: &Comparison) {
    let shown = |value: Option<f64>, unit: &str| {
        value.map_or("not measured".to_owned(), |it| format!("{} {unit}", readable(it)))
    };
    let both = |name: &str, [network, direct]: [String; 2]| {
        say(format_args!("  {name:<24} network {network:<16} direct {direct}"))
    };
    let sides = [&found.network, &found.direct];
    if found.is_in_time {
        both("breakthrough time", sides.map(|side| shown(side.breakthrough_time_s, "s")));
    } else {
        both("breakthrough pressure", sides.map(|side| shown(side.breakthrough_pressure_pa, "Pa")));
    }
    both("saturation then", sides.map(|side| shown(side.saturation_at_breakthrough, "")));
    for (name, side) in ["network", "direct"].into_iter().zip(sides) {
        side.no_breakthrough.iter().for_each(|why| say(format_args!("  {name:<11} no breakthrough measured: {why}")));
    }
    both("wall time", sides.map(|side| duration(side.wall_time_s)));
    let processor = |side: &Side| side.processor_time_s.map_or("not measured".to_owned(), duration);
    both("processor time", sides.map(processor));
    let rank = shown(found.rank_correlation, "");
    say(format_args!("  order of invasion        rank correlation {rank}, {} elements", found.elements_in_both));
    say(format_args!("  overlap of invaded areas {}, mean over all records", shown(found.mean_overlap, "")));
    for warning in sides.into_iter().flat_map(|side| &side.warnings) {
        say(format_args!("  WARNING     {warning}"));
    }
}
