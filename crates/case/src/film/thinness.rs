//! Validity of the thin-film approximation: slopes, gravity, room for the droplets at rest, and how long the film is at rest.
//!
//! The pressure of a thin film approximates the curvature by the second derivative of the height. At a contact angle θ that is 1/cos θ times that of the arc
//! with this angle: 4 % too much at a slope tan θ of 0.3, 12 % at 0.5, 41 % at 1. Without a fluid a case is in scaled units, whose slopes are not angles.

use super::bounds::{exceeds, falls_short, is_outside};
use super::droplets::{FilmDroplet, FilmSymmetry};
use super::equation::FilmEquation;
use super::model::ThinFilm;
use meniscus_core::input::Checker;
use meniscus_geometry::spec::GeometrySpec;

/// Slope at rest up to which a film counts as thin: its pressure is accurate within 12 %.
const THIN: f64 = 0.5;
/// Steepest initial droplet, height relative to half width: the slope at its edge is twice that.
const STEEPEST: f64 = 5.0;
/// Height relative to half width of any droplet, scaled or not: outside of this range the equations suffer from rounding.
const RATIOS: (f64, f64) = (1e-6, 1e3);
/// Fewest spacings in the capillary length, which is the width of the rim of a puddle.
const FEWEST_IN_RIM: f64 = 2.0;
/// Duration of the motion of a film in units of its time scale; it is at rest long before that.
const MOVES: f64 = 1000.0;
/// A film that runs for a smaller fraction of the same time is still far from its contact angle at the end.
const FAR_FROM_REST: f64 = 0.01;
/// Ratio of the initial half width to that at rest up to which a geometric film leaves less than 0.2 % of its area behind; 3 % at 1.9.
const RECEDES: f64 = 1.3;
/// A typical end in the same units.
const USUAL_END: f64 = 100.0;

/// Refuses droplets that are too steep for a film.
pub(super) fn steepness(checker: &mut Checker, film: &ThinFilm) {
    let (least, most) = (RATIOS.0, if film.is_scaled() { RATIOS.1 } else { STEEPEST });
    for (index, droplet) in film.droplets.iter().enumerate() {
        let ratio = droplet.height / droplet.half_width;
        if is_outside(ratio, (least, most)) {
            checker.refuse(
                format!("thin-film.droplets[{index}].height"),
                format!(
                    "expected a height of {least:e} to {most:?} half widths of {:e} m, found {:e} m",
                    droplet.half_width, droplet.height
                ),
                "a film is thin where its slope is below one half or so; use [sph] for steeper droplets",
            );
        }
    }
}

/// Refuses gravity that makes a rim narrower than the spacing.
pub(super) fn rim(checker: &mut Checker, film: &ThinFilm) {
    let weight = film.density * film.gravity.abs();
    let rim = (film.tension / weight).sqrt();
    if falls_short(rim, FEWEST_IN_RIM * film.spacing) {
        checker.refuse(
            "thin-film.gravity",
            format!(
                "gravity of {:e} m/s2 gives a capillary length of {rim:.2e} m, expected at least {FEWEST_IN_RIM} spacings of {:e} m",
                film.gravity, film.spacing
            ),
            "the rim of a puddle is a capillary length wide: lower gravity, which is in m/s2, or the spacing",
        );
    }
}

/// Refuses a domain in which the droplets have no room at rest.
pub(super) fn room(checker: &mut Checker, film: &ThinFilm, geometry: &GeometrySpec) {
    let Some(angle) = film.contact_angle else { return };
    let [left, right] = [geometry.min[0], geometry.max[0]];
    let reach = |droplet: &FilmDroplet| match film.symmetry {
        FilmSymmetry::Plane => (droplet.cross_section() / angle.tan()).sqrt(),
        // The paraboloid of the same volume with this slope at its edge.
        FilmSymmetry::Axis => (2.0 * droplet.height * droplet.half_width.powi(2) / angle.tan()).cbrt(),
    };
    for droplet in &film.droplets {
        let reach = reach(droplet);
        let over_left = film.symmetry == FilmSymmetry::Plane && exceeds(reach, droplet.center - left);
        if over_left || exceeds(reach, right - droplet.center) {
            checker.refuse(
                "thin-film.wetting.partial.contact-angle-deg",
                format!(
                    "at rest at {:.3} degrees the droplet at {:e} m extends {reach:.2e} m to each side, beyond the domain from {left:e} to {right:e} m",
                    angle.to_degrees(),
                    droplet.center
                ),
                "take a wider domain, a smaller droplet or a larger angle",
            );
        }
    }
}

impl ThinFilm {
    /// Notes for the user on a run of the film to `end` (s), one sentence each.
    pub fn notes(&self, end: f64) -> Vec<String> {
        let mut notes = Vec::new();
        let slope = self.contact_angle.map_or(0.0, f64::tan);
        if exceeds(slope, THIN) && !self.is_scaled() {
            let excess = 100.0 * (slope.hypot(1.0) - 1.0);
            notes.push(format!(
                "a slope of {slope:.2} at rest is not thin, expected at most {THIN}: the pressure of the film is {excess:.0} % above that of the drop; use [sph]"
            ));
        }
        let [_, _, time] = self.scales();
        if self.contact_angle.is_some() && exceeds(end, MOVES * time) {
            notes.push(format!(
                "the end is {:.0} times the {time:.1e} s in which this film moves, expected at most {MOVES:.0}: it is at rest long before that; \
                 end = {:.1e} would do",
                end / time,
                USUAL_END * time
            ));
        }
        if self.contact_angle.is_some() && falls_short(end, FAR_FROM_REST * time) {
            notes.push(format!(
                "the end is {:.1e} of the {time:.1e} s in which this film comes to its contact angle, expected at least {FAR_FROM_REST}: it \
                 still moves at the end, and angles and shapes are not those at rest; a larger angle or a later end would do",
                end / time
            ));
        }
        notes.extend(self.lattice_note());
        notes.extend(self.receding_note());
        notes
    }

    /// The note that the geometric equation leaves a film behind a contact line that recedes far.
    fn receding_note(&self) -> Option<String> {
        let (FilmEquation::Geometric(_), Some(angle)) = (self.equation, self.contact_angle) else { return None };
        let half_width_at_rest = |droplet: &FilmDroplet| (droplet.cross_section() / angle.tan()).sqrt();
        let widest =
            self.droplets.iter().map(|droplet| droplet.half_width / half_width_at_rest(droplet)).fold(0.0, f64::max);
        (widest > RECEDES).then(|| {
            format!(
                "a droplet begins {widest:.2} times as wide as it rests, expected at most {RECEDES}: a geometric film leaves liquid behind a \
                 contact line that recedes, and its contact line at rest is percents short; [thin-film.equation.precursor] leaves none"
            )
        })
    }
}
