//! Unfilled outlines that cross each other, as in DXF: united, or a hole that overshoots.
//!
//! Of two outlines that cross, the smaller one is a hole in the larger one, or an island in a hole, if most of it lies inside; the overshooting part is cut
//! off. Otherwise both are united.

use crate::import::combine::{Solid, TOLERANCE, area};
use crate::import::drawing::{Refusal, Ring};
use crate::import::nest::Region;
use crate::import::notes::Notes;
use meniscus_core::math::{Vec2, root};
use meniscus_geometry::body::bulged_ring;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::rings::{crossings, faults};

/// Fraction of the smaller outline inside the larger one above which it is a hole.
const HOLE: f64 = 0.5;
/// Maximum number of rounds of uniting and cutting outlines until none cross.
const ROUNDS: usize = 4;
/// Maximum number of source locations in a note.
const NAMED: usize = 3;

/// A ring and its source location.
pub(crate) type Placed = (Ring, String);

/// The rings without crossings; notes describe the changes.
pub(crate) fn resolved(mut rings: Vec<Placed>, notes: &mut Notes, refusals: &mut Vec<Refusal>) -> Vec<Placed> {
    let size = rings.iter().map(|(ring, _)| ring.bounds()).reduce(|a, b| a.united(&b)).map_or(0.0, |b| b.size().max());
    let tolerance = TOLERANCE * size;
    let (mut holes, mut united) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        let pairs = crossing_pairs(&rings);
        if pairs.is_empty() {
            break;
        }
        let solids: Vec<Option<Solid>> = rings.iter().map(|(ring, _)| Solid::of_ring(ring)).collect();
        let (mut together, mut cut): (Vec<[usize; 2]>, Vec<[usize; 2]>) = (Vec::new(), Vec::new());
        for &(pair, at) in &pairs {
            let [small, large] =
                if rings[pair[0]].0.area().abs() < rings[pair[1]].0.area().abs() { pair } else { [pair[1], pair[0]] };
            let both = solids[small].as_ref().zip(solids[large].as_ref());
            match both.and_then(|(small, large)| small.within(large, tolerance)) {
                Some(inner) if area(&inner) > HOLE * rings[small].0.area().abs() => cut.push([small, large]),
                Some(_) => together.push([small, large]),
                None => refusals.push(refusal(&rings, pair, at)),
            }
        }
        let mut changed: Vec<Option<Vec<Placed>>> = vec![None; rings.len()];
        // United outlines may be nested differently: the outlines around them wait for the next round.
        for group in groups(&together, rings.len()) {
            let parts: Vec<Solid> = group.iter().filter_map(|&i| Solid::of_ring(&rings[i].0)).collect();
            let Some(all) = Solid::united(&parts, tolerance) else {
                refusals.push(refusal(&rings, [group[0], group[1]], rings[group[0]].0.bounds().center()));
                continue;
            };
            united.push(format!("{} and {}", rings[group[0]].1, rings[group[1]].1));
            let location = rings[group[0]].1.clone();
            group.iter().for_each(|&i| changed[i] = Some(Vec::new()));
            changed[group[0]] = Some(placed(all, &location));
        }
        for [small, large] in cut {
            if changed[small].is_some() || changed[large].is_some() {
                continue;
            }
            let both = solids[small].as_ref().zip(solids[large].as_ref());
            let Some(inner) = both.and_then(|(small, large)| small.within(large, tolerance)) else { continue };
            holes.push(format!("{} in {}", rings[small].1, rings[large].1));
            changed[small] = Some(placed(inner, &rings[small].1));
        }
        if changed.iter().all(Option::is_none) {
            break;
        }
        let with = rings.into_iter().zip(changed);
        rings = with.flat_map(|(ring, new)| new.unwrap_or_else(|| vec![ring])).collect();
    }
    for (locations, text) in [
        (united, "outlines that overlap are united"),
        (
            holes,
            "outlines that overshoot the outline around most of their area are holes in it; to unite them, draw them as one",
        ),
    ] {
        if !locations.is_empty() {
            let more = if locations.len() > NAMED { ", ..." } else { "" };
            let named = locations.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
            notes.add(format!("{} {text}: {named}{more}.", locations.len()));
        }
    }
    rings
}

fn refusal(rings: &[Placed], [a, b]: [usize; 2], at: Vec2) -> Refusal {
    let found =
        format!("an outline that crosses that of {} near ({:e}, {:e}) m and touches it", rings[b].1, at.x, at.y);
    Refusal::new(rings[a].1.clone(), found, "outlines that cross or keep apart: unite or subtract them in the drawing")
}

/// Pairs of rings, each valid by itself, that cross.
fn crossing_pairs(rings: &[Placed]) -> Vec<([usize; 2], Vec2)> {
    let curves: Vec<Vec<Curve>> = rings.iter().map(|(ring, _)| bulged_ring(&ring.vertices).collect()).collect();
    let pairs = crossings(&curves);
    let is_sound = |i: usize| faults(std::slice::from_ref(&curves[i])).is_empty();
    pairs.into_iter().filter(|([a, b], _)| is_sound(*a) && is_sound(*b)).collect()
}

/// Connected groups of rings by their pairs, two or more in each group.
fn groups(pairs: &[[usize; 2]], count: usize) -> Vec<Vec<usize>> {
    let mut first: Vec<usize> = (0..count).collect();
    for &[a, b] in pairs {
        let (a, b) = (root(&mut first, a), root(&mut first, b));
        first[a.max(b)] = a.min(b);
    }
    let mut groups = vec![Vec::new(); count];
    (0..count).for_each(|i| groups[root(&mut first, i)].push(i));
    groups.retain(|group| group.len() > 1);
    groups
}

/// All rings of regions, with holes as separate rings.
fn placed(regions: Vec<Region>, location: &str) -> Vec<Placed> {
    let rings = regions.into_iter().flat_map(|(outer, holes)| std::iter::once(outer).chain(holes));
    rings.map(|ring| (ring, location.to_owned())).collect()
}
