//! What a run leaves behind, for tests that compare runs byte by byte.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// All files below `folder` but the report, which tells wall times, and the processor time beside the saved state.
pub fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        for entry in std::fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if !path.ends_with("report.json") && !path.ends_with("restart/cpu-s") {
                all.insert(path.strip_prefix(folder).unwrap().to_path_buf(), std::fs::read(&path).unwrap());
            }
        }
    }
    all
}
