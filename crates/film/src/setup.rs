//! Sets up a film at time zero from a checked case.

use super::backward_euler::StepRule;
use super::cells::{Cells, Layout, Model};
use super::droplet::{Droplet, particles};
use super::equilibrium::Equilibrium;
use super::film::Film;
use super::grid_film::GridFilm;
use super::kernel::Kernel;
use super::observed::Surroundings;
use super::ode::{Integrator, Tolerance};
use super::particles::{ParticleMethod, Pull};
use super::ring::{Line, Ring};
use super::scales::Scales;
use super::solver::ThinFilmSolver;
use super::sparse::TooLarge;
use meniscus_case::Case;
use meniscus_case::film::{
    FilmDroplet, FilmEquation, FilmGrid, FilmMethod, FilmParticles, FilmSums, FilmSymmetry, Geometric, LatticeEnergy,
    Precursor, Slip, ThinFilm,
};

/// Scaled first step: droplets far from equilibrium change fast.
const FIRST_STEP: f64 = 1.0e-6;
/// Longest first step on a grid over the initial time scale of a droplet. If a small contact angle makes the unit of time much longer than that, the scaled
/// first step alone leads to spurious roots.
const SHARE_OF_DROPLET: f64 = 1.0e-4;

/// Why a film cannot be set up.
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
        /// A typical one in m.
        usual: f64,
    },
    /// The film has too many nodes for the memory.
    #[error("{0}; take a larger spacing")]
    TooLarge(#[from] TooLarge),
}

impl SetupError {
    /// The key of the case that would have to change.
    pub fn key(&self) -> String {
        match self {
            Self::TooSmooth { .. } => "thin-film.equation.geometric.smoothing-length".to_owned(),
            Self::TooLarge(_) => "thin-film.spacing".to_owned(),
        }
    }
}

/// The solver of a case at time zero.
pub fn build(case: &Case, film: &ThinFilm) -> Result<ThinFilmSolver, SetupError> {
    let scales = Scales::of(film);
    let droplets = scales.droplets(film);
    let wall = [case.geometry.min[0], case.geometry.max[0]];
    let (wetting, equilibrium) = rest(film, &scales, &droplets)?;
    let pull = Pull { wetting, bond: scales.bond };
    let resolution = smoothing_length(film).unwrap_or(film.spacing) / scales.length;
    let moving = match film.method {
        FilmMethod::Particles(FilmParticles { integrator, tolerance, lattice_energy, sums }) => {
            let masses = particles(&droplets, film.spacing / scales.length, film.weights);
            let width = droplets.iter().map(|droplet| 2.0 * droplet.half_width).fold(0.0, f64::max);
            let tolerance = Tolerance { absolute: tolerance * width, relative: 0.0 };
            let state = Integrator::new(integrator, tolerance, masses.x.clone(), FIRST_STEP);
            let mut equation = ParticleMethod::new(Kernel::new(resolution), &masses, pull, lattice_energy);
            if sums == FilmSums::Direct {
                equation.sum_directly();
            }
            Film::Particles { method: Box::new(equation), state }
        }
        FilmMethod::FiniteDifferences(FilmGrid { step_share }) => {
            let rule = StepRule { first: first_step(film, &scales), share: step_share, ..StepRule::ADAPTIVE };
            Film::Grid(Box::new(grid(film, &scales, &droplets, wall, pull, rule)?))
        }
    };
    let right = droplets.last().map_or(0.0, |droplet| droplet.center);
    let surroundings = Surroundings {
        scales,
        wall,
        resolution,
        right,
        about_axis: film.symmetry == FilmSymmetry::Axis,
        rest: film.contact_angle.map(|_| 1.0),
        cap_sides: cap_sides(film),
        takes_lattice_off: matches!(
            film.method,
            FilmMethod::Particles(FilmParticles { lattice_energy: LatticeEnergy::TakenOff, .. })
        ),
        most_droplets: most_droplets(film),
        is_self_similar: film.is_self_similar(),
        equilibrium,
    };
    Ok(ThinFilmSolver::new(moving, surroundings))
}

/// Initial number of droplets of a film that cannot break up; a pendent one or one on a precursor film can.
fn most_droplets(film: &ThinFilm) -> Option<usize> {
    (smoothing_length(film).is_some() && film.gravity >= 0.0).then_some(film.droplets.len())
}

/// Scaled first step on a grid: droplets of half width r and height H initially move on the time scale (3μr/γ)(r/H)³.
fn first_step(film: &ThinFilm, scales: &Scales) -> f64 {
    let time = |droplet: &FilmDroplet| {
        let ratio = droplet.half_width / droplet.height;
        3.0 * film.viscosity * droplet.half_width / film.tension * ratio.powi(3)
    };
    let shortest = film.droplets.iter().map(time).fold(f64::INFINITY, f64::min);
    FIRST_STEP.min(SHARE_OF_DROPLET * shortest / scales.time)
}

/// Number of principal curvatures of the parabolic equilibrium, if the droplet has one.
fn cap_sides(film: &ThinFilm) -> Option<f64> {
    film.rests_as_cap().then_some(match film.symmetry {
        FilmSymmetry::Plane => 1.0,
        FilmSymmetry::Axis => 2.0,
    })
}

fn smoothing_length(film: &ThinFilm) -> Option<f64> {
    match film.equation {
        FilmEquation::Geometric(Geometric { smoothing_length }) => Some(smoothing_length),
        FilmEquation::Slip(_) | FilmEquation::Precursor(_) => None,
    }
}

/// χ of the geometric equation, and the equilibrium droplet if its form is known.
///
/// All droplets share one ξ, so χ is that of a droplet of their mean area: equal ones rest at the prescribed angle.
fn rest(film: &ThinFilm, scales: &Scales, droplets: &[Droplet]) -> Result<(f64, Option<Equilibrium>), SetupError> {
    let (Some(_), Some(length)) = (film.contact_angle, smoothing_length(film)) else { return Ok((0.0, None)) };
    let mean = 1.0 / droplets.len() as f64;
    let alpha = length / scales.length;
    let least = film.droplets.iter().map(|droplet| droplet.half_width).fold(f64::INFINITY, f64::min);
    let too_smooth = SetupError::TooSmooth { length, usual: 0.1 * least };
    let wetting = Equilibrium::of_unit_slope(alpha / mean.sqrt()).ok_or(too_smooth)?.wetting();
    let alone = (droplets.len() == 1).then(|| Equilibrium::under_gravity(alpha, 1.0, wetting, scales.bond));
    Ok((wetting, alone.flatten()))
}

/// The film on its grid at time zero.
fn grid(
    film: &ThinFilm,
    scales: &Scales,
    droplets: &[Droplet],
    wall: [f64; 2],
    pull: Pull,
    rule: StepRule,
) -> Result<GridFilm, TooLarge> {
    let spacing = film.spacing / scales.length;
    let count = ((wall[1] - wall[0]) / film.spacing).round() as usize;
    let model = match (film.equation, film.symmetry) {
        (FilmEquation::Geometric(Geometric { smoothing_length }), FilmSymmetry::Plane) => {
            // One node is at x = 0.
            let before = (-wall[0] / film.spacing).round();
            let alpha = smoothing_length / scales.length;
            let Pull { wetting, bond } = pull;
            let line = Line { from: -before * spacing, count, spacing, alpha, wetting, bond };
            let (ring, height) = Ring::new(line, droplets, film.weights)?;
            return Ok(GridFilm::new(ring, height, rule));
        }
        (FilmEquation::Geometric(Geometric { smoothing_length }), FilmSymmetry::Axis) => {
            Model::Geometric { alpha: smoothing_length / scales.length }
        }
        (FilmEquation::Slip(Slip { slip_length, film_height }), _) => {
            Model::Slip { length: slip_length / scales.height, film: film_height / scales.height }
        }
        (FilmEquation::Precursor(Precursor { film_height, slip_length }), _) => {
            // The scaled equilibrium slope is 1.
            let slope = if film.contact_angle.is_some() { 1.0 } else { 0.0 };
            Model::Precursor { film: film_height / scales.height, slope, slip: slip_length / scales.height }
        }
    };
    let layout =
        Layout { from: wall[0] / scales.length, count, spacing, symmetry: film.symmetry, model, bond: scales.bond };
    let (cells, height) = Cells::new(layout, droplets, film.weights)?;
    Ok(GridFilm::new(cells, height, rule))
}
