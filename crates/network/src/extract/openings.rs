//! The point of an open side that is farthest from the walls.

use meniscus_core::math::Vec2;
use meniscus_geometry::critical::walls::Walls;

/// The point of the segment from `a` to `b` (m) whose wall distance is largest, and that distance in m.
///
/// The distance has slope at most one, which bounds it on every interval; the remaining peaks are searched by golden section.
pub(super) fn farthest(walls: &Walls, a: Vec2, b: Vec2) -> (Vec2, f64) {
    // Relative margin of the bound of an interval above the best value, below which it is not divided: every peak that may be the highest has a sample near
    // its top.
    const CLOSE: f64 = 1e-3;
    // Bound for degenerate input; usually a few tens suffice.
    const MOST: usize = 10_000;
    let length = (b - a).norm();
    let value = |u: f64| walls.distance(a + (b - a) * u);
    let mut samples: Vec<(f64, f64)> = [0.0, 1.0].map(|u| (u, value(u))).to_vec();
    let mut best = samples[0].1.max(samples[1].1);
    let mut intervals = vec![(0.0, 1.0)];
    while let Some((low, high)) = intervals.pop() {
        let middle = 0.5 * (low + high);
        let d = value(middle);
        samples.push((middle, d));
        best = best.max(d);
        let most = d + 0.5 * (high - low) * length;
        if most > best * (1.0 + CLOSE) && samples.len() < MOST {
            intervals.push((low, middle));
            intervals.push((middle, high));
        }
    }
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at = |k: usize| samples[k.min(samples.len() - 1)];
    let is_peak = |&k: &usize| {
        let beside = at(k.saturating_sub(1)).1.max(at(k + 1).1);
        samples[k].1 >= beside && samples[k].1 > best * (1.0 - 2.0 * CLOSE)
    };
    let precision = 1e-12 * best.max(walls.tolerance) / length;
    let peaks = (0..samples.len()).filter(is_peak);
    let tops = peaks.map(|k| top(value, samples[k], [at(k.saturating_sub(1)).0, at(k + 1).0], precision));
    let (u, d) = tops.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0.5, best));
    (a + (b - a) * u, d)
}

/// The highest point of a peak between two parameters by golden section, as parameter and value.
fn top(value: impl Fn(f64) -> f64, mut best: (f64, f64), [mut low, mut high]: [f64; 2], precision: f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    while high - low > precision {
        let (p, q) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        if !(p > low && q < high) {
            break;
        }
        let (dp, dq) = (value(p), value(q));
        for (u, d) in [(p, dp), (q, dq)] {
            if d > best.1 {
                best = (u, d);
            }
        }
        if dp < dq { low = p } else { high = q }
    }
    best
}
