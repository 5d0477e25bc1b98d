//! Packs the fluid of a pore before time zero: particles move from crowded to empty places until all have the same room.
//!
//! Beside walls that no lattice fits, a lattice has gaps and crowds. The particles are shifted down the gradient of their
//! concentration (Lind et al. 2012), the walls hold still; straight walls on the lattice have no gradient and leave it as it is.

use crate::math::Vec2;
use crate::sph::domain::Domain;
use crate::sph::images::Images;
use crate::sph::kernel::WendlandC2;
use crate::sph::pairs::{Pairs, each};

/// Coefficient of the shift in units of h²; the explicit diffusion of the concentration is stable up to about a half.
const DIFFUSION: f64 = 0.2;

/// A particle moves by at most this share of the spacing at a time.
const LARGEST_MOVE: f64 = 0.1;

/// The packing is done when no particle moves by more than this share of the spacing at a time.
const AT_REST: f64 = 1e-4;

/// Most rounds of shifting.
const ROUNDS: usize = 400;

/// No particle comes nearer to a wall than this share of the spacing.
const CLOSEST_TO_WALL: f64 = 0.25;

/// Shifts the particles `fluid` among the fixed `walls` (m); `volume` (m²) is that of a particle at rest, `spacing` in m, `wall` gives signed
/// distance in m and normal.
pub fn pack(
    (fluid, walls): (&mut [Vec2], &[Vec2]),
    domain: &Domain,
    kernel: &WendlandC2,
    (spacing, volume): (f64, f64),
    wall: impl Fn(Vec2) -> (f64, Vec2) + Sync,
) {
    let fluids = fluid.len();
    let largest = LARGEST_MOVE * spacing;
    let closest = CLOSEST_TO_WALL * spacing;
    for _ in 0..ROUNDS {
        let mut points: Vec<Vec2> = fluid.iter().chain(walls).copied().collect();
        let images = Images::append(&mut points, domain, kernel.support());
        let pairs = Pairs::find(&points, fluids, domain, kernel);
        let mut moved = vec![Vec2::zeros(); fluids];
        each(&mut moved, |a| {
            let gradient: Vec2 = pairs.of(a).map(|ab| ab.grad_w).sum();
            let by = -DIFFUSION * kernel.h * kernel.h * volume * gradient;
            let mut x = fluid[a] + by * (largest / by.norm()).min(1.0);
            if pairs.of(a).any(|ab| images.source(ab.b) >= fluids) {
                let (distance, normal) = wall(x);
                x += (closest - distance).max(0.0) * normal;
            }
            for mirror in &domain.mirrors {
                let inwards = (domain.bounds.center()[mirror.axis] - mirror.at).signum();
                x[mirror.axis] += inwards * (closest - inwards * (x[mirror.axis] - mirror.at)).max(0.0);
            }
            x
        });
        let farthest = fluid.iter().zip(&moved).map(|(old, new)| (new - old).norm()).fold(0.0, f64::max);
        fluid.iter_mut().zip(&moved).for_each(|(x, moved)| *x = domain.wrapped(*moved));
        if std::env::var("PACK_DEBUG").is_ok() {
            let sums: Vec<f64> = (0..fluids).map(|a| volume * (pairs.w_self + pairs.of(a).map(|ab| ab.w).sum::<f64>()) - 1.0).collect();
            let rms = (sums.iter().map(|s| s * s).sum::<f64>() / fluids as f64).sqrt();
            let mean = sums.iter().sum::<f64>() / fluids as f64;
            let worst = sums.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
            eprintln!("rms {rms:.2e} mean {mean:.2e} worst {worst:.2e} move {:.2e}", farthest / spacing);
        }
        if farthest < AT_REST * spacing {
            break;
        }
    }
}
