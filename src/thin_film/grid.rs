//! Properties of a film on a grid needed by solver and output, whatever its equation.

use super::backward_euler::Balance;

/// An equation on a grid. Heights are those for which the equation is solved: h̄ in the geometric one, else h.
pub trait Grid: Balance {
    /// Positions of the nodes, ascending.
    fn nodes(&self) -> Vec<f64>;

    /// Area (plane film) or volume (axisymmetric film) per unit height of each node.
    fn sizes(&self) -> Vec<f64>;

    /// Derivative and curvature of the heights.
    fn slope_and_curvature(&self, v: &[f64]) -> [Vec<f64>; 2];

    /// Velocity of the film at the nodes; 0 where there is practically no film.
    fn velocity(&self, v: &[f64]) -> Vec<f64>;

    /// Energy.
    fn energy(&self, v: &[f64]) -> f64;
}
