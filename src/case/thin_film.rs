//! Checks of `[thin-film]`, and a checked film written out again.

use super::check::Checker;
use super::checked::{FilmIntegrator, FilmMethod, FilmWeights, LatticeEnergy, ThinFilm};
use super::raw::{
    Empty, RawDroplet, RawFilmGrid, RawFilmIntegrator, RawFilmMethod, RawFilmParticles, RawFilmWeights, RawFilmWetting,
    RawLatticeEnergy, RawPartialWetting, RawThinFilm,
};
use crate::geometry::spec::GeometrySpec;

/// Most particles or nodes.
const MOST_UNKNOWNS: f64 = 1.0e7;
/// Filter length over spacing: below 1 the particles do not see one another, above 1000 they are too many to be of use.
const RESOLUTION: (f64, f64) = (1.0, 1.0e3);
/// Filter length over the half width: above, there is no droplet of a given slope.
const LARGEST_SMOOTHING: f64 = 0.4;
/// Angles of rest in degrees at which a film may be called thin.
const ANGLES: (f64, f64) = (0.1, 45.0);
/// Errors of a step over the initial width.
const TOLERANCES: (f64, f64) = (1.0e-12, 1.0e-3);
const DEFAULT_TOLERANCE: f64 = 1.0e-7;
/// Steps over the time since the start.
const STEP_SHARES: (f64, f64) = (1.0e-5, 0.1);
const DEFAULT_STEP_SHARE: f64 = 0.005;

/// Checks `[thin-film]`; `geometry` is missing where it was wrong.
pub(super) fn thin_film(checker: &mut Checker, raw: &RawThinFilm, geometry: Option<&GeometrySpec>) -> Option<ThinFilm> {
    let mut positive = |path: &str, value: Option<f64>, example: &str, what: &str| {
        let path = format!("thin-film.{path}");
        let value = checker.require(&path, value, example);
        checker.positive(&path, value, what)
    };
    let droplet = raw.droplet.clone().unwrap_or_default();
    let viscosity = positive("viscosity", raw.viscosity, "viscosity = 1.0e-2 # Pa s", "a viscosity in Pa s");
    let tension = positive("tension", raw.tension, "tension = 0.03 # N/m", "a tension in N/m");
    let spacing = positive("spacing", raw.spacing, "spacing = 5.0e-6 # m", "a spacing in m");
    let smoothing =
        positive("smoothing-length", raw.smoothing_length, "smoothing-length = 5.0e-5 # m", "a length in m");
    let half_width = positive("droplet.half-width", droplet.half_width, "half-width = 5.0e-4 # m", "a length in m");
    let height = positive("droplet.height", droplet.height, "height = 4.0e-5 # m", "a height in m");
    let contact_angle = wetting(checker, &raw.wetting.clone().unwrap_or_default());
    let method = method(checker, &raw.method.clone().unwrap_or_default());
    if let (Some(spacing), Some(smoothing), Some(half_width)) = (spacing, smoothing, half_width) {
        resolution(checker, spacing, smoothing, half_width);
    }
    if let Some(geometry) = geometry {
        domain(checker, geometry, half_width, spacing);
    }
    Some(ThinFilm {
        viscosity: viscosity?,
        tension: tension?,
        smoothing_length: smoothing?,
        spacing: spacing?,
        half_width: half_width?,
        height: height?,
        contact_angle: contact_angle?,
        method: method?,
        weights: match raw.weights {
            None | Some(RawFilmWeights::Cell) => FilmWeights::Cell,
            Some(RawFilmWeights::Point) => FilmWeights::Point,
        },
    })
}

fn resolution(checker: &mut Checker, spacing: f64, smoothing: f64, half_width: f64) {
    let ratio = smoothing / spacing;
    if !(RESOLUTION.0..=RESOLUTION.1).contains(&ratio) {
        checker.refuse(
            "thin-film.spacing",
            format!("expected 1 to 1000 spacings in the smoothing length of {smoothing:e} m, found {ratio:.2}"),
            format!("a spacing of {:.2e} m is usual, a tenth of it", 0.1 * smoothing),
        );
    }
    if smoothing > LARGEST_SMOOTHING * half_width {
        checker.refuse(
            "thin-film.smoothing-length",
            format!(
                "expected at most {LARGEST_SMOOTHING} of the half width of {half_width:e} m, found {smoothing:e} m"
            ),
            format!("{:.2e} m is usual, a tenth of it", 0.1 * half_width),
        );
    }
}

/// The domain is the wall from its left to its right side; the droplet stands on it with its middle at x = 0.
fn domain(checker: &mut Checker, geometry: &GeometrySpec, half_width: Option<f64>, spacing: Option<f64>) {
    if !geometry.shapes.is_empty() {
        checker.refuse(
            "geometry",
            "expected a flat wall at y = 0 without solids, found shapes",
            "leave out the shapes; `min` and `max` say how much of the wall is of interest",
        );
    }
    let reach = (-geometry.min[0]).min(geometry.max[0]);
    if let Some(half_width) = half_width
        && reach <= half_width
    {
        checker.refuse(
            "thin-film.droplet.half-width",
            format!(
                "the droplet about x = 0 reaches over the domain, from {:e} to {:e} m",
                geometry.min[0], geometry.max[0]
            ),
            "take a wider domain",
        );
    }
    if let Some(spacing) = spacing {
        let count = (geometry.max[0] - geometry.min[0]) / spacing;
        if count > MOST_UNKNOWNS {
            checker.refuse(
                "thin-film.spacing",
                format!("{spacing:e} m would give {count:.2e} nodes, more than {MOST_UNKNOWNS:.0e}"),
                "",
            );
        }
    }
}

/// The angle of rest in rad; the outer option is missing where it was wrong.
#[expect(clippy::option_option, reason = "a wrong angle is not the same as complete wetting")]
fn wetting(checker: &mut Checker, raw: &RawFilmWetting) -> Option<Option<f64>> {
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

fn method(checker: &mut Checker, raw: &RawFilmMethod) -> Option<FilmMethod> {
    if let (Some(_), Some(_)) = (&raw.particles, &raw.finite_differences) {
        checker.refuse(
            "thin-film.method",
            "expected exactly one method, found 2",
            "choose one of `particles`, `finite-differences`",
        );
        return None;
    }
    if let Some(raw) = &raw.finite_differences {
        let path = "thin-film.method.finite-differences.step-share";
        let share = checker.within(path, raw.step_share, STEP_SHARES, "a share");
        return Some(FilmMethod::FiniteDifferences { step_share: share.unwrap_or(DEFAULT_STEP_SHARE) });
    }
    let raw = raw.particles.clone().unwrap_or_default();
    let path = "thin-film.method.particles.tolerance";
    let tolerance = checker.within(path, raw.tolerance, TOLERANCES, "a relative error");
    Some(FilmMethod::Particles {
        integrator: match raw.integrator {
            None | Some(RawFilmIntegrator::Stiff) => FilmIntegrator::Stiff,
            Some(RawFilmIntegrator::Explicit) => FilmIntegrator::Explicit,
        },
        tolerance: tolerance.unwrap_or(DEFAULT_TOLERANCE),
        lattice_energy: match raw.lattice_energy {
            None | Some(RawLatticeEnergy::Kept) => LatticeEnergy::Kept,
            Some(RawLatticeEnergy::TakenOff) => LatticeEnergy::TakenOff,
        },
    })
}

/// The film as a table that loads to the same film.
pub(super) fn raw(film: &ThinFilm) -> RawThinFilm {
    let wetting = match film.contact_angle {
        None => RawFilmWetting { complete: Some(Empty {}), partial: None },
        Some(angle) => {
            let degrees = angle.to_degrees().clamp(ANGLES.0, ANGLES.1);
            RawFilmWetting { complete: None, partial: Some(RawPartialWetting { contact_angle_deg: Some(degrees) }) }
        }
    };
    RawThinFilm {
        viscosity: Some(film.viscosity),
        tension: Some(film.tension),
        smoothing_length: Some(film.smoothing_length),
        spacing: Some(film.spacing),
        droplet: Some(RawDroplet { half_width: Some(film.half_width), height: Some(film.height) }),
        wetting: Some(wetting),
        method: Some(raw_method(film.method)),
        weights: Some(match film.weights {
            FilmWeights::Cell => RawFilmWeights::Cell,
            FilmWeights::Point => RawFilmWeights::Point,
        }),
    }
}

fn raw_method(method: FilmMethod) -> RawFilmMethod {
    match method {
        FilmMethod::FiniteDifferences { step_share } => {
            RawFilmMethod { particles: None, finite_differences: Some(RawFilmGrid { step_share: Some(step_share) }) }
        }
        FilmMethod::Particles { integrator, tolerance, lattice_energy } => RawFilmMethod {
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
            }),
            finite_differences: None,
        },
    }
}
