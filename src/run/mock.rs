//! A solver with a known solution, for tests of the run: particles on circles, stepped by a rotation that rounds differently for different time steps, so that
//! a run which stops at other times or loses a bit of its state is detected.

use std::sync::atomic::{AtomicBool, Ordering};

use super::simulation::{Progress, Watcher};
use meniscus_case::{Case, Expectation, Origin, load_from};
use meniscus_core::input::Overrides;
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_core::snapshot::{Cloud, Field, Grid, Lines, Snapshot, Values};
use meniscus_core::solver::{
    Measure, Quantity, Sample, Series, Solver, SolverError, StateError, Statistics, StepInfo, Watched,
};

/// Angular speed in rad/s.
const TURN: f64 = 2.0;
/// Time step in s, not a divisor of the record intervals.
const STEP: f64 = 0.0234;

/// Particles on circles about the origin.
#[derive(Debug, Clone)]
pub(crate) struct MockSolver {
    time: f64,
    dt: f64,
    steps: u64,
    points: Vec<Vec2>,
    /// Fails in the step after this one.
    pub(crate) fails_after: Option<u64>,
}

impl MockSolver {
    pub(crate) fn new() -> Self {
        let points = (1..=36).map(|i| Vec2::new(f64::from(i % 6 + 1) / 6.0, f64::from(i / 6) / 6.0)).collect();
        Self { time: 0.0, dt: 0.0, steps: 0, points, fails_after: None }
    }
}

impl Solver for MockSolver {
    fn time(&self) -> f64 {
        self.time
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        if self.fails_after.is_some_and(|last| self.steps >= last) {
            let (what, position) = ("speed inf m/s".into(), Vec2::new(1.0, 0.0));
            return Err(SolverError::BlowUp { what, time: self.time, step: self.steps, position });
        }
        let lands = self.time + STEP >= until;
        self.dt = if lands { until - self.time } else { STEP };
        self.time = if lands { until } else { self.time + STEP };
        self.steps += 1;
        for x in &mut self.points {
            *x = (*x + TURN * self.dt * perpendicular(*x)) / (1.0 + (TURN * self.dt).powi(2)).sqrt();
        }
        Ok(StepInfo { dt: self.dt, limit: if lands { "record" } else { "velocity" } })
    }

    fn snapshot(&self) -> Snapshot<'_> {
        let phase = (0..self.points.len() as i64).map(|i| i % 3).collect();
        let velocity: Vec<Vec2> = self.points.iter().map(|&x| TURN * perpendicular(x)).collect();
        let fields = vec![
            Field { name: "phase", unit: "", values: Values::Integer(phase) },
            Field { name: "velocity", unit: "m/s", values: Values::Vector(velocity.into()) },
        ];
        let distance = Field { name: "wall-distance", unit: "m", values: Values::Scalar(vec![self.time; 12].into()) };
        Snapshot {
            time: self.time,
            step: self.steps,
            particles: Cloud { points: (&self.points).into(), fields },
            grid: Some(Grid {
                origin: Vec2::zeros(),
                spacing: Vec2::repeat(0.5),
                counts: [4, 3],
                fields: vec![distance],
            }),
            interface: Some(Lines {
                points: (&self.points[..3]).into(),
                lines: vec![vec![0, 1, 2, 0]],
                fields: Vec::new(),
            }),
        }
    }

    fn outline(&self) -> Lines<'_> {
        Lines { points: vec![Vec2::zeros(), Vec2::new(1.0, 0.0)].into(), lines: vec![vec![0, 1]], fields: Vec::new() }
    }

    fn sample(&self) -> Vec<Sample> {
        let sample = |name, value| Sample { name, value };
        vec![
            sample("time_s", self.time),
            sample("step", self.steps as f64),
            sample("dt_s", self.dt),
            sample("contact_angle_deg", f64::NAN),
            sample("max_speed_m_per_s", self.points.iter().map(|x| TURN * x.norm()).fold(0.0, f64::max)),
        ]
    }

    /// The speed on the circles is constant.
    fn watched(&self) -> Vec<Watched> {
        let speed = "max_speed_m_per_s";
        vec![Watched { column: speed, kind: Quantity::Energy { speed, capillary_speed: None } }]
    }

    fn measures(&self, series: &Series) -> Vec<Measure> {
        let measure = |name: &str, value, unit: &str, method: &str| Measure {
            name: name.into(),
            value,
            unit: unit.into(),
            uncertainty: Some(1.0e-9),
            method: method.into(),
            moves_with: None,
        };
        vec![
            measure("radius-m", self.points[0].norm(), "m", "distance of the first particle from the origin"),
            measure("missing-angle-deg", f64::NAN, "deg", "there is no contact line"),
            measure("records", series.rows.len() as f64, "", "rows of the series"),
        ]
    }

    fn state(&self) -> Vec<u8> {
        postcard::to_stdvec(&(self.time, self.dt, self.steps, &self.points)).unwrap()
    }

    fn restore(&mut self, state: &[u8]) -> Result<(), StateError> {
        (self.time, self.dt, self.steps, self.points) =
            postcard::from_bytes(state).map_err(|error| StateError(error.to_string()))?;
        Ok(())
    }

    fn statistics(&self) -> Statistics {
        Statistics { unknowns: self.points.len(), steps: self.steps, ..Statistics::default() }
    }
}

/// Stops the run after some steps.
pub(crate) struct Interrupter<'a> {
    pub(crate) steps: u64,
    pub(crate) interrupt: &'a AtomicBool,
}

impl Watcher for Interrupter<'_> {
    fn stepped(&mut self, progress: &Progress) {
        self.interrupt.store(progress.step >= self.steps, Ordering::Relaxed);
    }
}

/// A case of one second with 11 rows, 6 VTK records and 3 saved states after time zero; its SPH settings are not used.
pub(crate) fn case() -> Case {
    let text = "format = 1\ntitle = \"Particles on circles\"\n[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\n\
                [sph]\nspacing = 0.05\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1e-3\n[time]\nend = 1.0\n\
                [output]\nseries.every-time = 0.1\nvtk.every-time = 0.2\nrestart.every-time = 0.4\n";
    let case = load_from(&Origin::Given("mock", text), &Overrides::default(), None)
        .unwrap_or_else(|error| panic!("{}", error.render()))
        .case;
    let expect = Expectation { measure: "radius-m".into(), value: 1.0 / 3.0, tolerance: 1.0e-9 };
    Case { expect: vec![expect], ..case }
}
