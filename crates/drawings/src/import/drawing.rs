//! Result of a reader, in the unit of the drawing and before scaling, recognition or cutting.

use std::collections::BTreeMap;

use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::curve::Curve;
use meniscus_geometry::spec::{CurvedPolygon, Polygon, ShapeSpec};

/// A closed ring of segments and circular arcs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ring {
    /// x, y and the bulge of the edge that starts there (the tangent of a quarter of its signed angle); the first vertex is not repeated.
    pub vertices: Vec<[f64; 3]>,
}

/// Rules for the points covered by a set of rings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FillRule {
    /// Those from which a ray crosses an odd number of edges.
    #[default]
    EvenOdd,
    /// Those with a nonzero winding number.
    NonZero,
}

/// A filled shape of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub enum Outline {
    /// A circle, exact.
    Disc {
        /// Center.
        center: Vec2,
        /// Radius.
        radius: f64,
    },
    /// Rings in any order and orientation, filled together by one rule.
    Area {
        /// The rings.
        rings: Vec<Ring>,
        /// Which points are covered.
        rule: FillRule,
    },
}

/// Fill of a shape.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Paint {
    /// Any color except white: solid.
    #[default]
    Filled,
    /// A color on a larger shape of another color: solid, or a channel in a chip.
    Overlaid,
    /// White, in a drawing with other colors: pore where it covers others.
    White,
    /// None: a closed outline.
    Unfilled {
        /// Its layer; empty without one.
        layer: String,
    },
}

/// A filled shape and its source location.
#[derive(Debug, Clone, PartialEq)]
pub struct Entity {
    /// The shape.
    pub outline: Outline,
    /// Its fill.
    pub paint: Paint,
    /// Its source location for messages: `line 12`, `LWPOLYLINE 2F`, `feature 3`.
    pub location: String,
}

impl Entity {
    /// The box around it.
    pub(crate) fn bounds(&self) -> Bounds {
        match &self.outline {
            Outline::Disc { center, radius } => Bounds { min: *center, max: *center }.grown(*radius),
            Outline::Area { rings, .. } => {
                let all = rings.iter().map(Ring::bounds).reduce(|a, b| a.united(&b));
                all.unwrap_or(Bounds { min: Vec2::zeros(), max: Vec2::zeros() })
            }
        }
    }
}

/// A unit of length.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// Its name, as in `mm`.
    pub name: String,
    /// Its length in m.
    pub meters: f64,
}

/// Relation of the rings of a drawing to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Nesting {
    /// Nested rings of an entity are outer ones and holes alternately.
    #[default]
    Alternate,
    /// The same, and they must not cross.
    Apart,
    /// The first ring of an entity is the outer one, and all others are its holes.
    FirstIsOuter,
    /// They may cross: the rule of the entity determines the area that they cover.
    ByRule,
    /// Rings inside those of other entities are holes: there are no fills.
    OfAll,
}

/// All data read from a file.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// The filled shapes.
    pub entities: Vec<Entity>,
    /// The unit given in the file, if any.
    pub unit: Option<Unit>,
    /// Whether lengths are in m by default.
    pub is_in_meters: bool,
    /// The page or domain given in the file, if any.
    pub frame: Option<Bounds>,
    /// Whether the frame is a page, outside which shapes are invisible and ignored; outside a domain they are errors.
    pub has_page: bool,
    /// Relation of its rings to each other.
    pub nesting: Nesting,
    /// Whether it is made of pixels: its curves are arcs, and the options determine solid and pore.
    pub is_of_pixels: bool,
    /// The layers of the file with the number of entities on each, where the format has layers.
    pub layers: BTreeMap<String, usize>,
    /// Entities that were read but not used, by kind, with their number: text, hatches, open lines, other layers.
    pub unused: BTreeMap<String, usize>,
    /// Further notes for the user, one sentence each.
    pub notes: Vec<String>,
}

impl Drawing {
    /// Counts entities that are not used, by their kind.
    pub(crate) fn count(&mut self, kind: &str, number: usize) {
        *self.unused.entry(kind.to_owned()).or_default() += number;
    }

    /// Adds a filled shape.
    pub(crate) fn add(&mut self, outline: Outline, location: String) {
        self.entities.push(Entity { outline, paint: Paint::Filled, location });
    }
}

/// A part of a file that a reader rejects.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Its source location: `line 12`, `LWPOLYLINE 2F`, `pixel (3, 4)`.
    pub location: String,
    /// What was found there.
    pub found: String,
    /// What was expected instead, or a remedy.
    pub expected: String,
}

impl Refusal {
    /// A refusal with its three parts.
    pub(crate) fn new(location: impl Into<String>, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { location: location.into(), found: found.into(), expected: expected.into() }
    }
}

impl std::fmt::Display for Refusal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: found {}, expected {}", self.location, self.found, self.expected)
    }
}

/// The polygon of these rings, with the orientation required for polygons, and with arcs if it has any.
pub(crate) fn shape_of(outer: Ring, holes: Vec<Ring>) -> ShapeSpec {
    let turned = |ring: Ring, ccw: bool| if (ring.area() > 0.0) == ccw { ring } else { ring.reversed() };
    let outer = turned(outer, true);
    let holes: Vec<Ring> = holes.into_iter().map(|hole| turned(hole, false)).collect();
    let (position, rotation_deg) = ([0.0; 2], 0.0);
    if outer.is_straight() && holes.iter().all(Ring::is_straight) {
        let points = |ring: Ring| ring.vertices.into_iter().map(|[x, y, _]| [x, y]).collect();
        let holes = holes.into_iter().map(points).collect();
        return ShapeSpec::Polygon(Polygon { outer: points(outer), holes, position, rotation_deg });
    }
    let holes = holes.into_iter().map(|hole| hole.vertices).collect();
    ShapeSpec::CurvedPolygon(CurvedPolygon { outer: outer.vertices, holes, position, rotation_deg })
}

/// The start of a curve with its bulge; a circle, or an arc of more than three quarters of one, in two halves.
pub(crate) fn vertices(curve: &Curve) -> Vec<[f64; 3]> {
    const LARGE: f64 = 1.5 * std::f64::consts::PI;
    match curve {
        Curve::Arc { sweep, .. } if sweep.abs() > LARGE => {
            vec![curve.part(0.0, 0.5).vertex(), curve.part(0.5, 1.0).vertex()]
        }
        _ => vec![curve.vertex()],
    }
}

/// Quantities checked in tests of readers.
#[cfg(test)]
pub(super) mod seen {
    use super::*;

    /// The area without regard to overlaps: of rings that do not cross, each with its own sign.
    pub(crate) fn area(outline: &Outline) -> f64 {
        match outline {
            Outline::Disc { radius, .. } => std::f64::consts::PI * radius * radius,
            Outline::Area { rings, .. } => rings.iter().map(Ring::area).sum::<f64>().abs(),
        }
    }

    /// A rectangle by its lower left corner and its size.
    pub(crate) fn bar(x: f64, y: f64, width: f64, height: f64) -> Ring {
        let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
        Ring { vertices: corners.map(|[x, y]| [x, y, 0.0]).to_vec() }
    }

    /// Centers and radii of a drawing of discs.
    pub(crate) fn discs(drawing: &Drawing) -> Vec<(Vec2, f64)> {
        let disc = |outline: &Outline| match outline {
            Outline::Disc { center, radius } => (*center, *radius),
            other => panic!("{other:?}"),
        };
        drawing.entities.iter().map(|entity| disc(&entity.outline)).collect()
    }

    pub(crate) fn counts(of: &BTreeMap<String, usize>) -> Vec<(&str, usize)> {
        of.iter().map(|(name, number)| (name.as_str(), *number)).collect()
    }

    pub(crate) fn only(drawing: &Drawing) -> &Outline {
        assert_eq!(drawing.entities.len(), 1, "{drawing:?}");
        &drawing.entities[0].outline
    }
}
