//! Fills the pore and a layer of its walls with particles: on a lattice, and along walls that no lattice fits.

use crate::geometry::shells::FreeWalls;
use crate::math::{Bounds, Vec2};
use crate::sph::cells::Cells;
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

    /// V_0 = dx² in m²: the cell of a particle.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.step.x * self.step.y
    }

    /// The kernel made consistent on this lattice, see [`WendlandC2::divided_by`].
    #[must_use]
    pub fn consistent(&self, kernel: WendlandC2) -> WendlandC2 {
        let (unity, twice) = self.neighbors(kernel.support()).fold((0.0, 0.0), |(unity, twice), r| {
            let (w, grad_w) = kernel.w_and_grad(r);
            (unity + w, twice - r.dot(&grad_w))
        });
        kernel.divided_by(self.volume() * unity, 0.5 * self.volume() * twice)
    }

    /// The lattice points around one of them, itself included.
    fn neighbors(&self, reach: f64) -> impl Iterator<Item = Vec2> {
        let step = self.step;
        let (nx, ny) = ((reach / step.x).ceil() as i64, (reach / step.y).ceil() as i64);
        (-ny..=ny).flat_map(move |j| (-nx..=nx).map(move |i| Vec2::new(i as f64 * step.x, j as f64 * step.y)))
    }

    /// Whether the straight line from `a` to `b` (m) lies along an axis on a border between cells of the lattice.
    #[must_use]
    pub fn fits(&self, a: Vec2, b: Vec2) -> bool {
        const ROUNDING: f64 = 1e-6;
        (0..2).any(|i| {
            let rows = (a[i] - self.bounds.min[i]) / self.step[i];
            (a[i] - b[i]).abs() < ROUNDING * self.step[i] && (rows - rows.round()).abs() < ROUNDING
        })
    }

    /// The box that [`Lattice::points`] fills.
    fn extent(&self, margin: f64, beyond: [bool; 4]) -> Bounds {
        let by =
            |side: usize| if beyond[side] { (margin / self.step[side / 2]).ceil() * self.step[side / 2] } else { 0.0 };
        Bounds { min: self.bounds.min - Vec2::new(by(0), by(2)), max: self.bounds.max + Vec2::new(by(1), by(3)) }
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

/// Where particles stand.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Places {
    /// Fluid particles in m.
    pub fluid: Vec<Vec2>,
    /// Wall particles in m.
    pub walls: Vec<Vec2>,
    /// Depth of each wall particle in m.
    pub depth: Vec<f64>,
}

impl Places {
    fn push_wall(&mut self, x: Vec2, depth: f64) {
        self.walls.push(x);
        self.depth.push(depth);
    }

    /// The particles at these places; `phase` names the fluid at a point.
    #[must_use]
    pub fn particles(&self, phase: impl Fn(Vec2) -> Phase) -> Particles {
        let mut particles = Particles::default();
        self.fluid.iter().for_each(|&x| particles.push(phase(x), x));
        self.walls.iter().for_each(|&x| particles.push(Phase::Solid, x));
        particles
    }
}

/// Fills the domain on the lattice: fluid where the signed distance is above zero, wall particles down to a depth of the
/// support.
///
/// `signed_distance` in m; `walls` tells which sides (left, right, bottom, top) are walls, so that wall particles stand beyond them.
pub fn on_lattice(lattice: &Lattice, support: f64, walls: [bool; 4], signed_distance: impl Fn(Vec2) -> f64) -> Places {
    let mut places = Places::default();
    for x in lattice.points(support, walls) {
        let d = signed_distance(x);
        if d > 0.0 && lattice.bounds.contains(x) {
            places.fluid.push(x);
        } else if d <= 0.0 && d > -support {
            places.push_wall(x, -d);
        }
    }
    places
}

/// Distance between samples of a shell over the distance of particles.
const SAMPLING: f64 = 1.0 / 16.0;

/// Wall particles nearer to one before them than this, in spacings, are left out: where layers of different walls meet.
const CLOSEST_WALLS: f64 = 0.5;

/// Lattice points farther than this from a wall, in spacings, are surely fluid or surely not.
const DOUBTFUL: f64 = 0.5;

/// Distances that differ by less than this share of the spacing are equal, as those of points in mirrored places.
const EQUAL: f64 = 1e-6;

/// Fills the domain with wall particles in layers at half a spacing, one and a half, .. below the walls that no lattice fits, evenly
/// along each layer, so that each has the volume of the lattice; all else as [`on_lattice`] does.
///
/// As many fluid particles as the pore has room for: `pore_area` in m². They stand on the lattice still, to be packed next.
pub fn along_walls(
    (lattice, domain): (&Lattice, &Domain),
    (support, walls): (f64, [bool; 4]),
    free: &FreeWalls,
    signed_distance: impl Fn(Vec2) -> f64,
    pore_area: f64,
) -> Places {
    let spacing = lattice.step.product().sqrt();
    let mut places = Places::default();
    let mut doubtful: Vec<(f64, Vec2)> = Vec::new();
    for x in lattice.points(support, walls) {
        let (d, own) = (signed_distance(x), free.own(x));
        if own && d.abs() < DOUBTFUL * spacing && lattice.bounds.contains(x) {
            doubtful.push((d, x));
        } else if d > 0.0 && lattice.bounds.contains(x) {
            places.fluid.push(x);
        } else if d <= 0.0 && d > -support && !own {
            places.push_wall(x, -d);
        }
    }
    let wanted = (pore_area / (spacing * spacing)).round() as usize;
    places.fluid.extend(deepest(doubtful, wanted.saturating_sub(places.fluid.len()), EQUAL * spacing));
    let mut depth = 0.5 * spacing;
    while depth < support {
        for shell in free.shells(depth, SAMPLING * spacing, lattice.extent(support, walls)) {
            let share = shell.length() / spacing;
            // An even number around a closed line keeps the symmetry of a disc.
            let count = if shell.closed { 2.0 * (0.5 * share).round() } else { share.round() };
            shell.divided(count as usize).into_iter().for_each(|x| places.push_wall(x, depth));
        }
        depth += spacing;
    }
    keep_apart(&mut places, domain, CLOSEST_WALLS * spacing);
    places
}

/// The `count` points with the largest distances. Of those whose distances differ by less than `equal` some can be left out, as in a
/// symmetric pore: then points from all around, so that no side is preferred.
fn deepest(mut points: Vec<(f64, Vec2)>, count: usize, equal: f64) -> Vec<Vec2> {
    points.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut taken = Vec::new();
    for group in points.chunk_by(|a, b| a.0 - b.0 < equal) {
        let room = (count - taken.len()).min(group.len());
        // Steps of the golden section visit all of a list, the next one always far from those before.
        let mut order: Vec<usize> = (0..group.len()).collect();
        order.sort_by(|a, b| golden(*a).total_cmp(&golden(*b)));
        taken.extend(order.into_iter().take(room).map(|i| group[i].1));
    }
    taken
}

/// The fractional part of `index` golden sections.
fn golden(index: usize) -> f64 {
    const SECTION: f64 = 0.618_033_988_749_894_9;
    (SECTION * (index as f64 + 0.5)).fract()
}

/// Leaves out each wall particle that is nearer than `closest` (m) to one before it.
fn keep_apart(places: &mut Places, domain: &Domain, closest: f64) {
    let cells = Cells::build(&places.walls, domain, closest);
    let mut kept = vec![true; places.walls.len()];
    for a in 0..kept.len() {
        let mut is_free = true;
        cells
            .visit_near(places.walls[a], |b, r| is_free &= b as usize >= a || !kept[b as usize] || r.norm() >= closest);
        kept[a] = is_free;
    }
    let mut flags = kept.iter();
    places.walls.retain(|_| *flags.next().unwrap_or(&true));
    let mut flags = kept.iter();
    places.depth.retain(|_| *flags.next().unwrap_or(&true));
}

/// The domain must be this many supports long along a periodic direction, or a pair would be met twice.
pub const PERIODIC_SUPPORTS: f64 = 3.0;

/// Whether the periodic directions of `domain` are long enough for `support` (m).
#[must_use]
pub fn fits(domain: &Domain, support: f64) -> bool {
    domain.periods().iter().flatten().all(|period| *period >= PERIODIC_SUPPORTS * support)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sums_of_the_kernel_over_its_lattice_are_their_integrals() {
        // Cells of 1 by 1.05: a lattice that fits its box.
        let bounds = Bounds { min: Vec2::zeros(), max: Vec2::new(20.0, 21.0) };
        let lattice = Lattice { bounds, counts: [20, 20], step: Vec2::new(1.0, 1.05) };
        let plain = WendlandC2::new(1.5);
        let kernel = lattice.consistent(plain);
        let sum = |kernel: &WendlandC2, of: &dyn Fn(Vec2, f64, Vec2) -> f64| {
            let terms = lattice.neighbors(kernel.support()).map(|r| {
                let (w, grad_w) = kernel.w_and_grad(r);
                lattice.volume() * of(r, w, grad_w)
            });
            terms.sum::<f64>()
        };
        let unity = |kernel: &WendlandC2| sum(kernel, &|_, w, _| w);
        let moment = |kernel: &WendlandC2| sum(kernel, &|r, _, grad_w| -0.5 * r.dot(&grad_w));
        assert!((unity(&plain) - 1.0).abs() > 1e-3 && (moment(&plain) - 1.0).abs() > 1e-3);
        assert!((unity(&kernel) - 1.0).abs() < 1e-14 && (moment(&kernel) - 1.0).abs() < 1e-14);
    }
}
