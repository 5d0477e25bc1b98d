//! The implicit finite-difference method for h̄ on a periodic uniform grid [Pang2022, Eqs. 76-83].
//!
//! Backward Euler: with H = (1 − α²D₂)², h = Hv, k = D₃v + ξ²D₁v, a step solves H(v − h̄ⁿ) + Δt D₁(h v² k) = 0 for v. This is the
//! paper's equation times H, which commutes with the differences; it makes the Jacobian sparse. ξ² is taken at the new time:
//! its derivative is a matrix of rank one, added by the Sherman-Morrison formula. Order 2 in space, 1 in time. The ring of
//! nodes is folded (0, n−1, 1, n−2, ...), so that the periodic matrix is banded.

use super::banded::Banded;
use super::droplet::{Droplet, WeightRule};

/// Newton's method stops below this 2-norm of the paper's residual F [Pang2022, Sect. 6].
pub const RESIDUAL: f64 = 1.0e-9;
/// More iterations than this mean a step that is too large; a healthy one takes 2 to 4.
pub const ITERATIONS: u32 = 12;
/// Shortest share of a Newton step that is tried.
const SHORTEST: f64 = 1.0 / 64.0;
/// A height below this share of the largest is a spurious root, not rounding.
const NEGATIVE: f64 = -1.0e-6;
/// Below this share of the largest h there is no film to speak of.
const BARE: f64 = 1.0e-3;
/// Diagonals on each side of the folded matrices.
const FOLDED_PLAIN: usize = 4;
const FOLDED_WIDE: usize = 6;

/// How long steps are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepRule {
    /// The first step.
    pub first: f64,
    /// Most by which a step may be longer than the one before.
    pub growth: f64,
    /// Longest step over the present time.
    pub share: f64,
    /// Longest step.
    pub longest: f64,
}

impl StepRule {
    /// The rule that starts partially wetting droplets without a rejected step.
    pub const ADAPTIVE: Self = Self { first: 1.0e-6, growth: 1.3, share: 0.02, longest: f64::INFINITY };

    /// Equal steps.
    #[must_use]
    pub fn fixed(dt: f64) -> Self {
        Self { first: dt, growth: 1.0, share: f64::INFINITY, longest: dt }
    }
}

/// A step that Newton's method does not solve, however short.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NotSolved {
    /// The step.
    pub dt: f64,
    /// 2-norm of the residual reached.
    pub residual: f64,
}

/// The grid and the equation.
#[derive(Debug, Clone)]
pub struct FiniteDifferences {
    alpha: f64,
    wetting: f64,
    /// First node.
    origin: f64,
    spacing: f64,
    /// Mass Σ h Δx.
    area: f64,
    /// The factors of H.
    smoothing: Banded,
    /// h̄ at the nodes.
    pub height: Vec<f64>,
    /// Time.
    pub time: f64,
    /// The step to try next.
    pub next: f64,
    rule: StepRule,
    /// Newton iterations so far.
    pub iterations: u64,
    /// Steps tried again with less.
    pub rejected: u64,
}

/// What a droplet spreads on, and how it is smoothed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
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
}

impl FiniteDifferences {
    /// A droplet on a grid; `weights` says whether nodes hold the mean of their cell or the value at the node.
    #[must_use]
    pub fn new(ring: &Ring, droplet: &Droplet, weights: WeightRule, rule: StepRule) -> Self {
        let Ring { from, count, spacing, alpha, wetting } = *ring;
        let mut sharp = vec![0.0; count];
        let masses = droplet.particles(spacing, weights);
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
        let area = spacing * sharp.iter().sum::<f64>();
        let mut grid = Self {
            alpha,
            wetting,
            origin: from,
            spacing,
            area,
            smoothing,
            height: Vec::new(),
            time: 0.0,
            next: rule.first,
            rule,
            iterations: 0,
            rejected: 0,
        };
        grid.height = grid.smoothed(&sharp);
        grid
    }

    /// The nodes.
    #[must_use]
    pub fn nodes(&self) -> Vec<f64> {
        (0..self.height.len()).map(|i| self.origin + i as f64 * self.spacing).collect()
    }

    /// Distance of nodes.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// h̄ at the node nearest to x = 0.
    #[must_use]
    pub fn center_height(&self) -> f64 {
        let node = (-self.origin / self.spacing).round().max(0.0) as usize;
        self.height.get(node).copied().unwrap_or(f64::NAN)
    }

    /// Mass Σ h̄ Δx; steps do not change it.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.spacing * self.height.iter().sum::<f64>()
    }

    /// h, h̄ₓ and h̄ₓₓ at the nodes.
    #[must_use]
    pub fn derivatives(&self) -> [Vec<f64>; 3] {
        let v = &self.height;
        [
            self.apply(v, &smoothing_stencil(self.alpha, self.spacing)),
            self.apply(v, &self.first()),
            self.apply(v, &self.second()),
        ]
    }

    /// Energy ½ ∫ hₓ h̄ₓ dx + χA²/⟨h,h̄⟩, with the first term as −½ ∫ h h̄ₓₓ dx.
    #[must_use]
    pub fn energy(&self) -> f64 {
        let [h, _, curvature] = self.derivatives();
        let surface: f64 = h.iter().zip(&curvature).map(|(h, c)| h * c).sum::<f64>() * self.spacing;
        -0.5 * surface + self.wetting * self.area * self.area / self.overlap(&h, &self.height)
    }

    /// Velocity of the film, h̄² ∂ₓ(h̄ₓₓ + ξ² h̄), at the nodes; 0 beyond the droplet, where nothing is that could move.
    #[must_use]
    pub fn velocity(&self) -> Vec<f64> {
        let state = self.state(&self.height);
        let bare = BARE * state.sharp.iter().copied().fold(0.0, f64::max);
        let speed = |i: usize| self.height[i].powi(2) * state.drive[i];
        (0..self.height.len()).map(|i| if state.sharp[i] > bare { speed(i) } else { 0.0 }).collect()
    }

    /// Does one step that ends at `until` or before; landing there is exact. Gives back its length.
    ///
    /// # Errors
    /// [`NotSolved`]; the state is kept.
    pub fn step(&mut self, until: f64) -> Result<f64, NotSolved> {
        loop {
            let left = until - self.time;
            let longest = self.rule.longest.min((self.rule.share * self.time).max(self.rule.first));
            let wanted = self.next.min(longest);
            // Equal steps miss their end by rounding only: that is no step of its own.
            let lands = wanted * (1.0 + 1.0e-9) >= left;
            // Two halves rather than a step and a sliver.
            let dt = if lands { left } else { wanted.min(0.5 * left).max(0.5 * wanted) };
            match self.solve(dt) {
                Ok(height) => {
                    self.height = height;
                    self.time = if lands { until } else { self.time + dt };
                    self.next = if dt < wanted { wanted } else { self.rule.growth * dt };
                    return Ok(dt);
                }
                Err(residual) => {
                    self.rejected += 1;
                    self.next = 0.3 * dt;
                    if self.next < 1.0e-6 * self.rule.first {
                        return Err(NotSolved { dt, residual });
                    }
                }
            }
        }
    }

    /// Runs to `until`.
    ///
    /// # Errors
    /// [`NotSolved`].
    pub fn run(&mut self, until: f64) -> Result<(), NotSolved> {
        while self.time < until {
            self.step(until)?;
        }
        Ok(())
    }

    /// Newton's method with a line search on the norm of F; the residual reached where it fails.
    fn solve(&mut self, dt: f64) -> Result<Vec<f64>, f64> {
        let mut v = self.height.clone();
        let mut state = self.state(&v);
        let mut residual = self.residual(&v, &state, dt);
        let mut size = self.size(&residual);
        for _ in 0..ITERATIONS {
            if size < RESIDUAL {
                let largest = v.iter().copied().fold(0.0, f64::max);
                return if v.iter().all(|&v| v > NEGATIVE * largest) { Ok(v) } else { Err(size) };
            }
            self.iterations += 1;
            let change = self.newton(&v, &state, &residual, dt).ok_or(size)?;
            let mut share = 1.0;
            loop {
                let trial: Vec<f64> = v.iter().zip(&change).map(|(v, c)| v - share * c).collect();
                let there = self.state(&trial);
                let residual_there = self.residual(&trial, &there, dt);
                let size_there = self.size(&residual_there);
                if size_there < size {
                    (v, state, residual, size) = (trial, there, residual_there, size_there);
                    break;
                }
                share *= 0.5;
                if share < SHORTEST {
                    return Err(size);
                }
            }
        }
        Err(size)
    }

    fn first(&self) -> [f64; 5] {
        let s = 0.5 / self.spacing;
        [0.0, -s, 0.0, s, 0.0]
    }

    fn second(&self) -> [f64; 5] {
        let s = 1.0 / (self.spacing * self.spacing);
        [0.0, s, -2.0 * s, s, 0.0]
    }

    fn third(&self) -> [f64; 5] {
        let s = 0.5 / self.spacing.powi(3);
        [-s, 2.0 * s, 0.0, -2.0 * s, s]
    }

    /// A stencil from node −2 to node 2, on the ring.
    fn apply(&self, v: &[f64], stencil: &[f64; 5]) -> Vec<f64> {
        let n = v.len();
        let at = |i: usize, offset: usize| v[(i + n + offset - 2) % n];
        (0..n).map(|i| stencil.iter().enumerate().map(|(offset, value)| value * at(i, offset)).sum()).collect()
    }

    fn overlap(&self, h: &[f64], v: &[f64]) -> f64 {
        self.spacing * h.iter().zip(v).map(|(h, v)| h * v).sum::<f64>()
    }

    fn state(&self, v: &[f64]) -> State {
        let sharp = self.apply(v, &smoothing_stencil(self.alpha, self.spacing));
        let overlap = self.overlap(&sharp, v);
        let xi_squared = if self.wetting == 0.0 { 0.0 } else { 2.0 * self.wetting * (self.area / overlap).powi(2) };
        let slope = self.apply(v, &self.first());
        let third = self.apply(v, &self.third());
        let drive = third.iter().zip(&slope).map(|(t, s)| t + xi_squared * s).collect();
        State { sharp, slope, drive, overlap, xi_squared }
    }

    /// G = H(v − h̄ⁿ) + Δt D₁(h v² k).
    fn residual(&self, v: &[f64], state: &State, dt: f64) -> Vec<f64> {
        let change: Vec<f64> = v.iter().zip(&self.height).map(|(v, old)| v - old).collect();
        let mut residual = self.apply(&change, &smoothing_stencil(self.alpha, self.spacing));
        let flux: Vec<f64> = (0..v.len()).map(|i| state.sharp[i] * v[i] * v[i] * state.drive[i]).collect();
        let outflow = self.apply(&flux, &self.first());
        residual.iter_mut().zip(&outflow).for_each(|(residual, outflow)| *residual += dt * outflow);
        residual
    }

    /// 2-norm of the paper's residual F = H⁻¹ G.
    fn size(&self, residual: &[f64]) -> f64 {
        self.smoothed(residual).iter().map(|f| f * f).sum::<f64>().sqrt()
    }

    /// H⁻¹ v.
    fn smoothed(&self, v: &[f64]) -> Vec<f64> {
        solve_folded(&self.smoothing, v)
    }

    /// The Newton step J⁻¹ G.
    fn newton(&self, v: &[f64], state: &State, residual: &[f64], dt: f64) -> Option<Vec<f64>> {
        let n = v.len();
        let smoothing = smoothing_stencil(self.alpha, self.spacing);
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
                let flux = square * k * smoothing[offset]
                    + h * square * (third[offset] + state.xi_squared * first[offset])
                    + local;
                let column = folded(row as i64 + offset as i64 - 2, n);
                let share = 0.5 * dt / self.spacing * flux;
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
            let scale = -4.0 * state.xi_squared * self.spacing / state.overlap;
            let row = |x: &[f64]| scale * state.sharp.iter().zip(x).map(|(h, x)| h * x).sum::<f64>();
            let share = row(&change) / (1.0 + row(&solved));
            change.iter_mut().zip(&solved).for_each(|(change, solved)| *change -= share * solved);
        }
        change.iter().all(|c| c.is_finite()).then_some(change)
    }
}

/// h, h̄ₓ, k, ⟨h,h̄⟩ and ξ² of a trial.
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
        let ring = Ring { from: -1.0, count: 80, spacing: 0.025, alpha: 0.05, wetting: 1.16 };
        let droplet = Droplet { area: 1.0, half_width: 0.5 };
        let grid = FiniteDifferences::new(&ring, &droplet, WeightRule::Cell, StepRule::ADAPTIVE);
        let v: Vec<f64> = grid.nodes().iter().map(|x| 0.4 + 0.3 * (3.0 * x).cos()).collect();
        let change: Vec<f64> = (0..80).map(|i| (1.3 * f64::from(i)).sin()).collect();
        let (dt, tiny) = (1.0e-3, 1.0e-6);
        let at = |sign: f64| {
            let v: Vec<f64> = v.iter().zip(&change).map(|(v, c)| v + sign * tiny * c).collect();
            grid.residual(&v, &grid.state(&v), dt)
        };
        let (up, down) = (at(1.0), at(-1.0));
        let product: Vec<f64> = up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * tiny)).collect();
        let found = grid.newton(&v, &grid.state(&v), &product, dt).unwrap();
        let error = found.iter().zip(&change).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // The central difference is good to rounding over its step.
        assert!(error < 1.0e-6, "{error}");
    }
}
