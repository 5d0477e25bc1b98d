//! `[thin-film.equation]` and `[thin-film.wetting]`: the equation of a thin film, and its wetting model.

use super::droplets::FilmSymmetry;
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Empty, Key, checked_tables, tables};

tables! {
    /// Thin-film equations.
    pub(crate) struct RawFilmEquation {
        /// Geometric thin-film equation with a smoothed film (Pang and Ó Náraigh 2022).
        pub geometric: RawGeometric,
        /// Navier slip on the wall; complete wetting only.
        pub slip: RawSlip,
        /// Precursor film on the wall.
        pub precursor: RawPrecursor,
    }

    /// Wetting models of thin films.
    pub(crate) struct RawFilmWetting {
        /// The film spreads without end.
        pub complete: Empty,
        /// The film comes to rest at a contact angle.
        pub partial: RawPartialWetting,
    }

    /// Partial wetting of a thin film.
    pub(crate) struct RawPartialWetting {
        /// Static contact angle in degrees; the droplet at rest must fit the domain.
        pub contact_angle_deg: f64 => Key::within("an angle in degrees", ANGLES.0, ANGLES.1).example("contact-angle-deg = 10.0"),
    }
}

checked_tables! {
    /// The Geometric Thin-Film Equation.
    pub struct RawGeometric for Geometric {
        /// Filter length `α` in m: at least 1 spacing, with particles 2, at most 0.4 half widths; on a grid at most 1000 spacings.
        pub smoothing_length: f64 => Key::positive("a length in m").example("smoothing-length = 5.0e-5 # m"),
    }

    /// The thin-film equation with slip.
    pub struct RawSlip for Slip {
        /// Slip length `λ` in m, at most half of the droplet height.
        pub slip_length: f64 => Key::positive("a length in m").example("slip-length = 1.0e-6 # m"),
        /// Film height in m that counts as dry, 1e-6 to 0.2 of the droplet height (default: a tenth of the slip
        /// length).
        pub film_height: f64 => Key::positive("a length in m"),
    }

    /// The thin-film equation with a precursor film.
    pub struct RawPrecursor for Precursor {
        /// Film height in m, 1e-6 to 0.2 of the droplet height.
        pub film_height: f64 => Key::positive("a length in m").example("film-height = 1.0e-6 # m"),
        /// Slip length `λ` in m, at most half of the droplet height (default: no slip).
        pub slip_length: f64 => Key::positive("a length in m"),
    }
}

/// Thin-film equations; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FilmEquation {
    /// Geometric Thin-Film Equation.
    Geometric(Geometric),
    /// Navier slip.
    Slip(Slip),
    /// Precursor film; a slip length of 0 for a no-slip wall.
    Precursor(Precursor),
}

/// The equations in a case file.
pub(super) const EQUATION: &str =
    "[thin-film.equation.geometric] with smoothing-length in m, or `slip`, or `precursor`";
/// Height of the film that counts as dry relative to the slip length, if the case does not give it.
const DRY: f64 = 0.1;
/// Contact angles at rest in degrees for which a film may be called thin.
const ANGLES: (f64, f64) = (0.1, 45.0);

/// The equation of a case, `None` if it is missing or wrong.
pub(super) fn equation(checker: &mut Checker, raw: &mut RawFilmEquation) -> Option<FilmEquation> {
    match (&raw.geometric, &mut raw.slip, &raw.precursor) {
        (Some(raw), None, None) => raw.clone().complete().map(FilmEquation::Geometric),
        (None, Some(raw), None) => {
            raw.film_height = raw.film_height.or(raw.slip_length.map(|slip| DRY * slip));
            raw.clone().complete().map(FilmEquation::Slip)
        }
        (None, None, Some(raw)) => {
            let slip_length = raw.slip_length.or(Some(0.0));
            RawPrecursor { slip_length, ..raw.clone() }.complete().map(FilmEquation::Precursor)
        }
        (None, None, None) => checker.require("thin-film.equation", None, EQUATION),
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

/// The contact angle at rest in rad; the outer option is missing if it was wrong.
#[expect(clippy::option_option, reason = "a wrong angle is not the same as complete wetting")]
pub(super) fn wetting(checker: &mut Checker, raw: &mut RawFilmWetting) -> Option<Option<f64>> {
    match (&raw.complete, &raw.partial) {
        (Some(_), Some(_)) => {
            checker.refuse(
                "thin-film.wetting",
                "expected exactly one wetting model, found 2",
                "choose one of `complete`, `partial`",
            );
            None
        }
        (_, None) => {
            raw.complete = Some(Empty {});
            Some(None)
        }
        (None, Some(partial)) => partial.contact_angle_deg.map(|angle| Some(angle.to_radians())),
    }
}

/// Which equations support a droplet at rest.
pub(super) fn partial_wetting(checker: &mut Checker, equation: FilmEquation, symmetry: FilmSymmetry) {
    let message = match (equation, symmetry) {
        (FilmEquation::Slip(_), _) => "the equation with slip is for complete wetting: it has no contact angle",
        (FilmEquation::Geometric(_), FilmSymmetry::Axis) => {
            "the wetting parameter of the geometric equation is known for plane droplets only"
        }
        _ => return,
    };
    checker.refuse("thin-film.wetting.partial", message, "[thin-film.equation.precursor] can do it");
}
