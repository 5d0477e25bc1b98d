//! Both displacements side by side: the results of each, and at equal saturations.

use std::sync::atomic::AtomicBool;

use super::comparison::{AtSaturation, Comparison, Side};
use super::pair::{CompareError, Pair, Task};
use super::picture::Maps;
use super::track::{Grid, Record, Track};
use super::{direct, network, picture, rank};
use crate::run::setup::{self, SetupError};
use crate::run::simulation::Watcher;
use meniscus_case::network::state::NetworkState;
use meniscus_case::network::{FilmModel, NetworkResults, PoreNetwork};
use meniscus_case::{Case, FluidPhase, Model};
use meniscus_core::solver::Solver;
use meniscus_geometry::elements::Elements;
use meniscus_network::solver::NetworkSolver;

/// Saturations at which both are drawn.
const PICTURES: usize = 4;

/// Whether two cases can be compared.
pub(crate) fn check(pair: &Pair<'_>) -> Result<(), CompareError> {
    fitting(pair).map(|_| ())
}

/// Runs both cases and compares them. `interrupt` stops the direct simulation after the present step, which is reported to `watcher`; it can be resumed. The
/// network is run again: it takes seconds.
pub(crate) fn compare(
    task: &Task<'_>,
    interrupt: &AtomicBool,
    watcher: &mut dyn Watcher,
) -> Result<Comparison, CompareError> {
    let pair = &task.pair;
    let (mut solver, state) = fitting(pair)?;
    let boundaries = state.elements.iter().map(|element| NetworkState::curves(&element.boundary)).collect();
    let elements = Elements::new(boundaries, state.images());
    let bounds = setup::geometry(pair.network)?.bounds();
    let grid = Grid::new(bounds, &elements);
    let by_network = match &pair.network.model {
        Model::Network(wanted) if pair.is_in_time() => {
            network::track_in_time(pair.network, wanted, &grid, pair.direct.end, pair.records)?
        }
        _ => network::track(&mut solver, &grid)?,
    };
    let by_direct = direct::track(task, &state, &grid, interrupt, watcher)?;
    let outlet = network::outlet_elements(&state);
    let outline = solver.outline();
    Ok(Comparison {
        titles: [pair.network.title.clone(), pair.direct.title.clone()],
        network: side(&by_network, &outlet, pair.is_in_time(), state.invading),
        direct: side(&by_direct, &outlet, pair.is_in_time(), state.invading),
        is_in_time: pair.is_in_time(),
        ..compared(&by_network, &by_direct, &Maps { grid: &grid, outline: &outline, invading: state.invading })
    })
}

/// The network and its first state, if the direct simulation has the same shapes and sides.
fn fitting(pair: &Pair<'_>) -> Result<(NetworkSolver, NetworkState), CompareError> {
    let Model::Network(wanted) = &pair.network.model else { return Err(CompareError::NoNetwork) };
    if wanted.region.is_some() {
        return Err(CompareError::Region);
    }
    let Model::Sph(sph) = &pair.direct.model else { return Err(CompareError::NoDirect) };
    if sph.non_wetting.is_none() {
        return Err(CompareError::NoDirect);
    }
    let solver =
        meniscus_network::setup::build_quasi_static(pair.network, &comparable(wanted)).map_err(SetupError::from)?;
    let state = network::state(&solver).ok_or(CompareError::NoNetwork)?;
    if let Some(misfit) = state.misfit(&pair.direct.geometry) {
        return Err(CompareError::OtherGeometry(misfit));
    }
    if pair.network.depth != pair.direct.depth {
        let text = |case: &Case| case.depth.map_or("no depth".to_owned(), |depth| format!("a depth of {depth:e} m"));
        let misfit = format!("the network has {}, and the direct simulation {}", text(pair.network), text(pair.direct));
        return Err(CompareError::OtherGeometry(misfit));
    }
    if let Some((side, misfit)) = state.misfit_of_sides(&sph.sides) {
        return Err(CompareError::OtherSides { side, misfit });
    }
    Ok((solver, state))
}

/// The same network without a displacement in time: it has the same elements.
fn comparable(wanted: &PoreNetwork) -> PoreNetwork {
    let mut wanted = PoreNetwork { results: NetworkResults::All, ..wanted.clone() };
    if let Some(displacement) = &mut wanted.displacement {
        displacement.dynamic = None;
        displacement.films = Some(FilmModel::None);
    }
    wanted
}

fn side(track: &Track, outlet: &[usize], is_in_time: bool, invading: FluidPhase) -> Side {
    let pressures: Vec<Option<f64>> =
        track.records.iter().map(|it| Some(it.pressure).filter(|p| p.is_finite())).collect();
    let common =
        Side { saturation: track.records.iter().map(|record| record.saturation).collect(), ..track.totals.clone() };
    if is_in_time {
        return Side {
            time_s: track.records.iter().map(|record| record.time).collect(),
            pressure_difference_pa: pressures,
            breakthrough_time_s: track.breakthrough.map(|[time, _]| time),
            saturation_at_breakthrough: track.breakthrough.map(|[_, saturation]| saturation),
            no_breakthrough: track.breakthrough.is_none().then(|| until_the_end(track)),
            ..common
        };
    }
    let through = outlet.iter().filter_map(|&element| track.filled[element]).min().filter(|&record| record > 0);
    // The extreme pressure: p_n - p_w rises in a drainage and falls in an imbibition.
    let farther = match invading {
        FluidPhase::NonWetting => f64::max,
        FluidPhase::Wetting => f64::min,
    };
    let until = through.map(|record| track.records[..=record].iter().map(|it| it.pressure));
    let farthest = until.map(|pressures| pressures.fold(f64::NAN, farther)).filter(|pressure| pressure.is_finite());
    let no_breakthrough = match (through, farthest) {
        (None, _) if outlet.is_empty() => Some("there is no outlet".to_owned()),
        (None, _) => Some(until_the_end(track)),
        (Some(_), None) => Some("no capillary pressure was recorded until then".to_owned()),
        (Some(_), Some(_)) => None,
    };
    Side {
        no_breakthrough,
        capillary_pressure_pa: pressures,
        breakthrough_pressure_pa: farthest,
        saturation_at_breakthrough: through.map(|record| invading.saturation(track.records[record].saturation)),
        ..common
    }
}

/// What a displacement lacks that ends before its breakthrough.
fn until_the_end(track: &Track) -> String {
    let Some(last) = track.records.last() else { return "there is no record".to_owned() };
    let end = if last.time.is_finite() { format!("at {:.4e} s", last.time) } else { "at its last event".to_owned() };
    format!(
        "the invading phase had not filled a pore at the outlet {end}, with a wetting saturation of {:.3}",
        last.saturation
    )
}

/// Results from both together; the sides are filled in later.
fn compared(network: &Track, direct: &Track, maps: &Maps<'_>) -> Comparison {
    let nearest = |track: &Track, saturation: f64| {
        let off = |record: &Record| (record.saturation - saturation).abs();
        (0..track.records.len()).min_by(|&a, &b| off(&track.records[a]).total_cmp(&off(&track.records[b]))).unwrap_or(0)
    };
    let overlap = |i: usize, j: usize| rank::overlap(&network.records[i].invaded, &direct.records[j].invaded);
    let ends = |track: &Track| {
        let all = || track.records.iter().map(|record| record.saturation);
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    };
    let ([a, b], [c, d]) = (ends(network), ends(direct));
    let (low, high) = (a.max(c), b.min(d));
    let has_range = high > low;
    let targets = (1..=PICTURES).map(|k| high - (high - low) * k as f64 / PICTURES as f64).filter(|_| has_range);
    let at_equal_saturation = targets
        .map(|saturation| {
            // The direct simulation has more states: the one nearest to that of the network.
            let i = nearest(network, saturation);
            let j = nearest(direct, network.records[i].saturation);
            let (one, other) = (&network.records[i], &direct.records[j]);
            let saturation = [one.saturation, other.saturation];
            let picture = picture::svg(maps, [&one.invaded, &other.invaded], saturation);
            AtSaturation { saturation, overlap: overlap(i, j), picture }
        })
        .collect();
    let both: Vec<[usize; 2]> = network
        .filled
        .iter()
        .zip(&direct.filled)
        .filter_map(|(one, other)| Some([(*one)?, (*other)?]))
        .filter(|both| both.iter().all(|&record| record > 0))
        .collect();
    let in_range = |record: &&Record| has_range && (low..=high).contains(&record.saturation);
    let overlaps: Vec<f64> = direct
        .records
        .iter()
        .filter(in_range)
        .map(|record| rank::overlap(&network.records[nearest(network, record.saturation)].invaded, &record.invaded))
        .collect();
    Comparison {
        titles: Default::default(),
        network: Side::default(),
        direct: Side::default(),
        is_in_time: false,
        rank_correlation: rank::correlation(&both),
        elements_in_both: both.len(),
        mean_overlap: (!overlaps.is_empty()).then(|| overlaps.iter().sum::<f64>() / overlaps.len() as f64),
        at_equal_saturation,
    }
}
