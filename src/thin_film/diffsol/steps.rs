//! One step of the library from a state of ours, and back.

use std::cell::RefCell;

use diffsol::error::DiffsolError;
use diffsol::{
    FaerSparseLU, FaerSparseMat, OdeBuilder, OdeSolverMethod, OdeSolverState, OdeSolverStopReason, RkState, Vector,
};

use super::super::ode::{Integrator, Method, Rates, StepTooSmall};
use super::super::particles::ParticleMethod;
use super::system::System;
use crate::math::factor_in_one_thread;

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
    factor_in_one_thread();
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
