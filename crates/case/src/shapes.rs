//! Domain and solids of a case or of a shape file: which keys go together, and checks of the shapes.

use std::path::PathBuf;

use super::network::{RawNetworkSide, RawNetworkSides};
use super::side::{Side, Sides};
use super::sides::RawSides;
use meniscus_core::input::tables::{Key, join, tables};
use meniscus_core::input::{Checker, Problem, Range};
use meniscus_drawings::import::{Beyond, Frame, Nested, Options};
use meniscus_drawings::with_drawing_options;
use meniscus_geometry::spec::{GeometrySpec, ShapeSpec, SolidSide};

tables! {
    /// A shape file: domain and solids.
    pub(crate) struct RawShapeFile {
        /// Version of the format: 1.
        pub format: u32 => Key::required("format = 1"),
        /// Lower left corner of the domain in m.
        pub min: [f64; 2],
        /// Upper right corner of the domain in m.
        pub max: [f64; 2],
        /// Whether the shapes are solid (`inside`, the default) or the pore (`outside`).
        pub solid: SolidSide,
        /// The shapes, united.
        pub shapes: Vec<ShapeSpec>,
        /// Depth of the chip (distance between floor and lid) in m (default: none); that of a case overrides it.
        pub depth: f64 => DEPTH,
    }
}

with_drawing_options! {
    /// Domain and solids of a case.
    pub(crate) struct RawGeometry {
        /// Shape file or drawing.
        pub file: PathBuf,
        /// Lower left corner of the domain in m (default: that of the file).
        pub min: [f64; 2],
        /// Upper right corner of the domain in m (default: that of the file).
        pub max: [f64; 2],
        /// Whether the inside or the outside of the shapes is solid; with `file` use `invert` (default `inside`).
        pub solid: SolidSide,
        /// The shapes, united; not with `file`.
        pub shapes: Vec<ShapeSpec>,
        /// Depth of the chip (distance between floor and lid) in m (default: that of a TOML shape file; without one all results are per meter of depth).
        pub depth: f64 => DEPTH,
        /// Distance in m by which every wall of the drawing moves into the pore; below 0 into the solid (default 0.0).
        pub etch_offset: f64,
    }
}

/// Depth of a chip (distance between floor and lid).
pub(crate) const DEPTH: Key =
    Key::positive("a depth in m").help("an etched or molded chip has 20e-6 to 400e-6; leave it out for a plane");

/// The geometry of a shape file, and its depth in m if it has one.
pub(super) fn shape_file(checker: &mut Checker, raw: RawShapeFile) -> Option<(GeometrySpec, Option<f64>)> {
    let raw = raw.in_range(checker, "");
    checker.format(raw.format);
    let RawShapeFile { format: _, min, max, solid, shapes, depth } = raw;
    let keys = RawGeometry { min, max, solid, shapes, ..RawGeometry::default() };
    inline(checker, "", &keys).map(|spec| (spec, depth))
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
    for problem in spec.problems() {
        checker.refuse(join(at, &in_file(&problem.path, &written)), problem.message, problem.help);
    }
    (checker.problems.len() == before).then_some(spec)
}

/// The shapes with generators expanded to discs, each with its index in the file.
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

/// The path of a problem with the index of its shape in the file.
fn in_file(path: &str, written: &[usize]) -> String {
    let parts = path.strip_prefix("shapes[").and_then(|rest| rest.split_once(']'));
    match parts.and_then(|(index, rest)| Some((written.get(index.parse::<usize>().ok()?)?, rest))) {
        Some((index, rest)) => format!("shapes[{index}]{rest}"),
        None => path.to_owned(),
    }
}

/// Refuses keys that belong into the file if there is one.
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

/// Refuses keys of the import if there is no file.
pub(super) fn refuse_keys_of_import(checker: &mut Checker, raw: &RawGeometry) {
    for (key, _) in Options::from(raw).given() {
        let message = format!("`{key}` controls how a file is read, and no `file` is given");
        checker.refuse(
            format!("geometry.{key}"),
            message,
            "shapes written here are in m: leave it out, or name a `file`",
        );
    }
}

/// Treatment of shapes beyond the sides of a window: left, right, bottom, top.
pub(super) fn beyond(sides: Option<&RawSides>) -> [Beyond; 4] {
    let Some(sides) = sides else { return [Beyond::Whole; 4] };
    [sides.left, sides.right, sides.bottom, sides.top].map(|side| match side {
        Some(Side::Inlet | Side::Outlet) => Beyond::Straight,
        Some(Side::Periodic) => Beyond::Nothing,
        None | Some(Side::Wall | Side::Image | Side::Symmetry) => Beyond::Whole,
    })
}

/// The same for a network, which cuts walls at its open sides itself.
pub(super) fn beyond_network(sides: Option<&RawNetworkSides>) -> [Beyond; 4] {
    let sides = sides.cloned().unwrap_or_default();
    [sides.left, sides.right, sides.bottom, sides.top].map(|side| match side {
        Some(RawNetworkSide::Periodic) => Beyond::Nothing,
        None | Some(RawNetworkSide::Wall) => Beyond::Whole,
    })
}

/// The geometry of a file with the domain replaced by that of the case.
pub(super) fn with_domain(checker: &mut Checker, mut spec: GeometrySpec, raw: &RawGeometry) -> Option<GeometrySpec> {
    let before = checker.problems.len();
    spec.min = raw.min.unwrap_or(spec.min);
    spec.max = raw.max.unwrap_or(spec.max);
    if raw.min.is_some() || raw.max.is_some() {
        for problem in spec.problems() {
            // The shapes were valid in their file, so the domain is wrong.
            let key = if raw.max.is_some() { "geometry.max" } else { "geometry.min" };
            let help = format!("{}; `window` in place of `min` and `max` leaves out what lies outside", problem.help);
            checker.refuse(key, problem.message, help);
        }
    }
    (checker.problems.len() == before).then_some(spec)
}

/// The geometry with its walls moved by an etch offset in m, if there is one.
pub(super) fn etched(checker: &mut Checker, spec: GeometrySpec, offset: Option<f64>) -> Option<GeometrySpec> {
    const KEY: &str = "geometry.etch-offset";
    let Some(offset) = offset.filter(|offset| *offset != 0.0) else { return Some(spec) };
    if !offset.is_finite() {
        checker.refuse(KEY, format!("expected a distance in m, found {offset:?}"), "etch-offset = 1.0e-6 # m");
        return None;
    }
    match spec.etched(offset) {
        Ok(spec) => Some(spec),
        Err(problem) => {
            checker.refuse(KEY, format!("{}: {}", problem.path, problem.message), problem.help);
            None
        }
    }
}

/// Refuses shapes whose images beyond periodic sides would be too many.
pub(super) fn refuse_images(checker: &mut Checker, geometry: Option<&GeometrySpec>, sides: Option<&Sides>) {
    let Some(sides) = sides else { return };
    for problem in geometry.map_or_else(Vec::new, |geometry| geometry.periodic_problems(sides.periodic())) {
        checker.refuse(format!("geometry.{}", problem.path), problem.message, problem.help);
    }
}

/// What is wrong with one shape, written at the key path `at`.
pub(super) fn shape_problems(at: &str, shape: &ShapeSpec, geometry: Option<&GeometrySpec>) -> Vec<Problem> {
    geometry.map_or_else(|| shape.problems(at), |geometry| shape.problems_in(geometry, at))
}
