//! `meniscus compare`: a network and a direct simulation of one geometry, side by side.

use std::path::PathBuf;

use clap::Args;

use super::exit::{BAD_INPUT, BUG, DONE, Failure, SOLVER_FAILED, USAGE};
use super::output::{duration, readable, say, tell};
use super::progress::ProgressDisplay;
use super::run::new_folder;
use super::source;
use super::threads::pool;
use crate::io::{FileError, atomic};
use crate::run::compare::{CompareError, Comparison, Side, compare as run_both, page};
use crate::run::execute::Mode;
use crate::run::folder;
use crate::run::setup::SetupError;

/// `compare`.
#[derive(Debug, Args)]
pub struct CompareArguments {
    /// Case file with [network] and an inlet
    pub network: PathBuf,
    /// Case file with [sph] and two fluids, of the same geometry
    pub direct: PathBuf,
    /// States of the direct simulation that are compared
    #[arg(long, value_name = "N", default_value = "100")]
    pub records: std::num::NonZeroUsize,
    /// Output folder, new or empty; where there is none: out/NAME-compare, out/NAME-compare-2, ..., NAME being that of the direct case
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads; all cores where there is none. The results do not depend on it
    #[arg(long, value_name = "N")]
    pub threads: Option<std::num::NonZeroUsize>,
}

/// Runs both cases, writes `compare.html` and `compare.json`, and tells what came out.
pub fn compare(arguments: &CompareArguments) -> Result<u8, Failure> {
    let network = source::load_case(Some(&arguments.network), &[])?;
    let direct = source::load_case(Some(&arguments.direct), &[])?;
    let out = new_folder(arguments.out.as_deref(), &format!("{}-compare", direct.name), Mode::New);
    let _claim = folder::create(&out).map_err(|error| Failure::new(USAGE, &error))?;
    tell(format_args!("{} | {} -> {}", network.case.title, direct.case.title, out.display()));
    let found = pool(arguments.threads)?.install(|| {
        let mut display = ProgressDisplay::new();
        let found =
            run_both((&network.case, &direct.case), arguments.records.get(), &mut |share| display.compared(share));
        display.finish();
        found.map_err(|error| match &error {
            CompareError::Setup(misfit @ SetupError::Network(_)) => network.refused(misfit),
            CompareError::Setup(misfit) => direct.refused(misfit),
            CompareError::NoNetwork => network.refused_at(
                "network",
                "the first case has no displacement in a network",
                "give [network] an inlet",
            ),
            CompareError::NoDirect => direct.refused_at(
                "sph",
                "the second case is no direct simulation of two fluids",
                "give it [sph] with both phases",
            ),
            CompareError::OtherGeometry(_) => direct.refused_at("geometry", &error.to_string(), ""),
            CompareError::OtherSides { side, .. } => {
                direct.refused_at(&format!("sph.sides.{side}"), &error.to_string(), "")
            }
            other => failure(other),
        })
    })?;
    let json = serde_json::to_string_pretty(&found).map_err(|error| Failure::new(BUG, &error))?;
    let unwritten = |error: FileError| Failure::new(USAGE, &error);
    atomic::write(&out.join("compare.json"), (json + "\n").as_bytes()).map_err(unwritten)?;
    atomic::write(&out.join("compare.html"), page(&found).as_bytes()).map_err(unwritten)?;
    summary(&found);
    say(format_args!("  page        {}", out.join("compare.html").display()));
    Ok(DONE)
}

fn failure(error: &CompareError) -> Failure {
    let code = if matches!(error, CompareError::Solver(_)) { SOLVER_FAILED } else { BAD_INPUT };
    Failure::new(code, error)
}

fn summary(found: &Comparison) {
    let told = |value: Option<f64>, unit: &str| {
        value.map_or("not measured".to_owned(), |it| format!("{} {unit}", readable(it)))
    };
    let both = |name: &str, [network, direct]: [String; 2]| {
        say(format_args!("  {name:<24} network {network:<16} direct {direct}"))
    };
    let sides = [&found.network, &found.direct];
    both("breakthrough pressure", sides.map(|side| told(side.breakthrough_pressure_pa, "Pa")));
    both("saturation then", sides.map(|side| told(side.saturation_at_breakthrough, "")));
    both("wall time", sides.map(|side| duration(side.wall_time_s)));
    let processor = |side: &Side| side.processor_time_s.map_or("not measured".to_owned(), duration);
    both("processor time", sides.map(processor));
    let rank = told(found.rank_correlation, "");
    say(format_args!("  order of invasion        rank correlation {rank}, {} elements", found.elements_in_both));
    say(format_args!("  overlap of invaded areas {}, mean over all records", told(found.mean_overlap, "")));
    for warning in sides.into_iter().flat_map(|side| &side.warnings) {
        say(format_args!("  WARNING     {warning}"));
    }
}
