//! The pressure equation of a step [Huber2013, Eqs. 28-31].

use rayon::prelude::*;

use super::given_flow::{RESPONSE_RESIDUAL, Response};
use super::{Flow, Predicted};
use crate::math::Vec2;
use crate::solver::SolverError;
use crate::sph::open::{Prescribed, Through};
use crate::sph::pairs::{GRAIN, each};
use crate::sph::poisson::{Matrix, System, Tolerance, Unknowns, assemble, impose};
use crate::sph::terms::divergence::divergence;
use crate::sph::terms::pressure_gradient;

/// Above this density ratio the multigrid keeps light and heavy particles apart.
const LARGEST_SMOOTH_RATIO: f64 = 5.0;

/// Wall particles whose nearest walls face each other by a cosine below this belong to opposite sides of a solid.
const OPPOSITE: f64 = -0.5;

/// Kind of the particles with a given pressure for the multigrid: apart from light (1) and heavy (0) ones.
const DIRICHLET: u8 = 2;

/// Largest relative residual of the density-error correction by shifting: what one step leaves, the next ones take.
const CORRECTION_RESIDUAL: f64 = 0.01;

/// What one pressure solve finds.
pub(super) struct Projected {
    /// Pressure in Pa.
    pub(super) pressure: Vec<f64>,
    /// The way in m that each fluid particle goes for the density-error correction by shifting, empty where there is none.
    pub(super) drift: Vec<Vec2>,
    /// What unit gradients along the periodic sides with a given flow do.
    pub(super) responses: Vec<Response>,
}

/// Whether the pressures of two particles that are `facing` so are coupled: all but those of wall particles that belong to opposite sides of a thin
/// solid, through which the pressure of one side would reach the other.
pub(super) fn joined(facing: Vec2, other: Vec2) -> bool {
    facing.dot(&other) > OPPOSITE
}

impl Flow {
    /// The pressure that makes the end of the step free of divergence [Huber2013, Eqs. 29-31], mean zero over each part in which
    /// no open side gives it.
    ///
    /// The right side gives a share of the density error back (the density-error correction, which the paper lacks).
    pub(super) fn project(&mut self, predicted: &Predicted) -> Result<Projected, SolverError> {
        let (n, dt) = (self.particles.len(), predicted.dt);
        let (method, f) = (&self.method, &self.fields);
        let mut source = vec![0.0; n];
        divergence(&self.pairs, &f.volume, &predicted.velocity, &mut source);
        // A long step takes back all there is, and no more.
        let drift = method.density_correction_rate(predicted.fastest).min(1.0 / dt) / dt;
        let mut b = vec![0.0; n];
        each(&mut b, |a| {
            if self.sees_the_fluid(a) { -f.volume[a] * (source[a] / dt - drift * self.density_error(a)) } else { 0.0 }
        });
        let matrix = self.assembled();
        let (method, f) = (&self.method, &self.fields);
        self.hydrostatic().subtract_from(&mut b, &matrix, &self.pairs);
        self.subtract_divergence_error(predicted, &matrix, &mut b);
        let jump = |b: usize| f.jump.as_ref().map_or(f64::NAN, |jump| method.tension * jump.curvature[b]);
        let prescribed = Prescribed::new(&self.particles, &self.open.sides, jump, method.kernel.h);
        let mut others = Vec::new();
        if method.density_error_shifting > 0.0 {
            let mut error = vec![0.0; n];
            each(&mut error, |a| {
                let seen = if self.sees_the_fluid(a) { self.density_error(a) } else { 0.0 };
                method.density_error_shifting * f.volume[a] * seen
            });
            others.push((error, Tolerance { residual: CORRECTION_RESIDUAL, ..method.tolerance }));
        }
        let tolerance = Tolerance { residual: RESPONSE_RESIDUAL, ..method.tolerance };
        let ways: Vec<Vec2> = self.open.through.iter().map(Through::way).collect();
        others.extend(ways.iter().map(|&way| (self.right_side_of_gradient(way, &matrix), tolerance)));
        let guess = self.particles.pressure.clone();
        let (pressure, mut found) = self.solve((matrix, b), (&prescribed, guess), others)?;
        let potentials = found.split_off(found.len() - ways.len());
        let responses = ways.iter().zip(potentials).map(|(&way, potential)| self.response(way, potential)).collect();
        Ok(Projected { pressure, drift: self.density_error_shifting(found.pop().unwrap_or_default()), responses })
    }

    /// The change of the velocity of the fluid particles in m/s that makes `velocity` (m/s) over particles and images free of divergence, and
    /// what unit gradients along the periodic sides with a given flow do.
    pub(super) fn project_kinematically(
        &mut self,
        velocity: &[Vec2],
    ) -> Result<(Vec<Vec2>, Vec<Response>), SolverError> {
        let b = self.minus_outflow(velocity);
        let matrix = self.assembled();
        let ways: Vec<Vec2> = self.open.through.iter().map(Through::way).collect();
        let others =
            ways.iter().map(|&way| (self.right_side_of_gradient(way, &matrix), self.method.tolerance)).collect();
        let given = Prescribed::new(&self.particles, &self.open.sides, |_| f64::NAN, self.method.kernel.h);
        let value = given.value.iter().map(|value| 0.0 * value).collect();
        let at_zero = Prescribed { value, reference: 0.0 };
        let (potential, found) = self.solve((matrix, b), (&at_zero, vec![0.0; self.particles.len()]), others)?;
        let responses = ways.iter().zip(found).map(|(&way, potential)| self.response(way, potential)).collect();
        Ok((self.down(potential), responses))
    }

    /// The matrix of the pressure equation at the present positions.
    fn assembled(&mut self) -> Matrix {
        let mut matrix = std::mem::take(&mut self.pressure.matrix);
        let (facing, f) = (self.facing(), &self.fields);
        assemble(&mut matrix, &self.pairs, &self.images, &f.volume, &f.density, |a, b| joined(facing[a], facing[b]));
        matrix
    }

    /// Solves the pressure equation from the first guess (Pa) with the `prescribed` pressures, and for each right side of `others` with zero in
    /// their place.
    fn solve(
        &mut self,
        (mut matrix, mut b): (Matrix, Vec<f64>),
        (prescribed, mut p): (&Prescribed, Vec<f64>),
        mut others: Vec<(Vec<f64>, Tolerance)>,
    ) -> Result<(Vec<f64>, Vec<Vec<f64>>), SolverError> {
        let (fluids, tolerance) = (self.particles.fluids, self.method.tolerance);
        let given = |a: usize| prescribed.of(a, fluids);
        let mut kind = self.kinds();
        let mut has_dirichlet = vec![false; self.particles.part.iter().max().map_or(0, |last| *last as usize + 1)];
        for a in self.particles.buffer().filter(|&a| given(a).is_some()) {
            has_dirichlet[self.particles.part[a] as usize] = true;
            kind[a] = DIRICHLET;
            others.iter_mut().for_each(|(right, _)| right[a] = 0.0);
        }
        impose(&mut matrix, &mut b, |a| given(a).map(|p| p - prescribed.reference));
        self.pressure.matrix = matrix;
        let part = &self.particles.part;
        let position = &self.particles.position;
        let unknowns =
            Unknowns { position, kind: &kind, part, has_dirichlet: &has_dirichlet, spacing: self.method.spacing };
        let offset = |a: usize| if has_dirichlet[part[a] as usize] { prescribed.reference } else { 0.0 };
        p.iter_mut().enumerate().for_each(|(a, p)| *p = if given(a).is_some() { 0.0 } else { *p - offset(a) });
        let volume = &self.fields.volume[..p.len()];
        let mut found: Vec<Vec<f64>> = others.iter().map(|(right, _)| vec![0.0; right.len()]).collect();
        let mut systems = vec![System { b: &mut b, x: &mut p, tolerance }];
        systems.extend(others.iter_mut().zip(&mut found).map(|((b, tolerance), x)| System {
            b,
            x,
            tolerance: *tolerance,
        }));
        let solved = self.pressure.solve(&unknowns, volume, &mut systems);
        let convergence = solved[0];
        p.iter_mut().enumerate().for_each(|(a, p)| *p = given(a).unwrap_or(*p + offset(a)));
        self.work.last_iterations = convergence.iterations;
        self.work.iterations += solved.iter().map(|solved| solved.iterations as u64).sum::<u64>();
        self.work.residual = convergence.residual;
        if !(convergence.residual <= tolerance.residual) {
            return Err(SolverError::NotConverged {
                system: "the pressure equation",
                residual: convergence.residual,
                tolerance: tolerance.residual,
                iterations: convergence.iterations,
                time: self.time,
                step: self.steps,
            });
        }
        Ok((p, found))
    }

    /// −V_a (∇·v)_a in m²/s of the `velocity` (m/s) over particles and images, where there is fluid to see.
    pub(super) fn minus_outflow(&self, velocity: &[Vec2]) -> Vec<f64> {
        let mut outflow = vec![0.0; self.particles.len()];
        divergence(&self.pairs, &self.fields.volume, velocity, &mut outflow);
        outflow.iter_mut().zip(&self.fields.volume).enumerate().for_each(|(a, (outflow, volume))| {
            *outflow = if self.sees_the_fluid(a) { -volume * *outflow } else { 0.0 };
        });
        outflow
    }

    /// Takes out of the right side `b` what the pressure before leaks in the part of the step beyond the longest explicit one.
    ///
    /// The divergence of the gradient is not quite the Laplacian, so that a pressure leaves the divergence Δt (Laplacian − divergence of the
    /// gradient): in a steady flow as much in any step, and through walls. So no step leaks more than an explicit one.
    fn subtract_divergence_error(&self, predicted: &Predicted, matrix: &Matrix, b: &mut [f64]) {
        let damped = &predicted.damped;
        if damped.excess == 0.0 {
            return;
        }
        let (n, f) = (self.particles.len(), &self.fields);
        let mut acceleration = damped.by_pressure.clone();
        acceleration.resize(n, Vec2::zeros());
        self.extend_to_buffers(&predicted.interior, &mut acceleration);
        self.images.extend_velocity(&mut acceleration);
        let mut of_gradient = vec![0.0; n];
        divergence(&self.pairs, &f.volume, &acceleration, &mut of_gradient);
        let mut hydrostatic = vec![0.0; n];
        self.hydrostatic().subtract_from(&mut hydrostatic, matrix, &self.pairs);
        let pressure = &self.particles.pressure;
        b.par_iter_mut().enumerate().with_min_len(GRAIN).for_each(|(a, b)| {
            if self.sees_the_fluid(a) {
                let laplacian = matrix.diagonal[a] * pressure[a] - matrix.coupled(a, pressure) - hydrostatic[a];
                *b += damped.excess * (laplacian - f.volume[a] * of_gradient[a]);
            }
        });
    }

    /// Where each wall particle and its images face; zero on other particles.
    pub(super) fn facing(&self) -> Vec<Vec2> {
        let mut facing = vec![Vec2::zeros(); self.particles.moving()];
        facing.extend_from_slice(&self.wall_facing);
        self.images.extend_reflected(&mut facing);
        facing
    }

    /// V_0/V_a − 1, the density error of a fluid particle; 0 on others.
    fn density_error(&self, a: usize) -> f64 {
        if a < self.particles.fluids { self.method.volume / self.fields.volume[a] - 1.0 } else { 0.0 }
    }

    /// The way −(∇ψ/ρ)_a in m down the gradient of the `potential` ψ (kg/m) of the density-error correction by shifting, the same on both sides of an interface.
    fn density_error_shifting(&self, potential: Vec<f64>) -> Vec<Vec2> {
        if potential.is_empty() { Vec::new() } else { self.down(potential) }
    }

    /// −∇φ/ρ of the fluid particles.
    fn down(&self, mut potential: Vec<f64>) -> Vec<Vec2> {
        self.images.extend(&mut potential);
        let f = &self.fields;
        pressure_gradient::down(&self.pairs, &f.volume, &f.density, &potential, self.particles.fluids)
    }

    /// Whether the divergence at particle `a` counts: deep beyond an open side the sums see no fluid, and no neighbors at its end.
    fn sees_the_fluid(&self, a: usize) -> bool {
        let (x, support) = (self.particles.position[a], self.method.kernel.support());
        self.open.sides.iter().all(|side| side.beyond(x) < support)
    }

    /// 0 in and near the heavy fluid, 1 in and near the light one, so that the multigrid keeps them apart.
    fn kinds(&self) -> Vec<u8> {
        let (w, o) = (self.method.wetting_fluid.density, self.method.other_fluid.density);
        let is_jump = self.method.density_ratio() > LARGEST_SMOOTH_RATIO;
        let between = if is_jump { (w * o).sqrt() } else { 0.0 };
        self.fields.density[..self.particles.len()].iter().map(|&rho| u8::from(rho < between)).collect()
    }
}
