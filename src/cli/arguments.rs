//! What can be written on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

/// Exit codes, as the help tells them.
const EXIT_CODES: &str = "Exit codes: 0 done, 1 bug, 2 usage or output folder, 3 bad case or shape file, 4 solver failed, \
                          5 expectation failed, 130 interrupted";

/// Direct simulation of two-phase flow with partial wetting in pores.
///
/// Without a command: runs the built-in case, a wetting liquid between four discs.
#[derive(Debug, Parser)]
#[command(name = "meniscus", version, after_help = EXIT_CODES)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a case: from a case file to VTK files, a series, a picture and a report
    Run(RunArguments),
    /// Tell everything that can be told before a run: mistakes, particles, time step, dimensionless numbers, duration
    Check(CheckArguments),
    /// Measure a shape file: porosity, specific surface, throats; write its outline and signed distance
    Geometry(GeometryArguments),
    /// Write a commented starter case
    New(NewArguments),
    /// List the models with their references
    List,
    /// Print the JSON schema of a case file
    Schema,
    /// Print a completion script for a shell
    Completions(CompletionArguments),
    /// Pore networks (not yet available)
    Network(AnyArguments),
    /// Parameter studies (not yet available)
    Study(AnyArguments),
}

/// `run`.
#[derive(Debug, Default, Args)]
pub struct RunArguments {
    /// Case file; the built-in case where there is none
    pub case: Option<PathBuf>,
    /// Output folder, new or empty; where there is none: out/NAME, NAME being that of the case file, or where an earlier run
    /// is in it out/NAME-2, out/NAME-3, ...
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Change a value of the case, as in --set sph.wetting.young.contact-angle-deg=60
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Number of threads; all cores where there is none. The results do not depend on it
    #[arg(long, value_name = "N")]
    pub threads: Option<std::num::NonZeroUsize>,
    /// Go on with the run in the output folder; without --out in the last one of out/NAME, out/NAME-2, ...
    #[arg(long)]
    pub resume: bool,
}

/// `check`.
#[derive(Debug, Args)]
pub struct CheckArguments {
    /// Case file
    pub case: PathBuf,
    /// Change a value of the case
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

/// `geometry`.
#[derive(Debug, Args)]
pub struct GeometryArguments {
    /// Shape file
    pub file: PathBuf,
    /// Folder for outline, signed distance and picture; nothing is written where there is none
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// `new`.
#[derive(Debug, Args)]
pub struct NewArguments {
    /// File to write, which must not exist
    #[arg(default_value = "case.toml")]
    pub file: PathBuf,
}

/// `completions`.
#[derive(Debug, Args)]
pub struct CompletionArguments {
    /// The shell
    pub shell: Shell,
}

/// Arguments of a command that is not yet available.
#[derive(Debug, Args)]
pub struct AnyArguments {
    /// Not read
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, hide = true)]
    pub rest: Vec<String>,
}
