//! The measures that each solver has in a case; their names are in `measure_names`, groups that a case can request in `measure_groups`.

use super::case_file::Model;
use super::film::{FilmEquation, FilmMethod, ThinFilm};
use super::measure_groups::Offer;
use super::measure_names::*;
use super::open::Drive;
use super::side::Side;
use super::sph::Sph;
use crate::geometry::spec::GeometrySpec;
use crate::input::nearest;

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
