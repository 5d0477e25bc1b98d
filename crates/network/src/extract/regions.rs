//! Regions and throats from loops and maxima, and their certificate.

use std::collections::BTreeSet;

use crate::extract::loops::{Loop, Loops, Step};
use crate::extract::moments::Moments;
use crate::extract::openings::farthest;
use crate::graph::{Edge, Network, Opening, Region, Throat, WallPiece};
use meniscus_core::math::Vec2;
use meniscus_geometry::critical::CriticalPoints;
use meniscus_geometry::critical::opposite::SAME_DIRECTION;
use meniscus_geometry::critical::shift::{Shift, minus, plus};
use meniscus_geometry::critical::slope::curvature;
use meniscus_geometry::critical::walls::{Contact, Walls};
use rayon::prelude::*;

/// The result of extraction from given critical points.
pub(super) enum Attempt {
    /// A network with a certificate.
    Certified(Network),
    /// Regions without exactly one maximum.
    Failed {
        /// Where, in m.
        near: Vec<Vec2>,
        /// The walls around each of them.
        images: Vec<Vec<(usize, Shift)>>,
    },
}

impl Attempt {
    /// This attempt if it has a certificate, else the other one.
    pub(super) fn or(self, other: Self) -> Self {
        if matches!(self, Self::Certified(_)) { self } else { other }
    }
}

/// Regions that are built together.
const BLOCK: usize = 1 << 16;

/// Relative tolerance of equal radii and widths.
const SAME: f64 = 1e-7;

/// The network of the loops, if each of them has exactly one maximum.
pub(super) fn attempt(walls: &Walls, points: &CriticalPoints, loops: &Loops) -> Attempt {
    let owned = maxima_of(walls, points, loops);
    let mut network = Network { throats: throats(walls, points), ..Network::default() };
    let mut failed = Vec::new();
    for (block, first) in loops.loops.chunks(BLOCK).zip((0..).step_by(BLOCK)) {
        let of_loop = |(ring, maxima): (&Loop, &Vec<Owned>)| {
            build(walls, points, ring, maxima).filter(|built| is_certified(walls, &built.region, maxima.len()))
        };
        let built: Vec<Option<Built>> = block.par_iter().zip(&owned[first..]).map(of_loop).collect();
        for (number, built) in (first..).zip(built) {
            match built {
                Some(built) => built.join(number, &mut network),
                None => failed.push(number),
            }
        }
    }
    if !failed.is_empty() {
        return failure(walls, points, failed.iter().map(|&number| &loops.loops[number]));
    }
    let wide: Vec<usize> = (0..network.throats.len())
        .filter(|&throat| {
            let throat = &network.throats[throat];
            throat.regions.iter().any(|&r| 0.5 * throat.width > network.regions[r].radius * (1.0 + SAME))
        })
        .collect();
    if !wide.is_empty() {
        let around = wide.iter().flat_map(|&throat| network.throats[throat].regions);
        return failure(walls, points, around.map(|region| &loops.loops[region]));
    }
    Attempt::Certified(network)
}

/// A maximum of a loop: its number, and its shift in the frame of the loop.
#[derive(Debug, Clone, Copy)]
struct Owned {
    maximum: usize,
    shift: Shift,
}

/// The maxima of each loop.
fn maxima_of(walls: &Walls, points: &CriticalPoints, loops: &Loops) -> Vec<Vec<Owned>> {
    let mut owned = vec![Vec::new(); loops.loops.len()];
    for (k, maximum) in points.maxima.iter().enumerate() {
        let found = maximum
            .contacts
            .iter()
            .filter_map(|contact| loops.at(walls, contact, contact.point - maximum.center))
            // The contact farthest from chord ends is unambiguous.
            .max_by(|a, b| a.2.total_cmp(&b.2));
        if let Some((number, shift, _)) = found {
            owned[number].push(Owned { maximum: k, shift });
        }
    }
    owned
}

fn throats(walls: &Walls, points: &CriticalPoints) -> Vec<Throat> {
    points
        .saddles
        .iter()
        .map(|saddle| Throat {
            width: 2.0 * saddle.half,
            contacts: saddle.contacts.map(|contact| contact.point),
            shapes: saddle.contacts.map(|contact| walls.walls[contact.wall].shape),
            curvatures: saddle.contacts.map(|contact| contact_curvature(walls, &contact)),
            regions: [usize::MAX; 2],
            shift: Vec2::zeros(),
        })
        .collect()
}

/// The signed curvature in 1/m of the wall at a contact: infinite at a sharp vertex; the larger one if two arcs join smoothly.
fn contact_curvature(walls: &Walls, contact: &Contact) -> f64 {
    let [before, after] = walls.around(contact);
    let (Some(before), Some(after)) = (before, after) else { return f64::INFINITY };
    let (a, b) = (walls.curve(before.wall, before.shift), walls.curve(after.wall, after.shift));
    if before == after {
        return curvature(&a);
    }
    let turns = (a.tangent(1.0) - b.tangent(0.0)).norm() > SAME_DIRECTION;
    if turns { f64::INFINITY } else { curvature(&a).max(curvature(&b)) }
}

/// A region with what it adds to its network.
struct Built {
    region: Region,
    /// Its openings, which are numbered from zero in its edges.
    openings: Vec<Opening>,
    /// The throat of each chord, its end, and where in m the chord lies in the frame of the region.
    chords: Vec<(usize, usize, Vec2)>,
}

impl Built {
    /// Adds the region as that of a number.
    fn join(mut self, number: usize, network: &mut Network) {
        for (index, end, offset) in self.chords {
            let throat = &mut network.throats[index];
            throat.regions[end] = number;
            // `contacts` and `shift` are complete once both regions have been added.
            if end == 0 {
                throat.contacts = throat.contacts.map(|contact| contact + offset);
                throat.shift -= offset;
            } else {
                throat.shift += offset;
            }
        }
        for edge in &mut self.region.edges {
            if let Edge::Opening { opening, .. } = edge {
                *opening += network.openings.len();
            }
        }
        network.openings.extend(self.openings.into_iter().map(|opening| Opening { region: number, ..opening }));
        network.regions.push(self.region);
    }
}

/// The region of a loop; `None` if the loop is not closed or has neither maximum nor opening.
fn build(walls: &Walls, points: &CriticalPoints, ring: &Loop, maxima: &[Owned]) -> Option<Built> {
    if ring.winding != [0, 0] {
        return None;
    }
    let (center, radius, frame) = match maxima.first() {
        Some(owned) => {
            let maximum = &points.maxima[owned.maximum];
            (maximum.center, maximum.radius, owned.shift)
        }
        None => {
            let (x, radius) = widest_opening(walls, ring)?;
            let (center, shift) = walls.wrapped(x);
            (center, radius, shift)
        }
    };
    let by = |shift: Shift| minus(shift, frame);
    let mut moments = Moments::about(center);
    let mut wall_length = 0.0;
    let (mut edges, mut openings, mut chords) = (Vec::new(), Vec::new(), Vec::new());
    let mut stretch: Option<Vec<WallPiece>> = None;
    for step in &ring.steps {
        match *step {
            Step::Wall { wall, shift, from, to } => {
                let curve = walls.curve(wall, by(shift));
                let part = if (from, to) == (0.0, 1.0) { curve } else { curve.part(from, to) };
                moments.curve(&part);
                wall_length += part.length();
                let piece = WallPiece::part_of(&curve, part, walls.walls[wall].shape);
                stretch.get_or_insert_default().push(piece);
                continue;
            }
            Step::Chord { throat, end, shift } => {
                let saddle = &points.saddles[throat];
                let offset = walls.offset(by(shift));
                let (from, to) = (saddle.contacts[end].point + offset, saddle.contacts[1 - end].point + offset);
                moments.straight(from, to);
                edges.push(Edge::Wall(stretch.take().unwrap_or_default().into()));
                edges.push(Edge::Throat { throat, end, from, to });
                chords.push((throat, end, offset));
            }
            Step::Side { part, shift } => {
                let offset = walls.offset(by(shift));
                let (from, to) = (part.from + offset, part.to + offset);
                moments.straight(from, to);
                if let Some(pieces) = stretch.take() {
                    edges.push(Edge::Wall(pieces.into()));
                }
                edges.push(Edge::Opening { opening: openings.len(), from, to });
                openings.push(Opening { side: part.side, ends: [from, to], region: usize::MAX });
            }
        }
    }
    if let Some(last) = stretch {
        match edges.first_mut() {
            // The loop started within this stretch.
            Some(Edge::Wall(first)) => *first = last.iter().chain(first.iter()).copied().collect(),
            _ => edges.push(Edge::Wall(last.into())),
        }
    }
    edges.shrink_to_fit();
    let moments = moments.closed();
    let region = Region { center, radius, edges, area: -moments.area, wall_length, centroid: moments.centroid() };
    Some(Built { region, openings, chords })
}

/// The point on the openings of a loop farthest from the walls, in the frame of the loop, and its distance in m.
fn widest_opening(walls: &Walls, ring: &Loop) -> Option<(Vec2, f64)> {
    let parts = ring.steps.iter().filter_map(|step| match *step {
        Step::Side { part, shift } => Some((part, walls.offset(shift))),
        _ => None,
    });
    parts.map(|(part, offset)| farthest(walls, part.from + offset, part.to + offset)).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Whether a region has exactly one maximum.
fn is_certified(walls: &Walls, region: &Region, maxima: usize) -> bool {
    let openings = region.edges.iter().filter_map(|edge| match edge {
        Edge::Opening { from, to, .. } => Some((*from, *to)),
        _ => None,
    });
    let is_higher_outside =
        || openings.clone().any(|(from, to)| farthest(walls, from, to).1 > region.radius * (1.0 + SAME));
    match maxima {
        0 => region.area > 0.0,
        1 => region.area > 0.0 && !is_higher_outside(),
        _ => false,
    }
}

/// A failed certificate: the first point of each loop, and all its walls.
fn failure<'a>(walls: &Walls, points: &CriticalPoints, loops: impl Iterator<Item = &'a Loop>) -> Attempt {
    let (mut near, mut images) = (Vec::new(), Vec::new());
    for ring in loops {
        let position = ring.steps.iter().find_map(|step| match *step {
            Step::Wall { wall, from, to, .. } => Some(walls.walls[wall].curve.point(0.5 * (from + to))),
            Step::Chord { throat, .. } => Some(points.saddles[throat].center),
            Step::Side { .. } => None,
        });
        near.extend(position);
        let mut around = BTreeSet::new();
        for step in &ring.steps {
            match *step {
                Step::Wall { wall, shift, .. } => around.extend([(wall, shift)]),
                Step::Chord { throat, shift, .. } => {
                    around.extend(points.saddles[throat].contacts.map(|c| (c.wall, plus(c.shift, shift))));
                }
                Step::Side { .. } => {}
            }
        }
        images.push(around.into_iter().collect());
    }
    Attempt::Failed { near, images }
}
