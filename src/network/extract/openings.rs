//! The point of an open side that is farthest from the walls.

use crate::geometry::critical::walls::Walls;
use crate::math::Vec2;

/// The point of the segment from `a` to `b` (m) whose wall distance is largest, and that distance in m.
///
/// The distance has slope at most one, which bounds it on every interval; the last one is searched by golden section.
pub(super) fn farthest(walls: &Walls, a: Vec2, b: Vec2) -> (Vec2, f64) {
    // Relative margin of the bound of an interval above the best value, below which it cannot contain a relevant peak.
    const CLOSE: f64 = 1e-3;
    // Bound for degenerate input; usually a few tens suffice.
    const MOST: usize = 10_000;
    let length = (b - a).norm();
    let value = |u: f64| walls.distance(a + (b - a) * u);
    let mut intervals = vec![(0.0, 1.0)];
    let mut best = (0.5, value(0.5));
    for u in [0.0, 1.0] {
        let d = value(u);
        if d > best.1 {
            best = (u, d);
        }
    }
    let mut shortest = 1.0;
    let mut count = 0;
    while let Some((low, high)) = intervals.pop() {
        let middle = 0.5 * (low + high);
        let d = value(middle);
        count += 1;
        if d > best.1 {
            best = (middle, d);
            shortest = high - low;
        }
        let most = d + 0.5 * (high - low) * length;
        if most > best.1 * (1.0 + CLOSE) && count < MOST {
            intervals.push((low, middle));
            intervals.push((middle, high));
        }
    }
    let shortest = f64::max(shortest, 2.0 * CLOSE * best.1 / length);
    let (mut low, mut high) = ((best.0 - shortest).max(0.0), (best.0 + shortest).min(1.0));
    const GOLDEN: f64 = 0.618_033_988_749_895;
    while (high - low) * length > 1e-12 * best.1.max(walls.tolerance) {
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
    (a + (b - a) * best.0, best.1)
}
