//! Why there is no movie of a folder.

use std::path::PathBuf;

use crate::run::report::REPORT;
use crate::run::setup::SetupError;
use meniscus_core::input::InputError;
use meniscus_output::FileError;
use meniscus_output::movie::MovieError;
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
