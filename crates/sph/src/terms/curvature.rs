//! Curvature of the interface [Huber2013, Eq. 19], normalized over valid normals as in Morris 2000.

use crate::pairs::Pairs;
use crate::parallel::values;
use meniscus_core::math::Vec2;

/// |n| in units of 1/h below which a normal is noise, for [`unit_normal`].
const SMALLEST_NORMAL: f64 = 0.01;

/// The unit normal n̂_a of normals n_a longer than 0.01/h, else zero: not valid [Morris2000, Sect. 3.3]. `h` in m.
pub fn unit_normal(normal: &[Vec2], h: f64) -> Vec<Vec2> {
    values(normal.len(), |a| {
        let length = normal[a].norm();
        if length > SMALLEST_NORMAL / h { normal[a] / length } else { Vec2::zeros() }
    })
}

/// Curvature κ = −∇·n̂ in 1/m [Huber2013, Eq. 19; Morris2000, Sect. 3.3], positive for a drop of the wetting phase. κ_a = −Σ_b V_b (n̂_b − n̂_a)·∇_a W_ab / Σ_b
/// V_b W_ab, over fluid with a valid normal.
pub fn curvature(pairs: &Pairs, fluid_volume: &[f64], unit_normal: &[Vec2], count: usize) -> Vec<f64> {
    let valid = |a: usize| unit_normal[a] != Vec2::zeros();
    values(count, |a| {
        if !valid(a) {
            return 0.0;
        }
        let own = fluid_volume[a] * pairs.w_self;
        let (sum, norm) = pairs.of(a).filter(|ab| valid(ab.b)).fold((0.0, own), |(sum, norm), ab| {
            let v_b = fluid_volume[ab.b];
            (sum - v_b * (unit_normal[ab.b] - unit_normal[a]).dot(&ab.grad_w), norm + v_b * ab.w)
        });
        if norm > 0.0 { sum / norm } else { 0.0 }
    })
}
