//! Two displacements in networks, each an ordinary run in a folder of its own, played on one page.

use std::path::{Path, PathBuf};

use super::files::PAGE;
use crate::run::execute::Mode;
use meniscus_core::playback::Playback;
use meniscus_output::network_page::{self, TooMany};
use meniscus_output::{FileError, atomic, restart};

/// The folders of both runs.
pub(crate) const RUNS: [&str; 2] = ["first", "second"];

/// How a run starts: anew, or where a comparison is resumed from its saved state, if it has one.
pub(crate) fn mode_in(folder: &Path, resumes: bool) -> Mode {
    if resumes && restart::path(folder).exists() { Mode::Resume } else { Mode::New }
}

/// Writes the page of both, each with its title, with one slider; returns its path.
///
/// # Errors
/// [`FileError`] if it cannot be written.
pub(crate) fn write(both: [(&str, &Playback); 2], folder: &Path) -> Result<Result<PathBuf, TooMany>, FileError> {
    let path = folder.join(PAGE);
    let title = format!("{} | {}", both[0].0, both[1].0);
    match network_page::page(&title, &both) {
        Ok(html) => atomic::write(&path, html.as_bytes()).map(|()| Ok(path)),
        Err(too_many) => Ok(Err(too_many)),
    }
}
