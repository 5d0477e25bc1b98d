//! Implicit time steps of a film on a grid: backward Euler, Newton's method with a line search, and step size control.
//!
//! A step solves G(v) = 0 for the heights v at its end. Order 1 in time. Newton's method ends when the residual or the next change of the heights is small,
//! or when no change reduces a residual at the level of the rounding of its terms: on fine grids and in long steps rounding keeps the residual of a fourth
//! derivative from being small. The factors of a Jacobian are reused as long as each change reduces the residual by a given factor: a factorization costs
//! several times a solution. No factors are kept between steps: a step depends on the heights, the time and the proposed step only, so that a resumed run is
//! bitwise identical to an uninterrupted one.

use super::sparse::Factors;

/// Newton's method stops below this norm of the residual or of a change: √∫ r² over the wall, in scaled heights. The paper takes 1e-9 of the plain 2-norm
/// over the nodes, which rounding makes unattainable on fine grids (Pang and Ó Náraigh 2022, section 6).
pub(crate) const RESIDUAL: f64 = 1.0e-9;
/// A step with more factorizations than this is too large; normally 1 or 2 suffice.
pub(crate) const FACTORS: u32 = 12;
/// The factors of a Jacobian are reused after a change that reduced the residual to at most this fraction.
const KEPT: f64 = 0.2;
/// Smallest fraction of a Newton step in the line search.
const SHORTEST: f64 = 1.0 / 64.0;
/// Factor by which a step is reduced after a failure.
const CUT: f64 = 0.3;
/// Smallest step over the first one of the rule.
const SMALLEST: f64 = 1.0e-6;

/// Maximum number of rejected steps: moving films need a few dozen, films long at rest up to two per accepted step.
const MOST_REJECTED: u64 = 2000;

/// Limit of the estimate of the number of steps.
const MOST_COUNTED: f64 = 1.0e8;

/// The nonlinear system of a step.
pub trait Balance {
    /// G(v), for a step of length `dt` that starts from the heights `old`.
    fn residual(&self, v: &[f64], old: &[f64], dt: f64) -> Vec<f64>;

    /// √∫ v² over the wall.
    fn norm(&self, v: &[f64]) -> f64;

    /// The norm of the residual in units of height.
    fn size(&self, residual: &[f64]) -> f64;

    /// Upper bound of the rounding of G at `v`, in the norm of [`size`](Self::size).
    fn rounding(&self, v: &[f64], dt: f64) -> f64;

    /// The factors of the Jacobian J of G at `v`; `None` if J is singular.
    fn jacobian(&self, v: &[f64], dt: f64) -> Option<Factors>;

    /// Whether a solution is physically a film.
    fn acceptable(&self, v: &[f64]) -> bool;
}

/// Step size control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepRule {
    /// The first step.
    pub first: f64,
    /// Largest ratio of successive steps.
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
    pub fn fixed(dt: f64) -> Self {
        Self { first: dt, growth: 1.0, share: f64::INFINITY, longest: dt }
    }
}

/// A step for which Newton's method fails, however short it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NotSolved {
    /// The step.
    pub dt: f64,
    /// Norm of the final residual; absent if Newton's method ended at negative heights, which are not a film.
    pub residual: Option<f64>,
}

/// State of the time integration.
#[derive(Debug, Clone)]
pub struct BackwardEuler {
    /// Heights at the nodes.
    pub height: Vec<f64>,
    pub time: f64,
    /// The step to try next.
    pub next: f64,
    rule: StepRule,
    /// Newton iterations so far.
    pub iterations: u64,
    /// Factorizations so far.
    pub factors: u64,
    /// Number of rejected steps.
    pub rejected: u64,
}

impl BackwardEuler {
    /// Heights at time zero.
    pub(crate) fn new(height: Vec<f64>, rule: StepRule) -> Self {
        Self { height, time: 0.0, next: rule.first, rule, iterations: 0, factors: 0, rejected: 0 }
    }

    /// Number of steps to `end` if none is rejected.
    pub(crate) fn steps_to(&self, end: f64) -> f64 {
        let (mut time, mut next, mut count) = (self.time, self.next, 0.0);
        while time < end && count < MOST_COUNTED {
            let dt: f64 = next.min(self.rule.longest).min((self.rule.share * time).max(self.rule.first));
            time += dt;
            next = self.rule.growth * dt;
            count += 1.0;
        }
        count
    }

    /// Does one step that ends at `until` or before; `until` is reached exactly. Returns its length.
    ///
    /// # Errors
    /// [`NotSolved`]; the state is kept.
    pub(crate) fn step(&mut self, balance: &(impl Balance + ?Sized), until: f64) -> Result<f64, NotSolved> {
        loop {
            let left = until - self.time;
            let longest = self.rule.longest.min((self.rule.share * self.time).max(self.rule.first));
            let wanted = self.next.min(longest);
            // Equal steps miss the end by rounding only, which must not become a step of its own.
            let lands = wanted * (1.0 + 1.0e-9) >= left;
            // Two halves rather than a full step and a tiny remainder.
            let dt = if lands { left } else { wanted.min(0.5 * left).max(0.5 * wanted) };
            match self.solve(balance, dt) {
                Ok(height) => {
                    self.height = height;
                    self.time = if lands { until } else { self.time + dt };
                    self.next = if dt < wanted { wanted } else { self.rule.growth * dt };
                    return Ok(dt);
                }
                Err(residual) => {
                    self.rejected += 1;
                    self.next = CUT * dt;
                    if self.next < SMALLEST * self.rule.first || self.rejected > MOST_REJECTED {
                        return Err(NotSolved { dt, residual });
                    }
                }
            }
        }
    }

    /// Runs to `until`.
    pub(crate) fn run(&mut self, balance: &(impl Balance + ?Sized), until: f64) -> Result<(), NotSolved> {
        while self.time < until {
            self.step(balance, until)?;
        }
        Ok(())
    }

    /// Newton's method with a line search on the norm of the residual. On failure the final residual, `None` if the heights are not a film.
    fn solve(&mut self, balance: &(impl Balance + ?Sized), dt: f64) -> Result<Vec<f64>, Option<f64>> {
        let mut v = self.height.clone();
        let mut residual = balance.residual(&v, &self.height, dt);
        let mut size = balance.size(&residual);
        let mut kept: Option<Factors> = None;
        let mut factored = 0;
        let mut ends_by_rounding = false;
        while size >= RESIDUAL {
            let is_new = kept.is_none();
            let factors = match kept.take() {
                Some(factors) => factors,
                None if factored == FACTORS => {
                    ends_by_rounding = size < balance.rounding(&v, dt);
                    break;
                }
                None => balance.jacobian(&v, dt).ok_or(Some(size))?,
            };
            factored += u32::from(is_new);
            self.factors += u64::from(is_new);
            self.iterations += 1;
            let mut change = residual.clone();
            factors.solve(&mut change);
            let moved = |share: f64| -> Vec<f64> { v.iter().zip(&change).map(|(v, c)| v - share * c).collect() };
            if balance.norm(&change) < RESIDUAL {
                v = moved(1.0);
                ends_by_rounding = true;
                break;
            }
            // Old factors are not worth a line search: new ones are computed instead.
            let shortest = if is_new { SHORTEST } else { 1.0 };
            let mut share = 1.0;
            let found = loop {
                let trial = moved(share);
                let residual = balance.residual(&trial, &self.height, dt);
                let size_there = balance.size(&residual);
                if size_there < size {
                    break Some((trial, residual, size_there));
                }
                share *= 0.5;
                if share < shortest {
                    break None;
                }
            };
            match found {
                Some((trial, residual_there, size_there)) => {
                    kept = (size_there < KEPT * size).then_some(factors);
                    (v, residual, size) = (trial, residual_there, size_there);
                }
                None if is_new => {
                    ends_by_rounding = size < balance.rounding(&v, dt);
                    break;
                }
                None => {}
            }
        }
        // A NaN is not a film either.
        let is_solved = size < RESIDUAL || ends_by_rounding;
        match (is_solved && size.is_finite(), balance.acceptable(&v)) {
            (false, _) => Err(Some(size)),
            (true, false) => Err(None),
            (true, true) => Ok(v),
        }
    }
}
