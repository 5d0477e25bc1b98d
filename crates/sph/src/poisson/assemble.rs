//! The matrix of the pressure Poisson equation on fluid and wall particles [Huber2013, Eq. 30].

use std::sync::Arc;

use rayon::prelude::*;

use crate::components::components;
use crate::images::Images;
use crate::pairs::{Pairs, split_rows};
use crate::parallel::values;
use crate::poisson::matrix::Matrix;
use crate::terms::poisson::coefficient;

/// The matrix of the pressure equation times −V_a [Huber2013, Eq. 30]. Images are identified with their sources, as p' = p. `volume` in m² and `density` in
/// kg/m³ over particles and images. Pairs that are not `joined` have no coupling.
pub fn assemble(
    pairs: &Pairs,
    images: &Images,
    volume: &[f64],
    density: &[f64],
    joined: impl Fn(usize, usize) -> bool + Sync,
) -> Matrix {
    let column = if images.is_empty() {
        Arc::clone(&pairs.b)
    } else {
        Arc::new(pairs.b.iter().map(|&b| images.source(b as usize) as u32).collect())
    };
    let mut coupling = vec![0.0; pairs.len()];
    let tasks: Vec<_> = split_rows(&pairs.start, &mut coupling).collect();
    tasks.into_par_iter().for_each(|(range, coupling)| {
        let all = range.flat_map(|a| pairs.of(a).map(move |ab| (a, ab)));
        for (out, (a, ab)) in coupling.iter_mut().zip(all) {
            let b = ab.b;
            let value =
                if joined(a, b) { coefficient(volume[a] * volume[b], density[a] + density[b], &ab) } else { 0.0 };
            *out = value as f32;
        }
    });
    let diagonal = values(pairs.rows(), |a| {
        let sum: f64 = coupling[pairs.row(a)].iter().copied().map(f64::from).sum();
        // A particle without neighbors has no equation: its pressure remains zero.
        if sum > 0.0 { sum } else { 1.0 }
    });
    Matrix { start: Arc::clone(&pairs.start), column, coupling, diagonal }
}

/// Numbers the connected components of the pore space, with neighbors connected if `joined`; each has its own pressure constant.
pub fn parts(pairs: &Pairs, images: &Images, joined: impl Fn(usize, usize) -> bool) -> Vec<u32> {
    let joined = &joined;
    components(pairs.rows(), |a| pairs.of(a).filter(move |ab| joined(a, ab.b)).map(|ab| images.source(ab.b)))
}
