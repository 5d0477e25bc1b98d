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
            SPEED * way * (1.0 - share / few).max(0.0) * into_own_phase
        });
        shift.iter_mut().zip(&back).for_each(|(shift, back)| *shift += back);
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
