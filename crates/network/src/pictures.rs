//! Data of the capillary pressure curve and the maps of a network.

use std::sync::Arc;

use super::cycles::{Cycles, Entry, FluidPhase};
use super::displacement::{Division, outline};
use super::graph::Network;
use super::model::{Configuration, Model};
use super::occupation::Occupation;
use super::region::shifts;
use super::tables::{kept, radius};
use meniscus_case::Side;
use meniscus_core::diagram::{Area, Color, Diagram, Frame, RegionMap, Stroke, Through, Tone, Trace, colors};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_core::snapshot::{Outlined, Outlines};

/// Least length of steps of the curve that are drawn, over that of an axis.
const FINEST: f64 = 1.0e-3;

/// Pressure in Pa above which axes are in kPa.
const KILO: f64 = 2.0e3;

/// Colors of phases: invading in this half cycle or before, displaced, and trapped.
struct Look {
    color: Color,
    trapped: (&'static str, Color),
    in_order: (&'static str, &'static [Color]),
    before: (&'static str, Color),
}

const LOOKS: [Look; 2] = [
    Look {
        color: colors::WETTING,
        trapped: ("wetting, trapped", colors::WETTING_TRAPPED),
        in_order: ("wetting, displaced share at invasion", colors::WETTING_IN_ORDER),
        before: ("wetting before", colors::WETTING_BEFORE),
    },
    Look {
        color: colors::NON_WETTING,
        trapped: ("non-wetting, trapped", colors::NON_WETTING_TRAPPED),
        in_order: ("non-wetting, displaced share at invasion", colors::NON_WETTING_IN_ORDER),
        before: ("non-wetting before", colors::NON_WETTING_BEFORE),
    },
];

fn look(phase: FluidPhase) -> &'static Look {
    &LOOKS[usize::from(phase == FluidPhase::NonWetting)]
}

/// The diagrams of a displacement.
pub(crate) fn diagrams(model: &Model) -> Vec<Diagram> {
    model.cycles.as_ref().and_then(|cycles| capillary_pressure(&model.config, cycles)).into_iter().collect()
}

/// Capillary pressure over the saturation of the wetting phase, a line for each half cycle: the pressure rises at constant saturation
/// and the saturation changes at constant pressure. Each line begins at the end of the previous one, so that cycles form closed loops.
fn capillary_pressure(config: &Configuration, cycles: &Cycles) -> Option<Diagram> {
    config.tension?;
    let pressure_at = |entry: &Entry| config.pressure(cycles.half_cycles()[entry.half_cycle].invading, entry.applied);
    let on_curve = cycles.record.curve.iter().map(|point| config.tension.unwrap_or(f64::NAN) * point.curvature.abs());
    let applied = cycles.history().iter().map(|entry| pressure_at(entry).abs()).chain(on_curve);
    let (label, unit) = if applied.fold(0.0, f64::max) > KILO {
        ("capillary pressure p_n - p_w (kPa)", 1.0e-3)
    } else {
        ("capillary pressure p_n - p_w (Pa)", 1.0)
    };
    let mut traces: Vec<Trace> = Vec::new();
    for (index, outcome) in cycles.record.outcomes.iter().enumerate() {
        let name = process_name(cycles, index);
        let last = traces.last().and_then(|trace| trace.points.last().copied());
        if cycles.has_films() {
            let of_half = cycles.record.curve.iter().filter(|point| point.half_cycle == index);
            let tension = config.tension?;
            let points = of_half.map(|point| [point.saturation, unit * tension * point.curvature]);
            let points = last.into_iter().chain(points).collect();
            traces.push(Trace { name, stroke: Stroke::Full, points });
            continue;
        }
        let entries = cycles.history().iter().filter(|entry| entry.half_cycle == index);
        let mut saturation = outcome.first_saturation[1];
        let mut points: Vec<[f64; 2]> = last.into_iter().collect();
        for entry in entries {
            let pressure = unit * pressure_at(entry);
            if let [end] = points[..] {
                // Elements open at the inlet fill at the first pressure after the reversal.
                points.push([end[0], pressure]);
            }
            points.push([saturation, pressure]);
            points.push([entry.saturation, pressure]);
            saturation = entry.saturation;
        }
        traces.push(Trace { name, stroke: Stroke::Full, points });
    }
    let ends = |side: usize| {
        let values = traces.iter().flat_map(|trace| trace.points.iter().map(move |point| point[side]));
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
    };
    let finest = [0, 1].map(|side| FINEST * (ends(side)[1] - ends(side)[0]));
    traces.iter_mut().for_each(|trace| trace.points = thinned(&trace.points, finest));
    let title = "Capillary pressure over saturation";
    Some(Diagram::linear("capillary-pressure", title, ["saturation of the wetting phase", label], traces))
}

/// Primary drainage, imbibition, secondary drainage and so on in a cycle; for a single half cycle, the process alone.
pub(super) fn process_name(cycles: &Cycles, index: usize) -> String {
    const ORDERS: [&str; 2] = ["primary", "secondary"];
    let (process, number) = (cycles.half_cycles()[index].invading.process(), index / 2);
    match ORDERS.get(number) {
        _ if cycles.half_cycles().len() == 1 => process.to_owned(),
        Some(_) if cycles.half_cycles().len() == 2 && index == 1 => process.to_owned(),
        Some(order) => format!("{order} {process}"),
        None => format!("{process} {}", number + 1),
    }
}

/// A staircase without collinear points and steps too short to be visible; first and last point are kept.
fn thinned(points: &[[f64; 2]], finest: [f64; 2]) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for (index, &point) in points.iter().enumerate() {
        let is_end = index + 1 == points.len();
        let is_visible = |last: &[f64; 2]| (0..2).any(|side| (point[side] - last[side]).abs() > finest[side]);
        if kept.last().is_none_or(is_visible) || is_end {
            // Add the corner of the staircase if both coordinates differ.
            if let Some(&last) = kept.last()
                && last[0] != point[0]
                && last[1] != point[1]
            {
                kept.push([last[0], point[1]]);
            }
            kept.push(point);
        }
    }
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for point in kept {
        if let [.., a, b] = corners[..]
            && (0..2).any(|side| a[side] == b[side] && b[side] == point[side])
        {
            corners.pop();
        }
        corners.push(point);
    }
    corners
}

/// All periodic images of a line or an outline that overlap the domain.
fn images(config: &Configuration, line: &[Vec2]) -> Vec<Vec<[f64; 2]>> {
    let Some(ends) = Bounds::around(line.iter().copied()) else { return Vec::new() };
    let moved = |by: Vec2| line.iter().map(|point| (point + by).into()).collect();
    shifts(ends, config.bounds, config.periods()).into_iter().map(moved).collect()
}

/// The periodic images of all outlines that overlap the domain, each in its tone.
fn areas(config: &Configuration, outlines: &Outlines, tones: impl Iterator<Item = Tone>) -> Vec<Area> {
    let images = |(cell, tone)| {
        let ends = Bounds::around(outlines.of(cell).into_iter());
        let shifts = ends.map_or_else(Vec::new, |ends| shifts(ends, config.bounds, config.periods()));
        shifts.into_iter().map(move |shift| Area { cell, shift, tone })
    };
    tones.enumerate().flat_map(images).collect()
}

impl Outlined for Network {
    fn outline(&self, cell: usize) -> Vec<Vec2> {
        outline(&self.regions[cell])
    }
}

/// The boundaries of the regions of a network.
pub(super) fn outlines(network: &Arc<Network>) -> Outlines {
    Outlines(Arc::clone(network) as _)
}

/// Lines in m.
type Polylines = Vec<Vec<Vec2>>;

/// The map: the order of invasion with its menisci, with the progress as text, or without a displacement the pores by size.
pub(crate) fn region_map(config: &Configuration, occupation: Option<(&Occupation, Polylines, String)>) -> RegionMap {
    occupation
        .map_or_else(|| sizes(config), |(occupation, menisci, progress)| order(config, occupation, &menisci, progress))
}

fn empty(config: &Configuration) -> RegionMap {
    let outline = &config.outline;
    let wall = |line: &Vec<u32>| {
        line.iter().filter_map(|&i| outline.points.get(i as usize)).map(|&point| point.into()).collect()
    };
    RegionMap {
        part: 0,
        note: String::new(),
        label: "",
        range: [0.0, 1.0],
        classes: Vec::new(),
        bar: colors::SIZES,
        frame: Frame {
            bounds: [config.bounds.min.into(), config.bounds.max.into()],
            open: config.sides.map(through),
            periodic: config.periodic,
        },
        areas: Vec::new(),
        outlines: outlines(&config.network),
        walls: outline.lines.iter().map(wall).collect(),
        menisci: ("menisci", Vec::new()),
        throats: ("throats", kept(config).flat_map(|throat| images(config, &throat.contacts)).collect()),
        strips: ("films", colors::WETTING, Vec::new()),
    }
}

/// Direction of flow through a side.
pub(crate) fn through(side: Side) -> Option<Through> {
    match side {
        Side::Inlet => Some(Through::In),
        Side::Outlet => Some(Through::Out),
        _ => None,
    }
}

fn order(config: &Configuration, occupation: &Occupation, menisci: &[Vec<Vec2>], progress: String) -> RegionMap {
    let tones = (0..occupation.elements().len()).map(|index| {
        let is_invaded = occupation.is_invaded(index);
        match occupation.invasions[index] {
            Some(invasion) if is_invaded => Tone::Value(invasion.displaced),
            _ if occupation.trapped[index] => Tone::Class(1),
            None if is_invaded => Tone::Class(2),
            _ => Tone::Class(0),
        }
    });
    let outlines = occupation.displacement.division().outlines();
    let largest = occupation.invasions.iter().flatten().map(|invasion| invasion.displaced).fold(0.0, f64::max);
    let [invading, defending] = [occupation.invading, occupation.invading.other()].map(look);
    let (label, bar) = invading.in_order;
    let menisci = menisci.iter().flat_map(|line| images(config, line)).collect();
    let all = occupation.films.iter().flat_map(|films| &films.strips);
    let strips = all.flat_map(|(line, width)| images(config, line).into_iter().map(|line| (line, *width)));
    // Films are wetting phase that did not come in this half cycle.
    let of_films = if occupation.invading == FluidPhase::Wetting { invading.before.1 } else { defending.color };
    let map = empty(config);
    RegionMap {
        part: occupation.half_cycle,
        note: progress,
        label,
        bar,
        range: [0.0, if largest > 0.0 { largest } else { 1.0 }],
        classes: vec![(occupation.invading.other().name(), defending.color), defending.trapped, invading.before],
        areas: areas(config, &outlines, tones),
        outlines,
        menisci: ("menisci", menisci),
        strips: ("films", of_films, strips.collect()),
        frame: Frame { open: occupation.open, ..map.frame },
        ..map
    }
}

/// The elements by their probability of invasion.
pub(crate) fn invasion(config: &Configuration, division: &Division, probability: &[f64], note: String) -> RegionMap {
    let outlines = division.outlines();
    let areas = areas(config, &outlines, probability.iter().map(|&it| Tone::Value(it)));
    RegionMap { note, label: "probability of invasion", areas, outlines, ..empty(config) }
}

fn sizes(config: &Configuration) -> RegionMap {
    let pores = &config.pores;
    let outlines = outlines(&config.network);
    let tones = pores.pore_of.iter().map(|&pore| Tone::Value(radius(config, pore)));
    let largest = (0..pores.main_region.len()).map(|pore| radius(config, pore)).fold(0.0, f64::max);
    RegionMap {
        note: format!("{} pores, {} throats", pores.main_region.len(), pores.throats.len()),
        label: "inscribed radius in m",
        range: [0.0, if largest > 0.0 { largest } else { 1.0 }],
        areas: areas(config, &outlines, tones),
        outlines,
        ..empty(config)
    }
}
