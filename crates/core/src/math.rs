//! Mathematics of the plane: vectors and matrices of nalgebra, boxes, the shape of the kernel.

/// Offset basis of the 64-bit FNV-1a hash.
pub const FNV1A_BASIS: u64 = 0xcbf2_9ce4_8422_2325;

/// The 64-bit FNV-1a hash (Fowler, Noll, Vo), continued from `hash`: the same on every machine and version.
pub fn fnv1a(hash: u64, bytes: impl IntoIterator<Item = u8>) -> u64 {
    const PRIME: u64 = 0x0100_0000_01b3;
    bytes.into_iter().fold(hash, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
}

/// A point or a vector of the plane.
pub type Vec2 = nalgebra::Vector2<f64>;

/// A linear map of the plane.
pub type Mat2 = nalgebra::Matrix2<f64>;

/// The vector `v` rotated by +90 degrees.
#[inline]
pub fn perpendicular(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

/// The distance of a point from a segment in m; from its ends, if these are one point.
pub fn distance_to_segment(x: Vec2, [a, b]: [Vec2; 2]) -> f64 {
    let along = b - a;
    let squared = along.norm_squared();
    let fraction = if squared > 0.0 { ((x - a).dot(&along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    (x - a - along * fraction).norm()
}

/// The shortest periodic image of `difference` (m).
#[inline]
pub fn nearest_image(difference: Vec2, period: [Option<f64>; 2]) -> Vec2 {
    let wrap = |d: f64, period: Option<f64>| period.map_or(d, |l| d - l * (d / l).round());
    Vec2::new(wrap(difference.x, period[0]), wrap(difference.y, period[1]))
}

/// Half the second moment of [`wendland_c2`] along a line through its center, over its zeroth moment, in h². Smoothing reduces the amplitude of an interface
/// wave by k²h² times this; it displaces the level 1/2 of a disc of curvature κ towards the center by h²κ times this.
pub const LINE_MOMENT: f64 = 1.0 / 7.0;

/// (1 − q/2)⁴ (1 + 2q) for q < 2, else 0: the shape of the quintic C2 kernel of Wendland 1995; its integral over the plane is 4π/7.
#[inline]
pub fn wendland_c2(q: f64) -> f64 {
    let t = (1.0 - 0.5 * q).max(0.0);
    let t2 = t * t;
    t2 * t2 * (1.0 + 2.0 * q)
}

/// An axis-aligned box, in m.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Bounds {
    /// Lower left corner in m.
    pub min: Vec2,
    /// Upper right corner in m.
    pub max: Vec2,
}

impl Bounds {
    /// A box without points: united with another one it is that one.
    pub const EMPTY: Self =
        Self { min: Vec2::new(f64::INFINITY, f64::INFINITY), max: Vec2::new(f64::NEG_INFINITY, f64::NEG_INFINITY) };

    /// Width and height in m.
    #[inline]
    pub fn size(&self) -> Vec2 {
        self.max - self.min
    }

    /// Area in m².
    pub fn area(&self) -> f64 {
        self.size().product()
    }

    /// The center of the box.
    #[inline]
    pub fn center(&self) -> Vec2 {
        0.5 * (self.min + self.max)
    }

    /// The smallest box around the points; `None` without points.
    pub fn around(mut points: impl Iterator<Item = Vec2>) -> Option<Self> {
        let first = points.next()?;
        Some(points.fold(Self { min: first, max: first }, |b, x| Self { min: b.min.inf(&x), max: b.max.sup(&x) }))
    }

    /// Whether `x` lies in the box, including its sides.
    #[inline]
    pub fn contains(&self, x: Vec2) -> bool {
        (0..2).all(|i| self.min[i] <= x[i] && x[i] <= self.max[i])
    }

    /// Whether two boxes have a common point, including their sides.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|i| self.min[i] <= other.max[i] && other.min[i] <= self.max[i])
    }

    /// The smallest box around both.
    #[inline]
    pub fn united(&self, other: &Self) -> Self {
        Self { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// The box with every side moved outwards by `margin` (m).
    #[inline]
    pub fn grown(&self, margin: f64) -> Self {
        let by = Vec2::repeat(margin);
        Self { min: self.min - by, max: self.max + by }
    }
}

/// An interval after a number of halvings, of which that part is kept that begins where `is_below` holds.
pub fn halved([mut low, mut high]: [f64; 2], halvings: u32, is_below: impl Fn(f64) -> bool) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = 0.5 * (low + high);
        if is_below(middle) { low = middle } else { high = middle }
    }
    [low, high]
}

/// Restricts faer to one thread from now on: the order of its sums would depend on the number of threads. To be called before each factorization.
pub fn factor_in_one_thread() {
    faer::set_global_parallelism(faer::Par::Seq);
}

/// The largest number of three digits that is not above a positive one, for messages that name a sufficient value.
pub fn rounded_down(value: f64) -> f64 {
    let nearest = three_digits(value);
    if nearest <= value { nearest } else { three_digits(nearest - last_digit(value)) }
}

/// The smallest number of three digits that is not below a positive one.
pub fn rounded_up(value: f64) -> f64 {
    let nearest = three_digits(value);
    if nearest >= value { nearest } else { three_digits(nearest + last_digit(value)) }
}

fn three_digits(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// One in the third digit.
fn last_digit(value: f64) -> f64 {
    10.0_f64.powi(value.log10().floor() as i32 - 2)
}

/// What an exponential approach still changes after `change`, with the `ratio` r of this change to that over the equal interval before: |change| r/(1 − r), r at
/// most [`SLOWEST`].
pub fn remaining(change: f64, ratio: f64) -> f64 {
    let ratio = ratio.min(SLOWEST);
    change.abs() * ratio / (1.0 - ratio)
}

/// Largest ratio of successive changes that determines an approach.
pub const SLOWEST: f64 = 0.9;

/// The root of a node in a disjoint-set forest, with path halving: `parent` has the parent of each node; a root is its own.
pub fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_numbers_lie_on_their_side_and_within_a_hundredth() {
        for k in 1..2000 {
            let value = 1.37e-9 * 1.017_f64.powi(k);
            for value in [value, format!("{value:.2e}").parse().unwrap()] {
                let (down, up) = (rounded_down(value), rounded_up(value));
                assert!(down <= value && value <= up && up - down < 0.011 * value, "{down:e} {value:e} {up:e}");
                assert_eq!((down, up), (format!("{down:.2e}").parse().unwrap(), format!("{up:.2e}").parse().unwrap()));
            }
        }
    }
}
