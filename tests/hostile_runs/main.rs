//! Cases with changed numbers that pass their check, run for a few steps with all their files: no panic, no hang, no number that is none in any
//! output, and no more work per step than a bound that is counted. Those that do not pass are refused with their file and a place in it.
//!
//! 150 cases by default; `MENISCUS_RUNS=5000 cargo test --release --test hostile_runs -- --nocapture` runs more. The cases follow from their
//! number alone: `MENISCUS_RUNS_FIRST=4711 MENISCUS_RUNS=1` runs one again. Those that break a rule stay in `target/hostile-runs`.

#[path = "../hostile_input/mutation.rs"]
mod mutation;
#[path = "../hostile_input/places.rs"]
mod places;
mod run;
mod seeds;

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use mutation::{EXTREME, Random, changed, numbers};
use run::{Ending, run};
use seeds::Seed;

/// Threads that run cases, one each.
const THREADS: u64 = 2;
/// A case at work for so long hangs: the program is ended, as there is no other way out of a loop.
const HANGS: Duration = Duration::from_secs(300);

/// What numbers are multiplied by: cases stay near what makes sense, so that most of them run.
const FACTORS: [f64; 12] = [0.0, -1.0, 0.01, 0.1, 0.5, 0.9, 1.0 + 1e-9, 1.1, 2.0, 10.0, 100.0, 1e4];

static BEGUN: [AtomicU64; THREADS as usize] = [const { AtomicU64::new(0) }; THREADS as usize];

fn config(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// The case of a number, and what was changed in which.
fn case_of(seeds: &[Seed], number: u64) -> (String, Vec<u8>) {
    let mut random = Random::new(number);
    let seed = random.one_of(seeds);
    /// One file in so many is damaged without a thought.
    const DAMAGED: usize = 10;
    let (bytes, told) = match random.below(DAMAGED) {
        0 => changed(seed.text.as_bytes(), &mut random),
        _ => retuned(seed.text.as_bytes(), &mut random),
    };
    (format!("{} ({told})", seed.name), bytes)
}

/// The text with one to three of its numbers changed.
fn retuned(text: &[u8], random: &mut Random) -> (Vec<u8>, String) {
    let (mut bytes, mut told) = (text.to_vec(), Vec::new());
    for _ in 0..*random.one_of(&[1, 1, 2, 3]) {
        let places = numbers(&bytes);
        let place = random.one_of(&places).clone();
        let old = String::from_utf8_lossy(&bytes[place.clone()]).into_owned();
        let new = match (random.below(8), old.parse::<i64>(), old.parse::<f64>()) {
            (0, ..) => (*random.one_of(&EXTREME)).to_owned(),
            (_, Ok(old), _) => (old + *random.one_of(&[-1, 1, 2, 10])).to_string(),
            (_, _, Ok(old)) => format!("{:e}", old * random.one_of(&FACTORS)),
            _ => "7".to_owned(),
        };
        let line = 1 + bytes[..place.start].iter().filter(|byte| **byte == b'\n').count();
        told.push(format!("line {line}: {old} -> {new}"));
        bytes.splice(place, new.bytes());
    }
    (bytes, told.join(", "))
}

/// Ends the program where a case hangs.
fn watch() {
    let mut since = BEGUN.each_ref().map(|begun| (begun.load(Ordering::Relaxed), Instant::now()));
    loop {
        std::thread::sleep(Duration::from_millis(100));
        for (begun, since) in BEGUN.iter().zip(&mut since) {
            let now = begun.load(Ordering::Relaxed);
            if now != since.0 {
                *since = (now, Instant::now());
            } else if now != 0 && since.1.elapsed() > HANGS {
                eprintln!("case {now} hangs: MENISCUS_RUNS_FIRST={now} MENISCUS_RUNS=1");
                std::process::abort();
            }
        }
    }
}

/// How many cases ended how, and what broke a rule.
#[derive(Default)]
struct Tally {
    refused: u64,
    large: u64,
    ran: u64,
    failed: Vec<String>,
    bad: Vec<String>,
}

fn work(thread: u64, seeds: &[Seed], (first, count): (u64, u64)) -> Tally {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("target/hostile-runs/{thread}"));
    let _ = std::fs::remove_dir_all(&root);
    let mut tally = Tally::default();
    for number in (first..first + count).filter(|number| number % THREADS == thread) {
        BEGUN[thread as usize].store(number, Ordering::Relaxed);
        let (told, bytes) = case_of(seeds, number);
        let folder = root.join(number.to_string());
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("case.toml"), bytes).unwrap();
        let ending = pool.install(|| std::panic::catch_unwind(|| run(&folder)));
        let told = format!("case {number}, {told}");
        let is_bad = match ending {
            Ok(Ending::Refused) => {
                tally.refused += 1;
                false
            }
            Ok(Ending::TooLarge) => {
                tally.large += 1;
                false
            }
            Ok(Ending::Ran) => {
                tally.ran += 1;
                false
            }
            Ok(Ending::Failed(why)) => {
                tally.failed.push(format!("{told}: {why}"));
                false
            }
            Ok(Ending::Bad(why)) => {
                tally.bad.push(format!("{told}: {why}"));
                true
            }
            Err(panic) => {
                let text = panic.downcast_ref::<String>().cloned();
                let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
                tally.bad.push(format!("{told}: panic: {}", text.unwrap_or_default()));
                true
            }
        };
        if !is_bad {
            let _ = std::fs::remove_dir_all(&folder);
        }
    }
    BEGUN[thread as usize].store(0, Ordering::Relaxed);
    tally
}

#[test]
fn changed_cases_that_pass_their_check_run_without_panic_hang_or_numbers_that_are_none() {
    let range = (config("MENISCUS_RUNS_FIRST", 1), config("MENISCUS_RUNS", 150));
    let seeds = seeds::seeds();
    std::thread::spawn(watch);
    let begun = Instant::now();
    let tallies: Vec<Tally> = std::thread::scope(|scope| {
        let seeds = &seeds;
        let threads: Vec<_> = (0..THREADS).map(|thread| scope.spawn(move || work(thread, seeds, range))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    let sum = |count: fn(&Tally) -> u64| tallies.iter().map(count).sum::<u64>();
    let failed: Vec<&String> = tallies.iter().flat_map(|tally| &tally.failed).collect();
    let bad: Vec<&str> = tallies.iter().flat_map(|tally| &tally.bad).map(String::as_str).collect();
    println!(
        "{} changed cases of {} in {:.0?}: {} refused, {} too large to run here, {} ran, {} ended with an error, {} bad",
        range.1,
        seeds.len(),
        begun.elapsed(),
        sum(|tally| tally.refused),
        sum(|tally| tally.large),
        sum(|tally| tally.ran),
        failed.len(),
        bad.len()
    );
    failed.iter().for_each(|one| println!("  error: {one}"));
    assert!(seeds.len() >= 30, "{} seeds", seeds.len());
    assert!(range.1 < 100 || sum(|tally| tally.ran) > range.1 / 10, "too few cases ran");
    assert!(bad.is_empty(), "{} bad:\n{}", bad.len(), bad.join("\n"));
}
