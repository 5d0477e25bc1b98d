//! The geometry of a case, from its shape file or as written in the case; and texts of files.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use super::shapes::{self, RawGeometry, RawShapeFile};
use meniscus_core::input::{Checker, Document, InputError, Mistake, Overrides, Problem, file};
use meniscus_drawings::ShapeFileError;
use meniscus_drawings::import::{self, Format, Imported, Options, Refused};

/// The shape file of the built-in case, as named there.
const DEFAULT_SHAPES: &str = "../geometries/four-discs.toml";
const DEFAULT_SHAPES_TEXT: &str = include_str!("../../../geometries/four-discs.toml");

/// Source of a case and of its files.
pub enum Origin<'p> {
    /// A case file.
    Disk(&'p Path),
    /// The same, with the text of the initial state of the case, whatever file it names.
    Started(&'p Path, &'p str),
    /// The built-in case.
    BuiltIn,
    /// The name and the text of a case without a file; relative paths refer to the working folder.
    Given(&'p str, &'p str),
}

impl<'p> Origin<'p> {
    /// The case file, if there is one.
    pub(super) fn path(&self) -> Option<&'p Path> {
        match *self {
            Self::Disk(path) | Self::Started(path, _) => Some(path),
            Self::BuiltIn | Self::Given(..) => None,
        }
    }
}

/// The last geometry read, so that the cases of a study read the same files once.
#[derive(Debug, Default)]
pub struct KeptGeometry(Mutex<Option<(RawGeometry, Imported)>>);

impl KeptGeometry {
    /// The geometry read for these keys; the other keys of `[geometry]` do not affect reading.
    pub(super) fn find(&self, raw: &RawGeometry) -> Option<Imported> {
        let kept = self.0.lock().ok()?;
        kept.as_ref().filter(|(key, _)| *key == Self::key(raw)).map(|(_, read)| read.clone())
    }

    pub(super) fn keep(&self, raw: &RawGeometry, read: &Imported) {
        if let Ok(mut kept) = self.0.lock() {
            *kept = Some((Self::key(raw), read.clone()));
        }
    }

    fn key(raw: &RawGeometry) -> RawGeometry {
        RawGeometry { depth: None, etch_offset: None, ..raw.clone() }
    }
}

/// Reads the geometry of a case; mistakes of another file go to `elsewhere`.
pub(super) fn read_geometry(
    checker: &mut Checker,
    raw: &RawGeometry,
    origin: &Origin,
    sources: &mut Vec<PathBuf>,
    elsewhere: &mut Vec<Mistake>,
) -> Option<Imported> {
    let Some(file) = &raw.file else {
        shapes::refuse_keys_of_import(checker, raw);
        return shapes::inline(checker, "geometry", raw).map(|spec| Imported { spec, depth: None, notes: Vec::new() });
    };
    shapes::refuse_keys_of_file(checker, raw);
    let options = Options::from(raw);
    let loaded = match origin {
        Origin::BuiltIn if file == Path::new(DEFAULT_SHAPES) => {
            shape_text("geometries/four-discs.toml", DEFAULT_SHAPES_TEXT, &options)
        }
        _ => {
            let folder = origin.path().and_then(Path::parent).unwrap_or(Path::new(""));
            shapes_at(&folder.join(file), &options, sources)
        }
    };
    match loaded {
        Ok(read) => {
            let spec = shapes::with_domain(checker, read.spec, raw)?;
            let mut notes = read.notes;
            if raw.min.is_some() || raw.max.is_some() {
                // The case gives the domain itself.
                notes.retain(|note| !note.starts_with("domain "));
            }
            Some(Imported { spec, depth: read.depth, notes })
        }
        Err(NotRead::Keys(problems)) => {
            for problem in problems {
                checker.refuse(format!("geometry.{}", problem.path), problem.message, problem.help);
            }
            None
        }
        Err(NotRead::File(error)) => {
            for mistake in error.mistakes {
                // A file that cannot be read is a mistake of the key that names it.
                match mistake.location {
                    None => checker.refuse("geometry.file", mistake.message.clone(), mistake.help_text()),
                    Some(_) => elsewhere.push(mistake),
                }
            }
            None
        }
    }
}

/// Why shapes cannot be read.
enum NotRead {
    /// Keys of the import, by name.
    Keys(Vec<Problem>),
    /// The file itself.
    File(InputError),
}

impl NotRead {
    /// The same as mistakes of the file.
    fn of_file(self, name: &str) -> InputError {
        let of_key = |problem: Problem| Mistake::of_file(name, problem.message, &problem.help);
        match self {
            Self::Keys(problems) => InputError { mistakes: problems.into_iter().map(of_key).collect() },
            Self::File(error) => error,
        }
    }
}

impl From<InputError> for NotRead {
    fn from(error: InputError) -> Self {
        Self::File(error)
    }
}

/// Where a missing shape file is expected.
const RELATIVE: &str = "its path is relative to the case file";

fn shapes_at(path: &Path, options: &Options, sources: &mut Vec<PathBuf>) -> Result<Imported, NotRead> {
    sources.push(path.to_path_buf());
    read_shapes(path, options, RELATIVE)
}

/// The shapes of a file; `help` is the remedy if it does not exist.
fn read_shapes(path: &Path, options: &Options, help: &str) -> Result<Imported, NotRead> {
    let name = path.display().to_string();
    if Format::of(path) == Some(Format::Toml) {
        return shape_text(&name, &read(path, help)?, options);
    }
    meniscus_drawings::load(path, options).map_err(|error| match error {
        ShapeFileError::Read { path, source } => NotRead::File(unreadable(&name, &path, &source, help)),
        ShapeFileError::Refused { path, refused } => match refused {
            Refused::Keys(problems) => NotRead::Keys(problems),
            Refused::Parts(refusals) => NotRead::File(each_part(&name, &path, &refusals, |refusal| {
                (format!("{}: found {}", refusal.location, refusal.found), format!("expected {}", refusal.expected))
            })),
            Refused::Shapes(problems) => NotRead::File(each_part(&name, &path, &problems, |problem| {
                (format!("{}: {}", problem.path, problem.message), problem.help.clone())
            })),
        },
        error => NotRead::File(Mistake::of_file(&name, error.to_string(), Format::way_from(path)).into()),
    })
}

/// Most refused parts of a file that are reported.
const MOST_PARTS: usize = 50;

/// A mistake for each refused part of a file.
fn each_part<T>(name: &str, path: &Path, parts: &[T], describe: impl Fn(&T) -> (String, String)) -> InputError {
    let one = |part: &T| {
        let (message, help) = describe(part);
        Mistake::of_file(name, format!("{}, {message}", path.display()), &help)
    };
    let mut mistakes: Vec<Mistake> = parts.iter().take(MOST_PARTS).map(one).collect();
    if parts.len() > MOST_PARTS {
        let more = format!("{}: there are {} more mistakes", path.display(), parts.len() - MOST_PARTS);
        mistakes.push(Mistake::of_file(name, more, ""));
    }
    InputError { mistakes }
}

/// Loads a shape file; the file extension determines the format.
///
/// # Errors
/// All mistakes of the file or of the options, or why it cannot be read.
pub fn load_shapes(path: &Path, options: &Options) -> Result<Imported, InputError> {
    let name = path.display().to_string();
    read_shapes(path, options, "check the path of the shape file").map_err(|error| error.of_file(&name))
}

/// The same with the text of a shape file in TOML; `name` is its name in messages.
///
/// # Errors
/// All mistakes of the text or of the options.
pub fn load_shapes_text(name: &str, text: &str, options: &Options) -> Result<Imported, InputError> {
    shape_text(name, text, options).map_err(|error| error.of_file(name))
}

fn shape_text(name: &str, text: &str, options: &Options) -> Result<Imported, NotRead> {
    let problems = options.problems(Format::Toml);
    if !problems.is_empty() {
        return Err(NotRead::Keys(problems));
    }
    let document = Document::parse(name, text, &Overrides::default())?;
    let mut reading = document.read::<RawShapeFile>();
    let mut checker = Checker::default();
    let found = shapes::shape_file(&mut checker, std::mem::take(&mut reading.value));
    let mistakes = reading.refuse(checker.problems);
    let Some((spec, depth)) = found.filter(|_| mistakes.is_empty()) else { return Err(InputError { mistakes }.into()) };
    let read = import::windowed(spec, options).map_err(NotRead::Keys)?;
    Ok(Imported { depth, ..read })
}

/// The text of a file; `help` is the remedy if it does not exist.
pub fn read(path: &Path, help: &str) -> Result<String, InputError> {
    file::read_text(path).map_err(|error| unreadable(&path.display().to_string(), path, &error, help))
}

/// The remedy if a file is not text.
const UTF_8: &str = "save it as text in UTF-8; is it the right file?";

fn unreadable(name: &str, path: &Path, error: &std::io::Error, help: &str) -> InputError {
    let resolved = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let message = match error.kind() {
        std::io::ErrorKind::NotFound => format!("there is no file {}", resolved.display()),
        std::io::ErrorKind::InvalidData => {
            return Mistake::of_file(
                name,
                format!("{} is not text in UTF-8 from {error} on", resolved.display()),
                UTF_8,
            )
            .into();
        }
        _ => format!("{} cannot be read: {error}", resolved.display()),
    };
    Mistake::of_file(name, message, help).into()
}
