//! The library diffsol as integrator of the particles of a film: ESDIRK34 for stiff films, Tsit45 as the explicit pair.
//!
//! Tsit45 integrates the rates of the library under test as they are. ESDIRK34 would need their full Jacobian; it solves M y' = F(y),
//! `system.rs`, with the recursive sums as further, algebraic unknowns, which `operators.rs` hands to the library.

mod operators;
pub mod system;

use std::cell::RefCell;

use ::diffsol::{
    FaerSparseLU, FaerSparseMat, OdeBuilder, OdeEquations, OdeSolverMethod, OdeSolverState, OdeSolverStopReason,
    RkState, Vector,
};
use meniscus_core::math::factor_in_one_thread;
use meniscus_film::ode::Rates;
use meniscus_film::particles::ParticleMethod;

use system::System;

/// Relative tolerance where only an absolute one is asked for: rounding.
const ROUNDING: f64 = 1.0e-14;

/// Positions of the particles at a time, and the steps that led there.
pub struct Reached {
    /// Positions.
    pub x: Vec<f64>,
    /// Accepted steps from time zero.
    pub steps: usize,
}

/// Particles at each of the ascending `times`, from the places `start` at time zero, with the absolute error `tolerance` per step.
pub fn esdirk34(method: &ParticleMethod, start: &[f64], tolerance: f64, first: f64, times: &[f64]) -> Vec<Reached> {
    factor_in_one_thread();
    let system = System::new(method, start);
    let (block, rows) = (system.block, system.start.len());
    let problem = OdeBuilder::<FaerSparseMat<f64>>::new()
        .h0(first)
        .rtol(ROUNDING)
        // The mean square of the error is over all rows; here it is that of the places, and sums follow from them.
        .atol(vec![tolerance / (block as f64).sqrt(); rows])
        .build_from_eqn(system)
        .unwrap();
    let state = RkState::new_without_initialise(&problem).unwrap();
    reach(problem.esdirk34_solver::<FaerSparseLU<f64>>(state).unwrap(), block, times)
}

/// The same by an explicit method.
pub fn tsit45(method: &ParticleMethod, start: &[f64], tolerance: f64, first: f64, times: &[f64]) -> Vec<Reached> {
    let particles = RefCell::new(method.clone());
    let (start, count) = (start.to_vec(), start.len());
    let problem = OdeBuilder::<FaerSparseMat<f64>>::new()
        .h0(first)
        .rtol(ROUNDING)
        .atol(vec![tolerance; count])
        .rhs(move |x: &[f64], _: &[f64], _: f64, rate: &mut [f64]| particles.borrow_mut().rates(x, rate))
        .init(move |_: &[f64], _: f64, x: &mut [f64]| x.copy_from_slice(&start), count)
        .build()
        .unwrap();
    let state = RkState::new_without_initialise(&problem).unwrap();
    reach(problem.tsit45_solver(state).unwrap(), 1, times)
}

fn reach<'a, E: OdeEquations<T = f64> + 'a>(
    mut solver: impl OdeSolverMethod<'a, E>,
    block: usize,
    times: &[f64],
) -> Vec<Reached> {
    let at = |&time: &f64| {
        solver.set_stop_time(time).unwrap();
        while !matches!(solver.step().unwrap(), OdeSolverStopReason::TstopReached) {}
        let x = solver.state().y.clone_as_vec().into_iter().step_by(block).collect();
        Reached { x, steps: solver.get_statistics().number_of_steps }
    };
    times.iter().map(at).collect()
}
