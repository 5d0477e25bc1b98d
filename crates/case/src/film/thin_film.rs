//! `[thin-film]`: droplets on a flat wall. Its table, the checks of its parts together, and the table of a checked film.

use super::droplets::{FilmSymmetry, RawDroplet, domain, droplets};
use super::equation::{
    EQUATION, FilmEquation, Geometric, RawFilmEquation, RawFilmWetting, equation, partial_wetting, wetting,
};
use super::method::{DefaultMethod, FilmMethod, FilmParticles, LatticeEnergy, RawFilmMethod, method};
use super::model::{FilmWeights, SCALED, ThinFilm};
use super::resolution::{count, particles, resolution, rounding};
use super::thinness;
use crate::fluid::RawFluid;
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, tables};
use meniscus_geometry::spec::GeometrySpec;

tables! {
    /// Droplets that spread on the wall y = 0, by a thin-film equation (Pang and O Naraigh 2022).
    pub(crate) struct RawThinFilm {
        /// The liquid; its density is needed with gravity only.
        pub fluid: RawFluid,
        /// Surface tension in N/m (default: that of the preset).
        pub tension: f64 => Key::positive("a tension in N/m"),
        /// Gravity towards the wall in m/s², negative for hanging droplets; capillary length at least 2 spacings
        /// (default 0).
        pub gravity: f64,
        /// Initial distance of particles or nodes in m: at least 10 per half width, at most 1e7 on the wall.
        pub spacing: f64 => Key::positive("a spacing in m").example("spacing = 5.0e-6 # m"),
        /// Plane film, or axisymmetric about x = 0 (default `plane`).
        pub symmetry: FilmSymmetry,
        /// Initial droplets: parabolas without overlap.
        pub droplets: Vec<RawDroplet> => Key::required("[[thin-film.droplets]] with half-width and height in m"),
        /// Exactly one equation.
        pub equation: RawFilmEquation => Key::required(EQUATION),
        /// At most one wetting model (default `complete`).
        pub wetting: RawFilmWetting,
        /// At most one method (default `particles` for the geometric equation in complete wetting in the plane, else
        /// `finite-differences`).
        pub method: RawFilmMethod,
        /// Particles and nodes represent the film of their cell, or the height at their position (default `cell`).
        pub weights: FilmWeights,
    }
}

/// Properties of the liquid of a film, SI units.
pub(super) struct Liquid {
    pub viscosity: f64,
    pub tension: f64,
    pub density: f64,
    pub gravity: f64,
}

/// The liquid of a film: density and viscosity, tension and gravity.
pub(super) fn liquid(checker: &mut Checker, raw: &RawThinFilm) -> Option<Liquid> {
    let gravity = raw.gravity.unwrap_or(0.0);
    let Some(fluid) = &raw.fluid else {
        if raw.tension.is_some() {
            let help =
                "add [thin-film.fluid] with preset = \"water\" or viscosity in Pa s; leave out both for scaled units";
            checker.refuse("thin-film.tension", "a tension is given without a fluid", help);
            return None;
        }
        let (viscosity, tension, density) = SCALED;
        return Some(Liquid { viscosity, tension, density, gravity });
    };
    let preset = fluid.properties(checker, "thin-film.fluid");
    if fluid.preset.is_some() && preset.is_none() {
        return None;
    }
    let tension = raw.tension.or(preset.and_then(|preset| preset.tension));
    let viscosity = fluid.viscosity.or(preset.map(|preset| preset.viscosity));
    let density = fluid.density.or(preset.map(|preset| preset.density)).or((gravity == 0.0).then_some(0.0));
    let viscosity = checker.require("thin-film.fluid.viscosity", viscosity, "viscosity = 1.0e-2 # Pa s");
    let tension = checker.require("thin-film.tension", tension, "tension = 0.03 # N/m");
    let density = checker.require("thin-film.fluid.density", density, "density = 998.2 # kg/m3");
    Some(Liquid { viscosity: viscosity?, tension: tension?, density: density?, gravity })
}

/// Checks `[thin-film]` and sets its defaults; `geometry` is missing if it was wrong.
pub(crate) fn thin_film(
    checker: &mut Checker,
    raw: &mut RawThinFilm,
    geometry: Option<&GeometrySpec>,
) -> Option<ThinFilm> {
    let liquid = liquid(checker, raw);
    let spacing = raw.spacing;
    let symmetry = *raw.symmetry.get_or_insert(FilmSymmetry::Plane);
    let droplets = droplets(checker, raw.droplets.as_deref().unwrap_or_default(), symmetry);
    let equation = equation(checker, raw.equation.get_or_insert_default());
    let contact_angle = wetting(checker, raw.wetting.get_or_insert_default());
    let particles_can_be =
        symmetry == FilmSymmetry::Plane && equation.is_none_or(|e| matches!(e, FilmEquation::Geometric(_)));
    let default = match contact_angle {
        Some(None) if particles_can_be => DefaultMethod::Particles,
        _ => DefaultMethod::FiniteDifferences,
    };
    let method = method(checker, raw.method.get_or_insert_default(), particles_can_be, default);
    if let (Some(equation), Some(Some(_))) = (equation, contact_angle) {
        partial_wetting(checker, equation, symmetry);
    }
    if let (Some(spacing), Some(equation), Some(droplets)) = (spacing, equation, &droplets) {
        resolution(checker, spacing, equation, droplets);
        match (equation, method) {
            (FilmEquation::Geometric(Geometric { smoothing_length }), Some(FilmMethod::FiniteDifferences(_))) => {
                rounding(checker, spacing, smoothing_length);
            }
            (FilmEquation::Geometric(Geometric { smoothing_length }), Some(FilmMethod::Particles(_))) => {
                particles(checker, spacing, smoothing_length);
            }
            _ => {}
        }
    }
    if let (
        Some(FilmMethod::Particles(FilmParticles { lattice_energy: LatticeEnergy::TakenOff, .. })),
        Some([_, _, ..]),
    ) = (method, droplets.as_deref())
    {
        checker.refuse(
            "thin-film.method.particles.lattice-energy",
            "the lattice energy can be subtracted for one droplet only, and there are several",
            "where droplets merge, their lattices do not match; take a smaller spacing, or finite differences",
        );
    }
    if let Some(geometry) = geometry {
        domain(checker, geometry, droplets.as_deref().unwrap_or_default(), symmetry);
        if let Some(spacing) = spacing {
            count(checker, geometry, spacing);
        }
    }
    let Liquid { viscosity, tension, density, gravity } = liquid?;
    let droplets = droplets?;
    raw.fluid = Some(RawFluid {
        density: (density > 0.0).then_some(density),
        viscosity: Some(viscosity),
        ..RawFluid::default()
    });
    (raw.tension, raw.gravity) = (Some(tension), Some(gravity));
    raw.droplets = Some(droplets.iter().copied().map(RawDroplet::from).collect());
    let film = ThinFilm {
        viscosity,
        tension,
        density,
        gravity,
        spacing: spacing?,
        symmetry,
        droplets,
        equation: equation?,
        contact_angle: contact_angle?,
        method: method?,
        weights: *raw.weights.get_or_insert(FilmWeights::Cell),
    };
    thinness::steepness(checker, &film);
    thinness::rim(checker, &film);
    if let Some(geometry) = geometry {
        thinness::room(checker, &film, geometry);
    }
    Some(film)
}
