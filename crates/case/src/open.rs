//! `[sph.sides.open]`: prescribed values at inlets, outlets and periodic sides with a flow, and their consistency.

use super::fluid::FluidPhase;
use super::rate::Rate;
use super::side::{SIDES, Side, Sides};
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, checked_tables, tables, words};

tables! {
    /// The open sides: a table for each side that fluid passes through.
    pub(crate) struct RawOpenSides {
        /// Flow through the side.
        pub left: RawOpenSide,
        /// Flow through the side.
        pub right: RawOpenSide,
        /// Flow through the side.
        pub bottom: RawOpenSide,
        /// Flow through the side.
        pub top: RawOpenSide,
    }

    /// An inlet, an outlet, or a periodic side with a given flow; one of pressure, velocity and flow rate.
    pub(crate) struct RawOpenSide {
        /// Dirichlet pressure in Pa, in the phase that enters (default 0 at an outlet).
        pub pressure: f64,
        /// A pressure that rises in equal steps.
        pub pressure_steps: RawPressureSteps,
        /// Mean inward velocity over the opening in m/s.
        pub velocity: f64 => Key::positive("a mean velocity inwards in m/s"),
        /// Inward flow rate per meter of depth in m²/s, with `geometry.depth` that of the chip in m³/s.
        pub flow_rate: Rate => Key::positive("a flow rate inwards in m2/s, or in m3/s with geometry.depth"),
        /// Rate at which the mean velocity rises in m/s² (default 0).
        pub acceleration: f64 => Key::not_negative("the rise of the mean velocity per time in m/s2"),
        /// Velocity profile over the opening; at periodic sides the initial one (default `plug`).
        pub profile: Profile,
        /// Phase that enters (default: the phase there at time zero).
        pub phase: FluidPhase,
    }
}

checked_tables! {
    /// A pressure that rises in equal steps, each held for the same time.
    pub struct RawPressureSteps for PressureSteps {
        /// Pressure rise per step in Pa.
        pub rise: f64 => Key::positive("a step in Pa").example("rise = 20.0"),
        /// Time for which each pressure is held, in s.
        pub every_time: f64 => Key::positive("a time in s").example("every-time = 1.0e-3"),
    }
}

words! {
    /// Velocity profile of an inlet.
    pub enum Profile {
        /// Uniform.
        Plug,
        /// A parabola that vanishes at walls.
        Parabolic,
    }
}

/// The drive of the flow through an open side, and the entering phase.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Open {
    /// The prescribed quantity.
    pub drive: Drive,
    /// Whether the entering phase is the wetting one; `None`: the initial phase at the side.
    pub enters_wetting: Option<bool>,
    /// Steps of a prescribed pressure.
    pub pressure_steps: Option<PressureSteps>,
    /// Rate in m/s² at which a prescribed mean velocity rises.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub acceleration: Option<f64>,
}

/// The prescribed quantity at an open side.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Drive {
    /// A pressure in Pa.
    Pressure(f64),
    /// The mean inward velocity in m/s.
    Velocity(f64, Profile),
    /// The inflow of area per time in m²/s, in a chip with a depth of volume in m³/s.
    FlowRate(f64, Profile),
}

/// The flow through the left, right, bottom and top side; `None` if a mistake was found.
pub(super) fn open(
    checker: &mut Checker,
    sides: &Sides,
    tables: &mut Option<RawOpenSides>,
    two_phases: bool,
) -> Option<[Option<Open>; 4]> {
    let before = checker.problems.len();
    let kinds = sides.each();
    let none = &mut RawOpenSides::default();
    let all =
        if kinds.into_iter().any(is_open) { tables.get_or_insert_default() } else { tables.as_mut().unwrap_or(none) };
    let mut tables = [&mut all.left, &mut all.right, &mut all.bottom, &mut all.top];
    let mut open = [None; 4];
    for (i, table) in tables.iter_mut().enumerate() {
        open[i] = side(checker, SIDES[i], kinds[i], table);
        if let Some(table) = table {
            phase(checker, SIDES[i], table, two_phases);
        }
        if table.as_ref().is_some_and(|table| table.profile == Some(Profile::Parabolic)) {
            parabola(checker, i, kinds);
        }
    }
    for pair in [[0, 1], [2, 3]] {
        if pair.iter().all(|&i| kinds[i] == Side::Periodic && tables[i].is_some()) {
            checker.refuse(
                at(SIDES[pair[1]]),
                format!("`{}` and `{}` both have a flow, and are one periodic side", SIDES[pair[0]], SIDES[pair[1]]),
                "keep the table of the side through which fluid enters",
            );
        }
    }
    together(checker, kinds, open);
    (checker.problems.len() == before).then_some(open)
}

fn at(side: &str) -> String {
    format!("sph.sides.open.{side}")
}

fn is_open(kind: Side) -> bool {
    matches!(kind, Side::Inlet | Side::Outlet)
}

/// The drive of a side; its table then has all keys.
fn side(checker: &mut Checker, name: &str, kind: Side, table: &mut Option<RawOpenSide>) -> Option<Open> {
    let raw = table.as_ref();
    let path = at(name);
    let is_given = |key: &str, value: bool| value || checker.is_refused(&format!("{path}.{key}"));
    let given = raw.map_or([false; 3], |raw| {
        [
            raw.pressure.is_some(),
            is_given("velocity", raw.velocity.is_some()),
            is_given("flow-rate", raw.flow_rate.is_some()),
        ]
    });
    let (allowed, example): ([bool; 3], &str) = match kind {
        Side::Inlet => {
            ([true; 3], "velocity in m/s, flow-rate in m2/s (in m3/s with geometry.depth) or pressure in Pa")
        }
        Side::Outlet => ([true, false, false], "pressure in Pa"),
        Side::Periodic => ([false, true, true], "velocity in m/s or flow-rate in m2/s (in m3/s with geometry.depth)"),
        _ => {
            if raw.is_some() {
                checker.refuse(
                    path,
                    format!("the side `{name}` is closed"),
                    format!("set sides.{name} = \"inlet\" or \"outlet\", or leave this table out"),
                );
            }
            return None;
        }
    };
    if kind == Side::Periodic && raw.is_none() {
        return None;
    }
    let count = given.iter().filter(|given| **given).count();
    // An outlet to atmosphere needs no further keys.
    let needed = usize::from(kind != Side::Outlet);
    let is_wrong = given.iter().zip(allowed).any(|(given, allowed)| *given && !allowed);
    if is_wrong || count > 1 || count < needed {
        let kind = format!("{kind:?}").to_lowercase();
        let found = ["pressure", "velocity", "flow-rate"].iter().zip(given).filter(|(_, given)| *given);
        let found: Vec<&str> = found.map(|(key, _)| *key).collect();
        let found = if found.is_empty() { "nothing".to_owned() } else { found.join(", ") };
        checker.refuse(
            if raw.is_some() { path } else { format!("sph.sides.{name}") },
            format!("the side `{name}` is of the kind `{kind}` and takes one value, found {found}"),
            format!("in [sph.sides.open.{name}] give {example}"),
        );
        return None;
    }
    let raw = table.get_or_insert_default();
    let (has_profile, acceleration) = (raw.profile.is_some(), raw.acceleration);
    let drive = match (raw.velocity, raw.flow_rate) {
        (Some(velocity), _) => Drive::Velocity(velocity, *raw.profile.get_or_insert(Profile::Plug)),
        (_, Some(rate)) => Drive::FlowRate(rate.value(), *raw.profile.get_or_insert(Profile::Plug)),
        _ => Drive::Pressure(*raw.pressure.get_or_insert_default()),
    };
    if has_profile && !given[1] && !given[2] {
        checker.refuse(
            format!("{path}.profile"),
            "a profile needs a velocity or a flow rate",
            "at a given pressure the profile is a result; leave this out",
        );
    }
    if acceleration.is_some() && !given[1] && !given[2] {
        checker.refuse(
            format!("{path}.acceleration"),
            "a velocity that rises needs an initial value",
            "give velocity = ... in m/s or flow-rate = ... instead of a pressure, or leave this out",
        );
    }
    let pressure_steps = pressure_steps(checker, &path, raw, given[0]);
    let enters_wetting = raw.phase.map(|phase| phase == FluidPhase::Wetting);
    Some(Open { drive, enters_wetting, pressure_steps, acceleration })
}

fn pressure_steps(checker: &mut Checker, side: &str, raw: &RawOpenSide, has_pressure: bool) -> Option<PressureSteps> {
    let steps = raw.pressure_steps.as_ref()?;
    let path = format!("{side}.pressure-steps");
    if !has_pressure {
        checker.refuse(
            path,
            "a pressure that rises in steps needs an initial value",
            "give pressure = ... in Pa beside it, or leave this out",
        );
        return None;
    }
    steps.clone().complete()
}

fn phase(checker: &mut Checker, name: &str, raw: &RawOpenSide, two_phases: bool) {
    if raw.phase.is_some() && !two_phases {
        checker.refuse(
            format!("{}.phase", at(name)),
            "an entering phase needs two phases, and there is no [sph.phases.non-wetting]",
            "add the second phase, or leave this out",
        );
    }
}

/// A parabola ends at walls; its maximum may lie on a mirror.
fn parabola(checker: &mut Checker, side: usize, kinds: [Side; 4]) {
    let across = if side < 2 { [2, 3] } else { [0, 1] };
    if across.iter().any(|&i| kinds[i] == Side::Periodic) || across.iter().all(|&i| kinds[i] == Side::Symmetry) {
        checker.refuse(
            format!("{}.profile", at(SIDES[side])),
            "a parabola needs a wall at one end or both",
            "use profile = \"plug\", or close the adjacent sides",
        );
    }
}

fn together(checker: &mut Checker, kinds: [Side; 4], open: [Option<Open>; 4]) {
    let sides: Vec<usize> = (0..4).filter(|&i| is_open(kinds[i])).collect();
    let [first, rest @ ..] = sides.as_slice() else { return };
    for &i in rest.iter().filter(|&&i| i / 2 != first / 2) {
        checker.refuse(
            format!("sph.sides.{}", SIDES[i]),
            format!("the open sides `{}` and `{}` meet in a corner", SIDES[*first], SIDES[i]),
            "open sides must be opposite to each other",
        );
    }
    if rest.is_empty() {
        checker.refuse(
            format!("sph.sides.{}", SIDES[*first]),
            format!("`{}` is the only open side: an incompressible fluid cannot flow in or out there", SIDES[*first]),
            "open the opposite side too, with \"outlet\"",
        );
    } else if sides.iter().all(|&i| open[i].is_some_and(|open| !matches!(open.drive, Drive::Pressure(_)))) {
        checker.refuse(
            format!("sph.sides.{}", SIDES[*first]),
            "fluid flows in at given velocities at all open sides and cannot leave",
            "make one side an \"outlet\"",
        );
    }
}
