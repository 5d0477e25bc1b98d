//! Packs of discs and rough rings: from shapes to a geometry, to its porosity, and a million distances.
//!
//! `cargo bench --bench geometry` prints seconds and how they grow with the number of pieces, on one thread, then criterion's statistics. With
//! `-- --table` the table alone. Work that grows as n log n takes 10 to 13 times as long for ten times as many pieces.

#[path = "../../../benches/support/table.rs"]
mod table;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use criterion::Criterion;
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{CurvedPolygon, Disc, GeometrySpec, Polygon, ShapeSpec, SolidSide};

/// Distances asked for in the last column of the table.
const DISTANCES: usize = 100_000;

/// A number from 0 to 1 that looks random; the same for the same `k`.
fn scattered(k: usize) -> f64 {
    (k as f64 * 0.618_033_988_749_895).fract()
}

/// Discs of 25 to 45 µm radius, one in each square of 100 µm, some of them touching the next square's disc.
fn discs(count: usize) -> GeometrySpec {
    const CELL: f64 = 1e-4;
    let side = (count as f64).sqrt().ceil() as usize;
    let disc = |k: usize| {
        let radius = CELL * (0.25 + 0.2 * scattered(k));
        let at =
            |i: usize, seed: usize| CELL * (i as f64 + 0.5) + (0.55 * CELL - radius) * (2.0 * scattered(seed) - 1.0);
        ShapeSpec::Disc(Disc { center: [at(k % side, 3 * k + 1), at(k / side, 7 * k + 2)], radius })
    };
    let size = CELL * side as f64;
    let shapes = (0..count).map(disc).collect();
    GeometrySpec { min: [0.0; 2], max: [size; 2], solid: SolidSide::Inside, shapes }
}

/// Points of a rough ring of about 1 mm radius.
fn outline(count: usize) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(move |k| {
        let angle = TAU * k as f64 / count as f64;
        let waves: f64 = (1..20).map(|n| (f64::from(n) * 7.0 * angle + f64::from(n * n)).sin() / f64::from(n)).sum();
        let radius = 1e-3 * (1.0 + 0.1 * waves + 1e-4 * scattered(k));
        [radius * angle.cos(), radius * angle.sin()]
    })
}

fn in_a_box(shape: ShapeSpec) -> GeometrySpec {
    GeometrySpec { min: [-2e-3; 2], max: [2e-3; 2], solid: SolidSide::Inside, shapes: vec![shape] }
}

fn ring(count: usize) -> GeometrySpec {
    in_a_box(ShapeSpec::Polygon(Polygon {
        outer: outline(count).collect(),
        holes: Vec::new(),
        position: [0.0; 2],
        rotation_deg: 0.0,
    }))
}

/// The same ring with every third edge an arc.
fn curved_ring(count: usize) -> GeometrySpec {
    let bulged = |(k, [x, y]): (usize, [f64; 2])| [x, y, if k % 3 == 0 { 0.05 } else { 0.0 }];
    in_a_box(ShapeSpec::CurvedPolygon(CurvedPolygon {
        outer: outline(count).enumerate().map(bulged).collect(),
        holes: Vec::new(),
        position: [0.0; 2],
        rotation_deg: 0.0,
    }))
}

/// Makes the shapes of so many discs or vertices.
type Shapes = fn(usize) -> GeometrySpec;

const SHAPES: [(&str, Shapes, &[usize]); 3] = [
    ("discs", discs, &[1_000, 10_000, 100_000]),
    ("ring", ring, &[10_000, 100_000]),
    ("curved ring", curved_ring, &[10_000, 100_000]),
];

fn seconds<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = work();
    (start.elapsed().as_secs_f64(), result)
}

fn print_table() {
    println!("seconds on one thread; checks included in `built`\n");
    println!(
        "{:<12} {:>8} {:>9} {:>9} {:>9} {:>9} {:>13}",
        "shapes", "count", "built", "periodic", "porosity", "surface", "1e5 distances"
    );
    for (name, shapes, counts) in SHAPES {
        for &count in counts {
            let spec = shapes(count);
            let (built, geometry) = seconds(|| Geometry::new(&spec).expect("sound shapes"));
            let (porosity, _) = seconds(|| black_box(geometry.porosity()));
            let (surface, _) = seconds(|| black_box(geometry.specific_surface()));
            let (low, size) = (geometry.bounds().min, geometry.bounds().size());
            let (distances, _) = seconds(|| {
                let place = |k: usize| low + size.component_mul(&Vec2::new(scattered(k), scattered(5 * k + 3)));
                (0..DISTANCES).map(|k| geometry.signed_distance(place(k))).sum::<f64>()
            });
            let (periodic, _) = seconds(|| geometry.with_periodic([true; 2]));
            println!(
                "{name:<12} {count:>8} {built:>9.3} {periodic:>9.3} {porosity:>9.4} {surface:>9.4} {distances:>13.3}"
            );
        }
    }
    println!();
}

fn statistics(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("geometry");
    group.sample_size(10);
    for (name, shapes, counts) in SHAPES {
        for &count in &counts[..counts.len() - 1] {
            let spec = shapes(count);
            group.bench_function(format!("{name}-{count}"), |bencher| {
                bencher.iter(|| Geometry::new(black_box(&spec)).expect("sound shapes").porosity());
            });
        }
    }
    group.finish();
}

fn main() {
    table::table_then_statistics(print_table, statistics);
}
