//! `samples.bin`: the finished samples of an ensemble, so that an interrupted one can be resumed.
//!
//! Format version, then for each sample its digest and its outcome (`postcard`); a checksum of all of it comes last. An unreadable file is ignored: the samples
//! are run anew.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::io::checksum::fnv1a;
use crate::io::{FileError, atomic};
use crate::run::ensemble::Outcome;

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
    pub(crate) ended: Result<Kept, String>,
}

/// The stored results of a sample.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Kept {
    /// Name, unit and value of each measure.
    pub(crate) measures: Vec<(String, String, f64)>,
    /// For each half cycle the capillary pressure at all saturations.
    pub(crate) curves: Vec<Vec<f64>>,
    /// Eight parts of the map per byte.
    invaded: Vec<u8>,
    /// Number of events or steps.
    pub(crate) steps: u64,
    /// Number of pores.
    pub(crate) pores: usize,
    /// Wall time in s.
    pub(crate) seconds: f64,
}

impl Kept {
    /// The stored results of an outcome that took `seconds`.
    pub(crate) fn of(outcome: Outcome, seconds: f64) -> Self {
        let byte = |parts: &[bool]| parts.iter().enumerate().fold(0, |byte, (k, &is)| byte | (u8::from(is) << k));
        let invaded = outcome.invaded.chunks(8).map(byte).collect();
        let Outcome { measures, curves, steps, pores, .. } = outcome;
        Self { measures, curves, invaded, steps, pores, seconds }
    }

    /// Whether a part of the map was invaded.
    pub(crate) fn is_invaded(&self, part: usize) -> bool {
        self.invaded.get(part / 8).is_some_and(|byte| byte >> (part % 8) & 1 == 1)
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
    let (version, rest) = postcard::take_from_bytes::<u32>(content.strip_prefix(MAGIC)?).ok()?;
    if version == VERSION { postcard::from_bytes(rest).ok() } else { None }
}

/// Writes the finished samples.
///
/// # Errors
/// [`FileError`]; then the previous file still exists.
pub(crate) fn save(folder: &Path, done: &[Option<Done>]) -> Result<(), FileError> {
    let path = path(folder);
    let failed = |error: postcard::Error| FileError::Format { path: path.clone(), what: error.to_string() };
    let mut bytes = MAGIC.to_vec();
    bytes.extend(postcard::to_stdvec(&VERSION).map_err(failed)?);
    bytes.extend(postcard::to_stdvec(done).map_err(failed)?);
    bytes.extend(fnv1a(&bytes).to_le_bytes());
    atomic::write(&path, &bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Vec<Option<Done>> {
        let outcome = Outcome {
            measures: vec![("breakthrough-pressure-Pa".into(), "Pa".into(), 0.1 + 0.2)],
            curves: vec![vec![f64::INFINITY, 1.0, f64::NEG_INFINITY]],
            invaded: (0..11).map(|k| k % 3 == 0).collect(),
            steps: 7,
            pores: 3,
        };
        let failed = Done { digest: 2, ended: Err("no pore opens".into()) };
        vec![Some(Done { digest: 1, ended: Ok(Kept::of(outcome, 0.5)) }), None, Some(failed)]
    }

    #[test]
    fn what_was_saved_reads_back_where_its_case_is_the_same() {
        let folder = tempfile::tempdir().unwrap();
        save(folder.path(), &example()).unwrap();
        assert_eq!(load(folder.path(), &[1, 5, 2]), example());
        let found = load(folder.path(), &[9, 5, 2, 3]);
        assert!(found.len() == 4 && found[0].is_none() && found[2].is_some());
        let Some(Ok(kept)) = example().remove(0).map(|done| done.ended) else { panic!("kept") };
        assert!((0..12).all(|part| kept.is_invaded(part) == (part < 11 && part % 3 == 0)));
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
