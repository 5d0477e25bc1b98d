//! How the time of a step grows with the number of particles and falls with threads: the free drop of `benches/step.rs` on ever finer
//! lattices.
//!
//! `cargo bench --bench scaling` measures 1e4 and 1e5 particles on one thread and on two, in a minute or two; `-- --full` goes on to 1e6.
//! `-- --sizes 1e4,4e4 --threads 1,2,4` chooses. The table is printed and written to `target/scaling.csv`, which
//! `postprocess/scaling_figure.py` draws.

#[path = "../tests/support/flow.rs"]
mod flow;

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use flow::flow;
use meniscus_sph::flow::{Flow, PARTS};
use mimalloc::MiMalloc;

/// That of the program.
#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// Side of the square in m.
const SIDE: f64 = 2.0e-3;

/// Particles times steps of a measurement: some seconds.
const WORK: f64 = 1.0e6;

/// Fewest and most steps of a measurement; as many go before it, in which the lattice melts.
const STEPS: (f64, f64) = (4.0, 100.0);

/// A drop of 5 mPa s in a vapor of the same density, periodic, of about `particles`.
fn case(particles: f64) -> String {
    // A whole number of spacings along the side.
    let spacing = SIDE / particles.sqrt().round();
    let half = SIDE / 2.0;
    format!(
        r#"
format = 1
title = "A free drop"
[geometry]
min = [-{half:?}, -{half:?}] # m
max = [{half:?}, {half:?}] # m
[sph]
spacing = {spacing:?} # m
[sph.phases.wetting]
density = 1000.0 # kg/m3
viscosity = 5.0e-3 # Pa s
[sph.phases.non-wetting]
density = 1000.0 # kg/m3
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

/// Numbers behind an argument such as `--sizes 1e4,1e5`; the default where it is not given.
fn numbers(name: &str, default: &[f64]) -> Vec<f64> {
    let given = std::env::args().skip_while(|argument| argument != name).nth(1);
    given.map_or(default.to_vec(), |list| {
        let number =
            |word: &str| word.parse().unwrap_or_else(|_| panic!("{name} takes numbers like 1e4,1e5, found {word}"));
        list.split(',').map(number).collect()
    })
}

fn advance(flow: &mut Flow, steps: usize) {
    for _ in 0..steps {
        flow.step(1.0).expect("a step");
    }
}

/// One row of the table: what a measurement at a size and a number of threads gave.
fn measure(size: f64, threads: usize) -> Vec<f64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    let steps = (WORK / size).clamp(STEPS.0, STEPS.1).round();
    pool.install(|| {
        let mut flow = flow(&case(size));
        advance(&mut flow, steps as usize);
        let (before, start) = (flow.work, Instant::now());
        advance(&mut flow, steps as usize);
        let wall = start.elapsed().as_secs_f64();
        let particles = flow.state.particles.len() as f64;
        let per_particle = |seconds: f64| 1e6 * seconds / (particles * steps);
        let parts = flow.work.seconds.iter().zip(before.seconds).map(|(after, before)| per_particle(after - before));
        let iterations = (flow.work.iterations - before.iterations) as f64 / steps;
        let bytes = flow.bytes() as f64 / particles;
        [particles, threads as f64, steps, per_particle(wall)]
            .into_iter()
            .chain(parts)
            .chain([iterations, bytes])
            .collect()
    })
}

fn main() {
    let full = std::env::args().any(|argument| argument == "--full");
    let default: &[f64] = if full { &[1.0e4, 1.0e5, 1.0e6] } else { &[1.0e4, 1.0e5] };
    let (sizes, threads) = (numbers("--sizes", default), numbers("--threads", &[1.0, 2.0]));
    let parts = PARTS.map(|part| format!("{part}_us"));
    let before = ["particles", "threads", "steps", "step_us"].map(str::to_owned);
    let after = ["pressure_iterations", "bytes_per_particle"].map(str::to_owned);
    let columns = [&before[..], &parts[..], &after[..]].concat();
    println!(
        "microseconds per particle and step, iterations of the pressure solve per step, bytes of memory per particle\n"
    );
    println!("{}", columns.iter().map(|column| format!("{column:>20}")).collect::<String>());
    let mut text = columns.join(",") + "\n";
    for &size in &sizes {
        for &threads in &threads {
            let row = measure(size, threads as usize);
            println!("{}", row.iter().map(|value| format!("{value:>20.4}")).collect::<String>());
            let words: Vec<String> = row.iter().map(f64::to_string).collect();
            writeln!(text, "{}", words.join(",")).expect("a text grows");
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/scaling.csv");
    std::fs::write(&path, text).expect("target is writable");
    println!("\n{}", path.display());
}
