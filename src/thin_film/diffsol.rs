//! Steps of the particles by the library diffsol: ESDIRK34 for stiff films, Tsit45 as the explicit pair.
//!
//! The stiff method sees the recursive sums as further, algebraic unknowns: M y' = F(y) with five rows a particle, seven in partial
//! wetting, where the overlap ⟨h, h̄⟩ is summed from the left and handed back from the right, so that every row has a few entries.
//! Each step begins from places, time and step alone, so that a resumed run gives the same bits; the library's multistep
//! method would lose its history. It leaves out the lattice energy.

use std::cell::RefCell;

use diffsol::error::DiffsolError;
use diffsol::{
    ConstantOp, FaerContext, FaerSparseLU, FaerSparseMat, FaerVec, LinearOp, Matrix, NonLinearOp, NonLinearOpJacobian,
    OdeBuilder, OdeEquations, OdeEquationsRef, OdeSolverMethod, OdeSolverState, OdeSolverStopReason, Op,
    ParameterisedOp, RkState, UnitCallable, Vector,
};

use super::ode::{Integrator, Method, Rates, StepTooSmall};
use super::particles::ParticleMethod;

/// Relative tolerance where only an absolute one is asked for: rounding.
const ROUNDING: f64 = 1.0e-14;
/// A step after which particles had left their order is done again with this share.
const SHRINK: f64 = 0.2;
/// Smallest step over the present time (or over 1 at time zero).
const SMALLEST: f64 = 1.0e-15;

/// What a step leads to.
struct Reached {
    x: Vec<f64>,
    time: f64,
    next: f64,
    landed: bool,
    factors: usize,
}

/// Does one step that ends at `until` or before. Gives back its length.
///
/// # Errors
/// [`StepTooSmall`] where no step is accepted; the state is kept.
pub fn step(method: &ParticleMethod, state: &mut Integrator, until: f64) -> Result<f64, StepTooSmall> {
    let mut first = state.next;
    loop {
        let reached = match state.method {
            Method::Stiff => stiff(method, state, first, until),
            Method::Explicit => explicit(method, state, first, until),
        };
        if let Ok(reached) = reached
            && method.admissible(&reached.x)
        {
            let dt = reached.time - state.time;
            state.work.factors += reached.factors as u64;
            state.x = reached.x;
            state.time = if reached.landed { until } else { reached.time };
            // A step that was cut to land tells little of the step that could have been.
            state.next = if dt < first { reached.next.max(first) } else { reached.next };
            return Ok(dt);
        }
        state.work.rejected += 1;
        first *= SHRINK;
        if first < SMALLEST * state.time.max(1.0) {
            return Err(StepTooSmall(first));
        }
    }
}

fn stiff(method: &ParticleMethod, from: &Integrator, first: f64, until: f64) -> Result<Reached, DiffsolError> {
    let system = System::new(method, &from.x);
    let block = system.block;
    // The error is that of the places; sums follow from them.
    let tolerance = from.tolerance.absolute / (block as f64).sqrt();
    let rows = system.start.len();
    let problem = OdeBuilder::<FaerSparseMat<f64>>::new()
        .t0(from.time)
        .h0(first.min(until - from.time))
        .rtol(from.tolerance.relative.max(ROUNDING))
        .atol(vec![tolerance; rows])
        .build_from_eqn(system)?;
    let state = RkState::new_without_initialise(&problem)?;
    let mut solver = problem.esdirk34_solver::<FaerSparseLU<f64>>(state)?;
    solver.set_stop_time(until)?;
    let landed = matches!(solver.step()?, OdeSolverStopReason::TstopReached);
    let factors = solver.get_statistics().number_of_linear_solver_setups;
    let end = solver.state();
    let x = end.y.clone_as_vec().into_iter().step_by(block).collect();
    Ok(Reached { x, time: end.t, next: end.h, landed, factors })
}

fn explicit(method: &ParticleMethod, from: &Integrator, first: f64, until: f64) -> Result<Reached, DiffsolError> {
    let particles = RefCell::new(method.clone());
    let start = from.x.clone();
    let count = start.len();
    let problem = OdeBuilder::<FaerSparseMat<f64>>::new()
        .t0(from.time)
        .h0(first.min(until - from.time))
        .rtol(from.tolerance.relative.max(ROUNDING))
        .atol(vec![from.tolerance.absolute; count])
        .rhs(move |x: &[f64], _: &[f64], _: f64, rate: &mut [f64]| particles.borrow_mut().rates(x, rate))
        .init(move |_: &[f64], _: f64, x: &mut [f64]| x.copy_from_slice(&start), count)
        .build()?;
    let state = RkState::new_without_initialise(&problem)?;
    let mut solver = problem.tsit45_solver(state)?;
    solver.set_stop_time(until)?;
    let landed = matches!(solver.step()?, OdeSolverStopReason::TstopReached);
    let end = solver.state();
    Ok(Reached { x: end.y.clone_as_vec(), time: end.t, next: end.h, landed, factors: 0 })
}

/// Places of a particle's unknowns in its block.
const PLACE: usize = 0;
const LEFT: usize = 1;
const LEFT_WEIGHTED: usize = 2;
const RIGHT: usize = 3;
const RIGHT_WEIGHTED: usize = 4;
const OVERLAP: usize = 5;
const TOTAL: usize = 6;
/// The four sums that h̄ and its derivatives follow from.
const SUMS: [usize; 4] = [LEFT, LEFT_WEIGHTED, RIGHT, RIGHT_WEIGHTED];

/// M y' = F(y).
struct System {
    alpha: f64,
    weight: Vec<f64>,
    /// 2χA², above 0 in partial wetting.
    pull: f64,
    bond: f64,
    block: usize,
    start: Vec<f64>,
    context: FaerContext,
}

/// Numbers at a particle.
struct Local {
    height: f64,
    slope: f64,
    /// h̄ₓₓₓ + (ξ² − Bo) h̄ₓ.
    drive: f64,
    /// ξ² − Bo.
    pull: f64,
}

impl System {
    fn new(method: &ParticleMethod, x: &[f64]) -> Self {
        let pull = method.pull();
        let mut system = Self {
            alpha: method.kernel().alpha(),
            weight: method.weight().to_vec(),
            pull: 2.0 * pull.wetting * method.area().powi(2),
            bond: pull.bond,
            block: if pull.wetting > 0.0 { TOTAL + 1 } else { RIGHT_WEIGHTED + 1 },
            start: Vec::new(),
            context: FaerContext::default(),
        };
        system.start = system.consistent(x);
        system
    }

    fn count(&self) -> usize {
        self.weight.len()
    }

    /// Factors of the four sums in h̄, h̄ₓ and h̄ₓₓₓ.
    fn factors(&self) -> [[f64; 4]; 3] {
        let a = self.alpha;
        let (height, slope, third) = (0.25 / a.powi(2), 0.25 / a.powi(3), 0.25 / a.powi(4));
        [
            [a * height, height, a * height, height],
            [0.0, -slope, 0.0, slope],
            [2.0 * third, -third / a, -2.0 * third, third / a],
        ]
    }

    fn local(&self, y: &[f64], i: usize) -> Local {
        let at = self.block * i;
        let sum =
            |factors: &[f64; 4]| SUMS.iter().zip(factors).map(|(&part, factor)| factor * y[at + part]).sum::<f64>();
        let [height, slope, third] = self.factors();
        let own = self.weight[i] * height[0];
        let (height, slope, third) = (sum(&height) + own, sum(&slope), sum(&third));
        let xi_squared = if self.pull > 0.0 { self.pull / y[at + TOTAL].powi(2) } else { 0.0 };
        let pull = xi_squared - self.bond;
        Local { height, slope, drive: third + pull * slope, pull }
    }

    /// Places with the sums that belong to them.
    fn consistent(&self, x: &[f64]) -> Vec<f64> {
        let (n, block) = (self.count(), self.block);
        let mut y = vec![0.0; block * n];
        for (i, place) in x.iter().enumerate() {
            y[block * i + PLACE] = *place;
        }
        for i in 1..n {
            let (at, other) = (block * i, block * (i - 1));
            [y[at + LEFT], y[at + LEFT_WEIGHTED]] = self.handed_on(&y[other..], LEFT, i - 1, x[i] - x[i - 1]);
        }
        for i in (0..n.saturating_sub(1)).rev() {
            let (at, other) = (block * i, block * (i + 1));
            [y[at + RIGHT], y[at + RIGHT_WEIGHTED]] = self.handed_on(&y[other..], RIGHT, i + 1, x[i + 1] - x[i]);
        }
        if self.pull > 0.0 {
            let heights: Vec<f64> = (0..n).map(|i| self.local(&y, i).height).collect();
            let mut total = 0.0;
            for i in 0..n {
                total += self.weight[i] * heights[i];
                y[block * i + OVERLAP] = total;
            }
            (0..n).for_each(|i| y[block * i + TOTAL] = total);
        }
        y
    }

    /// The pair of sums that the neighbor whose block begins `other` hands on over a gap.
    fn handed_on(&self, other: &[f64], part: usize, neighbor: usize, gap: f64) -> [f64; 2] {
        let decay = (-gap / self.alpha).exp();
        let plain = other[part] + self.weight[neighbor];
        [decay * plain, decay * (other[part + 1] + gap * plain)]
    }

    /// F(y).
    fn right_side(&self, y: &[f64], out: &mut [f64]) {
        let (n, block) = (self.count(), self.block);
        for i in 0..n {
            let at = block * i;
            let local = self.local(y, i);
            out[at + PLACE] = local.height.powi(2) * local.drive;
            out[at + LEFT..=at + RIGHT_WEIGHTED].copy_from_slice(&y[at + LEFT..=at + RIGHT_WEIGHTED]);
            for (part, neighbor) in self.neighbors(i) {
                let other = block * neighbor;
                let gap = (y[at] - y[other]).abs();
                let [plain, weighted] = self.handed_on(&y[other..], part, neighbor, gap);
                out[at + part] -= plain;
                out[at + part + 1] -= weighted;
            }
            if self.pull > 0.0 {
                let before = if i > 0 { y[at - block + OVERLAP] } else { 0.0 };
                let after = if i + 1 < n { y[at + block + TOTAL] } else { y[at + OVERLAP] };
                out[at + OVERLAP] = y[at + OVERLAP] - before - self.weight[i] * local.height;
                out[at + TOTAL] = y[at + TOTAL] - after;
            }
        }
    }

    /// The sums of a particle that come from a neighbor: the first of the pair, and the neighbor.
    fn neighbors(&self, i: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let before = i.checked_sub(1).map(|j| (LEFT, j));
        let after = (i + 1 < self.count()).then_some((RIGHT, i + 1));
        before.into_iter().chain(after)
    }

    /// The entries of dF/dy, always in the same order and at the same places.
    fn jacobian(&self, y: &[f64], mut entry: impl FnMut(usize, usize, f64)) {
        let (n, block) = (self.count(), self.block);
        let [by_height, by_slope, by_third] = self.factors();
        for i in 0..n {
            let at = block * i;
            let Local { height, slope, drive, pull } = self.local(y, i);
            let square = height * height;
            for (k, part) in SUMS.into_iter().enumerate() {
                let change = 2.0 * height * drive * by_height[k] + square * (by_third[k] + pull * by_slope[k]);
                entry(at + PLACE, at + part, change);
                entry(at + part, at + part, 1.0);
            }
            for (part, neighbor) in self.neighbors(i) {
                let other = block * neighbor;
                let gap = (y[at] - y[other]).abs();
                let decay = (-gap / self.alpha).exp();
                let [plain, weighted] = self.handed_on(&y[other..], part, neighbor, gap);
                // How the sums fall as the gap grows; it grows with this place on the left sums, with the other on the right.
                let (fall, fall_weighted) = (plain / self.alpha, weighted / self.alpha - plain);
                let side = if part == LEFT { 1.0 } else { -1.0 };
                entry(at + part, at + PLACE, side * fall);
                entry(at + part, other + PLACE, -side * fall);
                entry(at + part, other + part, -decay);
                entry(at + part + 1, at + PLACE, side * fall_weighted);
                entry(at + part + 1, other + PLACE, -side * fall_weighted);
                entry(at + part + 1, other + part, -decay * gap);
                entry(at + part + 1, other + part + 1, -decay);
            }
            if self.pull > 0.0 {
                let xi_squared = pull + self.bond;
                entry(at + PLACE, at + TOTAL, -2.0 * square * slope * xi_squared / y[at + TOTAL]);
                entry(at + OVERLAP, at + OVERLAP, 1.0);
                for (k, part) in SUMS.into_iter().enumerate() {
                    entry(at + OVERLAP, at + part, -self.weight[i] * by_height[k]);
                }
                if i > 0 {
                    entry(at + OVERLAP, at - block + OVERLAP, -1.0);
                }
                entry(at + TOTAL, at + TOTAL, 1.0);
                entry(at + TOTAL, if i + 1 < n { at + block + TOTAL } else { at + OVERLAP }, -1.0);
            }
        }
    }
}

/// F as the library sees it.
struct RightSide<'a>(&'a System);
/// M as the library sees it.
struct Mass<'a>(&'a System);
/// y at the start of the step, as the library sees it.
struct Start<'a>(&'a System);

macro_rules! operator {
    ($name:ty, $system:ident => $of:expr) => {
        impl Op for $name {
            type T = f64;
            type V = FaerVec<f64>;
            type M = FaerSparseMat<f64>;
            type C = FaerContext;

            fn context(&self) -> &FaerContext {
                let $system = self;
                &$of.context
            }

            fn nstates(&self) -> usize {
                let $system = self;
                $of.start.len()
            }

            fn nout(&self) -> usize {
                self.nstates()
            }

            fn nparams(&self) -> usize {
                0
            }
        }
    };
}

operator!(System, system => system);
operator!(RightSide<'_>, system => system.0);
operator!(Mass<'_>, system => system.0);
operator!(Start<'_>, system => system.0);

/// A matrix of entries; the library's own pattern is made of the same ones.
fn filled(rows: usize, places: Vec<(usize, usize)>, values: Vec<f64>, into: &mut FaerSparseMat<f64>) {
    // Entries within the matrix, none twice: there is nothing to refuse.
    if let Ok(matrix) = FaerSparseMat::try_from_triplets(rows, rows, places, values, into.context().clone()) {
        *into = matrix;
    }
}

/// The pattern of a matrix with entries at these places.
fn pattern(rows: usize, places: Vec<(usize, usize)>) -> Option<Sparsity> {
    let values = vec![1.0; places.len()];
    let matrix = FaerSparseMat::try_from_triplets(rows, rows, places, values, FaerContext::default()).ok()?;
    matrix.sparsity()?.to_owned().ok()
}

impl NonLinearOp for RightSide<'_> {
    fn call_inplace(&self, x: &FaerVec<f64>, _: f64, y: &mut FaerVec<f64>) {
        let mut out = vec![0.0; self.nstates()];
        self.0.right_side(&x.clone_as_vec(), &mut out);
        *y = FaerVec::from_vec(out, self.context().clone());
    }
}

impl NonLinearOpJacobian for RightSide<'_> {
    fn jac_mul_inplace(&self, x: &FaerVec<f64>, _: f64, v: &FaerVec<f64>, y: &mut FaerVec<f64>) {
        let (v, mut out) = (v.clone_as_vec(), vec![0.0; self.nstates()]);
        self.0.jacobian(&x.clone_as_vec(), |row, column, value| out[row] += value * v[column]);
        *y = FaerVec::from_vec(out, self.context().clone());
    }

    fn jacobian_inplace(&self, x: &FaerVec<f64>, _: f64, y: &mut FaerSparseMat<f64>) {
        let (mut places, mut values) = (Vec::new(), Vec::new());
        self.0.jacobian(&x.clone_as_vec(), |row, column, value| {
            places.push((row, column));
            values.push(value);
        });
        filled(self.nstates(), places, values, y);
    }

    fn jacobian_sparsity(&self) -> Option<Sparsity> {
        let mut places = Vec::new();
        self.0.jacobian(&self.0.start, |row, column, _| places.push((row, column)));
        pattern(self.nstates(), places)
    }
}

impl Mass<'_> {
    fn factor(&self, row: usize) -> f64 {
        if row.is_multiple_of(self.0.block) { 1.0 } else { 0.0 }
    }
}

impl LinearOp for Mass<'_> {
    fn gemv_inplace(&self, x: &FaerVec<f64>, _: f64, beta: f64, y: &mut FaerVec<f64>) {
        let (x, old) = (x.clone_as_vec(), y.clone_as_vec());
        let out = (0..x.len()).map(|row| self.factor(row) * x[row] + beta * old[row]).collect();
        *y = FaerVec::from_vec(out, self.context().clone());
    }

    fn matrix_inplace(&self, _: f64, y: &mut FaerSparseMat<f64>) {
        let rows = self.nstates();
        filled(rows, (0..rows).map(|row| (row, row)).collect(), (0..rows).map(|row| self.factor(row)).collect(), y);
    }

    fn sparsity(&self) -> Option<Sparsity> {
        pattern(self.nstates(), (0..self.nstates()).map(|row| (row, row)).collect())
    }
}

impl ConstantOp for Start<'_> {
    fn call_inplace(&self, _: f64, y: &mut FaerVec<f64>) {
        *y = FaerVec::from_slice(&self.0.start, self.context().clone());
    }
}

type Unit<'a> = ParameterisedOp<'a, UnitCallable<FaerSparseMat<f64>>>;

impl<'a> OdeEquationsRef<'a> for System {
    type Mass = Mass<'a>;
    type Rhs = RightSide<'a>;
    type Root = Unit<'a>;
    type Init = Start<'a>;
    type Out = Unit<'a>;
    type Reset = Unit<'a>;
}

impl OdeEquations for System {
    fn rhs(&self) -> RightSide<'_> {
        RightSide(self)
    }

    fn mass(&self) -> Option<Mass<'_>> {
        Some(Mass(self))
    }

    fn init(&self) -> Start<'_> {
        Start(self)
    }

    fn set_params(&mut self, _: &FaerVec<f64>) {}

    fn get_params(&self, _: &mut FaerVec<f64>) {}
}

type Sparsity = <FaerSparseMat<f64> as Matrix>::Sparsity;
