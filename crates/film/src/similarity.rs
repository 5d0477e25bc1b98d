//! The self-similar droplet of the equation without regularization [Pang2022, Eqs. 12-14].
//!
//! h̄ = t^(−1/7) f(η), x = η t^(1/7) turns h_t = −∂ₓ(h³ hₓₓₓ) into f''' = η/(7f²) with f'(0) = 0. No solution has a contact line at
//! f = 0 (the no-slip singularity), so f''(0) is fitted to a computed droplet by shooting: this tests the shape only.

use nalgebra::{Matrix4, Vector4};

use super::ode::{Implicit, Integrator, Rates, Tolerance};
use super::profile::Profile;
use meniscus_case::film::FilmIntegrator;

/// Exponent of time in x; the negative of that in h̄.
pub(crate) const EXPONENT: f64 = 1.0 / 7.0;
/// Fraction of the droplet covered by the fit: beyond, the shape depends on the regularization of the contact line.
pub(crate) const COVERED: f64 = 0.7;
/// Largest error of f over f(0) in the integration.
const TOLERANCE: f64 = 1.0e-10;
/// The bracket of f''(0) around its initial guess.
const BRACKET: (f64, f64) = (1.6, 0.6);
/// Golden-section steps: each keeps 0.618 of the bracket.
const SEARCH_STEPS: u32 = 50;

/// A fitted shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fit {
    /// f(0).
    pub(crate) height: f64,
    /// f''(0).
    pub(crate) curvature: f64,
    /// Largest difference of shape and droplet over f(0).
    pub(crate) error: f64,
}

/// (η, f, f', f'') along η.
struct Shooting;

impl Rates for Shooting {
    fn rates(&mut self, y: &[f64], out: &mut [f64]) {
        out.copy_from_slice(&[1.0, y[2], y[3], EXPONENT * y[0] / (y[1] * y[1])]);
    }

    fn admissible(&self, y: &[f64]) -> bool {
        y.iter().all(|y| y.is_finite()) && y[1] > 0.0
    }
}

impl Implicit for Shooting {
    type System = Matrix4<f64>;

    fn factor(&mut self, y: &[f64], shift: f64) -> Option<Matrix4<f64>> {
        let mut matrix = Matrix4::identity() * shift;
        matrix[(1, 2)] = -1.0;
        matrix[(2, 3)] = -1.0;
        matrix[(3, 0)] = -EXPONENT / (y[1] * y[1]);
        matrix[(3, 1)] = 2.0 * EXPONENT * y[0] / y[1].powi(3);
        matrix.try_inverse()
    }

    fn solve(inverse: &mut Matrix4<f64>, rhs: &mut [f64]) {
        let solved = *inverse * Vector4::from_row_slice(rhs);
        rhs.copy_from_slice(solved.as_slice());
    }
}

/// The self-similar shape f at the ascending positions `eta` for f(0) and f''(0) [Pang2022, Eqs. 12-14]. The list ends where the integration fails near the
/// wall.
pub(crate) fn shoot(height: f64, curvature: f64, eta: &[f64]) -> Vec<f64> {
    let tolerance = Tolerance { absolute: TOLERANCE * height, relative: TOLERANCE };
    let start = vec![0.0, height, 0.0, curvature];
    let mut state = Integrator::new(FilmIntegrator::Explicit, tolerance, start, 1.0e-3);
    let mut f = Vec::with_capacity(eta.len());
    for &position in eta {
        if state.run(&mut Shooting, position).is_err() {
            break;
        }
        f.push(state.x[1]);
    }
    f
}

/// The least-squares fit of the shape to the middle part of a droplet at the time `t` with its contact line at `contact_line`.
pub(crate) fn fit(profile: &Profile, t: f64, contact_line: f64) -> Option<Fit> {
    let stretch = t.powf(EXPONENT);
    let middle = (0..profile.x.len()).filter(|&i| (0.0..COVERED * contact_line).contains(&profile.x[i]));
    let (eta, f): (Vec<f64>, Vec<f64>) = middle.map(|i| (profile.x[i] / stretch, profile.height[i] * stretch)).unzip();
    let height = height_at_zero(&eta, &f)?;
    let misfit = |curvature: f64| {
        let shape = shoot(height, curvature, &eta);
        let off = |i: usize| shape.get(i).copied().unwrap_or(0.0) - f[i];
        let squares: f64 = (0..eta.len()).map(|i| off(i).powi(2)).sum();
        let largest = (0..eta.len()).map(|i| off(i).abs()).fold(0.0, f64::max);
        (squares, largest / height)
    };
    // A parabola through the center and the last point.
    let (last_eta, last_f) = (*eta.last()?, *f.last()?);
    let guess = 2.0 * (last_f - height) / (last_eta * last_eta);
    let curvature = least(|c| misfit(c).0, BRACKET.0 * guess, BRACKET.1 * guess);
    Some(Fit { height, curvature, error: misfit(curvature).1 })
}

/// f(0) by the even parabola through the first two points.
fn height_at_zero(eta: &[f64], f: &[f64]) -> Option<f64> {
    let (a, b) = (eta.first()?.powi(2), eta.get(1)?.powi(2));
    Some((f[0] * b - f[1] * a) / (b - a))
}

/// The minimum of a unimodal function by golden-section search.
fn least(function: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut a, mut b) = (from, to);
    let (mut left, mut right) = (b - golden * (b - a), a + golden * (b - a));
    let (mut at_left, mut at_right) = (function(left), function(right));
    for _ in 0..SEARCH_STEPS {
        if at_left < at_right {
            (b, right, at_right) = (right, left, at_left);
            left = b - golden * (b - a);
            at_left = function(left);
        } else {
            (a, left, at_left) = (left, right, at_right);
            right = a + golden * (b - a);
            at_right = function(right);
        }
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Pang2022, Eqs. 12-14]
    #[test]
    fn a_shot_solves_its_equation() {
        let step = 0.005;
        let eta: Vec<f64> = (0..97).map(|i| step * f64::from(i)).collect();
        let f = shoot(0.27, -1.2, &eta);
        assert_eq!(f.len(), eta.len());
        for i in 2..95 {
            let third = (f[i + 2] - 2.0 * f[i + 1] + 2.0 * f[i - 1] - f[i - 2]) / (2.0 * step.powi(3));
            // The differences are accurate to the fifth derivative times a quarter of the squared step.
            assert!((third - eta[i] / (7.0 * f[i] * f[i])).abs() < 1.0e-2, "{i}: {third}");
        }
        // The no-slip singularity: near the wall the solution turns and never reaches it.
        let far: Vec<f64> = (0..200).map(|i| step * f64::from(i)).collect();
        let f = shoot(0.27, -1.2, &far);
        assert!(f.len() == 200 && f.iter().all(|&f| f > 0.0) && f[199] > f[150], "{f:?}");
    }

    #[test]
    fn the_fit_gives_back_the_shape_it_is_given() {
        let t = 30.0_f64;
        let stretch = t.powf(EXPONENT);
        let eta: Vec<f64> = (0..60).map(|i| 0.01 * f64::from(i)).collect();
        let f = shoot(0.27, -1.2, &eta);
        let x = eta.iter().map(|eta| eta * stretch).collect();
        let profile = Profile { x, height: f.iter().map(|f| f / stretch).collect(), ..Profile::default() };
        let found = fit(&profile, t, 0.8 * stretch).unwrap();
        assert!((found.curvature + 1.2).abs() < 1.0e-6 && (found.height - 0.27).abs() < 1.0e-5, "{found:?}");
        assert!(found.error < 1.0e-5);
    }
}
