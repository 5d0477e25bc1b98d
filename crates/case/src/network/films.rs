//! `films` of `[network]`: how films of the wetting phase in the corners of a chip are connected.

use super::displacement::Process;
use super::pore_network::{NetworkInterface, PoreNetwork};
use super::table::FilmModel;
use crate::wetting::{PatchedWall, on_plates};
use meniscus_core::input::Checker;
use meniscus_wetting::Wetting;

/// Refuses films without a depth, and sets the default: rings with a depth, where a corner holds a film.
pub(crate) fn films(checker: &mut Checker, network: &mut PoreNetwork, depth: Option<f64>) {
    let Some(displacement) = network.displacement.as_mut().filter(|displacement| displacement.dynamic.is_none()) else {
        return;
    };
    if depth.is_none() && displacement.has_films() {
        let message = "corner films lie between walls and floor or lid, and a plane has neither";
        checker.refuse("network.films", message, "add depth = 50e-6 to [geometry], or leave films out");
    }
    let Some(interface) = network.interface.as_ref().filter(|_| depth.is_some()) else { return };
    // The wetting phase recedes in drainage and advances in imbibition.
    let half_cycles: &[usize] = match displacement.process {
        Process::Drainage => &[0],
        Process::Imbibition => &[1],
        Process::Cycle(_) => &[0, 1],
    };
    if half_cycles.iter().any(|&end| smallest_angles(interface, end).iter().sum::<f64>() < std::f64::consts::FRAC_PI_2)
    {
        displacement.films.get_or_insert(FilmModel::Rings);
    }
}

/// The smallest contact angles in rad of all walls, and of floor and lid, measured through the wetting phase: receding (0) or advancing (1).
fn smallest_angles(interface: &NetworkInterface, end: usize) -> [f64; 2] {
    let angle = |model: &Wetting| model.hysteresis_range()[end];
    let patches = interface.patches.iter().filter(|patch| !matches!(patch.on, PatchedWall::Plate(_)));
    let everywhere = interface.patches.iter().any(|patch| patch.on == PatchedWall::All);
    let own = (!everywhere).then(|| angle(&interface.wetting_model));
    let walls = patches.map(|patch| angle(&patch.model)).chain(own).fold(f64::INFINITY, f64::min);
    let [floor, lid] = on_plates(&interface.wetting_model, &interface.patches, angle);
    [walls, floor.min(lid)]
}
