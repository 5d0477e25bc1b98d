//! Checks of the equation of a thin film and of what it knows of wetting.

use super::checked::{FilmEquation, FilmSymmetry};
use super::raw::{RawFilmEquation, RawFilmWetting};
use crate::input::Checker;

/// Height of the film that counts as dry over the slip length, where the case says nothing.
const DRY: f64 = 0.1;
/// Angles of rest in degrees at which a film may be called thin.
pub(super) const ANGLES: (f64, f64) = (0.1, 45.0);

pub(super) fn equation(checker: &mut Checker, raw: &RawFilmEquation) -> Option<FilmEquation> {
    let mut length = |path: &str, value: Option<f64>, example: &str| {
        let path = format!("thin-film.equation.{path}");
        checker.require_positive(&path, value, example, "a length in m")
    };
    match (&raw.geometric, &raw.slip, &raw.precursor) {
        (Some(raw), None, None) => {
            let example = "smoothing-length = 5.0e-5 # m";
            length("geometric.smoothing-length", raw.smoothing_length, example)
                .map(|smoothing_length| FilmEquation::Geometric { smoothing_length })
        }
        (None, Some(raw), None) => {
            let slip = length("slip.slip-length", raw.slip_length, "slip-length = 1.0e-6 # m");
            let film = raw.film_height.or(slip.map(|slip| DRY * slip));
            let film = film.and_then(|film| length("slip.film-height", Some(film), ""));
            Some(FilmEquation::Slip { slip_length: slip?, film_height: film? })
        }
        (None, None, Some(raw)) => {
            let film = length("precursor.film-height", raw.film_height, "film-height = 1.0e-6 # m");
            let slip = match raw.slip_length {
                None => Some(0.0),
                given => length("precursor.slip-length", given, ""),
            };
            Some(FilmEquation::Precursor { film_height: film?, slip_length: slip? })
        }
        (None, None, None) => {
            checker.refuse(
                "thin-film.equation",
                "expected an equation, found none",
                "add [thin-film.equation.geometric] with smoothing-length in m, or `slip`, or `precursor`",
            );
            None
        }
        _ => {
            checker.refuse(
                "thin-film.equation",
                "expected exactly one equation, found more",
                "choose one of `geometric`, `slip`, `precursor`",
            );
            None
        }
    }
}

/// The angle of rest in rad; the outer option is missing where it was wrong.
#[expect(clippy::option_option, reason = "a wrong angle is not the same as complete wetting")]
pub(super) fn wetting(checker: &mut Checker, raw: &RawFilmWetting) -> Option<Option<f64>> {
    match (&raw.complete, &raw.partial) {
        (Some(_), Some(_)) => {
            checker.refuse(
                "thin-film.wetting",
                "expected exactly one wetting model, found 2",
                "choose one of `complete`, `partial`",
            );
            None
        }
        (_, None) => Some(None),
        (None, Some(partial)) => {
            let path = "thin-film.wetting.partial.contact-angle-deg";
            let angle = checker.require(path, partial.contact_angle_deg, "contact-angle-deg = 10.0");
            checker.within(path, angle, ANGLES, "an angle in degrees").map(|angle| Some(angle.to_radians()))
        }
    }
}

/// Which equations can make a droplet rest.
pub(super) fn partial_wetting(checker: &mut Checker, equation: FilmEquation, symmetry: FilmSymmetry) {
    let message = match (equation, symmetry) {
        (FilmEquation::Slip { .. }, _) => "the equation with slip is for complete wetting: it does not know an angle",
        (FilmEquation::Geometric { .. }, FilmSymmetry::Axis) => {
            "the wetting parameter of the geometric equation is known for plane droplets only"
        }
        _ => return,
    };
    checker.refuse("thin-film.wetting.partial", message, "[thin-film.equation.precursor] can do it");
}
