//! `meniscus movie`: a movie of a run from its output folder.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::Args;

use super::exit::{DONE, Failure, USAGE};
use super::output::{duration, say, tell};
use super::progress::ProgressDisplay;
use super::threads::pool;
use crate::run::movie::movie as frames;
use meniscus_output::atomic;
use meniscus_output::movie::Format;

/// How long the last frame stays before the movie begins again, in s.
const REST: f64 = 2.0;

/// `movie`.
#[derive(Debug, Args)]
pub(crate) struct MovieArguments {
    /// Output folder of a run
    pub(crate) folder: PathBuf,
    /// File to write, replaced if it exists: .gif, or .png or .apng for an animated PNG; if not given, movie.gif in the folder
    #[arg(long, value_name = "FILE")]
    pub(crate) out: Option<PathBuf>,
    /// Frames per second, 1 to 50
    #[arg(long, value_name = "N", default_value = "12", value_parser = clap::value_parser!(u32).range(1..=50))]
    pub(crate) rate: u32,
    /// Number of threads; all cores if not given
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<NonZeroUsize>,
}

/// Draws all frames of a run and writes its movie.
pub(crate) fn movie(arguments: &MovieArguments) -> Result<u8, Failure> {
    let path = arguments.out.clone().unwrap_or_else(|| arguments.folder.join("movie.gif"));
    let (format, clock) = (format_of(&path)?, Instant::now());
    let (movie, notes) = pool(arguments.threads)?.install(|| {
        let mut display = ProgressDisplay::new();
        let found = frames(&arguments.folder, &mut |fraction| display.filmed(fraction));
        display.finish();
        found.map_err(Failure::with(USAGE))
    })?;
    notes.iter().for_each(|note| tell(format_args!("  WARNING     {note}")));
    let count = movie.len();
    let bytes = movie.encoded(format, f64::from(arguments.rate), REST).map_err(Failure::with(USAGE))?;
    atomic::write(&path, &bytes).map_err(Failure::with(USAGE))?;
    let (size, seconds) = (bytes.len() as f64 / 1e6, clock.elapsed().as_secs_f64());
    say(format_args!("{}: {count} frames, {size:.1} MB, in {}", path.display(), duration(seconds)));
    Ok(DONE)
}

/// The format by the ending of a file.
fn format_of(path: &Path) -> Result<Format, Failure> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("gif") => Ok(Format::Gif),
        Some("png" | "apng") => Ok(Format::Apng),
        _ => {
            let what = format!(
                "--out {}: a movie ends in .gif, .png or .apng; ffmpeg turns it into other formats",
                path.display()
            );
            Err(Failure::new(USAGE, what))
        }
    }
}
