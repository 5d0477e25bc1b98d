//! Processor time of a run, over all its processes and all their threads.
//!
//! It is saved and restored with the state. What a killed process did after it last saved its state is not included: that is repeated, and counted then.

use std::path::{Path, PathBuf};

use cpu_time::ProcessTime;

use meniscus_output::checksum::fnv1a;
use meniscus_output::{FileError, atomic};

/// Measures the processor time of this process since it started on a run, and has that of earlier processes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProcessorTime {
    /// In s; `None` if an earlier process did not report it.
    before: Option<f64>,
    /// `None` if the system does not report it.
    begun: Option<ProcessTime>,
}

/// Its file, in s as text, with a checksum of the text: a wrong number would be worse than none.
fn file(folder: &Path) -> PathBuf {
    folder.join("restart").join("cpu-s")
}

impl ProcessorTime {
    /// From now on, for a new run.
    pub(crate) fn start() -> Self {
        Self { before: Some(0.0), begun: ProcessTime::try_now().ok() }
    }

    /// With the time of earlier processes until they saved the state in `folder`.
    pub(crate) fn after_that_in(self, folder: &Path) -> Self {
        let saved = std::fs::read_to_string(file(folder)).ok();
        let before = saved.and_then(|text| {
            let (seconds, checksum) = text.trim().split_once(' ')?;
            (checksum == checksum_of(seconds)).then_some(seconds)?.parse().ok()
        });
        Self { before, ..self }
    }

    /// In s until now; `None` if the part of a process is not known.
    pub(crate) fn seconds(&self) -> Option<f64> {
        Some(self.before? + self.begun?.try_elapsed().ok()?.as_secs_f64())
    }
}

/// Saves `seconds` of processor time for the process that resumes the run in `folder`.
pub(crate) fn save(folder: &Path, seconds: Option<f64>) -> Result<(), FileError> {
    let text = seconds.map_or("unknown".to_owned(), |seconds| seconds.to_string());
    let text = format!("{text} {}\n", checksum_of(&text));
    atomic::write(&file(folder), text.as_bytes())
}

fn checksum_of(text: &str) -> String {
    format!("{:016x}", fnv1a(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keeps the processor busy until at least this many seconds of it are spent.
    fn work(seconds: f64) {
        let begun = ProcessTime::now();
        while begun.elapsed().as_secs_f64() < seconds {
            std::hint::black_box((0..1000).map(f64::from).sum::<f64>());
        }
    }

    #[test]
    fn processor_time_goes_on_where_the_saved_one_stood() {
        let folder = tempfile::tempdir().unwrap();
        let first = ProcessorTime::start();
        work(0.02);
        let saved = first.seconds().unwrap();
        save(folder.path(), Some(saved)).unwrap();
        let second = ProcessorTime::start().after_that_in(folder.path());
        work(0.02);
        // Other tests of this process may run concurrently: there is no upper bound.
        assert!(saved >= 0.02 && second.seconds().unwrap() >= 0.04, "{saved} {second:?}");
    }

    #[test]
    fn processor_time_is_unknown_where_an_earlier_process_did_not_tell_it() {
        let folder = tempfile::tempdir().unwrap();
        let resumed = ProcessorTime::start().after_that_in(folder.path());
        assert_eq!(resumed.seconds(), None);
        save(folder.path(), resumed.seconds()).unwrap();
        assert_eq!(ProcessorTime::start().after_that_in(folder.path()).seconds(), None);
    }
}
