//! Properties of a film on a grid needed by solver and output, whatever its equation.

use super::backward_euler::Balance;

/// An equation on a grid. Heights are those for which the equation is solved: h̄ in the geometric one, else h.
pub trait Grid: Balance + std::fmt::Debug + Send + Sync {
    /// Positions of the nodes, ascending.
    fn nodes(&self) -> Vec<f64>;

    /// Area (plane film) or volume (axisymmetric film) per unit height of each node.
    fn sizes(&self) -> Vec<f64>;

    /// Derivative and curvature of the heights.
    fn slope_and_curvature(&self, v: &[f64]) -> [Vec<f64>; 2];

    /// Velocity of the film at the nodes; 0 where there is practically no film.
    fn velocity(&self, v: &[f64]) -> Vec<f64>;

    fn energy(&self, v: &[f64]) -> f64;
}

/// The error of a Newton step by the Jacobian at a wavy film, from the central difference of the residual, which is accurate to rounding over its step.
#[cfg(test)]
pub(super) fn error_of_jacobian(grid: &impl Grid, old: &[f64]) -> f64 {
    let (dt, tiny) = (1.0e-3, 1.0e-6);
    let v: Vec<f64> = grid.nodes().iter().map(|x| 0.4 + 0.3 * (3.0 * x).cos()).collect();
    let change: Vec<f64> = (0..v.len()).map(|i| (1.3 * i as f64).sin()).collect();
    let at = |sign: f64| {
        let v: Vec<f64> = v.iter().zip(&change).map(|(v, c)| v + sign * tiny * c).collect();
        grid.residual(&v, old, dt)
    };
    let mut found: Vec<f64> = at(1.0).iter().zip(at(-1.0)).map(|(up, down)| (up - down) / (2.0 * tiny)).collect();
    grid.jacobian(&v, dt).unwrap().solve(&mut found);
    found.iter().zip(&change).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}
