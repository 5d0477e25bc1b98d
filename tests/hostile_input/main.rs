//! Damaged and extreme inputs: each is read and checked, none is run. No panic, bounded memory, bounded time, no refusal without its file and a
//! place in it, and no result that is no number.
//!
//! 600 inputs by default; `MENISCUS_FUZZ=1000000 cargo test --release --test hostile_input -- --nocapture` does a million. The inputs follow
//! from their number alone: `MENISCUS_FUZZ_FIRST=4711 MENISCUS_FUZZ=1` does one again. The input at work lies in `target/hostile-input`, so
//! that one that ends the program is found there. This program has one test, so that its allocator counts one input alone.

mod inputs;
mod mutation;
mod places;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use peak_alloc::PeakAlloc;

use inputs::{Bench, Outcome};
use mutation::Random;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Most bytes beside what 100 times the file may take: shape generators, and networks of them.
const MOST_BYTES: usize = 2 << 30;
/// Most processor time of one input: other programs do not count.
const MOST_TIME: Duration = Duration::from_secs(10);

/// What is told of inputs that break a rule.
static FOUND: Mutex<Vec<String>> = Mutex::new(Vec::new());
static CURRENT: AtomicU64 = AtomicU64::new(0);

fn config(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Ends the program where one input takes far too much: there is no other way out of an allocation or a loop.
fn watch() {
    const FAR_TOO_LONG: u32 = 30;
    let (mut input, mut since) = (0, Instant::now());
    loop {
        std::thread::sleep(Duration::from_millis(5));
        let now = CURRENT.load(Ordering::Relaxed);
        if now != input {
            (input, since) = (now, Instant::now());
        }
        let bytes = MEMORY.current_usage();
        if bytes > 2 * MOST_BYTES || since.elapsed() > FAR_TOO_LONG * MOST_TIME {
            eprintln!("input {now}: {} MiB after {:?}; it lies in target/hostile-input", bytes >> 20, since.elapsed());
            std::process::abort();
        }
    }
}

#[test]
fn no_damaged_or_extreme_input_makes_the_reader_panic_or_take_more_than_its_share() {
    let (first, count) = (config("MENISCUS_FUZZ_FIRST", 1), config("MENISCUS_FUZZ", 600));
    let bench = Bench::new(&Path::new(env!("CARGO_MANIFEST_DIR")).join("target/hostile-input"));
    std::thread::spawn(watch);
    std::panic::set_hook(Box::new(|panic| {
        FOUND.lock().unwrap_or_else(std::sync::PoisonError::into_inner).push(panic.to_string());
    }));
    let begun = Instant::now();
    let (mut accepted, mut bad, mut slowest, mut largest) = (0, Vec::new(), (Duration::ZERO, 0), (0, 0));
    for number in first..first + count {
        CURRENT.store(number, Ordering::Relaxed);
        let mut random = Random::new(number);
        let input = bench.write(&mut random);
        let before = MEMORY.current_usage();
        MEMORY.reset_peak_usage();
        let clock = ProcessTime::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| bench.read(&input)));
        let (time, bytes) = (clock.elapsed(), MEMORY.peak_usage().saturating_sub(before));
        let mut told = std::mem::take(&mut *FOUND.lock().unwrap_or_else(std::sync::PoisonError::into_inner));
        match outcome {
            Ok(Outcome::Accepted) => accepted += 1,
            Ok(Outcome::Refused) => {}
            Ok(Outcome::Wrong(why)) => told.push(why),
            Err(_) => {}
        }
        if bytes > MOST_BYTES.max(100 * input.bytes) {
            told.push(format!("{} MiB", bytes >> 20));
        }
        if time > MOST_TIME {
            told.push(format!("{time:?}"));
        }
        if !told.is_empty() {
            let told = format!("input {number}, {} ({}): {}", input.seed.display(), input.change, told.join("; "));
            eprintln!("{told}");
            bench.keep(&input, number);
            bad.push(told);
        }
        slowest = slowest.max((time, number));
        largest = largest.max((bytes, number));
    }
    let _ = std::panic::take_hook();
    println!(
        "{count} inputs in {:.0?}: {accepted} accepted, {} bad; most processor time {:.1?} (input {}), most memory {} MiB (input {})",
        begun.elapsed(),
        bad.len(),
        slowest.0,
        slowest.1,
        largest.0 >> 20,
        largest.1
    );
    assert!(accepted > 0, "no input was accepted: nothing is tested beyond the readers");
    assert!(bad.is_empty(), "{} of {count} inputs:\n{}", bad.len(), bad.join("\n"));
}
