//! Arguments of `study`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

/// `study`.
#[derive(Debug, Subcommand)]
pub(crate) enum StudyCommand {
    /// List the runs of a study: what varies, particles, memory, expected duration
    Plan(StudyPlanArguments),
    /// Do all incomplete runs, then write the report
    Run(Box<StudyRunArguments>),
    /// Write table, curves and page from the completed runs
    Report(StudyFiles),
}

/// Studies and their folder: the arguments of `study report`.
#[derive(Debug, Args)]
pub(crate) struct StudyFiles {
    /// Study files, one after the other
    #[arg(required = true, value_name = "STUDY")]
    pub(crate) studies: Vec<PathBuf>,
    /// Study folder, new or of this study; out/study-NAME if not given. Of several studies: the folder that contains theirs
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// `study plan`, which writes nothing.
#[derive(Debug, Args)]
pub(crate) struct StudyPlanArguments {
    #[command(flatten)]
    pub(crate) files: StudyFiles,
    #[command(flatten)]
    pub(crate) cores: CoresArguments,
}

/// Threads and concurrent runs.
#[derive(Debug, Args)]
pub(crate) struct CoresArguments {
    /// Threads of each run
    #[arg(long, value_name = "N", default_value = "1")]
    pub(crate) threads: std::num::NonZeroUsize,
    /// Concurrent runs; as many as the cores allow if not given
    #[arg(long, value_name = "N")]
    pub(crate) jobs: Option<std::num::NonZeroUsize>,
}

/// `study run`.
#[derive(Debug, Args)]
pub(crate) struct StudyRunArguments {
    #[command(flatten)]
    pub(crate) files: StudyFiles,
    #[command(flatten)]
    pub(crate) cores: CoresArguments,
    /// Memory for all concurrent runs in MiB; nine tenths of the free memory if not given
    #[arg(long, value_name = "MIB")]
    pub(crate) memory: Option<u64>,
    #[command(flatten)]
    pub(crate) execution: EngineArguments,
    /// Do only the run of this number, in this process
    #[arg(long, value_name = "I")]
    pub(crate) index: Option<std::num::NonZeroUsize>,
    /// Started by another process of the program, which holds the study folder and the standard input
    #[arg(long, hide = true, requires = "index")]
    pub(crate) worker: bool,
    /// Expected digest of the case of the run
    #[arg(long, hide = true, requires = "index")]
    pub(crate) digest: Option<String>,
}

/// Where runs are done, and how.
#[derive(Debug, Clone, Args)]
pub(crate) struct EngineArguments {
    /// Where the runs are done
    #[arg(long, value_enum, default_value = "local")]
    pub(crate) engine: Engine,
    /// Further option for the job array, as in --sbatch=--partition=long
    #[arg(long, value_name = "OPTION", allow_hyphen_values = true)]
    pub(crate) sbatch: Vec<String>,
}

/// Where runs are done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Engine {
    /// On this machine
    Local,
    /// As a job array of Slurm
    Slurm,
}
