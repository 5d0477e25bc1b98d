//! The pressure jump J_ab = σ κ̄_ab (c_b − c_a) between particles on opposite sides of the interface.

use rayon::prelude::*;

use crate::bulk::BulkFields;
use crate::components::components;
use crate::images::Field;
use crate::neighborhood::Neighborhood;
use crate::pairs::Pairs;
use crate::parallel::{GRAIN, values};
use crate::surface_force::fit::{Fitted, WallFit};
use crate::view::View;
use meniscus_core::math::{LINE_MOMENT, Vec2};
use meniscus_geometry::interface::depth::Depth;

/// Passes of the smoothing of the curvature along the interface.
const PASSES: usize = 1;

/// Relative attenuation of a wave with wavenumber k by the kernel average, over k²h²: half its second moment, 5 h²/18 along each direction.
const LOSS_OF_A_PASS: f64 = 5.0 / 36.0;

/// Relative attenuation by a circle fit, over k²h²: exp(−k²h²/4) is the transform of the weight exp(−d²/h²).
const LOSS_OF_THE_FIT: f64 = 0.25;

/// Factor on the attenuation of all passes in the deconvolution, so that it also compensates for those of color and fit.
const DECONVOLUTION: f64 = 1.0 + (LOSS_OF_THE_FIT + LINE_MOMENT) / (PASSES as f64 * LOSS_OF_A_PASS);

/// Constrained fits whose contact lines are farther apart than this, over h, belong to different lines.
const ONE_LINE: f64 = 2.0;

/// Regularization added to the variance of the arc lengths in a regression, over h², for few or similar arc lengths.
const LEAST_SPREAD: f64 = 0.02;

/// Largest correction of a curvature over 1/h.
const LARGEST_CORRECTION: f64 = 0.5;

/// Sides and curvatures that determine the jump of each pair.
#[derive(Debug, Clone)]
pub struct Jump {
    /// Side of the interface: 1 in the wetting phase, 0 in the other; wall particles have that of the fluid nearby.
    pub side: Field<f64>,
    /// Curvature in 1/m of the interface near the particle, extrapolated to it with the gradient at rest; NaN away from the interface.
    pub curvature: Field<f64>,
    /// Whether a particle has a neighbor on the other side.
    pub is_across: Vec<bool>,
    /// Floor and lid, and whether a particle belongs to a drop or bubble away from walls; `None` in the plane.
    pub(crate) plates: Option<(Depth, Field<bool>)>,
}

impl Jump {
    /// Sides and curvatures; `color` is sharp on fluid particles and that of the fluid nearby on walls. `curvature_at` is the curvature near a point
    /// (m), `None` away from the interface; `gradient` its gradient at rest in 1/m².
    pub(crate) fn new(
        flow: &View<BulkFields>,
        color: &[f64],
        gradient: Vec2,
        curvature_at: impl Fn(Vec2) -> Option<Fitted> + Sync,
    ) -> Self {
        let (Neighborhood { pairs, images }, position) = (flow.neighborhood, &flow.state.particles.position);
        let (domain, h) = (&flow.config.domain, flow.config.method.kernel.h);
        let (n, fluids) = (pairs.rows(), flow.state.particles.moving());
        let side = images.field(color[..n].iter().map(|&c| if c > 0.5 { 1.0 } else { 0.0 }).collect());
        let is_across = values(n, |a| pairs.of(a).any(|ab| side[ab.b] != side[a]));
        let fitted: Vec<Option<Fitted>> = (0..fluids)
            .into_par_iter()
            .with_min_len(GRAIN / 8)
            .map(|a| if is_across[a] { curvature_at(position[a]) } else { None })
            .collect();
        let rest = |a: usize, b: usize| gradient.dot(&domain.separation(position[a], position[images.source(b)]));
        let apart = |x: Vec2, y: Vec2| domain.separation(x, y).norm();
        let on_fluid = values(fluids, |a| {
            let Some(Fitted { curvature, constrained }) = fitted[a] else { return f64::NAN };
            let Some(here) = constrained else { return curvature };
            let neighbors = pairs.of(a).filter_map(|ab| {
                let there = fitted.get(images.source(ab.b))?.as_ref()?.constrained?;
                let same = there.side == here.side && apart(there.line, here.line) < ONE_LINE * h;
                same.then(|| (ab.w, WallFit { mean: there.mean + rest(a, ab.b), ..there }))
            });
            curvature + here.share * turned(here, neighbors, pairs.w_self, h)
        });
        let mut curvature = smoothed(on_fluid, flow.neighborhood, &rest);
        curvature.resize(n, f64::NAN);
        // Wall particles: the mean of their fluid neighbors; in deeper layers that of the previous layer.
        for _ in 0..2 {
            let known = images.field(curvature);
            let of_wall = |a: usize| average_at(a, pairs, None, |b| known[b] + rest(a, b));
            curvature = values(n, |a| if a >= fluids && known[a].is_nan() { of_wall(a) } else { known[a] });
        }
        Self {
            side,
            curvature: images.field(curvature),
            is_across,
            plates: flow.config.method.plates.map(|plates| (plates.depth, drops(flow))),
        }
    }

    /// J_ab in units of the tension: κ̄_ab (c_b − c_a) in 1/m, κ̄ the mean of the defined curvatures \[Fedkiw1999; Kang2000\].
    #[inline]
    pub(crate) fn of(&self, a: usize, b: usize) -> f64 {
        if !self.is_across[a] {
            return 0.0;
        }
        let step = self.side[b] - self.side[a];
        if step == 0.0 {
            return 0.0;
        }
        let (k_a, k_b) = (self.curvature[a], self.curvature[b]);
        let kappa = match (k_a.is_nan(), k_b.is_nan()) {
            (false, false) => 0.5 * (k_a + k_b),
            (false, true) => k_a,
            (true, false) => k_b,
            (true, true) => 0.0,
        };
        // κ is positive where the wetting phase is convex, the curvature of a meniscus where it bulges into the wetting phase.
        let kappa = match &self.plates {
            None => kappa,
            Some((depth, is_drop)) if is_drop[a] || is_drop[b] => -depth.curvature_of_drop(-kappa),
            Some((depth, _)) => -depth.curvature(-kappa),
        };
        kappa * step
    }
}

/// The particles of drops and bubbles: of ganglia without a wall nearby.
fn drops(flow: &View<BulkFields>) -> Field<bool> {
    let (Neighborhood { pairs, images }, particles) = (flow.neighborhood, &flow.state.particles);
    let (phase, moving) = (&particles.phase, particles.moving());
    let part = components(moving, |a| {
        let same = move |&b: &usize| b < moving && phase[b] == phase[a];
        pairs.of(a).map(|ab| images.source(ab.b)).filter(same)
    });
    let mut is_drop = vec![true; moving];
    for a in (0..moving).filter(|&a| flow.fields.wall_distance[a].is_finite()) {
        is_drop[part[a] as usize] = false;
    }
    let of_particle = (0..particles.len()).map(|a| a < moving && is_drop[part[a] as usize]);
    images.field(of_particle.collect())
}

/// The difference in 1/m of the local curvature from the mean between the wall and the arc length s: s dκ̄/ds, with the slope of a weighted linear
/// regression over the `neighbors`.
fn turned(here: WallFit, neighbors: impl Iterator<Item = (f64, WallFit)>, own_weight: f64, h: f64) -> f64 {
    let (mut norm, mut s, mut k, mut ss, mut sk) = (own_weight, 0.0, 0.0, 0.0, 0.0);
    for (w, there) in neighbors {
        let (ds, dk) = (there.arc_length - here.arc_length, there.mean - here.mean);
        norm += w;
        s += w * ds;
        k += w * dk;
        ss += w * ds * ds;
        sk += w * ds * dk;
    }
    let (s, k) = (s / norm, k / norm);
    let slope = (sk / norm - s * k) / (ss / norm - s * s + LEAST_SPREAD * h * h);
    (here.arc_length * slope).clamp(-LARGEST_CORRECTION / h, LARGEST_CORRECTION / h)
}

/// The curvature without the noise of single fits \[vanCittert1931\]: S κ + g (S κ − S² κ), S the average over fluid particles with a curvature.
///
/// The second term compensates for the attenuation of resolved waves, to fourth order in kh, by S, the fits and the smoothed color. The curvature of an
/// interface at rest is unchanged, also at a wall: `rest(a, b)` in 1/m is the difference at rest of the curvature at a from that at b.
fn smoothed(
    curvature: Vec<f64>,
    Neighborhood { pairs, images }: &Neighborhood,
    rest: &(impl Fn(usize, usize) -> f64 + Sync),
) -> Vec<f64> {
    let average = |mut field: Vec<f64>| {
        for _ in 0..PASSES {
            let at = |a: usize, b: usize| field.get(images.source(b)).map_or(f64::NAN, |kappa| kappa + rest(a, b));
            let mean = |a: usize| average_at(a, pairs, Some(field[a]), |b| at(a, b));
            field = values(field.len(), |a| if field[a].is_nan() { f64::NAN } else { mean(a) });
        }
        field
    };
    let once = average(curvature);
    let twice = average(once.clone());
    once.iter().zip(&twice).map(|(once, twice)| once + DECONVOLUTION * (once - twice)).collect()
}

/// Σ_b W κ_b/Σ_b W over the neighbors of a with a curvature, and a itself with its `own` κ (1/m) if given. NaN if there is none.
fn average_at(a: usize, pairs: &Pairs, own: Option<f64>, curvature: impl Fn(usize) -> f64) -> f64 {
    let own = own.map_or((0.0, 0.0), |kappa| (pairs.w_self * kappa, pairs.w_self));
    let (sum, norm) = pairs.of(a).fold(own, |(sum, norm), ab| {
        let kappa = curvature(ab.b);
        if kappa.is_nan() { (sum, norm) } else { (sum + ab.w * kappa, norm + ab.w) }
    });
    if norm > 0.0 { sum / norm } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean over the arc length s of the curvature 3 + 2s.
    fn constrained(arc_length: f64) -> WallFit {
        WallFit { mean: 3.0 + arc_length, arc_length, share: 1.0, side: 1.0, line: Vec2::zeros() }
    }

    #[test]
    fn the_curvature_at_the_end_of_a_way_is_found_from_the_means_of_ways() {
        const H: f64 = 0.15;
        for arc_length in [0.0, 0.1, 0.3] {
            let neighbors = (0..10).map(|i| (1.0, constrained(0.05 * f64::from(i))));
            let more = turned(constrained(arc_length), neighbors, 1.0, H);
            assert!((more - arc_length).abs() < 0.03 * arc_length + 1e-12, "{more} at {arc_length}");
        }
        // No correction at rest; a single arc length has no slope.
        let rest = |arc_length: f64| WallFit { mean: 3.0, ..constrained(arc_length) };
        assert_eq!(turned(rest(0.2), (0..10).map(|i| (1.0, rest(0.05 * f64::from(i)))), 1.0, H), 0.0);
        assert_eq!(turned(constrained(0.2), std::iter::empty(), 1.0, H), 0.0);
    }
}
