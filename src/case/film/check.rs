//! Checks of `[thin-film]`.

use super::checked::{
    FilmDroplet, FilmEquation, FilmIntegrator, FilmMethod, FilmSymmetry, FilmWeights, LatticeEnergy, ThinFilm,
};
use super::raw::{
    RawDroplet, RawFilmEquation, RawFilmIntegrator, RawFilmMethod, RawFilmSymmetry, RawFilmWeights, RawFilmWetting,
    RawLatticeEnergy, RawThinFilm,
};
use crate::case::check::Checker;
use crate::case::preset::{COLD, WARM};
use crate::geometry::spec::GeometrySpec;

/// Most particles or nodes.
const MOST_UNKNOWNS: f64 = 1.0e7;
/// Fewest spacings in the filter length: with fewer, the particles do not see one another.
const FEWEST_IN_FILTER: f64 = 1.0;
/// Most spacings in the filter length on a grid: fourth differences lose (α/Δx)⁴ roundings of their digits.
const MOST_IN_FILTER: f64 = 1.0e3;
/// Filter length over the half width: above, there is no droplet of a given slope.
const LARGEST_SMOOTHING: f64 = 0.4;
/// Fewest spacings in the half width of a droplet.
const FEWEST_IN_DROPLET: f64 = 10.0;
/// Heights of films on the wall over that of the lowest droplet.
const FILMS: (f64, f64) = (1.0e-6, 0.2);
/// Most spacings over the height of a film, both over the scale of a droplet: a coarser grid does not see contact lines.
const COARSEST_FOR_FILM: f64 = 4.0;
/// Height of the film that counts as dry over the slip length, where the case says nothing.
const DRY: f64 = 0.1;
/// Slip lengths over the height of the lowest droplet.
const LARGEST_SLIP: f64 = 0.5;
/// Angles of rest in degrees at which a film may be called thin.
pub(super) const ANGLES: (f64, f64) = (0.1, 45.0);
/// Errors of a step over the initial width.
const TOLERANCES: (f64, f64) = (1.0e-12, 1.0e-3);
const DEFAULT_TOLERANCE: f64 = 1.0e-7;
/// Steps over the time since the start.
const STEP_SHARES: (f64, f64) = (1.0e-5, 0.1);
const DEFAULT_STEP_SHARE: f64 = 0.005;

/// What a film is made of, SI units.
struct Liquid {
    viscosity: f64,
    tension: f64,
    density: f64,
    gravity: f64,
}

/// In scaled units time, length and height are those of the scaled equations.
const SCALED: (f64, f64, f64) = (1.0 / 3.0, 1.0, 1.0);

/// Checks `[thin-film]`; `geometry` is missing where it was wrong.
pub(in crate::case) fn thin_film(
    checker: &mut Checker,
    raw: &RawThinFilm,
    geometry: Option<&GeometrySpec>,
) -> Option<ThinFilm> {
    let liquid = liquid(checker, raw);
    let spacing = checker.require("thin-film.spacing", raw.spacing, "spacing = 5.0e-6 # m");
    let spacing = checker.positive("thin-film.spacing", spacing, "a spacing in m");
    let symmetry = match raw.symmetry {
        None | Some(RawFilmSymmetry::Plane) => FilmSymmetry::Plane,
        Some(RawFilmSymmetry::Axis) => FilmSymmetry::Axis,
    };
    let droplets = droplets(checker, raw.droplets.as_deref().unwrap_or_default(), symmetry);
    let equation = equation(checker, &raw.equation.clone().unwrap_or_default());
    let contact_angle = wetting(checker, &raw.wetting.clone().unwrap_or_default());
    let particles_can_be =
        symmetry == FilmSymmetry::Plane && equation.is_none_or(|e| matches!(e, FilmEquation::Geometric { .. }));
    let method = method(checker, &raw.method.clone().unwrap_or_default(), particles_can_be);
    if let (Some(equation), Some(Some(_))) = (equation, contact_angle) {
        partial_wetting(checker, equation, symmetry);
    }
    if let (Some(spacing), Some(equation), Some(droplets)) = (spacing, equation, &droplets) {
        resolution(checker, spacing, equation, droplets);
        if let (FilmEquation::Geometric { smoothing_length }, Some(FilmMethod::FiniteDifferences { .. })) =
            (equation, method)
        {
            rounding(checker, spacing, smoothing_length);
        }
    }
    if let (Some(FilmMethod::Particles { lattice_energy: LatticeEnergy::TakenOff, .. }), Some([_, _, ..])) =
        (method, droplets.as_deref())
    {
        checker.refuse(
            "thin-film.method.particles.lattice-energy",
            "the lattice energy can be taken off one droplet, and there are several",
            "where droplets meet their lattices would not fit; take a smaller spacing, or finite differences",
        );
    }
    if let Some(geometry) = geometry {
        domain(checker, geometry, droplets.as_deref().unwrap_or_default(), symmetry);
        if let Some(spacing) = spacing {
            count(checker, geometry, spacing);
        }
    }
    let Liquid { viscosity, tension, density, gravity } = liquid?;
    Some(ThinFilm {
        viscosity,
        tension,
        density,
        gravity,
        spacing: spacing?,
        symmetry,
        droplets: droplets?,
        equation: equation?,
        contact_angle: contact_angle?,
        method: method?,
        weights: match raw.weights {
            None | Some(RawFilmWeights::Cell) => FilmWeights::Cell,
            Some(RawFilmWeights::Point) => FilmWeights::Point,
        },
    })
}

fn liquid(checker: &mut Checker, raw: &RawThinFilm) -> Option<Liquid> {
    let gravity = raw.gravity.unwrap_or(0.0);
    let Some(fluid) = &raw.fluid else {
        if raw.tension.is_some() {
            let help =
                "add [thin-film.fluid] with preset = \"water\" or viscosity in Pa s; leave out both for scaled units";
            checker.refuse("thin-film.tension", "there is a tension, and no fluid", help);
            return None;
        }
        let (viscosity, tension, density) = SCALED;
        return Some(Liquid { viscosity, tension, density, gravity });
    };
    let at = "thin-film.fluid";
    let celsius = checker.within(
        &format!("{at}.temperature-c"),
        fluid.temperature_c,
        (COLD, WARM),
        "a temperature in degrees Celsius",
    );
    let preset = fluid.preset.map(|preset| preset.at(celsius.unwrap_or(COLD)));
    let mut property = |path: &str, given: Option<f64>, known: Option<f64>, example: &str, what: &str| {
        let value = checker.require(path, given.or(known), example);
        checker.positive(path, value, what)
    };
    let viscosity = property(
        "thin-film.fluid.viscosity",
        fluid.viscosity,
        preset.map(|p| p.viscosity),
        "viscosity = 1.0e-2 # Pa s",
        "a viscosity in Pa s",
    );
    let tension = property(
        "thin-film.tension",
        raw.tension,
        preset.and_then(|p| p.tension),
        "tension = 0.03 # N/m",
        "a tension in N/m",
    );
    let known = fluid.density.or(preset.map(|p| p.density));
    let density = if gravity == 0.0 && known.is_none() {
        Some(0.0)
    } else {
        property("thin-film.fluid.density", known, None, "density = 998.2 # kg/m3", "a density in kg/m3")
    };
    Some(Liquid { viscosity: viscosity?, tension: tension?, density: density?, gravity })
}

fn droplets(checker: &mut Checker, raw: &[RawDroplet], symmetry: FilmSymmetry) -> Option<Vec<FilmDroplet>> {
    if raw.is_empty() {
        let help = "add [[thin-film.droplets]] with half-width and height in m";
        checker.refuse("thin-film.droplets", "expected a droplet, found none", help);
        return None;
    }
    let one = |checker: &mut Checker, index: usize, raw: &RawDroplet| {
        let mut positive = |key: &str, value: Option<f64>, example: &str| {
            let path = format!("thin-film.droplets[{index}].{key}");
            let value = checker.require(&path, value, example);
            checker.positive(&path, value, "a length in m")
        };
        let half_width = positive("half-width", raw.half_width, "half-width = 5.0e-4 # m");
        let height = positive("height", raw.height, "height = 4.0e-5 # m");
        let center = raw.center.unwrap_or(0.0);
        if symmetry == FilmSymmetry::Axis && center != 0.0 {
            checker.refuse(
                format!("thin-film.droplets[{index}].center"),
                format!("the middle of a droplet about an axis is at x = 0, found {center:e} m"),
                "leave it out, or set symmetry = \"plane\"",
            );
        }
        Some(FilmDroplet { center, half_width: half_width?, height: height? })
    };
    let found: Vec<Option<FilmDroplet>> = raw.iter().enumerate().map(|(index, raw)| one(checker, index, raw)).collect();
    let mut found: Vec<FilmDroplet> = found.into_iter().collect::<Option<_>>()?;
    found.sort_by(|a, b| a.center.total_cmp(&b.center));
    for pair in found.windows(2) {
        if pair[0].center + pair[0].half_width > pair[1].center - pair[1].half_width {
            checker.refuse(
                "thin-film.droplets",
                format!("the droplets at {:e} and {:e} m overlap", pair[0].center, pair[1].center),
                "move them apart, or make one droplet of them",
            );
        }
    }
    Some(found)
}

fn equation(checker: &mut Checker, raw: &RawFilmEquation) -> Option<FilmEquation> {
    let mut length = |path: &str, value: Option<f64>, example: &str| {
        let path = format!("thin-film.equation.{path}");
        let value = checker.require(&path, value, example);
        checker.positive(&path, value, "a length in m")
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
        (None, None, Some(raw)) => length("precursor.film-height", raw.film_height, "film-height = 1.0e-6 # m")
            .map(|film_height| FilmEquation::Precursor { film_height }),
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

/// Which equations can make a droplet rest.
fn partial_wetting(checker: &mut Checker, equation: FilmEquation, symmetry: FilmSymmetry) {
    let message = match (equation, symmetry) {
        (FilmEquation::Slip { .. }, _) => "the equation with slip is for complete wetting: it does not know an angle",
        (FilmEquation::Geometric { .. }, FilmSymmetry::Axis) => {
            "the wetting parameter of the geometric equation is known for plane droplets only"
        }
        _ => return,
    };
    checker.refuse("thin-film.wetting.partial", message, "[thin-film.equation.precursor] can do it");
}

fn method(checker: &mut Checker, raw: &RawFilmMethod, particles_can_be: bool) -> Option<FilmMethod> {
    if let (Some(_), Some(_)) = (&raw.particles, &raw.finite_differences) {
        checker.refuse(
            "thin-film.method",
            "expected exactly one method, found 2",
            "choose one of `particles`, `finite-differences`",
        );
        return None;
    }
    if raw.particles.is_some() && !particles_can_be {
        checker.refuse(
            "thin-film.method.particles",
            "particles solve the geometric equation in the plane, and no other",
            "leave the method out for finite differences",
        );
        return None;
    }
    if raw.finite_differences.is_some() || !particles_can_be {
        let path = "thin-film.method.finite-differences.step-share";
        let share = raw.finite_differences.as_ref().and_then(|raw| raw.step_share);
        let share = checker.within(path, share, STEP_SHARES, "a share");
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

fn resolution(checker: &mut Checker, spacing: f64, equation: FilmEquation, droplets: &[FilmDroplet]) {
    let least = |value: fn(&FilmDroplet) -> f64| droplets.iter().map(value).fold(f64::INFINITY, f64::min);
    let (half_width, height) = (least(|droplet| droplet.half_width), least(|droplet| droplet.height));
    if half_width < FEWEST_IN_DROPLET * spacing {
        checker.refuse(
            "thin-film.spacing",
            format!(
                "expected at least {FEWEST_IN_DROPLET} spacings in the half width of {half_width:e} m, found {:.2}",
                half_width / spacing
            ),
            format!("a spacing of {:.2e} m would do", half_width / FEWEST_IN_DROPLET),
        );
    }
    match equation {
        FilmEquation::Geometric { smoothing_length } => smoothing(checker, spacing, smoothing_length, half_width),
        FilmEquation::Slip { slip_length, film_height } => {
            if slip_length > LARGEST_SLIP * height {
                checker.refuse(
                    "thin-film.equation.slip.slip-length",
                    format!("expected at most {LARGEST_SLIP} of the height of {height:e} m, found {slip_length:e} m"),
                    format!("{:.2e} m is usual, a hundredth of it", 0.01 * height),
                );
            }
            film(checker, "slip", film_height, height);
            coarse(checker, spacing / half_width, slip_length / height);
        }
        FilmEquation::Precursor { film_height } => {
            film(checker, "precursor", film_height, height);
            coarse(checker, spacing / half_width, film_height / height);
        }
    }
}

fn smoothing(checker: &mut Checker, spacing: f64, smoothing: f64, half_width: f64) {
    let ratio = smoothing / spacing;
    if ratio < FEWEST_IN_FILTER {
        checker.refuse(
            "thin-film.spacing",
            format!("expected at least one spacing in the smoothing length of {smoothing:e} m, found {ratio:.2}"),
            format!("a spacing of {:.2e} m is usual, a tenth of it", 0.1 * smoothing),
        );
    }
    if smoothing > LARGEST_SMOOTHING * half_width {
        checker.refuse(
            "thin-film.equation.geometric.smoothing-length",
            format!(
                "expected at most {LARGEST_SMOOTHING} of the half width of {half_width:e} m, found {smoothing:e} m"
            ),
            format!("{:.2e} m is usual, a tenth of it", 0.1 * half_width),
        );
    }
}

fn rounding(checker: &mut Checker, spacing: f64, smoothing: f64) {
    let ratio = smoothing / spacing;
    if ratio > MOST_IN_FILTER {
        checker.refuse(
            "thin-film.spacing",
            format!("finite differences round off the film where the smoothing length has more than {MOST_IN_FILTER} spacings, found {ratio:.0}"),
            format!("a spacing of {:.2e} m is more than fine enough; particles may be finer", smoothing / MOST_IN_FILTER),
        );
    }
}

/// The film on the wall is thin beside the droplets.
fn film(checker: &mut Checker, equation: &str, film: f64, height: f64) {
    let ratio = film / height;
    if !(FILMS.0..=FILMS.1).contains(&ratio) {
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

/// The grid sees the contact line, where heights are those of the film or of the slip length.
fn coarse(checker: &mut Checker, spacing: f64, film: f64) {
    if spacing > COARSEST_FOR_FILM * film {
        checker.refuse(
            "thin-film.spacing",
            format!("the contact line is {film:.2e} of a droplet wide, a spacing is {spacing:.2e} of it"),
            format!("{COARSEST_FOR_FILM} spacings less coarse would do: the spacing over the half width is to be below {COARSEST_FOR_FILM} times the height of film or slip over that of the droplet"),
        );
    }
}

/// The domain is the wall from its left to its right side; the droplets stand on it.
fn domain(checker: &mut Checker, geometry: &GeometrySpec, droplets: &[FilmDroplet], symmetry: FilmSymmetry) {
    if !geometry.shapes.is_empty() {
        checker.refuse(
            "geometry",
            "expected a flat wall at y = 0 without solids, found shapes",
            "leave out the shapes; `min` and `max` say how much of the wall is of interest",
        );
    }
    let [left, right] = [geometry.min[0], geometry.max[0]];
    if symmetry == FilmSymmetry::Axis && left != 0.0 {
        checker.refuse(
            "geometry.min",
            format!("a film about an axis begins at x = 0, found {left:e} m"),
            "set the first number to 0.0, or symmetry = \"plane\"",
        );
    }
    for (index, droplet) in droplets.iter().enumerate() {
        let begins = droplet.center - droplet.half_width;
        let over_left = symmetry == FilmSymmetry::Plane && begins <= left;
        if over_left || droplet.center + droplet.half_width >= right {
            checker.refuse(
                format!("thin-film.droplets[{index}].half-width"),
                format!("the droplet at {:e} m reaches over the domain, from {left:e} to {right:e} m", droplet.center),
                "take a wider domain",
            );
        }
    }
}

fn count(checker: &mut Checker, geometry: &GeometrySpec, spacing: f64) {
    let count = (geometry.max[0] - geometry.min[0]) / spacing;
    if count > MOST_UNKNOWNS {
        checker.refuse(
            "thin-film.spacing",
            format!("{spacing:e} m would give {count:.2e} nodes, more than {MOST_UNKNOWNS:.0e}"),
            "",
        );
    }
}
