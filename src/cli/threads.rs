//! Threads of a run and runs at once, within the cores of this machine: more would only wait for each other.

use std::num::NonZeroUsize;

use super::exit::{Failure, USAGE};
use super::output::tell;

/// Number of threads that the loops of a process take where its command line says nothing.
const VARIABLE: &str = "RAYON_NUM_THREADS";

/// Cores of this machine that this process may use.
pub(crate) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The number asked for by `option`, at most the number of cores; less than asked for is told.
pub(crate) fn within_cores(option: &str, asked_for: usize) -> usize {
    let (found, note) = bounded(option, asked_for, cores());
    note.iter().for_each(tell);
    found
}

fn bounded(option: &str, asked_for: usize, cores: usize) -> (usize, Option<String>) {
    if asked_for <= cores {
        return (asked_for, None);
    }
    let these = if cores == 1 { "1 core".to_owned() } else { format!("{cores} cores") };
    (cores, Some(format!("{option} {asked_for}: this machine has {these}, and so many are used")))
}

/// The thread pool that a run works in: of the threads asked for, or of all cores.
///
/// # Errors
/// The system gives no threads.
pub(crate) fn pool(asked_for: Option<NonZeroUsize>) -> Result<rayon::ThreadPool, Failure> {
    let threads = match asked_for {
        Some(threads) => within_cores("--threads", usize::from(threads)),
        None => of_environment().unwrap_or_else(cores),
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Failure::new(USAGE, &format_args!("cannot start {threads} threads: {error}; use fewer")))
}

/// Keeps loops outside of a pool within the cores too.
pub(crate) fn bound_environment() {
    if asked_in_environment().is_some_and(|asked_for| asked_for > cores()) {
        // Only the first pool of a process can be set, and this is called before there is one.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(cores()).build_global();
    }
}

fn of_environment() -> Option<usize> {
    asked_in_environment().map(|asked_for| within_cores(VARIABLE, asked_for))
}

fn asked_in_environment() -> Option<usize> {
    std::env::var(VARIABLE).ok()?.parse().ok().filter(|threads| *threads > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_more_threads_are_started_than_there_are_cores_and_less_than_asked_for_is_told() {
        assert_eq!(bounded("--threads", 4, 4), (4, None));
        let (found, note) = bounded("--threads", 100_000, 4);
        assert_eq!(found, 4);
        assert_eq!(note.unwrap(), "--threads 100000: this machine has 4 cores, and so many are used");
    }
}
