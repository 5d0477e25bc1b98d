//! The particle method: ẋᵢ = h̄ᵢ² ( h̄ₓₓₓ,ᵢ + (ξ² − Bo) h̄ₓ,ᵢ ), h̄ = Σ wⱼ Φ(x − xⱼ), ξ² = 2χA²/⟨h,h̄⟩² [Pang2022, Sects. 3, 5].
//!
//! χ = 0 is complete wetting; the Bond number Bo is no part of the paper. The line is infinite. A lattice of particles has an energy w²/(24 α⁴) per length more than the
//! film that it stands for; its gradient opposes spreading like a contact angle of slope w/(√12 α²), and falls only as the
//! square of the spacing. [`LatticeEnergy::TakenOff`] adds its opposite, cₖ = (wₖ₋₁² − wₖ₊₁²)/(48 α⁴ wₖ), to the bracket. That
//! is no part of the paper, and holds only while gaps are below α/2: beyond, the term throws the last particles away.

use super::banded::Banded;
use super::droplet::PointMasses;
use super::kernel::{Kernel, Order};
use super::ode::{Implicit, Rates};
use super::sums::{FastSums, OneSided, Smoothed};

/// Widest gap over α at which the lattice energy may be taken off.
pub const WIDEST_GAP: f64 = 0.5;

/// What is done about the energy of the particle lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LatticeEnergy {
    /// Nothing, as in the paper.
    Kept,
    /// Its gradient is taken off the rates.
    TakenOff,
}

/// What moves a film besides its tension.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pull {
    /// χ of partial wetting, 0 for complete wetting.
    pub wetting: f64,
    /// Bond number ρgL²/γ, below 0 for a film that hangs.
    pub bond: f64,
}

/// Particles with all that their motion depends on but their positions.
#[derive(Debug, Clone)]
pub struct ParticleMethod {
    kernel: Kernel,
    weight: Vec<f64>,
    pull: Pull,
    area: f64,
    correction: Vec<f64>,
    sums: FastSums,
    smoothed: Smoothed,
}

impl ParticleMethod {
    /// The method for particles of the given weights.
    #[must_use]
    pub fn new(kernel: Kernel, masses: &PointMasses, pull: Pull, lattice: LatticeEnergy) -> Self {
        let weight = masses.weight.clone();
        let correction = match lattice {
            LatticeEnergy::Kept => vec![0.0; weight.len()],
            LatticeEnergy::TakenOff => lattice_correction(&kernel, &weight),
        };
        Self {
            kernel,
            pull,
            area: weight.iter().sum(),
            correction,
            sums: FastSums::new(kernel),
            smoothed: Smoothed::new(weight.len()),
            weight,
        }
    }

    /// Leaves the lattice energy alone from now on.
    pub fn keep_lattice_energy(&mut self) {
        self.correction.fill(0.0);
    }

    /// Whether a lattice energy is taken off.
    #[must_use]
    pub fn corrects(&self) -> bool {
        self.correction.iter().any(|&c| c != 0.0)
    }

    /// The slope of the contact angle that the lattice energy imitates, w/(√12 α²) with the largest weight.
    #[must_use]
    pub fn lattice_slope(&self) -> f64 {
        let largest = self.weight.iter().copied().fold(0.0, f64::max);
        largest / (12.0_f64.sqrt() * self.kernel.alpha().powi(2))
    }

    /// The weights.
    #[must_use]
    pub fn weight(&self) -> &[f64] {
        &self.weight
    }

    /// Total mass A.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// What moves the film besides its tension.
    #[must_use]
    pub fn pull(&self) -> Pull {
        self.pull
    }

    /// The kernel.
    #[must_use]
    pub fn kernel(&self) -> Kernel {
        self.kernel
    }

    /// h̄ and its derivatives at the particles.
    pub fn smooth(&mut self, x: &[f64]) -> &Smoothed {
        self.sums.at_particles(x, &self.weight, &mut self.smoothed);
        &self.smoothed
    }

    /// h̄, h̄ₓ, h̄ₓₓ at ascending places.
    #[must_use]
    pub fn profile(&self, x: &[f64], places: &[f64]) -> Smoothed {
        self.sums.at_places(x, &self.weight, places)
    }

    /// ⟨h, h̄⟩ = Σ wᵢ h̄ᵢ of the last sums.
    fn overlap(&self) -> f64 {
        self.weight.iter().zip(&self.smoothed.height).map(|(w, h)| w * h).sum()
    }

    /// ξ² of the last sums.
    fn xi_squared(&self) -> f64 {
        if self.pull.wetting == 0.0 { 0.0 } else { 2.0 * self.pull.wetting * (self.area / self.overlap()).powi(2) }
    }

    /// Energy E = ½ Σ wᵢ (Bo h̄ᵢ − h̄ₓₓ,ᵢ) + χA²/⟨h,h̄⟩, that of the lattice included.
    #[must_use]
    pub fn energy(&mut self, x: &[f64]) -> f64 {
        self.smooth(x);
        let surface: f64 = self.weight.iter().zip(&self.smoothed.curvature).map(|(w, c)| w * c).sum();
        let overlap = self.overlap();
        0.5 * (self.pull.bond * overlap - surface) + self.pull.wetting * self.area * self.area / overlap
    }

    /// The bracket h̄ₓₓₓ + (ξ² − Bo) h̄ₓ + c of particle i; `pull` is the factor of h̄ₓ.
    fn drive(&self, i: usize, pull: f64) -> f64 {
        self.smoothed.third[i] + pull * self.smoothed.slope[i] + self.correction[i]
    }
}

/// cₖ of each particle; beyond the ends there is no weight.
fn lattice_correction(kernel: &Kernel, weight: &[f64]) -> Vec<f64> {
    let at = |i: Option<usize>| i.and_then(|i| weight.get(i)).copied().unwrap_or(0.0);
    let scale = 48.0 * kernel.alpha().powi(4);
    let term = |i: usize| (at(i.checked_sub(1)).powi(2) - at(Some(i + 1)).powi(2)) / (scale * weight[i]);
    (0..weight.len()).map(term).collect()
}

/// The widest distance of neighbors.
#[must_use]
pub fn widest_gap(x: &[f64]) -> f64 {
    x.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

impl Rates for ParticleMethod {
    fn rates(&mut self, x: &[f64], out: &mut [f64]) {
        self.sums.at_particles(x, &self.weight, &mut self.smoothed);
        let pull = self.xi_squared() - self.pull.bond;
        for (i, rate) in out.iter_mut().enumerate() {
            *rate = self.smoothed.height[i].powi(2) * self.drive(i, pull);
        }
    }

    /// Particles keep their order.
    fn admissible(&self, x: &[f64]) -> bool {
        x.iter().all(|x| x.is_finite()) && x.windows(2).all(|pair| pair[0] < pair[1])
    }
}

/// Unknowns per particle of the extended system: δx and the changes of the left and right sums.
const BLOCK: usize = 5;
/// Diagonals of the extended system below and above the main one.
const BELOW: usize = 7;
const ABOVE: usize = 5;

/// The factored matrix s − J of the particle rates.
///
/// J is full, but with yⱼ = wⱼ δxⱼ it acts through the same recursive sums as the rates do. Taking their values as further
/// unknowns makes it a banded matrix of five rows a particle, so that an implicit step costs O(N). The change of ξ² is a
/// matrix of rank one and is added by the Sherman-Morrison formula.
#[derive(Debug, Clone)]
pub struct ParticleSystem {
    matrix: Banded,
    extended: Vec<f64>,
    /// u and v of J = J₀ + u vᵀ; empty for complete wetting.
    row: Vec<f64>,
    solved: Vec<f64>,
    denominator: f64,
}

impl ParticleSystem {
    fn solve_banded(&mut self, rhs: &mut [f64]) {
        self.extended.fill(0.0);
        for (i, value) in rhs.iter().enumerate() {
            self.extended[BLOCK * i] = *value;
        }
        self.matrix.solve(&mut self.extended);
        for (i, value) in rhs.iter_mut().enumerate() {
            *value = self.extended[BLOCK * i];
        }
    }
}

impl Implicit for ParticleMethod {
    type System = ParticleSystem;

    fn factor(&mut self, x: &[f64], shift: f64) -> Option<ParticleSystem> {
        let count = x.len();
        self.smooth(x);
        let xi_squared = self.xi_squared();
        let pull = xi_squared - self.pull.bond;
        let alpha = self.kernel.alpha();
        let mut matrix = Banded::new(BLOCK * count, BELOW, ABOVE);
        // (constant, linear) of each derivative's (c₀ + c₁ d) e^(−d/α).
        let form = |order: Order| {
            let at = |d: f64| self.kernel.at(order, d) * (d / alpha).exp();
            // Two places give the two numbers; 0 itself is special for the odd ones.
            let (near, far) = (at(alpha), at(2.0 * alpha));
            (2.0 * near - far, (far - near) / alpha)
        };
        let (first, second, fourth) = (form(Order::First), form(Order::Second), form(Order::Fourth));
        let fourth_at_zero = self.kernel.at(Order::Fourth, 0.0);
        let second_at_zero = self.kernel.at(Order::Second, 0.0);
        let mut row = Vec::new();
        let mut column = Vec::new();
        let overlap = self.overlap();
        let fourths = self.fourths(x);
        for i in 0..count {
            let s = &self.smoothed;
            let (height, slope, weight) = (s.height[i], s.slope[i], self.weight[i]);
            let square = height * height;
            let drive = self.drive(i, pull);
            // A particle's own term moves with it: the diagonal leaves it out.
            let curvature_of_others = s.curvature[i] - weight * second_at_zero;
            let fourth_of_others = fourths[i] - weight * fourth_at_zero;
            let own = 2.0 * height * slope * drive + square * (fourth_of_others + pull * curvature_of_others);
            let row_of = BLOCK * i;
            matrix.add(row_of, row_of, shift - own);
            // δvᵢ of the others is −Σ yⱼ [2 h̄ g Φ' + h̄² (Φ'''' + (ξ² − Bo) Φ'')], with Φ' odd; here its negative.
            for (part, side) in [(1, 1.0), (3, -1.0)] {
                let term = |first: f64, second: f64, fourth: f64| {
                    2.0 * height * drive * side * first + square * (fourth + pull * second)
                };
                matrix.add(row_of, row_of + part, term(first.0, second.0, fourth.0));
                matrix.add(row_of, row_of + part + 1, term(first.1, second.1, fourth.1));
            }
            for part in 1..BLOCK {
                matrix.add(row_of + part, row_of + part, 1.0);
            }
            let mut neighbor = |part: usize, j: usize, gap: f64| {
                let decay = (-gap / alpha).exp();
                let other = BLOCK * j;
                matrix.add(row_of + part, other, -decay * self.weight[j]);
                matrix.add(row_of + part, other + part, -decay);
                matrix.add(row_of + part + 1, other, -decay * gap * self.weight[j]);
                matrix.add(row_of + part + 1, other + part, -decay * gap);
                matrix.add(row_of + part + 1, other + part + 1, -decay);
            };
            if i > 0 {
                neighbor(1, i - 1, x[i] - x[i - 1]);
            }
            if i + 1 < count {
                neighbor(3, i + 1, x[i + 1] - x[i]);
            }
            if xi_squared > 0.0 {
                column.push(square * slope);
                row.push(-4.0 * xi_squared * weight * slope / overlap);
            }
        }
        if !matrix.factor() {
            return None;
        }
        let mut system =
            ParticleSystem { matrix, extended: vec![0.0; BLOCK * count], row, solved: Vec::new(), denominator: 1.0 };
        if !column.is_empty() {
            system.solve_banded(&mut column);
            system.denominator = 1.0 - dot(&system.row, &column);
            system.solved = column;
        }
        (system.denominator.abs() > f64::EPSILON).then_some(system)
    }

    fn solve(system: &mut ParticleSystem, rhs: &mut [f64]) {
        system.solve_banded(rhs);
        if !system.solved.is_empty() {
            let share = dot(&system.row, rhs) / system.denominator;
            rhs.iter_mut().zip(&system.solved).for_each(|(value, solved)| *value += share * solved);
        }
    }
}

impl ParticleMethod {
    /// Σⱼ wⱼ Φ''''(xᵢ − xⱼ), each particle's own term included.
    fn fourths(&self, x: &[f64]) -> Vec<f64> {
        let alpha = self.kernel.alpha();
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

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::super::droplet::{Droplet, WeightRule, particles};
    use super::*;

    const DROPLET: Droplet = Droplet { area: 1.0, half_width: 0.5, center: 0.0 };

    /// A droplet whose particles were moved about a little.
    fn method(wetting: f64, lattice: LatticeEnergy) -> (ParticleMethod, Vec<f64>) {
        let masses = particles(&[DROPLET], 0.02, WeightRule::Cell);
        let wave = |x: &f64| x + 0.004 * (40.0 * x + 0.3).sin();
        let pull = Pull { wetting, bond: 2.0 * wetting };
        (ParticleMethod::new(Kernel::new(0.05), &masses, pull, lattice), masses.x.iter().map(wave).collect())
    }

    #[test]
    fn the_forces_between_particles_cancel() {
        let (mut method, x) = method(1.16, LatticeEnergy::Kept);
        let smoothed = method.smooth(&x).clone();
        for field in [&smoothed.third, &smoothed.slope] {
            let size: f64 = field.iter().zip(&method.weight).map(|(f, w)| (f * w).abs()).sum();
            assert!(dot(field, &method.weight).abs() < 1.0e-12 * size);
        }
    }

    #[test]
    fn energy_falls_at_the_rate_of_dissipation() {
        for wetting in [0.0, 1.16] {
            let (mut method, x) = method(wetting, LatticeEnergy::Kept);
            let mut rate = vec![0.0; x.len()];
            method.rates(&x, &mut rate);
            let height = method.smoothed.height.clone();
            let dissipation: f64 = (0..x.len()).map(|i| method.weight[i] * (rate[i] / height[i]).powi(2)).sum();
            let step = 1.0e-7 / rate.iter().map(|v| v.abs()).fold(0.0, f64::max);
            let moved = |sign: f64| -> Vec<f64> { x.iter().zip(&rate).map(|(x, v)| x + sign * step * v).collect() };
            let change = (method.energy(&moved(1.0)) - method.energy(&moved(-1.0))) / (2.0 * step);
            // Rounding of E over its change in a step of 1e-7.
            assert!((change / dissipation + 1.0).abs() < 1.0e-6, "{change} {dissipation}");
        }
    }

    #[test]
    fn implicit_steps_use_the_jacobian_of_the_rates() {
        for (wetting, lattice) in [(0.0, LatticeEnergy::Kept), (1.16, LatticeEnergy::TakenOff)] {
            let (mut method, x) = method(wetting, lattice);
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
            // The central difference is good to step² and to rounding over step.
            assert!(error < 1.0e-6, "{error}");
        }
    }

    #[test]
    fn a_symmetric_droplet_stays_symmetric() {
        let masses = particles(&[DROPLET], 0.01, WeightRule::Cell);
        let mut method = ParticleMethod::new(Kernel::new(0.05), &masses, Pull::default(), LatticeEnergy::TakenOff);
        let mut rate = vec![0.0; masses.x.len()];
        method.rates(&masses.x, &mut rate);
        let largest = rate.iter().map(|v| v.abs()).fold(0.0, f64::max);
        assert!(rate.iter().zip(rate.iter().rev()).all(|(a, b)| (a + b).abs() < 1.0e-10 * largest));
        assert!(*rate.last().unwrap() > 0.0);
    }
}
