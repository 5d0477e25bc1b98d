//! The divergence of the transposed part of the viscous stress, ∇·(μ (∇v)ᵀ), which the form of Morris et al. 1997 lacks.
//!
//! With ∇·v = 0 it vanishes for uniform viscosity, so that only the excess Δμ over the smaller viscosity of both fluids counts: the stress is
//! nonzero in the more viscous fluid only. It derives from a dissipation,
//!
//! P_a = Δμ_a (tr M D:D + (1 − tr M/2) (D:A)² − tr(G M Gᵀ)), with the velocity gradient G within the fluid, D = (G + Gᵀ)/2, and the moment M of the
//! neighbors that are not of the other fluid, 1 if these are all around. A has the principal directions of M and the eigenvalues 1 and −1: D:A is
//! twice the stretching along the interface, which neighbors on one side of it determine fully.
//!
//! This is 2Δμ D:D minus Δμ ∇v:∇v of Morris's form. G fits the velocity differences with the weights of that form, so that away from walls
//! the sum of both dissipates for any velocities, and not at all in rigid rotation. The sum of the forces vanishes. Where the stress ends at
//! the other fluid, it supports the step of 2μ D·n there; on walls it exerts no force.

use crate::pairs::{Pair, Pairs};
use crate::parallel::values;
use meniscus_core::math::{Mat2, Vec2};

/// Regularization: gradients along a direction with a smaller moment of the neighbors are damped, and so are the principal directions of moments
/// whose principal values differ by less.
const LEAST_MOMENT: f64 = 0.03;

/// Largest stiffness, that of a row of particles.
const LARGEST_STIFFNESS: f64 = 10.0;

/// The transposed stress of one arrangement of particles; slices over particles.
pub struct TransposedStress<'a> {
    pairs: &'a Pairs,
    /// Volume V in m².
    volume: &'a [f64],
    /// Dynamic viscosity μ in Pa s; 0 on walls.
    viscosity: &'a [f64],
    /// The smaller viscosity of both fluids in Pa s.
    least: f64,
    /// The neighbors of each moving particle.
    around: Vec<Around>,
}

/// The neighbors of a particle of the more viscous fluid, by their moment −Σ_b V_b ∇_a W_ab ⊗ ∇_a W_ab |r_ab|²/(r_ab·∇_a W_ab).
#[derive(Clone, Copy)]
struct Around {
    /// M_a: moment of all neighbors not of the other fluid.
    moment: Mat2,
    /// A_a.
    directions: Mat2,
    /// Inverse of the moment of the neighbors of the same fluid.
    inverse: Mat2,
    /// Factor on Morris's form for which it is at least half of the sum of both forms.
    stiffness: f64,
}

impl<'a> TransposedStress<'a> {
    /// The stress among the first `moving` particles, `None` if both viscosities are equal.
    pub fn new(
        pairs: &'a Pairs,
        volume: &'a [f64],
        viscosity: &'a [f64],
        moving: usize,
        viscosities: [f64; 2],
    ) -> Option<Self> {
        let [one, other] = viscosities;
        if one == other {
            return None;
        }
        let least = one.min(other);
        let mut stress = Self { pairs, volume, viscosity, least, around: Vec::new() };
        stress.around = values(moving, |a| {
            let (mut same, mut others) = (Mat2::zeros(), Mat2::zeros());
            for ab in stress.neighbors(a) {
                let sum = if ab.b < moving { &mut same } else { &mut others };
                *sum += ab.grad_w * (ab.grad_w.transpose() * (-volume[ab.b] / ab.slope));
            }
            Around::new(same, others)
        });
        Some(stress)
    }

    /// Factor on the pair a, b of Morris's form for which this form is at least half of the sum of both.
    pub(crate) fn stiffness(&self, a: usize, b: usize) -> f64 {
        let moving = self.around.len();
        let is_same_fluid = a < moving && b < moving && self.is_more_viscous(a) && self.is_more_viscous(b);
        if is_same_fluid { 0.5 * (self.around[a].stiffness + self.around[b].stiffness) } else { 1.0 }
    }

    /// V_a Σ_b V_b (S_a + S_b)·∇_a W_ab in N/m, over neighbors of the same fluid: the force on each of the first `count` particles. `velocity`
    /// in m/s of all moving particles.
    pub fn force(&self, velocity: &[Vec2], count: usize) -> Vec<Vec2> {
        let moving = self.around.len();
        let stress = values(moving, |a| self.stress(a, velocity));
        values(count, |a| {
            self.same_fluid(a, moving)
                .map(|ab| self.volume[a] * self.volume[ab.b] * ((stress[a] + stress[ab.b]) * ab.grad_w))
                .sum()
        })
    }

    /// S_a = Δμ_a (tr M D + (1 − tr M/2) (D:A) A − G M) N⁻¹ in Pa, N the moment of the same fluid: half of the derivative of P_a by G.
    /// Equal to Δμ_a (∇v)ᵀ if neighbors are all around.
    fn stress(&self, a: usize, velocity: &[Vec2]) -> Mat2 {
        if !self.is_more_viscous(a) {
            return Mat2::zeros();
        }
        let Around { moment, directions, inverse, .. } = self.around[a];
        let difference = |ab: Pair| (velocity[ab.b] - velocity[a]) * (self.volume[ab.b] * ab.grad_w).transpose();
        let gradient = self.same_fluid(a, self.around.len()).map(difference).sum::<Mat2>() * inverse;
        let rate = 0.5 * (gradient + gradient.transpose());
        let trace = moment.trace();
        let along = (1.0 - 0.5 * trace).max(0.0) * rate.dot(&directions) * directions;
        (self.viscosity[a] - self.least) * (trace * rate + along - gradient * moment) * inverse
    }

    /// Whether the particle is of the more viscous fluid.
    fn is_more_viscous(&self, a: usize) -> bool {
        self.viscosity[a] > self.least
    }

    /// The neighbors in the same fluid of a particle of the more viscous fluid; images behind mirrors count as walls.
    fn same_fluid(&self, a: usize, moving: usize) -> impl Iterator<Item = Pair> + '_ {
        self.neighbors(a).filter(move |ab| ab.b < moving)
    }

    /// The neighbors of a particle of the more viscous fluid that are not of the other fluid.
    fn neighbors(&self, a: usize) -> impl Iterator<Item = Pair> + '_ {
        let pairs = self.is_more_viscous(a).then(|| self.pairs.of(a)).into_iter().flatten();
        let is_of_other = |b: usize| self.viscosity[b] > 0.0 && !self.is_more_viscous(b);
        // At the edge of the support the slope is zero in single precision.
        pairs.filter(move |ab| !is_of_other(ab.b) && ab.slope < 0.0)
    }
}

impl Around {
    /// From the moments of the same fluid and of walls and images.
    fn new(same: Mat2, others: Mat2) -> Self {
        let moment = same + others;
        let square = same * same + Mat2::from_diagonal_element(LEAST_MOMENT * LEAST_MOMENT);
        let inverse = same * square.try_inverse().unwrap_or_else(Mat2::zeros);
        let deviator = moment - Mat2::from_diagonal_element(0.5 * moment.trace());
        let directions = deviator * (2.0 / (deviator.norm_squared() + LEAST_MOMENT * LEAST_MOMENT)).sqrt();
        // P is at most 2 Δμ G:G minus the dissipation of Morris's form within the fluid, which is at least its smallest principal value times G:G.
        let smallest = same.symmetric_eigenvalues().min();
        let stiffness = if smallest > 1.0 / LARGEST_STIFFNESS { (1.0 / smallest).max(1.0) } else { LARGEST_STIFFNESS };
        Self { moment, directions, inverse, stiffness }
    }
}
