//! From a checked case to a film at time zero.

use super::droplet::WeightRule;
use super::equilibrium::Equilibrium;
use super::film::Film;
use super::finite_differences::{FiniteDifferences, Ring, StepRule};
use super::kernel::Kernel;
use super::ode::{Integrator, Method, Tolerance};
use super::particles::{LatticeEnergy, ParticleMethod};
use super::scales::Scales;
use super::solver::{Surroundings, ThinFilmSolver};
use crate::case::checked::{self, Case, FilmIntegrator, FilmMethod, FilmWeights, ThinFilm};

/// Scaled first step: a droplet that starts far from rest changes fast.
const FIRST_STEP: f64 = 1.0e-6;

/// A film that cannot be set up.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// The filter is too wide for the droplet.
    #[error(
        "no droplet rests at the given angle where the film is smoothed over {length:.3e} m; a tenth of the droplet's half \
         width, {usual:.3e} m, is usual"
    )]
    TooSmooth {
        /// Smoothing length in m.
        length: f64,
        /// A usual one in m.
        usual: f64,
    },
}

/// The solver of a case at time zero.
///
/// # Errors
/// [`SetupError`].
pub fn build(case: &Case, film: &ThinFilm) -> Result<ThinFilmSolver, SetupError> {
    let scales = Scales::of(film);
    let alpha = film.smoothing_length / scales.length;
    let too_smooth = SetupError::TooSmooth { length: film.smoothing_length, usual: 0.1 * film.half_width };
    let equilibrium = match film.contact_angle {
        None => None,
        Some(_) => Some(Equilibrium::of_unit_slope(alpha).ok_or(too_smooth)?),
    };
    let wetting = equilibrium.map_or(0.0, |droplet| droplet.wetting());
    let spacing = film.spacing / scales.length;
    let weights = match film.weights {
        FilmWeights::Cell => WeightRule::Cell,
        FilmWeights::Point => WeightRule::Point,
    };
    let droplet = scales.droplet(film);
    let wall = [case.geometry.min[0], case.geometry.max[0]];
    let film = match film.method {
        FilmMethod::Particles { integrator, tolerance, lattice_energy } => {
            let masses = droplet.particles(spacing, weights);
            let lattice = match lattice_energy {
                checked::LatticeEnergy::Kept => LatticeEnergy::Kept,
                checked::LatticeEnergy::TakenOff => LatticeEnergy::TakenOff,
            };
            let method = match integrator {
                FilmIntegrator::Stiff => Method::Stiff,
                FilmIntegrator::Explicit => Method::Explicit,
            };
            let tolerance = Tolerance { absolute: tolerance * 2.0 * droplet.half_width, relative: 0.0 };
            let state = Integrator::new(method, tolerance, masses.x.clone(), FIRST_STEP);
            Film::particles(ParticleMethod::new(Kernel::new(alpha), &masses, wetting, lattice), &masses, state)
        }
        FilmMethod::FiniteDifferences { step_share } => {
            // A node stands at x = 0, in the middle of the droplet.
            let before = (-wall[0] / film.spacing).round();
            let count = ((wall[1] - wall[0]) / film.spacing).round() as usize;
            let ring = Ring { from: -before * spacing, count, spacing, alpha, wetting };
            let rule = StepRule { share: step_share, ..StepRule::ADAPTIVE };
            Film::Grid(Box::new(FiniteDifferences::new(&ring, &droplet, weights, rule)))
        }
    };
    Ok(ThinFilmSolver::new(film, Surroundings { scales, wall, smoothing_length: alpha, equilibrium }))
}
