//! Two menisci that advance towards each other along a wall that they share.
//!
//! They become one where their contacts meet on the wall; earlier, off the wall, where both bulge and the arcs touch first: the defending
//! pocket behind the place of touch stays on the wall.

use crate::network::menisci::meniscus::Meniscus;
use crate::network::menisci::passage::Passage;

/// The smallest curvature, at most `up_to` (1/m), at which two menisci meet that advance along a shared wall: the left wall of `a`, beyond
/// its chord, is the right wall of `b` run through the other way. `shared` is the length of that wall between both chords in m. Both
/// passages are told in one frame.
#[must_use]
pub fn overlap(a: &Passage, b: &Passage, shared: f64, up_to: f64) -> Option<f64> {
    let (from_a, from_b) = (a.lowest()?.curvature, b.lowest()?.curvature);
    let low = from_a.max(from_b);
    let high = up_to.min(a.burst()?.curvature).min(b.burst()?.curvature);
    let have_met = |k: f64| match (a.at(k), b.at(k)) {
        (Some(one), Some(other)) => met(&one, &other, shared),
        _ => true,
    };
    if !(low <= high) || !have_met(high) {
        return None;
    }
    if have_met(low) {
        return Some(low);
    }
    let (mut low, mut high) = (low, high);
    // As many halvings as there are digits.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if have_met(middle) { high = middle } else { low = middle }
    }
    Some(high)
}

fn met(a: &Meniscus, b: &Meniscus, shared: f64) -> bool {
    a.left.advance + b.right.advance >= shared || (a.bend > 0.0 && b.bend > 0.0 && a.crosses(b))
}
