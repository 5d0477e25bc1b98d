//! A film on a grid: its equation, its state and quantities derived from both.

use std::sync::Arc;

use super::backward_euler::{BackwardEuler, NotSolved, StepRule};
use super::grid::Grid;

/// A film on a grid.
#[derive(Debug, Clone)]
pub struct GridFilm {
    equation: Arc<dyn Grid>,
    /// Heights, time and counts.
    pub state: BackwardEuler,
}

impl GridFilm {
    /// A film at time zero.
    pub fn new(equation: impl Grid + 'static, height: Vec<f64>, rule: StepRule) -> Self {
        Self { equation: Arc::new(equation), state: BackwardEuler::new(height, rule) }
    }

    /// Its equation.
    pub fn grid(&self) -> &dyn Grid {
        self.equation.as_ref()
    }

    /// Does one step that ends at `until` or before. Returns its length.
    ///
    /// # Errors
    /// [`NotSolved`]; the state is kept.
    pub fn step(&mut self, until: f64) -> Result<f64, NotSolved> {
        self.state.step(self.equation.as_ref(), until)
    }

    /// Runs to `until`.
    pub fn run(&mut self, until: f64) -> Result<(), NotSolved> {
        self.state.run(self.equation.as_ref(), until)
    }

    /// Mass: Σ heights × sizes, conserved by the steps.
    pub fn mass(&self) -> f64 {
        self.grid().sizes().iter().zip(&self.state.height).map(|(size, v)| size * v).sum()
    }

    pub(crate) fn energy(&self) -> f64 {
        self.grid().energy(&self.state.height)
    }

    /// Height at x = 0, by a parabola through the three nodes around it.
    pub fn center_height(&self) -> f64 {
        let (x, v) = (self.grid().nodes(), &self.state.height);
        let after = x.partition_point(|&x| x < 0.0);
        // The first node of an axisymmetric film is half a cell off the axis; its mirror image has the same height.
        if after == 0 {
            return if v.len() > 1 { (9.0 * v[0] - v[1]) / 8.0 } else { f64::NAN };
        }
        let middle = if after < x.len() && x[after] < -x[after - 1] { after } else { after - 1 };
        if middle == 0 || middle + 1 >= x.len() {
            return v.get(middle).copied().unwrap_or(f64::NAN);
        }
        let share = -x[middle] / (x[middle + 1] - x[middle]);
        let (before, here, next) = (v[middle - 1], v[middle], v[middle + 1]);
        here + 0.5 * share * (next - before) + 0.5 * share * share * (next - 2.0 * here + before)
    }
}
