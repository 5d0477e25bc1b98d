//! Checks of `[network]`: ranges of every value, which values go together, and what a displacement cannot do.

use super::checked::{
    Driven, DynamicDrive, NetworkDisplacement, NetworkEvents, NetworkInterface, PoreNetwork, Process, Stop,
};
use super::measured;
use super::raw::{RawDynamic, RawEvents, RawNetwork, RawNetworkSide, RawProcess};
use super::state::Start;
use crate::case::checked::{SIDES, Side, Sides};
use crate::case::raw::RawSideName;
use crate::case::sph::fluid;
use crate::case::wetting;
use crate::geometry::spec::GeometrySpec;
use crate::input::Checker;
use crate::wetting::Wetting;

/// Persistence ratio where the case says nothing.
pub(crate) const DEFAULT_PERSISTENCE: f64 = 0.95;
/// Below this ratio pores that no one would take for one are joined.
const PERSISTENCE: (f64, f64) = (0.5, 1.0);
/// Most cycles: the loop closes after two or three.
const MOST_CYCLES: f64 = 100.0;

/// Most pore volumes per step where the case says nothing.
pub(crate) const DEFAULT_LARGEST_STEP: f64 = 0.01;
const LARGEST_STEP: (f64, f64) = (1e-6, 1.0);

/// Checks `[network]`; `geometry` is missing where it was wrong.
pub(in crate::case) fn network(
    checker: &mut Checker,
    raw: &RawNetwork,
    geometry: Option<&GeometrySpec>,
    start: Option<Start>,
) -> Option<PoreNetwork> {
    let sides = sides(checker, raw);
    let phases = raw.phases.clone().unwrap_or_default();
    let [wetting, non_wetting] =
        [("wetting", phases.wetting), ("non-wetting", phases.non_wetting)].map(|(name, raw)| match raw {
            Some(raw) => fluid(checker, &format!("network.phases.{name}"), &raw).map(Some),
            None => Some(None),
        });
    let persistence = checker.within("network.persistence", raw.persistence, PERSISTENCE, "a persistence ratio");
    let interface = interface(checker, raw, sides.as_ref(), geometry);
    let measured = measured::checked(checker, raw.measured_throats.as_ref());
    if raw.dynamic.is_some() && raw.measured_throats.is_some() {
        checker.refuse(
            "network.measured",
            "a displacement in time follows menisci through throats by the formula, and knows no measured pressures",
            "leave it out, or leave out [network.dynamic]",
        );
    }
    let displacement = if raw.inlet.is_some() {
        if let (Some(start), Some(sides)) = (&start, &sides) {
            refuse_other_sides(checker, start, sides);
        }
        Some(displacement(checker, raw, start))
    } else {
        refuse_without_inlet(checker, raw);
        None
    };
    if raw.dynamic.is_some() && displacement.as_ref().is_some_and(|displacement| displacement.dynamic.is_none()) {
        return None;
    }
    Some(PoreNetwork {
        sides: sides?,
        wetting: wetting?,
        non_wetting: non_wetting?,
        interface: interface?,
        persistence: persistence.unwrap_or(DEFAULT_PERSISTENCE),
        measured: measured?,
        displacement,
    })
}

fn number(side: RawSideName) -> usize {
    match side {
        RawSideName::Left => 0,
        RawSideName::Right => 1,
        RawSideName::Bottom => 2,
        RawSideName::Top => 3,
    }
}

/// The kinds of all four sides; none where they do not go together.
fn sides(checker: &mut Checker, raw: &RawNetwork) -> Option<Sides> {
    let before = checker.problems.len();
    let given = raw.sides.clone().unwrap_or_default();
    let given = [given.left, given.right, given.bottom, given.top];
    let mut kinds = given.map(|side| match side {
        Some(RawNetworkSide::Periodic) => Side::Periodic,
        Some(RawNetworkSide::Wall) | None => Side::Wall,
    });
    let open = [("inlet", raw.inlet, Side::Inlet), ("outlet", raw.outlet, Side::Outlet)];
    for (key, side, kind) in open.into_iter().filter_map(|(key, side, kind)| Some((key, number(side?), kind))) {
        if given[side].is_some() {
            checker.refuse(
                format!("network.sides.{}", SIDES[side]),
                format!("the side `{}` is the {key}, and a kind of side is given for it too", SIDES[side]),
                format!("leave it out of [network.sides], or choose another {key}"),
            );
        }
        kinds[side] = kind;
    }
    if let (Some(inlet), Some(outlet)) = (raw.inlet.map(number), raw.outlet.map(number)) {
        if inlet == outlet {
            let message = format!("`{}` is both inlet and outlet", SIDES[inlet]);
            checker.refuse("network.outlet", message, format!("take the opposite side, `{}`", SIDES[inlet ^ 1]));
        } else if inlet / 2 != outlet / 2 {
            checker.refuse(
                "network.outlet",
                format!("the inlet `{}` and the outlet `{}` meet in a corner", SIDES[inlet], SIDES[outlet]),
                format!("take the opposite side, `{}`", SIDES[inlet ^ 1]),
            );
        }
    }
    for [a, b] in [[0, 1], [2, 3]] {
        for (one, other) in [(a, b), (b, a)] {
            if kinds[one] == Side::Periodic && kinds[other] != Side::Periodic {
                let found = match kinds[other] {
                    Side::Wall => "a wall",
                    Side::Inlet => "the inlet",
                    _ => "the outlet",
                };
                checker.refuse(
                    format!("network.sides.{}", SIDES[one]),
                    format!(
                        "the side `{}` is periodic and the opposite side `{}` is {found}",
                        SIDES[one], SIDES[other]
                    ),
                    "periodic sides come in pairs: make both periodic, or none",
                );
            }
        }
    }
    let [left, right, bottom, top] = kinds;
    (checker.problems.len() == before).then_some(Sides { left, right, bottom, top })
}

/// Tension and angles: both, or neither where nothing is displaced. The outer option is missing where a mistake was found.
fn interface(
    checker: &mut Checker,
    raw: &RawNetwork,
    sides: Option<&Sides>,
    geometry: Option<&GeometrySpec>,
) -> Option<Option<NetworkInterface>> {
    let tension = raw.interface.as_ref().and_then(|interface| interface.tension);
    if raw.inlet.is_none() && raw.interface.is_none() && raw.wetting.is_none() {
        return Some(None);
    }
    let tension =
        checker.require_positive("network.interface.tension", tension, "tension = 0.0276 # N/m", "a tension in N/m");
    if raw.wetting.is_none() {
        checker.require::<()>("network.wetting", None, "[network.wetting.young] with contact-angle-deg");
    }
    let model = wetting::model(checker, "network.wetting", raw.wetting.as_ref(), tension)?;
    let model = static_model(checker, model);
    let patches = match model {
        Some(model) => wetting::patches(checker, "network.wetting", raw.wetting.as_ref(), model, sides, geometry),
        None => Vec::new(),
    };
    for (index, patch) in raw.wetting.iter().flat_map(|raw| &raw.patches).flatten().enumerate() {
        if patch.stripes.is_some() {
            checker.refuse(
                format!("network.wetting.patches[{index}].stripes"),
                "menisci of a network stand between whole walls, and stripes divide a wall",
                "give the patch a shape or a side; a striped wall can be written as several shapes side by side",
            );
        }
    }
    Some(Some(NetworkInterface { tension: tension?, wetting_model: model?, patches }))
}

/// The model, where it is one of lines at rest.
fn static_model(checker: &mut Checker, model: Wetting) -> Option<Wetting> {
    if !model.is_dynamic() {
        return Some(model);
    }
    let (name, angle) = (model.table().key, model.static_angle().to_degrees());
    checker.refuse(
        format!("network.wetting.{name}"),
        format!("`{name}` is a law of the speed of contact lines, and a quasi-static displacement has no speed"),
        format!("take [network.wetting.young] with the static angle, contact-angle-deg = {angle:.1}"),
    );
    None
}

fn displacement(checker: &mut Checker, raw: &RawNetwork, initial: Option<Start>) -> NetworkDisplacement {
    let cycles = checker.within("network.cycles", raw.cycles.map(f64::from), (1.0, MOST_CYCLES), "a number of cycles");
    let process = match raw.process {
        None | Some(RawProcess::Drainage) => Process::Drainage,
        Some(RawProcess::Imbibition) => Process::Imbibition,
        Some(RawProcess::Cycle) => Process::Cycle(cycles.map_or(1, |_| raw.cycles.unwrap_or(1))),
    };
    if raw.cycles.is_some() && !matches!(process, Process::Cycle(_)) {
        checker.refuse(
            "network.cycles",
            "only cycles are counted, and the process is none",
            "set process = \"cycle\", or leave this out",
        );
    }
    if matches!(process, Process::Cycle(_)) && raw.outlet.is_none() {
        checker.refuse(
            "network.process",
            "a cycle needs an outlet: the wetting phase comes back through it",
            "add outlet = \"right\", say",
        );
    }
    NetworkDisplacement {
        process,
        trapping: raw.trapping.unwrap_or(true),
        events: match raw.events {
            None | Some(RawEvents::All) => NetworkEvents::All,
            Some(RawEvents::Burst) => NetworkEvents::Burst,
        },
        stop: stop(checker, raw),
        dynamic: raw.dynamic.as_ref().and_then(|dynamic| drive(checker, raw, dynamic, process)),
        initial,
    }
}

/// Refuses a state whose walls and periodic sides are others; what is open may change.
fn refuse_other_sides(checker: &mut Checker, start: &Start, sides: &Sides) {
    if let Some((_, misfit)) = start.state.misfit_of_sides(sides) {
        let message = format!("{} is the state of other sides: {misfit}", start.file.display());
        checker.refuse("network.initial", message, "give this case the sides of the state");
    }
}

/// Checks `[network.dynamic]` and what goes with it.
fn drive(checker: &mut Checker, raw: &RawNetwork, dynamic: &RawDynamic, process: Process) -> Option<DynamicDrive> {
    let before = checker.problems.len();
    let rate = checker.positive("network.dynamic.rate", dynamic.rate, "a rate in m2/s");
    let pressure = checker.positive("network.dynamic.pressure-drop", dynamic.pressure_drop, "a pressure drop in Pa");
    let step = checker.within(
        "network.dynamic.largest-step",
        dynamic.largest_step,
        LARGEST_STEP,
        "a share of the pore volume",
    );
    let one = "rate = 1.0e-8 # m2/s, or pressure-drop = 500.0 # Pa";
    if raw.initial.is_some() {
        checker.refuse(
            "network.initial",
            "a displacement in time begins with the pore space full of the defending phase",
            "leave out `initial`, or [network.dynamic]",
        );
    }
    let drive = match (dynamic.rate, dynamic.pressure_drop) {
        (Some(_), Some(_)) => {
            let message = "a rate and a pressure drop are given, and one follows from the other";
            checker.refuse("network.dynamic.pressure-drop", message, "leave one of them out");
            None
        }
        (Some(_), None) => rate.map(Driven::Rate),
        (None, Some(_)) => pressure.map(Driven::PressureDrop),
        (None, None) => checker.require("network.dynamic.rate", None, one),
    };
    if raw.outlet.is_none() {
        let message = "a displacement in time needs an outlet: the phase that is displaced leaves through it";
        checker.refuse("network.outlet", message, "add outlet = \"right\", say");
    }
    let phases = raw.phases.clone().unwrap_or_default();
    for (name, is_given) in [("wetting", phases.wetting.is_some()), ("non-wetting", phases.non_wetting.is_some())] {
        if !is_given {
            checker.refuse(
                format!("network.phases.{name}"),
                format!("a displacement in time needs the viscosity of the {name} phase"),
                format!("add [network.phases.{name}] with preset = \"water\", say, or density and viscosity"),
            );
        }
    }
    let quasi_static = [
        ("process", matches!(process, Process::Cycle(_)), "a cycle", "take drainage or imbibition"),
        ("events", raw.events == Some(RawEvents::Burst), "invasion percolation", "leave events out"),
        ("trapping", raw.trapping.is_some(), "a rule for trapping", "leave it out: what cannot flow out is trapped"),
        (
            "stop.capillary-pressure",
            raw.stop.as_ref().is_some_and(|stop| stop.capillary_pressure.is_some()),
            "one capillary pressure",
            "end at breakthrough, at a saturation, or after injected = 1.0 pore volumes",
        ),
    ];
    for (key, _, what, help) in quasi_static.into_iter().filter(|(_, given, _, _)| *given) {
        checker.refuse(
            format!("network.{key}"),
            format!("{what} belongs to quasi-static displacement, and [network.dynamic] is given"),
            help,
        );
    }
    let largest_step = step.unwrap_or(DEFAULT_LARGEST_STEP);
    (checker.problems.len() == before).then_some(DynamicDrive { drive: drive?, largest_step })
}

fn stop(checker: &mut Checker, raw: &RawNetwork) -> Stop {
    let given = raw.stop.clone().unwrap_or_default();
    if given.breakthrough == Some(true) && raw.outlet.is_none() {
        checker.refuse(
            "network.stop.breakthrough",
            "there is no outlet to break through at",
            "add outlet = \"right\", say, or leave this out",
        );
    }
    let saturation =
        checker.within("network.stop.saturation", given.saturation, (0.0, 1.0), "a saturation of the wetting phase");
    let injected = checker.positive("network.stop.injected", given.injected, "a number of pore volumes");
    if injected.is_some() && raw.dynamic.is_none() {
        checker.refuse(
            "network.stop.injected",
            "injected volumes are those of a displacement in time, and this one is quasi-static",
            "end at a saturation, or add [network.dynamic]",
        );
    }
    Stop {
        breakthrough: given.breakthrough.unwrap_or_default(),
        saturation,
        capillary_pressure: given.capillary_pressure,
        injected,
    }
}

/// Keys that say how something is displaced, where nothing comes in.
fn refuse_without_inlet(checker: &mut Checker, raw: &RawNetwork) {
    let given = [
        ("outlet", raw.outlet.is_some()),
        ("process", raw.process.is_some()),
        ("cycles", raw.cycles.is_some()),
        ("trapping", raw.trapping.is_some()),
        ("events", raw.events.is_some()),
        ("stop", raw.stop.is_some()),
        ("initial", raw.initial.is_some()),
        ("dynamic", raw.dynamic.is_some()),
    ];
    for (key, _) in given.into_iter().filter(|(_, given)| *given) {
        checker.refuse(
            format!("network.{key}"),
            format!("`{key}` belongs to a displacement, and there is no inlet"),
            "add inlet = \"left\", say; without an inlet the network is extracted and nothing is displaced",
        );
    }
}
