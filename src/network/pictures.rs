//! Data of the capillary pressure curve and the maps of a network.

use super::cycles::{Cycles, Entry, FluidPhase};
use super::displacement::Element;
use super::model::{Configuration, Model};
use super::occupation::Occupation;
use super::tables::{kept, radius};
use crate::case::Side;
use crate::diagram::{Area, Color, Diagram, Frame, RegionMap, Stroke, Through, Tone, Trace, colors};
use crate::math::Vec2;

/// Least length of steps of the curve that are drawn, over that of an axis.
const FINEST: f64 = 1.0e-3;

/// Pressure in Pa above which axes are in kPa.
const KILO: f64 = 2.0e3;

/// Colors of phases: invading in this half cycle or before, displaced, and trapped.
struct Look {
    color: Color,
    trapped: (&'static str, Color),
    in_order: (&'static str, &'static [Color]),
    before: &'static str,
}

const LOOKS: [Look; 2] = [
    Look {
        color: colors::WETTING,
        trapped: ("wetting, trapped", colors::WETTING_TRAPPED),
        in_order: ("wetting, displaced share at invasion", colors::WETTING_IN_ORDER),
        before: "wetting before",
    },
    Look {
        color: colors::NON_WETTING,
        trapped: ("non-wetting, trapped", colors::NON_WETTING_TRAPPED),
        in_order: ("non-wetting, displaced share at invasion", colors::NON_WETTING_IN_ORDER),
        before: "non-wetting before",
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
    let on_curve = cycles.curve().iter().map(|point| config.tension.unwrap_or(f64::NAN) * point.curvature.abs());
    let applied = cycles.history().iter().map(|entry| pressure_at(entry).abs()).chain(on_curve);
    let (label, unit) = if applied.fold(0.0, f64::max) > KILO {
        ("capillary pressure p_n - p_w in kPa", 1.0e-3)
    } else {
        ("capillary pressure p_n - p_w in Pa", 1.0)
    };
    let mut traces: Vec<Trace> = Vec::new();
    for (index, outcome) in cycles.outcomes().iter().enumerate() {
        let name = process_name(cycles, index);
        let last = traces.last().and_then(|trace| trace.points.last().copied());
        if cycles.has_films() {
            let of_half = cycles.curve().iter().filter(|point| point.half_cycle == index);
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
fn process_name(cycles: &Cycles, index: usize) -> String {
    const ORDERS: [&str; 2] = ["primary", "secondary"];
    let (process, number) = (cycles.half_cycles()[index].name(), index / 2);
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

fn pair(point: Vec2) -> [f64; 2] {
    point.into()
}

/// All periodic images of a line or an outline that overlap the domain.
fn images(config: &Configuration, line: &[Vec2]) -> Vec<Vec<[f64; 2]>> {
    let domain = config.bounds;
    let ends = line.iter().fold(None, |ends: Option<[Vec2; 2]>, point| {
        Some(ends.map_or([*point; 2], |[low, high]| [low.inf(point), high.sup(point)]))
    });
    let Some([low, high]) = ends else { return Vec::new() };
    let shifts = [0, 1].map(|axis| {
        let size = domain.size()[axis];
        if !config.periodic[axis] || !(size > 0.0) {
            return vec![0.0];
        }
        let first = ((domain.min[axis] - high[axis]) / size).ceil() as i32;
        let last = ((domain.max[axis] - low[axis]) / size).floor() as i32;
        (first..=last).map(|periods| f64::from(periods) * size).collect()
    });
    let moved = |x: f64, y: f64| line.iter().map(|point| pair(point + Vec2::new(x, y))).collect();
    shifts[0].iter().flat_map(|&x| shifts[1].iter().map(move |&y| (x, y))).map(|(x, y)| moved(x, y)).collect()
}

/// The maps: the order of invasion, or without a displacement the pores by size.
pub(crate) fn region_maps(config: &Configuration, occupation: Option<&Occupation>) -> Vec<RegionMap> {
    vec![occupation.map_or_else(|| sizes(config), |occupation| order(config, occupation))]
}

fn empty(config: &Configuration) -> RegionMap {
    let outline = &config.outline;
    let wall =
        |line: &Vec<u32>| line.iter().filter_map(|&i| outline.points.get(i as usize)).copied().map(pair).collect();
    RegionMap {
        name: "network",
        note: String::new(),
        label: "",
        range: [0.0, 1.0],
        classes: Vec::new(),
        bar: colors::SIZES,
        frame: Frame {
            bounds: [pair(config.bounds.min), pair(config.bounds.max)],
            open: config.sides.map(through),
            periodic: config.periodic,
        },
        areas: Vec::new(),
        walls: outline.lines.iter().map(wall).collect(),
        menisci: ("menisci", Vec::new()),
        throats: ("throats", kept(config).flat_map(|throat| images(config, &throat.contacts)).collect()),
        strips: ("films", Vec::new()),
    }
}

/// Direction of flow through a side.
fn through(side: Side) -> Option<Through> {
    match side {
        Side::Inlet => Some(Through::In),
        Side::Outlet => Some(Through::Out),
        _ => None,
    }
}

fn order(config: &Configuration, occupation: &Occupation) -> RegionMap {
    let areas = occupation.elements.iter().enumerate().map(|(index, element)| {
        let is_invaded = occupation.is_invaded(index);
        let tone = match occupation.invasions[index] {
            Some(invasion) if is_invaded => Tone::Value(invasion.displaced),
            _ if occupation.trapped[index] => Tone::Class(1),
            None if is_invaded => Tone::Class(2),
            _ => Tone::Class(0),
        };
        images(config, &element.outline).into_iter().map(move |boundary| Area { boundary, tone })
    });
    let areas: Vec<Area> = areas.flatten().collect();
    let largest = occupation.invasions.iter().flatten().map(|invasion| invasion.displaced).fold(0.0, f64::max);
    let [invading, defending] = [occupation.invading, occupation.invading.other()].map(look);
    let (label, bar) = invading.in_order;
    let menisci = occupation.menisci.iter().flat_map(|line| images(config, line)).collect();
    let all = occupation.films.iter().flat_map(|films| &films.strips);
    let strips = all.flat_map(|(line, width)| images(config, line).into_iter().map(|line| (line, *width)));
    RegionMap {
        name: "invasion",
        note: occupation.note.clone(),
        label,
        bar,
        range: [0.0, if largest > 0.0 { largest } else { 1.0 }],
        classes: vec![
            (occupation.invading.other().name(), defending.color),
            defending.trapped,
            (invading.before, invading.color),
        ],
        areas,
        menisci: ("menisci", menisci),
        strips: ("films", strips.collect()),
        ..empty(config)
    }
}

/// The elements by their probability of invasion.
pub(crate) fn invasion(config: &Configuration, elements: &[Element], probability: &[f64], note: String) -> RegionMap {
    let areas = elements.iter().zip(probability).flat_map(|(element, &probability)| {
        let tone = Tone::Value(probability);
        images(config, &element.outline).into_iter().map(move |boundary| Area { boundary, tone })
    });
    RegionMap {
        name: "invasion-probability",
        note,
        label: "probability of invasion",
        areas: areas.collect(),
        ..empty(config)
    }
}

fn sizes(config: &Configuration) -> RegionMap {
    let pores = &config.pores;
    let areas = config.network.regions.iter().zip(&pores.pore_of).flat_map(|(region, &pore)| {
        let tone = Tone::Value(radius(config, pore));
        let boundaries = images(config, &super::displacement::outline(region));
        boundaries.into_iter().map(move |boundary| Area { boundary, tone })
    });
    let largest = (0..pores.main_region.len()).map(|pore| radius(config, pore)).fold(0.0, f64::max);
    RegionMap {
        name: "pores",
        note: format!("{} pores, {} throats", pores.main_region.len(), pores.throats.len()),
        label: "inscribed radius in m",
        range: [0.0, if largest > 0.0 { largest } else { 1.0 }],
        areas: areas.collect(),
        ..empty(config)
    }
}
