//! Fills the pore and a layer of its walls with particles on a lattice, by the signed distance.

use crate::math::{Bounds, Vec2};
use crate::sph::domain::Domain;
use crate::sph::kernel::WendlandC2;
use crate::sph::particles::{Particles, Phase};

/// A square lattice that fits the box: a whole number of cells along each side, a particle in the middle of each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    bounds: Bounds,
    counts: [usize; 2],
    /// Distance of neighboring particles along x and y in m.
    pub step: Vec2,
}

impl Lattice {
    /// The lattice nearest to `spacing` (m) that fits `bounds`.
    #[must_use]
    pub fn fitting(bounds: Bounds, spacing: f64) -> Self {
        let size = bounds.size();
        let counts = [0, 1].map(|i| (size[i] / spacing).round().max(1.0) as usize);
        let step = Vec2::new(size.x / counts[0] as f64, size.y / counts[1] as f64);
        Self { bounds, counts, step }
    }

    /// V_0 = 1/Σ W over the perfect lattice, in m²: what Eq. (17) gives inside it.
    #[must_use]
    pub fn volume(&self, kernel: &WendlandC2) -> f64 {
        1.0 / self.neighbors(kernel.support()).map(|r| kernel.w(r.norm())).sum::<f64>()
    }

    /// The kernel with its gradient made consistent on this lattice, see [`WendlandC2::with_gradient_moment`].
    #[must_use]
    pub fn consistent(&self, kernel: WendlandC2) -> WendlandC2 {
        let sum: f64 = self.neighbors(kernel.support()).map(|r| r.dot(&kernel.grad_w(r))).sum();
        kernel.with_gradient_moment(-0.5 * self.volume(&kernel) * sum)
    }

    /// The lattice points around one of them, itself included.
    fn neighbors(&self, reach: f64) -> impl Iterator<Item = Vec2> {
        let step = self.step;
        let (nx, ny) = ((reach / step.x).ceil() as i64, (reach / step.y).ceil() as i64);
        (-ny..=ny).flat_map(move |j| (-nx..=nx).map(move |i| Vec2::new(i as f64 * step.x, j as f64 * step.y)))
    }

    /// The lattice points of the box, and of a margin of `margin` (m) beyond the sides for which `beyond` holds.
    fn points(&self, margin: f64, beyond: [bool; 4]) -> impl Iterator<Item = Vec2> + '_ {
        let extra = |i: usize, side: usize| if beyond[side] { (margin / self.step[i]).ceil() as i64 } else { 0 };
        let (left, right, bottom, top) = (extra(0, 0), extra(0, 1), extra(1, 2), extra(1, 3));
        let [nx, ny] = self.counts.map(|n| n as i64);
        (-bottom..ny + top).flat_map(move |j| {
            (-left..nx + right).map(move |i| {
                self.bounds.min + Vec2::new((i as f64 + 0.5) * self.step.x, (j as f64 + 0.5) * self.step.y)
            })
        })
    }
}

/// Fills the domain: fluid where the signed distance is above zero, wall particles down to a depth of the support.
///
/// `signed_distance` in m, `phase` names the fluid at a point, `walls` tells which sides (left, right, bottom, top)
/// are walls, so that wall particles stand beyond them. Returns the particles and the depth of each wall particle in m.
pub fn fill(
    lattice: &Lattice,
    support: f64,
    walls: [bool; 4],
    signed_distance: impl Fn(Vec2) -> f64,
    phase: impl Fn(Vec2) -> Phase,
) -> (Particles, Vec<f64>) {
    let mut particles = Particles::default();
    let mut solid = Vec::new();
    for x in lattice.points(support, walls) {
        let d = signed_distance(x);
        if d > 0.0 && lattice.bounds.contains(x) {
            particles.push(phase(x), x);
        } else if d <= 0.0 && d > -support {
            solid.push((x, -d));
        }
    }
    let depth = solid.iter().map(|s| s.1).collect();
    for (x, _) in solid {
        particles.push(Phase::Solid, x);
    }
    (particles, depth)
}

/// The domain must be this many supports long along a periodic direction, or a pair would be met twice.
pub const PERIODIC_SUPPORTS: f64 = 3.0;

/// Whether the periodic directions of `domain` are long enough for `support` (m).
#[must_use]
pub fn fits(domain: &Domain, support: f64) -> bool {
    domain.periods().iter().flatten().all(|period| *period >= PERIODIC_SUPPORTS * support)
}
