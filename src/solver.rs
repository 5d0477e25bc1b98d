//! The interface between a solver and the simulation loop.

use serde::Serialize;

use crate::diagram::{Diagram, RegionMap};
use crate::math::Vec2;
use crate::snapshot::{Layer, Lines, Snapshot};
use crate::table::{Document, Table};

/// The independent variable of a run: time, for most solvers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Clock {
    /// Its name.
    pub name: &'static str,
    /// Its symbol in pictures and progress lines.
    pub symbol: &'static str,
    /// Unit, empty if dimensionless.
    pub unit: &'static str,
}

impl Clock {
    /// Time in s.
    pub(crate) const TIME: Self = Self { name: "time", symbol: "t", unit: "s" };
}

/// The results of a solver at the end of a run besides measures and diagrams.
#[derive(Debug, Clone, Default)]
pub struct Results<'a> {
    /// Tables, written as CSV.
    pub tables: Vec<Table>,
    /// Layers, written as VTK.
    pub layers: Vec<Layer<'a>>,
    /// Text files, written verbatim.
    pub documents: Vec<Document>,
    /// Maps of the plane; the first one is the picture of the run.
    pub region_maps: Vec<RegionMap>,
}

/// One named scalar of the time series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Column of `series.csv` with its unit at the end, such as `interface_length_m`.
    pub name: &'static str,
    /// Value in SI units; NaN if the quantity does not exist (no contact line, say).
    pub value: f64,
}

/// A final result with its uncertainty and how it was measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// Name in `report.json`, such as `contact-angle-deg`.
    pub name: String,
    /// Value in `unit`; NaN if it could not be measured (`method` says why).
    pub value: f64,
    /// Unit, empty if dimensionless.
    pub unit: String,
    /// One standard uncertainty in `unit`, if known.
    pub uncertainty: Option<f64>,
    /// How it was measured, in one sentence.
    pub method: String,
    /// The column of the time series that it follows, unless it is one of the watched quantities.
    pub moves_with: Option<MovesWith>,
}

/// A measure without an uncertainty; its value in `unit`, and `method` in one sentence.
pub(crate) fn measure(name: &str, value: f64, unit: &str, method: impl Into<String>) -> Measure {
    Measure { name: name.into(), value, unit: unit.into(), uncertainty: None, method: method.into(), moves_with: None }
}

/// The column that a measure follows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovesWith {
    /// Its name.
    pub column: &'static str,
    /// Change of the measure per change of the column.
    pub factor: f64,
}

impl Measure {
    /// The same measure, which follows `column` of the series: its changes are those of the column times `factor`.
    pub(crate) fn moving_with(self, column: &'static str, factor: f64) -> Self {
        Self { moves_with: Some(MovesWith { column, factor }), ..self }
    }
}

/// The outcome of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepInfo {
    /// Time step in s.
    pub dt: f64,
    /// The limit that set `dt`: `velocity`, `viscosity`, `surface tension`, `gravity`, `record`, ...
    pub limit: &'static str,
}

/// Wall time of one part of the solver since its creation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PartTime {
    /// Name of the part: `neighbors`, `forces`, `pressure`, ...
    pub part: &'static str,
    /// Wall time in s.
    pub seconds: f64,
}

/// Statistics of the work of a solver.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Statistics {
    /// Number of unknowns: particles or nodes.
    pub unknowns: usize,
    /// Steps done by this process.
    pub steps: u64,
    /// Wall time by part.
    pub parts: Vec<PartTime>,
    /// Further counters by name, such as `ppe-iterations`.
    pub counts: Vec<(&'static str, f64)>,
}

/// Why a solver stopped. The state before the failed step is kept.
#[derive(Debug, thiserror::Error)]
pub enum SolverError {
    /// A value that is not finite, or an unphysical speed.
    #[error("{what} at time {time:.6e} s (step {step}), at ({:.4e}, {:.4e}) m", place.x, place.y)]
    BlowUp {
        /// What went wrong, with the value.
        what: String,
        /// Time in s.
        time: f64,
        /// Step.
        step: u64,
        /// Position in m.
        place: Vec2,
    },
    /// The time step fell far below what the static limits allow.
    #[error(
        "the time step fell to {dt:.3e} s, below {smallest:.3e} s, ruled by {limit}, at time {time:.6e} s (step {step}), \
         fastest particle at ({:.4e}, {:.4e}) m", place.x, place.y
    )]
    TimeStep {
        /// The time step in s.
        dt: f64,
        /// The smallest accepted time step in s.
        smallest: f64,
        /// The limit that sets it.
        limit: &'static str,
        /// Time in s.
        time: f64,
        /// Step.
        step: u64,
        /// Position of the fastest particle in m.
        place: Vec2,
    },
    /// A flow rate is prescribed at a side, but nothing can flow.
    #[error(
        "no pressure drives the flow that is asked for through the side `{side}` at time {time:.6e} s (step {step}): open a way \
         through the solids along it, wide enough for a few particles, or leave the flow out"
    )]
    Blocked {
        /// Name of the side.
        side: &'static str,
        /// Time in s.
        time: f64,
        /// Step.
        step: u64,
    },
    /// A linear or nonlinear solve did not reach its tolerance.
    #[error(
        "{system} did not converge at time {time:.6e} s (step {step}): relative residual {residual:.3e} after {iterations} \
         iterations, {tolerance:.1e} asked for{}", advice(*residual)
    )]
    NotConverged {
        /// The system of equations.
        system: &'static str,
        /// Relative residual reached.
        residual: f64,
        /// Relative residual required.
        tolerance: f64,
        /// Number of iterations.
        iterations: usize,
        /// Time in s.
        time: f64,
        /// Step.
        step: u64,
    },
}

/// Advice for a solve that stopped at the relative `residual`.
fn advice(residual: f64) -> &'static str {
    // A solve that fails for any other reason stops far above rounding.
    const ROUNDING: f64 = 1e-9;
    if residual < ROUNDING { "; rounding allows no less, so ask for a larger tolerance" } else { "" }
}

/// A saved state that cannot be restored.
#[derive(Debug, thiserror::Error)]
#[error("the saved state does not fit: {0}")]
pub struct StateError(pub String);

/// The rows of the time series so far, as in `series.csv`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Column names; the first is the clock of the solver: `time_s` for most.
    pub columns: Vec<String>,
    /// One row per record, each as long as `columns`.
    pub rows: Vec<Vec<f64>>,
}

impl Series {
    /// The values of one column; empty if there is no such column.
    pub(crate) fn column<'a>(&'a self, name: &str) -> impl Iterator<Item = f64> + 'a {
        let index = self.columns.iter().position(|c| c == name);
        self.rows.iter().filter_map(move |row| index.and_then(|i| row.get(i).copied()))
    }
}

/// A quantity of the time series that is constant once a run is steady.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Watched {
    /// Its column of `series.csv`.
    pub column: &'static str,
    /// Its kind, which sets the scale that its changes are compared with.
    pub kind: Quantity,
}

/// Kinds of watched quantities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// A contact angle in degrees.
    Angle {
        /// Column of the kinetic energy in J/m: the part of it that is not yet dissipated can still turn the interface.
        energy: &'static str,
        /// Column of the length of the interface in m.
        length: &'static str,
        /// Interfacial tension in N/m.
        tension: f64,
        /// Smallest and largest angle in degrees at which all contact lines are at rest; `None` if something drives the flow, or walls differ.
        at_rest: Option<[f64; 2]>,
        /// Whether a contact line may be pinned at other angles, at edges.
        pins: bool,
    },
    /// A pressure difference in Pa, compared with its value, or with `scale` in Pa where that is larger.
    Pressure {
        /// Pressures below this are small, in Pa.
        scale: f64,
    },
    /// A saturation, compared with 1.
    Saturation,
    /// Kinetic energy, compared with its value, unless all particles are at rest.
    Energy {
        /// Column of the largest speed in m/s.
        speed: &'static str,
        /// Speed in m/s at a capillary number of 1; `None` without interfacial tension.
        capillary_speed: Option<f64>,
    },
}

impl Quantity {
    /// Smallest and largest possible value, in the unit of the quantity.
    pub(crate) fn range(self) -> [f64; 2] {
        match self {
            Self::Angle { .. } => [0.0, 180.0],
            Self::Saturation => [0.0, 1.0],
            Self::Pressure { .. } | Self::Energy { .. } => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// A negligible change, where the quantity is measured without an uncertainty: of a saturation that of a hundredth.
    pub(crate) fn small(self) -> Option<f64> {
        matches!(self, Self::Saturation).then_some(0.01)
    }
}

/// A solver that the simulation loop can run. It does no I/O and prints nothing; time advances in `step` only.
pub trait Solver {
    /// The current value of the [`clock`](Self::clock): the time in s, for most solvers.
    fn time(&self) -> f64;

    /// What [`time`](Self::time) measures.
    fn clock(&self) -> Clock {
        Clock::TIME
    }

    /// Whether nothing changes any more, so that the run ends here.
    fn is_done(&self) -> bool {
        false
    }

    /// Number of steps done since time zero (resumed runs continue counting).
    fn steps(&self) -> u64;

    /// Does one step that ends at `until` (s) or before. `until` is met exactly: afterwards `time() == until`, unless the run is done before.
    ///
    /// # Errors
    /// See [`SolverError`]; the state before the step is kept and can still be saved and shown.
    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError>;

    /// The state for output. May compute fields, so call it per record, not per step.
    fn snapshot(&self) -> Snapshot<'_>;

    /// The outline of the solids, which does not move.
    fn outline(&self) -> Lines<'_>;

    /// One row of the time series: the clock (`time_s`) and `step` first, always the same names in the same order.
    fn sample(&self) -> Vec<Sample>;

    /// The quantities of the time series that show that a run is steady; empty if the solver cannot decide.
    fn watched(&self) -> Vec<Watched> {
        Vec::new()
    }

    /// The final results; `series` holds all rows recorded so far.
    fn measures(&self, series: &Series) -> Vec<Measure>;

    /// What a reader must know before trusting the measures, such as unresolved parts or a limit of the model; `series` as in [`measures`](Self::measures).
    fn warnings(&self, _series: &Series) -> Vec<String> {
        Vec::new()
    }

    /// Diagrams of the run so far, if the solver recorded the data.
    fn diagrams(&self) -> Vec<Diagram> {
        Vec::new()
    }

    /// Layers of cells that are recorded over time.
    fn layers(&self) -> Vec<Layer<'_>> {
        Vec::new()
    }

    /// Results at the end besides measures and diagrams.
    fn results(&self) -> Results<'_> {
        Results::default()
    }

    /// The full state: after `restore`, further steps give the same bits as an uninterrupted run.
    fn state(&self) -> Vec<u8>;

    /// Restores a state that `state` returned for the same case.
    ///
    /// # Errors
    /// [`StateError`] if the bytes are not such a state.
    fn restore(&mut self, state: &[u8]) -> Result<(), StateError>;

    /// Approximate number of steps from here to `end` in s, if the solver has a better estimate than from the length of its last step.
    fn steps_to(&self, _end: f64) -> Option<f64> {
        None
    }

    /// Wall time by part, and counters of the solver.
    fn statistics(&self) -> Statistics;
}
