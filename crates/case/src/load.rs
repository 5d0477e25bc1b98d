//! From a path to a checked case, including its shape file.

use std::path::{Path, PathBuf};

use super::case_file::{self, Case, Model, RawCase};
use super::kind::{drawing_in_place_of_a_case, other_than_a_case};
use super::magnitude::magnitudes;
use super::network::state::Start;
use super::read_geometry::{KeptGeometry, Origin, read, read_geometry};
use super::title::title;
use super::{depth, film, network, permeability, records, relative_permeability, shapes, sph, start};
use meniscus_core::input::{Checker, Document, InputError, Overrides, Problem, Renamed};
use meniscus_drawings::import::{self, Beyond};
use meniscus_geometry::spec::GeometrySpec;

/// A checked case and its sources.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The case.
    pub case: Case,
    /// The case as one file: overrides, defaults, presets and shapes resolved. It loads to the same case.
    pub resolved: String,
    /// The files that were read.
    pub sources: Vec<PathBuf>,
    /// Notes for the user on how the drawing was read, one sentence each.
    pub notes: Vec<String>,
    /// The text of the file, in which later mistakes are located.
    pub document: Document,
}

impl Loaded {
    /// Locates problems found later, by [`check_against`](super::check_against) say, in the case file.
    ///
    /// # Errors
    /// [`InputError`] if there are problems.
    pub fn refuse(&self, problems: Vec<Problem>) -> Result<(), InputError> {
        self.document.refuse(problems)
    }
}

/// Renamed keys.
static RENAMED: [Renamed; 3] = [
    Renamed { table: &NUMERICS, before: "drift-source", now: "density-error-correction" },
    Renamed { table: &NUMERICS, before: "drift-correction", now: "density-error-shifting" },
    Renamed { table: &NUMERICS, before: "short-range-push", now: "anti-clustering" },
];
const NUMERICS: [&str; 2] = ["sph", "numerics"];

/// Name of the built-in case in messages.
const DEFAULT_CASE: &str = "cases/four-discs.toml";
const DEFAULT_CASE_TEXT: &str = include_str!("../../../cases/four-discs.toml");

/// Loads and checks a case file and the shape file it names.
///
/// # Errors
/// All mistakes of both files, or the file that cannot be read with its resolved path.
pub fn load(path: &Path, overrides: &Overrides) -> Result<Loaded, InputError> {
    load_from(&Origin::Disk(path), overrides, None)
}

/// Loads the built-in case: the wetting liquid between four discs.
///
/// # Errors
/// Overrides that do not fit.
pub fn load_default(overrides: &Overrides) -> Result<Loaded, InputError> {
    load_from(&Origin::BuiltIn, overrides, None)
}

/// Loads and checks a case; if its geometry is the one in `kept`, it is not read again, and the resolved text has no shapes.
///
/// # Errors
/// As [`load`].
pub fn load_from(origin: &Origin, overrides: &Overrides, kept: Option<&KeptGeometry>) -> Result<Loaded, InputError> {
    let (name, text) = match *origin {
        Origin::Disk(path) | Origin::Started(path, _) => {
            if let Some(mistake) = drawing_in_place_of_a_case(path) {
                return Err(mistake.into());
            }
            (path.display().to_string(), read(path, "check the path of the case file")?)
        }
        Origin::BuiltIn => (DEFAULT_CASE.to_owned(), DEFAULT_CASE_TEXT.to_owned()),
        Origin::Given(name, text) => (name.to_owned(), text.to_owned()),
    };
    let document = Document::parse(&name, &text, overrides)?.with_renamed(&RENAMED);
    document.refuse(other_than_a_case(&text).into_iter().collect())?;
    let mut reading = document.read::<RawCase>();
    let mut checker = Checker::default();
    let written = one_model(&mut checker, std::mem::take(&mut reading.value));
    let mut raw = written.clone().in_range(&mut checker, "");
    raw.title = raw.title.map(|of_file| title(&of_file, overrides));
    checker.format(raw.format);
    let mut sources: Vec<PathBuf> = origin.path().map(Path::to_path_buf).into_iter().collect();
    let mut elsewhere = Vec::new();
    // Whether its keys go with a file is judged on all keys as written.
    let geometry = written.geometry.as_ref().and_then(|raw| {
        let known = kept.and_then(|kept| kept.find(raw));
        let read = known.or_else(|| read_geometry(&mut checker, raw, origin, &mut sources, &mut elsewhere))?;
        kept.iter().for_each(|kept| kept.keep(raw, &read));
        Some(read)
    });
    let (geometry, of_file, mut notes) =
        geometry.map_or((None, None, Vec::new()), |read| (Some(read.spec), read.depth, read.notes));
    let etch = raw.geometry.as_ref().and_then(|geometry| geometry.etch_offset);
    let geometry = geometry.and_then(|spec| shapes::etched(&mut checker, spec, etch));
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
    let start = start::start(&mut checker, &raw, folder, given, geometry.as_ref(), &mut sources);
    if let Some(network) = &mut raw.network {
        network::measured::read(&mut checker, &mut network.measured, &mut network.measured_throats, folder);
    }
    let has_wetting_table = raw.sph.as_ref().is_some_and(|sph| sph.wetting.is_some());
    let mut model = model(&mut checker, &mut raw, geometry.as_ref(), start);
    let depth = raw.geometry.as_ref().and_then(|geometry| geometry.depth).or(of_file);
    depth::depth(&mut checker, depth, model.as_mut(), geometry.as_ref(), has_wetting_table);
    depth::refuse_rates(&mut checker, &raw, depth.is_some());
    if let (Some(raw), Some(Model::Network(network))) = (raw.network.as_mut(), model.as_ref()) {
        raw.films = network.displacement.as_ref().and_then(|displacement| displacement.films);
    }
    shapes::refuse_images(&mut checker, geometry.as_ref(), model.as_ref().and_then(Model::sides));
    permeability::permeability(&mut checker, model.as_ref(), geometry.as_ref());
    relative_permeability::relative_permeability(&mut checker, model.as_ref());
    let end = records::end(&mut checker, &raw, model.as_ref());
    let output = records::output(&mut checker, &mut raw, end, in_spacings(geometry.as_ref(), model.as_ref()));
    let steady = records::steady(&mut checker, &mut raw, end, &output);
    permeability::records(&mut checker, model.as_ref(), end, steady.is_some(), &output);
    relative_permeability::records(&mut checker, model.as_ref(), end, steady.is_some(), &output);
    let expect = records::expectations(&mut checker, &mut raw, model.as_ref(), geometry.as_ref());
    magnitudes(&mut checker, "sph", raw.sph.as_ref());
    magnitudes(&mut checker, "thin-film", raw.thin_film.as_ref());
    magnitudes(&mut checker, "network", raw.network.as_ref());
    notes.append(&mut checker.notes);
    let mut mistakes = reading.refuse(checker.problems);
    mistakes.append(&mut elsewhere);
    let (Some(title), Some(geometry), Some(model), Some(end), true) =
        (raw.title.clone(), geometry, model, end, mistakes.is_empty())
    else {
        return Err(InputError { mistakes });
    };
    let case = Case { title, geometry, depth, model, end, steady, output, expect };
    let shapes = if kept.is_some() { Vec::new() } else { case.geometry.shapes.clone() };
    let resolved = case_file::text(raw, &case, shapes);
    Ok(Loaded { case, resolved, sources, notes, document })
}

/// Width and height of the domain of a direct simulation in spacings.
fn in_spacings(geometry: Option<&GeometrySpec>, model: Option<&Model>) -> Option<[f64; 2]> {
    let (geometry, Model::Sph(sph)) = (geometry?, model?) else { return None };
    Some([0, 1].map(|axis| (geometry.max[axis] - geometry.min[axis]) / sph.spacing))
}

/// The model of the case.
fn model(
    checker: &mut Checker,
    raw: &mut RawCase,
    geometry: Option<&GeometrySpec>,
    start: Option<Start>,
) -> Option<Model> {
    match (&mut raw.sph, &mut raw.thin_film, &mut raw.network) {
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

/// The case as written, or without its models if it has several.
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
