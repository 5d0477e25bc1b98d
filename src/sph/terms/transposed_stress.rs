//! The divergence of the transposed part of the viscous stress, ∇·(μ (∇v)ᵀ), which the form of Morris et al. 1997 lacks.
//!
//! With ∇·v = 0 a viscosity that is the same everywhere has none, so that μ is counted from the smaller viscosity of both fluids: the stress
//! stands in the more viscous fluid alone. It derives from a dissipation,
//!
//! P_a = Δμ_a (tr M D:D + (1 − tr M/2) (D:A)² − tr(G M Gᵀ)), with the gradient G of the fluid itself, D = (G + Gᵀ)/2, and the moment M of the neighbors
//! that are not of the other fluid, 1 where these are all around. A has the principal directions of M and the values 1 and −1: D:A is twice the
//! stretching along the interface, which neighbors on one side of it tell in full.
//!
//! This is 2Δμ D:D less Δμ ∇v:∇v, which Morris's form has. G fits the velocity differences in the weights of that form, so that away from walls
//! both together dissipate at any velocities, and nothing where the fluid turns as a whole. The sum of the forces vanishes. Where the
//! stress ends, at the other fluid, it bears the step of 2μ D·n there; at walls, along which it has no part, it ends without a force.

use crate::math::{Mat2, Vec2};
use crate::sph::pairs::{Pair, Pairs};
use crate::sph::parallel::values;

/// A gradient along which the neighbors have a smaller moment than this counts less and less; moments whose principal values differ by less have
/// less and less of a direction.
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
    /// M_a: that of all but the other fluid.
    moment: Mat2,
    /// A_a.
    directions: Mat2,
    /// The inverse of that of the same fluid.
    inverse: Mat2,
    /// How many times as stiff Morris's form must be to outweigh half of both forms.
    stiffness: f64,
}

impl<'a> TransposedStress<'a> {
    /// The stress among the first `moving` particles, none where there is one viscosity.
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

    /// How many times as stiff the pair a, b of Morris's form must be, so that the form with it is at least half of both together.
    pub(crate) fn stiffness(&self, a: usize, b: usize) -> f64 {
        let moving = self.around.len();
        let is_same_fluid = a < moving && b < moving && self.is_more_viscous(a) && self.is_more_viscous(b);
        if is_same_fluid { 0.5 * (self.around[a].stiffness + self.around[b].stiffness) } else { 1.0 }
    }

    /// V_a Σ_b V_b (S_a + S_b)·∇_a W_ab in N/m, over neighbors of the same fluid: the force on each of the first `count` particles. `velocity`
    /// in m/s is that of all moving ones.
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
    /// Δμ_a (∇v)ᵀ where neighbors are all around.
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

    /// The neighbors of a particle of the more viscous fluid that are of this fluid too; images behind mirrors count as walls.
    fn same_fluid(&self, a: usize, moving: usize) -> impl Iterator<Item = Pair> + '_ {
        self.neighbors(a).filter(move |ab| ab.b < moving)
    }

    /// The neighbors of a particle of the more viscous fluid that are not of the other fluid.
    fn neighbors(&self, a: usize) -> impl Iterator<Item = Pair> + '_ {
        let pairs = self.is_more_viscous(a).then(|| self.pairs.of(a)).into_iter().flatten();
        let is_of_other = |b: usize| self.viscosity[b] > 0.0 && !self.is_more_viscous(b);
        // At the edge of the support single precision has no slope any more.
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
        // P is at most 2 Δμ G:G less what Morris's form has between the same fluid, and that is no less than its smallest principal value times G:G.
        let smallest = same.symmetric_eigenvalues().min();
        let stiffness = if smallest > 1.0 / LARGEST_STIFFNESS { (1.0 / smallest).max(1.0) } else { LARGEST_STIFFNESS };
        Self { moment, directions, inverse, stiffness }
    }
}
