//! The implicit finite-difference method for h̄ on a periodic uniform grid [Pang2022, Eqs. 76-83].
//!
//! Backward Euler: with H = (1 − α²D₂)², h = Hv, k = D₃v + ξ²D₁v, a step solves H(v − h̄ⁿ) + Δt D₁(h v² k) = 0 for v. This is the
//! paper's equation times H, which commutes with the differences; it makes the Jacobian sparse. ξ² is taken at the new time:
//! its derivative is a matrix of rank one, added by the Sherman-Morrison formula. Order 2 in space, 1 in time. The ring of
//! nodes is folded (0, n−1, 1, n−2, ...), so that the periodic matrix is banded.

use super::backward_euler::{Balance, norm};
use super::banded::Banded;
use super::droplet::{Droplet, WeightRule, particles};
use super::grid::Grid;

/// A height below this share of the largest is a spurious root, not rounding.
const NEGATIVE: f64 = -1.0e-6;
/// Below this share of the largest h there is no film to speak of.
const BARE: f64 = 1.0e-3;
/// Diagonals on each side of the folded matrices.
const FOLDED_PLAIN: usize = 4;
const FOLDED_WIDE: usize = 6;

/// A droplet on a ring of nodes, its equation, and how it is smoothed.
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

/// The nodes and the equation.
#[derive(Debug, Clone)]
pub struct Ring {
    line: Line,
    /// Mass Σ h Δx.
    area: f64,
    /// The factors of H.
    smoothing: Banded,
}

impl Ring {
    /// Droplets on a ring with their smoothed heights; `weights` says whether nodes hold the mean of their cell or the value
    /// at the node.
    #[must_use]
    pub fn new(line: Line, droplets: &[Droplet], weights: WeightRule) -> (Self, Vec<f64>) {
        let Line { from, count, spacing, alpha, .. } = line;
        let mut sharp = vec![0.0; count];
        let masses = particles(droplets, spacing, weights);
        for (x, weight) in masses.x.iter().zip(&masses.weight) {
            let node = ((x - from) / spacing).round();
            if node >= 0.0 && (node as usize) < count {
                sharp[node as usize] += weight / spacing;
            }
        }
        let mut smoothing = Banded::new(count, FOLDED_PLAIN, FOLDED_PLAIN);
        let stencil = smoothing_stencil(alpha, spacing);
        for row in 0..count {
            for (offset, value) in (-2..=2).zip(stencil) {
                smoothing.add(folded(row as i64, count), folded(row as i64 + offset, count), value);
            }
        }
        // H is positive definite, so its factors exist.
        smoothing.factor();
        let ring = Self { line, area: spacing * sharp.iter().sum::<f64>(), smoothing };
        let height = ring.smoothed(&sharp);
        (ring, height)
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

    /// A stencil from node −2 to node 2, on the ring.
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

    /// H⁻¹ v.
    fn smoothed(&self, v: &[f64]) -> Vec<f64> {
        solve_folded(&self.smoothing, v)
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

    /// 2-norm of the paper's residual F = H⁻¹ G.
    fn size(&self, residual: &[f64]) -> f64 {
        norm(&self.smoothed(residual))
    }

    fn newton(&self, v: &[f64], residual: &[f64], dt: f64) -> Option<Vec<f64>> {
        let n = v.len();
        let state = &self.state(v);
        let smoothing = self.smoothing();
        let pull = state.xi_squared - self.line.bond;
        let (first, third) = (self.first(), self.third());
        let mut matrix = Banded::new(n, FOLDED_WIDE, FOLDED_WIDE);
        for (row, &height) in v.iter().enumerate() {
            for (offset, value) in (-2..=2).zip(smoothing) {
                matrix.add(folded(row as i64, n), folded(row as i64 + offset, n), value);
            }
            // The flux of this node enters the balances of its two neighbors.
            let (h, k, square) = (state.sharp[row], state.drive[row], height * height);
            for offset in 0..5 {
                let local = if offset == 2 { 2.0 * h * height * k } else { 0.0 };
                let flux = square * k * smoothing[offset] + h * square * (third[offset] + pull * first[offset]) + local;
                let column = folded(row as i64 + offset as i64 - 2, n);
                let share = 0.5 * dt / self.line.spacing * flux;
                matrix.add(folded(row as i64 - 1, n), column, share);
                matrix.add(folded(row as i64 + 1, n), column, -share);
            }
        }
        if !matrix.factor() {
            return None;
        }
        let mut change = solve_folded(&matrix, residual);
        if state.xi_squared > 0.0 {
            let flux: Vec<f64> = (0..n).map(|i| state.sharp[i] * v[i] * v[i] * state.slope[i]).collect();
            let column: Vec<f64> = self.apply(&flux, &first).iter().map(|value| dt * value).collect();
            let solved = solve_folded(&matrix, &column);
            let scale = -4.0 * state.xi_squared * self.line.spacing / state.overlap;
            let row = |x: &[f64]| scale * state.sharp.iter().zip(x).map(|(h, x)| h * x).sum::<f64>();
            let share = row(&change) / (1.0 + row(&solved));
            change.iter_mut().zip(&solved).for_each(|(change, solved)| *change -= share * solved);
        }
        change.iter().all(|c| c.is_finite()).then_some(change)
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

/// h, h̄ₓ, k = ∂ₓ(h̄ₓₓ + (ξ² − Bo) h̄), ⟨h,h̄⟩ and ξ² of a trial.
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

/// Place of a node in the folded ring: neighbors are at most two apart.
fn folded(node: i64, count: usize) -> usize {
    let node = node.rem_euclid(count as i64) as usize;
    if 2 * node < count { 2 * node } else { 2 * (count - 1 - node) + 1 }
}

fn solve_folded(matrix: &Banded, v: &[f64]) -> Vec<f64> {
    let n = v.len();
    let mut b = vec![0.0; n];
    for (node, value) in v.iter().enumerate() {
        b[folded(node as i64, n)] = *value;
    }
    matrix.solve(&mut b);
    (0..n).map(|node| b[folded(node as i64, n)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folding_a_ring_keeps_neighbors_within_two_places() {
        for count in [8, 9, 20, 21] {
            let mut seen: Vec<usize> = (0..count as i64).map(|node| folded(node, count)).collect();
            for offset in 1..=3 {
                for node in 0..count as i64 {
                    let apart = folded(node, count).abs_diff(folded(node + offset, count));
                    assert!(apart <= 2 * offset as usize, "{count} {node} {offset}: {apart}");
                }
            }
            seen.sort_unstable();
            assert!(seen.into_iter().eq(0..count));
        }
    }

    #[test]
    fn newton_steps_use_the_jacobian_of_the_residual() {
        let line = Line { from: -1.0, count: 80, spacing: 0.025, alpha: 0.05, wetting: 1.16, bond: 3.0 };
        let droplet = Droplet { area: 1.0, half_width: 0.5, center: 0.0 };
        let (ring, old) = Ring::new(line, &[droplet], WeightRule::Cell);
        let v: Vec<f64> = ring.nodes().iter().map(|x| 0.4 + 0.3 * (3.0 * x).cos()).collect();
        let change: Vec<f64> = (0..80).map(|i| (1.3 * f64::from(i)).sin()).collect();
        let (dt, tiny) = (1.0e-3, 1.0e-6);
        let at = |sign: f64| {
            let v: Vec<f64> = v.iter().zip(&change).map(|(v, c)| v + sign * tiny * c).collect();
            ring.residual(&v, &old, dt)
        };
        let (up, down) = (at(1.0), at(-1.0));
        let product: Vec<f64> = up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * tiny)).collect();
        let found = ring.newton(&v, &product, dt).unwrap();
        let error = found.iter().zip(&change).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // The central difference is good to rounding over its step.
        assert!(error < 1.0e-6, "{error}");
    }
}
