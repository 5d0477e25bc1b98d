//! Final results of a thin film: contact line, spreading, deviation from equilibrium and from known laws.

use super::history::{COX_VOINOV, Record, WINDOW};
use super::observed::ObservedFilm;
use super::similarity::{COVERED, fit};
use meniscus_core::solver::{Measure, measure};

/// Initial fraction of the run excluded from exponents, where the droplet still depends on its initial shape.
const FORGETTING: f64 = 1.0 / 50.0;
/// Above this fraction of the film's slope, the particle lattice visibly retards the contact line.
const VISIBLE: f64 = 0.1;

/// All measures of a film.
pub(crate) fn all(observed: &ObservedFilm) -> Vec<Measure> {
    let mut found = contact_line(observed);
    found.extend(rest(observed));
    found.extend(laws(observed));
    found.extend(lattice(observed));
    found
}

fn contact_line(observed: &ObservedFilm) -> Vec<Measure> {
    let (scales, film) = (observed.surroundings.scales, &observed.film);
    let line = observed.contact_line();
    let position = line.map_or(f64::NAN, |line| line.position * scales.length);
    let angle = line.map_or(f64::NAN, |line| (line.slope * scales.slope()).atan().to_degrees());
    let mut found = vec![
        measure("contact-line-position", position, "m")
            .by("where the tangent at the steepest point on the right meets the wall"),
        measure("center-height", film.center_height() * scales.height, "m").by("height at x = 0"),
        measure("contact-angle-deg", angle, "deg").by("angle of the tangent at the steepest point on the right"),
    ];
    let droplets = observed.profile().peaks();
    found.push(measure("droplet-count", droplets as f64, "").by("maxima of the film above a twentieth of the highest"));
    let (value, method) = spreading(observed, |record| Some(record.position));
    found.push(measure("contact-line-exponent", value, "").by(&method));
    if let Some(last) = film.last_particle() {
        found.push(measure("last-particle-position", last * scales.length, "m").by("position of the last particle"));
        let (value, method) = spreading(observed, |record| record.last);
        found.push(measure("last-particle-exponent", value, "").by(&method));
    }
    found
}

/// Deviation of a partially wetting film from equilibrium.
fn rest(observed: &ObservedFilm) -> Vec<Measure> {
    let surroundings = &observed.surroundings;
    let mut found = Vec::new();
    if let Some(rest) = surroundings.rest {
        let slope = observed.contact_line().map_or(f64::NAN, |line| line.slope / rest);
        found.push(measure("contact-angle-ratio", slope, "").by("slope at the steepest point over the slope at rest"));
    }
    if let Some(sides) = surroundings.cap_sides {
        let profile = observed.profile();
        let top = (0..profile.x.len()).max_by(|&i, &j| profile.height[i].total_cmp(&profile.height[j]));
        let cap = top.map_or(f64::NAN, |i| (-2.0 * profile.height[i] * profile.curvature[i] / sides).sqrt());
        let method = "slope at the wall of the parabola through the top of the droplet, over the slope at rest";
        found.push(measure("cap-angle-ratio", cap, "").by(method));
    }
    if let Some(droplet) = surroundings.equilibrium {
        let distance = observed.profile().distance_to(|x| droplet.height(x - surroundings.right));
        found.push(
            measure("equilibrium-l1-error", distance / droplet.area, "")
                .by("area between the profile and that of the droplet at rest, over the area of the droplet"),
        );
    }
    found
}

/// Fits of known laws, where applicable.
fn laws(observed: &ObservedFilm) -> Vec<Measure> {
    let surroundings = &observed.surroundings;
    let scales = surroundings.scales;
    let mut found = Vec::new();
    if surroundings.cap_sides.is_none()
        && let Some((law, _)) = surroundings.rest.and_then(|rest| observed.history.cox_voinov(rest))
    {
        let [from, to] = [WINDOW.0, WINDOW.1].map(|time| time * scales.time);
        let method = |what: &str| {
            format!(
                "{what}; law of Cox and Voinov by least squares in its two constants, from {from:.3e} to {to:.3e} s"
            )
        };
        let ratio = law.factor / COX_VOINOV;
        found.push(measure("cox-voinov-ratio", ratio, "").by(method("factor of Ca ln(x/d) over 9")));
        found.push(measure("cox-voinov-length-m", law.length * scales.length, "m").by(method("d")));
        found.push(
            measure("cox-voinov-error", law.error, "").by(method("rms misfit of the cubed angle over that at rest")),
        );
    }
    let time = observed.film.time();
    if surroundings.is_self_similar
        && let Some(line) = observed.contact_line()
        && let Some(shape) = fit(&observed.profile(), time, line.position)
    {
        let method = format!("f''' = eta/(7 f^2) by shooting, fitted up to {COVERED} of the contact-line position");
        found.push(measure("similarity-curvature", shape.curvature, "").by(format!("f''(0): {method}")));
        found.push(measure("similarity-error", shape.error, "").by(format!("largest misfit over f(0): {method}")));
    }
    found
}

fn lattice(observed: &ObservedFilm) -> Option<Measure> {
    let share = observed.film.lattice_slope()? / observed.contact_line().map_or(f64::NAN, |line| line.slope);
    let method = if share > VISIBLE {
        "slope that the particle lattice acts like over that of the film; the contact line is held back: take a smaller \
         spacing, or lattice-energy = \"taken-off\""
    } else {
        "slope that the particle lattice acts like over that of the film"
    };
    Some(measure("lattice-slope-ratio", share, "").by(method))
}

/// The exponent of the growth of a length in time, and the method.
fn spreading(observed: &ObservedFilm, length: impl Fn(&Record) -> Option<f64>) -> (f64, String) {
    let start = FORGETTING * observed.film.time();
    let exponent = observed.history.exponent(start, length).unwrap_or(f64::NAN);
    let from = start * observed.surroundings.scales.time;
    (
        exponent,
        format!("least squares in the logarithms of time and position, from {from:.3e} to {:.3e} s", observed.time),
    )
}
