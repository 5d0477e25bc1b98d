//! Checks of `[thin-film]`: each part by its own file, and what one part asks of another.

use super::checked::{FilmEquation, FilmMethod, FilmSymmetry, FilmWeights, LatticeEnergy, ThinFilm};
use super::droplets::{Liquid, domain, droplets, liquid};
use super::equation::{equation, partial_wetting, wetting};
use super::method::{DefaultMethod, method};
use super::raw::{RawFilmSymmetry, RawFilmWeights, RawThinFilm};
use super::resolution::{count, particles, resolution, rounding};
use super::thinness;
use crate::geometry::spec::GeometrySpec;
use crate::input::Checker;

/// Checks `[thin-film]`; `geometry` is missing where it was wrong.
pub(in crate::case) fn thin_film(
    checker: &mut Checker,
    raw: &RawThinFilm,
    geometry: Option<&GeometrySpec>,
) -> Option<ThinFilm> {
    let liquid = liquid(checker, raw);
    let spacing = checker.require_positive("thin-film.spacing", raw.spacing, "spacing = 5.0e-6 # m", "a spacing in m");
    let symmetry = match raw.symmetry {
        None | Some(RawFilmSymmetry::Plane) => FilmSymmetry::Plane,
        Some(RawFilmSymmetry::Axis) => FilmSymmetry::Axis,
    };
    let droplets = droplets(checker, raw.droplets.as_deref().unwrap_or_default(), symmetry);
    let equation = equation(checker, &raw.equation.clone().unwrap_or_default());
    let contact_angle = wetting(checker, &raw.wetting.clone().unwrap_or_default());
    let particles_can_be =
        symmetry == FilmSymmetry::Plane && equation.is_none_or(|e| matches!(e, FilmEquation::Geometric { .. }));
    let default = match contact_angle {
        Some(None) if particles_can_be => DefaultMethod::Particles,
        _ => DefaultMethod::FiniteDifferences,
    };
    let method = method(checker, &raw.method.clone().unwrap_or_default(), particles_can_be, default);
    if let (Some(equation), Some(Some(_))) = (equation, contact_angle) {
        partial_wetting(checker, equation, symmetry);
    }
    if let (Some(spacing), Some(equation), Some(droplets)) = (spacing, equation, &droplets) {
        resolution(checker, spacing, equation, droplets);
        match (equation, method) {
            (FilmEquation::Geometric { smoothing_length }, Some(FilmMethod::FiniteDifferences { .. })) => {
                rounding(checker, spacing, smoothing_length);
            }
            (FilmEquation::Geometric { smoothing_length }, Some(FilmMethod::Particles { .. })) => {
                particles(checker, spacing, smoothing_length);
            }
            _ => {}
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
    let film = ThinFilm {
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
    };
    thinness::steepness(checker, &film);
    thinness::rim(checker, &film);
    if let Some(geometry) = geometry {
        thinness::room(checker, &film, geometry);
    }
    Some(film)
}
