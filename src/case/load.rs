//! From a path to a checked case, by way of the shape file it names.

use std::path::{Path, PathBuf};

use super::case_file::{self, Case, Model, RawCase};
use super::kind::other_than_a_case;
use super::magnitude::magnitudes;
use super::network::RawNetwork;
use super::network::state::Start;
use super::shapes::{RawGeometry, RawShapeFile};
use super::{depth, film, network, permeability, records, relative_permeability, shapes, sph, start};
use crate::geometry::ShapeFileError;
use crate::geometry::import::{self, Beyond, Format, Imported, Options};
use crate::geometry::spec::GeometrySpec;
use crate::input::{Checker, Document, InputError, Mistake, Overrides, Problem, Renamed, file};

/// A checked case and where it came from.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The case.
    pub case: Case,
    /// The case as one file: overrides, defaults, presets and shapes written out. It loads to the same case.
    pub resolved: String,
    /// The files that were read.
    pub sources: Vec<PathBuf>,
    /// What the user should know of how the drawing was read, one sentence each.
    pub notes: Vec<String>,
    /// The text of the file, in which mistakes found later have their places.
    pub document: Document,
}

impl Loaded {
    /// Puts problems found later, by [`check_against`](super::check_against) say, at their places in the case file.
    ///
    /// # Errors
    /// [`InputError`] where there are problems.
    pub fn refuse(&self, problems: Vec<Problem>) -> Result<(), InputError> {
        self.document.refuse(problems)
    }
}

/// Keys with new names.
static RENAMED: [Renamed; 3] = [
    Renamed { table: &NUMERICS, before: "drift-source", now: "density-error-correction" },
    Renamed { table: &NUMERICS, before: "drift-correction", now: "density-error-shifting" },
    Renamed { table: &NUMERICS, before: "short-range-push", now: "anti-clustering" },
];
const NUMERICS: [&str; 2] = ["sph", "numerics"];

/// How the built-in case is called in messages.
const DEFAULT_CASE: &str = "cases/four-discs.toml";
const DEFAULT_CASE_TEXT: &str = include_str!("../../cases/four-discs.toml");
/// The shape file of the built-in case, as that case names it.
const DEFAULT_SHAPES: &str = "../geometries/four-discs.toml";
const DEFAULT_SHAPES_TEXT: &str = include_str!("../../geometries/four-discs.toml");

/// Where the files of a case come from.
enum Origin<'p> {
    Disk(&'p Path),
    /// The same, with the text of the state that the case begins with, whatever file it names.
    Started(&'p Path, &'p str),
    BuiltIn,
    /// A text without a file; what it names is looked for in the working folder.
    Given,
}

impl<'p> Origin<'p> {
    /// The case file, where there is one.
    fn path(&self) -> Option<&'p Path> {
        match *self {
            Self::Disk(path) | Self::Started(path, _) => Some(path),
            Self::BuiltIn | Self::Given => None,
        }
    }
}

/// Loads and checks a case file and the shape file it names.
///
/// # Errors
/// All mistakes of both files, or the file that cannot be read with its resolved path.
pub fn load(path: &Path, overrides: &Overrides) -> Result<Loaded, InputError> {
    let text = read(path, "check the path of the case file")?;
    load_text(&path.display().to_string(), &text, overrides, &Origin::Disk(path))
}

/// Loads and checks a case as if the file of the state that it begins with held `state`.
///
/// # Errors
/// As [`load`].
pub fn load_started(path: &Path, overrides: &Overrides, state: &str) -> Result<Loaded, InputError> {
    let text = read(path, "check the path of the case file")?;
    load_text(&path.display().to_string(), &text, overrides, &Origin::Started(path, state))
}

/// Loads the built-in case: the wetting liquid between four discs.
///
/// # Errors
/// Overrides that do not fit.
pub fn load_default(overrides: &Overrides) -> Result<Loaded, InputError> {
    load_text(DEFAULT_CASE, DEFAULT_CASE_TEXT, overrides, &Origin::BuiltIn)
}

/// Loads and checks the text of a case that stands in no file; `name` is how it is called in messages.
///
/// # Errors
/// As [`load`].
pub fn load_given(name: &str, text: &str, overrides: &Overrides) -> Result<Loaded, InputError> {
    load_text(name, text, overrides, &Origin::Given)
}

/// Loads the text of a starter case, which names no file.
///
/// # Errors
/// All its mistakes.
pub(super) fn load_starter(text: &str) -> Result<Loaded, InputError> {
    load_text("the starter case", text, &Overrides::default(), &Origin::BuiltIn)
}

fn load_text(name: &str, text: &str, overrides: &Overrides, origin: &Origin) -> Result<Loaded, InputError> {
    let document = Document::parse(name, text, overrides)?.with_renamed(&RENAMED);
    document.refuse(other_than_a_case(text).into_iter().collect())?;
    let mut reading = document.read::<RawCase>();
    let mut checker = Checker::default();
    let written = one_model(&mut checker, std::mem::take(&mut reading.value));
    let raw = &written.clone().in_range(&mut checker, "");
    checker.format(raw.format);
    let mut sources: Vec<PathBuf> = origin.path().map(Path::to_path_buf).into_iter().collect();
    let mut elsewhere = Vec::new();
    // Which of its keys go with a file is a question of all that are written.
    let geometry = written
        .geometry
        .as_ref()
        .and_then(|raw| read_geometry(&mut checker, raw, origin, &mut sources, &mut elsewhere));
    let (geometry, of_file, mut notes) =
        geometry.map_or((None, None, Vec::new()), |read| (Some(read.spec), read.depth, read.notes));
    notes.extend(document.notes_on_renamed());
    let geometry = geometry.and_then(|spec| {
        let has_window = raw.geometry.as_ref().is_some_and(|geometry| geometry.window.is_some());
        let beyond = raw.network.as_ref().map_or_else(
            || shapes::beyond(raw.sph.as_ref().and_then(|sph| sph.sides.as_ref())),
            |network| shapes::beyond_network(network.sides.as_ref()),
        );
        if has_window { cut(&mut checker, spec, beyond, &mut notes) } else { Some(spec) }
    });
    let folder = origin.path().and_then(Path::parent).unwrap_or(Path::new(""));
    let given = if let Origin::Started(_, state) = origin { Some(*state) } else { None };
    let start = start::start(&mut checker, raw, (folder, given), geometry.as_ref(), &mut sources);
    let network = raw.network.as_ref().map(|network| network::measured::with_file(&mut checker, network, folder));
    let mut model = model(&mut checker, (raw, network.as_ref()), geometry.as_ref(), start);
    let depth = raw.geometry.as_ref().and_then(|geometry| geometry.depth).or(of_file);
    let has_wetting_table = raw.sph.as_ref().is_some_and(|sph| sph.wetting.is_some());
    depth::depth(&mut checker, depth, model.as_mut(), geometry.as_ref(), has_wetting_table);
    shapes::refuse_images(&mut checker, geometry.as_ref(), model.as_ref().and_then(Model::sides));
    permeability::permeability(&mut checker, model.as_ref(), geometry.as_ref());
    relative_permeability::relative_permeability(&mut checker, model.as_ref());
    let end = records::end(&mut checker, raw, model.as_ref());
    let output = records::output(&mut checker, raw, end, in_spacings(geometry.as_ref(), model.as_ref()));
    let steady = records::steady(&mut checker, raw, end, &output);
    permeability::records(&mut checker, model.as_ref(), (end, steady.is_some()), &output);
    relative_permeability::records(&mut checker, model.as_ref(), (end, steady.is_some()), &output);
    let expect = records::expectations(&mut checker, raw, model.as_ref(), geometry.as_ref());
    magnitudes(&mut checker, "sph", raw.sph.as_ref());
    magnitudes(&mut checker, "thin-film", raw.thin_film.as_ref());
    magnitudes(&mut checker, "network", raw.network.as_ref());
    let mut mistakes = reading.refuse(checker.problems);
    mistakes.append(&mut elsewhere);
    let (Some(title), Some(geometry), Some(model), Some(end), true) =
        (raw.title.clone(), geometry, model, end, mistakes.is_empty())
    else {
        return Err(InputError { mistakes });
    };
    let case = Case { title, geometry, depth, model, end, steady, output, expect };
    let resolved = case_file::text(&case);
    Ok(Loaded { case, resolved, sources, notes, document })
}

/// Width and height of the domain of a direct simulation in spacings.
fn in_spacings(geometry: Option<&GeometrySpec>, model: Option<&Model>) -> Option<[f64; 2]> {
    let (geometry, Model::Sph(sph)) = (geometry?, model?) else { return None };
    Some([0, 1].map(|axis| (geometry.max[axis] - geometry.min[axis]) / sph.spacing))
}

/// The model of the case; `network` is its network with the measured values of the file that it names.
fn model(
    checker: &mut Checker,
    (raw, network): (&RawCase, Option<&RawNetwork>),
    geometry: Option<&GeometrySpec>,
    start: Option<Start>,
) -> Option<Model> {
    match (&raw.sph, &raw.thin_film, network) {
        (Some(raw), None, None) => sph::sph(checker, raw, geometry, start).map(|sph| Model::Sph(Box::new(sph))),
        (None, Some(raw), None) => film::thin_film(checker, raw, geometry).map(|film| Model::ThinFilm(Box::new(film))),
        (None, None, Some(raw)) => {
            network::network(checker, raw, geometry, start).map(|network| Model::Network(Box::new(network)))
        }
        _ if checker.is_refused("sph") || checker.is_refused("thin-film") || checker.is_refused("network") => None,
        _ => {
            checker.refuse("sph", "expected a model, found none", "add the table [sph], [thin-film] or [network]");
            None
        }
    }
}

/// The case as it is written, or without its models where it has several.
fn one_model(checker: &mut Checker, raw: RawCase) -> RawCase {
    let given =
        [("sph", raw.sph.is_some()), ("thin-film", raw.thin_film.is_some()), ("network", raw.network.is_some())];
    let names: Vec<&str> = given.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
    let (Some(last), true) = (names.last(), names.len() > 1) else { return raw };
    checker.refuse(
        *last,
        format!("expected exactly one model, found `{}`", names.join("` and `")),
        "use [sph], direct simulation, [thin-film], a droplet on a flat wall, or [network], slow displacement in many pores",
    );
    RawCase { sph: None, thin_film: None, network: None, ..raw }
}

/// Cuts the shapes at the sides of the window that are open or periodic.
fn cut(
    checker: &mut Checker,
    mut spec: GeometrySpec,
    beyond: [Beyond; 4],
    notes: &mut Vec<String>,
) -> Option<GeometrySpec> {
    let (cut, whole) = import::cut_at_sides(&mut spec, beyond);
    if cut > 0 {
        notes.push(format!("cut at open and periodic sides of the window: shapes ({cut})"));
    }
    if whole > 0 {
        notes.push(format!(
            "left whole at the sides of the window, as their outlines cross themselves there: shapes ({whole})"
        ));
    }
    let problems = if cut > 0 { spec.problems() } else { Vec::new() };
    for problem in &problems {
        checker.refuse("geometry.window", problem.message.clone(), "move the window a little");
    }
    problems.is_empty().then_some(spec)
}

fn read_geometry(
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
    let options = shapes::options(raw);
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
                // The case says the domain itself.
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
                match mistake.place {
                    None => checker.refuse("geometry.file", mistake.message.clone(), mistake.help_text()),
                    Some(_) => elsewhere.push(mistake),
                }
            }
            None
        }
    }
}

/// Why shapes are not read.
enum NotRead {
    /// Keys that tell how the file is read, by name.
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

/// Where the user should look for a shape file that is not there.
const BESIDE: &str = "the shape file is looked for beside the case file";

fn shapes_at(path: &Path, options: &Options, sources: &mut Vec<PathBuf>) -> Result<Imported, NotRead> {
    sources.push(path.to_path_buf());
    read_shapes(path, options, BESIDE)
}

/// The shapes of a file; `help` tells where the user should look when there is none.
fn read_shapes(path: &Path, options: &Options, help: &str) -> Result<Imported, NotRead> {
    let name = path.display().to_string();
    if Format::of(path) == Some(Format::Toml) {
        return shape_text(&name, &read(path, help)?, options);
    }
    crate::geometry::load(path, options).map_err(|error| match error {
        ShapeFileError::Keys { problems, .. } => NotRead::Keys(problems),
        ShapeFileError::Read { path, source } => NotRead::File(unreadable(&name, &path, &source, help)),
        ShapeFileError::Parts { path, refusals } => NotRead::File(each_part(&name, &path, &refusals, |refusal| {
            (format!("{}: found {}", refusal.place, refusal.found), format!("expected {}", refusal.expected))
        })),
        ShapeFileError::Shapes { path, problems } => NotRead::File(each_part(&name, &path, &problems, |problem| {
            (format!("{}: {}", problem.path, problem.message), problem.help.clone())
        })),
        error => NotRead::File(Mistake::of_file(&name, error.to_string(), "").into()),
    })
}

/// Most parts of a file that are told.
const MOST_PARTS: usize = 50;

/// A mistake for each part of a file that is refused.
fn each_part<T>(name: &str, path: &Path, parts: &[T], told: impl Fn(&T) -> (String, String)) -> InputError {
    let one = |part: &T| {
        let (message, help) = told(part);
        Mistake::of_file(name, format!("{}, {message}", path.display()), &help)
    };
    let mut mistakes: Vec<Mistake> = parts.iter().take(MOST_PARTS).map(one).collect();
    if parts.len() > MOST_PARTS {
        let more = format!("{}: there are {} more mistakes", path.display(), parts.len() - MOST_PARTS);
        mistakes.push(Mistake::of_file(name, more, ""));
    }
    InputError { mistakes }
}

/// Loads a shape file; the ending of its name says its format.
///
/// # Errors
/// All mistakes of the file or of the options, or why it cannot be read.
pub fn load_shapes(path: &Path, options: &Options) -> Result<Imported, InputError> {
    let name = path.display().to_string();
    read_shapes(path, options, "check the path of the shape file").map_err(|error| error.of_file(&name))
}

/// The same with the text of a shape file in TOML; `name` is how it is called in messages.
///
/// # Errors
/// All mistakes of the text or of the options.
pub(crate) fn load_shapes_text(name: &str, text: &str, options: &Options) -> Result<Imported, InputError> {
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

/// The text of a file; `help` tells where the user should look when there is none.
pub(crate) fn read(path: &Path, help: &str) -> Result<String, InputError> {
    file::read_text(path).map_err(|error| unreadable(&path.display().to_string(), path, &error, help))
}

/// The way out where a file is not text.
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
