//! Checks of the droplets of a thin film, of their liquid and of the wall that they stand on.

use super::bounds::exceeds;
use super::checked::{FilmDroplet, FilmSymmetry, SCALED};
use super::raw::{RawDroplet, RawThinFilm};
use crate::case::preset::{COLD, WARM};
use crate::geometry::spec::GeometrySpec;
use crate::input::Checker;

/// What a film is made of, SI units.
pub(super) struct Liquid {
    pub viscosity: f64,
    pub tension: f64,
    pub density: f64,
    pub gravity: f64,
}

pub(super) fn liquid(checker: &mut Checker, raw: &RawThinFilm) -> Option<Liquid> {
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
        checker.require_positive(path, given.or(known), example, what)
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

pub(super) fn droplets(checker: &mut Checker, raw: &[RawDroplet], symmetry: FilmSymmetry) -> Option<Vec<FilmDroplet>> {
    if raw.is_empty() {
        let help = "add [[thin-film.droplets]] with half-width and height in m";
        checker.refuse("thin-film.droplets", "expected a droplet, found none", help);
        return None;
    }
    let one = |checker: &mut Checker, index: usize, raw: &RawDroplet| {
        let mut positive = |key: &str, value: Option<f64>, example: &str| {
            let path = format!("thin-film.droplets[{index}].{key}");
            checker.require_positive(&path, value, example, "a length in m")
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
        if exceeds(pair[0].half_width + pair[1].half_width, pair[1].center - pair[0].center) {
            checker.refuse(
                "thin-film.droplets",
                format!("the droplets at {:e} and {:e} m overlap", pair[0].center, pair[1].center),
                "move them apart, or make one droplet of them",
            );
        }
    }
    Some(found)
}

/// The domain is the wall from its left to its right side; the droplets stand on it.
pub(super) fn domain(checker: &mut Checker, geometry: &GeometrySpec, droplets: &[FilmDroplet], symmetry: FilmSymmetry) {
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
