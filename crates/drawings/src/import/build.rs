//! From a drawing to shapes in m: unit, repairs, fills and holes, recognition of circles and arcs, domain, and notes on all of these.

use std::collections::BTreeMap;

use crate::import::drawing::{Drawing, Entity, FillRule, Nesting, Outline, Refusal, Ring, shape_of};
use crate::import::fill::{filled, without_slits};
use crate::import::format::Format;
use crate::import::frame::{self, Framed};
use crate::import::nest::{self, Region, circle, nested, regions};
use crate::import::notes::{Counts, Notes};
use crate::import::options::Options;
use crate::import::paint::{Painted, solids};
use crate::import::rings::{DOUBLED, bounds_of_points};
use crate::import::{overlap, recognize, smooth, window};
use meniscus_core::input::problem::Problem;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::body::bulged_ring;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::rings::{RingFault, crossing, faults};
use meniscus_geometry::spec::{Disc, GeometrySpec, ShapeSpec, SolidSide};
use meniscus_geometry::weld::weld;

/// Default margin around the shapes over the longer side of their bounding box: fluid can pass between the shapes and the sides.
const MARGIN: f64 = 0.1;

/// Largest length of a drawing in m: that of the largest domain.
const LARGEST: f64 = 1e15;

/// Shapes read from a drawing, with notes for the user.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// Domain and shapes in m.
    pub spec: GeometrySpec,
    /// Distance between floor and lid in m, if given: only our own shape files can.
    pub depth: Option<f64>,
    /// One sentence each: unit, what was read, recognized, repaired, ignored.
    pub notes: Vec<String>,
}

/// Why a drawing cannot be converted to shapes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refused {
    /// Keys besides the file are missing or invalid; the paths of the problems are keys, such as `unit`.
    #[error("{}", join(.0))]
    Keys(Vec<Problem>),
    /// Parts of the file cannot be read: all of them, in order.
    #[error("{} mistake(s)\n{}", .0.len(), join(.0))]
    Parts(Vec<Refusal>),
    /// Every part can be read, but the shapes are invalid; paths are source locations in the file.
    #[error("{} problem(s)\n{}", .0.len(), join(.0))]
    Shapes(Vec<Problem>),
}

fn join<T: ToString>(items: &[T]) -> String {
    items.iter().map(|item| format!("  {}", item.to_string())).collect::<Vec<_>>().join("\n")
}

/// A shape and its source location.
struct Placed {
    shape: ShapeSpec,
    location: String,
}

/// What else a drawing says, in m.
pub(super) struct Sheet {
    frame: Option<Bounds>,
    has_page: bool,
    pub(super) nesting: Nesting,
    is_of_pixels: bool,
    pub(super) layers: BTreeMap<String, usize>,
}

/// The outlines of a drawing in m, what else it says, notes, and parts that are refused.
pub(super) type Prepared = (Vec<Entity>, Sheet, Notes, Vec<Refusal>);

/// The outlines of a drawing in m, repaired and welded.
pub(super) fn prepared(drawing: Drawing, format: Format, options: &Options) -> Result<Prepared, Refused> {
    let (scale, unit) = options.length_of_unit(&drawing, format).map_err(|p| Refused::Keys(vec![p]))?;
    let mut notes = Notes::new(unit, &drawing);
    let Drawing { has_page, nesting, is_of_pixels, layers, .. } = drawing;
    let frame = drawing.frame.map(|frame| Bounds { min: frame.min * scale, max: frame.max * scale });
    let sheet = Sheet { frame, has_page, nesting, is_of_pixels, layers };
    let mut refusals = Vec::new();
    let mut outlines = cleaned(drawing.entities, scale, &mut notes.counts, &mut refusals);
    let around = outlines.iter().map(Entity::bounds).reduce(|a, b| a.united(&b));
    let size = around.map_or(0.0, |around| domain(around, frame, options).0.size().max());
    joined(&mut outlines, size, &mut notes.counts);
    Ok((outlines, sheet, notes, refusals))
}

/// The shapes of the outlines without the frame.
pub(super) fn completed(
    outlines: Vec<Entity>,
    (Framed { domain: framed, chamber, .. }, nesting): (Framed, Nesting),
    sheet: &Sheet,
    options: &Options,
    mut notes: Notes,
    mut refusals: Vec<Refusal>,
) -> Result<Imported, Refused> {
    let frame = sheet.frame.or(framed);
    let mut shapes = Vec::new();
    let mut regions = grouped(outlines, nesting, &mut notes, &mut refusals);
    if let Some((ring, location)) = chamber {
        let (domain, _) = domain(ring.bounds(), frame, options);
        match frame::around_chamber(&ring, domain) {
            Some(solid) => regions.extend(solid.into_iter().map(|region| (region, location.clone()))),
            None => {
                let expected = "an outline that does not cross itself".to_owned();
                refusals.push(Refusal { location, found: "the wall of the pore".into(), expected });
            }
        }
    }
    let sound = regions
        .into_iter()
        .flat_map(|(region, location)| without_slits(region).into_iter().map(move |one| (one, location.clone())));
    for (region, location) in sound {
        shapes.push(Placed { shape: recognized(region, sheet.is_of_pixels, options, &mut notes.counts), location });
    }
    if !refusals.is_empty() {
        return Err(Refused::Parts(refusals));
    }
    if shapes.is_empty() {
        let found = "no outline that encloses an area".to_owned();
        let expected = "closed shapes; what was read and not used: ".to_owned() + &notes.unused();
        return Err(Refused::Parts(vec![Refusal { location: "file".into(), found, expected }]));
    }
    let around = bounds_of_points(shapes.iter().flat_map(|placed| corners_of(&placed.shape)));
    let (domain, from) = domain(around, frame, options);
    notes.domain(domain, from);
    if options.window.is_some() || (frame.is_some() && sheet.has_page) {
        let before = shapes.len();
        shapes.retain(|placed| window::reaches(&placed.shape, domain));
        notes.counts.outside = before - shapes.len();
        if shapes.is_empty() {
            return Err(Refused::Keys(vec![nothing_within(domain, around)]));
        }
    }
    notes.counts.shapes(shapes.iter().map(|placed| &placed.shape));
    let (locations, shapes): (Vec<_>, Vec<_>) = shapes.into_iter().map(|one| (one.location, one.shape)).unzip();
    let solid = if options.is_inverted() && !sheet.is_of_pixels { SolidSide::Outside } else { SolidSide::Inside };
    let spec = GeometrySpec { min: domain.min.into(), max: domain.max.into(), solid, shapes };
    let problems = spec.problems();
    if problems.is_empty() {
        Ok(Imported { spec, depth: None, notes: notes.lines(options) })
    } else {
        Err(Refused::Shapes(problems.into_iter().map(|problem| placed(problem, &locations)).collect()))
    }
}

/// A shape file of ours clipped to the window of the options, with solid and pore exchanged if they ask for it.
///
/// # Errors
/// Problems of the keys `window` and `invert`.
pub fn windowed(mut spec: GeometrySpec, options: &Options) -> Result<Imported, Vec<Problem>> {
    let mut notes = Vec::new();
    if options.is_inverted() {
        spec.solid = if spec.solid == SolidSide::Inside { SolidSide::Outside } else { SolidSide::Inside };
    }
    if let Some([min, max]) = options.window {
        (spec.min, spec.max) = (min, max);
        let window = Bounds { min: min.into(), max: max.into() };
        let before = spec.shapes.len();
        spec.shapes.retain(|shape| window::reaches(shape, window));
        notes.push(format!("outside of the window: shapes ({})", before - spec.shapes.len()));
    }
    let key = if options.window.is_some() { "window" } else { "invert" };
    let problems = if options.window.is_some() || options.is_inverted() { spec.problems() } else { Vec::new() };
    if problems.is_empty() {
        return Ok(Imported { spec, depth: None, notes });
    }
    Err(problems.into_iter().map(|problem| Problem { path: key.into(), ..problem }).collect())
}

/// The problem with the source location prepended to its path.
fn placed(problem: Problem, locations: &[String]) -> Problem {
    let index = problem.path.strip_prefix("shapes[").and_then(|rest| rest.split(']').next()?.parse::<usize>().ok());
    match index.and_then(|index| locations.get(index)) {
        // The index counts internal shapes, which are not visible to the user.
        Some(location) => {
            let keys = problem.path.split_once("].").map_or("", |(_, keys)| keys);
            Problem { path: format!("{location}, {keys}"), ..problem }
        }
        None => problem,
    }
}

/// The outlines in m, without duplicate vertices and without rings of zero area.
fn cleaned(entities: Vec<Entity>, scale: f64, counts: &mut Counts, refusals: &mut Vec<Refusal>) -> Vec<Entity> {
    let corner = |entity: &Entity| -> Vec<Vec2> {
        match &entity.outline {
            Outline::Disc { center, radius } => vec![center.add_scalar(-radius), center.add_scalar(*radius)],
            Outline::Area { rings, .. } => {
                rings.iter().flat_map(|ring| ring.vertices.iter().map(|v| Vec2::new(v[0], v[1]))).collect()
            }
        }
    };
    let size = scale * bounds_of_points(entities.iter().flat_map(corner)).size().max();
    let tolerance = DOUBLED * size;
    let mut found = Vec::with_capacity(entities.len());
    for Entity { outline, paint, location } in entities {
        // The bulge of a vertex is not a length.
        let lengths: Vec<f64> = match &outline {
            Outline::Disc { center, radius } => vec![center.x, center.y, *radius],
            Outline::Area { rings, .. } => {
                rings.iter().flat_map(|ring| ring.vertices.iter().flat_map(|v| [v[0], v[1]])).collect()
            }
        };
        if let Some(length) = lengths.iter().map(|length| length * scale).find(|m| !(m.abs() <= LARGEST)) {
            let expected = format!("lengths of at most {LARGEST:e} m; is the unit of the file right?");
            refusals.push(Refusal { location, found: format!("a length of {length:e} m"), expected });
            continue;
        }
        match outline {
            Outline::Disc { radius, .. } if !(radius * scale > tolerance) => {
                let found = format!("a disc of radius {radius:e}");
                refusals.push(Refusal { location, found, expected: "a radius above 0".into() });
            }
            Outline::Disc { center, radius } => {
                let outline = Outline::Disc { center: center * scale, radius: radius * scale };
                found.push(Entity { outline, paint, location });
            }
            Outline::Area { rings, rule } => {
                let mut kept = Vec::with_capacity(rings.len());
                for ring in rings {
                    let (ring, doubled) = ring.scaled(scale).without_doubled(tolerance);
                    counts.doubled += doubled;
                    if ring.width() > tolerance {
                        kept.push(ring);
                    } else {
                        counts.without_area += 1;
                    }
                }
                if !kept.is_empty() {
                    found.push(Entity { outline: Outline::Area { rings: kept, rule }, paint, location });
                }
            }
        }
    }
    found
}

/// Makes nearly coincident corners and edges of different outlines coincide; `size` is that of the domain in m.
fn joined(entities: &mut [Entity], size: f64, counts: &mut Counts) {
    let rings_of = |entity: &Entity| match &entity.outline {
        Outline::Disc { .. } => Vec::new(),
        Outline::Area { rings, .. } => rings.iter().map(|ring| ring.vertices.clone()).collect(),
    };
    let all: Vec<Vec<Vec<[f64; 3]>>> = entities.iter().map(rings_of).collect();
    let (changed, count) = weld(&all, size);
    for (index, changed) in changed {
        if let Outline::Area { rings, .. } = &mut entities[index].outline {
            *rings = changed.into_iter().map(|vertices| Ring { vertices }).collect();
        }
    }
    counts.welded = count;
}

/// The regions filled by the outlines: of each entity separately, in painting order, or of all together in formats without fills.
fn grouped(
    entities: Vec<Entity>,
    nesting: Nesting,
    notes: &mut Notes,
    refusals: &mut Vec<Refusal>,
) -> Vec<(Region, String)> {
    if nesting == Nesting::OfAll {
        return nested_entities(entities, notes, refusals);
    }
    let mut found = Vec::with_capacity(entities.len());
    for Entity { outline, paint, location } in entities {
        match regions_of(outline, nesting) {
            Ok(regions) => found.push(Painted { regions, paint, location }),
            Err((found, expected)) => refusals.push(Refusal::new(location, found, expected)),
        }
    }
    solids(found, notes, refusals)
}

/// The regions of one outline; on failure what was found, and what was expected.
fn regions_of(outline: Outline, nesting: Nesting) -> Result<Vec<Region>, (String, &'static str)> {
    let (rings, rule) = match outline {
        Outline::Disc { center, radius } => return Ok(vec![(circle(center, radius), Vec::new())]),
        Outline::Area { rings, rule } => (rings, rule),
    };
    let (fault, expected) = match nesting {
        Nesting::ByRule => {
            let size = bounds_of_points(rings.iter().flat_map(|r| [r.bounds().min, r.bounds().max])).size().max();
            return filled(&rings, rule, DOUBLED * size)
                .map_err(|found| (found, "outlines that do not cross: unite or subtract them in the drawing program"));
        }
        _ if rings.len() == 1 => return Ok(rings.into_iter().map(|ring| (ring, Vec::new())).collect()),
        Nesting::FirstIsOuter => (
            outside(&rings).map(|fault| fault.to_string()),
            "holes within the first ring of their polygon, which is its outer one; rings beside it are polygons of their own",
        ),
        Nesting::Apart => (
            crossing_rings(&rings),
            "rings beside or within each other: unite or subtract them, or give each a record of its own, where they are united",
        ),
        Nesting::Alternate | Nesting::OfAll => (None, ""),
    };
    fault.map_or_else(|| Ok(regions(&rings, FillRule::EvenOdd)), |found| Err((found, expected)))
}

/// A hole that is not inside the first ring, or coincides with it along a line.
fn outside(rings: &[Ring]) -> Option<RingFault> {
    let turned = |(k, ring): (usize, &Ring)| {
        let ring = if (ring.area() > 0.0) == (k == 0) { ring.clone() } else { ring.reversed() };
        bulged_ring(&ring.vertices).collect()
    };
    let curves: Vec<Vec<Curve>> = rings.iter().enumerate().map(turned).collect();
    faults(&curves)
        .into_iter()
        .find(|fault| matches!(fault, RingFault::NotContained { .. } | RingFault::OnALine { .. }))
}

/// Two rings that cross, as text, with indices from 0.
fn crossing_rings(rings: &[Ring]) -> Option<String> {
    let curves: Vec<Vec<Curve>> = rings.iter().map(|ring| bulged_ring(&ring.vertices).collect()).collect();
    let ([one, other], at) = crossing(&curves)?;
    Some(format!("rings {one} and {other} that cross at ({:e}, {:e}) m", at.x, at.y))
}

/// All rings of a drawing without fills: those inside others are holes, those inside holes islands.
fn nested_entities(entities: Vec<Entity>, notes: &mut Notes, refusals: &mut Vec<Refusal>) -> Vec<(Region, String)> {
    let mut all = Vec::new();
    for Entity { outline, location, .. } in entities {
        let own = match outline {
            Outline::Disc { center, radius } => vec![circle(center, radius)],
            Outline::Area { rings, .. } => rings,
        };
        all.extend(own.into_iter().map(|ring| (ring, location.clone())));
    }
    let (rings, locations): (Vec<Ring>, Vec<String>) = overlap::resolved(all, notes, refusals).into_iter().unzip();
    let all = nested(&rings, FillRule::EvenOdd);
    let region = |nested: nest::Nested| {
        let holes = nested.holes.iter().map(|&i| rings[i].clone()).collect();
        ((rings[nested.outer].clone(), holes), locations[nested.outer].clone())
    };
    all.into_iter().map(region).collect()
}

/// The shape of a region: circles behind polygons and arcs behind runs of vertices are recognized if the options ask for it.
fn recognized((outer, holes): Region, is_of_pixels: bool, options: &Options, counts: &mut Counts) -> ShapeSpec {
    let is_exact_circle = |ring: &Ring| ring.vertices.len() == 2;
    let find = |ring: &Ring, counts: &mut Counts| -> Option<(Vec2, f64)> {
        if !(options.recognize_circles.unwrap_or(true) || is_exact_circle(ring)) {
            return None;
        }
        let found = recognize::circle(ring)?;
        counts.recognized += usize::from(!is_exact_circle(ring));
        Some(found)
    };
    if holes.is_empty()
        && let Some((center, radius)) = find(&outer, counts)
    {
        return ShapeSpec::Disc(Disc { center: center.into(), radius });
    }
    let mut refine = |ring: Ring| {
        if let Some((center, radius)) = find(&ring, counts) {
            return circle(center, radius);
        }
        let below = options.smooth_below();
        if is_of_pixels || !(below > 0.0) {
            return ring;
        }
        match smooth::smoothed(&ring, below) {
            Some(smoothed) => {
                counts.smooth(ring.area(), smoothed.area());
                smoothed
            }
            None => ring,
        }
    };
    let outer = refine(outer);
    let holes = holes.into_iter().map(refine).collect();
    shape_of(outer, holes)
}

/// The problem of a window outside the drawing.
fn nothing_within(domain: Bounds, around: Bounds) -> Problem {
    let span = |b: Bounds| format!("({:e}, {:e}) to ({:e}, {:e}) m", b.min.x, b.min.y, b.max.x, b.max.y);
    let message = format!("no shape reaches into the domain, {}; the shapes span {}", span(domain), span(around));
    Problem::new("window", message, "move the window, or check `unit` or `scale`")
}

/// The domain and its origin.
fn domain(around: Bounds, frame: Option<Bounds>, options: &Options) -> (Bounds, &'static str) {
    if let Some([min, max]) = options.window {
        return (Bounds { min: min.into(), max: max.into() }, "the window");
    }
    if let Some(frame) = frame {
        return (frame, "the domain of the file");
    }
    (around.grown(MARGIN * around.size().max()), "the box around the shapes with a margin of a tenth")
}

/// Corners of the bounding box of a shape of a drawing.
fn corners_of(shape: &ShapeSpec) -> Vec<Vec2> {
    let ring = |vertices: &[[f64; 3]]| {
        let bounds = Ring { vertices: vertices.to_vec() }.bounds();
        vec![bounds.min, bounds.max]
    };
    match shape {
        ShapeSpec::Disc(disc) => {
            let center = Vec2::from(disc.center);
            vec![center.add_scalar(-disc.radius), center.add_scalar(disc.radius)]
        }
        ShapeSpec::Polygon(polygon) => polygon.outer.iter().map(|&p| Vec2::from(p)).collect(),
        ShapeSpec::CurvedPolygon(polygon) => ring(&polygon.outer),
        _ => Vec::new(),
    }
}
