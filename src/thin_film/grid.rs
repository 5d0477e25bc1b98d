//! What solver and output need of a film on a grid, whatever its equation.

use super::backward_euler::Balance;

/// An equation on a grid. Heights are those that the equation is solved for: h̄ in the geometric one, else h.
pub trait Grid: Balance {
    /// Places of the nodes, ascending.
    fn nodes(&self) -> Vec<f64>;

    /// Area (of a plane film) or volume (of one about an axis) that a unit of height stands for at each node.
    fn sizes(&self) -> Vec<f64>;

    /// Derivative and curvature of the heights.
    fn slope_and_curvature(&self, v: &[f64]) -> [Vec<f64>; 2];

    /// Velocity of the film at the nodes; 0 where there is next to nothing that could move.
    fn velocity(&self, v: &[f64]) -> Vec<f64>;

    /// Energy.
    fn energy(&self, v: &[f64]) -> f64;
}
