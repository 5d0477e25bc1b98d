//! Implicit viscosity, which does not limit the time step.
//!
//! The forces F(v) at the beginning of the step, including the previous pressure, give the change δ of the velocity, (m + θ Δt K) δ = Δt F(v), with the viscous
//! matrix K: for F = −K v this is the θ method. Parts of the viscous force that are not in K (the transposed stress, images in Szewc's form) are explicit: with
//! the transposed stress at most 2K acts, which remains stable. Where F = 0, δ = 0: rest and steady flow do not depend on the time step.
//!
//! θ = 1/(1 − e^{−z}) − 1/z with the largest rate z/Δt [Liniger1970] is exact for a mode of that rate, gives the trapezoidal rule for short
//! steps and backward Euler for long ones, and no mode changes sign.

use std::sync::Arc;

use rayon::prelude::*;

use crate::conjugate_gradients::{Convergence, SymmetricMatrix, Tolerance, conjugate_gradients};
use crate::fields::Fields;
use crate::images::{Field, Images};
use crate::pairs::{Pair, Pairs, split_rows};
use crate::parallel::{GRAIN, change_each, each, largest, values};
use crate::particles::{Particles, Phase};
use crate::poisson::{Matrix, Multigrid, weighted_sum};
use crate::terms::transposed_stress::TransposedStress;
use crate::view::View;
use meniscus_case::ViscousTerm;
use meniscus_core::math::{Mat2, Vec2};

/// Largest relative residual of the change of the velocity.
const RESIDUAL: f64 = 1e-6;

/// Maximum number of iterations; a typical solve takes about ten, with steps a thousand times the explicit limit some hundreds.
const ITERATIONS: usize = 2000;

/// Product of θ Δt and the largest rate above which a multigrid preconditioner is faster than a diagonal one.
const STIFF: f64 = 40.0;

/// Product of time step and rate below which θ is computed from its series, whose next term is z³/720.
const SHORT: f64 = 1e-2;

/// K scaled by the masses, m^{-1/2} K m^{-1/2} in 1/s, over fluid particles. Walls and buffers are at rest in it: it acts on changes of the
/// velocity, and their velocities are given.
pub(super) struct ViscousMatrix<'a> {
    pairs: &'a Pairs,
    images: &'a Images,
    /// Whether pair forces are central, along the line of centers.
    is_central: bool,
    /// √m of each fluid particle, m in kg/m.
    root_mass: Vec<f64>,
    /// The negative off-diagonal entry of each pair, 0 where the neighbor is not fluid; for central forces divided by |∇W|².
    coupling: Vec<f32>,
    /// Diagonal blocks.
    diagonal: Vec<Mat2>,
    /// Upper bound of the viscous decay rates in 1/s, by Gershgorin's theorem.
    largest_rate: f64,
    /// Positions in m.
    position: &'a [Vec2],
    /// Phase of each particle: the multigrid keeps fluids of different viscosity apart.
    phase: &'a [Phase],
    /// Spacing of neighboring particles in m.
    spacing: f64,
}

impl View<'_, Fields> {
    /// The viscous matrix at the present positions, stiffer where the transposed `stress` acts.
    pub(super) fn viscous_matrix(&self, stress: Option<&TransposedStress>) -> ViscousMatrix<'_> {
        let (pairs, images, fluids, f) =
            (&self.neighborhood.pairs, &self.neighborhood.images, self.state.particles.fluids, &self.fields.bulk);
        let viscous = self.viscous();
        let has_plates = self.config.method.plates.is_some();
        let is_central = self.config.method.numerics.viscous_term == ViscousTerm::Szewc;
        let root_mass: Vec<f64> = (0..fluids).map(|a| (f.density[a] * f.volume[a]).sqrt()).collect();
        let inverse_root: Vec<f64> = root_mass.iter().map(|root| 1.0 / root).collect();
        let strength = |a: usize, ab: &Pair| {
            if !is_central {
                let stiffer = stress.map_or(1.0, |stress| stress.stiffness(a, ab.b));
                return stiffer * viscous.coupling(a, ab);
            }
            let steepness = ab.grad_w.norm_squared();
            // At the edge of the support the quotient exceeds single precision; the force of such a pair vanishes.
            let has_direction = steepness > f64::from(f32::MIN_POSITIVE);
            if has_direction { viscous.central_coupling(a, ab) / steepness } else { 0.0 }
        };
        let block = |a: usize, ab: &Pair, strength: f64| {
            if !is_central {
                return strength * self.stretch_matrix(a, ab.b, |stretch| stretch);
            }
            let for_image = if ab.b < self.state.particles.len() { 1.0 } else { 2.0 };
            // Exact for equal stretches along and across the wall, and symmetric in any case.
            let along = self.stretch_matrix(a, ab.b, f64::sqrt) * ab.grad_w;
            for_image * strength * along * along.transpose()
        };
        let starts = &pairs.start[..=fluids];
        let (mut coupling, mut diagonal) = (vec![0.0_f32; starts[fluids]], vec![Mat2::zeros(); fluids]);
        let parts: Vec<_> = split_rows(starts, &mut coupling).zip(diagonal.chunks_mut(GRAIN)).collect();
        parts.into_par_iter().for_each(|((rows, coupling), diagonal)| {
            let mut couplings = coupling.iter_mut();
            for (a, diagonal) in rows.zip(diagonal) {
                // The isotropic part: all fluid in Morris's form.
                let mut between = 0.0;
                for (ab, coupling) in pairs.of(a).zip(&mut couplings) {
                    let (b, strength) = (images.source(ab.b), strength(a, &ab));
                    // The image of a central pair acts along another line, so that its blocks would not be symmetric: it is lumped into the diagonal.
                    let is_coupled = b < fluids && (ab.b == b || !is_central);
                    if is_coupled {
                        *coupling = (strength * (inverse_root[a] * inverse_root[b])) as f32;
                        // With the coupling as rounded in storage the force at uniform velocity vanishes to the last bit.
                        let stored = f64::from(*coupling) * (root_mass[a] * root_mass[b]);
                        if is_central {
                            *diagonal += block(a, &ab, stored);
                        } else {
                            between += stored;
                        }
                    } else {
                        *diagonal += block(a, &ab, strength);
                    }
                }
                *diagonal += Mat2::from_diagonal_element(between);
                *diagonal /= root_mass[a] * root_mass[a];
                if has_plates {
                    *diagonal += Mat2::from_diagonal_element(self.plate_rate(a));
                }
            }
        });
        let rate = |a: usize| 2.0 * diagonal[a].symmetric_eigenvalues().max();
        let largest_rate = largest(fluids, rate).map_or(0.0, |l| l.1);
        let (Particles { position, phase, .. }, spacing) = (&self.state.particles, self.config.method.spacing);
        let (position, phase) = (&position[..fluids], &phase[..fluids]);
        ViscousMatrix {
            pairs,
            images,
            is_central,
            root_mass,
            coupling,
            diagonal,
            largest_rate,
            position,
            phase,
            spacing,
        }
    }
}

impl ViscousMatrix<'_> {
    /// The fraction of a step of length `dt` (s) beyond the longest one that is stable explicitly; 0 for shorter ones.
    pub(super) fn excess(&self, dt: f64) -> f64 {
        (1.0 - 2.0 / (dt * self.largest_rate)).max(0.0)
    }

    /// θ Δt in s for a step of length `dt` (s).
    pub(super) fn weight(&self, dt: f64) -> f64 {
        dt * theta(dt * self.largest_rate)
    }

    /// The change of the velocity in m/s over `dt` (s) under the `acceleration` (m/s²) of the forces at the beginning of the step \[Liniger1970\].
    pub(super) fn change(&self, acceleration: &[Vec2], dt: f64) -> (Vec<Vec2>, Convergence) {
        let weight = self.weight(dt);
        let fluids = self.diagonal.len();
        let diagonal = values(fluids, |a| Mat2::identity() + weight * self.diagonal[a]);
        let inverse = values(fluids, |a| diagonal[a].try_inverse().unwrap_or_else(Mat2::identity));
        let system = System { viscous: self, weight, diagonal };
        let b = values(fluids, |a| dt * self.root_mass[a] * acceleration[a]);
        let mut change = vec![Vec2::zeros(); fluids];
        let tolerance = Tolerance { residual: RESIDUAL, iterations: ITERATIONS };
        let found = if weight * self.largest_rate > STIFF && !self.is_central {
            let preconditioner = Preconditioner::new(self, weight);
            conjugate_gradients(&system, &b, &mut change, tolerance, |r, z| preconditioner.apply(r, z))
        } else {
            conjugate_gradients(&system, &b, &mut change, tolerance, |r, z| each(z, |a| inverse[a] * r[a]))
        };
        change.iter_mut().zip(&self.root_mass).for_each(|(change, root)| *change /= *root);
        (change, found)
    }
}

/// The weight of the end of the step \[Liniger1970\], from 1/2 for short to 1 for long steps. `z` is the time step times the largest rate.
fn theta(z: f64) -> f64 {
    if z < SHORT { 0.5 + z / 12.0 } else { 1.0 / (1.0 - (-z).exp()) - 1.0 / z }
}

/// A multigrid cycle on m + θ Δt K with each diagonal block replaced by half its trace (near walls the two components are stretched
/// differently), and without the couplings of images.
struct Preconditioner<'a> {
    root_mass: &'a [f64],
    matrix: Matrix,
    multigrid: Multigrid,
}

impl<'a> Preconditioner<'a> {
    fn new(viscous: &'a ViscousMatrix, weight: f64) -> Self {
        let (pairs, root_mass) = (viscous.pairs, &viscous.root_mass);
        let fluids = root_mass.len();
        let start = pairs.start[..=fluids].to_vec();
        let mut column = vec![0; start[fluids]];
        let mut coupling = vec![0.0; start[fluids]];
        let parts: Vec<_> = split_rows(&start, &mut column).zip(split_rows(&start, &mut coupling)).collect();
        parts.into_par_iter().for_each(|((rows, columns), (_, couplings))| {
            let mut entries = columns.iter_mut().zip(couplings);
            for a in rows {
                for (k, (column, coupling)) in pairs.row(a).zip(&mut entries) {
                    let b = pairs.b[k] as usize;
                    // A zero entry on the diagonal stands for a neighbor that is not fluid.
                    let (b, value) = if b < fluids { (b, viscous.coupling[k]) } else { (a, 0.0) };
                    *column = b as u32;
                    *coupling = (weight * root_mass[a] * root_mass[b] * f64::from(value)) as f32;
                }
            }
        });
        let diagonal =
            values(fluids, |a| root_mass[a] * root_mass[a] * (1.0 + 0.5 * weight * viscous.diagonal[a].trace()));
        let matrix = Matrix { start: Arc::new(start), column: Arc::new(column), coupling, diagonal };
        let kind: Vec<u8> = viscous.phase.iter().map(|phase| phase.number() as u8).collect();
        let multigrid = Multigrid::new(&matrix, viscous.position, &kind, viscous.spacing);
        Self { root_mass, matrix, multigrid }
    }

    /// z ≈ (1 + θ Δt m^{-1/2} K m^{-1/2})⁻¹ r.
    fn apply(&self, r: &[Vec2], z: &mut [Vec2]) {
        let right = values(r.len(), |a| self.root_mass[a] * r[a]);
        self.multigrid.precondition(&self.matrix, &right, z);
        change_each(z, |a, z| *z *= self.root_mass[a]);
    }
}

/// 1 + `weight` m^{-1/2} K m^{-1/2} with the weight θ Δt in s.
struct System<'a> {
    viscous: &'a ViscousMatrix<'a>,
    weight: f64,
    /// Diagonal blocks.
    diagonal: Vec<Mat2>,
}

impl System<'_> {
    /// A row of the product with x.
    #[inline]
    fn row(&self, a: usize, x: &Field<Vec2>) -> Vec2 {
        let v = self.viscous;
        let row = v.pairs.row(a);
        let coupling = &v.coupling[row.clone()];
        let coupled: Vec2 = if v.is_central {
            let pairs = v.pairs.of(a).zip(coupling);
            pairs.map(|(ab, coupling)| f64::from(*coupling) * x[ab.b].dot(&ab.grad_w) * ab.grad_w).sum()
        } else {
            weighted_sum(&v.pairs.b[row], coupling, x)
        };
        self.diagonal[a] * x[a] - self.weight * coupled
    }

    /// x over particles and images; zero on walls and buffers.
    fn extended(&self, x: &[Vec2]) -> Field<Vec2> {
        self.viscous.images.velocity_field(x.to_vec())
    }
}

impl SymmetricMatrix<Vec2> for System<'_> {
    fn apply(&self, x: &[Vec2], y: &mut [Vec2]) {
        let x = self.extended(x);
        each(y, |a| self.row(a, &x));
    }

    fn residual(&self, b: &[Vec2], x: &[Vec2], r: &mut [Vec2]) {
        let x = self.extended(x);
        each(r, |a| b[a] - self.row(a, &x));
    }
}
