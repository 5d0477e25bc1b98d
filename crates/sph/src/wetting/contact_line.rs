//! The contact line force as a volume force, one contact line at a time [Huber2013, Eqs. 11, 21-23].
//!
//! The particles of a line are connected components, so that the force of each line sums to f_wns (Eq. 12). [`LineDelta::Local`] needs no
//! sum over a line: it uses the integral of Eq. (22) over a straight interface, and is accurate as far as the interface is straight.

use crate::components::components;
use crate::domain::Domain;
use crate::kernel::WendlandC2;
use crate::neighborhood::Neighborhood;
use crate::wetting::lines::DetectedLine;
use meniscus_case::LineDelta;
use meniscus_core::math::Vec2;

/// Component of the unit normal along the wall below which the interface is parallel to it and has no contact line.
const SMALLEST_TANGENT: f64 = 0.15;

/// Lines whose N is below this fraction of ∫W ds have a reduced force: else a single trapped particle would take that of a whole line.
const SMALLEST_LINE: f64 = 0.5;

/// Particle fields of the line force; slices over at least the fluid particles.
pub struct LineFields<'a> {
    /// Position in m.
    pub position: &'a [Vec2],
    /// Velocity in m/s.
    pub velocity: &'a [Vec2],
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
    /// Weights w_a that distribute the force of a line, as in the surface force.
    pub weight: &'a [f64],
}

/// A particle on which a contact line acts.
#[derive(Debug, Clone, Copy)]
struct LineParticle {
    a: usize,
    /// ν_ns: tangential to the wall, towards the non-wetting phase.
    tangent: Vec2,
    cos_alpha: f64,
    /// |n̂ − (n̂·e_s) e_s| = sin α.
    sin_alpha: f64,
    /// |n| W(d_s, h): δ_wns before its normalization [Huber2013, Eq. 21].
    delta: f64,
}

/// The particles of all contact lines.
pub struct LineParticles {
    /// Line by line.
    lines: Vec<Vec<LineParticle>>,
    /// N of each line [Huber2013, Eq. 22].
    norm: Vec<f64>,
    /// ∫W ds in 1/m.
    integral: f64,
}

/// A contact line by the means over its particles with the weights V δ.
#[derive(Debug, Clone, Copy)]
pub struct MeanLine {
    position: Vec2,
    outward: Vec2,
    speed: f64,
    present: f64,
}

impl DetectedLine for MeanLine {
    fn position(&self) -> Vec2 {
        self.position
    }
    fn outward(&self) -> Vec2 {
        self.outward
    }
    fn speed(&self) -> f64 {
        self.speed
    }
    /// The mean angle, also for a pinned line: the band of the continuum force is too wide to pass through a point.
    fn present(&self, _: Option<Vec2>) -> f64 {
        self.present
    }
    fn intersection(&self, _: f64) -> Vec2 {
        self.position
    }
}

impl LineParticles {
    /// The particles near walls where the interface meets them, sorted into lines.
    pub fn find(neighborhood: &Neighborhood, fields: &LineFields, kernel: &WendlandC2, fluids: usize) -> Self {
        let particles = line_particles(fields, kernel, fluids);
        let line_of = line_of(&particles, neighborhood, fluids);
        let mut lines = vec![Vec::new(); line_of.iter().max().map_or(0, |last| *last as usize + 1)];
        for (p, &line) in particles.iter().zip(&line_of) {
            lines[line as usize].push(*p);
        }
        let weights = |line: &Vec<LineParticle>| line.iter().map(|p| fields.volume[p.a] * p.delta).sum();
        let norm = lines.iter().map(weights).collect();
        Self { lines, norm, integral: kernel.line_integral() }
    }

    /// The detected lines, including small ones, in their order.
    pub fn detected_lines(&self, fields: &LineFields, domain: &Domain) -> Vec<MeanLine> {
        self.lines.iter().zip(&self.norm).map(|(line, norm)| mean(line, *norm, fields, domain)).collect()
    }

    /// F_a = f_wns δ_wns,a ν_ns in N/m³, f_wns = σ (cos θ − cos α) from the wetting to the other phase [Huber2013, Eqs. 7, 21-23]. `angles` in rad are those of the wetting law at each line, in the order of detection;
    /// `tension` is σ_wn in N/m.
    pub fn line_force(&self, fields: &LineFields, delta: LineDelta, angles: &[f64], tension: f64) -> Vec<Vec2> {
        let mut force = vec![Vec2::zeros(); fields.weight.len()];
        for ((particles, norm), angle) in self.lines.iter().zip(&self.norm).zip(angles) {
            let sum: f64 = particles.iter().map(|p| fields.volume[p.a] * p.delta * fields.weight[p.a]).sum();
            let n = sum * (SMALLEST_LINE * self.integral / norm).max(1.0);
            for p in particles {
                let f = tension * (angle.cos() - p.cos_alpha);
                let norm = match delta {
                    // δ_wns,a = |n_a| W(d_s, h)/N, N the sum of V |n| W over the particles of the line [Huber2013, Eqs. 21, 22].
                    LineDelta::Normalized => n,
                    // δ_wns,a = |n_a| |n̂_a − (n̂_a·e_s) e_s| W(d_s, h)/∫W ds, of the particle alone: along a straight interface that meets the wall at
                    // the angle α, the element of length is ds/sin α, so that this sums to 1 at any α.
                    LineDelta::Local => self.integral / p.sin_alpha,
                };
                force[p.a] = f * p.delta * fields.weight[p.a] / norm * p.tangent;
            }
        }
        force
    }
}

/// The means over the particles of a line, at least one; `norm` is the sum of the weights.
fn mean(line: &[LineParticle], norm: f64, fields: &LineFields, domain: &Domain) -> MeanLine {
    let from = fields.position[line[0].a];
    let (mut position, mut outward, mut cosine) = (Vec2::zeros(), Vec2::zeros(), 0.0);
    let (mut moved, mut along) = (0.0, 0.0);
    for p in line {
        let weight = fields.volume[p.a] * p.delta / norm;
        let closest = fields.position[p.a] - fields.wall_distance[p.a] * fields.wall_normal[p.a];
        position += weight * domain.separation(closest, from);
        outward += weight * p.tangent;
        cosine += weight * p.cos_alpha;
        moved += weight * fields.velocity[p.a].dot(&fields.unit_normal[p.a]);
        along += weight * p.tangent.dot(&fields.unit_normal[p.a]);
    }
    MeanLine {
        position: domain.wrapped(from + position),
        outward: outward.try_normalize(f64::EPSILON).unwrap_or(line[0].tangent),
        // An interface that moves along the wall with the speed U has v·n = U ν·n; ν·n is −sin of the angle.
        speed: if along < 0.0 { moved / along } else { 0.0 },
        present: cosine.clamp(-1.0, 1.0).acos(),
    }
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
            sin_alpha: length,
            delta: fields.normal[a].norm() * kernel.w(fields.wall_distance[a].max(0.0)),
        })
    };
    (0..fluids).filter_map(candidate).collect()
}

/// The number of the contact line of each particle: neighbors whose ν_ns have the same direction belong to one line.
fn line_of(particles: &[LineParticle], neighborhood: &Neighborhood, fluids: usize) -> Vec<u32> {
    let Neighborhood { pairs, images } = neighborhood;
    let mut index = vec![None; fluids];
    for (i, p) in particles.iter().enumerate() {
        index[p.a] = Some(i);
    }
    components(particles.len(), |i| {
        let near = pairs.of(particles[i].a).filter_map(|ab| index.get(images.source(ab.b)).copied().flatten());
        near.filter(move |&j| particles[i].tangent.dot(&particles[j].tangent) > 0.0)
    })
}
