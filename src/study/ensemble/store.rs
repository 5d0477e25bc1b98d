//! `samples.bin`: the finished samples of an ensemble, so that an interrupted one can be resumed.
//!
//! Format version, then for each sample its digest and its outcome (`postcard`); a checksum of all of it comes last. An unreadable file is ignored: the samples
//! are run anew.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::run::ensemble::Observed;
use meniscus_output::checksum::fnv1a;
use meniscus_output::{FileError, atomic};

/// First bytes of the file.
const MAGIC: &[u8; 8] = b"samples\n";
/// Version of its layout.
const VERSION: u32 = 1;
/// Bytes of the checksum.
const CHECKSUM: usize = 8;

/// The outcome of a sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Done {
    /// Identifies its case.
    pub(crate) digest: u64,
    /// Its results, or why it failed.
    pub(crate) ended: Result<Observed, String>,
}

impl Done {
    /// Its results, unless it failed.
    pub(crate) fn observed(&self) -> Option<&Observed> {
        self.ended.as_ref().ok()
    }
}

/// The file in a study folder.
fn path(folder: &Path) -> PathBuf {
    folder.join("samples.bin")
}

/// The finished samples with these digests; the result is as long as the list.
pub(crate) fn load(folder: &Path, digests: &[u64]) -> Vec<Option<Done>> {
    let mut kept = std::fs::read(path(folder)).ok().and_then(|bytes| decode(&bytes)).unwrap_or_default();
    kept.resize(digests.len(), None);
    kept.into_iter().zip(digests).map(|(done, digest)| done.filter(|done| done.digest == *digest)).collect()
}

fn decode(bytes: &[u8]) -> Option<Vec<Option<Done>>> {
    let (content, checksum) = bytes.split_at_checked(bytes.len().checked_sub(CHECKSUM)?)?;
    if fnv1a(content).to_le_bytes() != checksum {
        return None;
    }
    let (version, done): (u32, _) = postcard::from_bytes(content.strip_prefix(MAGIC)?).ok()?;
    (version == VERSION).then_some(done)
}

/// Writes the finished samples.
///
/// # Errors
/// [`FileError`]; then the previous file still exists.
pub(crate) fn save(folder: &Path, done: &[Option<Done>]) -> Result<(), FileError> {
    let path = path(folder);
    let content = postcard::to_stdvec(&(VERSION, done))
        .map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
    let mut bytes = [MAGIC.as_slice(), &content].concat();
    bytes.extend(fnv1a(&bytes).to_le_bytes());
    atomic::write(&path, &bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Vec<Option<Done>> {
        let observed = Observed {
            measures: vec![("breakthrough-pressure-Pa".into(), "Pa".into(), 0.1 + 0.2)],
            curves: vec![vec![f64::INFINITY, 1.0, f64::NEG_INFINITY]],
            seconds: 0.5,
            ..Observed::default()
        };
        let failed = Done { digest: 2, ended: Err("no pore opens".into()) };
        vec![Some(Done { digest: 1, ended: Ok(observed) }), None, Some(failed)]
    }

    #[test]
    fn what_was_saved_reads_back_where_its_case_is_the_same() {
        let folder = tempfile::tempdir().unwrap();
        save(folder.path(), &example()).unwrap();
        assert_eq!(load(folder.path(), &[1, 5, 2]), example());
        let found = load(folder.path(), &[9, 5, 2, 3]);
        assert!(found.len() == 4 && found[0].is_none() && found[2].is_some());
    }

    #[test]
    fn a_file_cut_short_or_changed_is_none() {
        let folder = tempfile::tempdir().unwrap();
        save(folder.path(), &example()).unwrap();
        let bytes = std::fs::read(path(folder.path())).unwrap();
        assert!(decode(&bytes).is_some());
        assert!((0..bytes.len()).all(|length| decode(&bytes[..length]).is_none()));
        let mut changed = bytes;
        changed[20] ^= 1;
        assert_eq!(decode(&changed), None);
    }
}
