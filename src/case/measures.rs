//! The measures of each solver by name; the groups that a case can request are in `measure_groups`.

use super::case_file::Model;
use super::film::{FilmEquation, FilmMethod, ThinFilm};
use super::measure_groups::Offer;
use super::open::Drive;
use super::side::Side;
use super::sph::Sph;
use crate::geometry::spec::GeometrySpec;
use crate::input::nearest;

/// Measures of every direct simulation.
const EVERY_RUN: &[&str] = &["density-error", "largest-density-error", "smallest-particle-distance-ratio"];
/// With a wall.
const WITH_WALLS: &[&str] = &["smallest-wall-distance-m"];
/// With a tension.
const WITH_TENSION: &[&str] = &[
    "saturation",
    "area-drift",
    "capillary-pressure-Pa",
    "interface-length-m",
    "wetted-length-m",
    "wetting-blobs",
    "below-resolution-share",
    "small-pieces",
    "most-small-pieces",
];
/// With a wetting model.
const WITH_WETTING: &[&str] = &["contact-angle-deg", "requested-angle-deg", "line-slip-length-m"];
/// With open sides, or with a prescribed flow through periodic ones.
const OPEN_SIDES: &[&str] = &["balance-error", "open-area-drift", "inflow-m2-per-s"];
/// Of two phases between open sides.
const BREAKTHROUGH: &[&str] = &["breakthrough-time-s", "saturation-at-breakthrough"];
/// With a prescribed velocity or flow rate, at an inlet or through periodic sides.
const GIVEN_FLOW: &[&str] = &["asked-inflow-m2-per-s", "inflow-ratio"];
/// Of a chip with a depth between open sides.
const INFLOW_OF_CHIP: &[&str] = &["inflow-m3-per-s"];
/// Of a chip with a depth and a prescribed velocity or flow rate.
const GIVEN_FLOW_OF_CHIP: &[&str] = &["asked-inflow-m3-per-s"];
/// Of a moving drop in a chip with a depth.
const FORCES_OF_CHIP: &[&str] = &["retention-N", "wall-retention-N", "stream-drag-N", "net-drag-N"];
/// With a prescribed flow through periodic sides.
const PERIODIC_FLOW: &[&str] = &["largest-flow-rate-error", "driving-pressure-drop-Pa"];
/// With a pressure that rises in steps.
const PRESSURE_STEPS: &[&str] = &["burst-pressure-Pa"];
/// Of the permeability tensor by the force along x.
const PERMEABILITY_X: &[&str] = &["permeability-xx-m2", "permeability-yx-m2", "unsteady-share-x"];
/// The same along y.
const PERMEABILITY_Y: &[&str] = &["permeability-xy-m2", "permeability-yy-m2", "unsteady-share-y"];
/// Of every pore network.
const NETWORK: &[&str] = &[
    "porosity",
    "pores",
    "throats",
    "narrowest-throat-m",
    "widest-throat-m",
    "permeability-x-m2",
    "permeability-y-m2",
    "smallest-entry-pressure-Pa",
    "median-entry-pressure-Pa",
    "largest-entry-pressure-Pa",
    "saturation-at-breakthrough",
    "trapped-saturation",
    "final-wetting-saturation",
    "events",
];
/// Of a quasi-static one.
const NETWORK_QUASI_STATIC: &[&str] = &[
    "relative-permeability-wetting",
    "relative-permeability-non-wetting",
    "measured-entry-pressures",
    "breakthrough-pressure-Pa",
    "residual-saturation",
    "film-saturation",
    "snap-offs",
    "largest-capillary-pressure-Pa",
    "hysteresis-work-J-per-m3",
];
/// Of a displacement in time.
const NETWORK_IN_TIME: &[&str] = &[
    "breakthrough-time-s",
    "breakthrough-pressure-difference-Pa",
    "largest-pressure-difference-Pa",
    "injected-pore-volumes",
    "capillary-number",
    "viscosity-ratio",
    "finger-width-m",
    "fingers-per-line",
    "interface-length-m",
    "balance-error",
    "solves-per-event",
];
/// Of every thin film.
const THIN_FILM: &[&str] =
    &["contact-line-position", "center-height", "contact-angle-deg", "droplet-count", "contact-line-exponent"];
/// Of a film of particles.
const FILM_PARTICLES: &[&str] = &["last-particle-position", "last-particle-exponent", "lattice-slope-ratio"];
/// Of a film with a contact angle at rest.
const FILM_ANGLE: &[&str] = &["contact-angle-ratio"];
/// Of a droplet whose shape at rest is a parabola.
const FILM_CAP: &[&str] = &["cap-angle-ratio"];
/// Of a droplet whose shape at rest is known.
const FILM_REST: &[&str] = &["equilibrium-l1-error"];
/// Of a film with a contact angle at rest that is not a parabola.
const FILM_COX_VOINOV: &[&str] = &["cox-voinov-ratio", "cox-voinov-length-m", "cox-voinov-error"];
/// Of a droplet that spreads by the similarity solution.
const FILM_SIMILARITY: &[&str] = &["similarity-curvature", "similarity-error"];
/// Of a run that can end when steady.
const STEADY: &[&str] = &["steady-at-s"];

/// Of a comparison of a direct simulation with a network.
const COMPARISON: &[&str] = &[
    "mean-overlap",
    "rank-correlation",
    "elements-in-both",
    "network-breakthrough-pressure-Pa",
    "direct-breakthrough-pressure-Pa",
    "network-saturation-at-breakthrough",
    "direct-saturation-at-breakthrough",
    "network-breakthrough-time-s",
    "direct-breakthrough-time-s",
    "network-permeability-m2",
    "direct-permeability-m2",
    "network-pores",
    "direct-particles",
    "network-cpu-s",
    "direct-cpu-s",
];

/// All measures that the solver of a model has, including those that are absent in this case; `geometry` is missing if it was wrong, `is_steady` is whether the
/// case has `[time.steady]`.
pub fn offers(model: &Model, geometry: Option<&GeometrySpec>, is_steady: bool) -> Vec<Offer> {
    let steady = Offer::new(STEADY, "[time.steady]", is_steady);
    match model {
        Model::Sph(sph) => {
            let has_shapes = geometry.is_none_or(|geometry| !geometry.shapes.is_empty());
            let of_flow = of_flow(sph, has_shapes).into_iter().chain(of_open_sides(sph)).chain(of_permeability(sph));
            std::iter::once(steady).chain(of_flow).chain(sph.measure.offers()).collect()
        }
        Model::ThinFilm(film) => std::iter::once(steady).chain(of_film(film)).collect(),
        Model::Network(network) => vec![
            Offer::new(NETWORK, "a network", true),
            Offer::new(NETWORK_QUASI_STATIC, "quasi-static displacement", !network.is_dynamic()),
            Offer::new(NETWORK_IN_TIME, "[network.dynamic]", network.is_dynamic()),
        ],
    }
}

/// The measures of a comparison of a direct simulation with a network.
pub fn offer_of_comparison() -> Offer {
    Offer::new(COMPARISON, "[compare] in a study", true)
}

/// The measures of every direct simulation and those of its walls, tension and wetting.
fn of_flow(sph: &Sph, has_shapes: bool) -> [Offer; 4] {
    let sides = sph.sides.each();
    let has_walls = has_shapes || sides.contains(&Side::Wall);
    // A frozen interface has neither angle nor tension.
    let is_frozen = sph.measure.relative_permeability;
    let (has_tension, has_wetting) = (sph.acting_tension() > 0.0, sph.wetting_model.is_some() && !is_frozen);
    let unless_frozen = |given_by| {
        if is_frozen { "an interface that moves, without [sph.measure.relative-permeability]" } else { given_by }
    };
    [
        Offer::new(EVERY_RUN, "every run", true),
        Offer::new(WITH_WALLS, "a solid or a side that is a wall", has_walls),
        Offer::new(WITH_TENSION, unless_frozen("two phases with a tension above 0"), has_tension),
        Offer::new(WITH_WETTING, unless_frozen("a wetting model, such as [sph.wetting.young]"), has_wetting),
    ]
}

/// The measures of the flow through the sides.
fn of_open_sides(sph: &Sph) -> [Offer; 8] {
    let sides = sph.sides.each();
    let open = || sides.iter().zip(&sph.open).filter_map(|(side, open)| Some((*side, (*open)?)));
    let is_given = open().any(|(_, open)| !matches!(open.drive, Drive::Pressure(_)));
    let has_steps = open().any(|(_, open)| open.pressure_steps.is_some());
    let is_periodic = open().any(|(side, _)| side == Side::Periodic);
    let has_depth = sph.depth.is_some();
    let is_displaced = sph.tension > 0.0 && open().any(|(side, _)| side != Side::Periodic);
    [
        Offer::new(OPEN_SIDES, "open sides or a given flow through periodic ones", open().next().is_some()),
        Offer::new(BREAKTHROUGH, "two phases with a tension above 0, and open sides", is_displaced),
        Offer::new(GIVEN_FLOW, "a velocity or a flow-rate in [sph.sides.open]", is_given),
        Offer::new(PERIODIC_FLOW, "a given flow through periodic sides", is_periodic),
        Offer::new(PRESSURE_STEPS, "pressure-steps in [sph.sides.open]", has_steps),
        Offer::new(INFLOW_OF_CHIP, "open sides and geometry.depth", has_depth && open().next().is_some()),
        Offer::new(
            GIVEN_FLOW_OF_CHIP,
            "a velocity or a flow-rate in [sph.sides.open] and geometry.depth",
            has_depth && is_given,
        ),
        Offer::new(
            FORCES_OF_CHIP,
            "[sph.measure.moving-drop] and geometry.depth",
            has_depth && sph.measure.moving_drop,
        ),
    ]
}

/// The entries of the permeability tensor: a column for each axis with a force.
fn of_permeability(sph: &Sph) -> [Offer; 2] {
    let is_measured = |axis: usize| sph.measure.permeability && sph.gravity[axis] != 0.0;
    [
        Offer::new(PERMEABILITY_X, "[sph.measure.permeability] and an sph.gravity along x", is_measured(0)),
        Offer::new(PERMEABILITY_Y, "[sph.measure.permeability] and an sph.gravity along y", is_measured(1)),
    ]
}

/// The measures of a thin film.
fn of_film(film: &ThinFilm) -> [Offer; 7] {
    let has_angle = film.contact_angle.is_some();
    let is_particles = matches!(film.method, FilmMethod::Particles(_));
    let is_known = has_angle && matches!(film.equation, FilmEquation::Geometric(_)) && film.droplets.len() == 1;
    [
        Offer::new(THIN_FILM, "a thin film", true),
        Offer::new(FILM_PARTICLES, "[thin-film.method.particles]", is_particles),
        Offer::new(FILM_ANGLE, "[thin-film.wetting.partial]", has_angle),
        Offer::new(FILM_CAP, "one partially wetting droplet on a precursor film without gravity", film.rests_as_cap()),
        Offer::new(FILM_REST, "one partially wetting droplet of the geometric equation", is_known),
        Offer::new(
            FILM_COX_VOINOV,
            "[thin-film.wetting.partial] where the droplet at rest is not a parabola",
            has_angle && !film.rests_as_cap(),
        ),
        Offer::new(
            FILM_SIMILARITY,
            "one completely wetting droplet about x = 0 in the plane without gravity",
            film.is_self_similar(),
        ),
    ]
}

/// What is wrong with the name of a measure that the case does not have, and a remedy; `None` if the case has it.
pub(crate) fn unmeasured(name: &str, offers: &[Offer]) -> Option<(String, String)> {
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
