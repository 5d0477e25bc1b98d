//! Strays: single particles that an advancing or receding interface leaves in the other phase.
//!
//! Nothing in the equations brings them back: the smoothed color does not see a particle alone, and a wall that holds the
//! first layer of particles leaves a trail of them behind a receding contact line. Like the compression of the color
//! function in volume-of-fluid codes, a drift across the interface keeps the phases apart; it is zero wherever a particle
//! has its own kind around it, so an interface at rest does not feel it.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::math::Vec2;
use crate::sph::pairs::{Pairs, each};

/// A particle with a smaller share of its own kind among its neighbors is a stray. The first layer of a flat interface
/// has one half, a particle that stands out of it by dx about a quarter.
const FEW: f64 = 0.2;

/// Largest speed of strays over the capillary speed: a few times that of the contact lines which leave them.
const SPEED: f64 = 0.2;

/// Below this color gradient, in units of 1/h, no interface is in reach to go back to.
const SMALLEST_GRADIENT: f64 = 0.02;

/// What decides which particles are strays; slices over particles and images, the wall distance over fluid particles.
pub struct Strays<'a> {
    /// Side of the interface: 1 in the wetting phase, 0 in the other.
    pub side: &'a [f64],
    /// Gradient of the smoothed color in 1/m.
    pub normal: &'a [Vec2],
    /// V_a in m² on fluid, 0 on walls.
    pub fluid_volume: &'a [f64],
    /// Wall distance in m, infinite where no wall is in reach.
    pub wall_distance: &'a [f64],
    /// Wall normal at fluid particles, zero where no wall is in reach.
    pub wall_normal: &'a [Vec2],
    /// Static contact angle in rad, if any.
    pub angle: Option<f64>,
}

impl Strays<'_> {
    /// Adds to `shift` (m) the way of strays across the interface. `h` in m, `way` = capillary speed times Δt in m.
    pub fn send_back(&self, pairs: &Pairs, h: f64, way: f64, shift: &mut [Vec2]) {
        let mut back = vec![Vec2::zeros(); shift.len()];
        each(&mut back, |a| {
            let n = self.normal[a];
            if n.norm() < SMALLEST_GRADIENT / h {
                return Vec2::zeros();
            }
            let few = self.few(a);
            let share = self.share_of_own_kind(pairs, a);
            let into_own_phase = if self.side[a] > 0.5 { n.normalize() } else { -n.normalize() };
            SPEED * way * (1.0 - share / few).max(0.0) * self.off_the_wall(a, h, into_own_phase)
        });
        shift.iter_mut().zip(&back).for_each(|(shift, back)| *shift += back);
    }

    /// `direction` without its part into a wall nearer than `h` (m): a stray that is pressed against it comes back on no way.
    fn off_the_wall(&self, a: usize, h: f64, direction: Vec2) -> Vec2 {
        if self.wall_distance[a] < h {
            direction - direction.dot(&self.wall_normal[a]).min(0.0) * self.wall_normal[a]
        } else {
            direction
        }
    }

    /// The share below which a particle is a stray: smaller in the thin wedge of its phase at a wall.
    fn few(&self, a: usize) -> f64 {
        match self.angle {
            Some(angle) if self.wall_distance[a].is_finite() => {
                let own = if self.side[a] > 0.5 { angle } else { PI - angle };
                FEW * (own / FRAC_PI_2).clamp(f64::EPSILON, 1.0)
            }
            _ => FEW,
        }
    }

    /// Σ V W over fluid neighbors of the same kind over that of all fluid neighbors, the particle itself left out.
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
    use crate::math::Bounds;
    use crate::sph::domain::Domain;
    use crate::sph::kernel::WendlandC2;

    const H: f64 = 1.5;

    /// A lattice of spacing 1 whose left half is the wetting phase; `swapped` is the place of one particle of the wrong kind.
    fn shifts(swapped: Option<Vec2>) -> Vec<(Vec2, Vec2)> {
        let bounds = Bounds { min: Vec2::repeat(-8.0), max: Vec2::repeat(8.0) };
        let domain = Domain::new(bounds, [false; 2], vec![]);
        let points: Vec<Vec2> = (0..256).map(|i| Vec2::new(f64::from(i % 16) - 7.5, f64::from(i / 16) - 7.5)).collect();
        let is_swapped = |x: &Vec2| swapped == Some(*x);
        let side: Vec<f64> = points.iter().map(|x| f64::from(u8::from((x.x < 0.0) != is_swapped(x)))).collect();
        let pairs = Pairs::find(&points, points.len(), &domain, &WendlandC2::new(H));
        let normal = vec![Vec2::new(-0.5 / H, 0.0); points.len()];
        let (ones, far, zeros) = (vec![1.0; 256], vec![f64::INFINITY; 256], vec![Vec2::zeros(); 256]);
        let strays = Strays {
            side: &side,
            normal: &normal,
            fluid_volume: &ones,
            wall_distance: &far,
            wall_normal: &zeros,
            angle: None,
        };
        let mut shift = vec![Vec2::zeros(); points.len()];
        strays.send_back(&pairs, H, 0.1, &mut shift);
        points.into_iter().zip(shift).collect()
    }

    #[test]
    fn a_flat_interface_feels_nothing() {
        assert!(shifts(None).iter().all(|(_, by)| *by == Vec2::zeros()));
    }

    #[test]
    fn a_particle_alone_in_the_other_phase_goes_back_across_the_interface() {
        let stray = Vec2::new(2.5, 0.5);
        for (x, by) in shifts(Some(stray)) {
            if x == stray {
                assert!(by.x < 0.0 && by.y == 0.0, "{by:?}");
            } else {
                assert_eq!(by, Vec2::zeros(), "at {x:?}");
            }
        }
    }
}
