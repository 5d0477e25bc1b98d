//! One time step: predictor, pressure, corrector [Huber2013, section 3.3]. [`Flow::step`] alone defines the order of the terms.

mod corrector;
mod given_flow;
mod hydrostatic;
mod implicit_viscosity;
mod intermediate;
mod motion;
mod predictor;
mod pressure;
mod viscous;

use std::time::Instant;

use self::intermediate::{Corrected, Predicted, Projected};
use self::motion::Motion;
use crate::configuration::Configuration;
use crate::flow::Flow;
use crate::open::{self, Moved};
use crate::parallel::largest;
use crate::wetting::lines::gone;
use meniscus_case::ViscousStep;
use meniscus_core::solver::{SolverError, StepInfo};

/// Pressure solves before the first step with open sides, since no previous step gives the pressure gradients. The gradient in the
/// fluid depends only weakly on that in the buffer, so that few suffice. Without open sides one suffices, for the viscous step.
const FIRST_SOLVES: usize = 6;

/// A step is shortened at most this many times; once suffices where forces accelerate particles.
const MOST_REPEATS: usize = 10;

impl Flow {
    /// Takes one step that ends at `until` (s) or before, by momentum and continuity [Huber2013, Eqs. 1-3].
    ///
    /// # Errors
    /// See [`SolverError`]; positions, velocities and time are then those before the step.
    pub fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        let start = Instant::now();
        let time = self.state.time;
        let open = &mut self.config.open;
        open.sides.iter_mut().chain(&mut open.through).for_each(|side| side.take_step(time));
        // Also at the start of each stage of a run.
        if self.state.last_dt == 0.0 {
            self.find_first_pressure(until)?;
        }
        let mut predicted = self.view().predict(until, f64::INFINITY, self.config.method.numerics.viscous_step)?;
        let after_forces = Instant::now();
        let mut corrected = self.end_of(&predicted)?;
        for _ in 0..MOST_REPEATS {
            let velocity = &corrected.velocity;
            let fastest = largest(velocity.len(), |a| velocity[a].norm()).map_or(0.0, |l| l.1);
            let Some(dt) = self.config.method.shorter_step(predicted.dt, fastest * predicted.dt) else { break };
            predicted = self.view().predict(until, dt, self.config.method.numerics.viscous_step)?;
            corrected = self.end_of(&predicted)?;
            self.work.repeats += 1;
        }
        self.work.viscous_iterations += predicted.damped.iterations as u64;
        let after_pressure = Instant::now();
        let moved = self.view().moved(&predicted, &corrected)?;
        self.take_end(&predicted, corrected, moved, until);
        self.work.seconds[1] += (after_forces - start).as_secs_f64();
        self.work.seconds[2] += (after_pressure - after_forces).as_secs_f64();
        self.work.seconds[3] += after_pressure.elapsed().as_secs_f64();
        self.work.steps += 1;
        self.prepare();
        Ok(StepInfo { dt: predicted.dt, limit: predicted.limit })
    }

    /// Makes the end of a step the state.
    fn take_end(&mut self, predicted: &Predicted, corrected: Corrected, moved: Motion, until: f64) {
        let (Configuration { open, domain, method, .. }, state, dt) = (&self.config, &mut self.state, predicted.dt);
        let (fluids, moving) = (state.particles.fluids, state.particles.moving());
        for (side, given) in open.through.iter().zip(&mut state.given_flows) {
            let (from, phase) = (&state.particles.position[..fluids], &mut state.particles.phase[..fluids]);
            let moves = Moved { from, to: &moved.position[..fluids], volume: method.volume, dt };
            given.pass(side, domain, &moves, phase, &mut state.fluxes);
        }
        let from = std::mem::take(&mut state.particles.position);
        state.particles.position = moved.position;
        state.particles.position.extend_from_slice(&from[moving..]);
        open::note_passed(&from, &state.particles, &open.sides, &mut state.fluxes);
        state.particles.velocity[..moving].copy_from_slice(&moved.velocity);
        self.work.set_back += moved.set_back;
        state.time = if dt >= until - state.time { until } else { state.time + dt };
        state.steps += 1;
        state.last_dt = dt;
        state.lines = std::mem::take(&mut self.lines);
        state.gone = state.gone.or_else(|| gone(&state.lines, method.spacing));
        let Projected { mut pressure, viscous_pressure, responses, .. } = corrected.projected;
        pressure.iter_mut().zip(&viscous_pressure).for_each(|(p, by)| *p += by);
        let change = pressure.iter().zip(&state.particles.pressure).map(|(now, before)| now - before);
        state.particles.pressure_change = change.collect();
        state.particles.responses = responses.into_iter().map(|response| response.potential).collect();
        self.take_up_pressure(pressure, &corrected.gradient_changes);
        if !self.config.open.sides.is_empty() {
            let (sides, state) = (&self.config.open.sides, &mut self.state);
            open::exchange(&mut state.particles, sides, &mut state.fluxes, self.config.method.spacing);
        }
    }

    /// Computes the pressure that the viscous step and open sides need from a previous step, where there is none: that which balances the forces at time zero.
    fn find_first_pressure(&mut self, until: f64) -> Result<(), SolverError> {
        self.start_given_flow()?;
        for _ in 0..if self.config.open.sides.is_empty() { 1 } else { FIRST_SOLVES } {
            let predicted = self.view().predict(until, f64::INFINITY, ViscousStep::Explicit)?;
            let corrected = self.end_of(&predicted)?;
            self.take_up_pressure(corrected.projected.pressure, &corrected.gradient_changes);
        }
        Ok(())
    }

    /// The end of the `predicted` step.
    fn end_of(&mut self, predicted: &Predicted) -> Result<Corrected, SolverError> {
        let (flow, solve, work) = self.solving();
        let projected = flow.project(predicted, solve, work)?;
        Ok(flow.correct(predicted, projected))
    }

    /// Stores the pressure (Pa) of a step and applies the changes of the mean gradients (Pa/m).
    fn take_up_pressure(&mut self, pressure: Vec<f64>, gradient_changes: &[f64]) {
        self.state.particles.pressure = pressure;
        for (given, change) in self.state.given_flows.iter_mut().zip(gradient_changes) {
            given.gradient += change;
        }
    }
}
