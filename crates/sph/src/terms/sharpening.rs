//! Interface sharpening: moves back single particles that an advancing or receding interface leaves in the other phase.
//!
//! Nothing in the equations returns them: the smoothed color does not resolve a single particle, and the no-slip first layer of particles on a wall leaves a
//! trail of them behind a receding contact line. As the compression of the color function in volume-of-fluid codes, a drift across the interface keeps the
//! phases apart; it vanishes for particles surrounded by their own phase, so that it does not affect an interface at rest.
//!
//! Surface tension retains a heavy phase beside or above a light one, but the curvature does not resolve lengths below its fit: single particles
//! would fall out of the interface one by one. Only there, particles that protrude from the first layer are moved back too.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::pairs::Pairs;
use crate::parallel::values;
use meniscus_core::math::Vec2;

/// A particle with a smaller fraction of its own phase among its neighbors is isolated. The first layer of a flat interface
/// has one half, a particle that protrudes from it by dx about a quarter.
const FEW: f64 = 0.2;

/// Largest speed of isolated particles over the capillary speed: a few times that of the contact lines that leave them behind.
const SPEED: f64 = 0.2;

/// Where the body force pulls a phase out through its interface, particles with a smaller fraction than this are moved back: slightly
/// less than that of the first layer of a flat interface.
const FIRST_LAYER: f64 = 0.45;

/// Speed of such particles over √(g h): twice the speed at which a heavy layer of the thickness h falls out of a light one.
const SAG: f64 = 2.0;

/// Color gradient, in units of 1/h, below which no interface is in reach.
const SMALLEST_GRADIENT: f64 = 0.02;

/// Input of the sharpening; slices over particles and images, wall distance and normal over fluid particles.
pub(crate) struct Sharpening<'a> {
    /// Side of the interface: 1 in the wetting phase, 0 in the other.
    pub(crate) side: &'a [f64],
    /// Gradient of the smoothed color in 1/m.
    pub(crate) normal: &'a [Vec2],
    /// V_a in m² on fluid, 0 on walls.
    pub(crate) fluid_volume: &'a [f64],
    /// Wall distance in m, infinite if no wall is in reach.
    pub(crate) wall_distance: &'a [f64],
    /// Wall normal at fluid particles, zero if no wall is in reach.
    pub(crate) wall_normal: &'a [Vec2],
    /// Density difference of the wetting and the other phase over their mean, times the body force per mass, in m/s².
    pub(crate) weight: Vec2,
    /// Receding and advancing angle in rad of the wall next to each fluid particle, NaN if there is none.
    pub(crate) wall_hysteresis: &'a [[f64; 2]],
}

impl Sharpening<'_> {
    /// Adds the displacement of isolated particles across the interface to `shift` (m). `h` in m, capillary `speed` in m/s, `dt` in s.
    pub(crate) fn displace(&self, pairs: &Pairs, h: f64, speed: f64, dt: f64, shift: &mut [Vec2]) {
        let back = values(shift.len(), |a| {
            let n = self.normal[a];
            if n.norm() < SMALLEST_GRADIENT / h {
                return Vec2::zeros();
            }
            let wedge = self.wedge(a);
            let share = self.share_of_own_kind(pairs, a) / wedge;
            let n_hat = n.normalize();
            let into_own_phase = if self.side[a] > 0.5 { n_hat } else { -n_hat };
            let isolated = SPEED * speed * (1.0 - share / FEW).max(0.0);
            // The same force pulls both phases across the interface: the heavy one out, the light one in.
            let pull = -self.weight.dot(&n_hat);
            let sag = SAG * (pull.max(0.0) * h).sqrt() * (1.0 - share / FIRST_LAYER).max(0.0);
            dt * isolated.max(sag) * self.off_the_wall(a, h, into_own_phase)
        });
        shift.iter_mut().zip(&back).for_each(|(shift, back)| *shift += back);
    }

    /// `direction` without its component into a wall closer than `h` (m): nothing would return a particle pressed into the wall.
    fn off_the_wall(&self, a: usize, h: f64, direction: Vec2) -> Vec2 {
        if self.wall_distance[a] < h {
            direction - direction.dot(&self.wall_normal[a]).min(0.0) * self.wall_normal[a]
        } else {
            direction
        }
    }

    /// Fraction of own-phase neighbors in the thin wedge of a phase at a wall, over the one half of a flat interface.
    fn wedge(&self, a: usize) -> f64 {
        let [receding, advancing] = self.wall_hysteresis[a];
        let own = if self.side[a] > 0.5 { receding } else { PI - advancing };
        if own.is_nan() { 1.0 } else { (own / FRAC_PI_2).clamp(f64::EPSILON, 1.0) }
    }

    /// Σ V W over fluid neighbors of the same phase over that of all fluid neighbors, excluding the particle itself.
    fn share_of_own_kind(&self, pairs: &Pairs, a: usize) -> f64 {
        let (own, all) = pairs.of(a).fold((0.0, 0.0), |(own, all), ab| {
            let weight = self.fluid_volume[ab.b] * ab.w;
            (own + if self.side[ab.b] == self.side[a] { weight } else { 0.0 }, all + weight)
        });
        if all > 0.0 { own / all } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Domain;
    use crate::kernel::WendlandC2;
    use meniscus_core::math::Bounds;

    const H: f64 = 1.5;

    /// Shifts on a lattice of spacing 1 whose left half is the wetting phase; `swapped` is the position of a particle of the wrong phase.
    fn shifts(swapped: Option<Vec2>, weight: Vec2) -> Vec<(Vec2, Vec2)> {
        let bounds = Bounds { min: Vec2::repeat(-8.0), max: Vec2::repeat(8.0) };
        let domain = Domain::new(bounds, [false; 2], vec![]);
        let points: Vec<Vec2> = (0..256).map(|i| Vec2::new(f64::from(i % 16) - 7.5, f64::from(i / 16) - 7.5)).collect();
        let is_swapped = |x: &Vec2| swapped == Some(*x);
        let side: Vec<f64> = points.iter().map(|x| f64::from(u8::from((x.x < 0.0) != is_swapped(x)))).collect();
        let pairs = Pairs::find(&points, points.len(), &domain, &WendlandC2::new(H));
        let normal = vec![Vec2::new(-0.5 / H, 0.0); points.len()];
        let (ones, far, zeros) = (vec![1.0; 256], vec![f64::INFINITY; 256], vec![Vec2::zeros(); 256]);
        let sharpening = Sharpening {
            side: &side,
            normal: &normal,
            fluid_volume: &ones,
            wall_distance: &far,
            wall_normal: &zeros,
            weight,
            wall_hysteresis: &vec![[f64::NAN; 2]; 256],
        };
        let mut shift = vec![Vec2::zeros(); points.len()];
        sharpening.displace(&pairs, H, 1.0, 0.1, &mut shift);
        points.into_iter().zip(shift).collect()
    }

    #[test]
    fn a_flat_interface_feels_nothing() {
        for weight in [Vec2::zeros(), Vec2::x(), -Vec2::x()] {
            assert!(shifts(None, weight).iter().all(|(_, by)| *by == Vec2::zeros()), "{weight:?}");
        }
    }

    #[test]
    fn a_particle_alone_in_the_other_phase_goes_back_across_the_interface() {
        let isolated = Vec2::new(2.5, 0.5);
        for (x, by) in shifts(Some(isolated), Vec2::zeros()) {
            if x == isolated {
                assert!(by.x < 0.0 && by.y == 0.0, "{by:?}");
            } else {
                assert_eq!(by, Vec2::zeros(), "at {x:?}");
            }
        }
    }

    #[test]
    fn a_particle_that_stands_out_goes_back_where_its_phase_would_fall_out_only() {
        // Next to the interface, in the other phase.
        let standing_out = Vec2::new(0.5, 0.5);
        let shift = |weight: Vec2| {
            let found = shifts(Some(standing_out), weight).into_iter().find(|(x, _)| *x == standing_out);
            found.map_or(Vec2::zeros(), |(_, by)| by)
        };
        assert_eq!(shift(Vec2::zeros()), Vec2::zeros());
        assert_eq!(shift(-Vec2::x()), Vec2::zeros());
        let back = shift(Vec2::x());
        assert!(back.x < 0.0 && back.y == 0.0, "{back:?}");
    }
}
