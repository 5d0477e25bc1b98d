//! From a path to a checked case, by way of the shape file it names.

use std::path::{Path, PathBuf};

use super::check::{self, Checker};
use super::checked::{Case, Model};
use super::raw::{RawCase, RawGeometry, RawShapeFile};
use super::{film, network, resolve, shapes, sph};
use crate::geometry::spec::GeometrySpec;
use crate::input::{Document, InputError, Mistake, Overrides, Problem};

/// A checked case and where it came from.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The case.
    pub case: Case,
    /// The case as one file: overrides, defaults, presets and shapes written out. It loads to the same case.
    pub resolved: String,
    /// The files that were read.
    pub sources: Vec<PathBuf>,
    document: Document,
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

/// How the built-in case is called in messages.
const DEFAULT_CASE: &str = "cases/four-discs.toml";
const DEFAULT_CASE_TEXT: &str = include_str!("../../cases/four-discs.toml");
/// The shape file of the built-in case, as that case names it.
const DEFAULT_SHAPES: &str = "../geometries/four-discs.toml";
const DEFAULT_SHAPES_TEXT: &str = include_str!("../../geometries/four-discs.toml");

/// Where the files of a case come from.
enum Origin<'p> {
    Disk(&'p Path),
    BuiltIn,
}

/// Loads and checks a case file and the shape file it names.
///
/// # Errors
/// All mistakes of both files, or the file that cannot be read with its resolved path.
pub fn load(path: &Path, overrides: &Overrides) -> Result<Loaded, InputError> {
    let text = read(path, "check the path of the case file")?;
    load_text(&path.display().to_string(), &text, overrides, &Origin::Disk(path))
}

/// Loads the built-in case: the wetting liquid between four discs.
///
/// # Errors
/// Overrides that do not fit.
pub fn load_default(overrides: &Overrides) -> Result<Loaded, InputError> {
    load_text(DEFAULT_CASE, DEFAULT_CASE_TEXT, overrides, &Origin::BuiltIn)
}

fn load_text(name: &str, text: &str, overrides: &Overrides, origin: &Origin) -> Result<Loaded, InputError> {
    let document = Document::parse(name, text, overrides)?;
    let reading = document.read::<RawCase>();
    let mut checker = Checker::default();
    let raw = &reading.value;
    checker.format(raw.format);
    let title = checker.require("title", raw.title.clone(), "title = \"what the case shows\"");
    let mut sources: Vec<PathBuf> = match origin {
        Origin::Disk(path) => vec![path.to_path_buf()],
        Origin::BuiltIn => Vec::new(),
    };
    let mut elsewhere = Vec::new();
    let geometry = match &raw.geometry {
        None => checker.require("geometry", None, "[geometry] with file, or min, max and shapes"),
        Some(raw) => geometry(&mut checker, raw, origin, &mut sources, &mut elsewhere),
    };
    let model = model(&mut checker, raw, geometry.as_ref());
    let end = check::end(&mut checker, raw, model.as_ref());
    let output = check::output(&mut checker, raw, end);
    let expect = check::expectations(&mut checker, raw);
    let mut mistakes = reading.refuse(checker.problems);
    mistakes.append(&mut elsewhere);
    let (Some(title), Some(geometry), Some(model), Some(end), true) =
        (title, geometry, model, end, mistakes.is_empty())
    else {
        return Err(InputError { mistakes });
    };
    let case = Case { title, geometry, model, end, output, expect };
    let resolved = resolve::text(&case);
    Ok(Loaded { case, resolved, sources, document })
}

fn model(checker: &mut Checker, raw: &RawCase, geometry: Option<&GeometrySpec>) -> Option<Model> {
    match (&raw.sph, &raw.thin_film, &raw.network) {
        (Some(raw), None, None) => sph::sph(checker, raw, geometry).map(|sph| Model::Sph(Box::new(sph))),
        (None, Some(raw), None) => film::thin_film(checker, raw, geometry).map(|film| Model::ThinFilm(Box::new(film))),
        (None, None, Some(raw)) => {
            network::network(checker, raw, geometry).map(|network| Model::Network(Box::new(network)))
        }
        (None, None, None) => {
            checker.refuse("sph", "expected a model, found none", "add the table [sph], [thin-film] or [network]");
            None
        }
        (sph, film, network) => {
            let given = [("sph", sph.is_some()), ("thin-film", film.is_some()), ("network", network.is_some())];
            let names: Vec<&str> = given.iter().filter(|(_, given)| *given).map(|(name, _)| *name).collect();
            checker.refuse(
                names.last().copied().unwrap_or_default(),
                format!("expected exactly one model, found `{}`", names.join("` and `")),
                "use [sph], direct simulation, [thin-film], a droplet on a flat wall, or [network], slow displacement in many pores",
            );
            None
        }
    }
}

fn geometry(
    checker: &mut Checker,
    raw: &RawGeometry,
    origin: &Origin,
    sources: &mut Vec<PathBuf>,
    elsewhere: &mut Vec<Mistake>,
) -> Option<GeometrySpec> {
    let Some(file) = &raw.file else { return shapes::inline(checker, "geometry", raw) };
    shapes::refuse_keys_of_file(checker, raw);
    let loaded = match origin {
        Origin::BuiltIn if file == Path::new(DEFAULT_SHAPES) => {
            shape_text("geometries/four-discs.toml", DEFAULT_SHAPES_TEXT)
        }
        Origin::BuiltIn => shapes_at(file, sources),
        Origin::Disk(case) => shapes_at(&case.parent().unwrap_or(Path::new("")).join(file), sources),
    };
    match loaded {
        Ok(spec) => shapes::with_domain(checker, spec, raw),
        Err(error) => {
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

fn shapes_at(path: &Path, sources: &mut Vec<PathBuf>) -> Result<GeometrySpec, InputError> {
    sources.push(path.to_path_buf());
    load_shapes(path)
}

/// Loads a shape file; the ending of its name says its format.
///
/// # Errors
/// All mistakes of the file, or why it cannot be read.
pub fn load_shapes(path: &Path) -> Result<GeometrySpec, InputError> {
    let name = path.display().to_string();
    if path.extension().is_some_and(|extension| extension == "toml") {
        return shape_text(&name, &read(path, "the shape file is looked for beside the case file")?);
    }
    read(path, "the shape file is looked for beside the case file")?;
    crate::geometry::load(path).map_err(|error| Mistake::of_file(&name, error.to_string(), "").into())
}

fn shape_text(name: &str, text: &str) -> Result<GeometrySpec, InputError> {
    let document = Document::parse(name, text, &Overrides::default())?;
    let mut reading = document.read::<RawShapeFile>();
    let mut checker = Checker::default();
    let spec = shapes::shape_file(&mut checker, std::mem::take(&mut reading.value));
    let mistakes = reading.refuse(checker.problems);
    spec.filter(|_| mistakes.is_empty()).ok_or(InputError { mistakes })
}

/// The text of a file; `help` tells where the user should look when there is none.
pub(crate) fn read(path: &Path, help: &str) -> Result<String, InputError> {
    std::fs::read_to_string(path).map_err(|error| {
        let resolved = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let message = match error.kind() {
            std::io::ErrorKind::NotFound => format!("there is no file {}", resolved.display()),
            std::io::ErrorKind::InvalidData => format!("{} is not text in UTF-8", resolved.display()),
            _ => format!("{} cannot be read: {error}", resolved.display()),
        };
        Mistake::of_file(&path.display().to_string(), message, help).into()
    })
}
