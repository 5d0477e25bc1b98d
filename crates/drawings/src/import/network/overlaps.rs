//! Parts of a drawn network that overlap without being joined in it: where they do, the drawing has other throats than the file.

use std::collections::BTreeSet;
use std::fmt;

use crate::import::network::channels::Channel;
use crate::import::network::model::Network;
use crate::import::network::openings::Openings;
use meniscus_core::math::{Bounds, Vec2, distance_to_segment};
use meniscus_geometry::curve::cross;
use meniscus_geometry::tree::Tree;

/// Overlaps below this part of the widths are rounding.
const TOUCHING: f64 = 1e-9;
/// Largest number of overlaps that a note names.
const NAMED: usize = 8;
/// Largest number of pairs that are looked at: all of a network have far fewer, but for thousands of throats at one pore.
const MOST_PAIRS: usize = 20_000_000;

/// A pore, a throat or an opening, by its number in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Name {
    Pore(usize),
    Throat(usize),
    Opening(usize),
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pore(number) => write!(f, "pore {number}"),
            Self::Throat(number) => write!(f, "throat {number}"),
            Self::Opening(number) => write!(f, "the opening of pore {number}"),
        }
    }
}

/// All points within `half` of a line.
struct Part {
    name: Name,
    pores: [usize; 2],
    line: [Vec2; 2],
    half: f64,
    /// Whether it is the middle of its throat, which another throat between the same pores must leave free.
    is_neck: bool,
}

impl Part {
    fn bounds(&self) -> Bounds {
        let [a, b] = self.line;
        Bounds { min: a.inf(&b), max: a.sup(&b) }.grown(self.half)
    }

    fn is_joined(&self, other: &Self) -> bool {
        self.pores.iter().any(|pore| other.pores.contains(pore))
    }

    fn is_disc(&self) -> bool {
        matches!(self.name, Name::Pore(_))
    }
}

/// The sentence on overlaps of the pores with the channels of throats, by the index of each throat.
pub(super) fn note(network: &Network, throats: &[(usize, Channel)], openings: &Openings) -> Option<String> {
    let parts = parts(network, throats, openings);
    let joined: BTreeSet<[usize; 2]> =
        throats.iter().map(|&(throat, _)| sorted(network.throats[throat].pores)).collect();
    let mut found: BTreeSet<[Name; 2]> = wide(network, throats).collect();
    let tree = Tree::over(parts.iter().map(Part::bounds));
    let mut pairs = 0;
    for (i, part) in parts.iter().enumerate() {
        for j in tree.near(part.bounds()).filter(|&j| j < i) {
            pairs += 1;
            let other = &parts[j];
            let is_apart = || !is_of_network(part, other, &joined) && do_overlap(part, other);
            if part.name != other.name && (is_apart() || is_fork(network, part, other)) {
                found.insert(sorted([part.name, other.name]));
            }
        }
        if pairs > MOST_PAIRS {
            break;
        }
    }
    if found.is_empty() {
        return None;
    }
    let named: Vec<String> = found.iter().take(NAMED).map(|[a, b]| format!("{a} and {b}")).collect();
    let more = if found.len() > NAMED { ", ..." } else { "" };
    Some(format!(
        "overlaps ({}) that the network does not have, where other pores and throats may result: {}{more}; numbers from 0, as in the file",
        found.len(),
        named.join(", ")
    ))
}

fn parts(network: &Network, throats: &[(usize, Channel)], openings: &Openings) -> Vec<Part> {
    let mut parts = Vec::new();
    for (index, pore) in network.pores.iter().enumerate().filter(|(_, pore)| !pore.is_opening) {
        let (line, half) = ([pore.center; 2], pore.radius);
        parts.push(Part { name: Name::Pore(index), pores: [index; 2], line, half, is_neck: false });
    }
    for (index, channel) in throats {
        let (name, pores) = (Name::Throat(network.numbers[*index]), network.throats[*index].pores);
        let part = |line: [Vec2; 2], is_neck| Part { name, pores, line, half: channel.half, is_neck };
        parts.extend(channel.parts.iter().map(|&line| part(line, false)));
        parts.push(part([channel.neck; 2], true));
    }
    for opening in &openings.all {
        let (name, pores, half) = (Name::Opening(opening.labeled), [opening.pore; 2], opening.channel.half);
        parts.extend(opening.channel.parts.iter().map(|&line| Part { name, pores, line, half, is_neck: false }));
    }
    parts
}

/// Whether two parts may overlap: at a common pore, and discs that a throat joins.
fn is_of_network(part: &Part, other: &Part, joined: &BTreeSet<[usize; 2]>) -> bool {
    if part.is_neck || other.is_neck {
        return !(part.is_neck && other.is_neck && sorted(part.pores) == sorted(other.pores));
    }
    let are_discs = part.is_disc() && other.is_disc();
    part.is_joined(other) || (are_discs && joined.contains(&sorted([part.pores[0], other.pores[0]])))
}

/// Whether two channels leave a pore at an acute angle and their walls meet beyond its disc: the fork is a wider place.
fn is_fork(network: &Network, part: &Part, other: &Part) -> bool {
    if part.is_neck || other.is_neck || part.is_disc() || other.is_disc() {
        return false;
    }
    let Some(&pore) = part.pores.iter().find(|pore| other.pores.contains(pore)) else { return false };
    let pore = &network.pores[pore];
    let direction = |part: &Part| {
        let [a, b] = part.line;
        let from_pore = if a == pore.center { Some(b - a) } else { (b == pore.center).then(|| a - b) };
        from_pore.map(|along| along.normalize())
    };
    let Some((one, two)) = direction(part).zip(direction(other)) else { return false };
    let (h, k, cos, sin) = (part.half, other.half, one.dot(&two), cross(one, two).abs());
    // The distance of the point where both walls meet, between the channels.
    h * h + k * k + 2.0 * h * k * cos > (pore.radius * sin).powi(2) * (1.0 + TOUCHING) && cos > TOUCHING
}

fn do_overlap(part: &Part, other: &Part) -> bool {
    let reach = part.half + other.half;
    distance(part.line, other.line) < reach * (1.0 - TOUCHING)
}

/// Throats whose pores overlap in a longer chord than they are wide.
fn wide<'n>(network: &'n Network, throats: &'n [(usize, Channel)]) -> impl Iterator<Item = [Name; 2]> + 'n {
    throats.iter().filter_map(move |(index, channel)| {
        let throat = &network.throats[*index];
        let [a, b] = throat.pores.map(|pore| &network.pores[pore]);
        let distance = (b.center - a.center).norm();
        // From the first center to the chord.
        let along = 0.5 * (distance + (a.radius * a.radius - b.radius * b.radius) / distance);
        let half = (a.radius * a.radius - along * along).max(0.0).sqrt();
        let is_within = distance <= (a.radius - b.radius).abs();
        let is_wide = is_within || half > channel.half * (1.0 + TOUCHING);
        is_wide.then(|| sorted([Name::Throat(network.numbers[*index]), Name::Pore(throat.pores[0])]))
    })
}

fn sorted<T: Ord>([a, b]: [T; 2]) -> [T; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// The distance of two segments in m.
fn distance([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> f64 {
    let side = |from: Vec2, to: Vec2, x: Vec2| cross(to - from, x - from);
    if side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0 {
        return 0.0;
    }
    let ends = [(a, [c, d]), (b, [c, d]), (c, [a, b]), (d, [a, b])];
    ends.into_iter().map(|(x, line)| distance_to_segment(x, line)).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_of_segments_that_cross_meet_end_to_side_or_are_points() {
        let v = Vec2::new;
        assert_eq!(distance([v(0.0, 0.0), v(2.0, 2.0)], [v(0.0, 2.0), v(2.0, 0.0)]), 0.0);
        assert_eq!(distance([v(0.0, 0.0), v(4.0, 0.0)], [v(1.0, 3.0), v(1.0, 5.0)]), 3.0);
        assert_eq!(distance([v(0.0, 0.0); 2], [v(3.0, 4.0); 2]), 5.0);
        assert_eq!(distance([v(0.0, 0.0), v(4.0, 0.0)], [v(5.0, 0.0), v(9.0, 0.0)]), 1.0);
    }
}
