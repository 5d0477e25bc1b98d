//! `[network.dynamic]`: what drives a displacement in time.

use super::table::{Events, FilmModel, RawNetwork};
use meniscus_core::input::Checker;

/// What drives a displacement in time.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct DynamicDrive {
    /// A prescribed rate or pressure.
    pub drive: Drive,
    /// Largest number of pore volumes that pass the inlet in one step.
    pub largest_step: f64,
    /// Initial wetting saturation; `None` if the pores at the inlet are full.
    pub initial_saturation: Option<f64>,
}

/// The drive of a displacement in time.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Drive {
    /// Area injected per time in m²/s.
    Rate(f64),
    /// Pressure at the inlet minus that at the outlet in Pa.
    PressureDrop(f64),
}

/// Default of the largest number of pore volumes per step.
pub const DEFAULT_LARGEST_STEP: f64 = 0.01;

/// Checks `[network.dynamic]`, if there is one, and related keys.
pub(super) fn drive(checker: &mut Checker, raw: &mut RawNetwork, is_cycle: bool) -> Option<DynamicDrive> {
    let dynamic = raw.dynamic.as_mut()?;
    let before = checker.problems.len();
    if raw.initial.is_some() {
        checker.refuse(
            "network.initial",
            "a displacement in time begins with the pore space full of the defending phase",
            "leave out `initial`, or [network.dynamic]",
        );
    }
    let rate = checker.is_given("network.dynamic.rate", dynamic.rate.as_ref());
    let pressure = checker.is_given("network.dynamic.pressure-drop", dynamic.pressure_drop.as_ref());
    let drive = match (rate, pressure) {
        (true, true) => {
            let message = "a rate and a pressure drop are given, and one follows from the other";
            checker.refuse("network.dynamic.pressure-drop", message, "leave one of them out");
            None
        }
        (true, false) => dynamic.rate.map(|rate| Drive::Rate(rate.value())),
        (false, true) => dynamic.pressure_drop.map(Drive::PressureDrop),
        (false, false) => {
            checker.require("network.dynamic.rate", None, "rate = 1.0e-8 # m2/s, or pressure-drop = 500.0 # Pa")
        }
    };
    if raw.outlet.is_none() {
        let message = "a displacement in time needs an outlet: the displaced phase leaves through it";
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
        ("process", is_cycle, "a cycle", "take drainage or imbibition"),
        ("events", raw.events == Some(Events::Burst), "invasion percolation", "leave events out"),
        ("trapping", raw.trapping.is_some(), "a rule for trapping", "leave it out: what cannot flow out is trapped"),
        (
            "films",
            raw.films.is_some_and(|films| films != FilmModel::None),
            "quasi-static corner films",
            "leave films out",
        ),
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
    let largest_step = *dynamic.largest_step.get_or_insert(DEFAULT_LARGEST_STEP);
    let initial_saturation = dynamic.initial_saturation;
    (checker.problems.len() == before).then_some(DynamicDrive { drive: drive?, largest_step, initial_saturation })
}
