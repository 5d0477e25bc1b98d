//! `films` of `[network]`: whether corners of a chip can contain films of the wetting phase.

use super::displacement::Process;
use super::pore_network::{NetworkInterface, PoreNetwork};
use crate::wetting::{PatchedWall, on_plates};
use meniscus_core::input::Checker;
use meniscus_wetting::Wetting;

/// Refuses films without a depth, and if no corner allows them.
pub(crate) fn refuse_films(checker: &mut Checker, network: &PoreNetwork, depth: Option<f64>) {
    const KEY: &str = "network.films";
    let Some(displacement) = network.displacement.as_ref().filter(|displacement| displacement.films) else { return };
    if depth.is_none() {
        let message = "corner films lie between walls and floor or lid, and a plane has neither";
        return checker.refuse(KEY, message, "add depth = 50e-6 to [geometry], or leave films out");
    }
    let Some(interface) = &network.interface else { return };
    // The wetting phase recedes in drainage and advances in imbibition.
    let half_cycles: &[(usize, &str)] = match displacement.process {
        Process::Drainage => &[(0, "drainage")],
        Process::Imbibition => &[(1, "imbibition")],
        Process::Cycle(_) => &[(0, "drainage"), (1, "imbibition")],
    };
    for &(end, name) in half_cycles {
        let [wall, plate] = smallest_angles(interface, end).map(f64::to_degrees);
        if wall + plate >= 90.0 {
            let message = format!(
                "no corner has a film in {name}: the smallest angles of a wall and of a plate, {wall:.1} and {plate:.1} degrees, sum to 90 or more"
            );
            let help = "films need wall and plate angles that sum to less than 90 degrees; leave films out, or change the angles";
            return checker.refuse(KEY, message, help);
        }
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
