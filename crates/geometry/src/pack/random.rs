//! Random packs of discs with given porosity, sizes and smallest gap.
//!
//! Radii are drawn from a normal distribution (the sum of twelve uniform numbers, truncated at 2.5 deviations) and scaled together to the porosity. Each disc
//! is then enlarged by half the gap. Up to a solid fraction of 0.45 of the enlarged discs, they are placed one by one, the largest first, at free positions
//! (random sequential addition, which jams at 0.547 for equal discs). Denser packs start with smaller discs, which grow while overlaps are pushed apart
//! (after Jodrey, Tory 1985).

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::cells::Cells;
use super::error::{MOST_DISCS, PackError, size_of};
use crate::spec::{Disc, RandomPack};

/// Radii lie within this many standard deviations of their mean.
const CUT: f64 = 2.5;
/// Largest standard deviation over the mean: the smallest disc has an eighth of the mean radius.
const WIDEST: f64 = 0.35;
/// Solid fraction including gaps up to which discs are placed one by one.
const SEQUENTIAL: f64 = 0.45;
/// Solid fraction of the initial pack from which discs grow.
const LOOSE: f64 = 0.40;
/// Equal discs cannot be denser (hexagonal packing); random ones jam at about 0.84.
const DENSEST: f64 = 0.88;
/// Maximum number of trial positions for one disc.
const TRIES: usize = 20_000;

/// Uniform numbers from a seed.
struct Uniform(ChaCha8Rng);

impl Uniform {
    fn new(seed: u64) -> Self {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        Self(ChaCha8Rng::from_seed(bytes))
    }

    /// In [0, 1) with 53 bits.
    fn next(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Normally distributed with mean 0 and standard deviation 1, truncated.
    fn normal(&mut self) -> f64 {
        loop {
            let sum = (0..12).map(|_| self.next()).sum::<f64>() - 6.0;
            if sum.abs() <= CUT {
                return sum;
            }
        }
    }
}

/// The discs of a random pack. Along periodic axes a disc may cross the region's sides, written once; else it keeps the gap from them.
///
/// # Errors
/// Invalid sizes, and packs that are too dense: with the porosity that was reached.
pub fn random_pack(spec: &RandomPack) -> Result<Vec<Disc>, PackError> {
    let size = size_of(spec.region)?;
    check(spec, size)?;
    let periodic = spec.periodic.axes();
    let mut uniform = Uniform::new(spec.seed);
    let radii = radii(spec, size, &mut uniform)?;
    let largest = radii[0];
    for k in 0..2 {
        let least = if periodic[k] { 4.0 * largest + 2.0 * spec.gap } else { 2.0 * largest + 2.0 * spec.gap };
        PackError::require(
            size[k] >= least,
            "region",
            format!("{:e} m of the region hold no disc of radius {largest:e} m with its gaps", size[k]),
            "enlarge the region or make the discs smaller",
        )?;
    }
    let pack = Placing { spec, periodic, size };
    let counted = pack.counted(&radii);
    if counted > DENSEST {
        return Err(pack.refusal(counted, 0.84_f64.min(counted)));
    }
    let placed = if counted <= SEQUENTIAL { pack.one_by_one(&radii, 1.0, &mut uniform) } else { None };
    let centers = match placed {
        Some(centers) => centers,
        None => {
            let scale = (LOOSE / counted).sqrt().min(1.0);
            let Some(loose) = pack.one_by_one(&radii, scale, &mut uniform) else {
                return Err(pack.refusal(counted, LOOSE * scale));
            };
            pack.grown(&radii, loose).map_err(|reached| pack.refusal(counted, counted * reached * reached))?
        }
    };
    Ok(centers.into_iter().zip(radii).map(|(center, radius)| Disc { center, radius }).collect())
}

fn check(spec: &RandomPack, size: [f64; 2]) -> Result<(), PackError> {
    let RandomPack { porosity, radius, radius_deviation, gap, .. } = *spec;
    PackError::require(
        porosity > 0.0 && porosity < 1.0,
        "porosity",
        format!("{porosity} is not a porosity"),
        "a number above 0 and below 1",
    )?;
    PackError::require_size("radius", radius)?;
    PackError::require(
        (0.0..=WIDEST).contains(&radius_deviation),
        "radius-deviation",
        format!("{radius_deviation} is out of range"),
        "standard deviation over mean, 0 to 0.35",
    )?;
    PackError::require_size("gap", gap)?;
    let count = (1.0 - porosity) * size[0] * size[1] / (std::f64::consts::PI * radius * radius);
    PackError::require(
        count <= MOST_DISCS,
        "radius",
        format!("{count:.1e} discs would be needed, expected at most {MOST_DISCS:e}"),
        "are all lengths in m?",
    )?;
    PackError::require(
        count >= 0.5,
        "porosity",
        format!("the solid is {count:.2} of one disc"),
        "enlarge the region, make the discs smaller, or lower the porosity",
    )
}

/// The radii in descending order, with the total area of the solid.
fn radii(spec: &RandomPack, size: [f64; 2], uniform: &mut Uniform) -> Result<Vec<f64>, PackError> {
    let solid = (1.0 - spec.porosity) * size[0] * size[1] / std::f64::consts::PI;
    let (mut radii, mut sum) = (Vec::new(), 0.0);
    loop {
        let radius = spec.radius * (1.0 + spec.radius_deviation * uniform.normal());
        let square = radius * radius;
        // The last disc is included if the sum is closer with it.
        if !radii.is_empty() && sum + 0.5 * square > solid {
            break;
        }
        radii.push(radius);
        sum += square;
    }
    let scale = (solid / sum).sqrt();
    radii.iter_mut().for_each(|radius| *radius *= scale);
    radii.sort_by(|a, b| b.total_cmp(a));
    // With few discs the common scale factor may be far from one.
    const SAME: f64 = 0.1;
    PackError::require(
        (scale - 1.0).abs() <= SAME,
        "porosity",
        format!("{} discs meet it only with radii {:.0} % of those requested", radii.len(), 100.0 * scale),
        "enlarge the region or make the discs smaller, so that there are more of them",
    )?;
    Ok(radii)
}

struct Placing<'a> {
    spec: &'a RandomPack,
    periodic: [bool; 2],
    size: [f64; 2],
}

impl Placing<'_> {
    /// The range of an axis in which the center of a disc may lie.
    fn range(&self, axis: usize, radius: f64) -> [f64; 2] {
        let margin = if self.periodic[axis] { 0.0 } else { radius + self.spec.gap };
        [self.spec.region[0][axis] + margin, self.spec.region[1][axis] - margin]
    }

    /// The solid fraction including half of the gap around each disc, in the available region.
    fn counted(&self, radii: &[f64]) -> f64 {
        let half = 0.5 * self.spec.gap;
        let sum: f64 = radii.iter().map(|r| (r + half) * (r + half)).sum();
        let room = |k: usize| if self.periodic[k] { self.size[k] } else { self.size[k] - self.spec.gap };
        std::f64::consts::PI * sum / (room(0) * room(1))
    }

    /// The error for a pack of the solid fraction `counted` including gaps, where `reached` is possible.
    fn refusal(&self, counted: f64, reached: f64) -> PackError {
        let solid = (1.0 - self.spec.porosity) * reached / counted;
        PackError::new(
            "porosity",
            format!(
                "{} cannot be reached with a gap of {:e} m: about {:.3} can",
                self.spec.porosity,
                self.spec.gap,
                1.0 - solid
            ),
            "raise the porosity, lower the gap, or make the discs larger",
        )
    }

    /// Centers by sequential addition for discs of `scale` times their size with gaps; `None` if there is no free position.
    fn one_by_one(&self, radii: &[f64], scale: f64, uniform: &mut Uniform) -> Option<Vec<[f64; 2]>> {
        let gap = self.spec.gap;
        let mut cells = Cells::new(self.spec.region, self.periodic, (2.0 * radii[0] + gap) * scale);
        let mut centers: Vec<[f64; 2]> = Vec::with_capacity(radii.len());
        for (i, &radius) in radii.iter().enumerate() {
            let ranges = [0, 1].map(|axis| self.range(axis, radius));
            let mut draw = || ranges.map(|[from, to]| from + (to - from) * uniform.next());
            let is_free = |x: [f64; 2]| {
                let mut free = true;
                cells.near(x, |j| {
                    let [dx, dy] = cells.between(x, centers[j]);
                    let least = (radius + radii[j] + gap) * scale;
                    free &= dx * dx + dy * dy >= least * least;
                });
                free
            };
            let x = (0..TRIES).map(|_| draw()).find(|&x| is_free(x))?;
            cells.add(i, x);
            centers.push(x);
        }
        Some(centers)
    }

    /// Centers without overlaps, from those of smaller discs; on failure the fraction of the size that was reached.
    fn grown(&self, radii: &[f64], mut centers: Vec<[f64; 2]>) -> Result<Vec<[f64; 2]>, f64> {
        // Slightly larger than required, so that the last overlaps vanish in finite time.
        const MORE: f64 = 1.0 + 2e-3;
        // Number of pair evaluations: 1e5 discs then take some ten seconds at most.
        const WORK: usize = 400_000_000;
        const LEAST_ROUNDS: usize = 400;
        const MOST_ROUNDS: usize = 20_000;
        // Momentum of the motion: an average over 1 / (1 - this) iterations.
        const MOMENTUM: f64 = 0.8;
        // Fraction of the overlap by which a disc moves; below one half, as both move.
        const STEP: f64 = 0.25;
        // Cells are a little wider than necessary, so that they remain valid for several iterations.
        const SKIN: f64 = 0.3;
        let gap = self.spec.gap;
        let reach = 2.0 * radii[0] + gap;
        let skin = SKIN * (radii[radii.len() - 1] + 0.5 * gap);
        let rounds = (WORK / (radii.len() * 10)).clamp(LEAST_ROUNDS, MOST_ROUNDS);
        let mut cells = Cells::new(self.spec.region, self.periodic, MORE * reach + skin);
        let mut speed = vec![[0.0; 2]; centers.len()];
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        let (mut moved, mut best) = (f64::INFINITY, 0.0_f64);
        for _ in 0..rounds {
            if 2.0 * moved > skin {
                cells.fill(centers.iter().copied());
                pairs.clear();
                for (i, &x) in centers.iter().enumerate() {
                    cells.near(x, |j| {
                        if j > i && cells.distance(x, centers[j]) < MORE * (radii[i] + radii[j] + gap) + skin {
                            pairs.push((i as u32, j as u32));
                        }
                    });
                }
                moved = 0.0;
            }
            let mut force = vec![[0.0; 2]; centers.len()];
            let mut share = f64::INFINITY;
            for &(i, j) in &pairs {
                let (i, j) = (i as usize, j as usize);
                let [dx, dy] = cells.between(centers[i], centers[j]);
                let (distance, wanted) = ((dx * dx + dy * dy).sqrt(), radii[i] + radii[j] + gap);
                share = share.min(distance / wanted);
                let overlap = MORE * wanted - distance;
                if overlap > 0.0 {
                    let push = STEP * overlap / distance.max(1e-12 * wanted);
                    force[i] = [force[i][0] - push * dx, force[i][1] - push * dy];
                    force[j] = [force[j][0] + push * dx, force[j][1] + push * dy];
                }
            }
            best = best.max(share);
            if share >= 1.0 {
                return Ok(centers);
            }
            let mut farthest = 0.0_f64;
            for (i, x) in centers.iter_mut().enumerate() {
                let before = *x;
                for axis in 0..2 {
                    speed[i][axis] = MOMENTUM * speed[i][axis] + force[i][axis];
                    x[axis] += speed[i][axis];
                    let [from, to] = self.range(axis, radii[i]);
                    if self.periodic[axis] {
                        if x[axis] < from {
                            x[axis] += self.size[axis];
                        } else if x[axis] >= to {
                            x[axis] -= self.size[axis];
                        }
                    }
                    x[axis] = x[axis].clamp(from, to);
                }
                farthest = farthest.max(cells.distance(before, *x));
            }
            moved += farthest;
        }
        Err(best)
    }
}
