//! M y' = F(y): the places of particles with their recursive sums as algebraic unknowns.
//!
//! Five rows a particle, seven in partial wetting, where the overlap ⟨h, h̄⟩ is summed from the left and handed back from the right, so
//! that every row has a few entries.

use ::diffsol::FaerContext;

use meniscus_film::particles::ParticleMethod;

/// Indices of a particle's unknowns in its block.
const PLACE: usize = 0;
const LEFT: usize = 1;
const LEFT_WEIGHTED: usize = 2;
const RIGHT: usize = 3;
const RIGHT_WEIGHTED: usize = 4;
const OVERLAP: usize = 5;
const TOTAL: usize = 6;
/// The four sums that h̄ and its derivatives follow from.
const SUMS: [usize; 4] = [LEFT, LEFT_WEIGHTED, RIGHT, RIGHT_WEIGHTED];

/// M y' = F(y).
pub struct System {
    alpha: f64,
    weight: Vec<f64>,
    /// 2χA², above 0 in partial wetting.
    pull: f64,
    bond: f64,
    /// Rows of a particle.
    pub block: usize,
    /// y at the start of the step.
    pub start: Vec<f64>,
    /// The library's, for its matrices and vectors.
    pub context: FaerContext,
}

/// Numbers at a particle.
struct Local {
    height: f64,
    slope: f64,
    /// h̄ₓₓₓ + (ξ² − Bo) h̄ₓ.
    drive: f64,
    /// ξ² − Bo.
    pull: f64,
}

impl System {
    /// The system of particles at the places `x`.
    pub fn new(method: &ParticleMethod, x: &[f64]) -> Self {
        let pull = method.pull;
        let mut system = Self {
            alpha: method.kernel.alpha,
            weight: method.weight.clone(),
            pull: 2.0 * pull.wetting * method.area.powi(2),
            bond: pull.bond,
            block: if pull.wetting > 0.0 { TOTAL + 1 } else { RIGHT_WEIGHTED + 1 },
            start: Vec::new(),
            context: FaerContext::default(),
        };
        system.start = system.consistent(x);
        system
    }

    fn count(&self) -> usize {
        self.weight.len()
    }

    /// Factors of the four sums in h̄, h̄ₓ and h̄ₓₓₓ.
    fn factors(&self) -> [[f64; 4]; 3] {
        let a = self.alpha;
        let (height, slope, third) = (0.25 / a.powi(2), 0.25 / a.powi(3), 0.25 / a.powi(4));
        [
            [a * height, height, a * height, height],
            [0.0, -slope, 0.0, slope],
            [2.0 * third, -third / a, -2.0 * third, third / a],
        ]
    }

    fn local(&self, y: &[f64], i: usize) -> Local {
        let at = self.block * i;
        let sum =
            |factors: &[f64; 4]| SUMS.iter().zip(factors).map(|(&part, factor)| factor * y[at + part]).sum::<f64>();
        let [height, slope, third] = self.factors();
        let own = self.weight[i] * height[0];
        let (height, slope, third) = (sum(&height) + own, sum(&slope), sum(&third));
        let xi_squared = if self.pull > 0.0 { self.pull / y[at + TOTAL].powi(2) } else { 0.0 };
        let pull = xi_squared - self.bond;
        Local { height, slope, drive: third + pull * slope, pull }
    }

    /// Positions with the sums that belong to them.
    fn consistent(&self, x: &[f64]) -> Vec<f64> {
        let (n, block) = (self.count(), self.block);
        let mut y = vec![0.0; block * n];
        for (i, place) in x.iter().enumerate() {
            y[block * i + PLACE] = *place;
        }
        for i in 1..n {
            let (at, other) = (block * i, block * (i - 1));
            [y[at + LEFT], y[at + LEFT_WEIGHTED]] = self.handed_on(&y[other..], LEFT, i - 1, x[i] - x[i - 1]);
        }
        for i in (0..n.saturating_sub(1)).rev() {
            let (at, other) = (block * i, block * (i + 1));
            [y[at + RIGHT], y[at + RIGHT_WEIGHTED]] = self.handed_on(&y[other..], RIGHT, i + 1, x[i + 1] - x[i]);
        }
        if self.pull > 0.0 {
            let heights: Vec<f64> = (0..n).map(|i| self.local(&y, i).height).collect();
            let mut total = 0.0;
            for i in 0..n {
                total += self.weight[i] * heights[i];
                y[block * i + OVERLAP] = total;
            }
            (0..n).for_each(|i| y[block * i + TOTAL] = total);
        }
        y
    }

    /// The pair of sums that the neighbor whose block begins `other` hands on over a gap.
    fn handed_on(&self, other: &[f64], part: usize, neighbor: usize, gap: f64) -> [f64; 2] {
        let decay = (-gap / self.alpha).exp();
        let plain = other[part] + self.weight[neighbor];
        [decay * plain, decay * (other[part + 1] + gap * plain)]
    }

    /// F(y).
    pub fn right_side(&self, y: &[f64], out: &mut [f64]) {
        let (n, block) = (self.count(), self.block);
        for i in 0..n {
            let at = block * i;
            let local = self.local(y, i);
            out[at + PLACE] = local.height.powi(2) * local.drive;
            out[at + LEFT..=at + RIGHT_WEIGHTED].copy_from_slice(&y[at + LEFT..=at + RIGHT_WEIGHTED]);
            for (part, neighbor) in self.neighbors(i) {
                let other = block * neighbor;
                let gap = (y[at] - y[other]).abs();
                let [plain, weighted] = self.handed_on(&y[other..], part, neighbor, gap);
                out[at + part] -= plain;
                out[at + part + 1] -= weighted;
            }
            if self.pull > 0.0 {
                let before = if i > 0 { y[at - block + OVERLAP] } else { 0.0 };
                let after = if i + 1 < n { y[at + block + TOTAL] } else { y[at + OVERLAP] };
                out[at + OVERLAP] = y[at + OVERLAP] - before - self.weight[i] * local.height;
                out[at + TOTAL] = y[at + TOTAL] - after;
            }
        }
    }

    /// The sums of a particle that come from a neighbor: the first of the pair, and the neighbor.
    fn neighbors(&self, i: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let before = i.checked_sub(1).map(|j| (LEFT, j));
        let after = (i + 1 < self.count()).then_some((RIGHT, i + 1));
        before.into_iter().chain(after)
    }

    /// The entries of dF/dy, always in the same order and at the same places.
    pub fn jacobian(&self, y: &[f64], mut entry: impl FnMut(usize, usize, f64)) {
        let (n, block) = (self.count(), self.block);
        let [by_height, by_slope, by_third] = self.factors();
        for i in 0..n {
            let at = block * i;
            let Local { height, slope, drive, pull } = self.local(y, i);
            let square = height * height;
            for (k, part) in SUMS.into_iter().enumerate() {
                let change = 2.0 * height * drive * by_height[k] + square * (by_third[k] + pull * by_slope[k]);
                entry(at + PLACE, at + part, change);
                entry(at + part, at + part, 1.0);
            }
            for (part, neighbor) in self.neighbors(i) {
                let other = block * neighbor;
                let gap = (y[at] - y[other]).abs();
                let decay = (-gap / self.alpha).exp();
                let [plain, weighted] = self.handed_on(&y[other..], part, neighbor, gap);
                // How the sums fall as the gap grows; it grows with this place on the left sums, with the other on the right.
                let (fall, fall_weighted) = (plain / self.alpha, weighted / self.alpha - plain);
                let side = if part == LEFT { 1.0 } else { -1.0 };
                entry(at + part, at + PLACE, side * fall);
                entry(at + part, other + PLACE, -side * fall);
                entry(at + part, other + part, -decay);
                entry(at + part + 1, at + PLACE, side * fall_weighted);
                entry(at + part + 1, other + PLACE, -side * fall_weighted);
                entry(at + part + 1, other + part, -decay * gap);
                entry(at + part + 1, other + part + 1, -decay);
            }
            if self.pull > 0.0 {
                let xi_squared = pull + self.bond;
                entry(at + PLACE, at + TOTAL, -2.0 * square * slope * xi_squared / y[at + TOTAL]);
                entry(at + OVERLAP, at + OVERLAP, 1.0);
                for (k, part) in SUMS.into_iter().enumerate() {
                    entry(at + OVERLAP, at + part, -self.weight[i] * by_height[k]);
                }
                if i > 0 {
                    entry(at + OVERLAP, at - block + OVERLAP, -1.0);
                }
                entry(at + TOTAL, at + TOTAL, 1.0);
                entry(at + TOTAL, if i + 1 < n { at + block + TOTAL } else { at + OVERLAP }, -1.0);
            }
        }
    }
}
