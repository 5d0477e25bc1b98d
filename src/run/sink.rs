//! Sinks: what is written at a stop. Those of VTK files get a [`Frame`], a copy of the required data of the solver.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use meniscus_case::{self, Output};
use meniscus_core::snapshot::{Layer, Snapshot};
use meniscus_core::solver::Solver;
use meniscus_output::frames::{FrameList, Written};
use meniscus_output::journal::Mark;
use meniscus_output::pvd::Collection;
use meniscus_output::vtk::{self, Compression, VtkError};
use meniscus_output::{FileError, atomic};

/// The data of the solver for VTK files, copied so that the solver can continue while they are written.
pub(crate) struct Frame {
    /// Time in s.
    time: f64,
    snapshot: Snapshot<'static>,
    layers: Vec<Layer<'static>>,
}

impl Frame {
    /// A frame of the solver's present state.
    pub(crate) fn of(solver: &dyn Solver) -> Self {
        let layers = solver.layers().into_iter().map(Layer::into_owned).collect();
        Self { time: solver.time(), snapshot: solver.snapshot().into_owned(), layers }
    }
}

/// Initial state of a run's files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Start {
    /// A new folder.
    New,
    /// The files in the folder up to these marks.
    Resumed {
        /// In `series.csv`.
        series: Mark,
        /// In the list of written frames.
        frames: Mark,
    },
}

/// The compression setting of the case for the writer of VTK files.
pub(crate) fn compression(output: &Output) -> Compression {
    match output.vtk_compression {
        meniscus_case::Compression::None => Compression::None,
        meniscus_case::Compression::Zlib => Compression::Zlib,
        meniscus_case::Compression::Lz4 => Compression::Lz4,
    }
}

/// The VTK files of a run: one series each of particles, grid and interface, if the solver has them, and of its layers.
pub(crate) struct VtkFiles {
    folder: PathBuf,
    written: Vec<Written>,
    compression: Compression,
    series: BTreeMap<&'static str, Collection>,
}

impl VtkFiles {
    /// Those in the folder of a run, of which these were `written` before.
    pub(crate) fn new(folder: &Path, written: Vec<Written>, compression: Compression) -> Self {
        Self { folder: folder.to_path_buf(), written, compression, series: BTreeMap::new() }
    }

    /// Records a frame and lists the written files in `frames`. An earlier record of the same time is replaced, never duplicated.
    ///
    /// # Errors
    /// [`FileError`] with the path and a remedy.
    pub(crate) fn record(&mut self, frame: &Frame, frames: &mut FrameList) -> Result<(), FileError> {
        write_units(&self.folder, frame)?;
        let Snapshot { time, particles, grid, interface, .. } = &frame.snapshot;
        let (time, compression) = (*time, self.compression);
        // A solver without particles has no particle fields either.
        if !(particles.fields.is_empty() && particles.points.is_empty()) {
            self.write("particles", time, vtk::points(particles, compression), frames)?;
        }
        if let Some(grid) = grid {
            self.write("grid", time, vtk::grid(grid, compression), frames)?;
        }
        if let Some(interface) = interface {
            self.write("interface", time, vtk::lines(interface, compression), frames)?;
        }
        let time = frame.time;
        let mut layers = frame.layers.iter();
        layers.try_for_each(|it| self.write(it.name, time, vtk::layer(it, compression), frames))
    }

    fn write(
        &mut self,
        name: &'static str,
        time: f64,
        content: Result<Vec<u8>, VtkError>,
        frames: &mut FrameList,
    ) -> Result<(), FileError> {
        let new = || Collection::new(&self.folder, name, &self.written);
        let files = self.series.entry(name).or_insert_with(new);
        let content = content.map_err(|error| FileError::Format { path: files.path(), what: error.to_string() })?;
        files.record(time, &content, frames)
    }
}

/// Writes `units.json`: the unit of each field by file series and name.
pub(crate) fn write_units(folder: &Path, frame: &Frame) -> Result<(), FileError> {
    let snapshot = &frame.snapshot;
    let groups = [
        ("particles", Some(&snapshot.particles.fields).filter(|fields| !fields.is_empty())),
        ("grid", snapshot.grid.as_ref().map(|grid| &grid.fields)),
        ("interface", snapshot.interface.as_ref().map(|lines| &lines.fields)),
    ];
    let layers = frame.layers.iter().map(|layer| (layer.name, Some(&layer.fields)));
    let units: BTreeMap<&str, BTreeMap<&str, &str>> = groups
        .into_iter()
        .chain(layers)
        .filter_map(|(name, fields)| Some((name, fields?.iter().map(|field| (field.name, field.unit)).collect())))
        .collect();
    let path = folder.join("units.json");
    let text = serde_json::to_string_pretty(&units)
        .map_err(|error| FileError::Format { path: path.clone(), what: error.to_string() })?;
    atomic::write(&path, (text + "\n").as_bytes())
}
