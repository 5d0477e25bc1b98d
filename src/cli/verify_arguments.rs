//! Arguments of `network verify`.

use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::study_arguments::EngineArguments;

/// Further commands on a network.
#[derive(Debug, Subcommand)]
pub(crate) enum NetworkCommand {
    /// Verify selected throats by direct simulation of subdomains: entry pressures and conductances next to those of the formulas
    Verify(Box<VerifyArguments>),
}

/// `network verify`.
#[derive(Debug, Args)]
pub(crate) struct VerifyArguments {
    /// Case file with `[network]` and an interface
    pub(crate) case: PathBuf,
    /// Throats: critical, unsure, random:N, or numbers of throats.csv as in 3,7,12; may be given several times
    #[arg(long, value_name = "WHICH", required = true)]
    pub(crate) throats: Vec<String>,
    /// Spacings across each throat, one run for each
    #[arg(long, value_name = "N,N", value_delimiter = ',', num_args = 1, default_values = ["8", "16"])]
    pub(crate) spacings: Vec<NonZeroU32>,
    /// Seed of the random throats
    #[arg(long, default_value = "1")]
    pub(crate) seed: u64,
    /// Use two equal fluids that come to rest soon instead of those of [network.phases]; no static pressure depends on them
    #[arg(long)]
    pub(crate) alike: bool,
    /// Change a value of the case
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) overrides: Vec<String>,
    /// Folder for cases, runs and results; out/NAME-verify if not given. The same command continues in it
    #[arg(long, visible_alias = "output", value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write cases and study file, but run nothing
    #[arg(long)]
    pub(crate) only_write: bool,
    /// Concurrent runs, each on one thread; as many as there are cores if not given
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
    #[command(flatten)]
    pub(crate) execution: EngineArguments,
}
