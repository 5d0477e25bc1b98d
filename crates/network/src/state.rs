//! `at-breakthrough.json` and `at-end.json`: states from which a network or a direct simulation of the same geometry can start.

use std::io::{self, Write};

use serde::{Serialize, Serializer};

use super::cycles::{Cycles, HalfCycle};
use super::displacement::{Beginning, Element, Interfaces, Phase, StaticMeniscus};
use super::model::{Configuration, Model};
use super::moment::Moment;
use meniscus_case::FluidPhase;
use meniscus_case::network::state::{ElementState, FORMAT, MeniscusState, NetworkState};
use meniscus_core::table::Document;
use meniscus_geometry::curve::Curve;

const NOTE: &str = "SI units; curvatures above 0 where an interface bulges into the wetting phase: tension times curvature is p_n - p_w; \
                    curves as [x1, y1, x2, y2] or [center x, center y, radius, polar angle of the start, signed angle to the end]";

/// The same for a chip.
const NOTE_OF_CHIP: &str = "SI units; curvatures are those in the plane, above 0 where an interface bulges into the wetting phase: floor and lid add to p_n - p_w; \
                            curves as [x1, y1, x2, y2] or [center x, center y, radius, polar angle of the start, signed angle to the end]";

/// The states at first breakthrough and at the present moment.
pub(crate) fn documents(model: &Model) -> Vec<Document<'_>> {
    let Some(cycles) = &model.cycles else { return Vec::new() };
    let end = Document::new("at-end.json", |to| write(to, &model.config, cycles, &cycles.moment()));
    let at_breakthrough =
        |moment| Document::new("at-breakthrough.json", move |to| write(to, &model.config, cycles, moment));
    cycles.breakthrough().map(at_breakthrough).into_iter().chain([end]).collect()
}

/// Items that are made when they are serialized.
struct Made<F>(F);

impl<F: Fn() -> I, I: Iterator<Item: Serialize>> Serialize for Made<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((self.0)())
    }
}

/// Writes the state at a moment, element by element.
fn write(to: &mut dyn Write, config: &Configuration, cycles: &Cycles, moment: &Moment) -> io::Result<()> {
    let half = &cycles.half_cycles()[moment.half_cycle];
    let (resting, interfaces) = interfaces(config, half, moment);
    let elements = Made(|| elements(half, moment, &interfaces.trapped));
    let outline = Made(|| interfaces.outline.iter().map(Curve::numbers));
    serde_json::to_writer(&mut *to, &described(config, (half, moment), (resting, &interfaces), elements, outline))?;
    to.write_all(b"\n")
}

/// The state at a moment.
pub fn state(config: &Configuration, half_cycles: &[HalfCycle], moment: &Moment) -> NetworkState {
    let half = &half_cycles[moment.half_cycle];
    let (resting, interfaces) = interfaces(config, half, moment);
    let elements = elements(half, moment, &interfaces.trapped).collect();
    let outline = interfaces.outline.iter().map(Curve::numbers).collect();
    described(config, (half, moment), (resting, &interfaces), elements, outline)
}

/// The curvature in 1/m at which menisci rest at a moment, and all interfaces.
fn interfaces(config: &Configuration, half: &HalfCycle, moment: &Moment) -> (f64, Interfaces) {
    // Before the first event menisci are as flat as their walls allow.
    let largest = moment.applied.map_or(0.0, |applied| half.invading.towards_wetting(applied));
    let resting = moment.displacement.resting_curvature(largest);
    (resting, moment.displacement.interfaces(resting, config.bounds, config.periodic))
}

fn described<E, O>(
    config: &Configuration,
    (half, moment): (&HalfCycle, &Moment),
    (resting, interfaces): (f64, &Interfaces),
    elements: E,
    outline: O,
) -> NetworkState<E, O> {
    let displacement = &moment.displacement;
    let applied = half.invading.towards_wetting(resting);
    let pore_area: f64 = displacement.elements().iter().map(|element| element.area).sum();
    let invading = interfaces.area.map(|area| area / pore_area);
    let angle = |angle: &f64| {
        if half.invading == FluidPhase::Wetting { 180.0 - angle.to_degrees() } else { angle.to_degrees() }
    };
    let angles = || half.conditions.angle.iter().map(angle);
    NetworkState {
        format: FORMAT,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        note: if config.depth.is_some() { NOTE_OF_CHIP } else { NOTE }.to_owned(),
        geometry_hash: config.geometry_hash.clone(),
        domain_m: [config.bounds.min.into(), config.bounds.max.into()],
        sides: config.sides,
        invading: half.invading,
        half_cycle: moment.half_cycle + 1,
        events: moment.events,
        tension_n_per_m: config.tension.unwrap_or(f64::NAN),
        applied_curvature_per_m: applied,
        capillary_pressure_pa: config.pressure(half.invading, applied),
        largest_applied_curvature_per_m: moment.applied,
        contact_angles_deg: [angles().fold(f64::INFINITY, f64::min), angles().fold(f64::NEG_INFINITY, f64::max)],
        saturation: moment.saturation,
        saturation_with_menisci: invading.map(|share| half.invading.saturation(share)),
        elements,
        menisci: interfaces.menisci.iter().map(|one| meniscus(half, one)).collect(),
        snapped_throats: displacement.closed_throats(),
        invading_outline: outline,
    }
}

fn elements<'a>(
    half: &'a HalfCycle,
    moment: &'a Moment,
    trapped: &'a [f64],
) -> impl Iterator<Item = ElementState> + 'a {
    let displacement = &moment.displacement;
    let element = move |(index, element): (usize, &Element)| {
        let trapped_at = trapped[index];
        ElementState {
            phase: match displacement.phase(index) {
                Phase::Invading => half.invading,
                Phase::Defending => half.invading.other(),
            },
            trapped: displacement.is_trapped(index),
            trapped_curvature_per_m: trapped_at.is_finite().then(|| half.invading.towards_wetting(trapped_at)),
            area_m2: element.area,
            boundary: displacement.boundary(index).iter().map(Curve::numbers).collect(),
        }
    };
    displacement.elements().iter().enumerate().map(element)
}

fn meniscus(half: &HalfCycle, meniscus: &StaticMeniscus) -> MeniscusState {
    MeniscusState {
        between: meniscus.between,
        curvature_per_m: meniscus.curvature.map(|curvature| half.invading.towards_wetting(curvature)),
        contacts_m: [meniscus.curve.point(0.0).into(), meniscus.curve.point(1.0).into()],
        bend_rad: meniscus.bend,
        swept_area_m2: meniscus.swept,
    }
}

/// The phases of a saved state for a half cycle with invasion by `invading`.
pub(crate) fn beginning(state: &NetworkState, invading: FluidPhase) -> Beginning {
    let is_same = state.invading == invading;
    let sign = if invading == FluidPhase::NonWetting { 1.0 } else { -1.0 };
    let largest = state.largest_applied_curvature_per_m.map(|applied| sign * applied);
    // After invasion by the other phase, its elements keep the last curvature.
    let held = |element: &ElementState| match element.trapped_curvature_per_m {
        Some(curvature) => sign * curvature,
        None if is_same => f64::NAN,
        None => sign * state.applied_curvature_per_m,
    };
    Beginning {
        invaded: state.elements.iter().map(|element| element.phase == invading).collect(),
        applied: largest.filter(|_| is_same).unwrap_or(f64::NEG_INFINITY),
        held: state.elements.iter().map(held).collect(),
        closed: state.snapped_throats.clone(),
    }
}
