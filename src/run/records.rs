//! Records of a run: the series, and if it has a folder, VTK files and saved states.

use std::path::{Path, PathBuf};
use std::time::Instant;

use super::processor_time::ProcessorTime;
use super::schedule::Due;
use super::sink::{Frame, Start, VtkFiles, write_units};
use super::writer::{Record, Writer};
use meniscus_core::solver::{PartTime, Series, Solver};
use meniscus_output::frames::{self, FrameList};
use meniscus_output::journal::Mark;
use meniscus_output::restart::Saved;
use meniscus_output::series::SeriesFile;
use meniscus_output::vtk::Compression;
use meniscus_output::{FileError, atomic, pvd, vtk};

/// The records of a run, and their wall time.
#[derive(Default)]
pub(crate) struct Records {
    series: SeriesFile,
    files: Option<Files>,
    seconds: [f64; 3],
}

/// Where the files of a run are written, and what they need.
struct Files {
    folder: PathBuf,
    writer: Writer,
    processor_time: ProcessorTime,
    case_hash: u64,
    compression: Compression,
}

impl Records {
    /// The records of a run in `folder`, which exists; those of a run without files are [`Records::default`].
    ///
    /// # Errors
    /// [`FileError`] if files of a resumed run cannot be read.
    pub(crate) fn new(
        folder: &Path,
        case_hash: u64,
        start: Start,
        compression: Compression,
        processor_time: ProcessorTime,
    ) -> Result<Self, FileError> {
        let (series, written, list) = match start {
            Start::New => (SeriesFile::new(folder), Vec::new(), FrameList::new(folder)),
            Start::Resumed { series, frames } => {
                (SeriesFile::resume(folder, series)?, frames::read(folder, frames)?, FrameList::resume(folder, frames)?)
            }
        };
        pvd::rebuild(folder, &written)?;
        let writer = Writer::start(folder, VtkFiles::new(folder, written, compression), list)?;
        let files = Files { folder: folder.to_path_buf(), writer, processor_time, case_hash, compression };
        Ok(Self { series, files: Some(files), seconds: [0.0; 3] })
    }

    /// The rows of the series so far.
    pub(crate) fn series(&self) -> &Series {
        self.series.series()
    }

    /// The rows of the series, after the last one.
    pub(crate) fn into_series(self) -> Series {
        self.series.into_series()
    }

    /// Processor time in s of all processes of the run; `None` if one is not known, or without files.
    pub(crate) fn processor_time(&self) -> Option<f64> {
        self.files.as_ref().and_then(|files| files.processor_time.seconds())
    }

    /// Waits until all records are written.
    ///
    /// # Errors
    /// [`FileError`] if one could not be written.
    pub(crate) fn finish(&mut self) -> Result<(), FileError> {
        self.files.as_mut().map_or(Ok(()), |files| files.writer.finish())
    }

    /// Wall time that records took from the solver, by part, in s.
    pub(crate) fn parts(&self) -> Vec<PartTime> {
        let names = ["output: series", "output: vtk", "output: restart"];
        names.into_iter().zip(self.seconds).map(|(part, seconds)| PartTime { part, seconds }).collect()
    }

    /// Writes `solid.vtu`.
    pub(crate) fn write_outline(&self, solver: &dyn Solver) -> Result<(), FileError> {
        let Some(files) = &self.files else { return Ok(()) };
        let path = files.folder.join("solid.vtu");
        let outline = vtk::lines(&solver.outline(), files.compression)
            .map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
        atomic::write(&path, &outline)
    }

    /// Writes `units.json`.
    pub(crate) fn write_units(&self, solver: &dyn Solver) -> Result<(), FileError> {
        self.files.as_ref().map_or(Ok(()), |files| write_units(&files.folder, &Frame::of(solver)))
    }

    /// Writes the records that are due. The saved state comes last: it is never ahead of the other files. Files other than the series are written while the
    /// solver continues.
    pub(crate) fn record(&mut self, solver: &dyn Solver, due: Due) -> Result<(), FileError> {
        let mut clock = Instant::now();
        let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
        if due.series {
            let (columns, row): (Vec<&str>, Vec<f64>) = solver.sample().iter().map(|it| (it.name, it.value)).unzip();
            self.series.record(&columns, row)?;
        }
        self.seconds[0] += lap();
        let Some(files) = &mut self.files else { return Ok(()) };
        if due.vtk {
            files.writer.write(Record::Frame(Box::new(Frame::of(solver))))?;
        }
        self.seconds[1] += lap();
        if due.restart {
            let (time, step, state) = (solver.time(), solver.steps(), solver.state());
            let (series, frames) = (self.series.mark(), Mark::default());
            let saved = Saved { case_hash: files.case_hash, time, step, series, frames, state };
            files.writer.write(Record::State(saved, files.processor_time.seconds()))?;
        }
        self.seconds[2] += lap();
        Ok(())
    }
}
