//! The solid as closed outlines of segments and arcs, independent of the format.

use crate::import::drawing::{FillRule, Outline, Ring, vertices};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::body::Body;
use meniscus_geometry::boundary::{Piece, chains, clip_body, followers};
use meniscus_geometry::curve::Curve;
use meniscus_geometry::solid::Geometry;
use meniscus_geometry::spec::{GeometrySpec, SolidSide};

/// Outlines of the solid in m; those of different shapes may overlap.
#[derive(Debug, Clone)]
pub(crate) struct Sheet {
    /// The outlines in the order of the shapes.
    pub(crate) outlines: Vec<Outline>,
    /// The domain.
    pub(crate) frame: Bounds,
}

/// Ends of curves closer than this fraction of the domain's larger side are joined.
const JOINED: f64 = 1e-8;

impl Sheet {
    /// The outlines of a specification without problems.
    pub(crate) fn of(spec: &GeometrySpec) -> Self {
        let frame = Bounds { min: Vec2::from(spec.min), max: Vec2::from(spec.max) };
        let tolerance = JOINED * frame.size().max();
        let outlines = match spec.solid {
            SolidSide::Outside => {
                let rings = rings(&Geometry::unchecked(spec).solid_outline(), tolerance);
                if rings.is_empty() { Vec::new() } else { vec![Outline::Area { rings, rule: FillRule::EvenOdd }] }
            }
            SolidSide::Inside => {
                let paper = frame.grown(0.5 * frame.size().max());
                let bodies = spec.shapes.iter().zip(0..).flat_map(|(shape, i)| Body::of(shape, i, frame));
                bodies.filter_map(|body| outline(&body, paper, tolerance)).collect()
            }
        };
        Self { outlines, frame }
    }
}

fn outline(body: &Body, paper: Bounds, tolerance: f64) -> Option<Outline> {
    if let [Curve::Arc { center, radius, .. }] = body.curves[..]
        && body.curves[0].is_closed()
    {
        return Some(Outline::Disc { center, radius });
    }
    let rings = if body.is_endless() {
        rings(&clip_body(body, paper, 0.1 * tolerance).curves, tolerance)
    } else {
        rings(&body.curves, tolerance)
    };
    (!rings.is_empty()).then_some(Outline::Area { rings, rule: FillRule::EvenOdd })
}

/// Closed chains of curves as rings of vertices with bulges.
fn rings(curves: &[Curve], tolerance: f64) -> Vec<Ring> {
    let pieces: Vec<Piece> = curves.iter().map(|&curve| Piece { curve, shape: 0 }).collect();
    let next = followers(&pieces, tolerance);
    let chains = chains(&pieces, &next).into_iter().filter(|(_, is_closed)| *is_closed);
    chains.map(|(chain, _)| Ring { vertices: chain.iter().flat_map(|&i| vertices(&curves[i])).collect() }).collect()
}

/// The edges of a ring.
pub(super) fn edges(ring: &Ring) -> impl Iterator<Item = Curve> + '_ {
    meniscus_geometry::body::bulged_ring(&ring.vertices)
}

/// The points of a ring, with arcs approximated by chords within `error` times their radius.
pub(super) fn sampled(ring: &Ring, error: f64) -> Vec<Vec2> {
    let step = 2.0 * (1.0 - error).acos();
    let count = |curve: &Curve| match curve {
        Curve::Segment { .. } => 1,
        Curve::Arc { sweep, .. } => (sweep.abs() / step).ceil().max(1.0) as usize,
    };
    edges(ring)
        .flat_map(|curve| (0..count(&curve)).map(move |k| curve.point(k as f64 / count(&curve) as f64)))
        .collect()
}

/// The rings of an outline; a disc as two half circles.
pub(super) fn rings_of(outline: &Outline) -> Vec<Ring> {
    match outline {
        Outline::Disc { center, radius } => {
            let vertices = vec![[center.x + radius, center.y, 1.0], [center.x - radius, center.y, 1.0]];
            vec![Ring { vertices }]
        }
        Outline::Area { rings, .. } => rings.clone(),
    }
}
