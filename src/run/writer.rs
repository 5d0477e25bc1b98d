//! Writes files in a separate thread, so that the solver continues meanwhile.
//!
//! Records are written in the order in which they arrive: a saved state is never ahead of earlier files. The first error ends the thread; it is
//! returned to the caller that hands over the next record or waits for the end.

use std::panic::resume_unwind;
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use super::processor_time;
use super::sink::{Frame, VtkFiles};
use meniscus_output::FileError;
use meniscus_output::frames::FrameList;
use meniscus_output::restart::{self, Saved};

/// Records that may wait while another one is written; the caller of one more waits, too. Each takes as much memory as the flow.
const WAITING: usize = 1;

/// A record to write.
pub(crate) enum Record {
    /// A frame for the VTK files.
    Frame(Box<Frame>),
    /// A state to resume from, without the mark in the list of frames, and the processor time in s until then.
    State(Saved, Option<f64>),
}

/// A writer thread.
pub(crate) struct Writer {
    records: Option<SyncSender<Record>>,
    thread: Option<JoinHandle<Result<(), FileError>>>,
}

impl Writer {
    /// Writes frames to `files`, listed in `frames`, and states to `folder`.
    ///
    /// # Errors
    /// [`FileError::Write`] if the system cannot start a thread.
    pub(crate) fn start(folder: &Path, files: VtkFiles, frames: FrameList) -> Result<Self, FileError> {
        let (sender, receiver) = sync_channel(WAITING);
        let target = folder.to_path_buf();
        let thread = std::thread::Builder::new()
            .name("output".into())
            .spawn(move || write_all(&target, files, frames, &receiver))
            .map_err(FileError::write(folder))?;
        Ok(Self { records: Some(sender), thread: Some(thread) })
    }

    /// Hands over a record; waits while too many are pending.
    ///
    /// # Errors
    /// The [`FileError`] of an earlier record, which ended the thread.
    pub(crate) fn write(&mut self, record: Record) -> Result<(), FileError> {
        match self.records.as_ref().map(|records| records.send(record)) {
            Some(Ok(())) => Ok(()),
            // The receiver is gone: the thread has failed.
            Some(Err(_)) | None => self.finish(),
        }
    }

    /// Waits until all is written.
    ///
    /// # Errors
    /// The [`FileError`] of the record that could not be written, once.
    pub(crate) fn finish(&mut self) -> Result<(), FileError> {
        self.records = None;
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(written)) => written,
            Some(Err(panic)) => resume_unwind(panic),
            None => Ok(()),
        }
    }
}

impl Drop for Writer {
    /// Pending records are still written if the run ends early.
    fn drop(&mut self) {
        self.records = None;
        if let Some(thread) = self.thread.take() {
            // Nobody is left to report an error to.
            let _ = thread.join();
        }
    }
}

fn write_all(
    folder: &Path,
    mut files: VtkFiles,
    mut frames: FrameList,
    records: &Receiver<Record>,
) -> Result<(), FileError> {
    for record in records {
        match record {
            Record::Frame(frame) => files.record(&frame, &mut frames)?,
            Record::State(saved, processor_time) => {
                processor_time::save(folder, processor_time)?;
                restart::save(folder, &Saved { frames: frames.mark(), ..saved })?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::mock::MockSolver;
    use super::*;
    use meniscus_core::solver::Solver;
    use meniscus_output::atomic;
    use meniscus_output::journal::Mark;
    use meniscus_output::vtk::Compression;

    fn state(step: u64) -> Record {
        let (series, frames) = (Mark::default(), Mark::default());
        Record::State(Saved { case_hash: 1, time: step as f64, step, series, frames, state: vec![7; 1000] }, Some(1.0))
    }

    fn writer(folder: &Path) -> Writer {
        Writer::start(folder, VtkFiles::new(folder, Vec::new(), Compression::Zlib), FrameList::new(folder)).unwrap()
    }

    #[test]
    fn records_are_written_in_their_order_and_all_before_the_end() {
        let folder = tempfile::tempdir().unwrap();
        let (mut writer, mut solver) = (writer(folder.path()), MockSolver::new());
        for step in 0..5 {
            writer.write(Record::Frame(Box::new(Frame::of(&solver)))).unwrap();
            writer.write(state(step)).unwrap();
            solver.step(1.0).unwrap();
        }
        writer.finish().unwrap();
        assert_eq!(restart::load(folder.path()).unwrap().step, 4);
        assert!(folder.path().join("particles/particles-000004.vtu").exists());
    }

    #[test]
    fn a_state_behind_a_frame_that_cannot_be_written_is_not_saved() {
        let folder = tempfile::tempdir().unwrap();
        atomic::write(&folder.path().join("grid"), b"").unwrap();
        let mut writer = writer(folder.path());
        let mut result = writer.write(Record::Frame(Box::new(Frame::of(&MockSolver::new()))));
        for step in 0..5 {
            result = result.and_then(|()| writer.write(state(step)));
        }
        let error = result.and_then(|()| writer.finish()).unwrap_err().to_string();
        assert!(error.contains("grid"), "{error}");
        assert!(!restart::path(folder.path()).exists());
        assert!(writer.finish().is_ok(), "an error is told once");
    }

    #[test]
    fn what_was_handed_over_is_written_where_no_one_waits_for_it() {
        let folder = tempfile::tempdir().unwrap();
        drop({
            let mut writer = writer(folder.path());
            writer.write(state(3)).unwrap();
            writer
        });
        assert_eq!(restart::load(folder.path()).unwrap().step, 3);
    }
}
