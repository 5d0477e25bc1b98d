//! Time of the sums over particles, of a stiff step, and of a step of finite differences of a thin film, all O(N); time of a whole film
//! by our integrators and by those of the library diffsol. `cargo bench --bench thin_film`.

#[path = "../tests/film/diffsol/mod.rs"]
mod diffsol;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use meniscus_case::film::{FilmIntegrator, FilmWeights, LatticeEnergy};
use meniscus_film::backward_euler::StepRule;
use meniscus_film::droplet::{Droplet, particles};
use meniscus_film::grid_film::GridFilm;
use meniscus_film::kernel::Kernel;
use meniscus_film::ode::{Implicit, Integrator, Tolerance};
use meniscus_film::particles::{ParticleMethod, Pull};
use meniscus_film::ring::{Line, Ring};
use meniscus_film::sums::{FastSums, Smoothed, direct_sums};

use diffsol::{Reached, esdirk34, tsit45};

type Oracle = fn(&ParticleMethod, &[f64], f64, f64, &[f64]) -> Vec<Reached>;

const ALPHA: f64 = 0.05;
const DROPLET: Droplet = Droplet { area: 0.25, half_width: 0.5, center: 0.0 };

fn sums(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sums");
    group.sample_size(10);
    for count in [100_u64, 1000, 10_000, 100_000, 1_000_000] {
        let masses = particles(&[DROPLET], 1.0 / count as f64, FilmWeights::Point);
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
        let masses = particles(&[DROPLET], 1.0 / count as f64, FilmWeights::Point);
        let mut method =
            ParticleMethod::new(Kernel::new(ALPHA), &masses, Pull { wetting: 1.16, bond: 0.0 }, LatticeEnergy::Kept);
        let tolerance = Tolerance { absolute: 1.0e-7, relative: 0.0 };
        let start = Integrator::new(FilmIntegrator::Stiff, tolerance, masses.x.clone(), 1.0e-6);
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

/// The film of `cases/thin-film/complete-wetting.toml` without records, stiff to t = 50 and explicit to t = 1.
fn whole_films(criterion: &mut Criterion) {
    const TOLERANCE: f64 = 1.0e-7;
    const FIRST_STEP: f64 = 1.0e-6;
    let masses = particles(&[DROPLET], 0.00125, FilmWeights::Cell);
    let method = ParticleMethod::new(Kernel::new(ALPHA), &masses, Pull::default(), LatticeEnergy::Kept);
    let ours = |kind: FilmIntegrator, end: f64| {
        let tolerance = Tolerance { absolute: TOLERANCE, relative: 0.0 };
        let mut state = Integrator::new(kind, tolerance, masses.x.clone(), FIRST_STEP);
        let (mut method, mut steps) = (method.clone(), 0);
        while state.time < end {
            state.step(&mut method, end).unwrap();
            steps += 1;
        }
        Reached { x: state.x, steps }
    };
    let oracle =
        |integrate: Oracle, end: f64| integrate(&method, &masses.x, TOLERANCE, FIRST_STEP, &[end]).pop().unwrap();
    let mut group = criterion.benchmark_group("whole-film");
    group.sample_size(10);
    let mut time = |name: &str, film: &dyn Fn() -> Reached| {
        let Reached { x, steps } = film();
        println!("{name}: {steps} steps, last particle at {:.8}", x[x.len() - 1]);
        group.bench_function(name, |bencher| bencher.iter(film));
    };
    time("rodas", &|| ours(FilmIntegrator::Stiff, 50.0));
    time("esdirk34", &|| oracle(esdirk34, 50.0));
    time("dormand-prince", &|| ours(FilmIntegrator::Explicit, 1.0));
    time("tsit45", &|| oracle(tsit45, 1.0));
    group.finish();
}

fn grid_steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("grid-step");
    group.sample_size(10);
    for count in [1000_usize, 100_000] {
        let alpha = if count > 10_000 { 0.01 } else { ALPHA };
        let line = Line { from: -1.0, count, spacing: 2.0 / count as f64, alpha, wetting: 1.16, bond: 0.0 };
        let (ring, height) = Ring::new(line, &[DROPLET], FilmWeights::Cell).unwrap();
        let start = GridFilm::new(ring, height, StepRule::fixed(1.0e-6));
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(BenchmarkId::new("ring", count), |bencher| {
            bencher.iter(|| black_box(start.clone()).step(1.0).is_ok());
        });
    }
    group.finish();
}

criterion_group!(benches, sums, stiff_steps, whole_films, grid_steps);
criterion_main!(benches);
