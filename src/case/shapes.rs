//! Domain and solids of a case or of a shape file: which keys go together, and what the shapes themselves say.

use super::check::Checker;
use super::raw::{RawGeometry, RawShapeFile};
use crate::geometry::spec::{GeometrySpec, ShapeSpec};
use crate::input::Problem;

/// The geometry of a shape file.
pub(super) fn shape_file(checker: &mut Checker, raw: RawShapeFile) -> Option<GeometrySpec> {
    checker.format(raw.format);
    let keys = RawGeometry { file: None, min: raw.min, max: raw.max, solid: raw.solid, shapes: raw.shapes };
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
            checker.problems.extend(shape_problems(&join(at, &format!("shapes[{index}]")), shape));
        }
        return None;
    };
    let spec = GeometrySpec { min, max, solid, shapes: expanded(checker, at, &shapes) };
    if checker.problems.len() > before {
        return None;
    }
    for problem in spec_problems(&spec) {
        checker.refuse(join(at, &problem.path), problem.message, problem.help);
    }
    (checker.problems.len() == before).then_some(spec)
}

/// The shapes with generators replaced by the discs that they make.
fn expanded(checker: &mut Checker, at: &str, shapes: &[ShapeSpec]) -> Vec<ShapeSpec> {
    let mut plain = Vec::new();
    for (index, shape) in shapes.iter().enumerate() {
        match shape.expanded() {
            Ok(shapes) => plain.extend(shapes),
            Err(error) => {
                let path = join(at, &format!("shapes[{index}].{}.{}", shape.key(), error.key));
                checker.refuse(path, error.message, error.help);
            }
        }
    }
    plain
}

/// Refuses keys that belong to the file where a file is named.
pub(super) fn refuse_keys_of_file(checker: &mut Checker, raw: &RawGeometry) {
    let given = [("solid", raw.solid.is_some()), ("shapes", raw.shapes.is_some())];
    for (key, _) in given.into_iter().filter(|(_, given)| *given) {
        checker.refuse(
            format!("geometry.{key}"),
            format!("`file` and `{key}` are both given"),
            "put the shapes into the file, or write them all here and leave out `file`",
        );
    }
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
            checker.refuse(key, problem.message, problem.help);
        }
    }
    (checker.problems.len() == before).then_some(spec)
}

/// What is wrong with a domain and its shapes; key paths within the geometry.
fn spec_problems(spec: &GeometrySpec) -> Vec<Problem> {
    spec.problems()
}

/// What is wrong with one shape, written at the key path `at`.
pub(super) fn shape_problems(at: &str, shape: &ShapeSpec) -> Vec<Problem> {
    shape.problems(at)
}

fn join(at: &str, key: &str) -> String {
    if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") }
}
