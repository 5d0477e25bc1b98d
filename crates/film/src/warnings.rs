//! Limitations on the measures of a thin film due to its particles, its domain or its equation.

use super::observed::ObservedFilm;

/// Slope of the particle lattice over that of the film above which the contact line of a spreading droplet lags by one percent.
const VISIBLE: f64 = 0.5;
/// Scaled time after which a partially wetting film has reached equilibrium.
const AT_REST: f64 = 20.0;
/// Distance from the equilibrium droplet over its area above which a film at rest differs from it.
const OFF: f64 = 0.02;

/// All warnings of a film.
pub(crate) fn all(observed: &ObservedFilm) -> Vec<String> {
    [covered(observed), apart(observed), lattice(observed), off(observed)].into_iter().flatten().collect()
}

/// A film over the whole domain has no contact line.
fn covered(observed: &ObservedFilm) -> Option<String> {
    let [left, right] = observed.surroundings.wall;
    observed.contact_line().is_none().then(|| {
        format!(
            "the film has no contact line within the domain from {left:e} to {right:e} m: it covers the wall; a wider domain or an earlier end \
             would do"
        )
    })
}

/// A film without disjoining pressure lets droplets coalesce, but does not break up.
fn apart(observed: &ObservedFilm) -> Option<String> {
    // A film that covers the wall is flat except for rounding.
    observed.contact_line()?;
    let (most, found) = (observed.surroundings.most_droplets?, observed.profile().peaks());
    (found > most).then(|| {
        format!(
            "the film has {found} maxima, expected at most {most}: it breaks up for lack of resolution; a smaller spacing, finite differences or a \
             wider domain would do"
        )
    })
}

/// Particles retard the contact line, in partial wetting by an angle that is known before the run.
fn lattice(observed: &ObservedFilm) -> Option<String> {
    let slope = observed.film.lattice_slope()?;
    if observed.surroundings.takes_lattice_off {
        return Some(
            "the lattice energy was no longer subtracted once a gap between particles exceeded half of the smoothing length; a smaller \
             spacing would do"
                .to_owned(),
        );
    }
    let share = slope / observed.contact_line()?.slope;
    (observed.surroundings.rest.is_none() && share > VISIBLE).then(|| {
        format!(
            "the lattice of particles acts like a slope of {share:.2} of that of the film, expected at most {VISIBLE}: the contact line is held \
             back by percents; a smaller spacing, lattice-energy = \"taken-off\" or finite differences would do"
        )
    })
}

/// A film at rest that differs from the equilibrium droplet.
fn off(observed: &ObservedFilm) -> Option<String> {
    let droplet = observed.surroundings.equilibrium.filter(|_| observed.film.time() > AT_REST)?;
    let distance = observed.profile().distance_to(|x| droplet.height(x - observed.surroundings.right)) / droplet.area;
    (distance > OFF).then(|| {
        format!(
            "the film at rest differs from the equilibrium droplet by {:.1} % of its area, expected at most {:.0} %: contact line and angle are off by as much",
            100.0 * distance,
            100.0 * OFF
        )
    })
}
