//! The thin film as a solver for the simulation loop: SI units outside, scaled inside.

use std::borrow::Cow;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::film::{FailedStep, Film};
use super::history::{History, Record};
use super::observed::{ObservedFilm, Surroundings};
use super::{backward_euler, diagrams, measures, warnings};
use meniscus_core::diagram::Diagram;
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{Cloud, Field, Lines, Snapshot, Values};
use meniscus_core::solver::{Measure, PartTime, Sample, Series, Solver, SolverError, StateError, Statistics, StepInfo};

/// Scaled time after which a partially wetting film is in equilibrium.
const LONG: f64 = 100.0;

/// A film with its history and progress.
#[derive(Debug, Clone)]
pub struct ThinFilmSolver {
    observed: ObservedFilm,
    dt: f64,
    steps: u64,
    steps_here: u64,
    seconds: f64,
}

/// The complete state for resuming.
#[derive(Serialize, Deserialize)]
struct Saved {
    time: f64,
    dt: f64,
    steps: u64,
    scaled_time: f64,
    next: f64,
    corrects: bool,
    values: Vec<f64>,
    history: History,
}

impl ThinFilmSolver {
    /// A solver at time zero.
    pub(crate) fn new(film: Film, surroundings: Surroundings) -> Self {
        Self {
            observed: ObservedFilm { film, surroundings, history: History::default(), time: 0.0 },
            dt: 0.0,
            steps: 0,
            steps_here: 0,
            seconds: 0.0,
        }
    }

    /// The cause of negative heights, and the remedy.
    fn why_negative(&self) -> &'static str {
        if self.observed.surroundings.rest.is_some() && self.observed.film.time() > LONG {
            "as for films long at rest (end the run earlier, or take a smaller spacing and a domain that the film does not fill)"
        } else {
            "although it still moves: its steps are too long or its spacing is too coarse (take a smaller \
             thin-film.method.finite-differences.step-share or thin-film.spacing, and a domain that the film does not fill)"
        }
    }

    fn stuck(&self, stuck: FailedStep) -> SolverError {
        let (time, step) = (self.observed.time, self.steps);
        match stuck {
            FailedStep::Inaccurate(dt) => {
                let dt = dt * self.observed.surroundings.scales.time;
                let x = self.observed.fastest().1 * self.observed.surroundings.scales.length;
                let cause = format!("the film is fastest at x = {x:.4e} m; take a smaller thin-film.spacing");
                SolverError::TimeStep { dt, smallest: dt, limit: "accuracy", time, step, cause }
            }
            FailedStep::Negative => SolverError::BlowUp {
                what: format!(
                    "the thin film falls below height 0 in all but the shortest steps, {}",
                    self.why_negative()
                ),
                time,
                step,
                position: Vec2::new(self.observed.fastest().1 * self.observed.surroundings.scales.length, 0.0),
            },
            FailedStep::Residual(residual) => SolverError::NotConverged {
                system: "the thin film on its grid",
                residual,
                tolerance: backward_euler::RESIDUAL,
                iterations: backward_euler::FACTORS as usize,
                time,
                step,
            },
        }
    }
}

impl Solver for ThinFilmSolver {
    fn time(&self) -> f64 {
        self.observed.time
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        let clock = Instant::now();
        let scale = self.observed.surroundings.scales.time;
        let end = until / scale;
        let stepped = self.observed.film.step(end);
        self.seconds += clock.elapsed().as_secs_f64();
        let dt = stepped.map_err(|stuck| self.stuck(stuck))? * scale;
        let time = self.observed.film.time();
        if self.observed.history.is_due(time)
            && let Some(line) = self.observed.contact_line()
        {
            let (position, slope, last) = (line.position, line.slope, self.observed.film.last_particle());
            self.observed.history.records.push(Record { time, position, slope, last });
        }
        if self.observed.history.is_frame_due(time) {
            self.observed.history.frames.push(self.observed.frame());
        }
        let landed = self.observed.film.time() >= end;
        self.observed.time = if landed { until } else { (self.observed.film.time() * scale).min(until.next_down()) };
        self.dt = dt;
        self.steps += 1;
        self.steps_here += 1;
        Ok(StepInfo { dt, limit: if landed { "record" } else { "accuracy" } })
    }

    fn snapshot(&self) -> Snapshot<'_> {
        let s = &self.observed.surroundings.scales;
        let point = |(x, h): (&f64, &f64)| Vec2::new(x * s.length, h * s.height);
        let fields = self.observed.film.fields();
        let points: Vec<Vec2> = fields.x.iter().zip(&fields.height).map(point).collect();
        let count = points.len();
        let velocity: Vec<Vec2> = fields.velocity.iter().map(|v| Vec2::new(v * s.velocity(), 0.0)).collect();
        let pressure = -s.tension * s.curvature();
        let (_, mass) = self.observed.mass_unit();
        let volume = if self.observed.surroundings.about_axis { "m^3" } else { "m^2" };
        let integers = |values: Vec<i64>| Values::Integer(Cow::Owned(values));
        let fields = vec![
            Field { name: "id", unit: "", values: integers((0..count as i64).collect()) },
            Field { name: "phase", unit: "", values: integers(vec![0; count]) },
            Field { name: "velocity", unit: "m/s", values: Values::Vector(velocity.into()) },
            Field::scalar("pressure", "Pa", fields.curvature.iter().map(|c| c * pressure)),
            Field::scalar("volume", volume, fields.mass.iter().map(|m| m * mass)),
            Field::scalar("film-height", "m", fields.height.iter().map(|h| h * s.height)),
        ];
        let profile = self.observed.profile();
        let line: Vec<Vec2> = profile.x.iter().zip(&profile.height).map(point).collect();
        let lines = vec![(0..line.len() as u32).collect()];
        let curvature = Field::scalar("curvature", "1/m", profile.curvature.iter().map(|c| c * s.curvature()));
        Snapshot {
            time: self.observed.time,
            step: self.steps,
            particles: Cloud { points: points.into(), fields },
            grid: None,
            interface: Some(Lines { points: line.into(), lines, fields: vec![curvature] }),
        }
    }

    fn outline(&self) -> Lines<'_> {
        let wall = self.observed.surroundings.wall.map(|x| Vec2::new(x, 0.0));
        Lines { points: wall.to_vec().into(), lines: vec![vec![0, 1]], fields: Vec::new() }
    }

    fn sample(&self) -> Vec<Sample> {
        let s = &self.observed.surroundings.scales;
        let line = self.observed.contact_line();
        let (mass_name, mass) = self.observed.mass_unit();
        let (energy_name, energy) = if self.observed.surroundings.about_axis {
            ("energy_J", s.energy() * s.length)
        } else {
            ("energy_J_per_m", s.energy())
        };
        let or_nothing = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let row = [
            ("time_s", self.observed.time),
            ("step", self.steps as f64),
            ("dt_s", self.dt),
            ("contact_line_position_m", or_nothing(line.map(|line| line.position * s.length))),
            ("last_particle_position_m", or_nothing(self.observed.film.last_particle().map(|x| x * s.length))),
            ("contact_angle_deg", or_nothing(line.map(|line| (line.slope * s.slope()).atan().to_degrees()))),
            ("center_height_m", self.observed.film.center_height() * s.height),
            (mass_name, self.observed.film.mass() * mass),
            (energy_name, self.observed.film.energy() * energy),
            ("max_speed_m_per_s", self.observed.fastest().0 * s.velocity()),
        ];
        row.into_iter().map(|(name, value)| Sample { name, value }).collect()
    }

    fn measures(&self, _series: &Series) -> Vec<Measure> {
        measures::all(&self.observed)
    }

    fn warnings(&self, _series: &Series) -> Vec<String> {
        warnings::all(&self.observed)
    }

    fn diagrams(&self) -> Vec<Diagram> {
        diagrams::all(&self.observed)
    }

    fn state(&self) -> Vec<u8> {
        let (scaled_time, next, corrects, values) = match &self.observed.film {
            Film::Particles { method, state } => (state.time, state.next, method.corrects(), state.x.clone()),
            Film::Grid(grid) => (grid.state.time, grid.state.next, false, grid.state.height.clone()),
        };
        let (time, dt, steps, history) = (self.observed.time, self.dt, self.steps, self.observed.history.clone());
        let saved = Saved { time, dt, steps, scaled_time, next, corrects, values, history };
        // Serializing numbers into a vector of bytes cannot fail.
        postcard::to_stdvec(&saved).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> Result<(), StateError> {
        let saved: Saved = postcard::from_bytes(state).map_err(|error| StateError(error.to_string()))?;
        let count = match &self.observed.film {
            Film::Particles { state, .. } => state.x.len(),
            Film::Grid(grid) => grid.state.height.len(),
        };
        if saved.values.len() != count {
            return Err(StateError(format!("expected {count} particles or nodes, found {}", saved.values.len())));
        }
        (self.observed.time, self.dt, self.steps) = (saved.time, saved.dt, saved.steps);
        self.observed.history = saved.history;
        match &mut self.observed.film {
            Film::Particles { method, state } => {
                (state.time, state.next, state.x) = (saved.scaled_time, saved.next, saved.values);
                if !saved.corrects {
                    method.keep_lattice_energy();
                }
            }
            Film::Grid(grid) => {
                let state = &mut grid.state;
                (state.time, state.next, state.height) = (saved.scaled_time, saved.next, saved.values);
            }
        }
        Ok(())
    }

    fn steps_to(&self, end: f64) -> Option<f64> {
        match &self.observed.film {
            Film::Particles { state, .. } => state.steps_to(end / self.observed.surroundings.scales.time),
            Film::Grid(grid) => Some(grid.state.steps_to(end / self.observed.surroundings.scales.time)),
        }
    }

    fn statistics(&self) -> Statistics {
        Statistics {
            unknowns: match &self.observed.film {
                Film::Particles { state, .. } => state.x.len(),
                Film::Grid(grid) => grid.state.height.len(),
            },
            steps: self.steps_here,
            parts: vec![PartTime { part: "film", seconds: self.seconds }],
            counts: self.observed.film.counts(),
        }
    }
}
