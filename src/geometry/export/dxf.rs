//! DXF of AutoCAD 2000 in mm (`$INSUNITS` 4): discs as CIRCLE, all else as closed LWPOLYLINE with bulges, holes as rings of their own.

use dxf::entities::{Circle, Entity, EntityType, LwPolyline};
use dxf::enums::{AcadVersion, Units};
use dxf::{Drawing, LwPolylineVertex, Point};

use super::ExportError;
use super::sheet::Sheet;
use crate::geometry::import::drawing::{Outline, Ring};

/// Millimeters per meter.
const MM: f64 = 1e3;

pub(super) fn dxf(sheet: &Sheet) -> Result<Vec<u8>, ExportError> {
    let mut drawing = Drawing::new();
    drawing.header.version = AcadVersion::R2000;
    drawing.header.default_drawing_units = Units::Millimeters;
    let corner = |p: crate::math::Vec2| Point::new(p.x * MM, p.y * MM, 0.0);
    drawing.header.minimum_drawing_extents = corner(sheet.frame.min);
    drawing.header.maximum_drawing_extents = corner(sheet.frame.max);
    for outline in &sheet.outlines {
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
