//! Filling of a slit between two open sides by the wetting phase (C5 of the benchmarks).

use super::series::pairs;
use crate::analysis::laws::slit::SlitFilling;
use crate::solver::Measure;
use crate::sph::domain::ImageVelocity;
use crate::sph::flow::Flow;
use crate::sph::measures::{Columns, Group, Subject, measure};
use crate::sph::observe::Observation;
use crate::sph::open::OpenSide;
use crate::sph::particles::Phase;

/// Columns and measures of its table `[sph.measure.slit-filling]`.
pub const GROUP: Group = Group { columns, ..Group::of(measures) };

/// The side that the wetting phase comes in through: the first open one that it stands at or that it enters through.
pub(super) fn entry(flow: &Flow) -> Option<&OpenSide> {
    flow.setting.open.sides.iter().find(|side| side.main == Phase::Wetting)
}

/// Width of the domain across the slit in m.
fn across(flow: &Flow, side: &OpenSide) -> f64 {
    flow.setting.domain.bounds.size()[1 - side.axis()]
}

/// `filled_length_m`: area of the wetting phase over the width.
fn columns(flow: &Flow, seen: &Observation) -> Columns {
    let length = entry(flow).map_or(f64::NAN, |side| seen.areas.wetting / across(flow, side));
    vec![("filled_length_m", length)]
}

/// The exact law of the slit; none where the sides are not those of a slit.
fn law(s: &Subject) -> Option<SlitFilling> {
    let (flow, m) = (s.flow, &s.flow.setting.method);
    let side = entry(flow)?;
    let exit = flow.setting.open.sides.iter().find(|other| other.number != side.number)?;
    let is_half = flow.setting.domain.mirrors.iter().any(|mirror| mirror.image == ImageVelocity::Mirrored);
    let width = across(flow, side) * if is_half { 2.0 } else { 1.0 };
    let capillary = 2.0 * m.tension * m.wetting?.static_angle().cos() / width;
    Some(SlitFilling {
        width,
        length: flow.setting.domain.bounds.size()[side.axis()],
        pressure: capillary + side.given_pressure()? - exit.given_pressure()?,
        densities: [m.wetting_fluid.density, m.other_fluid.density],
        viscosities: [m.wetting_fluid.viscosity, m.other_fluid.viscosity],
        gravity: side.inwards() * m.gravity[side.axis()],
    })
}

fn measures(s: &Subject) -> Vec<Measure> {
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
