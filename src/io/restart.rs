//! The saved state of a run: a header that says what it belongs to, then the solver's bytes.
//!
//! The header (`postcard`) holds format version, hash of the case, time, step and a checksum of the state, so that a state
//! of another case, of another version, or cut short is refused before it is used. The file before stays until the new one
//! is complete.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::atomic::{self, FileError};
use super::checksum::fnv1a;

/// First bytes of every file of this kind.
const MAGIC: &[u8; 8] = b"meniscus";
/// Version of the layout of the file.
const FORMAT_VERSION: u32 = 1;
/// The way out of every broken state.
const START_AGAIN: &str = "start the run again without --resume";

/// A saved state.
#[derive(Debug, Clone, PartialEq)]
pub struct Saved {
    /// Hash of the case that the state belongs to.
    pub case_hash: u64,
    /// Time in s.
    pub time: f64,
    /// Number of steps done.
    pub step: u64,
    /// The bytes of `Solver::state`.
    pub state: Vec<u8>,
}

#[derive(Serialize, Deserialize)]
struct Header {
    format_version: u32,
    case_hash: u64,
    time: f64,
    step: u64,
    checksum: u64,
    length: u64,
}

/// The file of the saved state of the run in `folder`.
#[must_use]
pub fn path(folder: &Path) -> PathBuf {
    folder.join("restart").join("state.bin")
}

/// Saves a state in `folder`.
///
/// # Errors
/// [`FileError`]; then the state before is still there.
pub fn save(folder: &Path, saved: &Saved) -> Result<(), FileError> {
    let path = path(folder);
    let header = Header {
        format_version: FORMAT_VERSION,
        case_hash: saved.case_hash,
        time: saved.time,
        step: saved.step,
        checksum: fnv1a(&saved.state),
        length: saved.state.len() as u64,
    };
    let header = postcard::to_stdvec(&header)
        .map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
    atomic::write(&path, &[MAGIC.as_slice(), &header, &saved.state].concat())
}

/// Reads the saved state in `folder` and checks that it is complete.
///
/// # Errors
/// [`FileError::Read`] where there is none, [`FileError::Content`] where it is cut short, changed or of another version.
pub fn load(folder: &Path) -> Result<Saved, FileError> {
    let path = path(folder);
    let bytes = std::fs::read(&path).map_err(FileError::read(&path))?;
    decode(&bytes).map_err(|what| FileError::Content { path, what: format!("{what}; {START_AGAIN}") })
}

fn decode(bytes: &[u8]) -> Result<Saved, String> {
    let rest = bytes.strip_prefix(MAGIC.as_slice()).ok_or("it is not a saved state of this program")?;
    let (header, state) =
        postcard::take_from_bytes::<Header>(rest).map_err(|_| "its header is cut short".to_owned())?;
    if header.format_version != FORMAT_VERSION {
        return Err(format!(
            "it is of format {}, this version of the program reads format {FORMAT_VERSION}",
            header.format_version
        ));
    }
    if header.length != state.len() as u64 {
        return Err(format!("expected a state of {} bytes, found {}", header.length, state.len()));
    }
    if header.checksum != fnv1a(state) {
        return Err("its checksum does not match: the file was changed or damaged".to_owned());
    }
    Ok(Saved { case_hash: header.case_hash, time: header.time, step: header.step, state: state.to_vec() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Saved {
        Saved { case_hash: u64::MAX, time: 0.1 + 0.2, step: 7, state: (0..=255).collect() }
    }

    #[test]
    fn a_saved_state_reads_back_with_the_same_bits() {
        let folder = tempfile::tempdir().unwrap();
        save(folder.path(), &example()).unwrap();
        assert_eq!(load(folder.path()).unwrap(), example());
    }

    #[test]
    fn a_state_cut_short_anywhere_or_changed_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        save(folder.path(), &example()).unwrap();
        let bytes = std::fs::read(path(folder.path())).unwrap();
        for length in 0..bytes.len() {
            assert!(decode(&bytes[..length]).is_err(), "{length} bytes were accepted");
        }
        let mut changed = bytes;
        if let Some(last) = changed.last_mut() {
            *last ^= 1;
        }
        assert!(decode(&changed).unwrap_err().contains("checksum"));
    }
}
