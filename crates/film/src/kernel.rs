//! The smoothing kernel of the Geometric Thin-Film Equation and its derivatives, on the line and on a periodic interval.
//!
//! Source: Pang and Ó Náraigh 2022 [Pang2022, Eq. 41]. The Helmholtz kernel K(x) = e^(−|x|/α)/(2α) solves (1 − α²∂ₓₓ) K = δ; Φ = K∗K = (α + |x|)
//! e^(−|x|/α)/(4α²) smooths the film, h̄ = Φ∗h. Every derivative up to the fourth has the form (c₀ + c₁|x|) e^(−|x|/α), even or odd, which permits recursive
//! sums over particles.

/// Derivatives of Φ by order; the fourth is that for x ≠ 0, without the delta function at 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// Φ.
    Value,
    /// Φ'.
    First,
    /// Φ''.
    Second,
    /// Φ''', which jumps by 1/α⁴ at 0; its value there is 0, so that particles do not move themselves.
    Third,
    /// Φ'''' away from 0.
    Fourth,
}

/// (c₀ + c₁ d) e^(−d/α) at distance d, with the sign of x if it is odd.
#[derive(Debug, Clone, Copy)]
struct Term {
    constant: f64,
    linear: f64,
    odd: bool,
}

/// The smoothing kernel Φ on the infinite line [Pang2022, Eq. 41].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kernel {
    /// Filter length α.
    pub alpha: f64,
}

impl Kernel {
    /// The kernel of filter length `alpha`, above 0, in the unit of x.
    pub fn new(alpha: f64) -> Self {
        Self { alpha }
    }

    fn term(&self, order: Order) -> Term {
        let a = self.alpha;
        match order {
            Order::Value => Term { constant: 0.25 / a, linear: 0.25 / a.powi(2), odd: false },
            Order::First => Term { constant: 0.0, linear: -0.25 / a.powi(3), odd: true },
            Order::Second => Term { constant: -0.25 / a.powi(3), linear: 0.25 / a.powi(4), odd: false },
            Order::Third => Term { constant: 0.5 / a.powi(4), linear: -0.25 / a.powi(5), odd: true },
            Order::Fourth => Term { constant: -0.75 / a.powi(5), linear: 0.25 / a.powi(6), odd: false },
        }
    }

    /// Φ(x) or a derivative of it.
    pub(crate) fn at(&self, order: Order, x: f64) -> f64 {
        let Term { constant, linear, odd } = self.term(order);
        let d = x.abs();
        sign(odd, x) * (constant + linear * d) * (-d / self.alpha).exp()
    }
}

/// Sign of an odd function's argument, 0 at 0; 1 for an even function.
fn sign(odd: bool, x: f64) -> f64 {
    match odd {
        false => 1.0,
        true if x == 0.0 => 0.0,
        true => x.signum(),
    }
}

/// Reference quantities for tests.
#[cfg(test)]
impl Kernel {
    /// Helmholtz kernel K(x).
    pub(crate) fn helmholtz(&self, x: f64) -> f64 {
        (-x.abs() / self.alpha).exp() / (2.0 * self.alpha)
    }
}

/// Simpson's rule with `n` (even) cells.
#[cfg(test)]
pub(super) fn simpson(n: usize, from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let h = (to - from) / n as f64;
    let weight = |i: usize| match i {
        0 => 1.0,
        _ if i == n => 1.0,
        _ if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=n).map(|i| weight(i) * f(from + i as f64 * h)).sum::<f64>() * h / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORDERS: [Order; 5] = [Order::Value, Order::First, Order::Second, Order::Third, Order::Fourth];
    const ALPHA: f64 = 0.05;

    /// [Pang2022, Eq. 41]
    #[test]
    fn phi_is_the_helmholtz_kernel_smoothed_by_itself() {
        let kernel = Kernel::new(ALPHA);
        for x in [0.0, 0.013, 0.05, 0.21] {
            // Split at the kinks; the tails beyond 20 alpha hold e^-40 of the integral.
            let product = |y: f64| kernel.helmholtz(y) * kernel.helmholtz(x - y);
            let reach = 20.0 * ALPHA;
            let folded = simpson(4000, -reach, 0.0, product)
                + if x > 0.0 { simpson(4000, 0.0, x, product) } else { 0.0 }
                + simpson(4000, x, x + reach, product);
            // Simpson's error here is (h/alpha)^4/180, about 1e-11.
            assert!((folded / kernel.at(Order::Value, x) - 1.0).abs() < 1.0e-9, "{x}: {folded}");
        }
    }

    #[test]
    fn phi_has_unit_mass_and_variance_four_alpha_squared() {
        let kernel = Kernel::new(ALPHA);
        let half = |f: &dyn Fn(f64) -> f64| simpson(20_000, 0.0, 40.0 * ALPHA, |x| f(x) * kernel.at(Order::Value, x));
        assert!((2.0 * half(&|_| 1.0) - 1.0).abs() < 1.0e-10);
        assert!((2.0 * half(&|x| x * x) / (4.0 * ALPHA * ALPHA) - 1.0).abs() < 1.0e-10);
    }

    #[test]
    fn each_derivative_integrates_to_the_one_before() {
        let kernel = Kernel::new(ALPHA);
        for pair in ORDERS.windows(2) {
            for (from, to) in [(0.01, 0.12), (-0.3, -0.002)] {
                let integral = simpson(2000, from, to, |x| kernel.at(pair[1], x));
                let difference = kernel.at(pair[0], to) - kernel.at(pair[0], from);
                let scale = kernel.at(pair[0], 0.5 * ALPHA).abs();
                assert!((integral - difference).abs() < 1.0e-10 * scale, "{pair:?}");
            }
        }
    }

    #[test]
    fn the_third_derivative_jumps_by_one_over_alpha_to_the_fourth() {
        let kernel = Kernel::new(ALPHA);
        let tiny = 1.0e-14;
        let jump = kernel.at(Order::Third, tiny) - kernel.at(Order::Third, -tiny);
        assert!((jump * ALPHA.powi(4) - 1.0).abs() < 1.0e-10);
        assert_eq!(kernel.at(Order::Third, 0.0), 0.0);
        assert!((kernel.at(Order::Value, 0.0) - 0.25 / ALPHA).abs() < 1.0e-13);
        assert!((kernel.at(Order::Second, 0.0) * 4.0 * ALPHA.powi(3) + 1.0).abs() < 1.0e-13);
    }
}
