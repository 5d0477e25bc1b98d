//! Flow along a film in a corner: the viscous velocity u with −∇²u = 1, no slip on wall and plate, no shear at the surface.
//!
//! In polar coordinates (s, φ) about the corner, the plate at φ = 0 and the wall at φ = π/2, the velocity is
//!
//! u = s² [(cos 2φ − 1)/4 − (ln s sin 2φ + φ cos 2φ)/π] + Σ_k a_k s^(2k) sin 2kφ,
//!
//! of which the first term satisfies the equation and all satisfy no slip; least squares of ∂u/∂n on the surface give the coefficients.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{DMatrix, DVector};

/// Terms of the series: the conductance has converged to six digits.
const TERMS: usize = 16;

/// Points on the surface, and directions of the integral.
const POINTS: usize = 400;

/// The conductance g of the film in a right-angled corner between a wall and a plate with these contact angles in rad: for a surface of the radius r (m) it
/// carries g r⁴ times the pressure gradient over the viscosity, in m³/s \[RansohoffRadke1988\]. 0 where the angles sum to 90 degrees or more.
pub fn conductance(wall: f64, plate: f64) -> f64 {
    let turn = FRAC_PI_2 - wall - plate;
    if turn <= 0.0 {
        return 0.0;
    }
    // The surface is an arc of unit radius about this point, seen from which it begins on the plate and ends on the wall.
    let (x, y) = (wall.cos(), plate.cos());
    let normal = |at: f64| {
        let angle = PI + wall + turn * (1.0 - at);
        [angle.cos(), angle.sin()]
    };
    let point = |at: f64| {
        let [nx, ny] = normal(at);
        [x + nx, y + ny]
    };
    // Lengths over the longer arm keep the powers of the series in range.
    let scale = (plate.cos() - wall.sin()).max(wall.cos() - plate.sin());
    let on_surface = |k: usize| (k as f64 + 0.5) / POINTS as f64;
    let mut shear = DMatrix::zeros(POINTS, TERMS);
    let mut driven = DVector::zeros(POINTS);
    for k in 0..POINTS {
        let (at, n) = (point(on_surface(k)), normal(on_surface(k)));
        let (s, phi) = (at[1].hypot(at[0]) / scale, at[1].atan2(at[0]));
        // The normal in the direction of s and across it.
        let along = n[0] * phi.cos() + n[1] * phi.sin();
        let across = n[1] * phi.cos() - n[0] * phi.sin();
        let (sin, cos) = (2.0 * phi).sin_cos();
        let shape = 0.25 * (cos - 1.0) - (s.ln() * sin + phi * cos) / PI;
        let of_phi = -0.5 * sin - (2.0 * s.ln() * cos + cos - 2.0 * phi * sin) / PI;
        driven[k] = s * (along * (2.0 * shape - sin / PI) + across * of_phi);
        for term in 0..TERMS {
            let power = 2.0 * (term + 1) as f64;
            let (sin, cos) = (power * phi).sin_cos();
            shear[(k, term)] = power * s.powf(power - 1.0) * (along * sin + across * cos);
        }
    }
    let svd = shear.svd(true, true);
    const SMALLEST: f64 = 1e-14;
    let Ok(solution) = svd.solve(&(-driven), SMALLEST) else { return f64::NAN };
    // The integral over the film, direction by direction up to the surface.
    let mut sum = 0.0;
    for k in 0..POINTS {
        let phi = FRAC_PI_2 * on_surface(k);
        let (along, across) = (x * phi.cos() + y * phi.sin(), x * phi.sin() - y * phi.cos());
        // The nearer of both points at which the ray meets the circle.
        let end = (along - (1.0 - across * across).max(0.0).sqrt()) / scale;
        let (sin, cos) = (2.0 * phi).sin_cos();
        let (fourth, ln) = (end.powi(4), end.ln());
        let shape = 0.25 * (cos - 1.0) - phi * cos / PI;
        sum += 0.25 * fourth * shape - sin / PI * fourth * (0.25 * ln - 1.0 / 16.0);
        for (term, a) in solution.iter().enumerate() {
            let power = 2.0 * (term + 1) as f64;
            sum += a * end.powf(power + 2.0) / (power + 2.0) * (power * phi).sin();
        }
    }
    sum * FRAC_PI_2 / POINTS as f64 * scale.powi(4)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [RansohoffRadke1988]
    #[test]
    fn corners_conduct_as_finite_elements_say() {
        for (deg, expected) in
            [(0.0_f64, 2.349e-3), (10.0, 1.880e-3), (20.0, 9.027e-4), (30.0, 1.901e-4), (40.0, 3.46e-6)]
        {
            let found = conductance(deg.to_radians(), deg.to_radians());
            assert!((found / expected - 1.0).abs() < 2e-3, "{deg}: {found:.4e} {expected:.4e}");
        }
        let [one, other] = [(0.2, 0.9), (0.9, 0.2)].map(|(wall, plate)| conductance(wall, plate));
        assert!((one / other - 1.0).abs() < 1e-4, "{one} {other}");
        assert_eq!(conductance(0.8, 0.8), 0.0);
    }
}
