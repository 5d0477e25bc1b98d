//! Sinks: what is written at a stop. Those of VTK files see a [`Frame`], a copy of what they need of the solver.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::case::{self, Output};
use crate::io::frames::{FrameList, Written};
use crate::io::journal::Mark;
use crate::io::pvd::Collection;
use crate::io::series::SeriesFile;
use crate::io::vtk::{self, Compression, VtkError};
use crate::io::{FileError, atomic};
use crate::snapshot::{Layer, Snapshot};
use crate::solver::{Series, Solver};

/// What the VTK files need of the solver between two steps, without the solver: it goes on while they are written.
pub(crate) struct Frame {
    /// Where the run stands, in s.
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

/// Something that records a frame in a file.
pub(crate) trait Sink: Send {
    /// Records the frame and notes in `frames` what was written. A time that was recorded before is replaced, never doubled.
    ///
    /// # Errors
    /// [`FileError`] with the path and a way out.
    fn record(&mut self, frame: &Frame, frames: &mut FrameList) -> Result<(), FileError>;
}

/// Where a run's files begin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Start {
    /// With a new folder.
    New,
    /// With what stands in the folder before these marks.
    Resumed {
        /// In `series.csv`.
        series: Mark,
        /// In the list of written frames.
        frames: Mark,
    },
}

fn format_error(path: PathBuf) -> impl Fn(VtkError) -> FileError {
    move |error| FileError::Format { path: path.clone(), what: error.to_string() }
}

/// What the case says of compression, as the writer of VTK files has it.
pub(crate) fn compression(output: &Output) -> Compression {
    match output.vtk_compression {
        case::Compression::None => Compression::None,
        case::Compression::Zlib => Compression::Zlib,
        case::Compression::Lz4 => Compression::Lz4,
    }
}

/// `particles.pvd` and its files.
pub(crate) struct ParticleFiles(Collection, Compression);

/// `grid.pvd` and its files, where the solver offers a grid.
pub(crate) struct GridFiles(Collection, Compression);

/// `interface.pvd` and its files, where there is an interface.
pub(crate) struct InterfaceFiles(Collection, Compression);

/// `NAME.pvd` and its files for each layer of cells that the solver offers.
pub(crate) struct LayerFiles {
    folder: PathBuf,
    written: Vec<Written>,
    compression: Compression,
    collections: Vec<(&'static str, Collection)>,
}

/// `units.json`: the unit of each field by file series and name.
pub(crate) struct UnitFile(PathBuf);

/// The VTK sinks of a run in whose folder these files were `written` before.
pub(crate) fn vtk_sinks(folder: &Path, written: Vec<Written>, compression: Compression) -> Vec<Box<dyn Sink>> {
    let collection = |name: &str, extension| Collection::new(folder, name, extension, &written);
    vec![
        Box::new(UnitFile::of(folder)),
        Box::new(ParticleFiles(collection("particles", "vtu"), compression)),
        Box::new(GridFiles(collection("grid", "vti"), compression)),
        Box::new(InterfaceFiles(collection("interface", "vtp"), compression)),
        Box::new(LayerFiles { folder: folder.to_path_buf(), written, compression, collections: Vec::new() }),
    ]
}

impl Sink for ParticleFiles {
    fn record(&mut self, frame: &Frame, frames: &mut FrameList) -> Result<(), FileError> {
        let snapshot = &frame.snapshot;
        // A solver without particles has no fields of them either.
        if snapshot.particles.fields.is_empty() && snapshot.particles.points.is_empty() {
            return Ok(());
        }
        let content = vtk::points(&snapshot.particles, snapshot.time, self.1).map_err(format_error(self.0.path()))?;
        self.0.record(snapshot.time, &content, frames)
    }
}

impl Sink for GridFiles {
    fn record(&mut self, frame: &Frame, frames: &mut FrameList) -> Result<(), FileError> {
        let snapshot = &frame.snapshot;
        let Some(grid) = &snapshot.grid else { return Ok(()) };
        let content = vtk::grid(grid, snapshot.time, self.1).map_err(format_error(self.0.path()))?;
        self.0.record(snapshot.time, &content, frames)
    }
}

impl Sink for InterfaceFiles {
    fn record(&mut self, frame: &Frame, frames: &mut FrameList) -> Result<(), FileError> {
        let snapshot = &frame.snapshot;
        let Some(interface) = &snapshot.interface else { return Ok(()) };
        let content = vtk::lines(interface, snapshot.time, self.1).map_err(format_error(self.0.path()))?;
        self.0.record(snapshot.time, &content, frames)
    }
}

impl Sink for LayerFiles {
    fn record(&mut self, frame: &Frame, frames: &mut FrameList) -> Result<(), FileError> {
        let time = frame.time;
        for layer in &frame.layers {
            let place = match self.collections.iter().position(|(name, _)| *name == layer.name) {
                Some(place) => place,
                None => {
                    let files = Collection::new(&self.folder, layer.name, "vtp", &self.written);
                    self.collections.push((layer.name, files));
                    self.collections.len() - 1
                }
            };
            let files = &mut self.collections[place].1;
            let content = vtk::layer(layer, time, self.compression).map_err(format_error(files.path()))?;
            files.record(time, &content, frames)?;
        }
        Ok(())
    }
}

impl Sink for UnitFile {
    fn record(&mut self, frame: &Frame, _: &mut FrameList) -> Result<(), FileError> {
        self.write(frame)
    }
}

impl UnitFile {
    /// The file in the folder of a run.
    pub(crate) fn of(folder: &Path) -> Self {
        Self(folder.join("units.json"))
    }

    /// Writes the units of a frame.
    pub(crate) fn write(&self, frame: &Frame) -> Result<(), FileError> {
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
        let text = serde_json::to_string_pretty(&units)
            .map_err(|error| FileError::Format { path: self.0.clone(), what: error.to_string() })?;
        atomic::write(&self.0, (text + "\n").as_bytes())
    }
}

/// `series.csv`.
pub(crate) struct SeriesSink(SeriesFile);

impl SeriesSink {
    /// The series of a run.
    ///
    /// # Errors
    /// [`FileError`] where the file of a resumed run cannot be read.
    pub(crate) fn new(folder: &Path, start: Start) -> Result<Self, FileError> {
        Ok(Self(match start {
            Start::New => SeriesFile::new(folder),
            Start::Resumed { series, .. } => SeriesFile::resume(folder, series)?,
        }))
    }

    /// Adds the row of the solver's present state. A time that was recorded before is replaced, never doubled.
    ///
    /// # Errors
    /// [`FileError`] with the path and a way out.
    pub(crate) fn record(&mut self, solver: &dyn Solver) -> Result<(), FileError> {
        let (columns, row): (Vec<&str>, Vec<f64>) =
            solver.sample().iter().map(|sample| (sample.name, sample.value)).unzip();
        self.0.record(&columns, row)
    }

    /// How much of the file there is.
    pub(crate) fn mark(&self) -> Mark {
        self.0.mark()
    }

    /// All rows so far.
    pub(crate) fn series(&self) -> &Series {
        self.0.series()
    }
}
