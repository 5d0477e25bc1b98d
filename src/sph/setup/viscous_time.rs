//! The time in which the slowest viscous motion of a pore decays.

use rayon::prelude::*;

use crate::math::Vec2;
use crate::sph::domain::{Domain, ImageVelocity};
use crate::sph::fill::Lattice;
use crate::sph::method::Method;

/// Square of the first zero of the Bessel function J_0: a flow along a round pore of the radius R decays at the rate 5.78 ν/R².
const ROUND_PORE: f64 = 5.783_186;

/// R²/(5.78 ν) in s, with the radius R of the largest circle between walls without slip and the larger kinematic viscosity ν. Infinite with
/// surface tension, which limits the step itself, and where nothing holds the fluid.
///
/// `wall_distance` in m, above 0 in the fluid. It follows from the lattice and not from particles, so that a resumed run finds the same.
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
    let room = |x: &Vec2| {
        let images = domain.mirrors.iter().filter(|mirror| mirror.image == ImageVelocity::Reversed);
        images.map(|mirror| (x[mirror.axis] - mirror.at).abs()).fold(wall_distance(*x), f64::min)
    };
    let radius = points.par_iter().map(room).reduce(|| 0.0, f64::max);
    radius * radius / (ROUND_PORE * viscosity)
}
