//! The network for VTK: pores as points, throats as lines, regions as polygons, menisci as lines.

use super::cycles::{FluidPhase, Invasion};
use super::displacement::Division;
use super::model::{Configuration, Model};
use super::occupation::Occupation;
use super::pictures;
use super::summary::pore_states;
use super::tables::{arms, center, kept, length, pores_of, radius};
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{CellKind, Field, Layer, Lines, Outlines, Vertices};

/// Sequence number of elements that no event filled.
const NOT_INVADED: i64 = -1;

/// Phase numbers as in all other files: 0 wetting, 1 non-wetting.
fn phase(fluid: FluidPhase) -> i64 {
    i64::from(fluid == FluidPhase::NonWetting)
}

/// Menisci as polylines.
pub(crate) fn menisci(menisci: Vec<Vec<Vec2>>) -> Lines<'static> {
    let (mut points, mut lines) = (Vec::new(), Vec::new());
    for line in menisci {
        let first = points.len() as u32;
        lines.push((first..first + line.len() as u32).collect());
        points.extend(line);
    }
    Lines { points: points.into(), lines, fields: Vec::new() }
}

/// A layer of polygons.
fn polygons(name: &'static str, outlines: Outlines, fields: Vec<Field<'static>>, count: usize) -> Layer<'static> {
    let ends = (0..count).scan(0, |end, cell| {
        *end += outlines.of(cell).len() as u32;
        Some(*end)
    });
    Layer { name, kind: CellKind::Polygons, ends: ends.collect(), vertices: Vertices::Made(outlines), fields }
}

/// The elements, with pore, phase, sequence and capillary pressure at invasion.
pub(crate) fn regions(config: &Configuration, occupation: Option<&Occupation>) -> Layer<'static> {
    let pores = &config.pores;
    let Some(occupation) = occupation else { return plain_regions(config) };
    let elements = occupation.elements();
    let pressure = |invasion: &Invasion| config.pressure(occupation.invading, invasion.applied);
    let invasions = || occupation.invasions.iter();
    let mut fields = vec![
        Field::integer("pore", elements.iter().map(|element| pores.pore_of[element.region] as i64)),
        Field::integer("phase", (0..elements.len()).map(|element| phase(occupation.fluid(element)))),
        Field::scalar("invading-share", "", occupation.share.iter().copied()),
        Field::integer("trapped", occupation.trapped.iter().map(|&trapped| i64::from(trapped))),
        Field::integer("sequence", invasions().map(|it| it.map_or(NOT_INVADED, |invasion| invasion.sequence as i64))),
        Field::scalar(
            "capillary-pressure-at-invasion",
            "Pa",
            invasions().map(|it| it.as_ref().map_or(f64::NAN, pressure)),
        ),
        Field::scalar(
            "displaced-saturation-at-invasion",
            "",
            invasions().map(|it| it.map_or(f64::NAN, |invasion| invasion.displaced)),
        ),
    ];
    if let Some(films) = &occupation.films {
        fields.push(Field::scalar("film-volume", "m3", films.volume.iter().copied()));
    }
    polygons("regions", occupation.displacement.division().outlines(), fields, elements.len())
}

/// The elements with their probability of invasion.
pub(crate) fn invasion(config: &Configuration, division: &Division, probability: &[f64]) -> Layer<'static> {
    let elements = division.elements();
    let fields = vec![
        Field::integer("pore", elements.iter().map(|element| config.pores.pore_of[element.region] as i64)),
        Field::scalar("area", "m2", elements.iter().map(|element| element.area)),
        Field::scalar("invasion-probability", "", probability.iter().copied()),
    ];
    polygons("invasion", division.outlines(), fields, elements.len())
}

fn plain_regions(config: &Configuration) -> Layer<'static> {
    let pores = &config.pores.pore_of;
    let fields = vec![
        Field::integer("pore", pores.iter().map(|&pore| pore as i64)),
        Field::scalar("inscribed-radius", "m", pores.iter().map(|&pore| radius(config, pore))),
    ];
    polygons("regions", pictures::outlines(&config.network), fields, pores.len())
}

/// `pores.vtu`.
pub(crate) fn pores(config: &Configuration, occupation: Option<&Occupation>) -> Layer<'static> {
    let count = config.pores.main_region.len();
    let centers: Vec<Vec2> = (0..count).map(|pore| center(config, pore)).collect();
    let mut fields = vec![
        Field::integer("pore", 0..count as i64),
        Field::scalar("inscribed-radius", "m", (0..count).map(|pore| radius(config, pore))),
        Field::scalar("area", "m2", config.pores.area.iter().copied()),
    ];
    if let Some(occupation) = occupation {
        let states = pore_states(config, occupation);
        fields.extend([
            Field::integer("phase", states.iter().map(|state| phase(state.fluid))),
            Field::integer("trapped", states.iter().map(|state| i64::from(state.is_trapped))),
            Field::integer(
                "sequence",
                states.iter().map(|state| state.invasion.map_or(NOT_INVADED, |invasion| invasion.sequence as i64)),
            ),
        ]);
    }
    let vertices = Vertices::Given(centers.into());
    Layer { name: "pores", kind: CellKind::Points, vertices, ends: (1..=count as u32).collect(), fields }
}

/// `throats.vtu`: two lines per throat, from the pore centers to the middle of the throat.
pub(crate) fn throats(model: &Model) -> Layer<'static> {
    let config = &model.config;
    let of_arms = |throat| arms(config, throat).map(|to_center| [throat.middle() + to_center, throat.middle()]);
    let vertices: Vec<Vec2> = kept(config).flat_map(of_arms).flatten().collect();
    let ends = (2..=vertices.len() as u32).step_by(2).collect();
    let both = || kept(config).flat_map(|throat| [throat, throat]);
    let mut fields = vec![
        Field::integer("throat", (0..config.pores.throats.len() as i64).flat_map(|throat| [throat, throat])),
        Field::integer("pore-1", both().map(|throat| pores_of(config, throat)[0] as i64)),
        Field::integer("pore-2", both().map(|throat| pores_of(config, throat)[1] as i64)),
        Field::scalar("width", "m", both().map(|throat| throat.width)),
        Field::scalar("length", "m", both().map(|throat| length(config, throat))),
    ];
    if let Some(pressures) = model.entry_pressures() {
        let both = config.pores.throats.iter().flat_map(|&throat| [pressures[throat]; 2]);
        fields.push(Field::scalar("entry-pressure", "Pa", both));
    }
    Layer { name: "throats", kind: CellKind::Lines, vertices: Vertices::Given(vertices.into()), ends, fields }
}
