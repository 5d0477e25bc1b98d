//! Frames from the VTK files of a direct simulation or a thin film.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::failure::MovieFailure;
use crate::run::setup;
use meniscus_case::Case;
use meniscus_core::diagram::Frame;
use meniscus_core::snapshot::{Cloud, Lines, Snapshot};
use meniscus_output::movie::Movie;
use meniscus_output::picture::{Picture, Scene};
use meniscus_output::vtk::read::{self, ReadError};
use meniscus_output::{FileError, pvd};

/// The arrays that pictures show.
const ARRAYS: [&str; 4] = ["phase", "below-resolution", "volume", "film-height"];

/// What pictures need to know about a run.
pub(super) struct Subject {
    title: String,
    frame: Option<Frame>,
}

impl Subject {
    /// From the case, or of a run without a report from its folder.
    pub(super) fn of(case: Option<&Case>, folder: &Path) -> Self {
        let name = || folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Self { title: case.map_or_else(name, |case| case.title.clone()), frame: case.and_then(setup::frame) }
    }
}

/// The files of one time.
struct Files {
    time: f64,
    particles: PathBuf,
    interface: Option<PathBuf>,
}

/// The movie of all frames in a folder.
pub(super) fn movie(folder: &Path, subject: &Subject, progress: &mut dyn FnMut(f64)) -> Result<Movie, MovieFailure> {
    let frames = frames(folder)?;
    let outline = match folder.join("solid.vtu") {
        path if path.exists() => content(&path, read::lines)?,
        _ => Lines::default(),
    };
    let frame = subject.frame.as_ref();
    let (mut scene, mut movie): (Option<Scene>, _) = (None, Movie::default());
    let at_once = rayon::current_num_threads();
    for (done, some) in frames.chunks(at_once).enumerate() {
        let scenes = some.par_iter().map(|files| Ok(Scene::of(&snapshot(files)?, frame)?));
        for found in scenes.collect::<Result<Vec<Scene>, MovieFailure>>()? {
            scene = Some(scene.map_or(found.clone(), |scene| scene.with(found)));
        }
        // Reading takes about a tenth of the time.
        progress(0.1 * (done * at_once) as f64 / frames.len() as f64);
    }
    let Some(scene) = scene else { return Err(MovieFailure::NoFrames(folder.to_path_buf())) };
    for (done, some) in frames.chunks(at_once).enumerate() {
        let drawn = some.par_iter().map(|files| Ok(scene.draw(&snapshot(files)?, &outline, &subject.title, frame)?));
        for picture in drawn.collect::<Result<Vec<Picture>, MovieFailure>>()? {
            movie.push(&picture, 1)?;
        }
        progress(0.1 + 0.9 * (done * at_once) as f64 / frames.len() as f64);
    }
    if frames.len() < 2 {
        return Err(MovieFailure::OneFrame { folder: folder.to_path_buf(), key: "every-time" });
    }
    Ok(movie)
}

/// The files of all times.
fn frames(folder: &Path) -> Result<Vec<Files>, MovieFailure> {
    let list = |name: &str| {
        let path = folder.join(name);
        if path.exists() { pvd::read(&path).map(Some) } else { Ok(None) }
    };
    let Some(particles) = list("particles.pvd")? else {
        return Err(MovieFailure::NoFrames(folder.to_path_buf()));
    };
    let interfaces = list("interface.pvd")?.unwrap_or_default();
    let mut interfaces: BTreeMap<u64, PathBuf> =
        interfaces.into_iter().map(|(time, path)| (time.to_bits(), path)).collect();
    let files =
        |(time, particles): (f64, PathBuf)| Files { time, particles, interface: interfaces.remove(&time.to_bits()) };
    Ok(particles.into_iter().map(files).collect())
}

fn snapshot(files: &Files) -> Result<Snapshot<'static>, MovieFailure> {
    let particles: Cloud<'static> = content(&files.particles, |bytes| read::points(bytes, &ARRAYS))?;
    let interface = files.interface.as_deref().map(|path| content(path, read::lines)).transpose()?;
    Ok(Snapshot { time: files.time, step: 0, particles, grid: None, interface })
}

/// The content of a file.
fn content<T>(path: &Path, parse: impl Fn(&[u8]) -> Result<T, ReadError>) -> Result<T, MovieFailure> {
    let bytes = std::fs::read(path).map_err(FileError::read(path))?;
    let parsed = parse(&bytes);
    Ok(parsed.map_err(|error| FileError::Content { path: path.to_path_buf(), what: error.to_string() })?)
}
