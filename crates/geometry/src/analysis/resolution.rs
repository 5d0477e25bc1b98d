//! Which fluid particles belong to a resolved flow, and which are isolated, in single rows, or in clusters of a few.
//!
//! A morphological opening (Serra 1982): the core of a phase are the particles that have only their own phase, or walls, within `CORE` spacings; all particles
//! within `REACH` spacings of the core belong to it. The remainder is thinner than about three particles.

use rayon::prelude::*;

use super::cells::Cells;
use meniscus_core::math::Vec2;

/// Radius in spacings within which a core particle has no other phase: more than the diagonal of the lattice.
const CORE: f64 = 1.5;

/// Distance from the core in spacings: two layers of particles.
const REACH: f64 = 2.2;

/// For each particle, whether its phase is locally thinner than about three particles \[Serra1982\].
///
/// `points` in m, `is_wetting` the phase of each, `spacing` in m, `period` in m.
pub fn thin_parts(points: &[Vec2], is_wetting: &[bool], spacing: f64, period: [Option<f64>; 2]) -> Vec<bool> {
    let cells = Cells::new(points, REACH * spacing, period);
    let all_near = |a: usize, reach: f64, holds: &dyn Fn(usize) -> bool| {
        let mut all = true;
        cells.for_each_near(points[a], reach * spacing, |b, _| all &= holds(b));
        all
    };
    let is_core: Vec<bool> =
        (0..points.len()).into_par_iter().map(|a| all_near(a, CORE, &|b| is_wetting[b] == is_wetting[a])).collect();
    let far_from_core = |a: usize| all_near(a, REACH, &|b| !(is_core[b] && is_wetting[b] == is_wetting[a]));
    (0..points.len()).into_par_iter().map(far_from_core).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::lattice::Lattice;

    /// [Serra1982]
    #[test]
    fn films_and_single_particles_are_thin_and_drops_and_interfaces_are_not() {
        let points = Lattice::open(Vec2::zeros(), Vec2::repeat(1.0), [40, 40]).nodes();
        let thin = |inside: &dyn Fn(&Vec2) -> bool| {
            let is_wetting: Vec<bool> = points.iter().map(inside).collect();
            thin_parts(&points, &is_wetting, 1.0, [None; 2]).iter().filter(|thin| **thin).count()
        };
        assert_eq!(thin(&|x| x.y < 10.5), 0, "a flat interface");
        assert_eq!(thin(&|x| (x - Vec2::repeat(20.0)).norm() < 8.3), 0, "a drop");
        assert_eq!(thin(&|x| (x - Vec2::repeat(20.0)).norm() < 0.5), 1, "a single particle");
        assert_eq!(thin(&|x| x.y == 20.0), 40, "a row");
        assert_eq!(thin(&|x| x.y == 20.0 || x.y == 21.0), 80, "two rows");
        assert_eq!(thin(&|x| (x.y - 20.0).abs() < 1.5), 0, "three rows");
        assert_eq!(thin(&|x| x.y < 0.5), 40, "a row on a wall");
    }
}
