//! Implicit steps of particles: the matrix s − J of their rates, made sparse by auxiliary unknowns.
//!
//! J is dense, but with yⱼ = wⱼ δxⱼ it acts through the same recursive sums as the rates do. With the changes of these sums as additional unknowns the matrix
//! has five rows per particle with a few entries each, so that an implicit step costs O(N). The change of ξ² in partial wetting is a matrix of rank one.

use super::kernel::Order;
use super::ode::Implicit;
use super::particles::ParticleMethod;
use super::sparse::{Factors, Pattern};
use super::sums::OneSided;

/// Unknowns of a particle: δx, and the changes of the two left and the two right sums.
const BLOCK: usize = 5;
/// Offsets of the left and of the right sums in a block.
const LEFT: usize = 1;
const RIGHT: usize = 3;

/// The factored matrix s − J of the particle rates.
#[derive(Debug, Clone)]
pub struct ParticleSystem {
    factors: Factors,
    extended: Vec<f64>,
}

impl ParticleMethod {
    /// The entries of the extended matrix by row and column, always with the same pattern in the same order; for the last sums, those at `x`.
    fn entries(&self, x: &[f64], shift: f64, mut entry: impl FnMut(usize, usize, f64)) {
        let alpha = self.kernel.alpha;
        let pull = self.xi_squared() - self.pull.bond;
        let [first, second, fourth] = [Order::First, Order::Second, Order::Fourth].map(|order| self.form(order));
        let own_second = self.kernel.at(Order::Second, 0.0);
        let own_fourth = self.kernel.at(Order::Fourth, 0.0);
        let fourths = self.fourths(x);
        for i in 0..x.len() {
            let s = &self.smoothed;
            let (height, slope, weight) = (s.height[i], s.slope[i], self.weight[i]);
            let square = height * height;
            let drive = self.drive(i, pull);
            // A particle's own term moves with it: the diagonal omits it.
            let curvature_of_others = s.curvature[i] - weight * own_second;
            let fourth_of_others = fourths[i] - weight * own_fourth;
            let own = 2.0 * height * slope * drive + square * (fourth_of_others + pull * curvature_of_others);
            let at = BLOCK * i;
            entry(at, at, shift - own);
            // δvᵢ of the others is −Σ yⱼ [2 h̄ g Φ' + h̄² (Φ'''' + (ξ² − Bo) Φ'')], with Φ' odd; here its negative.
            for (part, side) in [(LEFT, 1.0), (RIGHT, -1.0)] {
                let term = |first: f64, second: f64, fourth: f64| {
                    2.0 * height * drive * side * first + square * (fourth + pull * second)
                };
                entry(at, at + part, term(first.0, second.0, fourth.0));
                entry(at, at + part + 1, term(first.1, second.1, fourth.1));
            }
            for part in LEFT..BLOCK {
                entry(at + part, at + part, 1.0);
            }
            let mut neighbor = |part: usize, j: usize, gap: f64| {
                let decay = (-gap / alpha).exp();
                let other = BLOCK * j;
                entry(at + part, other, -decay * self.weight[j]);
                entry(at + part, other + part, -decay);
                entry(at + part + 1, other, -decay * gap * self.weight[j]);
                entry(at + part + 1, other + part, -decay * gap);
                entry(at + part + 1, other + part + 1, -decay);
            };
            if i > 0 {
                neighbor(LEFT, i - 1, x[i] - x[i - 1]);
            }
            if i + 1 < x.len() {
                neighbor(RIGHT, i + 1, x[i + 1] - x[i]);
            }
        }
    }

    /// c₀ and c₁ of a derivative (c₀ + c₁ d) e^(−d/α) of the kernel.
    fn form(&self, order: Order) -> (f64, f64) {
        let alpha = self.kernel.alpha;
        let at = |d: f64| self.kernel.at(order, d) * (d / alpha).exp();
        // Two values determine the two coefficients; 0 itself is special for the odd derivatives.
        let (near, far) = (at(alpha), at(2.0 * alpha));
        (2.0 * near - far, (far - near) / alpha)
    }

    /// Σⱼ wⱼ Φ''''(xᵢ − xⱼ), including each particle's own term.
    fn fourths(&self, x: &[f64]) -> Vec<f64> {
        let alpha = self.kernel.alpha;
        let decay = |gap: f64| (-gap / alpha).exp();
        let mut total = vec![0.0; x.len()];
        let scale = 0.25 / alpha.powi(6);
        let mut side = OneSided::default();
        for i in 0..x.len() {
            if i > 0 {
                let gap = x[i] - x[i - 1];
                side = side.with(self.weight[i - 1]).moved(gap, decay(gap));
            }
            total[i] = scale * (side.weighted - 3.0 * alpha * (side.plain + self.weight[i]));
        }
        let mut side = OneSided::default();
        for i in (0..x.len()).rev() {
            if i + 1 < x.len() {
                let gap = x[i + 1] - x[i];
                side = side.with(self.weight[i + 1]).moved(gap, decay(gap));
            }
            total[i] += scale * (side.weighted - 3.0 * alpha * side.plain);
        }
        total
    }
}

impl Implicit for ParticleMethod {
    type System = ParticleSystem;

    fn factor(&mut self, x: &[f64], shift: f64) -> Option<ParticleSystem> {
        let rows = BLOCK * x.len();
        self.smooth(x);
        if self.pattern.is_none() {
            let mut indices = Vec::new();
            self.entries(x, shift, |row, column, _| indices.push((row, column)));
            self.pattern = Pattern::new(rows, indices).ok();
        }
        let mut values = Vec::new();
        self.entries(x, shift, |_, _, value| values.push(value));
        let mut factors = self.pattern.as_ref()?.factor(&values)?;
        let xi_squared = self.xi_squared();
        if xi_squared > 0.0 {
            let (mut row, mut column) = (vec![0.0; rows], vec![0.0; rows]);
            let overlap = self.overlap();
            for (i, (height, slope)) in self.smoothed.height.iter().zip(&self.smoothed.slope).enumerate() {
                column[BLOCK * i] = height * height * slope;
                row[BLOCK * i] = 4.0 * xi_squared * self.weight[i] * slope / overlap;
            }
            factors = factors.with_rank_one(column, row)?;
        }
        Some(ParticleSystem { factors, extended: vec![0.0; rows] })
    }

    fn solve(system: &mut ParticleSystem, rhs: &mut [f64]) {
        system.extended.fill(0.0);
        system.extended.iter_mut().step_by(BLOCK).zip(rhs.iter()).for_each(|(slot, value)| *slot = *value);
        system.factors.solve(&mut system.extended);
        rhs.iter_mut().zip(system.extended.iter().step_by(BLOCK)).for_each(|(value, slot)| *value = *slot);
    }
}

#[cfg(test)]
mod tests {
    use super::super::ode::Rates;
    use super::super::particles::disturbed;
    use super::*;
    use meniscus_case::film::LatticeEnergy;

    #[test]
    fn implicit_steps_use_the_jacobian_of_the_rates() {
        for (wetting, lattice) in [(0.0, LatticeEnergy::Kept), (1.16, LatticeEnergy::TakenOff)] {
            let (mut method, x) = disturbed(wetting, lattice);
            let count = x.len();
            let change: Vec<f64> = (0..count).map(|i| (1.7 * i as f64).cos()).collect();
            let step = 1.0e-7;
            let moved = |sign: f64| -> Vec<f64> { x.iter().zip(&change).map(|(x, d)| x + sign * step * d).collect() };
            let (mut up, mut down) = (vec![0.0; count], vec![0.0; count]);
            method.rates(&moved(1.0), &mut up);
            method.rates(&moved(-1.0), &mut down);
            let shift = 1.0e4;
            let mut found: Vec<f64> =
                (0..count).map(|i| shift * change[i] - (up[i] - down[i]) / (2.0 * step)).collect();
            let mut system = method.factor(&x, shift).unwrap();
            ParticleMethod::solve(&mut system, &mut found);
            let error = found.iter().zip(&change).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // The central difference is accurate to step² and to rounding over step.
            assert!(error < 1.0e-6, "{error}");
        }
    }
}
