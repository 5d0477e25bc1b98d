//! A network and a direct simulation of one geometry, side by side.
//!
//! Both are cases of their own. The network goes from event to event, the direct simulation from record to record. At equal saturations the elements
//! that each has filled are held against each other, cell by cell on one grid; so are the pressures, the order in which elements were filled, and
//! what both took. Of a network its first half cycle counts.

mod direct;
mod execute;
mod files;
mod measures;
mod network;
mod page;
mod picture;
mod rank;
mod states;

use std::path::Path;
use std::sync::atomic::AtomicBool;

use serde::Serialize;

pub(crate) use self::direct::RUN as DIRECT_RUN;
pub(crate) use self::execute::{ExecuteError, execute};
pub(crate) use self::files::{CURVES, PAGE, write};
pub(super) use self::network::outlet_elements;
use crate::case::network::state::NetworkState;
use crate::case::{Case, Model};
use crate::geometry::elements::Elements;
use crate::input::Problem;
use crate::math::{Bounds, Vec2};
use crate::network::solver::NetworkSolver;
use crate::run::execute::{Mode, RunError};
use crate::run::setup::{self, SetupError};
use crate::run::simulation::Watcher;
use crate::solver::SolverError;

/// Saturations at which both are drawn.
const PICTURES: usize = 4;
/// Cells along the longer side of the domain on which phases are compared.
const CELLS: f64 = 240.0;

/// A network and a direct simulation that are compared.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<'a> {
    /// The case of the network.
    pub network: &'a Case,
    /// The case of the direct simulation.
    pub direct: &'a Case,
    /// Number of compared states of the direct simulation.
    pub records: usize,
}

/// A comparison in a folder.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Task<'a> {
    /// Both cases.
    pub(crate) pair: Pair<'a>,
    /// The case file of the direct simulation with all that was filled in.
    pub(crate) resolved: &'a str,
    /// The folder, which exists.
    pub(crate) folder: &'a Path,
    /// Whether the direct simulation is begun or taken up.
    pub(crate) mode: Mode,
}

/// One of both cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Of {
    /// That of the network.
    Network,
    /// That of the direct simulation.
    Direct,
}

/// Two cases that cannot be compared, or a run that failed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CompareError {
    /// The first case is no network with a displacement.
    #[error("expected a network with a displacement; give the case [network] with an inlet")]
    NoNetwork,
    /// The second case is no direct simulation of two fluids.
    #[error("expected a direct simulation of two fluids; give the case [sph] with both phases")]
    NoDirect,
    /// The cases have different geometries.
    #[error("the cases are not of one geometry: {0}; let both name the same shape file")]
    OtherGeometry(String),
    /// The cases have different sides.
    #[error(
        "the cases differ in the side `{side}`: of the network {misfit}; walls and periodic sides must be the same"
    )]
    OtherSides {
        /// The side.
        side: &'static str,
        /// What is different.
        misfit: String,
    },
    /// A case cannot be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The network failed.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// The direct simulation failed.
    #[error("{0}")]
    Failed(String),
    /// It was asked to stop, and can be taken up.
    #[error("interrupted")]
    Interrupted,
    /// The folder of the direct simulation, or a file in it.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl CompareError {
    /// What is wrong with which of both cases, at the keys that a user would change; none where a run failed or was stopped.
    pub(crate) fn problems(&self) -> Option<(Of, Vec<Problem>)> {
        let direct = |key: &str| Some((Of::Direct, vec![Problem::of_text(key, &self.to_string())]));
        match self {
            Self::NoNetwork => Some((Of::Network, vec![Problem::of_text("network", &self.to_string())])),
            Self::NoDirect => direct("sph"),
            Self::OtherGeometry(_) => direct("geometry"),
            Self::OtherSides { side, .. } => direct(&format!("sph.sides.{side}")),
            Self::Setup(misfit @ SetupError::Network(_)) => Some((Of::Network, misfit.problems())),
            Self::Setup(misfit) => Some((Of::Direct, misfit.problems())),
            Self::Solver(_) | Self::Failed(_) | Self::Interrupted | Self::Run(_) => None,
        }
    }
}

/// A state of one of both: where the curve stands, and which cells hold the invading phase.
#[derive(Debug, Clone)]
struct Record {
    /// Saturation of the wetting phase.
    saturation: f64,
    /// Capillary pressure p_n - p_w in Pa; NaN where there is none.
    pressure: f64,
    /// For each cell of the pore whether it holds the invading phase.
    invaded: Vec<bool>,
}

/// One of both through its displacement.
#[derive(Debug, Clone)]
struct Track {
    records: Vec<Record>,
    /// For each element the record at which the invading phase came to hold more than half of it.
    filled: Vec<Option<usize>>,
    wall_time_s: f64,
    processor_time_s: Option<f64>,
    unknowns: usize,
    steps: u64,
    permeability: Option<f64>,
    warnings: Vec<String>,
}

/// The cells on which both are compared.
struct Grid {
    bounds: Bounds,
    counts: [usize; 2],
    /// Indices of the cells whose middles lie in the pore, row by row, and the element that each lies in.
    cells: Vec<(usize, usize)>,
}

impl Grid {
    fn new(bounds: Bounds, elements: &Elements) -> Self {
        let size = bounds.size();
        let counts = [0, 1].map(|axis| (CELLS * size[axis] / size.max()).ceil().max(1.0) as usize);
        let mut grid = Self { bounds, counts, cells: Vec::new() };
        grid.cells =
            (0..counts[0] * counts[1]).filter_map(|cell| Some((cell, elements.at(grid.middle(cell))?))).collect();
        grid
    }

    fn middle(&self, cell: usize) -> Vec2 {
        let place = Vec2::new((cell % self.counts[0]) as f64 + 0.5, (cell / self.counts[0]) as f64 + 0.5);
        self.bounds.min + self.cell().component_mul(&place)
    }

    /// Width and height of a cell in m.
    fn cell(&self) -> Vec2 {
        self.bounds.size().component_div(&Vec2::new(self.counts[0] as f64, self.counts[1] as f64))
    }
}

/// What came out of one of both.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(crate) struct Side {
    /// Saturations of the wetting phase.
    pub saturation: Vec<f64>,
    /// Capillary pressures p_n - p_w in Pa at them; none where there is no pressure.
    pub capillary_pressure_pa: Vec<Option<f64>>,
    /// The largest capillary pressure until the invading phase reached the outlet, in Pa, where it did.
    pub breakthrough_pressure_pa: Option<f64>,
    /// Saturation then.
    pub saturation_at_breakthrough: Option<f64>,
    /// Permeability along x in m²; none where it is not measured.
    pub permeability_m2: Option<f64>,
    /// Wall time in s.
    pub wall_time_s: f64,
    /// Processor time in s over all threads; none where the system does not tell.
    pub processor_time_s: Option<f64>,
    /// Pores, or particles.
    pub unknowns: usize,
    /// Events, or time steps.
    pub steps: u64,
    /// What a reader must know before trusting it.
    pub warnings: Vec<String>,
}

/// Both at one saturation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct AtSaturation {
    /// Saturations of the network and of the direct simulation.
    pub(crate) saturation: [f64; 2],
    /// Area that both have invaded over the area that either has.
    pub(crate) overlap: f64,
    /// The picture as SVG.
    #[serde(skip)]
    pub(crate) picture: String,
}

/// The comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Comparison {
    /// Titles of both cases.
    pub(crate) titles: [String; 2],
    /// The network.
    pub(crate) network: Side,
    /// The direct simulation.
    pub(crate) direct: Side,
    /// Spearman's rank correlation of the order in which elements were filled that both filled after the beginning; none for fewer than three.
    pub(crate) rank_correlation: Option<f64>,
    /// Number of these elements.
    pub(crate) elements_in_both: usize,
    /// Mean of the overlaps at all records of the direct simulation.
    pub(crate) mean_overlap: Option<f64>,
    /// Both at equal saturations.
    pub(crate) at_equal_saturation: Vec<AtSaturation>,
}

/// Whether two cases can be compared.
pub(crate) fn check(pair: &Pair<'_>) -> Result<(), CompareError> {
    fitting(pair).map(|_| ())
}

/// Runs both cases and compares them. `interrupt` stops the direct simulation after the present step, which is reported to `watcher`; it can be taken
/// up. The network is run again: it takes seconds.
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
    let by_network = network::track(&mut solver, &grid)?;
    let by_direct = direct::track(task, (&state, &grid), interrupt, watcher)?;
    let outlet = network::outlet_elements(&state);
    Ok(Comparison {
        titles: [pair.network.title.clone(), pair.direct.title.clone()],
        network: side(&by_network, &outlet),
        direct: side(&by_direct, &outlet),
        ..compared(&by_network, &by_direct, &grid)
    })
}

/// The network and its first state, where the direct simulation has the same shapes and sides.
fn fitting(pair: &Pair<'_>) -> Result<(NetworkSolver, NetworkState), CompareError> {
    let Model::Network(wanted) = &pair.network.model else { return Err(CompareError::NoNetwork) };
    let Model::Sph(sph) = &pair.direct.model else { return Err(CompareError::NoDirect) };
    if sph.non_wetting.is_none() {
        return Err(CompareError::NoDirect);
    }
    let solver = crate::network::setup::build_still(pair.network, wanted).map_err(SetupError::from)?;
    let state = network::state(&solver).ok_or(CompareError::NoNetwork)?;
    if let Some(misfit) = state.misfit(&pair.direct.geometry) {
        return Err(CompareError::OtherGeometry(misfit));
    }
    if let Some((side, misfit)) = state.misfit_of_sides(&sph.sides) {
        return Err(CompareError::OtherSides { side, misfit });
    }
    Ok((solver, state))
}

fn side(track: &Track, outlet: &[usize]) -> Side {
    let through = outlet.iter().filter_map(|&element| track.filled[element]).min().filter(|&record| record > 0);
    let pressures = through.map(|record| track.records[..=record].iter().map(|it| it.pressure));
    let largest = pressures.map(|pressures| pressures.fold(f64::NAN, f64::max)).filter(|pressure| pressure.is_finite());
    Side {
        saturation: track.records.iter().map(|record| record.saturation).collect(),
        capillary_pressure_pa: track.records.iter().map(|it| Some(it.pressure).filter(|p| p.is_finite())).collect(),
        breakthrough_pressure_pa: largest,
        saturation_at_breakthrough: through.map(|record| track.records[record].saturation),
        permeability_m2: track.permeability,
        wall_time_s: track.wall_time_s,
        processor_time_s: track.processor_time_s,
        unknowns: track.unknowns,
        steps: track.steps,
        warnings: track.warnings.clone(),
    }
}

/// What is told by both together; the sides are left to be filled in.
fn compared(network: &Track, direct: &Track, grid: &Grid) -> Comparison {
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
            AtSaturation {
                saturation: [network.records[i].saturation, direct.records[j].saturation],
                overlap: overlap(i, j),
                picture: picture::svg(grid, [&network.records[i].invaded, &direct.records[j].invaded]),
            }
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
        rank_correlation: rank::correlation(&both),
        elements_in_both: both.len(),
        mean_overlap: (!overlaps.is_empty()).then(|| overlaps.iter().sum::<f64>() / overlaps.len() as f64),
        at_equal_saturation,
    }
}
