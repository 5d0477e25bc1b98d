//! Checks of `[sph.initial]`: which phase is where at time zero, and how it moves.

use super::checked::{Initial, InitialVelocity, Sides};
use super::network::state::Start;
use super::raw::{RawInitial, RawPhase};
use super::shapes::shape_problems;
use crate::geometry::spec::GeometrySpec;
use crate::input::Checker;
use crate::math::Vec2;

/// The state at time zero by shapes.
pub(super) fn initial(
    checker: &mut Checker,
    raw: &RawInitial,
    two_phases: bool,
    geometry: Option<&GeometrySpec>,
) -> Option<Initial> {
    let wetting = raw.wetting.clone().unwrap_or_default();
    for (index, shape) in wetting.iter().enumerate() {
        checker.problems.extend(shape_problems(&format!("sph.initial.wetting[{index}]"), shape, geometry));
    }
    if two_phases && wetting.is_empty() {
        checker.refuse(
            "sph.initial.wetting",
            "there are two phases, and no shape says where they are",
            "add [[sph.initial.wetting]] with a shape, such as disc = { center = [0.0, 0.0], radius = 1.0e-3 }",
        );
    }
    let velocity = velocity(checker, raw);
    let wetting_is_background = !two_phases || raw.background == Some(RawPhase::Wetting);
    Some(Initial { wetting, wetting_is_background, network: None, velocity: velocity? })
}

/// The state at time zero by that of a network.
pub(super) fn from_network(
    checker: &mut Checker,
    raw: &RawInitial,
    two_phases: bool,
    sides: &Sides,
    start: Option<Start>,
) -> Option<Initial> {
    const PATH: &str = "sph.initial.network";
    let others = [("background", raw.background.is_some()), ("wetting", raw.wetting.is_some())];
    for (key, _) in others.into_iter().filter(|(_, given)| *given && two_phases) {
        checker.refuse(
            format!("sph.initial.{key}"),
            format!("`network` says which phase is where, and `{key}` is given too"),
            "keep one of them",
        );
    }
    let velocity = velocity(checker, raw);
    let start = start?;
    if let Some((_, misfit)) = start.state.misfit_of_sides(sides) {
        let message = format!("{} is the state of other sides: {misfit}", start.file.display());
        let help =
            "walls and periodic sides must be those of the network; its inlet and its outlet may be open or closed";
        checker.refuse(PATH, message, help);
        return None;
    }
    if start.state.invading_outline.is_empty() {
        let message = format!("{} holds no menisci: a direct simulation wrote it", start.file.display());
        checker.refuse(
            PATH,
            message,
            "begin a network with it (network.initial), and take a state that this one writes",
        );
        return None;
    }
    let wetting_is_background = start.state.invading == RawPhase::NonWetting;
    Some(Initial { wetting: Vec::new(), wetting_is_background, network: Some(start), velocity: velocity? })
}

fn velocity(checker: &mut Checker, raw: &RawInitial) -> Option<InitialVelocity> {
    const PATH: &str = "sph.initial.velocity";
    let Some(raw) = &raw.velocity else { return Some(InitialVelocity::Rest) };
    let speed = raw.taylor_green.as_ref().map(|raw| {
        let path = format!("{PATH}.taylor-green.speed");
        checker.require_positive(&path, raw.speed, "speed = 1.0 # m/s", "a speed in m/s")
    });
    match (raw.rest, raw.uniform, speed) {
        (Some(_), None, None) => Some(InitialVelocity::Rest),
        (None, Some(velocity), None) => Some(InitialVelocity::Uniform(Vec2::from(velocity))),
        (None, None, Some(speed)) => speed.map(InitialVelocity::TaylorGreen),
        (rest, uniform, speed) => {
            let count = usize::from(rest.is_some()) + usize::from(uniform.is_some()) + usize::from(speed.is_some());
            checker.refuse(
                PATH,
                format!("expected exactly one velocity field, found {count}"),
                "choose one of `rest`, `uniform`, `taylor-green`",
            );
            None
        }
    }
}
