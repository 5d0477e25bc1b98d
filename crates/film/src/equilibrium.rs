//! The equilibrium of a partially wetting droplet in closed form [Pang2022, Sect. 5, Appendix B], and the χ of a unit slope.
//!
//! In |x| < r: h̄ = B₁ cos(ξx) + B₂; beyond, h = 0 and h̄ decays as (C₁ + C₂|x|) e^(−|x|/α). With s = αξ, continuity of three derivatives gives ξr = π − 2
//! arctan s (the solution of the paper's transcendental equation), B₂ = B₁(1 + s²) and B₁ = A/(2(1 + s²)(r + 2α)). The tail is expressed from r outwards: C₁
//! and C₂ overflow for small α.

use std::f64::consts::{PI, TAU};

use meniscus_geometry::analysis::roots::bisect;

/// A droplet at rest, symmetric about x = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium {
    /// Filter length α.
    pub alpha: f64,
    /// Mass A.
    pub area: f64,
    /// Wave number ξ.
    pub xi: f64,
    /// Half of the base width r, where h ends.
    pub radius: f64,
    /// B₁.
    pub cosine: f64,
    /// B₂.
    pub level: f64,
}

/// Range of ξ√A in which an equilibrium is sought; χ increases over all of it.
const XI_RANGE: (f64, f64) = (0.05, 60.0);
/// Factor by which ξ is raised in the search for a unit slope.
const SEARCH_STEP: f64 = 1.01;

impl Equilibrium {
    /// The equilibrium with the wave number `xi` [Pang2022, Sect. 5].
    pub(crate) fn of_wave_number(alpha: f64, area: f64, xi: f64) -> Self {
        let s = alpha * xi;
        let radius = (PI - 2.0 * s.atan()) / xi;
        let cosine = area / (2.0 * (1.0 + s * s) * (radius + 2.0 * alpha));
        Self { alpha, area, xi, radius, cosine, level: cosine * (1.0 + s * s) }
    }

    /// The equilibrium for χ under gravity, which reduces ξ² by the Bond number: κ² = ξ² − Bo replaces ξ² everywhere but in ξ² = 2χA²/⟨h,h̄⟩². `None` if κ is
    /// outside the range of the search.
    pub fn under_gravity(alpha: f64, area: f64, wetting: f64, bond: f64) -> Option<Self> {
        let at = |kappa: f64| Self::of_wave_number(alpha, area, kappa);
        let excess = |kappa: f64| kappa * kappa + bond - 2.0 * wetting * (area / at(kappa).overlap()).powi(2);
        bisect(excess, XI_RANGE.0, XI_RANGE.1).map(at)
    }

    /// The equilibrium of unit mass with unit slope at π/(2ξ): it calibrates χ [Pang2022, Sect. 5].
    ///
    /// B₁ξ = 1 is ξ² = 2(1 + s²)(π − 2 arctan s + 2s). `None` if α is too large for a droplet of unit slope.
    pub fn of_unit_slope(alpha: f64) -> Option<Self> {
        let excess = |xi: f64| {
            let s = alpha * xi;
            xi * xi - 2.0 * (1.0 + s * s) * (PI - 2.0 * s.atan() + 2.0 * s)
        };
        // For α = 0 the root is √(2π); filtering raises it.
        let below = 0.99 * TAU.sqrt();
        let candidates = std::iter::successors(Some(below), |xi| Some(xi * SEARCH_STEP));
        let above = candidates.take_while(|&xi| xi < XI_RANGE.1).find(|&xi| excess(xi) > 0.0)?;
        bisect(excess, below, above).map(|xi| Self::of_wave_number(alpha, 1.0, xi))
    }

    /// χ = ξ²⟨h,h̄⟩²/(2A²).
    pub fn wetting(&self) -> f64 {
        0.5 * (self.xi * self.overlap() / self.area).powi(2)
    }

    /// ⟨h,h̄⟩ = ∫ h h̄ dx.
    pub(crate) fn overlap(&self) -> f64 {
        let (xi, r) = (self.xi, self.radius);
        let q = 1.0 + (self.alpha * xi).powi(2);
        let waves = (1.0 + q * q) * (xi * r).sin() / xi + q * (2.0 * xi * r).sin() / (4.0 * xi);
        2.0 * self.cosine.powi(2) * q * (1.5 * q * r + waves)
    }

    /// h̄ at x.
    pub fn height(&self, x: f64) -> f64 {
        let d = x.abs() - self.radius;
        if d < 0.0 {
            return self.cosine * (self.xi * x).cos() + self.level;
        }
        let phase = self.xi * self.radius;
        let edge = self.cosine * phase.cos() + self.level;
        let slope = -self.cosine * self.xi * phase.sin();
        (edge + (slope + edge / self.alpha) * d) * (-d / self.alpha).exp()
    }

    /// The contact line: the intersection of the tangent at the steepest point with the wall.
    pub(crate) fn contact_line(&self) -> f64 {
        PI / (2.0 * self.xi) + self.level / (self.cosine * self.xi)
    }
}

/// Reference quantities for tests.
#[cfg(test)]
impl Equilibrium {
    /// h at x; it jumps to 0 at r.
    pub(crate) fn sharp_height(&self, x: f64) -> f64 {
        let q = 1.0 + (self.alpha * self.xi).powi(2);
        if x.abs() < self.radius { self.cosine * q * q * (self.xi * x).cos() + self.level } else { 0.0 }
    }

    /// The equilibrium for the wetting parameter χ; `None` if ξ is outside the range of the search.
    pub(crate) fn of_wetting(alpha: f64, area: f64, wetting: f64) -> Option<Self> {
        let at = |xi: f64| Self::of_wave_number(alpha, area, xi);
        bisect(|xi| at(xi).wetting() - wetting, XI_RANGE.0, XI_RANGE.1).map(at)
    }
}

#[cfg(test)]
mod tests {
    use super::super::kernel::{Kernel, Order, simpson};
    use super::*;

    /// [Pang2022, Sect. 5]
    #[test]
    fn a_unit_slope_gives_the_table_of_wetting_parameters() {
        // alpha, chi, r, xi, B1, B2, overlap, foot; evaluated from the closed form with 30 digits, printed to 9 decimals.
        let table = [
            [0.2, 1.929_480_940, 0.697_396_868, 2.968_320_282, 0.336_890_869, 0.455_623_681, 0.661_796_529, 0.984_811],
            [0.1, 1.272_668_615, 1.015_315_290, 2.594_210_238, 0.385_473_770, 0.411_415_872, 0.614_989_210, 1.016_917],
            [0.05, 1.160_231_215, 1.143_691_062, 2.527_094_462, 0.395_711_365, 0.402_029_102, 0.602_789_661, 1.023_611],
            [0.02, 1.130_615_871, 1.211_754_916, 2.509_817_861, 0.398_435_287, 0.399_439_214, 0.599_142_781, 1.025_300],
            [0.01, 1.126_407_523, 1.232_922_429, 2.507_420_322, 0.398_816_262, 0.399_067_004, 0.598_598_505, 1.025_526],
            [
                0.005,
                1.125_352_572,
                1.243_215_960,
                2.506_825_692,
                0.398_910_863,
                0.398_973_534,
                0.598_460_050,
                1.025_581,
            ],
        ];
        for [alpha, wetting, radius, xi, cosine, level, overlap, contact_line] in table {
            let found = Equilibrium::of_unit_slope(alpha).unwrap();
            for (value, known) in [
                (found.wetting(), wetting),
                (found.radius, radius),
                (found.xi, xi),
                (found.cosine, cosine),
                (found.level, level),
                (found.overlap(), overlap),
            ] {
                assert!((value - known).abs() < 1.0e-9, "{alpha}: {value} {known}");
            }
            assert!((found.contact_line() - contact_line).abs() < 1.0e-6, "{alpha}: {}", found.contact_line());
        }
    }

    #[test]
    fn the_smoothed_equilibrium_is_the_kernel_on_the_sharp_one() {
        let droplet = Equilibrium::of_unit_slope(0.05).unwrap();
        let kernel = Kernel::new(0.05);
        for x in [0.0, 0.4, 1.1, droplet.radius, 1.3, 2.0] {
            // Simpson's rule between the ends of h and the kink of the kernel.
            let ends = [-droplet.radius, x.clamp(-droplet.radius, droplet.radius), droplet.radius];
            // The end point of h belongs to the droplet here.
            let product = |y: f64| droplet.sharp_height(y * (1.0 - 1.0e-15)) * kernel.at(Order::Value, x - y);
            let smoothed: f64 = ends.windows(2).map(|pair| simpson(20_000, pair[0], pair[1], product)).sum();
            // Simpson's error with 20,000 cells is below 1e-13 of the height.
            assert!((smoothed - droplet.height(x)).abs() < 1.0e-12, "{x}: {smoothed} {}", droplet.height(x));
        }
    }

    #[test]
    fn the_wetting_parameter_gives_back_its_equilibrium() {
        for alpha in [0.05, 0.005] {
            let droplet = Equilibrium::of_unit_slope(alpha).unwrap();
            let found = Equilibrium::of_wetting(alpha, 1.0, droplet.wetting()).unwrap();
            assert!((found.xi - droplet.xi).abs() < 1.0e-9);
        }
        // The paper's rounded parameter.
        let printed = Equilibrium::of_wetting(0.05, 1.0, 1.1602).unwrap();
        assert!((printed.cosine * printed.xi - 0.999_986_75).abs() < 1.0e-8);
    }

    #[test]
    fn a_very_small_filter_length_does_not_overflow_the_tail() {
        let droplet = Equilibrium::of_unit_slope(1.0e-4).unwrap();
        let far = droplet.height(droplet.radius + 0.01);
        assert!(far > 0.0 && far < 1.0e-20);
    }
}
