//! Checks of `[sph.initial]`: the phases and the velocity at time zero.

use std::path::PathBuf;

use super::fluid::FluidPhase;
use super::network::state::Start;
use super::shapes::shape_problems;
use super::side::Sides;
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Empty, Key, tables};
use meniscus_core::math::Vec2;
use meniscus_geometry::spec::{GeometrySpec, ShapeSpec};

tables! {
    /// The state at time zero.
    pub(crate) struct RawInitial {
        /// Phase outside of the shapes (default `non-wetting`).
        pub background: FluidPhase,
        /// Shapes filled with the wetting phase (with `background = "wetting"`, with the other one); each must contain a particle of the pore (this or
        /// `non-wetting` is required with two fluids).
        pub wetting: Vec<ShapeSpec>,
        /// Shapes filled with the non-wetting phase, instead of `background` and `wetting`: the wetting phase fills the rest.
        pub non_wetting: Vec<ShapeSpec>,
        /// File with the state of a network of the same geometry, instead of these.
        pub network: PathBuf,
        /// Initial velocity: at most one field (default `rest`).
        pub velocity: RawVelocity,
    }

    /// Initial velocity fields; exactly one of them.
    pub(crate) struct RawVelocity {
        /// No motion.
        pub rest: Empty,
        /// Uniform velocity in m/s.
        pub uniform: [f64; 2],
        /// Taylor-Green vortices, one period per domain.
        pub taylor_green: RawTaylorGreen,
    }

    /// Taylor-Green vortices.
    pub(crate) struct RawTaylorGreen {
        /// Largest speed in m/s.
        pub speed: f64 => Key::positive("a speed in m/s").example("speed = 1.0 # m/s"),
    }
}

/// The keys of shapes that define the phases.
const WETTING: &str = "sph.initial.wetting";
const NON_WETTING: &str = "sph.initial.non-wetting";

/// Initial state.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Initial {
    /// The wetting phase is the union of these shapes (`[[sph.initial.wetting]]`) ...
    pub wetting: Vec<ShapeSpec>,
    /// ... or, if true, everything outside of them (`[[sph.initial.non-wetting]]`, or `sph.initial.background = "wetting"`).
    pub wetting_is_background: bool,
    /// The key of the shapes.
    #[serde(skip)]
    pub key: &'static str,
    /// The state of a network instead of shapes (`sph.initial.network`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub network: Option<Start>,
    /// Initial velocity.
    pub velocity: InitialVelocity,
}

/// Initial velocity fields.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum InitialVelocity {
    /// At rest.
    Rest,
    /// The same velocity everywhere, in m/s.
    Uniform(Vec2),
    /// Taylor-Green vortices of the given speed in m/s, one period per domain.
    TaylorGreen(f64),
}

/// The state at time zero from shapes.
pub(super) fn initial(
    checker: &mut Checker,
    raw: &mut RawInitial,
    two_phases: bool,
    geometry: Option<&GeometrySpec>,
) -> Option<Initial> {
    let others = [("background", raw.background.is_some()), ("wetting", raw.wetting.is_some())];
    let is_of_non_wetting = raw.non_wetting.is_some();
    if is_of_non_wetting {
        refuse_beside(checker, "non-wetting", &others);
    }
    let (key, shapes) =
        if is_of_non_wetting { (NON_WETTING, &mut raw.non_wetting) } else { (WETTING, &mut raw.wetting) };
    let wetting = shapes.get_or_insert_default().clone();
    for (index, shape) in wetting.iter().enumerate() {
        checker.problems.extend(shape_problems(&format!("{key}[{index}]"), shape, geometry));
    }
    if two_phases && wetting.is_empty() {
        checker.refuse(
            key,
            "there are two phases, and no shape defines their regions",
            "add [[sph.initial.wetting]] with a shape, such as disc = { center = [0.0, 0.0], radius = 1.0e-3 }",
        );
    }
    let velocity = velocity(checker, raw);
    let wetting_is_background = !two_phases || is_of_non_wetting || raw.background == Some(FluidPhase::Wetting);
    if !two_phases {
        raw.wetting = None;
    } else if !is_of_non_wetting {
        raw.background.get_or_insert(FluidPhase::NonWetting);
    }
    Some(Initial { wetting, wetting_is_background, key, network: None, velocity: velocity? })
}

/// The state at time zero from that of a network.
pub(super) fn from_network(
    checker: &mut Checker,
    raw: &mut RawInitial,
    two_phases: bool,
    sides: &Sides,
    start: Option<Start>,
) -> Option<Initial> {
    const PATH: &str = "sph.initial.network";
    let others = [
        ("background", raw.background.is_some()),
        ("wetting", raw.wetting.is_some()),
        ("non-wetting", raw.non_wetting.is_some()),
    ];
    if two_phases {
        refuse_beside(checker, "network", &others);
    }
    let velocity = velocity(checker, raw);
    let start = start?;
    if let Some((_, misfit)) = start.state.misfit_of_sides(sides) {
        let message = format!("{} was written for other sides: {misfit}", start.file.display());
        let help =
            "walls and periodic sides must be those of the network; its inlet and its outlet may be open or closed";
        checker.refuse(PATH, message, help);
        return None;
    }
    if start.state.invading_outline.is_empty() {
        let message = format!("{} has no menisci: it was written by a direct simulation", start.file.display());
        checker.refuse(
            PATH,
            message,
            "begin a network with it (network.initial), and take a state that this one writes",
        );
        return None;
    }
    let wetting_is_background = start.state.invading == FluidPhase::NonWetting;
    let velocity = velocity?;
    raw.network = Some(start.file.clone());
    Some(Initial { wetting: Vec::new(), wetting_is_background, key: WETTING, network: Some(start), velocity })
}

/// Refuses further keys if one key defines the phases; `others` are keys, and whether they are given.
fn refuse_beside(checker: &mut Checker, deciding: &str, others: &[(&str, bool)]) {
    for (key, _) in others.iter().filter(|(_, given)| *given) {
        checker.refuse(
            format!("sph.initial.{key}"),
            format!("`{deciding}` defines the regions of the phases, and `{key}` is given too"),
            "keep one of them",
        );
    }
}

fn velocity(checker: &mut Checker, raw: &mut RawInitial) -> Option<InitialVelocity> {
    const PATH: &str = "sph.initial.velocity";
    let raw = raw.velocity.get_or_insert(RawVelocity { rest: Some(Empty {}), ..RawVelocity::default() });
    let speed = raw.taylor_green.as_ref().map(|raw| raw.speed);
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
