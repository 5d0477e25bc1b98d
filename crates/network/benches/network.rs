//! How long it takes to extract a network: random packs of discs, and a ring of many vertices.

#[allow(dead_code, reason = "the tests use more of it")]
#[path = "../../../tests/support/packs.rs"]
mod packs;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{GeometrySpec, Polygon, ShapeSpec, SolidSide};
use meniscus_network::extract;
use packs::{Grains, Pack};

fn within(side: f64, shapes: Vec<ShapeSpec>) -> Geometry {
    Geometry::new(&GeometrySpec { min: [0.0; 2], max: [side; 2], solid: SolidSide::Inside, shapes })
        .expect("the shapes are good")
}

fn discs(criterion: &mut Criterion) {
    for (count, side) in [(500, 28.0), (5000, 90.0)] {
        let pack = Pack { side, count, radii: [0.3, 0.6], gap: 0.05, periodic: true, grains: Grains::Discs, seed: 7 };
        let plain = within(side, pack.shapes());
        let boxed = plain.clone().with_wall_sides([true; 4]);
        let periodic = plain.with_periodic([true, true]);
        for (name, geometry) in [("a box", boxed), ("a periodic cell", periodic)] {
            criterion.bench_function(&format!("the network of {count} discs in {name}"), |bencher| {
                bencher.iter(|| extract(black_box(&geometry), [false; 4]).expect("there is a network").throats.len());
            });
        }
    }
}

fn rings(criterion: &mut Criterion) {
    for count in [1_000, 10_000, 100_000] {
        let corner = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            let radius = 3.5 * (1.0 + 0.1 * (40.0 * angle).cos());
            [5.0 + radius * angle.cos(), 5.0 + radius * angle.sin()]
        };
        let outer = (0..count).map(corner).collect();
        let ring = ShapeSpec::Polygon(Polygon { outer, holes: Vec::new(), position: [0.0; 2], rotation_deg: 0.0 });
        let geometry = within(10.0, vec![ring]).with_wall_sides([true; 4]);
        criterion.bench_function(&format!("the network around a ring of {count} vertices"), |bencher| {
            bencher.iter(|| extract(black_box(&geometry), [false; 4]).expect("there is a network").throats.len());
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = discs, rings
}
criterion_main!(benches);
