//! `[[thin-film.droplets]]`: the droplets of a thin film, and the wall below them.

use super::bounds::exceeds;
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, checked_tables, words};
use meniscus_geometry::spec::GeometrySpec;

words! {
    /// Symmetry of the film.
    pub enum FilmSymmetry {
        /// Uniform in the direction of depth.
        Plane,
        /// Axisymmetric about x = 0.
        Axis,
    }
}

checked_tables! {
    /// A droplet with a parabolic profile.
    pub struct RawDroplet for FilmDroplet {
        /// Center in m; 0 about an axis (default 0).
        pub center: f64,
        /// Half of the initial base width in m.
        pub half_width: f64 => Key::positive("a length in m").example("half-width = 5.0e-4 # m"),
        /// Initial central height in m: 1e-6 to 5 half widths, in scaled units to 1000.
        pub height: f64 => Key::positive("a length in m").example("height = 4.0e-5 # m"),
    }
}

impl FilmDroplet {
    /// Area in m².
    pub fn cross_section(&self) -> f64 {
        4.0 / 3.0 * self.half_width * self.height
    }
}

/// The droplets from left to right, `None` if one is wrong.
pub(super) fn droplets(checker: &mut Checker, raw: &[RawDroplet], symmetry: FilmSymmetry) -> Option<Vec<FilmDroplet>> {
    if raw.is_empty() {
        checker.require::<()>("thin-film.droplets", None, "[[thin-film.droplets]] with half-width and height in m");
        return None;
    }
    for (index, center) in raw.iter().enumerate().filter_map(|(index, raw)| Some((index, raw.center?))) {
        if symmetry == FilmSymmetry::Axis && center != 0.0 {
            checker.refuse(
                format!("thin-film.droplets[{index}].center"),
                format!("an axisymmetric droplet is centered at x = 0, found {center:e} m"),
                "leave it out, or set symmetry = \"plane\"",
            );
        }
    }
    let one = |raw: &RawDroplet| RawDroplet { center: raw.center.or(Some(0.0)), ..raw.clone() }.complete();
    let mut found: Vec<FilmDroplet> = raw.iter().map(one).collect::<Option<_>>()?;
    found.sort_by(|a, b| a.center.total_cmp(&b.center));
    for pair in found.windows(2) {
        if exceeds(pair[0].half_width + pair[1].half_width, pair[1].center - pair[0].center) {
            checker.refuse(
                "thin-film.droplets",
                format!("the droplets at {:e} and {:e} m overlap", pair[0].center, pair[1].center),
                "move them apart, or merge them into one",
            );
        }
    }
    Some(found)
}

/// The domain is the wall from its left to its right side; the droplets lie on it.
pub(super) fn domain(checker: &mut Checker, geometry: &GeometrySpec, droplets: &[FilmDroplet], symmetry: FilmSymmetry) {
    if !geometry.shapes.is_empty() {
        checker.refuse(
            "geometry",
            "expected a flat wall at y = 0 without solids, found shapes",
            "leave out the shapes; `min` and `max` delimit the wall",
        );
    }
    let [left, right] = [geometry.min[0], geometry.max[0]];
    if symmetry == FilmSymmetry::Axis && left != 0.0 {
        checker.refuse(
            "geometry.min",
            format!("an axisymmetric film starts at x = 0, found {left:e} m"),
            "set the first number to 0.0, or symmetry = \"plane\"",
        );
    }
    for (index, droplet) in droplets.iter().enumerate() {
        let begins = droplet.center - droplet.half_width;
        let over_left = symmetry == FilmSymmetry::Plane && begins <= left;
        if over_left || droplet.center + droplet.half_width >= right {
            checker.refuse(
                format!("thin-film.droplets[{index}].half-width"),
                format!("the droplet at {:e} m exceeds the domain, from {left:e} to {right:e} m", droplet.center),
                "take a wider domain",
            );
        }
    }
}
