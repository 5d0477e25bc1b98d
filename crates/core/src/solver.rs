//! The interface between the simulation loop and a solver.

use serde::Serialize;

use crate::diagram::{Diagram, RegionMap};
use crate::math::Vec2;
use crate::playback::Playback;
use crate::snapshot::{Layer, Lines, Snapshot};
use crate::table::{Document, Table};

/// The independent variable of a run: time, for most solvers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Clock {
    /// Its name.
    pub name: &'static str,
    /// Its symbol in pictures and progress messages.
    pub symbol: &'static str,
    /// Unit, empty for dimensionless numbers.
    pub unit: &'static str,
}

impl Clock {
    /// Time in s.
    pub const TIME: Self = Self { name: "time", symbol: "t", unit: "s" };
}

/// Output that is made when it is written, so that not all of it is in memory at a time.
pub type Made<'a, T> = Box<dyn Fn() -> T + Send + Sync + 'a>;

/// The final output of a solver besides measures and diagrams.
#[derive(Default)]
pub struct Results<'a> {
    /// Tables, written as CSV.
    pub tables: Vec<Made<'a, Table>>,
    /// Layers, written as VTK.
    pub layers: Vec<Made<'a, Layer<'a>>>,
    /// Texts, written unchanged.
    pub documents: Vec<Document<'a>>,
}

/// One named number of the time series.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Column of `series.csv` with its unit at the end, such as `interface_length_m`.
    pub name: &'static str,
    /// Value in SI units; NaN where the quantity does not exist (no contact line, say).
    pub value: f64,
}

/// A final result with its error bar and method.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// Name in `report.json`, such as `contact-angle-deg`.
    pub name: String,
    /// Value in `unit`; NaN if it could not be measured (the method gives the reason).
    pub value: f64,
    /// Unit, empty for dimensionless numbers.
    pub unit: String,
    /// One standard uncertainty in `unit`, if known.
    pub uncertainty: Option<f64>,
    /// How it was measured, in one sentence.
    pub method: String,
    /// The column of the time series with which it varies, unless it is one of the watched quantities.
    pub moves_with: Option<MovesWith>,
}

/// A measure by its value in `unit`, without an error bar.
pub fn measure(name: &str, value: f64, unit: &str) -> Measure {
    Measure { name: name.into(), value, unit: unit.into(), uncertainty: None, method: String::new(), moves_with: None }
}

/// The column with which a measure varies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovesWith {
    /// Its name.
    pub column: &'static str,
    /// Ratio of a change of the measure to that of the column.
    pub factor: f64,
    /// The value of the measure where every contact line is at the requested angle, if known.
    pub at_rest: Option<f64>,
}

impl Measure {
    /// The same measure, with how it was measured in one sentence.
    pub fn by(self, method: impl Into<String>) -> Self {
        Self { method: method.into(), ..self }
    }

    /// The same measure with one standard uncertainty in its unit, if known.
    pub fn with_uncertainty(self, uncertainty: impl Into<Option<f64>>) -> Self {
        Self { uncertainty: uncertainty.into(), ..self }
    }

    /// The same measure, which varies with a `column` of the series: changes of the column times `factor` are those of the measure.
    pub fn moving_with(self, column: &'static str, factor: f64) -> Self {
        Self { moves_with: Some(MovesWith { column, factor, at_rest: None }), ..self }
    }

    /// The same measure, which varies with a column and has this value where every contact line is at the requested angle.
    pub fn resting_at(self, value: f64) -> Self {
        let moves_with = self.moves_with.map(|with| MovesWith { at_rest: Some(value), ..with });
        Self { moves_with, ..self }
    }
}

/// Summary of one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepInfo {
    /// Time step in s.
    pub dt: f64,
    /// The limit that determined `dt`: `velocity`, `viscosity`, `surface tension`, `gravity`, `record`, ...
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

/// Statistics of a solver's work.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Statistics {
    /// Number of unknowns: particles or nodes.
    pub unknowns: usize,
    /// Number of steps done by this process.
    pub steps: u64,
    /// Wall time of each part.
    pub parts: Vec<PartTime>,
    /// Further counts by name, such as `ppe-iterations`.
    pub counts: Vec<(&'static str, f64)>,
}

/// Why a solver stopped. The state before the failing step is kept.
#[derive(Debug, thiserror::Error)]
pub enum SolverError {
    /// A value that is not finite, or an unphysically large speed.
    #[error("{what} at time {time:.6e} s (step {step}), at ({:.4e}, {:.4e}) m", position.x, position.y)]
    BlowUp {
        /// What went wrong, with the value.
        what: String,
        /// Time in s.
        time: f64,
        /// Step.
        step: u64,
        /// Position in m.
        position: Vec2,
    },
    /// The time step is far below the static limits.
    #[error(
        "the time step fell to {dt:.3e} s, below {smallest:.3e} s, limited by {limit}, at time {time:.6e} s (step {step}): {cause}"
    )]
    TimeStep {
        /// The time step in s.
        dt: f64,
        /// The smallest accepted one in s.
        smallest: f64,
        /// The limit that determines it.
        limit: &'static str,
        /// Time in s.
        time: f64,
        /// Step.
        step: u64,
        /// What is too fast, where, and the remedy.
        cause: String,
    },
    /// A flow rate is prescribed at a side through which nothing can flow.
    #[error(
        "no pressure can drive the requested flow through the side `{side}` at time {time:.6e} s (step {step}): open a path through the solids along it, wide enough for a few particles, or leave the flow out"
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
         iterations, {tolerance:.1e} requested{}", advice(*residual)
    )]
    NotConverged {
        /// Name of the system.
        system: &'static str,
        /// Relative residual reached.
        residual: f64,
        /// Required relative residual.
        tolerance: f64,
        /// Number of iterations.
        iterations: usize,
        /// Time in s.
        time: f64,
        /// Step.
        step: u64,
    },
}

/// The advice after a solve that stopped at the relative `residual`.
fn advice(residual: f64) -> &'static str {
    // A solve that fails for another reason stops far above rounding.
    const ROUNDING: f64 = 1e-9;
    if residual < ROUNDING { "; rounding allows no less, so ask for a larger tolerance" } else { "" }
}

/// A saved state that cannot be restored.
#[derive(Debug, thiserror::Error)]
#[error("the saved state does not fit: {0}")]
pub struct StateError(pub String);

/// The rows of the time series up to now, as in `series.csv`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Column names; the first is the clock of the solver: `time_s` for most.
    pub columns: Vec<String>,
    /// One row per record, each as long as `columns`.
    pub rows: Vec<Vec<f64>>,
}

impl Series {
    /// The values of one column, empty if there is no such column.
    pub fn column<'a>(&'a self, name: &str) -> impl Iterator<Item = f64> + 'a {
        let index = self.columns.iter().position(|c| c == name);
        self.rows.iter().filter_map(move |row| index.and_then(|i| row.get(i).copied()))
    }
}

/// A quantity of the time series that is constant in a steady state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Watched {
    /// Its column of `series.csv`.
    pub column: &'static str,
    /// Its kind, which determines the reference for its changes.
    pub kind: Quantity,
}

/// Kinds of quantities that are watched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Quantity {
    /// A contact angle in degrees.
    Angle {
        /// Column of the kinetic energy in J/m: the energy not yet dissipated can still rotate the interface.
        energy: &'static str,
        /// Column of the length of the interface in m.
        length: &'static str,
        /// Interfacial tension in N/m.
        tension: f64,
        /// Smallest and largest equilibrium angle in degrees of all contact lines; absent if the flow is driven or walls differ.
        at_rest: Option<[f64; 2]>,
        /// Whether contact lines may rest at other angles, at edges.
        pins: bool,
    },
    /// A pressure difference in Pa; its changes are relative to its value or to `scale` in Pa, whichever is larger.
    Pressure {
        /// What counts as a small pressure, in Pa.
        scale: f64,
    },
    /// A fraction of the pore space; its changes are absolute.
    Saturation,
    /// Kinetic energy; its changes are relative to its value, unless all particles are at rest.
    Energy {
        /// Column of the largest speed in m/s.
        speed: &'static str,
        /// Speed in m/s at a capillary number of 1; absent without interfacial tension.
        capillary_speed: Option<f64>,
    },
}

impl Quantity {
    /// Smallest and largest possible value, in the unit of the quantity.
    pub fn range(self) -> [f64; 2] {
        match self {
            Self::Angle { .. } => [0.0, 180.0],
            Self::Saturation => [0.0, 1.0],
            Self::Pressure { .. } | Self::Energy { .. } => [f64::NEG_INFINITY, f64::INFINITY],
        }
    }

    /// Whether every contact line can rest at one angle only.
    pub fn has_one_angle(self) -> bool {
        matches!(self, Self::Angle { at_rest: Some([least, most]), pins: false, .. } if least == most)
    }

    /// A change that is negligible, for a quantity measured without an error bar: one percent for a saturation.
    pub fn small(self) -> Option<f64> {
        matches!(self, Self::Saturation).then_some(0.01)
    }
}

/// A solver that the simulation loop can run. It does no I/O and prints nothing; time advances in `step` only.
pub trait Solver {
    /// Position of the run on its [`clock`](Self::clock): the time in s, for most solvers.
    fn time(&self) -> f64;

    /// The independent variable of [`time`](Self::time).
    fn clock(&self) -> Clock {
        Clock::TIME
    }

    /// Whether the run is complete, as no further event can occur.
    fn is_done(&self) -> bool {
        false
    }

    /// Number of steps done since time zero (continued in resumed runs).
    fn steps(&self) -> u64;

    /// Does one step that ends at `until` (s) or before. `until` is reached exactly: afterwards `time() == until`, unless the run is done before.
    ///
    /// # Errors
    /// See [`SolverError`]; the state before the step is kept and can still be saved and output.
    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError>;

    /// The state for output. May compute fields; to be called per record, not per step.
    fn snapshot(&self) -> Snapshot<'_>;

    /// The outline of the solids, which is stationary.
    fn outline(&self) -> Lines<'_>;

    /// One row of the time series: the clock (`time_s`) and `step` first, always the same names in the same order.
    fn sample(&self) -> Vec<Sample>;

    /// The quantities of the time series that detect a steady state; empty if the solver has none.
    fn watched(&self) -> Vec<Watched> {
        Vec::new()
    }

    /// The final results; `series` holds all rows recorded so far.
    fn measures(&self, series: &Series) -> Vec<Measure>;

    /// Current limitations on the measures: lack of resolution, limits of the model; `series` as for [`measures`](Self::measures).
    fn warnings(&self, _series: &Series) -> Vec<String> {
        Vec::new()
    }

    /// Diagrams of the run so far, if the solver recorded their data.
    fn diagrams(&self) -> Vec<Diagram> {
        Vec::new()
    }

    /// Layers of cells that are recorded over time.
    fn layers(&self) -> Vec<Layer<'_>> {
        Vec::new()
    }

    /// The map of the plane that is the picture of the present state; `None` if its snapshot is.
    fn region_map(&self) -> Option<RegionMap> {
        None
    }

    /// The displacement so far, to be played from event to event; `None` if there is none.
    fn playback(&self) -> Option<Playback> {
        None
    }

    /// Final output besides measures and diagrams.
    fn results(&self) -> Results<'_> {
        Results::default()
    }

    /// The complete state, such that `restore` and further steps are bitwise identical to an uninterrupted run.
    fn state(&self) -> Vec<u8>;

    /// Restores a state returned by `state` for the same case.
    ///
    /// # Errors
    /// [`StateError`] if the bytes are not such a state.
    fn restore(&mut self, state: &[u8]) -> Result<(), StateError>;

    /// Approximate number of steps from here to `end` in s, if the solver has a better estimate than the length of its last step.
    fn steps_to(&self, _end: f64) -> Option<f64> {
        None
    }

    /// Wall time of each part and work counters of the solver.
    fn statistics(&self) -> Statistics;
}
