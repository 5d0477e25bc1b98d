//! Sums of the kernel and its derivatives over particles: O(N) by recursion, and O(N²) for comparison.
//!
//! h̄⁽ᵏ⁾(xᵢ) = Σⱼ wⱼ Φ⁽ᵏ⁾(xᵢ − xⱼ) [Pang2022, Sect. 3]. The paper's running sums of w e^(±x/α) overflow for |x| > 709 α; here each particle passes its sums
//! on to the next one with a decay e^(−d/α) over the gap d, so that no exponent is positive. Positions are ascending; coincident particles must be merged
//! before (their order would affect Φ''').

use super::kernel::{Kernel, Order};

/// h̄ and its first three derivatives, one value per particle or position.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Smoothed {
    /// h̄.
    pub height: Vec<f64>,
    /// h̄ₓ.
    pub slope: Vec<f64>,
    /// h̄ₓₓ.
    pub curvature: Vec<f64>,
    /// h̄ₓₓₓ.
    pub third: Vec<f64>,
}

impl Smoothed {
    /// Zeros for `count` values.
    pub fn new(count: usize) -> Self {
        let zeros = || vec![0.0; count];
        Self { height: zeros(), slope: zeros(), curvature: zeros(), third: zeros() }
    }
}

/// Σ w e^(−d/α) and Σ w d e^(−d/α) over the particles on one side of a point, d their distance.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct OneSided {
    pub(crate) plain: f64,
    pub(crate) weighted: f64,
}

impl OneSided {
    /// The sums at a point farther away by `gap`, with `decay` = e^(−gap/α).
    #[inline]
    pub(crate) fn moved(self, gap: f64, decay: f64) -> Self {
        Self { plain: decay * self.plain, weighted: decay * (self.weighted + gap * self.plain) }
    }

    /// The sums with one more particle at the present point.
    #[inline]
    pub(crate) fn with(self, weight: f64) -> Self {
        Self { plain: self.plain + weight, ..self }
    }
}

/// The coefficients of the sums.
#[derive(Debug, Clone, Copy)]
struct Factors {
    alpha: f64,
    height: f64,
    slope: f64,
    curvature: f64,
}

impl Factors {
    fn new(kernel: &Kernel) -> Self {
        let alpha = kernel.alpha;
        Self { alpha, height: 0.25 / alpha.powi(2), slope: 0.25 / alpha.powi(3), curvature: 0.25 / alpha.powi(4) }
    }
}

/// The recursion for the sums of the kernel over particles [Pang2022, Sect. 3], with its work space, reused in each step.
#[derive(Debug, Clone)]
pub struct FastSums {
    kernel: Kernel,
    decay: Vec<f64>,
}

impl FastSums {
    /// Sums for the given kernel.
    pub fn new(kernel: Kernel) -> Self {
        Self { kernel, decay: Vec::new() }
    }

    /// h̄ and its derivatives at the particles. `x` is ascending; `x`, `weight` and the fields of `out` have the same length.
    pub fn at_particles(&mut self, x: &[f64], weight: &[f64], out: &mut Smoothed) {
        let count = x.len();
        let rate = -1.0 / self.kernel.alpha;
        self.decay.clear();
        self.decay.extend(x.windows(2).map(|pair| (rate * (pair[1] - pair[0])).exp()));
        // The left sums are stored in the fields to which they contribute.
        let mut left = OneSided::default();
        for i in 0..count {
            if i > 0 {
                left = left.with(weight[i - 1]).moved(x[i] - x[i - 1], self.decay[i - 1]);
            }
            (out.height[i], out.slope[i]) = (left.plain, left.weighted);
        }
        let factors = Factors::new(&self.kernel);
        let mut right = OneSided::default();
        for i in (0..count).rev() {
            if i + 1 < count {
                right = right.with(weight[i + 1]).moved(x[i + 1] - x[i], self.decay[i]);
            }
            let (a, b) = (out.height[i], out.slope[i]);
            let both = factors.alpha * (a + weight[i] + right.plain);
            let far = b + right.weighted;
            let tilt = b - right.weighted;
            out.height[i] = factors.height * (both + far);
            out.slope[i] = -factors.slope * tilt;
            out.curvature[i] = factors.curvature * (far - both);
            out.third[i] = factors.curvature * (2.0 * (a - right.plain) - tilt / factors.alpha);
        }
    }

    /// h̄, h̄ₓ and h̄ₓₓ at other ascending positions; the third derivative, which jumps at particles, is left at zero.
    pub(crate) fn at_positions(&self, x: &[f64], weight: &[f64], positions: &[f64]) -> Smoothed {
        let rate = -1.0 / self.kernel.alpha;
        let factors = Factors::new(&self.kernel);
        let moved = |sums: OneSided, gap: f64| sums.moved(gap, (rate * gap).exp());
        let mut out = Smoothed::new(positions.len());
        // Sums at the last particle passed, including that particle.
        let (mut sums, mut next) = (OneSided::default(), 0);
        for (i, &position) in positions.iter().enumerate() {
            while next < x.len() && x[next] <= position {
                let gap = if next == 0 { 0.0 } else { x[next] - x[next - 1] };
                sums = moved(sums, gap).with(weight[next]);
                next += 1;
            }
            let here = if next == 0 { sums } else { moved(sums, position - x[next - 1]) };
            (out.height[i], out.slope[i]) = (here.plain, here.weighted);
        }
        let (mut sums, mut next) = (OneSided::default(), x.len());
        for (i, &position) in positions.iter().enumerate().rev() {
            while next > 0 && x[next - 1] > position {
                let gap = if next == x.len() { 0.0 } else { x[next] - x[next - 1] };
                sums = moved(sums, gap).with(weight[next - 1]);
                next -= 1;
            }
            let right = if next == x.len() { sums } else { moved(sums, x[next] - position) };
            let (a, b) = (out.height[i], out.slope[i]);
            let (both, far) = (factors.alpha * (a + right.plain), b + right.weighted);
            out.height[i] = factors.height * (both + far);
            out.slope[i] = -factors.slope * (b - right.weighted);
            out.curvature[i] = factors.curvature * (far - both);
        }
        out
    }
}

/// The direct sums, for particles in any order: slow, but without recursion.
pub fn direct_sums(kernel: &Kernel, x: &[f64], weight: &[f64]) -> Smoothed {
    let sum = |order: Order| -> Vec<f64> {
        x.iter().map(|&xi| x.iter().zip(weight).map(|(&xj, &wj)| wj * kernel.at(order, xi - xj)).sum()).collect()
    };
    Smoothed {
        height: sum(Order::Value),
        slope: sum(Order::First),
        curvature: sum(Order::Second),
        third: sum(Order::Third),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Positions with uneven gaps on [−l, l] and uneven weights.
    fn particles(count: usize, half: f64) -> (Vec<f64>, Vec<f64>) {
        let step = 2.0 * half / count as f64;
        let wave = |i: usize| (12.9898 * i as f64).sin();
        let x = (0..count).map(|i| -half + step * (i as f64 + 0.45 * wave(i))).collect();
        let weight = (0..count).map(|i| step * (1.0 + 0.5 * wave(3 * i + 1))).collect();
        (x, weight)
    }

    /// Largest difference over the largest value.
    fn difference(a: &[f64], b: &[f64]) -> f64 {
        let largest = b.iter().map(|v| v.abs()).fold(0.0, f64::max);
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
    }

    /// [Pang2022, Sect. 3]
    #[test]
    fn the_recursion_agrees_with_the_direct_sums() {
        // The last line is ten thousand filter lengths long: nothing overflows.
        for (count, half, alpha) in
            [(1, 1.0, 0.1), (2, 1.0, 0.1), (200, 2.0, 0.05), (800, 2.0, 0.05), (2000, 2.0, 0.005), (1500, 50.0, 0.01)]
        {
            let (x, weight) = particles(count, half);
            let kernel = Kernel::new(alpha);
            let mut fast = Smoothed::new(count);
            FastSums::new(kernel).at_particles(&x, &weight, &mut fast);
            let slow = direct_sums(&kernel, &x, &weight);
            assert!(difference(&fast.height, &slow.height) < 1.0e-12);
            assert!(difference(&fast.curvature, &slow.curvature) < 1.0e-12);
            if count > 1 {
                assert!(difference(&fast.slope, &slow.slope) < 1.0e-12);
                assert!(difference(&fast.third, &slow.third) < 1.0e-12);
            }
        }
    }

    #[test]
    fn places_between_particles_see_the_direct_sums() {
        let (x, weight) = particles(300, 1.0);
        let kernel = Kernel::new(0.05);
        let mut positions: Vec<f64> = (0..400).map(|i| -1.6 + 0.0081 * f64::from(i)).collect();
        positions.extend_from_slice(&x);
        positions.sort_by(f64::total_cmp);
        let found = FastSums::new(kernel).at_positions(&x, &weight, &positions);
        let sum = |order: Order| -> Vec<f64> {
            let at = |&p: &f64| x.iter().zip(&weight).map(|(&xj, &wj)| wj * kernel.at(order, p - xj)).sum();
            positions.iter().map(at).collect()
        };
        assert!(difference(&found.height, &sum(Order::Value)) < 1.0e-12);
        assert!(difference(&found.slope, &sum(Order::First)) < 1.0e-12);
        assert!(difference(&found.curvature, &sum(Order::Second)) < 1.0e-12);
    }
}
