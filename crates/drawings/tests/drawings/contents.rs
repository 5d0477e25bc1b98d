//! What the files hold, as read and as the reference has it.

use meniscus_drawings::import::{Imported, Options};
use meniscus_drawings::load;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Disc, GeometrySpec, ShapeSpec};
use serde_json::Value;

use super::files::file;

/// The box of the grains in m.
pub const GRAINS: [[f64; 2]; 2] = [[0.0, 0.0], [10e-3, 6e-3]];

pub fn reference() -> Value {
    serde_json::from_slice(&std::fs::read(file("reference.json")).unwrap()).unwrap()
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

pub fn rows(value: &Value) -> Vec<Vec<Value>> {
    value.as_array().unwrap().iter().map(|row| row.as_array().unwrap().clone()).collect()
}

pub fn imported(name: &str, options: &Options) -> Imported {
    load(&file(name), options).unwrap_or_else(|error| panic!("{name}: {error}"))
}

pub fn porosity(spec: &GeometrySpec) -> f64 {
    Geometry::new(spec).unwrap().porosity().value
}

/// The discs by their centers, so that packs in another order can be compared.
pub fn discs(spec: &GeometrySpec) -> Vec<Disc> {
    let disc = |shape: &ShapeSpec| if let ShapeSpec::Disc(disc) = shape { Some(disc.clone()) } else { None };
    spec.shapes.iter().filter_map(disc).collect()
}
