//! From the user's input, a case file, its text or a drawing with a few numbers, to a case that is checked against its geometry.

use std::path::Path;

use super::setup::{self, SetupError};
use meniscus_case::{self, Case, Loaded, Model, NetworkOptions, Origin};
use meniscus_core::input::{Document, InputError, Overrides, Problem, file};
use meniscus_drawings::import::{self, Beyond, Imported, Options};
use meniscus_geometry::spec::GeometrySpec;

/// Name of the output folder of the built-in case.
const DEFAULT_NAME: &str = "four-discs";

/// The note on pressures if no tension was given.
const WITHOUT_TENSION: &str = "no tension is given: pressures are those of a tension of 1 N/m; multiply them by yours";

/// The note on menisci if no angle was given.
const WITHOUT_ANGLE: &str = "no contact angle is given: it is 0 degrees, complete wetting; give yours by --angle-deg";

/// A checked case with its name.
#[derive(Debug)]
pub struct Source {
    /// The case.
    pub case: Case,
    /// The case file with all defaults filled in.
    pub resolved: String,
    /// Name of the case: that of its file without the ending.
    pub name: String,
    /// Notes for the user on how it was read.
    pub notes: Vec<String>,
    /// The text of the case file; `None` if there is none.
    pub document: Option<Document>,
}

/// What is wrong with the user's input.
#[derive(Debug, thiserror::Error)]
pub enum Refusal {
    /// Mistakes with their locations in files.
    #[error(transparent)]
    Input(#[from] InputError),
    /// Mistakes in [`NetworkOptions`] and [`Options`], by the corresponding keys of a case file.
    #[error("{}", .0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    Options(Vec<Problem>),
    /// No solver can be made for a case without a file.
    #[error("{0}")]
    Setup(String),
}

impl Source {
    /// Why no solver can be made for the case, with the locations in its file.
    pub fn refused(&self, error: &SetupError) -> Refusal {
        let placed = self.document.as_ref().and_then(|document| document.refuse(error.problems()).err());
        placed.map_or_else(|| Refusal::Setup(error.to_string()), Refusal::Input)
    }

    /// Problems of the case that were found later, each with its location in the file.
    pub(crate) fn refused_for(&self, problems: Vec<Problem>) -> Refusal {
        let message = problems.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
        let placed = self.document.as_ref().and_then(|document| document.refuse(problems).err());
        placed.map_or(Refusal::Setup(message), Refusal::Input)
    }

    /// A case that does not fit, with the location of the key that a user would change.
    pub(crate) fn refused_at(&self, key: &str, message: &str, help: &str) -> Refusal {
        self.refused_for(vec![Problem::new(key, message, help)])
    }
}

/// Loads a case file, or the built-in case if `None`, and checks it against its geometry.
///
/// # Errors
/// All mistakes with their locations.
pub fn load_case(path: Option<&Path>, overrides: &[String]) -> Result<Source, InputError> {
    let name = path.and_then(Path::file_stem).map_or_else(|| DEFAULT_NAME.into(), |stem| stem.to_string_lossy().into());
    sound(&path.map_or(Origin::BuiltIn, Origin::Disk), overrides, name)
}

/// The same with the text of a case, called `name`. Relative paths in it refer to the working folder.
///
/// # Errors
/// All mistakes with their locations.
pub fn load_case_text(name: &str, text: &str, overrides: &[String]) -> Result<Source, InputError> {
    sound(&Origin::Given(name, text), overrides, name.to_owned())
}

/// Loads a case file as if the file of its initial state contained `state`.
///
/// # Errors
/// All mistakes with their locations.
pub(crate) fn load_started(path: &Path, overrides: &[String], state: &str) -> Result<Source, InputError> {
    sound(&Origin::Started(path, state), overrides, path.file_stem().unwrap_or_default().to_string_lossy().into())
}

/// The case, if it is valid for its geometry.
fn sound(origin: &Origin, overrides: &[String], name: String) -> Result<Source, InputError> {
    let loaded = meniscus_case::load_from(origin, &Overrides::parse(overrides)?, None)?;
    loaded.refuse(setup::problems(&loaded.case))?;
    let Loaded { case, resolved, notes, document, .. } = loaded;
    Ok(Source { case, resolved, name, notes, document: Some(document) })
}

/// Whether a file is a case file, and not a shape file, by its content.
pub fn is_case_file(path: &Path) -> bool {
    // Errors of unreadable files are left to the readers of shape files.
    let is_toml = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    is_toml && file::read_text(path).is_ok_and(|text| meniscus_case::is_case(&text))
}

/// The shapes of a drawing; those that cross a periodic side are cut there.
///
/// # Errors
/// All mistakes of the file or of the options, or why it cannot be read.
pub fn load_drawing(path: &Path, options: &Options, periodic: [bool; 2]) -> Result<Imported, InputError> {
    Ok(within_sides(meniscus_case::load_shapes(path, options)?, options, periodic))
}

fn within_sides(mut read: Imported, options: &Options, [x, y]: [bool; 2]) -> Imported {
    if options.window.is_some() {
        let beyond = |is_joined| if is_joined { Beyond::Nothing } else { Beyond::Whole };
        import::cut_at_sides(&mut read.spec, [x, x, y, y].map(beyond));
    }
    read
}

/// The network of a drawing, or of the geometry of a case file, with its displacement. A case of a network keeps its other keys.
///
/// # Errors
/// All mistakes of the file and of the options.
pub fn load_network(path: &Path, import: &Options, options: &NetworkOptions) -> Result<Source, Refusal> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    if !is_case_file(path) {
        let read = load_drawing(path, import, options.periodic)?;
        return network_of(&name, read, options);
    }
    let source = load_case(Some(path), &[])?;
    if matches!(source.case.model, Model::Network(_)) {
        return Ok(load_case(Some(path), &options.overrides())?);
    }
    let Source { case, notes, .. } = source;
    network_of(&name, Imported { spec: case.geometry, depth: case.depth, notes }, options)
}

/// The same for the text of a shape file in TOML, called `name`.
///
/// # Errors
/// All mistakes of the text and of the options.
pub fn load_network_text(
    name: &str,
    text: &str,
    import: &Options,
    options: &NetworkOptions,
) -> Result<Source, Refusal> {
    let read = meniscus_case::load_shapes_text(name, text, import)?;
    network_of(name, within_sides(read, import, options.periodic), options)
}

/// The case of a network without a case file.
fn network_of(name: &str, read: Imported, options: &NetworkOptions) -> Result<Source, Refusal> {
    let Imported { spec, depth: of_file, mut notes } = read;
    if options.has_interface() && options.tension.is_none() {
        notes.push(WITHOUT_TENSION.to_owned());
    }
    if options.has_interface() && options.angle_deg.is_none() {
        notes.push(WITHOUT_ANGLE.to_owned());
    }
    let geometry: GeometrySpec = spec;
    let title = format!("Network of {name}");
    let depth = options.depth.or(of_file);
    let (case, resolved) = meniscus_case::quick(&title, geometry, depth, &options.table()).map_err(Refusal::Options)?;
    Ok(Source { case, resolved, name: format!("{name}-network"), notes, document: None })
}
