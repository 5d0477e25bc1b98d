//! The measures that each solver has in a case, with what gives them; the comment above a name is its meaning in docs/reference/measures.md. Groups that a
//! case can request are in `measure_groups`.

use super::case_file::Model;
use super::film::{FilmEquation, FilmMethod, ThinFilm};
use super::measure_groups::Offer;
use super::network::PoreNetwork;
use super::open::Drive;
use super::side::Side;
use super::sph::Sph;
use meniscus_core::input::nearest;
use meniscus_geometry::spec::GeometrySpec;

/// Offers: what gives the measures, whether the case has that, and the names of the measures.
macro_rules! offers {
    ($($given_by:expr, $is_given:expr => $($name:literal)+;)+) => {
        vec![$(Offer { names: &[$($name),+], given_by: String::from($given_by), is_given: $is_given }),+]
    };
}

/// All measures that the solver of a model has, including those that are absent in this case; `geometry` is missing if it was wrong, `is_steady` is whether the
/// case has `[time.steady]`.
pub fn offers(model: &Model, geometry: Option<&GeometrySpec>, is_steady: bool) -> Vec<Offer> {
    let has_shapes = geometry.is_none_or(|geometry| !geometry.shapes.is_empty());
    let all = match model {
        Model::Sph(sph) => vec![
            of_steady_run(is_steady),
            of_every_run(sph, has_shapes),
            of_two_phases(sph),
            of_open_sides(sph),
            of_forces_in_chip(sph),
            of_permeability(sph),
            sph.measure.offers(),
        ],
        Model::ThinFilm(film) => vec![of_steady_run(is_steady), of_film(film)],
        Model::Network(network) => {
            vec![of_network(network), of_quasi_static_network(network), of_network_in_time(network)]
        }
    };
    all.into_iter().flatten().collect()
}

/// Those of a run that can end when steady.
fn of_steady_run(is_steady: bool) -> Vec<Offer> {
    offers! {
        "[time.steady]", is_steady =>
            // With `[time.steady]`: time of the first [steady](output.md#steady-runs) record
            "steady-at-s";
    }
}

/// Those of every direct simulation.
fn of_every_run(sph: &Sph, has_shapes: bool) -> Vec<Offer> {
    let has_walls = has_shapes || sph.sides.each().contains(&Side::Wall);
    offers! {
        "every run", true =>
            // Root mean square of `V_0/V − 1` of the fluid particles
            "density-error"
            // Largest magnitude of `V_0/V − 1` of a fluid particle
            "largest-density-error"
            // Smallest distance of two fluid particles over `dx`; below 0.5 particles pair up
            "smallest-particle-distance-ratio";
        "a solid or a side that is a wall", has_walls =>
            // With a solid or a wall at a side: signed wall distance of the nearest fluid particle, negative inside the wall
            "smallest-wall-distance-m";
    }
}

/// Those of two phases and of their contact lines.
fn of_two_phases(sph: &Sph) -> Vec<Offer> {
    // A frozen interface has neither angle nor tension.
    let is_frozen = sph.measure.relative_permeability;
    let has_wetting = sph.wetting_model.is_some() && !is_frozen;
    let unless_frozen = |given_by| {
        if is_frozen { "an interface that moves, without [sph.measure.relative-permeability]" } else { given_by }
    };
    offers! {
        unless_frozen("two phases with a tension above 0"), sph.acting_tension() > 0.0 =>
            // Area of the wetting phase over that of both phases
            "saturation"
            // Larger relative area change of a phase, without the flow through open sides
            "area-drift"
            // Mean pressure of the non-wetting minus the wetting phase, away from the interface
            "capillary-pressure-Pa"
            // Length of the contour c = 0.5
            "interface-length-m"
            // Length of the wall under the wetting phase
            "wetted-length-m"
            // Number of connected parts of the wetting phase
            "wetting-blobs"
            // Number of particles where their phase is thinner than about three particles, over the number of particles of the smaller phase
            "below-resolution-share"
            // Number of connected parts of either phase with fewer than 20 particles, at the end
            "small-pieces"
            // Largest number of connected parts with fewer than 20 particles at any record
            "most-small-pieces";
        unless_frozen("a wetting model, such as [sph.wetting.young]"), has_wetting =>
            // With a wetting model: mean contact angle; at an edge, relative to the face below the wetting phase
            "contact-angle-deg"
            // With a wetting model: mean static angle at the contact lines
            "requested-angle-deg"
            // With a wetting model: slip length of walls near [contact lines](../numerics/walls.md#slip-near-contact-lines)
            "line-slip-length-m";
    }
}

/// Those of the flow through the sides.
fn of_open_sides(sph: &Sph) -> Vec<Offer> {
    let sides = sph.sides.each();
    let open = || sides.iter().zip(&sph.open).filter_map(|(side, open)| Some((*side, (*open)?)));
    let is_given = open().any(|(_, open)| !matches!(open.drive, Drive::Pressure(_)));
    let has_steps = open().any(|(_, open)| open.pressure_steps.is_some());
    let (is_open, has_depth) = (open().next().is_some(), sph.depth.is_some());
    let is_periodic = open().any(|(side, _)| side == Side::Periodic);
    let is_displaced = sph.tension > 0.0 && open().any(|(side, _)| side != Side::Periodic);
    offers! {
        "open sides or a given flow through periodic ones", is_open =>
            // Net inflow minus gain of mass, over the initial mass; the larger of both phases
            "balance-error"
            // Change of the total area minus net inflow, over the initial area
            "open-area-drift"
            // Mean net inflow through all sides where area enters; with a prescribed velocity or flow rate by the displacements in the buffers
            "inflow-m2-per-s";
        "two phases with a tension above 0, and open sides", is_displaced =>
            // Two phases: time at which 20 particles of the entering phase (that of the larger inflow) have left, in the middle between two records
            "breakthrough-time-s"
            // Two phases: saturation of the entering phase at that time
            "saturation-at-breakthrough";
        "a velocity or a flow-rate in [sph.sides.open]", is_given =>
            // Prescribed inflow, with a prescribed velocity or flow rate
            "asked-inflow-m2-per-s"
            // Inflow through the sides with a prescribed velocity or flow rate, by the displacements in the buffers, over the prescribed inflow
            "inflow-ratio";
        "a given flow through periodic sides", is_periodic =>
            // Periodic sides with a prescribed flow: largest relative error of the flow rate in a step
            "largest-flow-rate-error"
            // Periodic sides with a prescribed flow: final mean driving pressure gradient times the period
            "driving-pressure-drop-Pa";
        "pressure-steps in [sph.sides.open]", has_steps =>
            // With `pressure-steps`: middle between the last pressure difference at which the menisci rested and that at which 20 particles of the entering
            // phase had left, uncertain by half of their difference
            "burst-pressure-Pa";
        "open sides and geometry.depth", has_depth && is_open =>
            // With [`geometry.depth`](../tutorials/depth.md): `inflow-m2-per-s` times the depth
            "inflow-m3-per-s";
        "a velocity or a flow-rate in [sph.sides.open] and geometry.depth", has_depth && is_given =>
            // With [`geometry.depth`](../tutorials/depth.md): `asked-inflow-m2-per-s` times the depth
            "asked-inflow-m3-per-s";
    }
}

/// Those of a moving drop in a chip.
fn of_forces_in_chip(sph: &Sph) -> Vec<Offer> {
    let has_both = sph.depth.is_some() && sph.measure.moving_drop;
    offers! {
        "[sph.measure.moving-drop] and geometry.depth", has_both =>
            // With `geometry.depth`: retention times the depth
            "retention-N"
            "wall-retention-N"
            // With `geometry.depth`: drag times the depth, with the friction of floor and lid
            "stream-drag-N"
            "net-drag-N";
    }
}

/// The entries of the permeability tensor: a column for each axis with a force.
fn of_permeability(sph: &Sph) -> Vec<Offer> {
    let is_measured = |axis: usize| sph.measure.permeability && sph.gravity[axis] != 0.0;
    offers! {
        "[sph.measure.permeability] and an sph.gravity along x", is_measured(0) =>
            // Viscosity times the mean velocity along x and y, over the force per volume along x; bar: what is left to change
            "permeability-xx-m2"
            "permeability-yx-m2"
            // Rate of change of the momentum over the body force, at the end of the force along x
            "unsteady-share-x";
        "[sph.measure.permeability] and an sph.gravity along y", is_measured(1) =>
            // Viscosity times the mean velocity along x and y, over the force per volume along y; bar: what is left to change
            "permeability-xy-m2"
            "permeability-yy-m2"
            // Rate of change of the momentum over the body force, at the end of the force along y
            "unsteady-share-y";
    }
}

/// Those of every pore network.
fn of_network(network: &PoreNetwork) -> Vec<Offer> {
    offers! {
        "a network", true =>
            // Closed-form pore area over the area of the domain
            "porosity"
            // Number of maxima of the wall distance, joined by the persistence ratio
            "pores"
            // Number of saddles of the wall distance between pores, without openings
            "throats"
            // Width of the narrowest of these throats
            "narrowest-throat-m"
            // Width of the widest of these throats
            "widest-throat-m"
            // Permeability along x and y; needs open or periodic sides; 0 where nothing leads through; with a warning at solid fractions below 0.3
            "permeability-x-m2"
            "permeability-y-m2"
            // Smallest, median and largest entry pressure of all throats in drainage, at the receding angle
            "smallest-entry-pressure-Pa"
            "median-entry-pressure-Pa"
            "largest-entry-pressure-Pa"
            // Saturation of the invading phase when it first reaches the outlet
            "saturation-at-breakthrough"
            // Final saturation of the displaced phase where it has no path to the outlet; in drainage with what films keep that have none
            "trapped-saturation"
            // Final saturation of the wetting phase
            "final-wetting-saturation"
            // Number of events of all kinds and half cycles
            "events";
        "network.gravity", network.gravity.is_some() =>
            // With `network.gravity`: difference of the densities times gravity in the plane and the square of the mean distance between neighboring pores, over
            // the tension
            "bond-number";
    }
}

/// Those of a quasi-static displacement in a network.
fn of_quasi_static_network(network: &PoreNetwork) -> Vec<Offer> {
    offers! {
        "quasi-static displacement", !network.is_dynamic() =>
            // Permeability of the throats between regions of the phase, and of rings of films, over that of all throats, at the end of the last half cycle; of the
            // wetting phase in drainage without films 0 once the invading phase holds all openings of the inlet
            "relative-permeability-wetting"
            "relative-permeability-non-wetting"
            // With `network.measured`: number of throats whose measured entry pressure replaces the formula in the first half cycle
            "measured-entry-pressures"
            // Capillary pressure of the event by which the invading phase first reaches the outlet
            "breakthrough-pressure-Pa"
            // Final saturation of the displaced phase
            "residual-saturation"
            // Where corners hold films: `trapped-saturation` if they were connected in the other two ways of `films`
            "trapped-saturation-without-films"
            "trapped-saturation-with-rings"
            "trapped-saturation-with-joined-films"
            // With `films`: share of the pore space in films at the end, a part of the wetting saturation
            "film-saturation"
            // With `films`: number of throats that films closed
            "snap-offs"
            // Applied capillary pressure of largest magnitude in the first half cycle
            "largest-capillary-pressure-Pa"
            // Cycles: integral of the capillary pressure over the saturation that events displaced in the last drainage and imbibition
            "hysteresis-work-J-per-m3";
        "quasi-static displacement and network.gravity", !network.is_dynamic() && network.gravity.is_some() =>
            // With `network.gravity`: standard deviation along the flow of the menisci that can advance, at first breakthrough
            "front-width-m"
            // With `network.gravity`: share of the pore space in trapped ganglia that their own head would move, as it does not here
            "movable-trapped-saturation";
    }
}

/// Those of a displacement in time in a network.
fn of_network_in_time(network: &PoreNetwork) -> Vec<Offer> {
    offers! {
        "[network.dynamic]", network.is_dynamic() =>
            // Time at which the invading phase reaches the outlet
            "breakthrough-time-s"
            // Pressure at the inlet minus that at the outlet at breakthrough
            "breakthrough-pressure-difference-Pa"
            // Largest pressure at the inlet minus that at the outlet; at vanishing rate the capillary pressure of breakthrough
            "largest-pressure-difference-Pa"
            // Area that passed the inlet over that of the pores
            "injected-pore-volumes"
            // Viscosity of the invading phase times inflow, over side length and tension; mean over the records
            "capillary-number"
            // Viscosity of the invading over that of the displaced phase
            "viscosity-ratio"
            // Mean width of fingers on lines across the flow, solids included
            "finger-width-m"
            // Mean number of fingers on these lines
            "fingers-per-line"
            // Final length of the menisci
            "interface-length-m"
            // Area gained by the invading phase minus its net inflow, over the area that it holds
            "balance-error"
            // Number of linear solves over that of events
            "solves-per-event";
    }
}

/// Those of a thin film.
fn of_film(film: &ThinFilm) -> Vec<Offer> {
    let (has_angle, rests_as_cap) = (film.contact_angle.is_some(), film.rests_as_cap());
    let is_particles = matches!(film.method, FilmMethod::Particles(_));
    let is_known = has_angle && matches!(film.equation, FilmEquation::Geometric(_)) && film.droplets.len() == 1;
    offers! {
        "a thin film", true =>
            // Position of the contact line in m
            "contact-line-position"
            // Height at x = 0 in m
            "center-height"
            // Angle of the tangent at the steepest point
            "contact-angle-deg"
            // Number of maxima of the film above a twentieth of the highest
            "droplet-count"
            // Exponent in time of the position of the contact line, from 1/50 of the run on
            "contact-line-exponent";
        "[thin-film.method.particles]", is_particles =>
            // Particles: position of the last particle in m
            "last-particle-position"
            // Particles: exponent in time of the position of the last particle, from 1/50 of the run on
            "last-particle-exponent"
            // Particles with their lattice energy: slope imitated by the lattice over that of the film
            "lattice-slope-ratio";
        "[thin-film.wetting.partial]", has_angle =>
            // Partial wetting: slope at the steepest point over that at rest
            "contact-angle-ratio";
        "one partially wetting droplet on a precursor film without gravity", rests_as_cap =>
            // Partial wetting with a precursor film: slope at the wall of the parabola through the top, over that at rest
            "cap-angle-ratio";
        "one partially wetting droplet of the geometric equation", is_known =>
            // Partial wetting of one droplet, geometric equation: area between the profile and that at rest, over the area of the droplet
            "equilibrium-l1-error";
        "[thin-film.wetting.partial] where the droplet at rest is not a parabola", has_angle && !rests_as_cap =>
            // Partial wetting: fitted factor of `Ca ln(x/d)` in the cubed angle, over 9
            "cox-voinov-ratio"
            // Partial wetting: fitted length `d`
            "cox-voinov-length-m"
            // Partial wetting: root mean square misfit of the cubed angle, over that at rest
            "cox-voinov-error";
        "one completely wetting droplet about x = 0 in the plane without gravity", film.is_self_similar() =>
            // Complete wetting in the plane: fitted f''(0) of the self-similar shape
            "similarity-curvature"
            // Complete wetting in the plane: largest misfit of the self-similar shape over f(0)
            "similarity-error";
    }
}

/// The measures of a comparison of a direct simulation with a network.
pub fn offers_of_comparison() -> Vec<Offer> {
    offers! {
        "[compare] in a study", true =>
            // Area that both have invaded over the area that either has; mean over the records
            "mean-overlap"
            // Spearman's rank correlation of the order of invasion, over the elements that both filled
            "rank-correlation"
            // Number of elements that both filled
            "elements-in-both"
            // Largest capillary pressure until an element at the outlet is filled; in imbibition the smallest
            "network-breakthrough-pressure-Pa"
            "direct-breakthrough-pressure-Pa"
            // Saturation of the invading phase when an element at the outlet is filled
            "network-saturation-at-breakthrough"
            "direct-saturation-at-breakthrough"
            // With `[network.dynamic]`: time at which the invading phase reaches the outlet
            "network-breakthrough-time-s"
            "direct-breakthrough-time-s"
            // Permeability along x, where measured
            "network-permeability-m2"
            "direct-permeability-m2"
            // Number of pores of the network
            "network-pores"
            // Number of particles of the direct simulation
            "direct-particles"
            // Processor time
            "network-cpu-s"
            "direct-cpu-s";
    }
}

/// What is wrong with the name of a measure that the case does not have, and a remedy; `None` if the case has it.
pub fn unmeasured(name: &str, offers: &[Offer]) -> Option<(String, String)> {
    let with_name = || offers.iter().filter(|offer| offer.names.contains(&name));
    if with_name().any(|offer| offer.is_given) {
        return None;
    }
    let given_by: Vec<&str> = with_name().map(|offer| offer.given_by.as_str()).collect();
    if !given_by.is_empty() {
        let help = format!("it comes with {}", given_by.join(" or "));
        return Some((format!("`{name}` is not measured in this case"), help));
    }
    let known = || offers.iter().filter(|offer| offer.is_given).flat_map(|offer| offer.names.iter().copied());
    let list = known().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let meant = nearest(name, offers.iter().flat_map(|offer| offer.names.iter().copied()));
    let meant = meant.map_or(String::new(), |meant| format!("did you mean `{meant}`? "));
    Some((format!("unknown measure `{name}`"), format!("{meant}measured in this case: {list}")))
}
