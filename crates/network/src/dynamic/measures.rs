//! Measures, events and diagrams of a dynamic displacement.

use super::Drive;
use super::model::DynamicModel;
use crate::cycles::FluidPhase;
use crate::measures::{Costly, of_network};
use crate::tables::{BEGINNING, counts, indices, numbers, numbers_of_throats, words};
use meniscus_core::diagram::{Diagram, Stroke, Trace};
use meniscus_core::solver::{Measure, Series, measure};
use meniscus_core::table::Table;

/// All measures.
pub(crate) fn all(model: &DynamicModel, series: &Series) -> Vec<Measure> {
    let mut found = of_network(&model.quasi_static, Costly::of(&model.quasi_static.config));
    let dynamic = &model.dynamic;
    let terms = dynamic.terms();
    let breakthrough = dynamic.breakthrough();
    let of = |value: fn(&super::Breakthrough) -> f64| breakthrough.as_ref().map_or(f64::NAN, value);
    let reached = if breakthrough.is_some() {
        "when the first meniscus touched the outlet"
    } else {
        "the invading phase did not reach the outlet"
    };
    let pressures = dynamic.history().iter().map(|event| event.pressure).filter(|pressure| pressure.is_finite());
    let largest = pressures.fold(f64::NAN, f64::max);
    let trapped: f64 = dynamic
        .trapped()
        .into_iter()
        .zip(dynamic.displacement().elements())
        .enumerate()
        .filter(|(_, (trapped, _))| *trapped)
        .map(|(index, (_, element))| element.area * (1.0 - dynamic.share(index)))
        .sum();
    let fingers = dynamic.fingers(&model.quasi_static.config);
    let numbers = series.column("capillary_number").filter(|ca| ca.is_finite()).collect::<Vec<_>>();
    let mean = numbers.iter().skip(1).sum::<f64>() / numbers.len().saturating_sub(1) as f64;
    found.extend([
        measure("breakthrough-time-s", of(|it| it.time), "s").by(reached),
        measure("breakthrough-pressure-difference-Pa", of(|it| it.pressure), "Pa")
            .by(format!("pressure at the inlet less that at the outlet, {reached}")),
        measure("largest-pressure-difference-Pa", largest, "Pa")
            .by("largest pressure at the inlet less that at the outlet, at all events"),
        measure("saturation-at-breakthrough", of(|it| it.saturation), "")
            .by(format!("share of the pore space that the invading phase holds, {reached}")),
        measure("injected-pore-volumes", model.injected(), "").by("area that passed the inlet over that of the pores"),
        measure("final-wetting-saturation", model.wetting_saturation(), "")
            .by("share of the pore space that the wetting phase holds at the end"),
        measure("trapped-saturation", trapped / dynamic.pore_area(), "")
            .by("share of the pore space that holds the displaced phase and from which none leads on to the outlet"),
        measure("capillary-number", mean, "").by(
            "viscosity of the invading phase x inflow / (length of the inlet side, or around the inlet disc, x tension), mean over the records",
        ),
        measure("viscosity-ratio", terms.viscosity[0] / terms.viscosity[1], "")
            .by("viscosity of the invading phase over that of the displaced one"),
        measure("finger-width-m", fingers.width, "m")
            .by("mean on 64 lines across the flow, circles about an inlet disc, from the first to the last pore of a finger, solids in it \
                 included"),
        measure("fingers-per-line", fingers.count, "")
            .by("mean number of fingers on the lines that the invading phase has reached"),
        measure("interface-length-m", dynamic.interface_length(), "m")
            .by("sum of the lengths of all menisci at the end"),
        measure("balance-error", dynamic.balance_error(), "")
            .by("area that the invading phase gained less what flowed in and out, over what it holds"),
        measure("events", dynamic.history().len() as f64, "").by("bursts, touches and overlaps"),
        measure("solves-per-event", dynamic.state.solves as f64 / dynamic.history().len().max(1) as f64, "")
            .by("matrices factored and solved with, over the number of events"),
    ]);
    found
}

/// A warning if menisci hold a given pressure drop before breakthrough.
pub(crate) fn at_rest(dynamic: &super::Dynamic) -> Option<String> {
    /// Largest pore volume that would flow in during the time so far.
    const STILL: f64 = 1e-6;
    let (time, (_, inflow)) = (dynamic.time(), dynamic.drive_now());
    let rests = time > 0.0 && dynamic.breakthrough().is_none() && inflow.abs() * time < STILL * dynamic.pore_area();
    match dynamic.terms().drive {
        Drive::PressureDrop(pressure) if rests => Some(format!(
            "the menisci came to rest before breakthrough, with {:.3} of the pore space invaded: they hold the pressure drop of {pressure} Pa; raise it, or, for \
             spontaneous imbibition, give the chip a depth or a smaller angle",
            dynamic.invading_area() / dynamic.pore_area()
        )),
        _ => None,
    }
}

/// A warning if menisci are fast enough to leave films of the wetting phase on floor and lid, which the network neglects.
pub(crate) fn films_left(model: &DynamicModel) -> Option<String> {
    let config = &model.quasi_static.config;
    let depth = config.depth_for(model.invading).filter(|_| model.invading == FluidPhase::NonWetting)?;
    let wetting = model.dynamic.terms().viscosity[1];
    let number = model.capillary_number() * wetting / model.dynamic.terms().viscosity[0];
    depth.film_left(number).map(|film| {
        format!(
            "at Ca = {number:.1e} of the wetting phase and an angle of {:.0} degrees menisci leave films on floor and lid (Bretherton 1961: {film:.1e} of the depth each), \
             which are not modeled: in reality less is displaced",
            depth.wettest().to_degrees()
        )
    })
}

/// `events.csv`.
pub(crate) fn events(model: &DynamicModel) -> Table {
    let pressure =
        |curvature| model.quasi_static.config.pressure(model.invading, model.invading.towards_wetting(curvature));
    let number_of = numbers_of_throats(&model.quasi_static.config);
    let history = || model.dynamic.history().iter();
    let nothing = || std::iter::once(f64::NAN);
    let throats = history().map(|event| event.throat.and_then(|throat| number_of[throat]));
    let saturations = std::iter::once(model.dynamic.first_saturation()).chain(history().map(|event| event.saturation));
    Table {
        name: "events",
        columns: vec![
            // Number of the event, from 1; 0 at the beginning
            counts("sequence", 0..=history().len()),
            // Time
            numbers("time_s", std::iter::once(0.0).chain(history().map(|event| event.time))),
            // `burst`, `touch`, `overlap`; `beginning`: openings of the inlet filled, without a pressure
            words("event", std::iter::once(BEGINNING).chain(history().map(|event| event.kind.name()))),
            // Passed throat; empty within a pore, or for a throat that the merge dissolved
            indices("throat", std::iter::once(None).chain(throats)),
            // Tension times meniscus curvature, positive where the meniscus bulges into the wetting phase
            numbers("meniscus_pressure_Pa", nothing().chain(history().map(|event| pressure(event.curvature)))),
            // Pressure at the inlet minus that at the outlet
            numbers("pressure_difference_Pa", nothing().chain(history().map(|event| event.pressure))),
            // Wetting saturation after the event
            numbers("saturation", saturations.map(|saturation| model.invading.saturation(saturation))),
        ],
    }
}

/// Pressure difference over saturation.
pub(crate) fn diagrams(model: &DynamicModel) -> Vec<Diagram> {
    let history = model.dynamic.history();
    let points =
        history.iter().filter(|event| event.pressure.is_finite()).map(|event| [event.saturation, event.pressure]);
    let traces = vec![Trace { name: "events".to_owned(), stroke: Stroke::Full, points: points.collect() }];
    let labels = ["saturation of the invading phase", "pressure at the inlet less that at the outlet (Pa)"];
    vec![Diagram::linear("pressure-difference", "Pressure difference at each event", labels, traces)]
}
