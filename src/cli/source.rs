//! Loads cases and shapes: the only access of the command line to the case reader and the geometry.

use std::path::Path;

use super::exit::{BAD_INPUT, Failure, USAGE};
use super::output::tell;
use crate::run::setup::{self, SetupError};
use crate::run::source::{self, Refusal, Source, is_case_file};
use meniscus_case::{self, NetworkOptions, SIDES};
use meniscus_core::input::{Overrides, Problem};
use meniscus_core::snapshot::{Grid, Lines};
use meniscus_core::solver::{Measure, measure};
use meniscus_drawings::import::{Imported, Options};
use meniscus_geometry::spec::GeometrySpec;
use meniscus_geometry::throats::throats;
use meniscus_geometry::{Geometry, GeometryError};

/// Nodes of the distance grid along the longer side of a shape file's domain.
const GRID_NODES: f64 = 400.0;

/// Chordal tolerance of the drawn outline relative to the domain's longer side: a hundredth of a pixel of the picture.
const OUTLINE_ERROR: f64 = 1e-5;

/// Number of the narrowest throats that are printed.
const THROATS: usize = 10;

/// Printed and drawn properties of a shape file.
#[derive(Debug)]
pub(crate) struct Shapes {
    /// Outline of the solids.
    pub(crate) outline: Lines<'static>,
    /// Signed distance on a grid, in the field `wall-distance`.
    pub(crate) distance: Grid<'static>,
    /// Porosity, specific surface, throats.
    pub(crate) measures: Vec<Measure>,
    /// Walls and periodic sides, if given by the user.
    pub(crate) sides: Option<String>,
    /// The shapes as read.
    pub(crate) spec: GeometrySpec,
    /// Depth of the chip (distance between floor and lid) in m.
    pub(crate) depth: Option<f64>,
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Input(error) => Self::input(error),
            Refusal::Options(problems) => of_options(&problems),
            Refusal::Setup(text) => Self::new(BAD_INPUT, &text),
        }
    }
}

/// A case, after printing its notes.
fn with_notes_printed(source: Source) -> Source {
    source.notes.iter().for_each(tell);
    source
}

/// Loads a case file, or the built-in case if `None`, and checks it against its geometry.
pub(crate) fn load_case(path: Option<&Path>, overrides: &[String]) -> Result<Source, Failure> {
    source::load_case(path, overrides).map(with_notes_printed).map_err(Failure::input)
}

/// The network of a drawing or of a case file.
pub(crate) fn load_network(path: &Path, import: &Options, options: &NetworkOptions) -> Result<Source, Failure> {
    Ok(with_notes_printed(source::load_network(path, import, options)?))
}

/// Loads a case file as if the file of its initial state contained `state`.
pub(crate) fn load_started(path: &Path, overrides: &[String], state: &str) -> Result<Source, Failure> {
    source::load_started(path, overrides, state).map(with_notes_printed).map_err(Failure::input)
}

/// Loads a shape file.
fn geometry_of_file(path: &Path, options: &Options, periodic: [bool; 2]) -> Result<Imported, Failure> {
    let read = source::load_drawing(path, options, periodic).map_err(Failure::input)?;
    read.notes.iter().for_each(tell);
    Ok(read)
}

/// Problems of keys that correspond to command-line options.
fn of_options(problems: &[Problem]) -> Failure {
    let lines: Vec<String> = problems
        .iter()
        .map(|problem| format!("--{}: {}; {}", NetworkOptions::name_of(&problem.path), problem.message, problem.help))
        .map(|line| line.trim_end_matches("; ").to_owned())
        .collect();
    Failure::new(BAD_INPUT, lines.join("\n"))
}

/// Refuses an invalid depth in m for these shapes.
pub(crate) fn valid_depth(depth: Option<f64>, spec: &GeometrySpec) -> Result<(), Failure> {
    depth
        .and_then(|depth| meniscus_case::implausible_depth(depth, spec))
        .map_or(Ok(()), |problem| Err(of_options(&[problem])))
}

/// Loads and measures a shape file, or the geometry of a case with the case's sides, of a `depth` in m if given; `at` receives the current stage.
pub(crate) fn load_shapes(
    path: &Path,
    options: &Options,
    periodic: Option<[bool; 2]>,
    depth: Option<f64>,
    at: impl Fn(&'static str),
) -> Result<Shapes, Failure> {
    at("reading and checking the shapes");
    let is_case = is_case_file(path);
    if is_case && *options != Options::default() {
        let message = "a case has its own import options: set the keys of its [geometry]";
        return Err(Failure::new(USAGE, message));
    }
    let (geometry, spec, depth) = match (is_case, periodic) {
        (true, Some(_)) => {
            let message = "a case has its own periodic sides: leave out --periodic";
            return Err(Failure::new(USAGE, message));
        }
        (true, None) => {
            let set: Vec<String> = depth.iter().map(|depth| format!("geometry.depth={depth:?}")).collect();
            let overrides = Overrides::parse(&set).map_err(Failure::input)?;
            let loaded = meniscus_case::load(path, &overrides).map_err(Failure::input)?;
            loaded.notes.iter().for_each(tell);
            at("uniting the shapes");
            let geometry = setup::geometry(&loaded.case);
            let refused = |error: SetupError| {
                loaded.refuse(error.problems()).err().map_or_else(|| Failure::new(BAD_INPUT, &error), Failure::input)
            };
            (geometry.map_err(refused)?, loaded.case.geometry, loaded.case.depth)
        }
        (false, periodic) => {
            let Imported { spec, depth: of_file, .. } = geometry_of_file(path, options, periodic.unwrap_or_default())?;
            let depth = depth.or(of_file);
            valid_depth(depth, &spec)?;
            at("uniting the shapes");
            let problems = spec.periodic_problems(periodic.unwrap_or_default());
            if !problems.is_empty() {
                return Err(Failure::new(BAD_INPUT, GeometryError::Invalid(problems)));
            }
            let geometry = Geometry::new(&spec).map_err(Failure::with(BAD_INPUT))?;
            (geometry.with_sides(periodic.unwrap_or_default(), [false; 4]), spec, depth)
        }
    };
    let sides = (is_case || periodic.is_some()).then(|| kinds_of_sides(&geometry));
    at("measuring porosity, walls and throats");
    let measures = measures(&geometry, depth);
    at("drawing the outline");
    let longer = geometry.bounds().size().max();
    let outline = geometry.outline_within(OUTLINE_ERROR * longer);
    at("computing the signed distance on a grid");
    let distance = geometry.distance_grid(longer / GRID_NODES);
    Ok(Shapes { outline, distance, measures, sides, spec, depth })
}

/// The kind of each side, as far as the geometry has it.
fn kinds_of_sides(geometry: &Geometry) -> String {
    let [x, y] = geometry.periodic();
    let names = SIDES.into_iter().zip([x, x, y, y]).zip(geometry.wall_sides());
    let kinds = names.map(|((name, is_periodic), is_wall)| match (is_periodic, is_wall) {
        (true, _) => format!("{name} periodic"),
        (_, true) => format!("{name} wall"),
        _ => format!("{name} open"),
    });
    kinds.collect::<Vec<_>>().join(", ")
}

fn measures(geometry: &Geometry, depth: Option<f64>) -> Vec<Measure> {
    let porosity = geometry.porosity();
    let mut found = vec![
        measure("porosity", porosity.value, "")
            .by("share of the domain that is not solid, exact along the outline")
            .with_uncertainty(porosity.uncertainty),
        measure("specific-surface-per-m", geometry.specific_surface(), "1/m")
            .by("wall length over the area of the domain"),
    ];
    found.extend(depth.into_iter().flat_map(|depth| of_chip(geometry, depth)));
    for (number, throat) in throats(geometry).iter().take(THROATS).enumerate() {
        // Adding zero turns minus zero into zero.
        let (c, name) = (throat.center.map(|v| v + 0.0), format!("throat-{}-width-m", number + 1));
        let method = format!("shortest distance from wall to wall, middle at ({:.4e}, {:.4e}) m", c.x, c.y);
        found.push(measure(&name, throat.width, "m").by(&method));
        if let Some(depth) = depth {
            let name = format!("throat-{}-width-over-depth", number + 1);
            found.push(measure(&name, throat.width / depth, "").by("the same over the depth"));
        }
    }
    found
}

/// Measures of a geometry that require its `depth` in m.
fn of_chip(geometry: &Geometry, depth: f64) -> [Measure; 4] {
    let (porosity, area) = (geometry.porosity().value, geometry.bounds().area());
    let with_plates = geometry.specific_surface() + 2.0 * porosity / depth;
    let walls = "area of walls, floor and lid over the volume of the domain";
    let bound = "porosity times depth squared over 12: no permeability of the flow averaged over the depth is larger";
    [
        measure("depth-m", depth, "m").by("distance of floor and lid"),
        measure("pore-volume-m3", porosity * area * depth, "m3").by("area of the pore times the depth"),
        measure("specific-surface-with-plates-per-m", with_plates, "1/m").by(walls),
        measure("permeability-bound-m2", porosity * depth * depth / 12.0, "m2").by(bound),
    ]
}

/// The commented starter case, of a chip if there is a `depth` in m.
pub(crate) fn starter_case(depth: Option<f64>) -> Result<String, Failure> {
    depth
        .map_or_else(|| Ok(meniscus_case::starter_case().to_owned()), meniscus_case::starter_of_chip)
        .map_err(Failure::input)
}
