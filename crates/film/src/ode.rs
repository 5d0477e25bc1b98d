//! Time integration of particles: an explicit and a stiff one-step method with error control.
//!
//! Both methods depend on the present state and the proposed step only, so that a run resumed from a saved state is bitwise identical to an uninterrupted
//! one; multistep methods would have to save their history. Explicit: Dormand and Prince 1980, order 5(4). Stiff: RODAS, order 4(3), L-stable, 6 stages
//! (Hairer and Wanner, Solving Ordinary Differential Equations II, 1996, Sect. VI.4). Both are for autonomous systems.

use meniscus_case::film::FilmIntegrator;

/// ẋ = f(x).
pub trait Rates {
    /// Writes f(x).
    fn rates(&mut self, x: &[f64], out: &mut [f64]);

    /// Whether a state is admissible.
    fn admissible(&self, x: &[f64]) -> bool;
}

/// Rates whose Jacobian J is available for implicit steps.
pub trait Implicit: Rates {
    /// The factored matrix.
    type System;

    /// Factors `shift` − J(x); `None` if that is singular.
    fn factor(&mut self, x: &[f64], shift: f64) -> Option<Self::System>;

    /// Replaces `rhs` by the solution.
    fn solve(system: &mut Self::System, rhs: &mut [f64]);
}

/// Tolerance of the error per step: absolute + relative |x|.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// In the unit of x.
    pub absolute: f64,
    /// Relative to |x|.
    pub relative: f64,
}

/// Work counters.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the rates.
    pub rates: u64,
    /// Factorizations.
    pub factors: u64,
    /// Number of rejected steps.
    pub rejected: u64,
}

/// State of a time integration.
#[derive(Debug, Clone)]
pub struct Integrator {
    pub(crate) method: FilmIntegrator,
    pub tolerance: Tolerance,
    pub time: f64,
    /// State.
    pub x: Vec<f64>,
    /// The step to try next.
    pub next: f64,
    /// Work counters.
    pub work: Work,
    stages: Vec<Vec<f64>>,
}

/// No accepted step down to this size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepTooSmall(pub f64);

/// Bounds of the ratio of successive steps, and the fraction of the tolerance aimed at.
const SHRINK: f64 = 0.2;
const GROW: f64 = 5.0;
const SAFETY: f64 = 0.9;
/// Step of the stiff method over the time, in a spreading droplet, at this tolerance; it scales as the fourth root of the tolerance.
const SHARE: f64 = 0.2;
const SHARE_AT: f64 = 1.0e-7;
/// Smallest step over the present time (or over 1 at time zero).
const SMALLEST: f64 = 1.0e-15;

impl Integrator {
    /// A state at time zero with a first step to try.
    pub fn new(method: FilmIntegrator, tolerance: Tolerance, x: Vec<f64>, first: f64) -> Self {
        Self { method, tolerance, time: 0.0, x, next: first, work: Work::default(), stages: Vec::new() }
    }

    /// Does one step that ends at `until` or before; `until` is reached exactly. Returns its length.
    ///
    /// # Errors
    /// [`StepTooSmall`] if no step is accepted; the state is kept.
    pub fn step(&mut self, system: &mut impl Implicit, until: f64) -> Result<f64, StepTooSmall> {
        loop {
            let left = until - self.time;
            let cut = self.next >= left;
            // Two halves rather than a full step and a tiny remainder.
            let dt = if cut { left } else { self.next.min(0.5 * left).max(self.next.min(left) * 0.5) };
            let (order, trial) = match self.method {
                FilmIntegrator::Explicit => (5.0, self.explicit(system, dt)),
                FilmIntegrator::Stiff => (4.0, self.stiff(system, dt)),
            };
            let factor = match &trial {
                Some((_, error)) if error.is_finite() => (SAFETY * error.powf(-1.0 / order)).clamp(SHRINK, GROW),
                _ => SHRINK,
            };
            if let Some((x, error)) = trial
                && error <= 1.0
                && system.admissible(&x)
            {
                self.x = x;
                self.time = if cut { until } else { self.time + dt };
                // A step truncated at `until` is no measure of the possible step.
                self.next = if dt < self.next { self.next.max(dt * factor) } else { dt * factor };
                return Ok(dt);
            }
            self.work.rejected += 1;
            self.next = dt * factor.min(0.5);
            if self.next < SMALLEST * self.time.max(1.0) {
                return Err(StepTooSmall(self.next));
            }
        }
    }

    /// Approximate number of steps of the stiff method to `end`: they grow in proportion to the time. Those of the explicit method are limited by stability,
    /// for which the length of the last step is the better estimate.
    pub(crate) fn steps_to(&self, end: f64) -> Option<f64> {
        if self.method == FilmIntegrator::Explicit {
            return None;
        }
        let share = SHARE * (self.tolerance.absolute / SHARE_AT).powf(0.25);
        let start = self.time.max(self.next);
        Some((end / start).max(1.0).ln() / share.ln_1p())
    }

    /// Runs to `until`.
    pub fn run(&mut self, system: &mut impl Implicit, until: f64) -> Result<(), StepTooSmall> {
        while self.time < until {
            self.step(system, until)?;
        }
        Ok(())
    }

    /// Largest error over tolerance.
    fn norm(&self, error: &[f64], x: &[f64]) -> f64 {
        let share = |i: usize| {
            let scale = self.tolerance.absolute + self.tolerance.relative * self.x[i].abs().max(x[i].abs());
            (error[i] / scale).powi(2)
        };
        ((0..x.len()).map(share).sum::<f64>() / x.len().max(1) as f64).sqrt()
    }

    fn room(&mut self, stages: usize) -> Vec<Vec<f64>> {
        let mut room = std::mem::take(&mut self.stages);
        room.resize_with(stages, Vec::new);
        room.iter_mut().for_each(|stage| stage.resize(self.x.len(), 0.0));
        room
    }

    /// A step of the explicit method of order 5(4), with its error over the tolerance \[Dormand1980\].
    fn explicit(&mut self, system: &mut impl Rates, dt: f64) -> Option<(Vec<f64>, f64)> {
        let mut k = self.room(7);
        let mut x = self.x.clone();
        let mut inside = true;
        for stage in 0..7 {
            if stage > 0 {
                x = combined(&self.x, dt, &DORMAND_PRINCE[stage - 1][..stage], &k);
                inside &= system.admissible(&x);
            }
            if !inside {
                break;
            }
            system.rates(&x, &mut k[stage]);
            self.work.rates += 1;
        }
        let zeros = vec![0.0; x.len()];
        let error = combined(&zeros, dt, &DORMAND_PRINCE_ERROR, &k);
        let norm = self.norm(&error, &x);
        self.stages = k;
        inside.then_some((x, norm))
    }

    /// A step of RODAS, a linearly implicit method of order 4(3), with its error over the tolerance \[Hairer1996\].
    fn stiff<S: Implicit>(&mut self, system: &mut S, dt: f64) -> Option<(Vec<f64>, f64)> {
        let mut matrix = system.factor(&self.x, 1.0 / (RODAS_GAMMA * dt))?;
        self.work.factors += 1;
        let mut k = self.room(6);
        let mut x = self.x.clone();
        for stage in 0..6 {
            if stage > 0 {
                x = combined(&self.x, 1.0, RODAS_A[stage - 1], &k);
            }
            // The recursive sums need ordered particles.
            if !system.admissible(&x) {
                self.stages = k;
                return None;
            }
            let mut rhs = vec![0.0; x.len()];
            system.rates(&x, &mut rhs);
            self.work.rates += 1;
            if stage > 0 {
                rhs = combined(&rhs, 1.0 / dt, RODAS_C[stage - 1], &k);
            }
            S::solve(&mut matrix, &mut rhs);
            k[stage] = rhs;
        }
        x.iter_mut().zip(&k[5]).for_each(|(x, last)| *x += last);
        let norm = self.norm(&k[5], &x);
        self.stages = k;
        Some((x, norm))
    }
}

/// x + scale Σ aₛ kₛ.
fn combined(x: &[f64], scale: f64, a: &[f64], k: &[Vec<f64>]) -> Vec<f64> {
    let mut sum = x.to_vec();
    for (a, k) in a.iter().zip(k) {
        let share = scale * a;
        sum.iter_mut().zip(k).for_each(|(sum, k)| *sum += share * k);
    }
    sum
}

/// Rows 2 to 7 of the tableau; the last one is the solution.
const DORMAND_PRINCE: [[f64; 6]; 6] = [
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// The solution minus the embedded one of order 4.
const DORMAND_PRINCE_ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

const RODAS_GAMMA: f64 = 0.25;

const RODAS_A: [&[f64]; 5] = [
    &[1.544],
    &[0.946_678_528_081_582_6, 0.255_701_169_898_328_4],
    &[3.314_825_187_068_521, 2.896_124_015_972_201, 0.998_641_913_997_781_7],
    &[1.221_224_509_226_641, 6.019_134_481_288_629, 12.537_083_329_320_87, -0.687_886_036_105_895],
    &[1.221_224_509_226_641, 6.019_134_481_288_629, 12.537_083_329_320_87, -0.687_886_036_105_895, 1.0],
];

const RODAS_C: [&[f64]; 5] = [
    &[-5.6688],
    &[-2.430_093_356_833_875, -0.206_359_915_709_191_5],
    &[-0.107_352_905_815_137_5, -9.594_562_251_023_355, -20.470_286_148_096_16],
    &[7.496_443_313_967_647, -10.246_804_314_643_52, -33.999_903_528_199_05, 11.708_908_932_061_6],
    &[
        8.083_246_795_921_522,
        -7.981_132_988_064_893,
        -31.521_594_328_743_71,
        16.319_305_431_231_36,
        -6.058_818_238_834_054,
    ],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// ẋ = −y + x (1 − x² − y²), ẏ = x + y (1 − x² − y²): trajectories on the unit circle stay on it and rotate at 1 rad/s.
    struct Circle;

    impl Rates for Circle {
        fn rates(&mut self, x: &[f64], out: &mut [f64]) {
            let rest = 1.0 - x[0] * x[0] - x[1] * x[1];
            out.copy_from_slice(&[-x[1] + x[0] * rest, x[0] + x[1] * rest]);
        }

        fn admissible(&self, x: &[f64]) -> bool {
            x.iter().all(|x| x.is_finite())
        }
    }

    impl Implicit for Circle {
        type System = [f64; 4];

        fn factor(&mut self, x: &[f64], shift: f64) -> Option<[f64; 4]> {
            let rest = 1.0 - x[0] * x[0] - x[1] * x[1];
            let cross = 2.0 * x[0] * x[1];
            Some([shift - rest + 2.0 * x[0] * x[0], 1.0 + cross, -1.0 + cross, shift - rest + 2.0 * x[1] * x[1]])
        }

        fn solve(m: &mut [f64; 4], rhs: &mut [f64]) {
            let determinant = m[0] * m[3] - m[1] * m[2];
            let (a, b) = (rhs[0], rhs[1]);
            rhs[0] = (m[3] * a - m[1] * b) / determinant;
            rhs[1] = (m[0] * b - m[2] * a) / determinant;
        }
    }

    /// Error after a quarter turn in `steps` equal steps.
    fn error(method: FilmIntegrator, steps: u32) -> f64 {
        let loose = Tolerance { absolute: 1.0e9, relative: 0.0 };
        let dt = std::f64::consts::FRAC_PI_2 / f64::from(steps);
        let mut integrator = Integrator::new(method, loose, vec![1.0, 0.0], dt);
        for i in 1..=steps {
            integrator.next = 2.0 * dt;
            integrator.step(&mut Circle, f64::from(i) * dt).unwrap();
        }
        integrator.x[0].hypot(integrator.x[1] - 1.0)
    }

    /// [Dormand1980; Hairer1996]
    #[test]
    fn the_methods_have_the_orders_of_their_names() {
        for (method, order) in [(FilmIntegrator::Explicit, 5.0), (FilmIntegrator::Stiff, 4.0)] {
            let found = (error(method, 20) / error(method, 40)).log2();
            // Higher-order terms bend the line a little; on a circle some of the leading ones cancel.
            assert!(found > order - 0.3 && found < order + 1.2, "{method:?}: {found}");
        }
    }

    #[test]
    fn the_error_stays_near_the_tolerance_and_the_end_is_met_exactly() {
        for method in [FilmIntegrator::Explicit, FilmIntegrator::Stiff] {
            let tolerance = Tolerance { absolute: 1.0e-9, relative: 0.0 };
            let mut integrator = Integrator::new(method, tolerance, vec![1.0, 0.0], 1.0e-3);
            integrator.run(&mut Circle, 3.0).unwrap();
            assert_eq!(integrator.time, 3.0);
            let off = (integrator.x[0] - 3.0_f64.cos()).hypot(integrator.x[1] - 3.0_f64.sin());
            assert!(off < 1.0e-7, "{method:?}: {off}");
        }
    }
}
