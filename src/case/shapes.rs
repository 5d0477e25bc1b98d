//! Domain and solids of a case or of a shape file: which keys go together, and what the shapes themselves say.

use super::check::Checker;
use super::raw::{RawGeometry, RawShapeFile};
use crate::geometry::spec::{GeometrySpec, ShapeSpec};

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
    let before = checker.problems.len();
    for (index, shape) in shapes.iter().enumerate() {
        shape_problems(checker, &join(at, &format!("shapes[{index}]")), shape);
    }
    let spec = GeometrySpec { min: min?, max: max?, solid: raw.solid.unwrap_or_default(), shapes };
    domain(checker, at, &spec);
    (checker.problems.len() == before).then_some(spec)
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
pub(super) fn with_domain(checker: &mut Checker, mut spec: GeometrySpec, raw: &RawGeometry) -> GeometrySpec {
    spec.min = raw.min.unwrap_or(spec.min);
    spec.max = raw.max.unwrap_or(spec.max);
    if raw.min.is_some() || raw.max.is_some() {
        domain(checker, "geometry", &spec);
    }
    spec
}

fn domain(checker: &mut Checker, at: &str, spec: &GeometrySpec) {
    for (axis, name) in ["x", "y"].into_iter().enumerate() {
        let (min, max) = (spec.min[axis], spec.max[axis]);
        if min >= max {
            checker.refuse(
                join(at, "max"),
                format!("the domain is empty along {name}: min is {min:?} m, max is {max:?} m"),
                "min is the lower left corner, max the upper right one",
            );
        }
    }
}

/// What is wrong with one shape on its own.
pub(super) fn shape_problems(checker: &mut Checker, at: &str, shape: &ShapeSpec) {
    let (name, lengths) = match shape {
        ShapeSpec::HalfPlane(_) => ("half-plane", vec![]),
        ShapeSpec::Disc(disc) => ("disc", vec![("radius", disc.radius)]),
        ShapeSpec::Rectangle(r) => ("rectangle", vec![("size[0]", r.size[0]), ("size[1]", r.size[1])]),
        ShapeSpec::Capsule(capsule) => ("capsule", vec![("radius", capsule.radius)]),
        ShapeSpec::Polygon(_) => ("polygon", vec![]),
        ShapeSpec::Channel(channel) => ("channel", vec![("width", channel.width)]),
        ShapeSpec::ThroatDiscs(t) => {
            ("throat-discs", vec![("radii[0]", t.radii[0]), ("radii[1]", t.radii[1]), ("gap", t.gap)])
        }
        ShapeSpec::ThroatCosine(t) => {
            ("throat-cosine", vec![("width", t.width), ("throat", t.throat), ("length", t.length)])
        }
    };
    for (key, length) in lengths {
        checker.positive(&format!("{at}.{name}.{key}"), Some(length), "a length in m");
    }
}

fn join(at: &str, key: &str) -> String {
    if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") }
}
