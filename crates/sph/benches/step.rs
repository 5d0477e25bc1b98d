//! One step of a flow of 10 000 particles: a drop of liquid in its vapor, periodic, as in `cases/laplace-drop.toml`.
//!
//! `cargo bench --bench step` prints microseconds per particle and step by part, bytes per particle, iterations and residual of
//! the pressure solve, for one thread and for all, then criterion's statistics of whole steps. With `-- --table` the table alone.

#[path = "../../../tests/support/flow.rs"]
mod flow;
#[path = "../../../benches/support/table.rs"]
mod table;

use std::hint::black_box;
use std::time::Instant;

use criterion::{BatchSize, Criterion};
use flow::flow;
use meniscus_sph::flow::{Flow, PARTS};
use rayon::ThreadPool;

/// Steps before the clock starts: the lattice must have melted, as in a run.
const WARM_UP: usize = 100;

/// Steps measured.
const STEPS: usize = 100;

/// The drop in a square of 2 mm; 100 × 100 particles. Densities and the tension make the solver's two ways.
fn case(density: f64) -> String {
    format!(
        r#"
format = 1
title = "A free drop"
[geometry]
min = [-1.0e-3, -1.0e-3] # m
max = [1.0e-3, 1.0e-3] # m
[sph]
spacing = 2.0e-5 # m
[sph.phases.wetting]
density = 1000.0 # kg/m3
viscosity = 5.0e-3 # Pa s
[sph.phases.non-wetting]
density = {density:?} # kg/m3
viscosity = 5.0e-4 # Pa s
[sph.interface]
tension = 0.02 # N/m
[sph.sides]
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
[[sph.initial.wetting]]
disc = {{ center = [0.0, 0.0], radius = 5.0e-4 }} # m
[time]
end = 1.0 # s
"#
    )
}

fn advance(flow: &mut Flow, steps: usize) {
    for _ in 0..steps {
        flow.step(1.0).expect("a step");
    }
}

/// Pools of one thread and, where there are more, of all.
fn pools() -> Vec<ThreadPool> {
    let all = std::thread::available_parallelism().map_or(1, usize::from);
    let counts = if all > 1 { vec![1, all] } else { vec![1] };
    let pool = |count| rayon::ThreadPoolBuilder::new().num_threads(count).build().expect("a pool");
    counts.into_iter().map(pool).collect()
}

fn print_row(density: f64) {
    for pool in pools() {
        let mut flow = flow(&case(density));
        pool.install(|| advance(&mut flow, WARM_UP));
        let (before, start) = (flow.work, Instant::now());
        pool.install(|| advance(&mut flow, STEPS));
        let wall = start.elapsed().as_secs_f64();
        let particles = flow.state.particles.len();
        let per_particle = |seconds: f64| 1e6 * seconds / (particles * STEPS) as f64;
        print!("{:>7} {:>8} {:>8.3}", 1000.0 / density, pool.current_num_threads(), per_particle(wall));
        for (after, before) in flow.work.seconds.iter().zip(before.seconds) {
            print!(" {:>9.3}", per_particle(after - before));
        }
        let iterations = (flow.work.iterations - before.iterations) as f64 / STEPS as f64;
        println!(" {iterations:>11.1} {:>9.1e} {:>9}", flow.work.residual, flow.bytes() / particles);
    }
}

fn print_table() {
    println!("microseconds per particle and step of 10 000 particles, mean of {STEPS} steps\n");
    print!("{:>7} {:>8} {:>8}", "ratio", "threads", "step");
    PARTS.iter().for_each(|part| print!(" {part:>9}"));
    println!(" {:>11} {:>9} {:>9}", "iterations", "residual", "bytes");
    for density in [1000.0, 100.0] {
        print_row(density);
    }
    println!();
}

fn statistics(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step");
    group.sample_size(10);
    for density in [1000.0, 100.0] {
        let mut melted = flow(&case(density));
        advance(&mut melted, WARM_UP);
        group.bench_function(format!("ratio-{}", 1000.0 / density), |bencher| {
            bencher.iter_batched(|| (), |()| advance(black_box(&mut melted), 1), BatchSize::PerIteration);
        });
    }
    group.finish();
}

fn main() {
    table::table_then_statistics(print_table, statistics);
}
