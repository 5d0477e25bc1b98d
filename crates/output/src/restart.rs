//! The saved state of a run: a header that identifies it, then the solver's bytes.
//!
//! The header (`postcard`) has the format version, the hash of the case, the time, the step and the extent of the other files that belongs to the state. A
//! checksum of all of it comes last, so that a state of another case, of another version, truncated or changed is refused before it is used. The previous file
//! is kept until the new one is complete.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::atomic::{self, FileError};
use super::checksum::fnv1a;
use super::journal::Mark;

/// First bytes of every file of this kind.
const MAGIC: &[u8; 8] = b"meniscus";
/// Version of the layout of the file.
const FORMAT_VERSION: u32 = 4;
/// The remedy for every damaged state.
const START_AGAIN: &str = "put the file back from a copy, or start the run again with another --out DIR";
/// Bytes of the checksum.
const CHECKSUM: usize = 8;

/// A saved state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Saved {
    /// Hash of the case that the state belongs to.
    pub case_hash: u64,
    /// Time in s.
    pub time: f64,
    /// Number of steps done.
    pub step: u64,
    /// The extent of `series.csv` that belongs to it.
    pub series: Mark,
    /// The extent of the list of written frames that belongs to it.
    pub frames: Mark,
    /// The bytes of `Solver::state`, which follow the header.
    #[serde(skip)]
    pub state: Vec<u8>,
}

/// The file of the saved state of the run in `folder`.
pub fn path(folder: &Path) -> PathBuf {
    folder.join("restart").join("state.bin")
}

/// Saves a state in `folder`.
///
/// # Errors
/// [`FileError`]; then the previous state still exists.
pub fn save(folder: &Path, saved: &Saved) -> Result<(), FileError> {
    let path = path(folder);
    let header = postcard::to_stdvec(&(FORMAT_VERSION, saved)).map_err(FileError::format(&path))?;
    let mut bytes = [MAGIC.as_slice(), &header, &saved.state].concat();
    bytes.extend(fnv1a(&bytes).to_le_bytes());
    atomic::write(&path, &bytes)
}

/// Reads the saved state in `folder` and checks that it is complete.
///
/// # Errors
/// [`FileError::Read`] if there is none, [`FileError::Content`] if it is truncated, changed or of another version.
pub fn load(folder: &Path) -> Result<Saved, FileError> {
    let path = path(folder);
    let bytes = std::fs::read(&path).map_err(FileError::read(&path))?;
    decode(&bytes).map_err(|what| FileError::content(&path)(format!("{what}; {START_AGAIN}")))
}

fn decode(bytes: &[u8]) -> Result<Saved, String> {
    if !bytes.starts_with(MAGIC) {
        return Err("it is not a saved state of this program".to_owned());
    }
    let (version, _) = postcard::take_from_bytes::<u32>(&bytes[MAGIC.len()..]).unwrap_or_default();
    if version != FORMAT_VERSION {
        return Err(format!("expected a state of format {FORMAT_VERSION}, found format {version}"));
    }
    let (content, checksum) = bytes.split_at(bytes.len().saturating_sub(CHECKSUM));
    if fnv1a(content).to_le_bytes() != checksum {
        return Err("its checksum does not match: it was changed, damaged or cut short".to_owned());
    }
    let rest = &content[MAGIC.len().min(content.len())..];
    let ((_, header), state) =
        postcard::take_from_bytes::<(u32, Saved)>(rest).map_err(|_| "its header cannot be read".to_owned())?;
    Ok(Saved { state: state.to_vec(), ..header })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saved_state_reads_back_with_the_same_bits_and_is_refused_if_cut_short_anywhere_or_changed() {
        let folder = tempfile::tempdir().unwrap();
        let (series, frames, state) = (Mark::after(b"a"), Mark::after(b"b"), (0..=255).collect());
        let saved = Saved { case_hash: u64::MAX, time: 0.1 + 0.2, step: 7, series, frames, state };
        save(folder.path(), &saved).unwrap();
        assert_eq!(load(folder.path()).unwrap(), saved);
        let bytes = std::fs::read(path(folder.path())).unwrap();
        for length in 0..bytes.len() {
            assert!(decode(&bytes[..length]).is_err(), "{length} bytes were accepted");
        }
        for bit in 0..8 * bytes.len() {
            let mut changed = bytes.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            assert!(decode(&changed).is_err(), "bit {bit} was changed and accepted");
        }
    }
}
