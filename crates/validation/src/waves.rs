//! Linear viscous capillary modes of two fluids of equal density and viscosity: plane waves and free drops.
//!
//! For equal fluids the interface is a sheet of force in a single fluid, and its motion follows in closed form from the Green's function of the unsteady
//! Stokes equation. Gravity, walls and different fluids are not included (for these see Prosperetti 1981). The Laplace transforms are in `capillary_wave` and
//! `oscillating_drop`; here is their inverse.

use std::f64::consts::PI;

use nalgebra::Complex;

/// Fewest nodes of the inverse Laplace transform: enough to enclose the poles over three periods, with nine digits unaffected by rounding.
const FEWEST: usize = 40;
/// Nodes per radian of a longer oscillation.
const PER_RADIAN: f64 = 2.0;

/// A function of time from its Laplace transform, at `time` (s) above 0, when it has turned by the `phase` (rad), by a fixed Talbot contour \[AbateValko2004\].
pub(crate) fn inverse_laplace(transform: impl Fn(Complex<f64>) -> Complex<f64>, time: f64, phase: f64) -> f64 {
    let nodes = FEWEST.max((PER_RADIAN * phase).ceil() as usize);
    let r = 2.0 * nodes as f64 / (5.0 * time);
    let first = 0.5 * (transform(Complex::new(r, 0.0)).re * (r * time).exp());
    let node = |k: usize| {
        let angle = k as f64 * PI / nodes as f64;
        let cotangent = 1.0 / angle.tan();
        let s = r * angle * Complex::new(cotangent, 1.0);
        let slope = Complex::new(1.0, angle + (angle * cotangent - 1.0) * cotangent);
        ((s * time).exp() * transform(s) * slope).re
    };
    r / nodes as f64 * (first + (1..nodes).map(node).sum::<f64>())
}
