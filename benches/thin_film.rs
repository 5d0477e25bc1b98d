//! Time of the sums over particles, of a stiff step, and of a step of finite differences of a thin film, all O(N). `cargo bench --bench thin_film`.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use meniscus::thin_film::backward_euler::StepRule;
use meniscus::thin_film::droplet::{Droplet, WeightRule, particles};
use meniscus::thin_film::grid::{Equation, GridFilm};
use meniscus::thin_film::kernel::Kernel;
use meniscus::thin_film::ode::{Implicit, Integrator, Method, Tolerance};
use meniscus::thin_film::particles::{LatticeEnergy, ParticleMethod, Pull};
use meniscus::thin_film::ring::{Line, Ring};
use meniscus::thin_film::sums::{FastSums, Smoothed, direct_sums};

const ALPHA: f64 = 0.05;
const DROPLET: Droplet = Droplet { area: 0.25, half_width: 0.5, center: 0.0 };

fn sums(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sums");
    group.sample_size(10);
    for count in [100_u64, 1000, 10_000, 100_000, 1_000_000] {
        let masses = particles(&[DROPLET], 1.0 / count as f64, WeightRule::Point);
        let kernel = Kernel::new(ALPHA);
        let mut out = Smoothed::new(masses.x.len());
        let mut fast = FastSums::new(kernel);
        group.throughput(Throughput::Elements(count));
        group.bench_function(BenchmarkId::new("recursive", count), |bencher| {
            bencher.iter(|| fast.at_particles(black_box(&masses.x), &masses.weight, &mut out));
        });
        if count <= 1000 {
            group.bench_function(BenchmarkId::new("direct", count), |bencher| {
                bencher.iter(|| direct_sums(&kernel, black_box(&masses.x), &masses.weight));
            });
        }
    }
    group.finish();
}

fn stiff_steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stiff-step");
    group.sample_size(10);
    for count in [200_u64, 20_000] {
        let masses = particles(&[DROPLET], 1.0 / count as f64, WeightRule::Point);
        let mut method =
            ParticleMethod::new(Kernel::new(ALPHA), &masses, Pull { wetting: 1.16, bond: 0.0 }, LatticeEnergy::Kept);
        let tolerance = Tolerance { absolute: 1.0e-7, relative: 0.0 };
        let start = Integrator::new(Method::Stiff, tolerance, masses.x.clone(), 1.0e-6);
        group.throughput(Throughput::Elements(count));
        group.bench_function(BenchmarkId::new("factor", count), |bencher| {
            bencher.iter(|| method.factor(black_box(&masses.x), 1.0e6).is_some());
        });
        group.bench_function(BenchmarkId::new("step", count), |bencher| {
            bencher.iter(|| start.clone().step(&mut method, 1.0e-7).is_ok());
        });
    }
    group.finish();
}

fn grid_steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("grid-step");
    group.sample_size(10);
    for count in [1000_usize, 100_000] {
        let alpha = if count > 10_000 { 0.01 } else { ALPHA };
        let line = Line { from: -1.0, count, spacing: 2.0 / count as f64, alpha, wetting: 1.16, bond: 0.0 };
        let (ring, height) = Ring::new(line, &[DROPLET], WeightRule::Cell).unwrap();
        let start = GridFilm::new(Equation::Ring(ring), height, StepRule::fixed(1.0e-6));
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::new("ring", count), |bencher| {
            bencher.iter(|| black_box(start.clone()).step(1.0).is_ok());
        });
    }
    group.finish();
}

criterion_group!(benches, sums, stiff_steps, grid_steps);
criterion_main!(benches);
