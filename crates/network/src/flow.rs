//! Flow through a network: permeability of the pore space, and relative permeabilities of both phases along a displacement.
//!
//! A phase flows through throats between two regions that it holds; menisci block the flow, and films are neglected. With `network.region`
//! both phases pass the manifolds.

use super::cycles::{Cycles, FluidPhase};
use super::displacement::Phase;
use super::film_flow::FilmFlow;
use super::laplacian::FlowError;
use super::model::{Configuration, Model};
use super::permeability::{Drive, Paths, with_films};
use super::tables::numbers;
use meniscus_case::network::FilmModel;
use meniscus_core::table::Table;

/// Number of states of a half cycle, including first and last, at which relative permeabilities are computed.
const STATES: u32 = 9;

/// Permeabilities of random packs are within 5 % of Stokes flow above this solid fraction; below it, errors of other shapes are up to 25 %.
pub(crate) const LEAST_SOLID: f64 = 0.3;

/// The drive of a flow along an axis; `None` if its sides are closed.
pub(crate) fn drive(config: &Configuration, axis: usize) -> Option<Drive> {
    let opens = |side: usize| config.network.openings.iter().any(|opening| opening.side == side);
    if config.periodic[axis] {
        Some(Drive::Periodic(axis))
    } else {
        (opens(2 * axis) && opens(2 * axis + 1)).then_some(Drive::Sides(axis))
    }
}

/// Permeability in m² for a phase in the regions for which `holds` is true, and in these films.
fn of_phase(model: &Model, drive: Drive, holds: &[bool], films: &FilmFlow) -> Result<f64, FlowError> {
    let config = &model.config;
    let is_open = |regions: [usize; 2]| regions.iter().all(|&region| holds[region]);
    let conductance: Vec<f64> = config
        .network
        .throats
        .iter()
        .zip(model.conductances())
        .map(|(throat, &conductance)| if is_open(throat.regions) { conductance } else { 0.0 })
        .collect();
    with_films(&config.network, Paths { conductance: &conductance, holds }, &films.0, config.bounds, drive)
}

/// Permeability of the whole pore space along an axis in m²; NaN if its sides are closed or the flow cannot be solved.
pub(crate) fn along(model: &Model, axis: usize) -> f64 {
    let everywhere = || vec![true; model.config.network.regions.len()];
    let find = || {
        drive(&model.config, axis).and_then(|drive| of_phase(model, drive, &everywhere(), &FilmFlow::default()).ok())
    };
    *model.config.derived.permeabilities[axis].get_or_init(|| find().unwrap_or(f64::NAN))
}

/// For each region whether the wetting phase holds most of it after the invasions of the last half cycle up to this displaced share, and the saturation.
fn wetting_regions(config: &Configuration, cycles: &Cycles, displaced: f64) -> (Vec<bool>, f64) {
    let invading = cycles.half_cycle().invading;
    let regions = config.network.regions.len();
    let (mut wetting, mut all) = (vec![0.0; regions], vec![0.0; regions]);
    let counted = &cycles.counted;
    let mut counted_wetting = 0.0;
    for (index, element) in cycles.displacement.elements().iter().enumerate() {
        let is_invaded = match &cycles.record.invasions[index] {
            Some(invasion) => invasion.displaced <= displaced,
            None => cycles.displacement.phase(index) == Phase::Invading,
        };
        all[element.region] += element.area;
        if is_invaded == (invading == FluidPhase::Wetting) {
            wetting[element.region] += element.area;
            counted_wetting += counted.areas[index];
        }
    }
    let saturation = match config.region {
        Some(_) => counted_wetting / counted.sum,
        None => wetting.iter().sum::<f64>() / all.iter().sum::<f64>(),
    };
    (wetting.iter().zip(&all).map(|(wetting, all)| *wetting > 0.5 * all).collect(), saturation)
}

/// Relative permeabilities from inlet to outlet along the last half cycle: rows of wetting saturation, k_r of wetting and non-wetting phase.
fn relative(model: &Model, states: &[f64]) -> Vec<[f64; 3]> {
    let config = &model.config;
    let drive = config.inlet.and_then(|inlet| drive(config, inlet / 2));
    let (Some(cycles), Some(drive)) = (model.cycles.as_ref(), drive) else { return Vec::new() };
    let whole = along(model, config.inlet.unwrap_or_default() / 2);
    if !(whole > 0.0) {
        return Vec::new();
    }
    let displaced = cycles.record.invasions.iter().flatten().map(|invasion| invasion.displaced).fold(0.0, f64::max);
    // The initial filling counts as displaced; before it, nothing is.
    let at = |share: &f64| if *share > 0.0 { share * displaced } else { -1.0 };
    let state = |displaced: f64| {
        let (wetting, saturation) = wetting_regions(config, cycles, displaced);
        let other: Vec<bool> = wetting.iter().map(|wetting| !wetting).collect();
        let [wetting, other] = [wetting, other].map(|holds| with_manifolds(config, holds));
        let films = film_flow(config, cycles, displaced, &wetting, drive);
        // The flow of a phase that does not percolate is rounding error.
        const ROUNDING: f64 = 1.0e-12;
        let ratio = |(holds, films): (Vec<bool>, &FilmFlow)| {
            if films.is_empty() && holds.iter().all(|&holds| holds) {
                return 1.0;
            }
            of_phase(model, drive, &holds, films).unwrap_or(f64::NAN) / whole
        };
        let none = FilmFlow::default();
        // Together both phases have the conductors of one.
        let (wetting, other) = rayon::join(|| ratio((wetting, &films)), || ratio((other, &none)));
        let [wetting, other] = [wetting, other].map(|ratio| if ratio < ROUNDING { 0.0 } else { ratio });
        [saturation, wetting, other]
    };
    states.iter().map(at).map(state).collect()
}

/// The films at the pressure after the invasions of the last half cycle up to this displaced share; none before the first one.
fn film_flow(config: &Configuration, cycles: &Cycles, displaced: f64, holds: &[bool], drive: Drive) -> FilmFlow {
    let half = cycles.half_cycle();
    let Some(terms) = half.films.as_ref().filter(|_| half.film_model == FilmModel::Rings) else {
        return FilmFlow::default();
    };
    let invasions = cycles.record.invasions.iter().flatten().filter(|invasion| invasion.displaced <= displaced);
    let farther = if half.invading == FluidPhase::Wetting { f64::min } else { f64::max };
    let applied = invasions.map(|invasion| invasion.applied).filter(|applied| applied.is_finite()).reduce(farther);
    applied.map_or_else(FilmFlow::default, |applied| {
        let curvature = config.curvature(half.invading, applied);
        FilmFlow::new(&config.network, holds, terms, curvature, (config.bounds, drive))
    })
}

/// With `network.region`, both phases pass the manifolds, which do not count in the saturation.
fn with_manifolds(config: &Configuration, mut holds: Vec<bool>) -> Vec<bool> {
    if config.region.is_some() {
        let ends = config.at_inlet().into_iter().zip(config.at_outlet()).map(|(inlet, outlet)| inlet || outlet);
        holds.iter_mut().zip(ends).for_each(|(holds, is_end)| *holds |= is_end);
    }
    holds
}

/// Wetting saturation and relative permeabilities at present, at the end of the last half cycle; `None` if nothing flows from inlet to outlet.
pub(crate) fn relative_at_end(model: &Model) -> Option<[f64; 3]> {
    let steps = model.cycles.as_ref()?.steps;
    let find = || (steps, relative(model, &[1.0]).first().copied());
    let &(of, found) = model.relative_at_end.get_or_init(find);
    // It may have been asked for before the last step.
    if of == steps { found } else { find().1 }
}

/// `relative_permeability.csv`; `None` if nothing flows from inlet to outlet.
pub(crate) fn table(model: &Model) -> Option<Table> {
    let last = relative_at_end(model)?;
    let states: Vec<f64> = (0..STATES - 1).map(|state| f64::from(state) / f64::from(STATES - 1)).collect();
    let rows = [relative(model, &states), vec![last]].concat();
    let column = |side: usize| rows.iter().map(move |row| row[side]);
    Some(Table {
        name: "relative_permeability",
        columns: vec![
            // Wetting saturation; with [`network.region`](../network/theory.md#a-region) that of the region
            numbers("saturation", column(0)),
            // Permeability of the throats between regions of the wetting phase, and of rings of films, over that of all throats
            numbers("relative_permeability_wetting", column(1)),
            // Permeability of the throats between regions of the non-wetting phase over that of all
            numbers("relative_permeability_non_wetting", column(2)),
        ],
    })
}
