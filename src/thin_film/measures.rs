//! Final results of a thin film: where its contact line is, how it came there, how far it is from rest.

use super::profile::exponent;
use super::solver::ThinFilmSolver;
use crate::solver::{Measure, Series, Solver};

/// Share of the run that the exponent leaves out at its beginning, where the droplet still forgets its shape.
const FORGETTING: f64 = 1.0 / 50.0;
/// Above this share of the film's slope, the lattice of particles holds the contact line back visibly.
const VISIBLE: f64 = 0.1;

/// All measures of a film.
#[must_use]
pub fn all(solver: &ThinFilmSolver, series: &Series) -> Vec<Measure> {
    let surroundings = solver.surroundings();
    let (scales, film) = (surroundings.scales, solver.film());
    let foot = solver.foot();
    let slope = foot.map_or(f64::NAN, |foot| foot.slope);
    let position = foot.map_or(f64::NAN, |foot| foot.position * scales.length);
    let angle = (slope * scales.slope()).atan().to_degrees();
    let mut found = vec![
        measure(
            "contact-line-position",
            position,
            "m",
            "where the tangent at the steepest place on the right meets the wall",
        ),
        measure("center-height", film.center_height() * scales.height, "m", "smoothed height at x = 0"),
        measure("contact-angle-deg", angle, "deg", "angle of the tangent at the steepest place on the right"),
    ];
    let (value, method) = spreading(solver, series, "contact_line_position_m");
    found.push(measure("contact-line-exponent", value, "", &method));
    if let Some(last) = film.last_particle() {
        found.push(measure("last-particle-position", last * scales.length, "m", "position of the last particle"));
        let (value, method) = spreading(solver, series, "last_particle_position_m");
        found.push(measure("last-particle-exponent", value, "", &method));
    }
    if let Some(droplet) = surroundings.equilibrium {
        found.push(measure("contact-angle-ratio", slope, "", "slope at the steepest place over the slope at rest"));
        let distance = solver.profile().distance_to(|x| droplet.height(x));
        found.push(measure(
            "equilibrium-l1-error",
            distance / droplet.area,
            "",
            "area between the profile and that of the droplet at rest, over the area of the droplet",
        ));
    }
    if let Some(lattice) = film.lattice_slope() {
        let share = lattice / slope;
        let method = if share > VISIBLE {
            "slope that the lattice of particles imitates over that of the film; the contact line is held back: take a \
             smaller spacing, or lattice-energy = \"taken-off\""
        } else {
            "slope that the lattice of particles imitates over that of the film"
        };
        found.push(measure("lattice-slope-ratio", share, "", method));
    }
    found
}

/// The exponent of a column in time, and how it was found.
fn spreading(solver: &ThinFilmSolver, series: &Series, column: &str) -> (f64, String) {
    let start = FORGETTING * solver.time();
    let points = series.column("time_s").zip(series.column(column)).filter(|(t, _)| *t >= start * (1.0 - 1.0e-9));
    let method = format!("least squares in the logarithms of time and position, from {start:.3e} s to the end");
    (exponent(points).unwrap_or(f64::NAN), method)
}

fn measure(name: &str, value: f64, unit: &str, method: &str) -> Measure {
    Measure { name: name.into(), value, unit: unit.into(), uncertainty: None, method: method.into() }
}
