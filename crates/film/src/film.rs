//! A common interface to the two methods for the solver and the output. Scaled.

use super::grid_film::GridFilm;
use super::ode::{Integrator, Rates};
use super::particles::{ParticleMethod, WIDEST_GAP, widest_gap};
use super::profile::Profile;

/// The state of a film.
#[derive(Debug, Clone)]
pub(crate) enum Film {
    /// Particles on an infinite line.
    Particles {
        /// The equation.
        method: Box<ParticleMethod>,
        state: Integrator,
    },
    /// Nodes of a grid.
    Grid(Box<GridFilm>),
}

/// A failed step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FailedStep {
    /// No step of the particles meets the tolerance, down to this one.
    Inaccurate(f64),
    /// Newton's method on the grid ended at heights below 0.
    Negative,
    /// Newton's method on the grid ended with this residual.
    Residual(f64),
}

/// The observed quantities of a film at its particles or nodes.
#[derive(Debug, Clone, Default)]
pub(crate) struct FilmFields {
    /// Positions.
    pub(crate) x: Vec<f64>,
    /// h̄.
    pub(crate) height: Vec<f64>,
    /// h̄ₓₓ.
    pub(crate) curvature: Vec<f64>,
    /// Velocity along the wall.
    pub(crate) velocity: Vec<f64>,
    /// Mass of the particle or node.
    pub(crate) mass: Vec<f64>,
}

impl Film {
    /// Scaled time.
    pub(crate) fn time(&self) -> f64 {
        match self {
            Self::Particles { state, .. } => state.time,
            Self::Grid(grid) => grid.state.time,
        }
    }

    /// Does one step that ends at `until` or before. Returns its length.
    ///
    /// # Errors
    /// [`FailedStep`]; the state is kept.
    pub(crate) fn step(&mut self, until: f64) -> Result<f64, FailedStep> {
        match self {
            Self::Particles { method, state } => {
                if method.corrects() && widest_gap(&state.x) > WIDEST_GAP * method.kernel.alpha {
                    method.keep_lattice_energy();
                }
                state.step(method.as_mut(), until).map_err(|error| FailedStep::Inaccurate(error.0))
            }
            Self::Grid(grid) => {
                grid.step(until).map_err(|error| error.residual.map_or(FailedStep::Negative, FailedStep::Residual))
            }
        }
    }

    /// Observed quantities at the particles or nodes.
    pub(crate) fn fields(&self) -> FilmFields {
        match self {
            Self::Particles { method, state } => {
                // The sums need work space, which is discarded.
                let mut method = method.clone();
                let mut velocity = vec![0.0; state.x.len()];
                method.rates(&state.x, &mut velocity);
                let mass = method.weight.clone();
                let smoothed = method.smooth(&state.x);
                let (height, curvature) = (smoothed.height.clone(), smoothed.curvature.clone());
                FilmFields { x: state.x.clone(), height, curvature, velocity, mass }
            }
            Self::Grid(film) => {
                let (grid, height) = (film.grid(), film.state.height.clone());
                let [_, curvature] = grid.slope_and_curvature(&height);
                let mass = height.iter().zip(grid.sizes()).map(|(h, size)| h * size).collect();
                FilmFields { x: grid.nodes(), curvature, velocity: grid.velocity(&height), mass, height }
            }
        }
    }

    /// The profile at ascending positions; on a grid at its nodes.
    pub(crate) fn profile(&self, positions: &[f64]) -> Profile {
        match self {
            Self::Particles { method, state } => {
                let s = method.profile(&state.x, positions);
                Profile { x: positions.to_vec(), height: s.height, slope: s.slope, curvature: s.curvature }
            }
            Self::Grid(film) => {
                let (grid, height) = (film.grid(), film.state.height.clone());
                let [slope, curvature] = grid.slope_and_curvature(&height);
                Profile { x: grid.nodes(), height, slope, curvature }
            }
        }
    }

    /// Heights at ascending positions, interpolated linearly between nodes of a grid; 0 beyond its ends.
    pub(crate) fn heights(&self, positions: &[f64]) -> Vec<f64> {
        match self {
            Self::Particles { method, state } => method.profile(&state.x, positions).height,
            Self::Grid(film) => {
                let (x, height) = (film.grid().nodes(), &film.state.height);
                let at = |&position: &f64| {
                    let after = x.partition_point(|&x| x < position);
                    match after {
                        0 => x.first().filter(|&&x| x == position).map_or(0.0, |_| height[0]),
                        _ if after == x.len() => 0.0,
                        _ => {
                            let share = (position - x[after - 1]) / (x[after] - x[after - 1]);
                            height[after - 1] + share * (height[after] - height[after - 1])
                        }
                    }
                };
                positions.iter().map(at).collect()
            }
        }
    }

    /// The positions of up to `count` particles from the middle one to the last, evenly chosen; empty on a grid.
    pub(crate) fn particle_positions(&self, count: usize) -> Vec<f64> {
        let Self::Particles { state, .. } = self else { return Vec::new() };
        let right = &state.x[state.x.len() / 2..];
        let last = right.len().saturating_sub(1);
        let chosen = |i: usize| right.get((i + 1) * last / count).copied();
        (0..count.min(last)).filter_map(chosen).collect()
    }

    /// h̄ at x = 0.
    pub(crate) fn center_height(&self) -> f64 {
        match self {
            Self::Particles { method, state } => method.profile(&state.x, &[0.0]).height[0],
            Self::Grid(grid) => grid.center_height(),
        }
    }

    /// Position of the last particle; `None` on a grid.
    pub(crate) fn last_particle(&self) -> Option<f64> {
        match self {
            Self::Particles { state, .. } => state.x.last().copied(),
            Self::Grid(_) => None,
        }
    }

    pub(crate) fn energy(&self) -> f64 {
        match self {
            Self::Particles { method, state } => method.clone().energy(&state.x),
            Self::Grid(grid) => grid.energy(),
        }
    }

    pub(crate) fn mass(&self) -> f64 {
        match self {
            Self::Particles { method, .. } => method.area,
            Self::Grid(grid) => grid.mass(),
        }
    }

    /// Slope of the spurious contact angle of the particle lattice; `None` on a grid, or if it is corrected.
    pub(crate) fn lattice_slope(&self) -> Option<f64> {
        match self {
            Self::Particles { method, .. } => (!method.corrects()).then(|| method.lattice_slope()),
            Self::Grid(_) => None,
        }
    }

    /// Work counters by name.
    pub(crate) fn counts(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Particles { state, .. } => vec![
                ("rate-evaluations", state.work.rates as f64),
                ("factorizations", state.work.factors as f64),
                ("rejected-steps", state.work.rejected as f64),
            ],
            Self::Grid(grid) => {
                vec![
                    ("newton-iterations", grid.state.iterations as f64),
                    ("factorizations", grid.state.factors as f64),
                    ("rejected-steps", grid.state.rejected as f64),
                ]
            }
        }
    }
}
