//! Checks of `[sph.sides.open]`: what is given at inlets, outlets and periodic sides with a flow, and what cannot work.

use super::checked::{Drive, Open, PressureSteps, Profile, SIDES};
use super::raw::{RawOpenSide, RawPhase, RawProfile, RawSide, RawSides};
use crate::input::Checker;

/// The flow through the left, right, bottom and top side; none where a mistake was found.
pub(super) fn open(checker: &mut Checker, raw: &RawSides, two_phases: bool) -> Option<[Option<Open>; 4]> {
    let before = checker.problems.len();
    let kinds = [raw.left, raw.right, raw.bottom, raw.top].map(|side| side.unwrap_or(RawSide::Wall));
    let tables = raw.open.clone().unwrap_or_default();
    let tables = [tables.left, tables.right, tables.bottom, tables.top];
    let mut open = [None; 4];
    for (i, table) in tables.iter().enumerate() {
        open[i] = side(checker, (SIDES[i], kinds[i]), table.as_ref());
        if let Some(table) = table {
            phase(checker, SIDES[i], table, two_phases);
        }
        if table.as_ref().is_some_and(|table| table.profile == Some(RawProfile::Parabolic)) {
            parabola(checker, i, kinds);
        }
    }
    for pair in [[0, 1], [2, 3]] {
        if pair.iter().all(|&i| kinds[i] == RawSide::Periodic && tables[i].is_some()) {
            checker.refuse(
                at(SIDES[pair[1]]),
                format!("both `{}` and `{}` have a flow, and they are one side", SIDES[pair[0]], SIDES[pair[1]]),
                "keep the table of the side that fluid comes in through",
            );
        }
    }
    together(checker, kinds, open);
    (checker.problems.len() == before).then_some(open)
}

fn at(side: &str) -> String {
    format!("sph.sides.open.{side}")
}

fn is_open(kind: RawSide) -> bool {
    matches!(kind, RawSide::Inlet | RawSide::Outlet)
}

fn side(checker: &mut Checker, (name, kind): (&str, RawSide), raw: Option<&RawOpenSide>) -> Option<Open> {
    let path = at(name);
    let given = raw.map_or([false; 3], |raw| [raw.pressure.is_some(), raw.velocity.is_some(), raw.flow_rate.is_some()]);
    let (allowed, example): ([bool; 3], &str) = match kind {
        RawSide::Inlet => ([true; 3], "velocity in m/s, flow-rate in m2/s or pressure in Pa"),
        RawSide::Outlet => ([true, false, false], "pressure in Pa"),
        RawSide::Periodic => ([false, true, true], "velocity in m/s or flow-rate in m2/s"),
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
    if kind == RawSide::Periodic && raw.is_none() {
        return None;
    }
    let count = given.iter().filter(|given| **given).count();
    // An outlet to the open air needs no more than its name.
    let needed = usize::from(kind != RawSide::Outlet);
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
    let raw = raw.cloned().unwrap_or_default();
    let shape = match raw.profile {
        None | Some(RawProfile::Plug) => Profile::Plug,
        Some(RawProfile::Parabolic) => Profile::Parabolic,
    };
    let velocity = checker.positive(&format!("{path}.velocity"), raw.velocity, "a mean velocity inwards in m/s");
    let rate = checker.positive(&format!("{path}.flow-rate"), raw.flow_rate, "a flow rate inwards in m2/s");
    let drive = match (velocity, rate) {
        (Some(velocity), _) => Drive::Velocity(velocity, shape),
        (_, Some(rate)) => Drive::FlowRate(rate, shape),
        _ => Drive::Pressure(raw.pressure.unwrap_or(0.0)),
    };
    if raw.profile.is_some() && raw.velocity.is_none() && raw.flow_rate.is_none() {
        checker.refuse(
            format!("{path}.profile"),
            "a profile needs a velocity or a flow rate",
            "at a given pressure the flow finds its own profile; leave this out",
        );
    }
    let pressure_steps = pressure_steps(checker, &path, &raw);
    Some(Open { drive, enters_wetting: raw.phase.map(|phase| phase == RawPhase::Wetting), pressure_steps })
}

fn pressure_steps(checker: &mut Checker, side: &str, raw: &RawOpenSide) -> Option<PressureSteps> {
    let steps = raw.pressure_steps.as_ref()?;
    let path = format!("{side}.pressure-steps");
    if raw.pressure.is_none() {
        checker.refuse(
            path,
            "a pressure that rises in steps needs the first one",
            "give pressure = ... in Pa beside it, or leave this out",
        );
        return None;
    }
    let rise = checker.require_positive(&format!("{path}.rise"), steps.rise, "rise = 20.0", "a step in Pa");
    let every = format!("{path}.every-time");
    let every_time = checker.require_positive(&every, steps.every_time, "every-time = 1.0e-3", "a time in s");
    Some(PressureSteps { rise: rise?, every_time: every_time? })
}

fn phase(checker: &mut Checker, name: &str, raw: &RawOpenSide, two_phases: bool) {
    if raw.phase.is_some() && !two_phases {
        checker.refuse(
            format!("{}.phase", at(name)),
            "a phase that comes in needs two phases, and there is no [sph.phases.non-wetting]",
            "add the second phase, or leave this out",
        );
    }
}

/// A parabola ends at walls; it may have its top on a mirror.
fn parabola(checker: &mut Checker, side: usize, kinds: [RawSide; 4]) {
    let across = if side < 2 { [2, 3] } else { [0, 1] };
    if across.iter().any(|&i| kinds[i] == RawSide::Periodic) || across.iter().all(|&i| kinds[i] == RawSide::Symmetry) {
        checker.refuse(
            format!("{}.profile", at(SIDES[side])),
            "a parabola needs a wall at one end at least",
            "use profile = \"plug\", or close the sides beside it",
        );
    }
}

fn together(checker: &mut Checker, kinds: [RawSide; 4], open: [Option<Open>; 4]) {
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
            format!("`{}` is the only open side: what is incompressible cannot flow in or out there", SIDES[*first]),
            "open the opposite side too, with \"outlet\"",
        );
    } else if sides.iter().all(|&i| open[i].is_some_and(|open| !matches!(open.drive, Drive::Pressure(_)))) {
        checker.refuse(
            format!("sph.sides.{}", SIDES[*first]),
            "fluid flows in at given velocities everywhere and has no way out",
            "make one side an \"outlet\"",
        );
    }
}
