//! Checks of the spacing relative to droplets, filter, slip length and films on the wall.

use super::bounds::{exceeds, falls_short, is_outside};
use super::droplets::FilmDroplet;
use super::equation::{FilmEquation, Geometric, Precursor, Slip};
use meniscus_core::input::Checker;
use meniscus_core::math::rounded_down;
use meniscus_geometry::spec::GeometrySpec;

/// Most particles or nodes.
const MOST_UNKNOWNS: f64 = 1.0e7;
/// Fewest spacings in the filter length.
const FEWEST_IN_FILTER: f64 = 1.0;
/// The same for particles: with fewer, the smoothed film has a peak at each particle, and droplets break up.
const FEWEST_BETWEEN_PARTICLES: f64 = 2.0;
/// Most spacings in the filter length on a grid: fourth differences lose digits by (α/Δx)⁴ rounding errors.
const MOST_IN_FILTER: f64 = 1.0e3;
/// Largest filter length relative to the half width: above, there is no droplet of a given slope.
const LARGEST_SMOOTHING: f64 = 0.4;
/// Fewest spacings in the half width of a droplet.
const FEWEST_IN_DROPLET: f64 = 10.0;
/// Heights of films on the wall relative to that of the lowest droplet.
const FILMS: (f64, f64) = (1.0e-6, 0.2);
/// Largest spacing relative to the height of a film, both scaled by the droplet: a coarser grid does not resolve contact lines.
const COARSEST_FOR_FILM: f64 = 4.0;
/// Largest slip length relative to the height of the lowest droplet.
const LARGEST_SLIP: f64 = 0.5;

pub(super) fn resolution(checker: &mut Checker, spacing: f64, equation: FilmEquation, droplets: &[FilmDroplet]) {
    let least = |value: fn(&FilmDroplet) -> f64| droplets.iter().map(value).fold(f64::INFINITY, f64::min);
    let (half_width, height) = (least(|droplet| droplet.half_width), least(|droplet| droplet.height));
    if falls_short(half_width, FEWEST_IN_DROPLET * spacing) {
        checker.refuse(
            "thin-film.spacing",
            format!(
                "expected at least {FEWEST_IN_DROPLET} spacings in the half width of {half_width:e} m, found {:.2}",
                half_width / spacing
            ),
            format!("a spacing of {:.2e} m would do", rounded_down(half_width / FEWEST_IN_DROPLET)),
        );
    }
    match equation {
        FilmEquation::Geometric(Geometric { smoothing_length }) => {
            smoothing(checker, spacing, smoothing_length, half_width)
        }
        FilmEquation::Slip(Slip { slip_length, film_height }) => {
            slip(checker, "slip", slip_length, height);
            film(checker, "slip", film_height, height);
            coarse(checker, spacing / half_width, slip_length / height);
        }
        FilmEquation::Precursor(Precursor { film_height, slip_length }) => {
            slip(checker, "precursor", slip_length, height);
            film(checker, "precursor", film_height, height);
            coarse(checker, spacing / half_width, film_height / height);
        }
    }
}

fn smoothing(checker: &mut Checker, spacing: f64, smoothing: f64, half_width: f64) {
    let ratio = smoothing / spacing;
    if falls_short(ratio, FEWEST_IN_FILTER) {
        checker.refuse(
            "thin-film.spacing",
            format!("expected at least one spacing in the smoothing length of {smoothing:e} m, found {ratio:.2}"),
            format!("a spacing of {:.2e} m is usual, a tenth of it", 0.1 * smoothing),
        );
    }
    if exceeds(smoothing, LARGEST_SMOOTHING * half_width) {
        checker.refuse(
            "thin-film.equation.geometric.smoothing-length",
            format!(
                "expected at most {LARGEST_SMOOTHING} of the half width of {half_width:e} m, found {smoothing:e} m"
            ),
            format!("{:.2e} m is usual, a tenth of it", 0.1 * half_width),
        );
    }
}

pub(super) fn particles(checker: &mut Checker, spacing: f64, smoothing: f64) {
    let ratio = smoothing / spacing;
    if !falls_short(ratio, FEWEST_IN_FILTER) && falls_short(ratio, FEWEST_BETWEEN_PARTICLES) {
        checker.refuse(
            "thin-film.spacing",
            format!(
                "particles need at least {FEWEST_BETWEEN_PARTICLES} spacings in the smoothing length of {smoothing:e} m, found {ratio:.2}"
            ),
            format!("a spacing of {:.2e} m is usual, a tenth of it; or take [thin-film.method.finite-differences]", 0.1 * smoothing),
        );
    }
}

pub(super) fn rounding(checker: &mut Checker, spacing: f64, smoothing: f64) {
    let ratio = smoothing / spacing;
    if exceeds(ratio, MOST_IN_FILTER) {
        checker.refuse(
            "thin-film.spacing",
            format!("finite differences round off the film where the smoothing length has more than {MOST_IN_FILTER} spacings, found {ratio:.0}"),
            format!("a spacing of {:.2e} m is more than fine enough; particles may be finer", smoothing / MOST_IN_FILTER),
        );
    }
}

fn slip(checker: &mut Checker, equation: &str, slip: f64, height: f64) {
    if exceeds(slip, LARGEST_SLIP * height) {
        checker.refuse(
            format!("thin-film.equation.{equation}.slip-length"),
            format!("expected at most {LARGEST_SLIP} of the height of {height:e} m, found {slip:e} m"),
            format!("{:.2e} m is usual, a hundredth of it", 0.01 * height),
        );
    }
}

/// Requires that the film on the wall is thin compared with the droplets.
fn film(checker: &mut Checker, equation: &str, film: f64, height: f64) {
    let ratio = film / height;
    if is_outside(ratio, FILMS) {
        checker.refuse(
            format!("thin-film.equation.{equation}.film-height"),
            format!(
                "expected {:e} to {:?} of the droplets' height of {height:e} m, found {film:e} m",
                FILMS.0, FILMS.1
            ),
            format!("{:.2e} m is usual, a hundredth of it", 0.01 * height),
        );
    }
}

/// Requires that the grid resolves the contact line, where heights are those of the film or of the slip length.
fn coarse(checker: &mut Checker, spacing: f64, film: f64) {
    if exceeds(spacing, COARSEST_FOR_FILM * film) {
        checker.refuse(
            "thin-film.spacing",
            format!("relative to the droplet, the contact line is {film:.2e} wide and a spacing {spacing:.2e}"),
            format!("use a finer spacing: the spacing over the half width must be below {COARSEST_FOR_FILM} times the height of film or slip over that of the droplet"),
        );
    }
}

pub(super) fn count(checker: &mut Checker, geometry: &GeometrySpec, spacing: f64) {
    let count = (geometry.max[0] - geometry.min[0]) / spacing;
    if exceeds(count, MOST_UNKNOWNS) {
        checker.refuse(
            "thin-film.spacing",
            format!("{spacing:e} m would give {count:.2e} nodes, more than {MOST_UNKNOWNS:.0e}"),
            "",
        );
    }
}
