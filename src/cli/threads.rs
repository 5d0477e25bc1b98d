//! Threads of a run and concurrent runs, within the cores of this machine: more would only wait for each other.

use std::num::NonZeroUsize;

use super::exit::{Failure, USAGE};
use super::output::tell;

/// Default number of threads of a process.
const VARIABLE: &str = "RAYON_NUM_THREADS";

/// Cores of this machine available to this process.
pub(crate) fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The number requested by `option`, at most the number of cores; a reduction is reported.
pub(crate) fn within_cores(option: &str, requested: usize) -> usize {
    let (found, note) = bounded(option, requested, cores());
    note.iter().for_each(tell);
    found
}

fn bounded(option: &str, requested: usize, cores: usize) -> (usize, Option<String>) {
    if requested <= cores {
        return (requested, None);
    }
    let these = if cores == 1 { "1 core".to_owned() } else { format!("{cores} cores") };
    (cores, Some(format!("{option} {requested}: this machine has {these}, and this number is used")))
}

/// The thread pool of a run: with the requested number of threads, or all cores.
///
/// # Errors
/// The system cannot create threads.
pub(crate) fn pool(requested: Option<NonZeroUsize>) -> Result<rayon::ThreadPool, Failure> {
    let threads = match requested {
        Some(threads) => within_cores("--threads", usize::from(threads)),
        None => of_environment().unwrap_or_else(cores),
    };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| Failure::new(USAGE, format_args!("cannot start {threads} threads: {error}; use fewer")))
}

/// Limits loops outside of a pool to the cores, too.
pub(crate) fn bound_environment() {
    if requested_in_environment().is_some_and(|requested| requested > cores()) {
        // The global pool of a process can be set only once; this is called before it exists.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(cores()).build_global();
    }
}

fn of_environment() -> Option<usize> {
    requested_in_environment().map(|requested| within_cores(VARIABLE, requested))
}

fn requested_in_environment() -> Option<usize> {
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
        assert_eq!(note.unwrap(), "--threads 100000: this machine has 4 cores, and this number is used");
    }
}
