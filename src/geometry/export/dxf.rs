//! DXF of AutoCAD 2000 in mm (`$INSUNITS` 4): discs as CIRCLE, all others as closed LWPOLYLINE with bulges, holes as separate rings. A rectangle on the layer
//! `domain` is the domain. Overlapping shapes are united: nested outlines are holes when read.

use dxf::entities::{Circle, Entity, EntityType, LwPolyline};
use dxf::enums::{AcadVersion, Units};
use dxf::{Drawing, LwPolylineVertex, Point};

use super::error::ExportError;
use super::sheet::{Sheet, rings_of};
use crate::geometry::import::combine::Solid;
use crate::geometry::import::drawing::{FillRule, Outline, Ring};
use crate::geometry::import::frame::DOMAIN;
use crate::geometry::import::nest::regions;
use crate::geometry::tree::Tree;
use crate::math::Bounds;

/// Lengths below this fraction of the domain count as zero at intersections.
const TOLERANCE: f64 = 1e-9;
/// Millimeters per meter.
const MM: f64 = 1e3;

pub(super) fn dxf(sheet: &Sheet) -> Result<Vec<u8>, ExportError> {
    let mut drawing = Drawing::new();
    drawing.header.version = AcadVersion::R2000;
    drawing.header.default_drawing_units = Units::Millimeters;
    let corner = |p: crate::math::Vec2| Point::new(p.x * MM, p.y * MM, 0.0);
    drawing.header.minimum_drawing_extents = corner(sheet.frame.min);
    drawing.header.maximum_drawing_extents = corner(sheet.frame.max);
    let (min, max) = (sheet.frame.min, sheet.frame.max);
    let sides = [[min.x, min.y], [max.x, min.y], [max.x, max.y], [min.x, max.y]];
    let rectangle = Ring { vertices: sides.map(|[x, y]| [x, y, 0.0]).to_vec() };
    let mut domain = Entity::new(EntityType::LwPolyline(polyline(&rectangle)));
    DOMAIN.clone_into(&mut domain.common.layer);
    drawing.add_entity(domain);
    for outline in &apart(sheet) {
        match outline {
            Outline::Disc { center, radius } => {
                drawing.add_entity(Entity::new(EntityType::Circle(Circle::new(corner(*center), radius * MM))));
            }
            Outline::Area { rings, .. } => {
                for ring in rings {
                    drawing.add_entity(Entity::new(EntityType::LwPolyline(polyline(ring))));
                }
            }
        }
    }
    let mut bytes = Vec::new();
    drawing.save(&mut bytes).map_err(|error| ExportError::Library(error.to_string()))?;
    Ok(bytes)
}

/// The outlines; those with overlapping boxes are united.
fn apart(sheet: &Sheet) -> Vec<Outline> {
    let tolerance = TOLERANCE * sheet.frame.size().max();
    let solids: Vec<Vec<Solid>> = sheet
        .outlines
        .iter()
        .map(|outline| regions(&rings_of(outline), FillRule::EvenOdd).iter().filter_map(Solid::of).collect())
        .collect();
    let bounds = |all: &Vec<Solid>| all.iter().map(Solid::bounds).reduce(|a, b| a.united(&b));
    let boxes: Vec<Option<Bounds>> = solids.iter().map(bounds).collect();
    let tree = Tree::over(boxes.iter().flatten().copied());
    let alone = |k: usize| boxes[k].is_none_or(|own| tree.near(own).count() < 2);
    let (alone, together): (Vec<usize>, Vec<usize>) = (0..solids.len()).partition(|&k| alone(k));
    let mut found: Vec<Outline> = alone.iter().map(|&k| sheet.outlines[k].clone()).collect();
    let mut parts = Vec::new();
    for (k, own) in solids.into_iter().enumerate() {
        if together.binary_search(&k).is_ok() {
            parts.extend(own);
        }
    }
    match Solid::united(&parts, tolerance) {
        Some(united) => found.extend(united.into_iter().map(|(outer, holes)| {
            let rings = std::iter::once(outer).chain(holes).collect();
            Outline::Area { rings, rule: FillRule::EvenOdd }
        })),
        None => found.extend(together.iter().map(|&k| sheet.outlines[k].clone())),
    }
    found
}

fn polyline(ring: &Ring) -> LwPolyline {
    let mut polyline = LwPolyline::default();
    polyline.set_is_closed(true);
    polyline.vertices = ring
        .vertices
        .iter()
        .map(|&[x, y, bulge]| LwPolylineVertex { x: x * MM, y: y * MM, bulge, ..LwPolylineVertex::default() })
        .collect();
    polyline
}
