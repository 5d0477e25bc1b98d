//! The implicit finite-difference method for h̄ on a periodic uniform grid [Pang2022, Eqs. 76-83].
//!
//! Backward Euler: with H = (1 − α²D₂)², h = Hv, k = D₃v + ξ²D₁v, a step solves H(v − h̄ⁿ) + Δt D₁(h v² k) = 0 for v. This is the
//! paper's equation times H, which commutes with the differences; it makes the Jacobian sparse. ξ² is taken at the new time:
//! its derivative is a matrix of rank one, added by the Sherman-Morrison formula. Order 2 in space, 1 in time.

use super::backward_euler::Balance;
use super::droplet::{Droplet, particles};
use super::grid::Grid;
use super::sparse::{Factors, Pattern, TooLarge};
use meniscus_case::film::FilmWeights;

/// A negative height beyond this fraction of the largest is a spurious root, not rounding.
const NEGATIVE: f64 = -1.0e-6;
/// Half-width of the stencil of a balance in nodes.
const REACH: usize = 3;
/// Below this fraction of the largest h the velocity is set to zero.
const BARE: f64 = 1.0e-3;

/// Periodic grid and parameters of the equation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// First node; x = 0 should be a node.
    pub from: f64,
    /// Number of nodes.
    pub count: usize,
    /// Distance of nodes.
    pub spacing: f64,
    /// Filter length α.
    pub alpha: f64,
    /// χ, 0 for complete wetting.
    pub wetting: f64,
    /// Bond number ρgL²/γ.
    pub bond: f64,
}

/// The nodes and the equation of the implicit finite-difference method [Pang2022, Eqs. 76-83].
#[derive(Debug, Clone)]
pub struct Ring {
    line: Line,
    /// Mass Σ h Δx.
    area: f64,
    /// The factors of H.
    smoothing: Factors,
    /// The sparsity pattern of the Jacobians.
    pattern: Pattern,
}

impl Ring {
    /// Droplets on a periodic grid with their smoothed heights; `weights` selects cell averages or the values at the nodes.
    pub fn new(line: Line, droplets: &[Droplet], weights: FilmWeights) -> Result<(Self, Vec<f64>), TooLarge> {
        let Line { from, count, spacing, alpha, .. } = line;
        let mut sharp = vec![0.0; count];
        let masses = particles(droplets, spacing, weights);
        for (x, weight) in masses.x.iter().zip(&masses.weight) {
            let node = ((x - from) / spacing).round();
            if node >= 0.0 && (node as usize) < count {
                sharp[node as usize] += weight / spacing;
            }
        }
        let stencil = smoothing_stencil(alpha, spacing);
        let smoothing = Pattern::new(count, (0..count).flat_map(|row| around(row, 2, count)))?
            .factor(&stencil.repeat(count))
            // H is positive definite, so its factors exist.
            .ok_or(TooLarge(count))?;
        let pattern = Pattern::new(count, (0..count).flat_map(|row| around(row, REACH, count)))?;
        let mut height = sharp.clone();
        smoothing.solve(&mut height);
        Ok((Self { line, area: spacing * sharp.iter().sum::<f64>(), smoothing, pattern }, height))
    }

    fn smoothing(&self) -> [f64; 5] {
        smoothing_stencil(self.line.alpha, self.line.spacing)
    }

    fn first(&self) -> [f64; 5] {
        let s = 0.5 / self.line.spacing;
        [0.0, -s, 0.0, s, 0.0]
    }

    fn second(&self) -> [f64; 5] {
        let s = 1.0 / (self.line.spacing * self.line.spacing);
        [0.0, s, -2.0 * s, s, 0.0]
    }

    fn third(&self) -> [f64; 5] {
        let s = 0.5 / self.line.spacing.powi(3);
        [-s, 2.0 * s, 0.0, -2.0 * s, s]
    }

    /// Applies a stencil from node −2 to node 2, periodically.
    fn apply(&self, v: &[f64], stencil: &[f64; 5]) -> Vec<f64> {
        let n = v.len();
        let at = |i: usize, offset: usize| v[(i + n + offset - 2) % n];
        (0..n).map(|i| stencil.iter().enumerate().map(|(offset, value)| value * at(i, offset)).sum()).collect()
    }

    fn overlap(&self, h: &[f64], v: &[f64]) -> f64 {
        self.line.spacing * h.iter().zip(v).map(|(h, v)| h * v).sum::<f64>()
    }

    fn state(&self, v: &[f64]) -> State {
        let sharp = self.apply(v, &self.smoothing());
        let overlap = self.overlap(&sharp, v);
        let xi_squared =
            if self.line.wetting == 0.0 { 0.0 } else { 2.0 * self.line.wetting * (self.area / overlap).powi(2) };
        let pull = xi_squared - self.line.bond;
        let slope = self.apply(v, &self.first());
        let third = self.apply(v, &self.third());
        let drive = third.iter().zip(&slope).map(|(t, s)| t + pull * s).collect();
        State { sharp, slope, drive, overlap, xi_squared }
    }
}

impl Balance for Ring {
    /// G = H(v − h̄ⁿ) + Δt D₁(h v² k).
    fn residual(&self, v: &[f64], old: &[f64], dt: f64) -> Vec<f64> {
        let state = self.state(v);
        let change: Vec<f64> = v.iter().zip(old).map(|(v, old)| v - old).collect();
        let mut residual = self.apply(&change, &self.smoothing());
        let flux: Vec<f64> = (0..v.len()).map(|i| state.sharp[i] * v[i] * v[i] * state.drive[i]).collect();
        let outflow = self.apply(&flux, &self.first());
        residual.iter_mut().zip(&outflow).for_each(|(residual, outflow)| *residual += dt * outflow);
        residual
    }

    fn norm(&self, v: &[f64]) -> f64 {
        (self.line.spacing * v.iter().map(|v| v * v).sum::<f64>()).sqrt()
    }

    /// Norm of the paper's residual F = H⁻¹ G.
    fn size(&self, residual: &[f64]) -> f64 {
        let mut smoothed = residual.to_vec();
        self.smoothing.solve(&mut smoothed);
        self.norm(&smoothed)
    }

    /// Terms of the flux by magnitude: h, whose differences cancel, and the drive, whose derivatives cancel at rest.
    fn rounding(&self, v: &[f64], dt: f64) -> f64 {
        let sizes: Vec<f64> = v.iter().map(|v| v.abs()).collect();
        let sum = |stencil: [f64; 5]| self.apply(&sizes, &stencil.map(f64::abs));
        let (sharp, third, slope) = (sum(self.smoothing()), sum(self.third()), sum(self.first()));
        let state = self.state(v);
        let pull = (state.xi_squared - self.line.bond).abs();
        let flux = |i: usize| {
            let drive = third[i] + pull * slope[i];
            v[i] * v[i] * (sharp[i] * state.drive[i].abs() + state.sharp[i].abs() * drive)
        };
        let flux: Vec<f64> = (0..v.len()).map(flux).collect();
        let outflow = self.apply(&flux, &self.first().map(f64::abs));
        let terms: Vec<f64> = sizes.iter().zip(&outflow).map(|(v, outflow)| v + dt * outflow).collect();
        f64::EPSILON * self.size(&terms)
    }

    fn jacobian(&self, v: &[f64], dt: f64) -> Option<Factors> {
        let n = v.len();
        let state = self.state(v);
        let smoothing = self.smoothing();
        let pull = state.xi_squared - self.line.bond;
        let (first, third) = (self.first(), self.third());
        // Derivatives of the flux at a node with respect to the heights from two nodes before to two after.
        let flux = |node: usize| -> [f64; 5] {
            let (h, k, height) = (state.sharp[node], state.drive[node], v[node]);
            let square = height * height;
            let mut row = [0.0; 5];
            for (offset, value) in row.iter_mut().enumerate() {
                *value = square * k * smoothing[offset] + h * square * (third[offset] + pull * first[offset]);
            }
            row[2] += 2.0 * h * height * k;
            row
        };
        let fluxes: Vec<[f64; 5]> = (0..n).map(flux).collect();
        let share = 0.5 * dt / self.line.spacing;
        let mut values = Vec::with_capacity(n * (2 * REACH + 1));
        for node in 0..n {
            let mut row = [0.0; 2 * REACH + 1];
            for offset in 0..5 {
                row[offset + 1] += smoothing[offset];
                row[offset + 2] += share * fluxes[(node + 1) % n][offset];
                row[offset] -= share * fluxes[(node + n - 1) % n][offset];
            }
            values.extend(row);
        }
        let factors = self.pattern.factor(&values)?;
        if state.xi_squared == 0.0 {
            return Some(factors);
        }
        let flux: Vec<f64> = (0..n).map(|i| state.sharp[i] * v[i] * v[i] * state.slope[i]).collect();
        let column = self.apply(&flux, &first).iter().map(|value| dt * value).collect();
        let scale = -4.0 * state.xi_squared * self.line.spacing / state.overlap;
        factors.with_rank_one(column, state.sharp.iter().map(|h| scale * h).collect())
    }

    fn acceptable(&self, v: &[f64]) -> bool {
        let largest = v.iter().copied().fold(0.0, f64::max);
        v.iter().all(|&v| v > NEGATIVE * largest)
    }
}

impl Grid for Ring {
    fn nodes(&self) -> Vec<f64> {
        (0..self.line.count).map(|i| self.line.from + i as f64 * self.line.spacing).collect()
    }

    fn sizes(&self) -> Vec<f64> {
        vec![self.line.spacing; self.line.count]
    }

    fn slope_and_curvature(&self, v: &[f64]) -> [Vec<f64>; 2] {
        [self.apply(v, &self.first()), self.apply(v, &self.second())]
    }

    /// h̄² ∂ₓ(h̄ₓₓ + (ξ² − Bo) h̄).
    fn velocity(&self, v: &[f64]) -> Vec<f64> {
        let state = self.state(v);
        let bare = BARE * state.sharp.iter().copied().fold(0.0, f64::max);
        let speed = |i: usize| v[i].powi(2) * state.drive[i];
        (0..v.len()).map(|i| if state.sharp[i] > bare { speed(i) } else { 0.0 }).collect()
    }

    /// ½ ∫ (hₓ h̄ₓ + Bo h h̄) dx + χA²/⟨h,h̄⟩, with its first term as −½ ∫ h h̄ₓₓ dx.
    fn energy(&self, v: &[f64]) -> f64 {
        let h = self.apply(v, &self.smoothing());
        let curvature = self.apply(v, &self.second());
        let surface: f64 = h.iter().zip(&curvature).map(|(h, c)| h * c).sum::<f64>() * self.line.spacing;
        let overlap = self.overlap(&h, v);
        0.5 * (self.line.bond * overlap - surface) + self.line.wetting * self.area * self.area / overlap
    }
}

/// h, h̄ₓ, k = ∂ₓ(h̄ₓₓ + (ξ² − Bo) h̄), ⟨h,h̄⟩ and ξ² of an iterate.
struct State {
    sharp: Vec<f64>,
    slope: Vec<f64>,
    drive: Vec<f64>,
    overlap: f64,
    xi_squared: f64,
}

/// (1 − α²D₂)² as a stencil.
fn smoothing_stencil(alpha: f64, spacing: f64) -> [f64; 5] {
    let c = (alpha / spacing).powi(2);
    let (far, near) = (c * c, -2.0 * c - 4.0 * c * c);
    [far, near, 1.0 + 4.0 * c + 6.0 * c * c, near, far]
}

/// Row and column of the entries of a row, from `reach` nodes before it to `reach` after.
fn around(row: usize, reach: usize, count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..=2 * reach).map(move |offset| (row, (row + count + offset - reach) % count))
}

#[cfg(test)]
mod tests {
    use super::super::grid::error_of_jacobian;
    use super::*;

    /// [Pang2022, Eqs. 76-83]
    #[test]
    fn newton_steps_use_the_jacobian_of_the_residual() {
        let line = Line { from: -1.0, count: 80, spacing: 0.025, alpha: 0.05, wetting: 1.16, bond: 3.0 };
        let droplet = Droplet { area: 1.0, half_width: 0.5, center: 0.0 };
        let (ring, old) = Ring::new(line, &[droplet], FilmWeights::Cell).unwrap();
        let error = error_of_jacobian(&ring, &old);
        assert!(error < 1.0e-6, "{error}");
    }
}
