//! Two menisci that advance towards each other along a common wall.
//!
//! They coalesce where their contacts meet on the wall, or earlier, off the wall, where both bulge and the arcs touch first: a pocket of the defending phase
//! remains on the wall behind that point.

use crate::interface::head::Head;
use crate::interface::menisci::meniscus::Meniscus;
use crate::interface::menisci::passage::Passage;

/// The smallest applied curvature, at most `up_to` (1/m), at which two menisci, each with the head at its height, meet that advance along a common wall
/// \[CieplakRobbins1988\]. The left wall of `a`, beyond its chord, is the right wall of `b` traversed in the opposite direction. `shared` is the length of that
/// wall between both chords in m. Both passages use the same coordinates.
pub fn overlap((a, head_a): (&Passage, Head), (b, head_b): (&Passage, Head), shared: f64, up_to: f64) -> Option<f64> {
    let range = |passage: &Passage| Some([passage.lowest()?.curvature, passage.burst()?.curvature]);
    let ([from_a, burst_a], [from_b, burst_b]) = (range(a)?, range(b)?);
    let low = head_a.applied(from_a).max(head_b.applied(from_b));
    let high = up_to.min(head_a.applied(burst_a)).min(head_b.applied(burst_b));
    // Within the range of each by rounding too.
    let (of_a, of_b) = (
        |k: f64| a.at(head_a.local(k).min(burst_a).max(from_a)),
        |k: f64| b.at(head_b.local(k).min(burst_b).max(from_b)),
    );
    let gap = |k: f64| match (of_a(k), of_b(k)) {
        (Some(one), Some(other)) => gap((a, &one), (b, &other), shared),
        _ => f64::NEG_INFINITY,
    };
    let at_high = if low <= high { gap(high) } else { return None };
    if at_high > 0.0 {
        return None;
    }
    let at_low = gap(low);
    if at_low <= 0.0 { Some(low) } else { Some(first_met(gap, (low, at_low), (high, at_high))) }
}

/// Zero of a gap between a state where it is open and one where it is closed: the Illinois false position, with bisection where that converges slowly.
fn first_met(gap: impl Fn(f64) -> f64, open: (f64, f64), met: (f64, f64)) -> f64 {
    let ((mut low, mut at_low), (mut high, mut at_high)) = (open, met);
    let tolerance = 4.0 * f64::EPSILON * low.abs().max(high.abs());
    // The width that the interval must reach, and the steps until then.
    let (mut goal, mut steps) = (0.125 * (high - low), 0);
    let mut was_open = None;
    while high - low > tolerance {
        let share = at_low / (at_low - at_high);
        steps += 1;
        let is_slow = steps > 3 || !share.is_finite();
        let middle = low + (high - low) * if is_slow { 0.5 } else { share };
        // Close to an end the trial steps over the root, so that the interval shrinks from both sides.
        let middle = middle.max(low + 0.5 * tolerance).min(high - 0.5 * tolerance);
        let value = gap(middle);
        let is_open = value > 0.0;
        // An end that is retained twice gets half its weight.
        let weight = if was_open == Some(is_open) { 0.5 } else { 1.0 };
        if is_open {
            (low, at_low, at_high) = (middle, value, at_high * weight);
        } else {
            (high, at_high, at_low) = (middle, value, at_low * weight);
        }
        was_open = Some(is_open);
        if high - low <= goal {
            (goal, steps) = (0.125 * (high - low), 0);
        }
    }
    high
}

/// The dimensionless gap between two menisci, at most 0 where they have met: between their contacts over the length of the common wall, or between their arcs
/// over the mean radius. Arcs meet ahead of both throats: a meniscus far behind its own throat may reach around the
/// common wall to the other one, in the invading phase.
fn gap(a: (&Passage, &Meniscus), b: (&Passage, &Meniscus), shared: f64) -> f64 {
    // Two contacts pinned at the same edge have met, whatever the rounding of their arc lengths.
    const ROUNDING: f64 = 1e-12;
    let contacts = 1.0 - ROUNDING - (a.1.left.advance + b.1.right.advance) / shared;
    if contacts <= 0.0 {
        return contacts;
    }
    let arcs = match (a.1.center(), b.1.center()) {
        (Some(one), Some(other)) if a.1.curvature > 0.0 && b.1.curvature > 0.0 => {
            let [k, l] = [a.1.curvature, b.1.curvature];
            let mean = if (k - l).abs() <= ROUNDING * k { k } else { 2.0 * k * l / (k + l) };
            (one - other).norm() * mean - 2.0
        }
        _ => f64::INFINITY,
    };
    let have_met = a.1.meetings(b.1).into_iter().flatten().any(|x| a.0.is_ahead(x) && b.0.is_ahead(x));
    if have_met {
        if arcs.is_finite() { arcs.min(0.0) } else { -contacts }
    } else if arcs > 0.0 {
        contacts.min(arcs)
    } else {
        // Intersections of the circles off the arcs are irrelevant.
        contacts
    }
}
