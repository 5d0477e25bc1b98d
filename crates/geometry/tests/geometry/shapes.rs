//! Shapes and geometries that the tests share, and membership by the definition of each shape.

use std::f64::consts::PI;

use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{
    Capsule, CurvedPolygon, Disc, GeometrySpec, HalfPlane, Polygon, Rectangle, ShapeSpec, SolidSide, ThroatCosine,
    ThroatDiscs,
};
use proptest::prelude::*;

pub fn disc(x: f64, y: f64, radius: f64) -> ShapeSpec {
    ShapeSpec::Disc(Disc { center: [x, y], radius })
}

pub fn rectangle(center: [f64; 2], size: [f64; 2], rotation_deg: f64) -> ShapeSpec {
    ShapeSpec::Rectangle(Rectangle { center, size, rotation_deg })
}

pub fn polygon(outer: &[[f64; 2]], holes: &[&[[f64; 2]]]) -> ShapeSpec {
    let holes = holes.iter().map(|hole| hole.to_vec()).collect();
    ShapeSpec::Polygon(Polygon { outer: outer.to_vec(), holes, position: [0.0; 2], rotation_deg: 0.0 })
}

pub fn curved(outer: &[[f64; 3]], holes: &[&[[f64; 3]]]) -> ShapeSpec {
    let holes = holes.iter().map(|hole| hole.to_vec()).collect();
    ShapeSpec::CurvedPolygon(CurvedPolygon { outer: outer.to_vec(), holes, position: [0.0; 2], rotation_deg: 0.0 })
}

pub fn spec(shapes: Vec<ShapeSpec>, solid: SolidSide) -> GeometrySpec {
    GeometrySpec { min: [-2.0, -2.0], max: [2.0, 2.0], solid, shapes }
}

pub fn solid(shapes: Vec<ShapeSpec>) -> Geometry {
    Geometry::new(&spec(shapes, SolidSide::Inside)).unwrap()
}

pub fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// One of each shape, some of them overlapping.
pub fn zoo() -> Vec<ShapeSpec> {
    vec![
        ShapeSpec::HalfPlane(HalfPlane { point: [0.0, -1.6], rotation_deg: 5.0 }),
        disc(-1.0, -1.2, 0.45),
        rectangle([1.1, 1.1], [0.8, 0.5], 27.0),
        ShapeSpec::Capsule(Capsule { ends: [[0.6, 0.7], [1.2, 0.2]], radius: 0.15 }),
        polygon(
            &[[-1.5, 0.2], [-0.3, 0.1], [-0.5, 0.7], [-0.2, 1.5], [-1.4, 1.3]],
            &[&[[-1.2, 0.5], [-1.1, 1.0], [-0.7, 0.9], [-0.8, 0.4]]],
        ),
        ShapeSpec::ThroatDiscs(ThroatDiscs { center: [0.3, -0.7], radii: [0.3, 0.25], gap: 0.2, rotation_deg: 40.0 }),
        disc(-0.6, -1.1, 0.3),
        keyhole(),
    ]
}

/// A straight side, an arc of more than a half circle, one that bends inwards, and a round hole.
pub fn keyhole() -> ShapeSpec {
    let outer = [[1.25, -1.0, 0.0], [1.6, -1.0, 1.4], [1.6, -0.6, 0.2], [1.2, -0.55, -0.3]];
    let hole = [[1.5, -0.8, -1.0], [1.7, -0.8, -1.0]];
    let ShapeSpec::CurvedPolygon(shape) = curved(&outer, &[&hole]) else { unreachable!() };
    ShapeSpec::CurvedPolygon(CurvedPolygon { position: [0.05, 0.02], rotation_deg: -4.0, ..shape })
}

/// Membership by the definition of each shape, independent of the library.
pub fn is_in(shape: &ShapeSpec, x: Vec2) -> bool {
    let unit = |degrees: f64| v(degrees.to_radians().cos(), degrees.to_radians().sin());
    let across = |degrees: f64| v(-unit(degrees).y, unit(degrees).x);
    match shape {
        ShapeSpec::HalfPlane(s) => (x - Vec2::from(s.point)).dot(&across(s.rotation_deg)) < 0.0,
        ShapeSpec::Disc(s) => (x - Vec2::from(s.center)).norm() < s.radius,
        ShapeSpec::Rectangle(s) => {
            let d = x - Vec2::from(s.center);
            d.dot(&unit(s.rotation_deg)).abs() < 0.5 * s.size[0]
                && d.dot(&across(s.rotation_deg)).abs() < 0.5 * s.size[1]
        }
        ShapeSpec::Capsule(s) => {
            let (a, b) = (Vec2::from(s.ends[0]), Vec2::from(s.ends[1]));
            let u = ((x - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            (x - a - (b - a) * u).norm() < s.radius
        }
        ShapeSpec::Polygon(s) => {
            // Even-odd rule over all rings.
            let mut inside = false;
            for ring in std::iter::once(&s.outer).chain(&s.holes) {
                for (i, p) in ring.iter().enumerate() {
                    let q = ring[(i + 1) % ring.len()];
                    if (p[1] > x.y) != (q[1] > x.y) && x.x < p[0] + (x.y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) {
                        inside = !inside;
                    }
                }
            }
            inside
        }
        ShapeSpec::CurvedPolygon(s) => {
            let d = x - Vec2::from(s.position);
            let d = v(d.dot(&unit(s.rotation_deg)), d.dot(&across(s.rotation_deg)));
            std::iter::once(&s.outer).chain(&s.holes).filter(|ring| is_in_bulged(ring, d)).count() % 2 == 1
        }
        // Read as the discs that they stand for.
        ShapeSpec::RandomPack(_) | ShapeSpec::Array(_) => false,
        ShapeSpec::Channel(s) => (x - Vec2::from(s.center)).dot(&across(s.rotation_deg)).abs() > 0.5 * s.width,
        ShapeSpec::ThroatDiscs(s) => [(-1.0, s.radii[0]), (1.0, s.radii[1])].iter().any(|(side, r)| {
            (x - Vec2::from(s.center) - across(s.rotation_deg) * (side * (0.5 * s.gap + r))).norm() < *r
        }),
        ShapeSpec::ThroatCosine(s) => {
            let d = x - Vec2::from(s.center);
            let (along, high) = (d.dot(&unit(s.rotation_deg)), d.dot(&across(s.rotation_deg)));
            high.abs() > cosine_half_width(s, along)
        }
    }
}

/// Even-odd rule over the chords, turned where the point lies between a chord and its arc.
fn is_in_bulged(ring: &[[f64; 3]], x: Vec2) -> bool {
    let mut inside = false;
    for (i, &[px, py, bulge]) in ring.iter().enumerate() {
        let (p, q) = (v(px, py), Vec2::new(ring[(i + 1) % ring.len()][0], ring[(i + 1) % ring.len()][1]));
        if (p.y > x.y) != (q.y > x.y) && x.x < p.x + (x.y - p.y) / (q.y - p.y) * (q.x - p.x) {
            inside = !inside;
        }
        if bulge != 0.0 {
            // The arc passes at bulge times half the chord beside its middle, on the right of the chord where the bulge is above 0.
            let (chord, right) = (q - p, v(q.y - p.y, p.x - q.x));
            let center = 0.5 * (p + q) + right * (0.25 * (bulge - 1.0 / bulge));
            let radius = (p - center).norm();
            let is_beyond_chord = (x - p).dot(&right) * bulge > 0.0;
            if is_beyond_chord && chord.norm() > 0.0 && (x - center).norm() < radius {
                inside = !inside;
            }
        }
    }
    inside
}

pub fn cosine_half_width(s: &ThroatCosine, along: f64) -> f64 {
    let narrowing = if along.abs() < 0.5 * s.length { 0.5 * (1.0 + (2.0 * PI * along / s.length).cos()) } else { 0.0 };
    0.5 * (s.width - (s.width - s.throat) * narrowing)
}

pub fn cosine() -> ThroatCosine {
    ThroatCosine { center: [0.2, -0.1], width: 1.6, throat: 0.4, length: 2.5, rotation_deg: 27.0 }
}

pub fn point() -> impl Strategy<Value = Vec2> {
    (-2.2..2.2_f64, -2.2..2.2_f64).prop_map(|(x, y)| v(x, y))
}

pub fn outside() -> Geometry {
    Geometry::new(&spec(zoo(), SolidSide::Outside)).unwrap()
}
