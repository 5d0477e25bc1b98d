//! A checked film as a table that loads to the same film.

use super::checked::{
    FilmEquation, FilmIntegrator, FilmMethod, FilmSums, FilmSymmetry, FilmWeights, LatticeEnergy, ThinFilm,
};
use super::equation::ANGLES;
use super::raw::{
    RawDroplet, RawFilmEquation, RawFilmGrid, RawFilmIntegrator, RawFilmMethod, RawFilmParticles, RawFilmSums,
    RawFilmSymmetry, RawFilmWeights, RawFilmWetting, RawGeometric, RawLatticeEnergy, RawPartialWetting, RawPrecursor,
    RawSlip, RawThinFilm,
};
use crate::case::raw::{Empty, RawFluid};

/// The film as a table.
pub(in crate::case) fn raw(film: &ThinFilm) -> RawThinFilm {
    let density = (film.density > 0.0).then_some(film.density);
    let fluid = RawFluid { density, viscosity: Some(film.viscosity), ..RawFluid::default() };
    RawThinFilm {
        fluid: Some(fluid),
        tension: Some(film.tension),
        gravity: Some(film.gravity),
        spacing: Some(film.spacing),
        symmetry: Some(match film.symmetry {
            FilmSymmetry::Plane => RawFilmSymmetry::Plane,
            FilmSymmetry::Axis => RawFilmSymmetry::Axis,
        }),
        droplets: Some(
            film.droplets
                .iter()
                .map(|droplet| RawDroplet {
                    center: Some(droplet.center),
                    half_width: Some(droplet.half_width),
                    height: Some(droplet.height),
                })
                .collect(),
        ),
        equation: Some(equation(film.equation)),
        wetting: Some(wetting(film.contact_angle)),
        method: Some(method(film.method)),
        weights: Some(match film.weights {
            FilmWeights::Cell => RawFilmWeights::Cell,
            FilmWeights::Point => RawFilmWeights::Point,
        }),
    }
}

fn equation(equation: FilmEquation) -> RawFilmEquation {
    let none = RawFilmEquation::default();
    match equation {
        FilmEquation::Geometric { smoothing_length } => {
            RawFilmEquation { geometric: Some(RawGeometric { smoothing_length: Some(smoothing_length) }), ..none }
        }
        FilmEquation::Slip { slip_length, film_height } => RawFilmEquation {
            slip: Some(RawSlip { slip_length: Some(slip_length), film_height: Some(film_height) }),
            ..none
        },
        FilmEquation::Precursor { film_height, slip_length } => {
            let slip_length = (slip_length > 0.0).then_some(slip_length);
            let precursor = RawPrecursor { film_height: Some(film_height), slip_length };
            RawFilmEquation { precursor: Some(precursor), ..none }
        }
    }
}

fn wetting(contact_angle: Option<f64>) -> RawFilmWetting {
    match contact_angle {
        None => RawFilmWetting { complete: Some(Empty {}), partial: None },
        Some(angle) => {
            let degrees = angle.to_degrees().clamp(ANGLES.0, ANGLES.1);
            RawFilmWetting { complete: None, partial: Some(RawPartialWetting { contact_angle_deg: Some(degrees) }) }
        }
    }
}

fn method(method: FilmMethod) -> RawFilmMethod {
    match method {
        FilmMethod::FiniteDifferences { step_share } => {
            RawFilmMethod { particles: None, finite_differences: Some(RawFilmGrid { step_share: Some(step_share) }) }
        }
        FilmMethod::Particles { integrator, tolerance, lattice_energy, sums } => RawFilmMethod {
            particles: Some(RawFilmParticles {
                integrator: Some(match integrator {
                    FilmIntegrator::Stiff => RawFilmIntegrator::Stiff,
                    FilmIntegrator::Explicit => RawFilmIntegrator::Explicit,
                }),
                tolerance: Some(tolerance),
                lattice_energy: Some(match lattice_energy {
                    LatticeEnergy::Kept => RawLatticeEnergy::Kept,
                    LatticeEnergy::TakenOff => RawLatticeEnergy::TakenOff,
                }),
                sums: Some(match sums {
                    FilmSums::Recursive => RawFilmSums::Recursive,
                    FilmSums::Direct => RawFilmSums::Direct,
                }),
            }),
            finite_differences: None,
        },
    }
}
