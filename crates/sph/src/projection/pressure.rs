//! The pressure equation of a step [Huber2013, Eqs. 28-31].

use super::given_flow::{RESPONSE_RESIDUAL, Response};
use super::intermediate::{Predicted, Projected};
use crate::boundary::shepard;
use crate::conjugate_gradients::SymmetricMatrix;
use crate::fields::Fields;
use crate::flow::Work;
use crate::images::Field;
use crate::method::Method;
use crate::neighborhood::Neighborhood;
use crate::open::{OpenSide, Prescribed};
use crate::parallel::{change_each, values};
use crate::particles::Particles;
use crate::poisson::{Matrix, PressureSolve, System, Tolerance, Unknowns, assemble, impose};
use crate::terms::divergence::divergence;
use crate::terms::pressure_gradient;
use crate::view::View;
use meniscus_core::math::Vec2;
use meniscus_core::solver::SolverError;

/// Density ratio above which the multigrid keeps light and heavy particles apart.
const LARGEST_SMOOTH_RATIO: f64 = 5.0;

/// Kind of the particles with a given pressure for the multigrid: apart from light (1) and heavy (0) ones.
const DIRICHLET: u8 = 2;

/// Largest relative residual of the density-error correction by shifting: later steps correct the remaining error.
const CORRECTION_RESIDUAL: f64 = 0.01;

/// The pressure equation of a step.
struct PressureEquation {
    /// As assembled, without the prescribed pressures.
    matrix: Matrix,
    /// Right-hand side.
    b: Vec<f64>,
    /// Given pressures.
    prescribed: Prescribed,
    /// Initial guess of the pressure in Pa.
    guess: Vec<f64>,
    /// The pressure of the step before in Pa.
    before: Vec<f64>,
    /// Further systems with the same matrix, with zero instead of the prescribed pressures.
    others: Vec<Further>,
}

/// A further right-hand side of the pressure equation.
struct Further {
    b: Vec<f64>,
    /// Initial guess, then the solution.
    x: Vec<f64>,
    tolerance: Tolerance,
}

impl Further {
    /// Without an initial guess.
    fn new(b: Vec<f64>, tolerance: Tolerance) -> Self {
        Self { x: vec![0.0; b.len()], b, tolerance }
    }
}

impl View<'_, Fields> {
    /// The pressure that makes the velocity at the end of the step divergence-free [Huber2013, Eqs. 28, 29]. It has zero mean over each component in which no
    /// open side gives it. The right-hand side includes the density-error correction, which is not in the paper.
    pub(super) fn project(
        &self,
        predicted: &Predicted,
        solve: &mut PressureSolve,
        work: &mut Work,
    ) -> Result<Projected, SolverError> {
        let matrix = self.assembled();
        let (n, dt, position) = (self.state.particles.len(), predicted.dt, &self.state.particles.position);
        let (method, f) = (&self.config.method, &self.fields.bulk);
        let source = divergence(&self.neighborhood.pairs, &f.volume, &predicted.velocity, n);
        // A long step corrects the whole error at most.
        let correction = method.density_correction_rate(predicted.fastest).min(1.0 / dt) / dt;
        let mut b = values(n, |a| {
            if self.config.is_near_fluid(position[a]) {
                -f.volume[a] * (source[a] / dt - correction * self.density_error(a))
            } else {
                0.0
            }
        });
        let mut hydrostatic = vec![0.0; n];
        self.hydrostatic().subtract_from(&mut hydrostatic, &matrix, &self.neighborhood.pairs);
        b.iter_mut().zip(&hydrostatic).for_each(|(b, hydrostatic)| *b += hydrostatic);
        self.subtract_divergence_error(predicted, &matrix, &hydrostatic, &mut b);
        let jump = self.fields.interface.force.jump();
        let jump = |b: usize| jump.map_or(f64::NAN, |jump| method.tension * jump.curvature[b]);
        let prescribed = Prescribed::new(&self.state.particles, &self.config.open.sides, jump, method.kernel.h);
        let viscous_pressure = self.viscous_pressure(predicted, &matrix, &b);
        let mut others = Vec::new();
        if method.numerics.density_error_shifting > 0.0 {
            let error = values(n, |a| {
                let error = if self.config.is_near_fluid(position[a]) { self.density_error(a) } else { 0.0 };
                method.numerics.density_error_shifting * f.volume[a] * error
            });
            others.push(Further::new(error, Tolerance { residual: CORRECTION_RESIDUAL, ..method.tolerance }));
        }
        let tolerance = Tolerance { residual: RESPONSE_RESIDUAL, ..method.tolerance };
        let axes: Vec<Vec2> = self.config.open.through.iter().map(OpenSide::inward).collect();
        let particles = &self.state.particles;
        others.extend(axes.iter().enumerate().map(|(i, &axis)| {
            let b = self.right_side_of_gradient(axis, &matrix);
            let x = particles.responses.get(i).map_or_else(|| vec![0.0; n], Vec::clone);
            Further { b, x, tolerance }
        }));
        let before = particles.pressure.clone();
        // Never farther than over the last step: the change has noise, too.
        let ahead = if self.state.last_dt > 0.0 { (dt / self.state.last_dt).min(1.0) } else { 0.0 };
        let guess = before.iter().zip(&particles.pressure_change).map(|(p, change)| p + ahead * change).collect();
        let equation = PressureEquation { matrix, b, prescribed, guess, before, others };
        let (pressure, mut found) = self.solve(equation, solve, work)?;
        let potentials = found.split_off(found.len() - axes.len());
        let responses = axes.iter().zip(potentials).map(|(&axis, potential)| self.response(axis, potential)).collect();
        // −∇ψ/ρ with the potential ψ in kg/m: the same on both sides of an interface.
        let density_error_shift = found.pop().map_or_else(Vec::new, |potential| self.down(potential));
        Ok(Projected { pressure, viscous_pressure, density_error_shift, responses })
    }

    /// The change of the velocity of the fluid particles in m/s that makes `velocity` (m/s) divergence-free, and the
    /// responses to unit gradients along the periodic sides with a given flow.
    pub(super) fn project_kinematically(
        &self,
        velocity: &Field<Vec2>,
        solve: &mut PressureSolve,
        work: &mut Work,
    ) -> Result<(Vec<Vec2>, Vec<Response>), SolverError> {
        let b = self.minus_outflow(velocity);
        let matrix = self.assembled();
        let (sides, method) = (&self.config.open.sides, &self.config.method);
        let axes: Vec<Vec2> = self.config.open.through.iter().map(OpenSide::inward).collect();
        let further = |&axis| Further::new(self.right_side_of_gradient(axis, &matrix), method.tolerance);
        let others = axes.iter().map(further).collect();
        let given = Prescribed::new(&self.state.particles, sides, |_| f64::NAN, method.kernel.h);
        let value = given.value.iter().map(|value| 0.0 * value).collect();
        let prescribed = Prescribed { value, reference: 0.0 };
        let guess = vec![0.0; self.state.particles.len()];
        let equation = PressureEquation { matrix, b, prescribed, guess, before: Vec::new(), others };
        let (potential, found) = self.solve(equation, solve, work)?;
        let responses = axes.iter().zip(found).map(|(&axis, potential)| self.response(axis, potential)).collect();
        Ok((self.down(potential), responses))
    }

    /// The matrix of the pressure equation at the present positions.
    fn assembled(&self) -> Matrix {
        let (Neighborhood { pairs, images }, Fields { bulk, walls, .. }) = (self.neighborhood, self.fields);
        let joined = walls.joined(self.state.particles.moving(), images);
        assemble(pairs, images, &bulk.volume, &bulk.density, joined)
    }

    /// The pressure (Pa), and the solutions for the further right-hand sides.
    fn solve(
        &self,
        equation: PressureEquation,
        solve: &mut PressureSolve,
        work: &mut Work,
    ) -> Result<(Vec<f64>, Vec<Vec<f64>>), SolverError> {
        let PressureEquation { mut matrix, mut b, prescribed, guess: mut p, mut before, mut others } = equation;
        let (fluids, tolerance) = (self.state.particles.fluids, self.config.method.tolerance);
        let given = |a: usize| prescribed.of(a, fluids);
        let mut kind = kinds(&self.config.method, &self.fields.bulk.density[..self.state.particles.len()]);
        let mut has_dirichlet =
            vec![false; self.state.particles.part.iter().max().map_or(0, |last| *last as usize + 1)];
        for a in self.state.particles.buffer().filter(|&a| given(a).is_some()) {
            has_dirichlet[self.state.particles.part[a] as usize] = true;
            kind[a] = DIRICHLET;
            others.iter_mut().for_each(|other| (other.b[a], other.x[a]) = (0.0, 0.0));
        }
        impose(&mut matrix, &mut b, |a| given(a).map(|p| p - prescribed.reference));
        let (Particles { position, part, .. }, spacing) = (&self.state.particles, self.config.method.spacing);
        let unknowns =
            Unknowns { matrix: &matrix, position, kind: &kind, part, has_dirichlet: &has_dirichlet, spacing };
        let offset = |a: usize| if has_dirichlet[part[a] as usize] { prescribed.reference } else { 0.0 };
        for p in [&mut p, &mut before] {
            p.iter_mut().enumerate().for_each(|(a, p)| *p = if given(a).is_some() { 0.0 } else { *p - offset(a) });
        }
        let volume = &self.fields.bulk.volume[..p.len()];
        let mut systems = vec![System { b: &mut b, x: &mut p, before: &before, tolerance }];
        systems.extend(others.iter_mut().map(|Further { b, x, tolerance }| System {
            b,
            x,
            before: &[],
            tolerance: *tolerance,
        }));
        let solved = solve.solve(&unknowns, volume, &mut systems);
        let convergence = solved[0];
        p.iter_mut().enumerate().for_each(|(a, p)| *p = given(a).unwrap_or(*p + offset(a)));
        work.last_iterations = convergence.iterations;
        work.iterations += solved.iter().map(|solved| solved.iterations as u64).sum::<u64>();
        work.residual = convergence.residual;
        if !convergence.is_reached() {
            return Err(self.not_converged("the pressure equation", convergence));
        }
        Ok((p, others.into_iter().map(|other| other.x).collect()))
    }

    /// −V_a (∇·v)_a in m²/s of the `velocity` (m/s), 0 deep in the buffers.
    pub(super) fn minus_outflow(&self, velocity: &Field<Vec2>) -> Vec<f64> {
        let position = &self.state.particles.position;
        let mut outflow = divergence(&self.neighborhood.pairs, &self.fields.bulk.volume, velocity, position.len());
        outflow.iter_mut().zip(&*self.fields.bulk.volume).enumerate().for_each(|(a, (outflow, volume))| {
            *outflow = if self.config.is_near_fluid(position[a]) { -volume * *outflow } else { 0.0 };
        });
        outflow
    }

    /// Subtracts from the right side `b` the divergence error of the previous pressure in the part of the step beyond the longest explicit one \[Kan1986\].
    ///
    /// The discrete divergence of the gradient is not exactly the Laplacian, so that a pressure leaves the divergence Δt (Laplacian − divergence
    /// of the gradient): in a steady flow in every step, and through walls. With the subtraction no step leaks more than an explicit one.
    fn subtract_divergence_error(&self, predicted: &Predicted, matrix: &Matrix, hydrostatic: &[f64], b: &mut [f64]) {
        let damped = &predicted.damped;
        if damped.excess == 0.0 {
            return;
        }
        let (n, f) = (self.state.particles.len(), &self.fields.bulk);
        let mut acceleration = damped.by_pressure.clone();
        acceleration.resize(n, Vec2::zeros());
        predicted.interior.set_buffer_acceleration(&self.state.particles, &self.config.open.sides, &mut acceleration);
        let acceleration = self.neighborhood.images.velocity_field(acceleration);
        let of_gradient = divergence(&self.neighborhood.pairs, &f.volume, &acceleration, n);
        let Particles { position, pressure, .. } = &self.state.particles;
        change_each(b, |a, b| {
            if self.config.is_near_fluid(position[a]) {
                let laplacian = matrix.diagonal[a] * pressure[a] - matrix.coupled(a, pressure) - hydrostatic[a];
                *b += damped.excess * (laplacian - f.volume[a] * of_gradient[a]);
            }
        });
    }

    /// θ Δt μ_a/V_a (M φ)_a in Pa with φ = p' − p from M φ = b − M p \[Timmermans1996\]: the difference of the pressure that balances the viscous forces
    /// at the end of a long step from p'. Empty after explicit steps and without
    /// [`Configuration::has_viscous_pressure`](crate::configuration::Configuration::has_viscous_pressure).
    ///
    /// The corrector adds −Δt ∇φ/ρ to a velocity for which viscosity was implicit, so that (1 + θ Δt K) ∇φ = ∇(φ + θ Δt μ M φ/V) has to be
    /// balanced. Without this term a long step corrects only a fraction of the pressure error that decreases as 1/Δt.
    fn viscous_pressure(&self, predicted: &Predicted, matrix: &Matrix, b: &[f64]) -> Vec<f64> {
        if predicted.damped.excess == 0.0 || !self.config.has_viscous_pressure() {
            return Vec::new();
        }
        let (f, n) = (&self.fields.bulk, b.len());
        let of_fluid = &f.viscosity[..self.state.particles.fluids];
        // Where the viscosity jumps, long steps would amplify it.
        if of_fluid.iter().any(|mu| *mu != of_fluid[0]) {
            return Vec::new();
        }
        let (moving, of_particles) = (self.state.particles.moving(), f.viscosity.to_vec());
        let viscosity = shepard::into_walls(self.neighborhood, &f.fluid_volume, moving, of_particles);
        let mut change = vec![0.0; n];
        matrix.residual(b, &self.state.particles.pressure, &mut change);
        let weight = predicted.damped.weight;
        change.iter_mut().enumerate().for_each(|(a, change)| *change *= weight * viscosity[a] / f.volume[a]);
        change
    }

    /// V_0/V_a − 1, the density error of a fluid particle; 0 on others.
    fn density_error(&self, a: usize) -> f64 {
        if a >= self.state.particles.fluids {
            return 0.0;
        }
        let weight = self.config.weight_of_corrections(self.state.particles.position[a]);
        weight * (self.config.method.volume / self.fields.bulk.volume[a] - 1.0)
    }

    /// −∇φ/ρ of the fluid particles.
    fn down(&self, potential: Vec<f64>) -> Vec<Vec2> {
        let potential = self.neighborhood.images.field(potential);
        let (pairs, f) = (&self.neighborhood.pairs, &self.fields.bulk);
        pressure_gradient::descent(pairs, &f.volume, &f.density, &potential, self.state.particles.fluids)
    }
}

/// 0 in and near the heavy fluid, 1 in and near the light one, so that the multigrid keeps them apart; `density` in kg/m³.
fn kinds(method: &Method, density: &[f64]) -> Vec<u8> {
    let (w, o) = (method.wetting_fluid.density, method.other_fluid.density);
    let is_jump = method.density_ratio() > LARGEST_SMOOTH_RATIO;
    let between = if is_jump { (w * o).sqrt() } else { 0.0 };
    density.iter().map(|&rho| u8::from(rho < between)).collect()
}
