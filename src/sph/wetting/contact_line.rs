//! The contact line's force in volume form, one contact line at a time [Huber2013, Eqs. 11, 21-23].
//!
//! The particles of a line are found as connected components, so that each line's force sums to f_wns (Eq. 12).

use crate::math::Vec2;
use crate::sph::images::Images;
use crate::sph::kernel::WendlandC2;
use crate::sph::pairs::Pairs;
use crate::sph::wetting::{LineState, Wetting};

/// Where the unit normal has less than this share along the wall, the interface runs parallel to it: no line there.
const SMALLEST_TANGENT: f64 = 0.15;

/// A line whose N stays below this share of ∫W ds is not a line: else one trapped particle took a whole line's force.
const SMALLEST_LINE: f64 = 0.5;

/// What the line force needs of the particles; slices over fluid particles at least.
pub struct LineFields<'a> {
    /// n in 1/m [Huber2013, Eq. 18].
    pub normal: &'a [Vec2],
    /// n̂, zero where not valid.
    pub unit_normal: &'a [Vec2],
    /// Distance to the wall d_s in m, infinite far away.
    pub wall_distance: &'a [f64],
    /// Wall normal e_s into the fluid.
    pub wall_normal: &'a [Vec2],
    /// Volume in m².
    pub volume: &'a [f64],
    /// Weights w_a by which a line's force is shared out, as in the surface force.
    pub weight: &'a [f64],
}

/// A particle that a contact line acts on.
#[derive(Debug, Clone, Copy)]
struct LineParticle {
    a: usize,
    /// ν_ns: along the wall, towards the non-wetting phase.
    tangent: Vec2,
    cos_alpha: f64,
    /// |n| W(d_s, h): δ_wns before its normalization [Huber2013, Eq. 21].
    delta: f64,
}

/// F_a = f_wns δ_wns,a ν_ns in N/m³ [Huber2013, Eq. 23], δ_wns,a = |n_a| W(d_s, h)/N [Eqs. 21, 22].
///
/// Returns the number of contact lines found. `tension` is σ_wn in N/m.
pub fn line_force(
    pairs: &Pairs,
    images: &Images,
    fields: &LineFields,
    kernel: &WendlandC2,
    (wetting, tension): (&Wetting, f64),
    force: &mut [Vec2],
) -> usize {
    force.fill(Vec2::zeros());
    let particles = line_particles(fields, kernel, force.len());
    let line_of = components(&particles, pairs, images, force.len());
    let lines = line_of.iter().max().map_or(0, |last| last + 1);
    let (mut norm, mut share) = (vec![0.0; lines], vec![0.0; lines]);
    for (p, &line) in particles.iter().zip(&line_of) {
        let weight = fields.volume[p.a] * p.delta;
        norm[line] += weight;
        share[line] += weight * fields.weight[p.a];
    }
    let smallest = SMALLEST_LINE * kernel.line_integral();
    for (p, &line) in particles.iter().zip(&line_of) {
        let n = share[line] * (smallest / norm[line]).max(1.0);
        let f = wetting.driving_force(&LineState { cos_alpha: p.cos_alpha, tension });
        force[p.a] = f * p.delta * fields.weight[p.a] / n * p.tangent;
    }
    norm.iter().filter(|&&n| n >= smallest).count()
}

fn line_particles(fields: &LineFields, kernel: &WendlandC2, fluids: usize) -> Vec<LineParticle> {
    let candidate = |a: usize| {
        let (n_hat, e_s) = (fields.unit_normal[a], fields.wall_normal[a]);
        if n_hat == Vec2::zeros() || fields.wall_distance[a] >= kernel.support() {
            return None;
        }
        let along = n_hat - n_hat.dot(&e_s) * e_s;
        let length = along.norm();
        (length > SMALLEST_TANGENT).then(|| LineParticle {
            a,
            tangent: -along / length,
            cos_alpha: -n_hat.dot(&e_s),
            delta: fields.normal[a].norm() * kernel.w(fields.wall_distance[a].max(0.0)),
        })
    };
    (0..fluids).filter_map(candidate).collect()
}

/// The number of the contact line of each particle: neighbors whose ν_ns point the same way share a line.
fn components(particles: &[LineParticle], pairs: &Pairs, images: &Images, fluids: usize) -> Vec<usize> {
    const NONE: usize = usize::MAX;
    let mut place = vec![NONE; fluids];
    for (i, p) in particles.iter().enumerate() {
        place[p.a] = i;
    }
    let mut line_of = vec![NONE; particles.len()];
    let mut lines = 0;
    for first in 0..particles.len() {
        if line_of[first] != NONE {
            continue;
        }
        line_of[first] = lines;
        let mut open = vec![first];
        while let Some(i) = open.pop() {
            for ab in pairs.of(particles[i].a) {
                let b = images.source(ab.b);
                let j = if b < fluids { place[b] } else { NONE };
                if j != NONE && line_of[j] == NONE && particles[i].tangent.dot(&particles[j].tangent) > 0.0 {
                    line_of[j] = lines;
                    open.push(j);
                }
            }
        }
        lines += 1;
    }
    line_of
}
