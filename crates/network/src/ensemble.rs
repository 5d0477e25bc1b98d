//! An ensemble of networks that differ in uncertain values: the results of one realization, and maps of all.
//!
//! Capillary pressures are evaluated at the same saturations of the wetting phase in each. The state at breakthrough, or without it at the
//! end of the first half cycle, is evaluated in the elements of the first realization.

use std::sync::atomic::{AtomicBool, Ordering};

use serde::{Deserialize, Serialize};

use super::cycles::{Cycles, FluidPhase};
use super::displacement::{Division, Phase};
use super::dynamic::solver::DynamicSolver;
use super::films::CurvePoint;
use super::locate::{inner_point, located};
use super::measures::Costly;
use super::model::{Configuration, Model};
use super::setup::{Ground, SetupError, build_on, in_time};
use super::solver::NetworkSolver;
use super::{layers, measures, pictures, tables};
use meniscus_case::Case;
use meniscus_case::network::PoreNetwork;
use meniscus_core::diagram::RegionMap;
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::Layer;
use meniscus_core::solver::{Measure, Series, Solver, SolverError};
use meniscus_core::table::Table;

/// Number of saturations of the wetting phase, from 0 to 1, at which capillary pressures are evaluated.
pub const SATURATIONS: usize = 101;

/// Rounding error of saturations, which are sums of areas.
const ROUNDING: f64 = 1e-9;

/// Steps between two checks for an interrupt.
const BETWEEN_LOOKS: u64 = 64;

/// A network before its displacement.
pub enum Sample {
    /// Quasi-static, or without a displacement.
    QuasiStatic(Box<NetworkSolver>),
    /// Dynamic.
    InTime(Box<DynamicSolver>),
}

/// The results of one realization, as a study keeps them.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Observed {
    /// Name, unit and value of each measure.
    pub measures: Vec<(String, String, f64)>,
    /// For each half cycle the capillary pressure in Pa at each saturation, infinite if the saturation is not reached or needs no pressure.
    pub curves: Vec<Vec<f64>>,
    /// Which elements of the reference the invading phase held at breakthrough, or at the end of the first half cycle: eight per byte.
    pub invaded: Vec<u8>,
    /// Number of events or steps.
    pub steps: u64,
    /// Number of pores.
    pub pores: usize,
    /// Wall time in s, measured by the caller.
    pub seconds: f64,
}

impl Observed {
    /// The measures, and for each element of the reference whether its counterpart among the own elements is `invaded`.
    fn new(measures: Vec<Measure>, counterparts: &[Option<usize>], invaded: &[bool]) -> Self {
        let is_invaded = |element: &Option<usize>| element.is_some_and(|element| invaded[element]);
        let bits = |parts: &[Option<usize>]| {
            parts.iter().enumerate().fold(0, |byte, (k, part)| byte | (u8::from(is_invaded(part)) << k))
        };
        Self {
            measures: measures.into_iter().map(|one| (one.name, one.unit, one.value)).collect(),
            invaded: counterparts.chunks(8).map(bits).collect(),
            ..Self::default()
        }
    }

    /// Whether an element of the reference was invaded.
    pub fn is_invaded(&self, element: usize) -> bool {
        self.invaded.get(element / 8).is_some_and(|byte| byte >> (element % 8) & 1 == 1)
    }
}

/// The elements of a map, those of one of the networks.
pub struct Reference {
    config: Configuration,
    division: Division,
    probes: Vec<Vec2>,
    processes: Vec<&'static str>,
}

impl Sample {
    /// The network of a case, on its own ground or that of a case of the same geometry, sides and persistence ratio.
    ///
    /// # Errors
    /// [`SetupError`] if there is no such network.
    pub fn on(ground: &Ground, case: &Case, wanted: &PoreNetwork) -> Result<Self, SetupError> {
        let quasi_static = build_on(ground, wanted, case.depth)?;
        Ok(match in_time(wanted, &quasi_static)? {
            Some(solver) => Self::InTime(Box::new(solver)),
            None => Self::QuasiStatic(Box::new(quasi_static)),
        })
    }

    fn model(&self) -> &Model {
        match self {
            Self::QuasiStatic(solver) => &solver.model,
            Self::InTime(solver) => solver.quasi_static(),
        }
    }

    fn division(&self) -> Division {
        match self {
            Self::QuasiStatic(solver) => {
                solver.cycles().map_or_else(Division::default, |cycles| cycles.displacement.division())
            }
            Self::InTime(solver) => solver.division(),
        }
    }

    /// Its elements.
    pub fn reference(&self) -> Reference {
        let division = self.division();
        let probes = (0..division.elements().len()).map(|element| inner_point(&division.outline(element))).collect();
        let processes = match self {
            Self::QuasiStatic(solver) => solver
                .cycles()
                .map_or(Vec::new(), |cycles| cycles.half_cycles().iter().map(|half| half.invading.process()).collect()),
            Self::InTime(_) => Vec::new(),
        };
        Reference { config: self.model().config.clone(), division, probes, processes }
    }

    /// Performs the displacement and finds its measures, those of a quasi-static one without the costly ones that are left out; `None` if
    /// interrupted. `stop` returns, for a dynamic displacement, the next time in s at which it halts, and whether its state is recorded then.
    ///
    /// # Errors
    /// [`SolverError`] of a dynamic displacement.
    pub fn observed(
        self,
        reference: &Reference,
        costly: Costly,
        stop: &dyn Fn(f64) -> Option<(f64, bool)>,
        interrupt: &AtomicBool,
    ) -> Result<Option<Observed>, SolverError> {
        let counterparts = reference.counterparts(&self.model().config, &self.division());
        match self {
            Self::QuasiStatic(solver) => Ok(quasi_static(*solver, &counterparts, costly, interrupt)),
            Self::InTime(solver) => in_its_time(*solver, &counterparts, stop, interrupt),
        }
    }
}

fn quasi_static(
    mut solver: NetworkSolver,
    counterparts: &[Option<usize>],
    costly: Costly,
    interrupt: &AtomicBool,
) -> Option<Observed> {
    let mut invaded = Vec::new();
    if let Some(cycles) = &mut solver.model.cycles {
        let mut half_cycle = 0;
        while cycles.advance().is_some() {
            if cycles.steps % BETWEEN_LOOKS == 0 && interrupt.load(Ordering::Relaxed) {
                return None;
            }
            if half_cycle == 0 && cycles.half_cycle_index() == 1 {
                half_cycle = 1;
                invaded = at_turn(cycles);
            }
        }
        if let Some(moment) = cycles.breakthrough() {
            let displacement = &moment.displacement;
            let holds = |element| displacement.phase(element) == Phase::Invading;
            // Only of the first half cycle: in the second the phases are exchanged.
            if moment.half_cycle == 0 {
                invaded = (0..displacement.elements().len()).map(holds).collect();
            }
        }
        if invaded.is_empty() {
            let displacement = &cycles.displacement;
            invaded = (0..displacement.elements().len()).map(|e| displacement.phase(e) == Phase::Invading).collect();
        }
    }
    let config = &solver.model.config;
    Some(Observed {
        curves: solver.cycles().map_or(Vec::new(), |cycles| curves(config, cycles)),
        steps: solver.steps(),
        pores: config.pores.main_region.len(),
        ..Observed::new(measures::all(&solver.model, costly), counterparts, &invaded)
    })
}

/// The elements of the first invading phase just after the end of the first half cycle.
fn at_turn(cycles: &Cycles) -> Vec<bool> {
    let displacement = &cycles.displacement;
    let holds = |element: usize| match displacement.phase(element) {
        Phase::Defending => true,
        // The start of the next half cycle has filled it.
        Phase::Invading => cycles.record.invasions[element].is_some(),
    };
    (0..displacement.elements().len()).map(holds).collect()
}

fn in_its_time(
    mut solver: DynamicSolver,
    counterparts: &[Option<usize>],
    stop: &dyn Fn(f64) -> Option<(f64, bool)>,
    interrupt: &AtomicBool,
) -> Result<Option<Observed>, SolverError> {
    let mut series = Series::default();
    let record = |solver: &DynamicSolver, series: &mut Series| {
        let (columns, row): (Vec<&str>, Vec<f64>) = solver.sample().iter().map(|it| (it.name, it.value)).unzip();
        series.columns = columns.into_iter().map(str::to_owned).collect();
        series.rows.push(row);
    };
    let held = |solver: &DynamicSolver| solver.shares().map(|share| share > 0.5).collect::<Vec<bool>>();
    record(&solver, &mut series);
    let mut invaded = None;
    'run: while let Some((until, is_recorded)) = stop(solver.time()).filter(|_| !solver.is_done()) {
        while solver.time() < until {
            if interrupt.load(Ordering::Relaxed) {
                return Ok(None);
            }
            solver.step(until)?;
            if invaded.is_none() && solver.breakthrough().is_some() {
                invaded = Some(held(&solver));
            }
            if solver.is_done() {
                record(&solver, &mut series);
                break 'run;
            }
        }
        if is_recorded {
            record(&solver, &mut series);
        }
    }
    let invaded = invaded.unwrap_or_else(|| held(&solver));
    Ok(Some(Observed {
        steps: solver.steps(),
        pores: solver.quasi_static().config.pores.main_region.len(),
        ..Observed::new(solver.measures(&series), counterparts, &invaded)
    }))
}

/// For each half cycle that has started, the capillary pressure at each saturation.
fn curves(config: &Configuration, cycles: &Cycles) -> Vec<Vec<f64>> {
    let Some(tension) = config.tension else { return Vec::new() };
    let of_half = |(half_cycle, outcome): (usize, &super::cycles::Outcome)| {
        let invading = cycles.half_cycles()[half_cycle].invading;
        let first = outcome.first_saturation[1];
        if cycles.has_films() {
            let points = cycles.record.curve.iter().filter(|point| point.half_cycle == half_cycle);
            let points: Vec<[f64; 2]> =
                points.map(|point: &CurvePoint| [point.saturation, tension * point.curvature]).collect();
            return at_saturations(invading, first, &points, true);
        }
        let entries = cycles.history().iter().filter(|entry| entry.half_cycle == half_cycle);
        let points: Vec<[f64; 2]> =
            entries.map(|entry| [entry.saturation, config.pressure(invading, entry.applied)]).collect();
        at_saturations(invading, first, &points, false)
    };
    cycles.record.outcomes.iter().enumerate().map(of_half).collect()
}

/// The pressure at which a half cycle starting at the saturation `first` reaches each saturation. An event reaches all saturations that it
/// passes at its own pressure; between the `points` of a curve that `is_continuous` the pressure is interpolated. Initial saturations, which
/// need no pressure, and those never reached are infinite, with the sign of the limit in the direction of the half cycle.
fn at_saturations(invading: FluidPhase, first: f64, points: &[[f64; 2]], is_continuous: bool) -> Vec<f64> {
    let sign = if invading == FluidPhase::NonWetting { 1.0 } else { -1.0 };
    // Mapped to one case for both phases: saturation falls and pressure rises.
    let falls: Vec<[f64; 2]> = points.iter().map(|[s, p]| [sign * s, sign * p]).collect();
    let at = |k: usize| {
        let wanted = sign * k as f64 / (SATURATIONS - 1) as f64;
        if wanted >= sign * first - ROUNDING {
            return sign * f64::NEG_INFINITY;
        }
        let Some(reached) = falls.iter().position(|[s, _]| *s <= wanted + ROUNDING) else {
            return sign * f64::INFINITY;
        };
        let [s, pressure] = falls[reached];
        let before = reached.checked_sub(1).map(|before| falls[before]).filter(|_| is_continuous);
        sign * before.map_or(pressure, |[s0, p0]| {
            let share = if s0 > s { ((s0 - wanted) / (s0 - s)).clamp(0.0, 1.0) } else { 1.0 };
            p0 + share * (pressure - p0)
        })
    };
    (0..SATURATIONS).map(at).collect()
}

impl Reference {
    /// Names of the half cycles.
    pub fn processes(&self) -> &[&'static str] {
        &self.processes
    }

    /// The moment of the maps.
    pub fn moment(&self) -> &'static str {
        if self.config.has_outlet() { "at breakthrough" } else { "at the end of the first half cycle" }
    }

    /// Number of its elements.
    pub fn len(&self) -> usize {
        self.division.elements().len()
    }

    /// For each of its elements the one of another network at the same position; `None` inside walls.
    fn counterparts(&self, config: &Configuration, division: &Division) -> Vec<Option<usize>> {
        let [elements, own] = [division.elements(), self.division.elements()];
        let is_same = config.geometry_hash == self.config.geometry_hash
            && elements.len() == own.len()
            && elements.iter().zip(own).all(|(one, other)| one.area == other.area);
        if is_same {
            return (0..elements.len()).map(Some).collect();
        }
        let size = config.bounds.size();
        let periods = [0, 1].map(|axis| config.periodic[axis].then_some(size[axis]));
        let outlines: Vec<Vec<Vec2>> = (0..elements.len()).map(|element| division.outline(element)).collect();
        located(&outlines, &self.probes, periods)
    }

    /// The probability that a random point of each pore is invaded, as a table of pores.
    pub fn table(&self, probability: &[f64]) -> Table {
        let config = &self.config;
        let pores = config.pores.main_region.len();
        let mut sums = vec![[0.0; 2]; pores];
        for (element, probability) in self.division.elements().iter().zip(probability) {
            let [weighted, area] = &mut sums[config.pores.pore_of[element.region]];
            *weighted += element.area * probability;
            *area += element.area;
        }
        let centers = || (0..pores).map(|pore| tables::center(config, pore));
        Table {
            name: "invasion",
            columns: vec![
                // As in `pores.csv`
                tables::counts("pore", 0..pores),
                tables::numbers("x_m", centers().map(|center| center.x)),
                tables::numbers("y_m", centers().map(|center| center.y)),
                tables::numbers("inscribed_radius_m", (0..pores).map(|pore| tables::radius(config, pore))),
                tables::numbers("area_m2", config.pores.area.iter().copied()),
                // Probability that a random point of the pore holds the invading phase when that reaches the outlet, or else at the end of the first
                // half cycle
                tables::numbers("invasion_probability", sums.iter().map(|[weighted, area]| weighted / area)),
            ],
        }
    }

    /// The same by element.
    pub fn layer(&self, probability: &[f64]) -> Layer<'static> {
        layers::invasion(&self.config, &self.division, probability)
    }

    /// The same as a picture; `note` is printed below its title.
    pub fn region_map(&self, probability: &[f64], note: String) -> RegionMap {
        pictures::invasion(&self.config, &self.division, probability, note)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_invaded_is_kept_for_each_element_of_the_reference() {
        let counterparts: Vec<Option<usize>> = (0..11).rev().map(Some).chain([None]).collect();
        let invaded: Vec<bool> = (0..11).map(|k| k % 3 == 0).collect();
        let observed = Observed::new(Vec::new(), &counterparts, &invaded);
        assert!((0..13).all(|k| observed.is_invaded(k) == (k < 11 && (10 - k) % 3 == 0)));
    }

    #[test]
    fn a_saturation_has_the_pressure_of_the_event_that_passes_it() {
        let events = [[0.5, 10.0], [0.25, 20.0]];
        let curve = at_saturations(FluidPhase::NonWetting, 0.9, &events, false);
        assert_eq!((curve[100], curve[90], curve[89]), (f64::NEG_INFINITY, f64::NEG_INFINITY, 10.0));
        assert_eq!((curve[50], curve[49], curve[25], curve[24]), (10.0, 20.0, 20.0, f64::INFINITY));
        // Imbibition reversed: the pressure falls while the wetting phase enters.
        let curve = at_saturations(FluidPhase::Wetting, 0.25, &[[0.5, 20.0], [0.75, -10.0]], false);
        assert_eq!((curve[25], curve[26], curve[50], curve[51]), (f64::INFINITY, 20.0, 20.0, -10.0));
        assert_eq!(curve[76], f64::NEG_INFINITY);
    }

    #[test]
    fn a_curve_with_films_is_interpolated() {
        let curve = at_saturations(FluidPhase::NonWetting, 1.0, &[[1.0, 0.0], [0.5, 10.0]], true);
        assert!((curve[75] - 5.0).abs() < 1e-9 && curve[50] == 10.0);
    }
}
