//! The quintic C2 kernel of Wendland 1995 in the plane, support 2h [Huber2013, Eq. 14].

use std::f64::consts::PI;

use meniscus_core::math::{Vec2, wendland_c2};

/// Wendland's C2 kernel for one smoothing length [Huber2013, Eq. 14; Wendland1995].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WendlandC2 {
    /// Smoothing length h in m.
    pub h: f64,
    inverse_h: f64,
    norm: f64,
    gradient_norm: f64,
}

impl WendlandC2 {
    /// The kernel with smoothing length `h` in m.
    pub fn new(h: f64) -> Self {
        let norm = 7.0 / (4.0 * PI * h * h);
        Self { h, inverse_h: 1.0 / h, norm, gradient_norm: 5.0 * norm / (h * h) }
    }

    /// The kernel with its value divided by `unity` = Σ_b dx² W and its gradient by `moment` = −½ Σ_b dx² r_ab·∇W, sums over the perfect lattice.
    ///
    /// Both approximate integrals that are 1; at h = 1.5 dx they are 1.0051 and .9974. Divided by them, the volume of Eq. (17) is dx²
    /// on the lattice, and gradient, divergence and Laplacian of Eqs. (15) to (31) are exact there for linear (quadratic) fields.
    /// Without this, areas, viscosity and pressure carry errors of half a percent that no refinement removes.
    pub(crate) fn divided_by(self, unity: f64, moment: f64) -> Self {
        Self { norm: self.norm / unity, gradient_norm: self.gradient_norm / moment, ..self }
    }

    /// Radius 2h of the support, in m.
    pub fn support(&self) -> f64 {
        2.0 * self.h
    }

    /// W(r) in 1/m².
    pub fn w(&self, r: f64) -> f64 {
        self.w_and_slope(r).0
    }

    /// ∇_a W(|r_ab|) in 1/m³, where `r_ab` = x_a − x_b in m.
    pub(crate) fn grad_w(&self, r_ab: Vec2) -> Vec2 {
        self.w_and_grad(r_ab).1
    }

    /// W(|r_ab|) in 1/m² and ∇_a W(|r_ab|) in 1/m³ at once.
    #[inline]
    pub(crate) fn w_and_grad(&self, r_ab: Vec2) -> (f64, Vec2) {
        let (w, slope) = self.w_and_slope(r_ab.norm());
        (w, r_ab * slope)
    }

    /// W(r) in 1/m² and (1/r) dW/dr in 1/m⁴. dW/dr = −5 q (1 − q/2)³ · 7/(4πh³), so that the gradient is regular at r = 0.
    #[inline]
    pub(crate) fn w_and_slope(&self, r: f64) -> (f64, f64) {
        let q = r * self.inverse_h;
        let t = (1.0 - 0.5 * q).max(0.0);
        (self.norm * wendland_c2(q), -self.gradient_norm * t * t * t)
    }

    /// ∫₀²ʰ W(s) ds in 1/m: the sum in Eq. (22) for a contact line of an interface perpendicular to the wall.
    pub(crate) fn line_integral(&self) -> f64 {
        // ∫₀² (1 − q/2)⁴ (2q + 1) dq = 2/3.
        self.norm * self.h * 2.0 / 3.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Huber2013, Eq. 14]
    #[test]
    fn the_kernel_integrates_to_one() {
        let kernel = WendlandC2::new(0.3);
        let n = 20_000;
        let dr = kernel.support() / f64::from(n);
        let sum: f64 = (0..n).map(|i| (f64::from(i) + 0.5) * dr).map(|r| 2.0 * PI * r * kernel.w(r) * dr).sum();
        assert!((sum - 1.0).abs() < 1e-8, "{sum}");
    }

    /// [Huber2013, Eqs. 21-23]
    #[test]
    fn the_line_integral_is_the_integral_along_a_line() {
        let kernel = WendlandC2::new(1.7);
        let n = 20_000;
        let ds = kernel.support() / f64::from(n);
        let sum: f64 = (0..n).map(|i| kernel.w((f64::from(i) + 0.5) * ds) * ds).sum();
        assert!((sum - kernel.line_integral()).abs() < 1e-8 * sum);
        assert!((sum * 1.7 - 0.3714).abs() < 1e-4);
    }

    /// [Huber2013, Eq. 14]
    #[test]
    fn the_gradient_is_the_derivative_of_the_kernel() {
        let kernel = WendlandC2::new(0.8);
        let step = 1e-6;
        for x in [Vec2::new(0.3, -0.2), Vec2::new(1.0, 0.9), Vec2::new(1e-9, 0.0), Vec2::new(1.59, 0.0)] {
            let numeric = Vec2::from_fn(|i, _| {
                let mut e = Vec2::zeros();
                e[i] = step;
                (kernel.w((x + e).norm()) - kernel.w((x - e).norm())) / (2.0 * step)
            });
            assert!((numeric - kernel.grad_w(x)).norm() < 1e-6, "at {x:?}");
        }
    }

    #[test]
    fn nothing_is_felt_beyond_the_support() {
        let kernel = WendlandC2::new(1.0);
        assert_eq!(kernel.w(2.0), 0.0);
        assert_eq!(kernel.w(3.0), 0.0);
        assert_eq!(kernel.grad_w(Vec2::new(0.0, 2.5)), Vec2::zeros());
    }
}
