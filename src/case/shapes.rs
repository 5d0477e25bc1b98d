//! Domain and solids of a case or of a shape file: which keys go together, and what the shapes themselves say.

use super::checked::{Model, Side};
use super::network::raw::{RawNetworkSide, RawNetworkSides};
use super::raw::{RawGeometry, RawShapeFile, RawSide, RawSides};
use crate::geometry::import::{Beyond, Options};
use crate::geometry::spec::{GeometrySpec, ShapeSpec};
use crate::input::{Checker, Problem};

/// The geometry of a shape file.
pub(super) fn shape_file(checker: &mut Checker, raw: RawShapeFile) -> Option<GeometrySpec> {
    checker.format(raw.format);
    let RawShapeFile { format: _, min, max, solid, shapes } = raw;
    let keys = RawGeometry { min, max, solid, shapes, ..RawGeometry::default() };
    inline(checker, "", &keys)
}

/// The geometry written at the key path `at` (`geometry`, or empty in a shape file).
pub(super) fn inline(checker: &mut Checker, at: &str, raw: &RawGeometry) -> Option<GeometrySpec> {
    let min = checker.require(&join(at, "min"), raw.min, "min = [0.0, 0.0] # m");
    let max = checker.require(&join(at, "max"), raw.max, "max = [1.0e-3, 1.0e-3] # m");
    let shapes = raw.shapes.clone().unwrap_or_default();
    let solid = raw.solid.unwrap_or_default();
    let before = checker.problems.len();
    let (Some(min), Some(max)) = (min, max) else {
        for (index, shape) in shapes.iter().enumerate() {
            checker.problems.extend(shape_problems(&join(at, &format!("shapes[{index}]")), shape, None));
        }
        return None;
    };
    let (written, shapes): (Vec<usize>, Vec<ShapeSpec>) = expanded(checker, at, &shapes).into_iter().unzip();
    let spec = GeometrySpec { min, max, solid, shapes };
    if checker.problems.len() > before {
        return None;
    }
    for problem in spec_problems(&spec) {
        checker.refuse(join(at, &in_file(&problem.path, &written)), problem.message, problem.help);
    }
    (checker.problems.len() == before).then_some(spec)
}

/// The shapes with generators replaced by the discs that they make, each with the index that it is written at.
fn expanded(checker: &mut Checker, at: &str, shapes: &[ShapeSpec]) -> Vec<(usize, ShapeSpec)> {
    let mut plain = Vec::new();
    for (index, shape) in shapes.iter().enumerate() {
        match shape.expanded() {
            Ok(shapes) => plain.extend(shapes.into_iter().map(|shape| (index, shape))),
            Err(error) => {
                let path = join(at, &format!("shapes[{index}].{}.{}", shape.key(), error.key));
                checker.refuse(path, error.message, error.help);
            }
        }
    }
    plain
}

/// The path of a problem with the index that its shape is written at.
fn in_file(path: &str, written: &[usize]) -> String {
    let parts = path.strip_prefix("shapes[").and_then(|rest| rest.split_once(']'));
    match parts.and_then(|(index, rest)| Some((written.get(index.parse::<usize>().ok()?)?, rest))) {
        Some((index, rest)) => format!("shapes[{index}]{rest}"),
        None => path.to_owned(),
    }
}

/// Refuses keys that belong to the file where a file is named.
pub(super) fn refuse_keys_of_file(checker: &mut Checker, raw: &RawGeometry) {
    let shapes = "put the shapes into the file, or write them all here and leave out `file`";
    let solid = "set `solid` in a TOML shape file; of other files `invert = true` makes the pore of what is drawn";
    let given = [("solid", raw.solid.is_some(), solid), ("shapes", raw.shapes.is_some(), shapes)];
    for (key, _, help) in given.into_iter().filter(|(_, given, _)| *given) {
        checker.refuse(format!("geometry.{key}"), format!("`file` and `{key}` are both given"), help);
    }
    if raw.window.is_some() {
        for (key, _) in [("min", raw.min), ("max", raw.max)].iter().filter(|(_, corner)| corner.is_some()) {
            let help = "keep `window`, which cuts the shapes at its sides, or `min` and `max`";
            checker.refuse(format!("geometry.{key}"), format!("`window` and `{key}` are both given"), help);
        }
    }
}

/// Refuses keys that tell how a file is read where no file is named.
pub(super) fn refuse_keys_of_import(checker: &mut Checker, raw: &RawGeometry) {
    let given = [
        ("unit", raw.unit.is_some()),
        ("scale", raw.scale.is_some()),
        ("window", raw.window.is_some()),
        ("layers", raw.layers.is_some()),
        ("join-within", raw.join_within.is_some()),
        ("threshold", raw.threshold.is_some()),
        ("pixel-size", raw.pixel_size.is_some()),
        ("invert", raw.invert.is_some()),
        ("recognize-circles", raw.recognize_circles.is_some()),
        ("smooth-below-deg", raw.smooth_below_deg.is_some()),
        ("columns", raw.columns.is_some()),
        ("separator", raw.separator.is_some()),
        ("diameters", raw.diameters.is_some()),
    ];
    for (key, _) in given.into_iter().filter(|(_, given)| *given) {
        let message = format!("`{key}` tells how a file is read, and no `file` is given");
        checker.refuse(
            format!("geometry.{key}"),
            message,
            "shapes written here are in m: leave it out, or name a `file`",
        );
    }
}

/// How the file of a case is read.
pub(super) fn options(raw: &RawGeometry) -> Options {
    Options {
        unit: raw.unit.clone(),
        scale: raw.scale,
        window: raw.window,
        layers: raw.layers.clone(),
        join_within: raw.join_within,
        threshold: raw.threshold,
        pixel_size: raw.pixel_size,
        invert: raw.invert,
        recognize_circles: raw.recognize_circles,
        smooth_below_deg: raw.smooth_below_deg,
        columns: raw.columns,
        separator: raw.separator,
        diameters: raw.diameters,
    }
}

/// What becomes of shapes beyond the sides of a window: left, right, bottom, top.
pub(super) fn beyond(sides: Option<&RawSides>) -> [Beyond; 4] {
    let Some(sides) = sides else { return [Beyond::Whole; 4] };
    [sides.left, sides.right, sides.bottom, sides.top].map(|side| match side {
        Some(RawSide::Inlet | RawSide::Outlet) => Beyond::Straight,
        Some(RawSide::Periodic) => Beyond::Nothing,
        None | Some(RawSide::Wall | RawSide::Image | RawSide::Symmetry) => Beyond::Whole,
    })
}

/// The same of a network, which cuts walls at its open sides itself.
pub(super) fn beyond_network(sides: Option<&RawNetworkSides>) -> [Beyond; 4] {
    let sides = sides.cloned().unwrap_or_default();
    [sides.left, sides.right, sides.bottom, sides.top].map(|side| match side {
        Some(RawNetworkSide::Periodic) => Beyond::Nothing,
        None | Some(RawNetworkSide::Wall) => Beyond::Whole,
    })
}

/// The geometry of a file with the domain that the case puts in its place.
pub(super) fn with_domain(checker: &mut Checker, mut spec: GeometrySpec, raw: &RawGeometry) -> Option<GeometrySpec> {
    let before = checker.problems.len();
    spec.min = raw.min.unwrap_or(spec.min);
    spec.max = raw.max.unwrap_or(spec.max);
    if raw.min.is_some() || raw.max.is_some() {
        for problem in spec_problems(&spec) {
            // The shapes were right in their file, so that what is wrong now is the domain.
            let key = if raw.max.is_some() { "geometry.max" } else { "geometry.min" };
            let help = format!("{}; `window` in place of `min` and `max` leaves out what lies outside", problem.help);
            checker.refuse(key, problem.message, help);
        }
    }
    (checker.problems.len() == before).then_some(spec)
}

/// Refuses shapes whose images beyond periodic sides would be too many.
pub(super) fn refuse_images(checker: &mut Checker, geometry: Option<&GeometrySpec>, model: Option<&Model>) {
    let sides = match model {
        Some(Model::Sph(sph)) => &sph.sides,
        Some(Model::Network(network)) => &network.sides,
        Some(Model::ThinFilm(_)) | None => return,
    };
    let periodic = [sides.left == Side::Periodic, sides.bottom == Side::Periodic];
    for problem in geometry.map_or_else(Vec::new, |geometry| geometry.periodic_problems(periodic)) {
        checker.refuse(format!("geometry.{}", problem.path), problem.message, problem.help);
    }
}

/// What is wrong with a domain and its shapes; key paths within the geometry.
fn spec_problems(spec: &GeometrySpec) -> Vec<Problem> {
    spec.problems()
}

/// What is wrong with one shape, written at the key path `at`.
pub(super) fn shape_problems(at: &str, shape: &ShapeSpec, geometry: Option<&GeometrySpec>) -> Vec<Problem> {
    geometry.map_or_else(|| shape.problems(at), |geometry| shape.problems_in(geometry, at))
}

fn join(at: &str, key: &str) -> String {
    if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") }
}
