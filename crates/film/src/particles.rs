//! The particle method: ẋᵢ = h̄ᵢ² ( h̄ₓₓₓ,ᵢ + (ξ² − Bo) h̄ₓ,ᵢ ), h̄ = Σ wⱼ Φ(x − xⱼ), ξ² = 2χA²/⟨h,h̄⟩² [Pang2022, Sects. 3, 5].
//!
//! χ = 0 is complete wetting; the Bond number Bo is not part of the paper. The line is infinite. The energy of a lattice of particles exceeds that of the
//! film it represents by w²/(24 α⁴) per length; its gradient opposes spreading like a contact angle of slope w/(√12 α²), and decreases only as the square of
//! the spacing. [`LatticeEnergy::TakenOff`] adds its opposite, cₖ = (wₖ₋₁² − wₖ₊₁²)/(48 α⁴ wₖ), to the bracket. That is not part of the paper, and valid only
//! for gaps below α/2: beyond, the term expels the last particles.

use super::droplet::PointMasses;
use super::kernel::Kernel;
use super::ode::Rates;
use super::sparse::Pattern;
use super::sums::{FastSums, Smoothed, direct_sums};
use meniscus_case::film::LatticeEnergy;

/// Largest gap over α at which the lattice energy may be corrected.
pub(crate) const WIDEST_GAP: f64 = 0.5;

/// Driving forces of a film besides surface tension.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pull {
    /// χ of partial wetting, 0 for complete wetting.
    pub wetting: f64,
    /// Bond number ρgL²/γ, below 0 for a pendent film.
    pub bond: f64,
}

/// The particles except for their positions, with all parameters of their motion.
#[derive(Debug, Clone)]
pub struct ParticleMethod {
    /// The kernel that smooths the film.
    pub kernel: Kernel,
    /// The mass of each particle.
    pub weight: Vec<f64>,
    /// Driving forces besides surface tension.
    pub pull: Pull,
    /// Total mass A.
    pub area: f64,
    correction: Vec<f64>,
    sums: FastSums,
    sums_directly: bool,
    pub(super) smoothed: Smoothed,
    /// The sparsity pattern of the matrix of implicit steps, once computed.
    pub(super) pattern: Option<Pattern>,
}

impl ParticleMethod {
    /// The method for particles of the given weights.
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
            sums_directly: false,
            smoothed: Smoothed::new(weight.len()),
            weight,
            pattern: None,
        }
    }

    /// From now on computes the sums of the rates over all pairs, for comparison with the recursion.
    pub(crate) fn sum_directly(&mut self) {
        self.sums_directly = true;
    }

    /// From now on omits the correction of the lattice energy.
    pub(crate) fn keep_lattice_energy(&mut self) {
        self.correction.fill(0.0);
    }

    /// Whether the lattice energy is corrected.
    pub fn corrects(&self) -> bool {
        self.correction.iter().any(|&c| c != 0.0)
    }

    /// The slope of the spurious contact angle due to the lattice energy, w/(√12 α²) with the largest weight.
    pub(crate) fn lattice_slope(&self) -> f64 {
        let largest = self.weight.iter().copied().fold(0.0, f64::max);
        largest / (12.0_f64.sqrt() * self.kernel.alpha.powi(2))
    }

    /// h̄ and its derivatives at the particles.
    pub(crate) fn smooth(&mut self, x: &[f64]) -> &Smoothed {
        if self.sums_directly {
            self.smoothed = direct_sums(&self.kernel, x, &self.weight);
        } else {
            self.sums.at_particles(x, &self.weight, &mut self.smoothed);
        }
        &self.smoothed
    }

    /// h̄, h̄ₓ, h̄ₓₓ at ascending positions.
    pub fn profile(&self, x: &[f64], positions: &[f64]) -> Smoothed {
        self.sums.at_positions(x, &self.weight, positions)
    }

    /// ⟨h, h̄⟩ = Σ wᵢ h̄ᵢ from the last sums.
    pub(super) fn overlap(&self) -> f64 {
        self.weight.iter().zip(&self.smoothed.height).map(|(w, h)| w * h).sum()
    }

    /// ξ² from the last sums.
    pub(super) fn xi_squared(&self) -> f64 {
        if self.pull.wetting == 0.0 { 0.0 } else { 2.0 * self.pull.wetting * (self.area / self.overlap()).powi(2) }
    }

    /// Energy E = ½ Σ wᵢ (Bo h̄ᵢ − h̄ₓₓ,ᵢ) + χA²/⟨h,h̄⟩, including that of the lattice.
    pub(crate) fn energy(&mut self, x: &[f64]) -> f64 {
        self.smooth(x);
        let surface: f64 = self.weight.iter().zip(&self.smoothed.curvature).map(|(w, c)| w * c).sum();
        let overlap = self.overlap();
        0.5 * (self.pull.bond * overlap - surface) + self.pull.wetting * self.area * self.area / overlap
    }

    /// The bracket h̄ₓₓₓ + (ξ² − Bo) h̄ₓ + c of particle i; `pull` is the factor of h̄ₓ.
    pub(super) fn drive(&self, i: usize, pull: f64) -> f64 {
        self.smoothed.third[i] + pull * self.smoothed.slope[i] + self.correction[i]
    }
}

/// cₖ of each particle; the weight beyond the ends is zero.
fn lattice_correction(kernel: &Kernel, weight: &[f64]) -> Vec<f64> {
    let at = |i: Option<usize>| i.and_then(|i| weight.get(i)).copied().unwrap_or(0.0);
    let scale = 48.0 * kernel.alpha.powi(4);
    let term = |i: usize| (at(i.checked_sub(1)).powi(2) - at(Some(i + 1)).powi(2)) / (scale * weight[i]);
    (0..weight.len()).map(term).collect()
}

/// The largest distance between neighbors.
pub(crate) fn widest_gap(x: &[f64]) -> f64 {
    x.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

impl Rates for ParticleMethod {
    /// ẋᵢ = h̄ᵢ² (h̄ₓₓₓ,ᵢ + (ξ² − Bo) h̄ₓ,ᵢ) of each particle [Pang2022, Sect. 3].
    fn rates(&mut self, x: &[f64], out: &mut [f64]) {
        self.smooth(x);
        let pull = self.xi_squared() - self.pull.bond;
        for (i, rate) in out.iter_mut().enumerate() {
            *rate = self.smoothed.height[i].powi(2) * self.drive(i, pull);
        }
    }

    /// Particles must keep their order.
    fn admissible(&self, x: &[f64]) -> bool {
        x.iter().all(|x| x.is_finite()) && x.windows(2).all(|pair| pair[0] < pair[1])
    }
}

/// A droplet whose particles are slightly displaced, for tests.
#[cfg(test)]
pub(super) fn disturbed(wetting: f64, lattice: LatticeEnergy) -> (ParticleMethod, Vec<f64>) {
    let droplet = super::droplet::Droplet { area: 1.0, half_width: 0.5, center: 0.0 };
    let masses = super::droplet::particles(&[droplet], 0.02, meniscus_case::film::FilmWeights::Cell);
    let wave = |x: &f64| x + 0.004 * (40.0 * x + 0.3).sin();
    let pull = Pull { wetting, bond: 2.0 * wetting };
    (ParticleMethod::new(Kernel::new(0.05), &masses, pull, lattice), masses.x.iter().map(wave).collect())
}

#[cfg(test)]
mod tests {
    use super::super::droplet::{Droplet, particles};
    use super::*;
    use meniscus_case::film::FilmWeights;

    const DROPLET: Droplet = Droplet { area: 1.0, half_width: 0.5, center: 0.0 };

    #[test]
    fn the_forces_between_particles_cancel() {
        let (mut method, x) = disturbed(1.16, LatticeEnergy::Kept);
        let smoothed = method.smooth(&x).clone();
        for field in [&smoothed.third, &smoothed.slope] {
            let size: f64 = field.iter().zip(&method.weight).map(|(f, w)| (f * w).abs()).sum();
            let sum: f64 = field.iter().zip(&method.weight).map(|(f, w)| f * w).sum();
            assert!(sum.abs() < 1.0e-12 * size);
        }
    }

    #[test]
    fn energy_falls_at_the_rate_of_dissipation() {
        for wetting in [0.0, 1.16] {
            let (mut method, x) = disturbed(wetting, LatticeEnergy::Kept);
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
    fn a_symmetric_droplet_stays_symmetric() {
        let masses = particles(&[DROPLET], 0.01, FilmWeights::Cell);
        let mut method = ParticleMethod::new(Kernel::new(0.05), &masses, Pull::default(), LatticeEnergy::TakenOff);
        let mut rate = vec![0.0; masses.x.len()];
        method.rates(&masses.x, &mut rate);
        let largest = rate.iter().map(|v| v.abs()).fold(0.0, f64::max);
        assert!(rate.iter().zip(rate.iter().rev()).all(|(a, b)| (a + b).abs() < 1.0e-10 * largest));
        assert!(*rate.last().unwrap() > 0.0);
    }
}
