//! Decay time of the slowest viscous mode in a pore.

use rayon::prelude::*;

use crate::domain::{Domain, ImageVelocity};
use crate::fill::Lattice;
use crate::method::Method;
use meniscus_core::math::Vec2;

/// Square of the first zero of the Bessel function J_0: flow along a cylindrical pore of radius R decays at the rate 5.78 ν/R².
const ROUND_PORE: f64 = 5.783_186;

/// R²/(5.78 ν) in s, with the radius R of the largest circle between no-slip walls and the larger kinematic viscosity ν. Infinite with
/// surface tension, which limits the step itself, and without walls.
///
/// `wall_distance` in m, positive in the fluid. Evaluated on the lattice and not on particles, so that a resumed run obtains the same value.
pub(super) fn viscous_time(
    method: &Method,
    lattice: &Lattice,
    domain: &Domain,
    wall_distance: impl Fn(Vec2) -> f64 + Sync,
) -> f64 {
    if method.tension > 0.0 {
        return f64::INFINITY;
    }
    let fluids = [method.wetting_fluid, method.other_fluid];
    let viscosity = fluids.iter().map(|fluid| fluid.viscosity / fluid.density).fold(0.0, f64::max);
    let points: Vec<Vec2> = lattice.inside().collect();
    let distance = |x: &Vec2| {
        let images = domain.mirrors.iter().filter(|mirror| mirror.image == ImageVelocity::Reversed);
        images.map(|mirror| (x[mirror.axis] - mirror.at).abs()).fold(wall_distance(*x), f64::min)
    };
    let radius = points.par_iter().map(distance).reduce(|| 0.0, f64::max);
    radius * radius / (ROUND_PORE * viscosity)
}
