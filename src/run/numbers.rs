//! The dimensionless numbers of a case and the limits of its time step, by formulas that are stated with them.
//!
//! With rho, mu of the wetting phase, sigma the tension, L the shorter side of the domain, U a speed:
//! Re = rho U L/mu, Ca = mu U/sigma, We = rho U² L/sigma, Bo = |rho_w - rho_n| g L²/sigma (rho_w alone in single-phase flow),
//! La = sigma rho L/mu², Oh = La^(-1/2).

use serde::Serialize;

use crate::case::checked::{Case, Model, ThinFilm};
use crate::math::Vec2;

/// A dimensionless number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Number {
    /// Its usual symbol, such as `Re`.
    pub symbol: &'static str,
    /// Its value.
    pub value: f64,
    /// How it is formed.
    pub formula: &'static str,
}

/// The numbers of a case at the speed `speed` in m/s; those that need a tension are absent without one.
#[must_use]
pub fn numbers(case: &Case, speed: f64) -> Vec<Number> {
    let sph = match &case.model {
        Model::Sph(sph) => sph,
        Model::ThinFilm(film) => return of_thin_film(film, speed),
    };
    let (rho, mu, sigma) = (sph.wetting.density, sph.wetting.viscosity, sph.tension);
    let length = reference_length(case);
    let difference = (rho - sph.non_wetting.map_or(0.0, |fluid| fluid.density)).abs();
    let number = |symbol, value, formula| Number { symbol, value, formula };
    let mut all = vec![number("Re", rho * speed * length / mu, "rho U L / mu")];
    if sigma > 0.0 {
        let laplace = sigma * rho * length / (mu * mu);
        all.extend([
            number("Ca", mu * speed / sigma, "mu U / sigma"),
            number("We", rho * speed * speed * length / sigma, "rho U^2 L / sigma"),
            number("Bo", difference * sph.gravity.norm() * length * length / sigma, "|rho_w - rho_n| g L^2 / sigma"),
            number("Oh", laplace.powf(-0.5), "mu / sqrt(rho sigma L)"),
            number("La", laplace, "rho sigma L / mu^2"),
        ]);
    }
    all
}

/// A thin film has no inertia; what matters is how slow and how flat it is.
fn of_thin_film(film: &ThinFilm, speed: f64) -> Vec<Number> {
    let number = |symbol, value, formula| Number { symbol, value, formula };
    vec![
        number("Ca", film.viscosity * speed / film.tension, "mu U / sigma"),
        number("H/W", film.height / (2.0 * film.half_width), "initial height / initial width"),
        number("alpha/dx", film.smoothing_length / film.spacing, "filter length / spacing"),
    ]
}

/// The length L of the numbers: the shorter side of the domain in m.
#[must_use]
pub fn reference_length(case: &Case) -> f64 {
    (Vec2::from(case.geometry.max) - Vec2::from(case.geometry.min)).min()
}
