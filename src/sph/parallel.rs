//! Loops and sums over particles in parallel, with the same bits for any number of threads.

use rayon::prelude::*;

/// Particles per task: enough to outweigh the overhead of a task, few compared with the particle count of a real case.
pub(crate) const GRAIN: usize = 512;

/// `out[a] = value(a)` in parallel, one writer per element, so that any number of threads gives the same bits.
pub(crate) fn each<T: Send>(out: &mut [T], value: impl Fn(usize) -> T + Sync) {
    out.par_iter_mut().enumerate().with_min_len(GRAIN).for_each(|(a, out)| *out = value(a));
}

/// `value(a)` of each a in 0..n, in parallel.
pub(crate) fn values<T: Send>(n: usize, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    (0..n).into_par_iter().with_min_len(GRAIN).map(&value).collect()
}

/// Σ_a `value(a)` over 0..n, as partial sums of fixed length added in order: the same bits for any number of threads.
pub(crate) fn total(n: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    let parts: Vec<f64> = (0..n.div_ceil(GRAIN))
        .into_par_iter()
        .map(|part| (part * GRAIN..((part + 1) * GRAIN).min(n)).map(&value).sum())
        .collect();
    parts.iter().sum()
}

/// The largest `value(a)` over 0..n with its index; the first of equals. `None` for n = 0.
pub(crate) fn largest(n: usize, value: impl Fn(usize) -> f64) -> Option<(usize, f64)> {
    (0..n).map(|a| (a, value(a))).reduce(|best, next| if next.1 > best.1 { next } else { best })
}
