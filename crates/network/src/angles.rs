//! Contact angles of walls, floor and lid for an invading phase: receding if the non-wetting phase invades, advancing if the wetting phase does.

use std::f64::consts::PI;

use super::cycles::FluidPhase;
use super::film_flow::of_walls;
use super::films::FilmTerms;
use super::gravity::Gravity;
use meniscus_case::network::NetworkInterface;
use meniscus_case::{PatchedWall, SIDES, on_plates};
use meniscus_geometry::interface::depth::Depth;
use meniscus_geometry::interface::films::WallFilms;
use meniscus_wetting::Wetting;

/// Floor and lid with the angles for an invading phase: on them the wetting phase recedes or advances.
pub(super) fn depth_for(invading: FluidPhase, depth: f64, interface: &NetworkInterface) -> Depth {
    let (wall, plates) = on_depth(invading, interface);
    Depth::new(depth, wall, plates)
}

/// Contact angles in rad of walls, floor and lid through the wetting phase.
fn on_depth(invading: FluidPhase, interface: &NetworkInterface) -> (f64, [f64; 2]) {
    let end = usize::from(invading == FluidPhase::Wetting);
    let angle = |model: &Wetting| model.hysteresis_range()[end];
    (angle(&interface.wetting_model), on_plates(&interface.wetting_model, &interface.patches, angle))
}

/// The films in the corners of all walls with floor and lid.
pub(super) fn film_terms(
    invading: FluidPhase,
    depth: f64,
    interface: &NetworkInterface,
    (walls, gravity): (usize, Option<Gravity>),
) -> FilmTerms {
    let plates = on_depth(invading, interface).1;
    let through_wetting = |defending: f64| if invading == FluidPhase::Wetting { PI - defending } else { defending };
    let angles: Vec<f64> = angles(interface, walls, invading).into_iter().map(through_wetting).collect();
    FilmTerms {
        depth: depth_for(invading, depth, interface),
        walls: angles.iter().map(|&angle| WallFilms::new(angle, plates)).collect(),
        conductances: of_walls(depth, &angles, plates),
        gravity,
    }
}

/// Contact angle of each wall through the defending phase in rad: receding if the non-wetting phase invades.
pub(super) fn angles(interface: &NetworkInterface, walls: usize, invading: FluidPhase) -> Vec<f64> {
    let through_defending = |model: &Wetting| match invading {
        FluidPhase::NonWetting => model.hysteresis_range()[0],
        FluidPhase::Wetting => PI - model.hysteresis_range()[1],
    };
    let mut angles = vec![through_defending(&interface.wetting_model); walls];
    let first_side = walls - SIDES.len();
    for patch in &interface.patches {
        let angle = through_defending(&patch.model);
        let wall = match patch.on {
            PatchedWall::All => {
                angles.fill(angle);
                continue;
            }
            PatchedWall::Shape(shape) => shape as usize,
            PatchedWall::Side(side) => first_side + side as usize,
            PatchedWall::Plate(_) => continue,
        };
        if let Some(known) = angles.get_mut(wall) {
            *known = angle;
        }
    }
    angles
}
