//! The movie of a run, from its folder: every frame drawn like `picture.png`.
//!
//! A direct simulation and a thin film have their frames in VTK files ([`files`]). A network is computed again from its case ([`network`]): that takes as long as
//! the run, seconds, and gives every event with its menisci and films, which the two records of `meniscus network` do not.

mod files;
mod network;

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::report::{REPORT, Status};
use super::setup::{self, SetupError};
use super::source::{Source, load_case_text};
use meniscus_case::{Case, Model};
use meniscus_core::diagram::Frame;
use meniscus_core::input::InputError;
use meniscus_output::FileError;
use meniscus_output::movie::{Movie, MovieError};
use meniscus_output::picture::PictureError;

/// Why there is no movie of a folder.
#[derive(Debug, thiserror::Error)]
pub(crate) enum MovieFailure {
    /// No such folder.
    #[error("there is no folder {}; give the output folder of a run, such as out/four-discs", .0.display())]
    NoFolder(PathBuf),
    /// Neither frames nor a case.
    #[error(
        "{} holds no frames: it has no particles.pvd, and no {REPORT} of a network; give the output folder of a run, of a study \
         that of one run, such as DIR/runs/NAME", .0.display()
    )]
    NoFrames(PathBuf),
    /// A network that has not ended.
    #[error(
        "{} has no {REPORT}, from which the movie of a network is made; wait until the run has ended, or interrupt it by Ctrl-C: it \
         can be resumed", .0.display()
    )]
    NoReport(PathBuf),
    /// A network without a displacement.
    #[error("nothing moves in {}: its network has no displacement; give it an inlet and an outlet", .0.display())]
    NoDisplacement(PathBuf),
    /// A single frame.
    #[error("{} holds a single frame; run the case again with a smaller output.vtk.{key}", folder.display())]
    OneFrame {
        /// The folder.
        folder: PathBuf,
        /// The key of the interval.
        key: &'static str,
    },
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The case in the report cannot be read.
    #[error("the case in {}: {error}", path.display())]
    Case {
        /// The report.
        path: PathBuf,
        /// What is wrong with its case.
        error: Box<InputError>,
    },
    /// The solver of the case cannot be made.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A frame cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The frames do not make a movie.
    #[error(transparent)]
    Movie(#[from] MovieError),
}

/// What the report of a run tells about it.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Written {
    version: String,
    status: Status,
    clock: Reached,
    steps: u64,
    resolved_case: String,
}

/// The end of a run.
#[derive(Debug, Deserialize)]
struct Reached {
    value: f64,
}

/// A run that has left a report.
struct Ended {
    written: Written,
    source: Source,
}

/// What pictures need to know about a run.
struct Subject {
    title: String,
    frame: Option<Frame>,
}

impl Subject {
    /// From the case, or of a run without a report from its folder.
    fn of(case: Option<&Case>, folder: &Path) -> Self {
        let name = || folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Self { title: case.map_or_else(name, |case| case.title.clone()), frame: case.and_then(setup::frame) }
    }
}

/// The frames of a run with notes for its user; `progress` receives the fraction of the work that is done.
///
/// # Errors
/// [`MovieFailure`] with a way out.
pub(crate) fn movie(folder: &Path, progress: &mut dyn FnMut(f64)) -> Result<(Movie, Vec<String>), MovieFailure> {
    if !folder.is_dir() {
        return Err(MovieFailure::NoFolder(folder.to_path_buf()));
    }
    let ended = ended(folder)?;
    if let Some(Ended { written, source }) = &ended
        && let Model::Network(network) = &source.case.model
    {
        let has_displacement = network.displacement.is_some();
        let found = if has_displacement { Some(network::movie(&source.case, written, progress)?) } else { None };
        return found.ok_or_else(|| MovieFailure::NoDisplacement(folder.to_path_buf()));
    }
    if ended.is_none() && folder.join("regions.pvd").exists() {
        return Err(MovieFailure::NoReport(folder.to_path_buf()));
    }
    let subject = Subject::of(ended.as_ref().map(|ended| &ended.source.case), folder);
    Ok((files::movie(folder, &subject, progress)?, Vec::new()))
}

/// The report and the case of a run; `None` if there is no report yet.
fn ended(folder: &Path) -> Result<Option<Ended>, MovieFailure> {
    let path = folder.join(REPORT);
    if !path.exists() {
        return Ok(None);
    }
    let bytes = std::fs::read(&path).map_err(FileError::read(&path))?;
    let written: Written = serde_json::from_slice(&bytes).map_err(|error| FileError::Content {
        path: path.clone(),
        what: format!("{error}; continue the run with --resume, which writes it again"),
    })?;
    let source = load_case_text(REPORT, &written.resolved_case, &[])
        .map_err(|error| MovieFailure::Case { path, error: Box::new(error) })?;
    Ok(Some(Ended { written, source }))
}
