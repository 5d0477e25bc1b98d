//! What a reader must know before trusting the measures of a thin film: what its particles, its domain or its equation do to them.

use super::solver::ThinFilmSolver;

/// Slope of the particle lattice over that of the film from which the contact line of a spreading droplet is a percent short.
const VISIBLE: f64 = 0.5;
/// Scaled time after which a partially wetting film has come to rest.
const AT_REST: f64 = 20.0;
/// Distance from the droplet at rest over its area from which a film at rest is not that droplet.
const OFF: f64 = 0.02;

/// All warnings of a film.
pub(crate) fn all(solver: &ThinFilmSolver) -> Vec<String> {
    [covered(solver), apart(solver), lattice(solver), off(solver)].into_iter().flatten().collect()
}

/// A film over the whole domain has no contact line.
fn covered(solver: &ThinFilmSolver) -> Option<String> {
    let [left, right] = solver.surroundings().wall;
    solver.foot().is_none().then(|| {
        format!(
            "the film has no contact line within the domain from {left:e} to {right:e} m: it covers the wall; a wider domain or an earlier end \
             would do"
        )
    })
}

/// A film without attraction to itself joins droplets, and makes none.
fn apart(solver: &ThinFilmSolver) -> Option<String> {
    // A film that covers the wall is flat but for rounding.
    solver.foot()?;
    let (most, found) = (solver.surroundings().most_droplets?, solver.profile().peaks());
    (found > most).then(|| {
        format!(
            "the film has {found} maxima, expected at most {most}: it comes apart by its resolution; a smaller spacing, finite differences or a \
             wider domain would do"
        )
    })
}

/// Particles hold the contact line back, in partial wetting by an angle that is known before the run.
fn lattice(solver: &ThinFilmSolver) -> Option<String> {
    let slope = solver.film().lattice_slope()?;
    if solver.surroundings().takes_lattice_off {
        return Some(
            "the lattice energy was no longer taken off once a gap between particles exceeded half of the smoothing length; a smaller \
             spacing would do"
                .to_owned(),
        );
    }
    let share = slope / solver.foot()?.slope;
    (solver.surroundings().rest.is_none() && share > VISIBLE).then(|| {
        format!(
            "the lattice of particles imitates a slope of {share:.2} of that of the film, expected at most {VISIBLE}: the contact line is held \
             back by percents; a smaller spacing, lattice-energy = \"taken-off\" or finite differences would do"
        )
    })
}

/// A film that no longer moves and is not the droplet at rest.
fn off(solver: &ThinFilmSolver) -> Option<String> {
    let droplet = solver.surroundings().equilibrium.filter(|_| solver.film().time() > AT_REST)?;
    let distance = solver.profile().distance_to(|x| droplet.height(x - solver.surroundings().right)) / droplet.area;
    (distance > OFF).then(|| {
        format!(
            "the film rests {:.1} % of its area away from the droplet at rest, expected at most {:.0} %: contact line and angle are off by as much",
            100.0 * distance,
            100.0 * OFF
        )
    })
}
