//! What can be written on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use super::import_arguments::ImportArguments;

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
    /// Measure a shape file or the geometry of a case: porosity, specific surface, throats; write its outline and signed distance
    Geometry(GeometryArguments),
    /// Write a commented starter case
    New(NewArguments),
    /// List the models with their references
    List,
    /// Print the JSON schema of a case file
    Schema(SchemaArguments),
    /// Print a completion script for a shell
    Completions(CompletionArguments),
    /// Pore networks (not yet available)
    Network(AnyArguments),
    /// Parameter studies: many runs from one file, with a table, curves and a page
    #[command(subcommand)]
    Study(StudyCommand),
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
    /// Tell what a run would take as JSON, for other programs
    #[arg(long)]
    pub json: bool,
}

/// `geometry`.
#[derive(Debug, Args)]
pub struct GeometryArguments {
    /// Shape file (TOML, list of discs, SVG, DXF, shapefile, GeoJSON, WKT, mask in PNG or TIFF), or a case file, whose geometry is
    /// measured with the sides of the case
    pub file: PathBuf,
    /// Sides of a shape file that are joined; none where it is not given
    #[arg(long, value_name = "AXES")]
    pub periodic: Option<Axes>,
    #[command(flatten)]
    pub import: ImportArguments,
    /// Folder for outline, signed distance and picture; nothing is written where there is none
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Axes along which a domain is joined to itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Axes {
    /// Left and right
    X,
    /// Bottom and top
    Y,
    /// All four
    Xy,
}

impl Axes {
    /// Whether x and y are among them.
    pub fn along(self) -> [bool; 2] {
        [self != Self::Y, self != Self::X]
    }
}

/// `study`.
#[derive(Debug, Subcommand)]
pub enum StudyCommand {
    /// Tell the runs of a study: what varies, particles, memory, expected duration
    Plan(StudyPlanArguments),
    /// Do all runs that are not complete, then write the report
    Run(Box<StudyRunArguments>),
    /// Write table, curves and page from the runs that are complete
    Report(StudyReportArguments),
}

/// `study plan`.
#[derive(Debug, Args)]
pub struct StudyPlanArguments {
    /// Study files, one after the other
    #[arg(required = true, value_name = "STUDY")]
    pub studies: Vec<PathBuf>,
    /// Study folder, out/study-NAME where there is none; nothing is written. Of several studies: the folder that holds theirs
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub cores: CoresArguments,
}

/// Threads and runs at once.
#[derive(Debug, Args)]
pub struct CoresArguments {
    /// Threads of each run
    #[arg(long, value_name = "N", default_value = "1")]
    pub threads: std::num::NonZeroUsize,
    /// Runs at once; as many as the cores allow where there is none
    #[arg(long, value_name = "N")]
    pub jobs: Option<std::num::NonZeroUsize>,
}

/// `study run`.
#[derive(Debug, Args)]
pub struct StudyRunArguments {
    /// Study files, one after the other
    #[arg(required = true, value_name = "STUDY")]
    pub studies: Vec<PathBuf>,
    /// Study folder, new or of this study; out/study-NAME where there is none. Of several studies: the folder that holds theirs
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub cores: CoresArguments,
    /// Memory for all runs at once in MiB; nine tenths of what is free where there is none
    #[arg(long, value_name = "MIB")]
    pub memory: Option<u64>,
    /// Where the runs are done
    #[arg(long, value_enum, default_value = "local")]
    pub engine: Engine,
    /// Further option for the job array, as in --sbatch=--partition=long
    #[arg(long, value_name = "OPTION", allow_hyphen_values = true)]
    pub sbatch: Vec<String>,
    /// Do only the run of this number, in this process
    #[arg(long, value_name = "I")]
    pub index: Option<std::num::NonZeroUsize>,
    /// Started by another process of the program, which holds the study folder and the standard input
    #[arg(long, hide = true, requires = "index")]
    pub worker: bool,
    /// The run must be of this case
    #[arg(long, hide = true, requires = "index")]
    pub digest: Option<String>,
}

/// Where runs are done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Engine {
    /// On this machine
    Local,
    /// As a job array of Slurm
    Slurm,
}

/// `study report`.
#[derive(Debug, Args)]
pub struct StudyReportArguments {
    /// Study files, one after the other
    #[arg(required = true, value_name = "STUDY")]
    pub studies: Vec<PathBuf>,
    /// Study folder, out/study-NAME where there is none. Of several studies: the folder that holds theirs
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

/// `schema`.
#[derive(Debug, Args)]
pub struct SchemaArguments {
    /// Print that of a study file
    #[arg(long)]
    pub study: bool,
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
