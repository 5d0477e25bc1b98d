//! Unions of polygons whose coordinates are rounded have the area of inclusion and exclusion, whose intersections of convex polygons are found by clipping
//! (Sutherland, Hodgman 1974), without our unions.
//!
//! `MENISCUS_UNIONS=10000 cargo test --release --test drawings unions -- --nocapture` tries so many.

use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use meniscus_geometry::Geometry;
use rayon::prelude::*;

/// Drawings in CI.
const FEW: u64 = 300;
/// Side of the box.
const SIDE: f64 = 30.0;
/// Corners of different shapes within this share of the drawing are joined.
const WELD: f64 = 2e-7;

type Ring = Vec<[f64; 2]>;

/// Convex polygons: a turned block, and bars that are flush with one of its sides or with each other, in part or in whole, or overlap it.
fn drawing(number: u64) -> Vec<Ring> {
    let mut state = number.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let digits = 10.0_f64.powi(4 + (number % 5) as i32);
    let (sin, cos) = (6.3 * random()).sin_cos();
    let place = |along: [f64; 2], up: [f64; 2]| -> Ring {
        let corners = [[along[0], up[0]], [along[1], up[0]], [along[1], up[1]], [along[0], up[1]]];
        let rounded = |x: f64| (x * digits).round() / digits;
        corners.map(|[x, y]| [rounded(15.0 + cos * x - sin * y), rounded(15.0 + sin * x + cos * y)]).to_vec()
    };
    let (width, height) = (2.0 + 3.0 * random(), 1.0 + 2.0 * random());
    let mut rings = vec![place([-width, width], [-height, 0.0])];
    let count = 1 + (3.0 * random()) as usize;
    let mut left = -width * random();
    for _ in 0..count {
        let right = left + 0.3 + 2.0 * random();
        let sunk = if random() < 0.3 { -0.5 * height } else { 0.0 };
        rings.push(place([left, right], [sunk, 0.5 + 3.0 * random()]));
        left = if random() < 0.5 { right } else { right + 0.2 + random() };
    }
    rings
}

/// Twice the signed area.
fn twice_area(ring: &Ring) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| (a[0] - SIDE) * (b[1] - SIDE) - (a[1] - SIDE) * (b[0] - SIDE)).sum()
}

/// The part of a convex polygon in another one, both counter-clockwise.
fn clipped(ring: &Ring, by: &Ring) -> Ring {
    let mut left = ring.clone();
    for (a, b) in by.iter().zip(by.iter().cycle().skip(1)) {
        let side = |p: &[f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
        let mut kept = Vec::new();
        for (p, q) in left.iter().zip(left.iter().cycle().skip(1)) {
            let (from, to) = (side(p), side(q));
            if from >= 0.0 {
                kept.push(*p);
            }
            if (from >= 0.0) != (to >= 0.0) {
                let share = from / (from - to);
                kept.push([0, 1].map(|i| p[i] + share * (q[i] - p[i])));
            }
        }
        left = kept;
    }
    left
}

fn area_of_union(rings: &[Ring]) -> f64 {
    (1..1_usize << rings.len())
        .map(|some| {
            let chosen: Vec<&Ring> = (0..rings.len()).filter(|k| some >> k & 1 == 1).map(|k| &rings[k]).collect();
            let common = chosen[1..].iter().fold(chosen[0].clone(), |common, ring| clipped(&common, ring));
            let sign = if chosen.len() % 2 == 1 { 0.5 } else { -0.5 };
            sign * twice_area(&common)
        })
        .sum()
}

fn perimeter(rings: &[Ring]) -> f64 {
    let of = |ring: &Ring| -> f64 {
        ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).sum()
    };
    rings.iter().map(of).sum()
}

fn difference(number: u64) -> Option<String> {
    let rings = drawing(number);
    let mut text = format!("# domain 0 0 {SIDE} {SIDE}\n");
    for ring in &rings {
        let corners = ring.iter().chain(&ring[..1]).map(|[x, y]| format!("{x} {y}")).collect::<Vec<_>>();
        text += &format!("POLYGON (({}))\n", corners.join(", "));
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("union.wkt");
    std::fs::write(&file, &text).unwrap();
    let read = match load(&file, &Options::default()) {
        Ok(read) => read,
        Err(error) => return Some(format!("{number}: {error}\n{text}")),
    };
    let found = SIDE * SIDE * (1.0 - Geometry::new(&read.spec).unwrap().porosity().value);
    let right = area_of_union(&rings);
    // Corners that are joined move by up to this.
    let moves = read.notes.iter().any(|note| note.starts_with("joined"));
    let slack = if moves { WELD * SIDE * perimeter(&rings) } else { 1e-9 * right };
    ((found - right).abs() > slack).then(|| format!("{number}: {found} for {right}, moved: {moves}\n{text}"))
}

#[test]
fn unions_of_rounded_polygons_have_the_area_of_inclusion_and_exclusion() {
    let count = std::env::var("MENISCUS_UNIONS").ok().and_then(|count| count.parse().ok()).unwrap_or(FEW);
    let found: Vec<String> = (0..count).into_par_iter().filter_map(difference).collect();
    println!("{count} unions, {} failed", found.len());
    assert!(found.is_empty(), "{}", found[..found.len().min(5)].join("\n"));
}
