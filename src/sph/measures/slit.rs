//! Filling of a slit between two open sides by the wetting phase (C5 of the benchmarks), and rise in one (C4).

use super::{Subject, extremum, measure, pairs};
use crate::analysis::laws::slit::SlitFilling;
use crate::math::Vec2;
use crate::solver::Measure;
use crate::sph::domain::ImageVelocity;
use crate::sph::observe::Observation;
use crate::sph::open::OpenSide;
use crate::sph::projection::Flow;

/// The side that the wetting phase comes in through: the first open one that it stands at or that it enters through.
fn entry(flow: &Flow) -> Option<&OpenSide> {
    flow.open.sides.iter().find(|side| side.main == crate::sph::particles::Phase::Wetting)
}

/// Width of the domain across the slit in m.
fn across(flow: &Flow, side: &OpenSide) -> f64 {
    flow.domain.bounds.size()[1 - side.axis()]
}

/// `filled_length_m`: area of the wetting phase over the width.
pub fn filling_columns(flow: &Flow, seen: &Observation) -> Vec<(&'static str, f64)> {
    let length = entry(flow).map_or(f64::NAN, |side| seen.areas.wetting / across(flow, side));
    vec![("filled_length_m", length)]
}

/// `apex_m`: distance of the nearest point of the interface from the side that the wetting phase comes in through.
pub fn rise_columns(flow: &Flow, seen: &Observation) -> Vec<(&'static str, f64)> {
    let apex = entry(flow).map_or(f64::NAN, |side| {
        let points = seen.interface.iter().flat_map(|line| &line.points);
        points.map(|x: &Vec2| -side.beyond(*x)).fold(f64::INFINITY, f64::min)
    });
    vec![("apex_m", apex)]
}

/// The exact law of the slit; none where the sides are not those of a slit.
fn law(s: &Subject) -> Option<SlitFilling> {
    let (flow, m) = (s.flow, &s.flow.method);
    let side = entry(flow)?;
    let exit = flow.open.sides.iter().find(|other| other.number != side.number)?;
    let is_half = flow.domain.mirrors.iter().any(|mirror| mirror.image == ImageVelocity::Mirrored);
    let width = across(flow, side) * if is_half { 2.0 } else { 1.0 };
    let capillary = 2.0 * m.tension * m.wetting?.static_angle().cos() / width;
    Some(SlitFilling {
        width,
        length: flow.domain.bounds.size()[side.axis()],
        pressure: capillary + side.given_pressure()? - exit.given_pressure()?,
        densities: [m.wetting_fluid.density, m.other_fluid.density],
        viscosities: [m.wetting_fluid.viscosity, m.other_fluid.viscosity],
        gravity: side.inwards() * m.gravity[side.axis()],
    })
}

pub fn filling(s: &Subject) -> Vec<Measure> {
    let Some(law) = law(s) else { return vec![] };
    let (times, lengths) = pairs(s.series, "filled_length_m");
    let Some((&first, &last)) = lengths.first().zip(lengths.last()) else { return vec![] };
    let exact = law.lengths(first, &times);
    let way = exact.last().map_or(f64::NAN, |end| end - first);
    let worst = lengths.iter().zip(&exact).map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max);
    let method = "area of the wetting phase over the width; exact: both columns with the friction of a parabola and the static angle";
    vec![
        measure("filled-length-m", last, "m", None, "area of the wetting phase over the width, at the end"),
        measure(
            "filling-ratio",
            (last - first) / way,
            "",
            None,
            &format!("way of the meniscus over the exact one; {method}"),
        ),
        measure(
            "filling-error",
            worst / way,
            "",
            None,
            &format!("largest difference over all records, over the whole way; {method}"),
        ),
    ]
}

pub fn rise(s: &Subject) -> Vec<Measure> {
    let (times, heights) = pairs(s.series, "apex_m");
    let Some(&last) = heights.last() else { return vec![] };
    let turn = |from: usize, sign: f64| {
        let rest = heights.iter().enumerate().skip(from);
        rest.max_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1))).map(|(i, _)| i)
    };
    let peak = turn(0, 1.0).unwrap_or_default();
    let low = turn(peak, -1.0).unwrap_or(peak);
    let [highest, lowest] = [peak, low].map(|row| extremum(&times, &heights, row));
    let method = "the point of the interface that is nearest to the side of entry, over all records, by the parabola through the three records there";
    vec![
        measure("peak-apex-m", highest.value, "m", Some(highest.value_error), &format!("largest distance of {method}")),
        measure(
            "peak-time-s",
            highest.time,
            "s",
            Some(highest.time_error),
            &format!("time of the largest distance of {method}"),
        ),
        measure(
            "minimum-apex-m",
            lowest.value,
            "m",
            Some(lowest.value_error),
            &format!("least distance after the peak of {method}"),
        ),
        measure(
            "minimum-time-s",
            lowest.time,
            "s",
            Some(lowest.time_error),
            &format!("time of the least distance after the peak of {method}"),
        ),
        measure(
            "final-apex-m",
            last,
            "m",
            None,
            "distance of the point of the interface nearest to the side of entry, at the end",
        ),
    ]
}
