//! Reads the state of a network from which a case starts, and checks it against the geometry of the case.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::case_file::RawCase;
use super::network::state::{NetworkState, Start};
use meniscus_core::input::{Checker, file};
use meniscus_core::math::{FNV1A_BASIS, fnv1a};
use meniscus_geometry::spec::GeometrySpec;

/// Advice for a file that is not a state.
const WRITE: &str =
    "a run of [network] with an inlet writes at-end.json and, where it breaks through, at-breakthrough.json";

/// The key of a state file, and the file.
fn named(raw: &RawCase) -> Option<(&'static str, &Path)> {
    let of_sph = raw.sph.as_ref().and_then(|sph| sph.initial.as_ref()?.network.as_deref());
    let of_network = raw.network.as_ref().and_then(|network| network.initial.as_deref());
    of_sph.map(|file| ("sph.initial.network", file)).or(of_network.map(|file| ("network.initial", file)))
}

/// The initial state of the case: `given` instead of its file, which is relative to the `folder` of the case file; `None` if the case names none, or if it is
/// refused.
pub(super) fn start(
    checker: &mut Checker,
    raw: &RawCase,
    folder: &Path,
    given: Option<&str>,
    geometry: Option<&GeometrySpec>,
    sources: &mut Vec<PathBuf>,
) -> Option<Start> {
    let (key, file) = named(raw)?;
    let path = folder.join(file);
    let path = std::path::absolute(&path).unwrap_or(path);
    let read = match given {
        Some(text) => Ok(text.to_owned()),
        None => {
            sources.push(path.clone());
            file::read_text(&path)
        }
    };
    let name = given.map_or_else(|| path.display().to_string(), |_| "the state of the network".to_owned());
    let text = match read {
        Ok(text) => text,
        Err(error) => {
            let what = match error.kind() {
                std::io::ErrorKind::NotFound => format!("there is no file {}", path.display()),
                _ => format!("{} cannot be read: {error}", path.display()),
            };
            checker.refuse(key, what, format!("{WRITE}; its path is relative to the case file"));
            return None;
        }
    };
    let state = match NetworkState::read(&text) {
        Ok(state) => state,
        Err(error) => {
            checker.refuse(key, format!("{} is not a network state: {error}", path.display()), WRITE);
            return None;
        }
    };
    if let Some(misfit) = geometry.and_then(|geometry| state.misfit(geometry)) {
        let message = format!("{name} belongs to another geometry: {misfit}");
        let help = match given {
            Some(_) => "let both cases name the same shape file",
            None => "run the network of this geometry first, and take the state that it writes",
        };
        checker.refuse(key, message, help);
        return None;
    }
    // So that a saved run detects a changed file.
    let digest = fnv1a(FNV1A_BASIS, text.bytes());
    Some(Start { file: path, digest: format!("{digest:016x}"), state: Arc::new(state) })
}
