//! The thin film as the simulation loop sees it: SI units outside, scaled inside.

use std::borrow::Cow;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::diagrams;
use super::equilibrium::Equilibrium;
use super::film::{Film, Stuck};
use super::history::{Frame, History, Record};
use super::measures;
use super::profile::{Foot, Profile};
use super::scales::Scales;
use super::warnings;
use crate::diagram::Diagram;
use crate::math::Vec2;
use crate::snapshot::{Cloud, Field, Lines, Snapshot, Values};
use crate::solver::{Measure, PartTime, Sample, Series, Solver, SolverError, StateError, Statistics, StepInfo};

/// Points of the output's profile of particles per filter length; the foot is then good to 1e-7 of it.
const POINTS_PER_FILTER: f64 = 20.0;
/// Most points of that profile.
const MOST_POINTS: f64 = 2.0e4;

/// Steps between the places of a frame.
const FRAME_PLACES: u32 = 240;
/// Particles whose ways are kept.
const WAYS: usize = 12;

/// Scaled time after which a partially wetting film is at rest.
const LONG: f64 = 100.0;

/// What stands still around the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surroundings {
    /// Scales.
    pub(crate) scales: Scales,
    /// Left and right end of the wall in m.
    pub(crate) wall: [f64; 2],
    /// Scaled length that the film varies over at its contact line: the filter length, or the grid's spacing.
    pub(crate) resolution: f64,
    /// Scaled middle of the droplet on the right.
    pub(crate) right: f64,
    /// Whether the film is the same all around the axis x = 0.
    pub(crate) about_axis: bool,
    /// Scaled slope at rest, in partial wetting.
    pub(crate) rest: Option<f64>,
    /// For a partially wetting droplet that rests as a parabola: directions that its curvature is the sum of, 1 in the plane
    /// and 2 about an axis.
    pub(crate) cap_sides: Option<f64>,
    /// Whether the case takes the energy of the particle lattice off.
    pub(crate) takes_lattice_off: bool,
    /// Droplets at the start of a film that can only join them: a geometric one that does not hang.
    pub(crate) most_droplets: Option<usize>,
    /// Whether the droplet comes to a self-similar shape by surface tension.
    pub(crate) is_self_similar: bool,
    /// The droplet at rest, where its form is known.
    pub(crate) equilibrium: Option<Equilibrium>,
}

/// A film with all that is needed to observe it.
#[derive(Debug, Clone)]
pub(crate) struct ThinFilmSolver {
    film: Film,
    surroundings: Surroundings,
    history: History,
    time: f64,
    dt: f64,
    steps: u64,
    steps_here: u64,
    seconds: f64,
}

/// All that the future depends on.
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
            film,
            surroundings,
            history: History::default(),
            time: 0.0,
            dt: 0.0,
            steps: 0,
            steps_here: 0,
            seconds: 0.0,
        }
    }

    /// The film, scaled.
    pub(crate) fn film(&self) -> &Film {
        &self.film
    }

    /// What stands around it.
    pub(crate) fn surroundings(&self) -> &Surroundings {
        &self.surroundings
    }

    /// The way of the contact line.
    pub(crate) fn history(&self) -> &History {
        &self.history
    }

    /// The scaled profile over the wall.
    pub(crate) fn profile(&self) -> Profile {
        let [left, right] = self.surroundings.wall.map(|x| x / self.surroundings.scales.length);
        let wanted = POINTS_PER_FILTER * (right - left) / self.surroundings.resolution;
        let count = wanted.ceil().clamp(2.0, MOST_POINTS);
        let places: Vec<f64> = (0..=count as usize).map(|i| left + (right - left) * i as f64 / count).collect();
        self.film.profile(&places)
    }

    /// The scaled contact line on the right; none where its tangent meets the wall outside of the domain, as that of a film that
    /// covers the whole of it does.
    pub(crate) fn foot(&self) -> Option<Foot> {
        let end = self.surroundings.wall[1] / self.surroundings.scales.length;
        self.profile().foot(self.surroundings.right).filter(|foot| foot.position <= end)
    }

    /// The scaled places of the heights in frames: equal steps along the wall.
    pub(crate) fn frame_places(&self) -> Vec<f64> {
        let [left, right] = self.surroundings.wall.map(|x| x / self.surroundings.scales.length);
        (0..=FRAME_PLACES).map(|i| left + (right - left) * f64::from(i) / f64::from(FRAME_PLACES)).collect()
    }

    fn frame(&self) -> Frame {
        let time = self.film.time();
        let heights = self.film.heights(&self.frame_places());
        Frame { time, heights, ways: self.film.ways(WAYS) }
    }

    /// Column of the film's size, and its unit of scaled mass: an area in the plane, a volume about an axis.
    fn mass_unit(&self) -> (&'static str, f64) {
        let s = &self.surroundings.scales;
        if self.surroundings.about_axis { ("volume_m3", s.area() * s.length) } else { ("area_m2", s.area()) }
    }

    fn fastest(&self) -> (f64, f64) {
        let seen = self.film.seen();
        let pairs = seen.velocity.iter().zip(&seen.x);
        pairs.map(|(v, x)| (v.abs(), *x)).fold((0.0, 0.0), |a, b| if b.0 > a.0 { b } else { a })
    }

    /// Why heights fall below 0, and what would help.
    fn why_negative(&self) -> &'static str {
        if self.surroundings.rest.is_some() && self.film.time() > LONG {
            "as films long at rest do (end the run earlier, or take a smaller spacing and a domain that the film does not fill)"
        } else {
            "although it still moves: its steps or its spacing are too long for it (take a smaller \
             thin-film.method.finite-differences.step-share or thin-film.spacing, and a domain that the film does not fill)"
        }
    }

    fn stuck(&self, stuck: Stuck) -> SolverError {
        let (time, step) = (self.time, self.steps);
        match stuck {
            Stuck::Inaccurate(dt) => {
                let dt = dt * self.surroundings.scales.time;
                let place = Vec2::new(self.fastest().1 * self.surroundings.scales.length, 0.0);
                SolverError::TimeStep { dt, smallest: dt, limit: "accuracy", time, step, place }
            }
            Stuck::Negative => SolverError::BlowUp {
                what: format!(
                    "the thin film falls below height 0 in all but the shortest steps, {}",
                    self.why_negative()
                ),
                time,
                step,
                place: Vec2::new(self.fastest().1 * self.surroundings.scales.length, 0.0),
            },
            Stuck::Residual(residual) => SolverError::NotConverged {
                system: "the thin film on its grid",
                residual,
                tolerance: super::backward_euler::RESIDUAL,
                iterations: super::backward_euler::FACTORS as usize,
                time,
                step,
            },
        }
    }
}

fn scalar(name: &'static str, unit: &'static str, values: impl IntoIterator<Item = f64>) -> Field<'static> {
    Field { name, unit, values: Values::Scalar(values.into_iter().collect::<Vec<_>>().into()) }
}

impl Solver for ThinFilmSolver {
    fn time(&self) -> f64 {
        self.time
    }

    fn steps(&self) -> u64 {
        self.steps
    }

    fn step(&mut self, until: f64) -> Result<StepInfo, SolverError> {
        let clock = Instant::now();
        let scale = self.surroundings.scales.time;
        let end = until / scale;
        let stepped = self.film.step(end);
        self.seconds += clock.elapsed().as_secs_f64();
        let dt = stepped.map_err(|stuck| self.stuck(stuck))? * scale;
        let time = self.film.time();
        if self.history.is_due(time)
            && let Some(foot) = self.foot()
        {
            let (position, slope, last) = (foot.position, foot.slope, self.film.last_particle());
            self.history.records.push(Record { time, position, slope, last });
        }
        if self.history.is_frame_due(time) {
            self.history.frames.push(self.frame());
        }
        let landed = self.film.time() >= end;
        self.time = if landed { until } else { (self.film.time() * scale).min(until.next_down()) };
        self.dt = dt;
        self.steps += 1;
        self.steps_here += 1;
        Ok(StepInfo { dt, limit: if landed { "record" } else { "accuracy" } })
    }

    fn snapshot(&self) -> Snapshot<'_> {
        let s = &self.surroundings.scales;
        let point = |(x, h): (&f64, &f64)| Vec2::new(x * s.length, h * s.height);
        let seen = self.film.seen();
        let points: Vec<Vec2> = seen.x.iter().zip(&seen.height).map(point).collect();
        let count = points.len();
        let velocity: Vec<Vec2> = seen.velocity.iter().map(|v| Vec2::new(v * s.velocity(), 0.0)).collect();
        let pressure = -s.tension * s.curvature();
        let (_, mass) = self.mass_unit();
        let integers = |values: Vec<i64>| Values::Integer(Cow::Owned(values));
        let fields = vec![
            Field { name: "id", unit: "", values: integers((0..count as i64).collect()) },
            Field { name: "phase", unit: "", values: integers(vec![0; count]) },
            Field { name: "velocity", unit: "m/s", values: Values::Vector(velocity.into()) },
            scalar("pressure", "Pa", seen.curvature.iter().map(|c| c * pressure)),
            scalar(
                "volume",
                if self.surroundings.about_axis { "m^3" } else { "m^2" },
                seen.mass.iter().map(|m| m * mass),
            ),
            scalar("film-height", "m", seen.height.iter().map(|h| h * s.height)),
        ];
        let profile = self.profile();
        let line: Vec<Vec2> = profile.x.iter().zip(&profile.height).map(point).collect();
        let lines = vec![(0..line.len() as u32).collect()];
        let curvature = scalar("curvature", "1/m", profile.curvature.iter().map(|c| c * s.curvature()));
        Snapshot {
            time: self.time,
            step: self.steps,
            particles: Cloud { points: points.into(), fields },
            grid: None,
            interface: Some(Lines { points: line.into(), lines, fields: vec![curvature] }),
        }
    }

    fn outline(&self) -> Lines<'_> {
        let wall = self.surroundings.wall.map(|x| Vec2::new(x, 0.0));
        Lines { points: wall.to_vec().into(), lines: vec![vec![0, 1]], fields: Vec::new() }
    }

    fn sample(&self) -> Vec<Sample> {
        let s = &self.surroundings.scales;
        let foot = self.foot();
        let (mass_name, mass) = self.mass_unit();
        let (energy_name, energy) = if self.surroundings.about_axis {
            ("energy_J", s.energy() * s.length)
        } else {
            ("energy_J_per_m", s.energy())
        };
        let or_nothing = |value: Option<f64>| value.unwrap_or(f64::NAN);
        let row = [
            ("time_s", self.time),
            ("step", self.steps as f64),
            ("dt_s", self.dt),
            ("contact_line_position_m", or_nothing(foot.map(|foot| foot.position * s.length))),
            ("last_particle_position_m", or_nothing(self.film.last_particle().map(|x| x * s.length))),
            ("contact_angle_deg", or_nothing(foot.map(|foot| (foot.slope * s.slope()).atan().to_degrees()))),
            ("center_height_m", self.film.center_height() * s.height),
            (mass_name, self.film.mass() * mass),
            (energy_name, self.film.energy() * energy),
            ("max_speed_m_per_s", self.fastest().0 * s.velocity()),
        ];
        row.into_iter().map(|(name, value)| Sample { name, value }).collect()
    }

    fn measures(&self, _series: &Series) -> Vec<Measure> {
        measures::all(self)
    }

    fn warnings(&self, _series: &Series) -> Vec<String> {
        warnings::all(self)
    }

    fn diagrams(&self) -> Vec<Diagram> {
        diagrams::all(self)
    }

    fn state(&self) -> Vec<u8> {
        let (scaled_time, next, corrects, values) = match &self.film {
            Film::Particles { method, state } => (state.time, state.next, method.corrects(), state.x.clone()),
            Film::Grid(grid) => (grid.state.time, grid.state.next, false, grid.state.height.clone()),
        };
        let (time, dt, steps) = (self.time, self.dt, self.steps);
        let saved = Saved { time, dt, steps, scaled_time, next, corrects, values, history: self.history.clone() };
        // Numbers in a list always fit into a vector of bytes.
        postcard::to_stdvec(&saved).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> Result<(), StateError> {
        let saved: Saved = postcard::from_bytes(state).map_err(|error| StateError(error.to_string()))?;
        let count = match &self.film {
            Film::Particles { state, .. } => state.x.len(),
            Film::Grid(grid) => grid.state.height.len(),
        };
        if saved.values.len() != count {
            return Err(StateError(format!("expected {count} particles or nodes, found {}", saved.values.len())));
        }
        (self.time, self.dt, self.steps) = (saved.time, saved.dt, saved.steps);
        self.history = saved.history;
        match &mut self.film {
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
        match &self.film {
            Film::Particles { state, .. } => state.steps_to(end / self.surroundings.scales.time),
            Film::Grid(grid) => Some(grid.state.steps_to(end / self.surroundings.scales.time)),
        }
    }

    fn statistics(&self) -> Statistics {
        Statistics {
            unknowns: match &self.film {
                Film::Particles { state, .. } => state.x.len(),
                Film::Grid(grid) => grid.state.height.len(),
            },
            steps: self.steps_here,
            parts: vec![PartTime { part: "film", seconds: self.seconds }],
            counts: self.film.counts(),
        }
    }
}
