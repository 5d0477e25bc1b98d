//! Shapes and geometries that the tests share, and membership by the definition of each shape.

use std::f64::consts::PI;

use meniscus::geometry::Geometry;
use meniscus::geometry::spec::{
    Capsule, Disc, GeometrySpec, HalfPlane, Polygon, Rectangle, ShapeSpec, SolidSide, ThroatCosine, ThroatDiscs,
};
use meniscus::math::Vec2;
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
    ]
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
