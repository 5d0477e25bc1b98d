//! Loops and sums over particles in parallel, with the same bits for any number of threads.

use std::ops::Range;

use rayon::prelude::*;

/// Particles per task: enough to outweigh the overhead of a task, few compared with the particle count of a real case.
pub(crate) const GRAIN: usize = 512;

/// `task(first, part)` of parts of `out`, each with the index of its first element, in parallel. A task is not a type parameter: the loops of rayon are
/// compiled once for each type of elements, not once for each loop of the method.
fn parts_of<T: Send>(out: &mut [T], task: &(dyn Fn(usize, &mut [T]) + Sync)) {
    out.par_chunks_mut(GRAIN).enumerate().for_each(|(part, out)| task(part * GRAIN, out));
}

/// `task(range)` of parts of 0..n in order, in parallel; see [`parts_of`].
fn in_parts<T: Send>(n: usize, task: &(dyn Fn(Range<usize>) -> T + Sync)) -> Vec<T> {
    (0..n.div_ceil(GRAIN)).into_par_iter().map(|part| task(part * GRAIN..((part + 1) * GRAIN).min(n))).collect()
}

/// `change(a, &mut out[a])` in parallel, one writer per element, so that any number of threads gives the same bits.
pub(crate) fn change_each<T: Send>(out: &mut [T], change: impl Fn(usize, &mut T) + Sync) {
    parts_of(out, &|first, part| part.iter_mut().enumerate().for_each(|(i, out)| change(first + i, out)));
}

/// `out[a] = value(a)` in parallel.
pub(crate) fn each<T: Send>(out: &mut [T], value: impl Fn(usize) -> T + Sync) {
    change_each(out, |a, out| *out = value(a));
}

/// `value(a)` of each a in 0..n, in parallel.
pub(crate) fn values<T: Send>(n: usize, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let mut found = Vec::with_capacity(n);
    in_parts(n, &|range| range.map(&value).collect::<Vec<T>>()).iter_mut().for_each(|part| found.append(part));
    found
}

/// Σ_a `value(a)` over 0..n, as partial sums of fixed length added in order: the same bits for any number of threads.
pub(crate) fn total(n: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    in_parts(n, &|range| range.map(&value).sum::<f64>()).iter().sum()
}

/// The largest `value(a)` over 0..n with its index; the first of equals. `None` for n = 0.
pub(crate) fn largest(n: usize, value: impl Fn(usize) -> f64) -> Option<(usize, f64)> {
    (0..n).map(|a| (a, value(a))).reduce(|best, next| if next.1 > best.1 { next } else { best })
}
