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
        (Some(one), Some(other)) => met((a, &one), (b, &other), shared),
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

/// Whether the contacts have met on the shared wall, or the arcs off it. Arcs that cross behind both throats do so on paper only.
fn met(a: (&Passage, &Meniscus), b: (&Passage, &Meniscus), shared: f64) -> bool {
    // Two contacts held at one edge have met, whatever the rounding of their way there.
    const ROUNDING: f64 = 1e-12;
    if a.1.left.advance + b.1.right.advance >= shared * (1.0 - ROUNDING) {
        return true;
    }
    a.1.meetings(b.1).into_iter().flatten().any(|x| a.0.is_ahead(x) || b.0.is_ahead(x))
}
