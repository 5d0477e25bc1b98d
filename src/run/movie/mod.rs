//! The movie of a run, from its folder: every frame drawn like `picture.png`.
//!
//! A direct simulation and a thin film have their frames in VTK files ([`files`]). A network is computed again from its case ([`network`]): that takes as long as
//! the run, seconds, and gives every event with its menisci and films, which the two records of `meniscus network` do not.

mod ended;
mod failure;
mod files;
mod network;

use std::path::Path;

use self::ended::{Ended, ended};
use self::failure::MovieFailure;
use self::files::Subject;
use meniscus_case::Model;
use meniscus_output::movie::Movie;

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
        if network.displacement.is_none() {
            return Err(MovieFailure::NoDisplacement(folder.to_path_buf()));
        }
        return network::movie(&source.case.with_all_results(), written, progress);
    }
    if ended.is_none() && folder.join("regions.pvd").exists() {
        return Err(MovieFailure::NoReport(folder.to_path_buf()));
    }
    let subject = Subject::of(ended.as_ref().map(|ended| &ended.source.case), folder);
    Ok((files::movie(folder, &subject, progress)?, Vec::new()))
}
