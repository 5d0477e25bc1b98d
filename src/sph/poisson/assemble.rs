//! The matrix of the pressure Poisson equation on fluid and wall particles [Huber2013, Eq. 30].

use rayon::prelude::*;

use crate::math::Vec2;
use crate::sph::images::Images;
use crate::sph::pairs::{GRAIN, Pairs, each};
use crate::sph::poisson::Matrix;
use crate::sph::terms::poisson::coefficient;

/// Fills `matrix` with the coefficients of Eq. (30) times −V_a; images count for their sources [Eq. 34: p' = p].
///
/// `volume` in m² and `density` in kg/m³ over particles and images, `r_ab(a, b)` in m, `zeta` in m.
pub fn assemble(
    matrix: &mut Matrix,
    (pairs, images): (&Pairs, &Images),
    volume: &[f64],
    density: &[f64],
    r_ab: impl Fn(usize, usize) -> Vec2 + Sync,
    zeta: f64,
) {
    let rows = pairs.rows();
    matrix.start.clear();
    matrix.start.extend_from_slice(pairs.starts());
    matrix.column.clear();
    matrix.column.extend(pairs.neighbors().iter().map(|&b| images.source(b as usize) as u32));
    matrix.coupling.resize(pairs.len(), 0.0);
    let mut rest = matrix.coupling.as_mut_slice();
    let mut tasks = Vec::new();
    for first in (0..rows).step_by(GRAIN) {
        let end = (first + GRAIN).min(rows);
        let (here, after) = rest.split_at_mut(pairs.starts()[end] - pairs.starts()[first]);
        rest = after;
        tasks.push((first..end, here));
    }
    tasks.into_par_iter().for_each(|(range, coupling)| {
        let mut k = 0;
        for a in range {
            for ab in pairs.of(a) {
                let b = ab.b;
                coupling[k] = coefficient(volume[a] * volume[b], density[a] + density[b], r_ab(a, b), &ab, zeta);
                k += 1;
            }
        }
    });
    matrix.diagonal.resize(rows, 0.0);
    let (start, coupling) = (&matrix.start, &matrix.coupling);
    each(&mut matrix.diagonal, |a| {
        let sum: f64 = coupling[start[a]..start[a + 1]].iter().sum();
        // A particle without neighbors has no equation: its pressure stays zero.
        if sum > 0.0 { sum } else { 1.0 }
    });
}

/// Numbers the parts of the pore space that share no neighbors; each has a pressure constant of its own.
#[must_use]
pub fn parts(pairs: &Pairs, images: &Images) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut part = vec![NONE; pairs.rows()];
    let mut next = 0;
    for first in 0..part.len() {
        if part[first] != NONE {
            continue;
        }
        part[first] = next;
        let mut open = vec![first];
        while let Some(a) = open.pop() {
            for ab in pairs.of(a) {
                let b = images.source(ab.b);
                if part[b] == NONE {
                    part[b] = next;
                    open.push(b);
                }
            }
        }
        next += 1;
    }
    part
}
