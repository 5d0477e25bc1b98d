//! What can be written behind `network verify`.

use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::study_arguments::EngineArguments;

/// What is done with a network.
#[derive(Debug, Subcommand)]
pub(crate) enum NetworkCommand {
    /// Verify chosen throats by direct simulation of cut-outs: entry pressures and conductances beside those of the formulas
    Verify(Box<VerifyArguments>),
}

/// `network verify`.
#[derive(Debug, Args)]
pub(crate) struct VerifyArguments {
    /// Case file with `[network]` and an interface
    pub(crate) case: PathBuf,
    /// Throats: critical, unsure, random:N, or numbers of throats.csv as in 3,7,12; may be given several times
    #[arg(long, value_name = "WHICH", required_unless_present = "events")]
    pub(crate) throats: Vec<String>,
    /// Touches and overlaps: critical, touch:N, overlap:N, or numbers of events.csv as in 1,4; may be given several times
    #[arg(long, value_name = "WHICH")]
    pub(crate) events: Vec<String>,
    /// Spacings across each throat, one run for each
    #[arg(long, value_name = "N,N", value_delimiter = ',', num_args = 1, default_values = ["8", "16"])]
    pub(crate) spacings: Vec<NonZeroU32>,
    /// Chooses the random throats and events
    #[arg(long, default_value = "1")]
    pub(crate) seed: u64,
    /// Take two fluids alike that come to rest soon in place of those of [network.phases]; no pressure at rest depends on them
    #[arg(long)]
    pub(crate) alike: bool,
    /// Change a value of the case
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) overrides: Vec<String>,
    /// Folder for cases, runs and results; out/NAME-verify where there is none. The same command goes on in it
    #[arg(long, visible_alias = "output", value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Write cases and study file, and run nothing
    #[arg(long)]
    pub(crate) only_write: bool,
    /// Runs at once, each on one thread; as many as there are cores where there is none
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
    #[command(flatten)]
    pub(crate) place: EngineArguments,
}
