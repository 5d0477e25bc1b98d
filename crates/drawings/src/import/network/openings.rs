//! Openings of a network: straight channels from labeled pores to the sides of the domain.
//!
//! A pore labeled as at a side, as inlet or as outlet opens with its whole width. A boundary pore is itself an opening: it lies on the side, and the pore
//! behind it opens with the width of the throat between them, at most its own.
//!
//! A pore that opens with its whole width is one outline with its channels: separate ones would touch each other in tangents.

use crate::import::drawing::{FillRule, Outline, Ring};
use crate::import::network::channels::Channel;
use crate::import::network::model::{Network, Pore, Throat};
use meniscus_core::math::{Bounds, Vec2};

/// Room between the pore space and a side without boundary pores, over the longer side: a disc that touches a side leaves no network.
const MARGIN: f64 = 1e-3;

/// An opening this much narrower than its pore, over the width, is as wide.
const AS_WIDE: f64 = 1e-3;

/// The opening of a pore.
pub(super) struct Opening {
    /// The pore behind it.
    pub(super) pore: usize,
    /// The pore that is labeled: the same, or a boundary pore.
    pub(super) labeled: usize,
    side: usize,
    /// Its channel, which ends beyond the side.
    pub(super) channel: Channel,
    /// Whether it is as wide as its pore.
    is_whole: bool,
}

/// The domain and the openings at its sides.
pub(super) struct Openings {
    pub(super) domain: Bounds,
    pub(super) all: Vec<Opening>,
    /// Openings narrower than their boundary pores, as their pores are.
    pub(super) narrowed: usize,
}

impl Openings {
    /// The openings of a network whose pores and throats lie in `around`. The domain ends at boundary pores, elsewhere around all.
    pub(super) fn of(network: &Network, around: Bounds) -> Self {
        let centers = Bounds::around(network.pores.iter().map(|pore| pore.center)).unwrap_or(around);
        let at_ends = [0, 1].map(|end| side_of_end(network, end, centers));
        // Sides of each pore, its labels for sides before those for inlet and outlet.
        let sides_of = |pore: usize| {
            let pore = &network.pores[pore];
            let labeled = (0..4).filter(|&side| pore.at_side[side]);
            let of_ends = (0..2).filter(|&end| pore.at_end[end] && pore.at_side == [false; 4]).map(|end| at_ends[end]);
            labeled.chain(of_ends).collect::<Vec<usize>>()
        };
        let boundary: Vec<(&Throat, usize, usize)> = network
            .throats
            .iter()
            .filter_map(|throat| {
                let labeled = throat.pores.into_iter().find(|&pore| network.pores[pore].is_opening)?;
                let side = sides_of(labeled).first().copied();
                Some((throat, labeled, side.unwrap_or_else(|| nearest(network.pores[labeled].center, centers))))
            })
            .collect();
        let mut domain = around.grown(MARGIN * around.size().max());
        for side in 0..4 {
            let all = boundary.iter().filter(|it| it.2 == side).map(|it| network.pores[it.1].center[side / 2]);
            let outermost = if side.is_multiple_of(2) { all.reduce(f64::min) } else { all.reduce(f64::max) };
            if let Some(at) = outermost {
                let corner = if side.is_multiple_of(2) { &mut domain.min } else { &mut domain.max };
                corner[side / 2] = at;
            }
        }
        let (mut all, mut narrowed) = (Vec::new(), 0);
        for (throat, labeled, side) in boundary {
            let [a, b] = throat.pores;
            let pore = if a == labeled { b } else { a };
            let (half, radius) = (0.5 * throat.width, network.pores[pore].radius);
            narrowed += usize::from(half > radius);
            let is_whole = half > radius * (1.0 - AS_WIDE);
            let half = if is_whole { radius } else { half };
            all.push(Opening {
                pore,
                labeled,
                side,
                channel: to_side(network, [pore, labeled], half, side, domain),
                is_whole,
            });
        }
        for pore in (0..network.pores.len()).filter(|&pore| !network.pores[pore].is_opening) {
            for side in sides_of(pore) {
                let channel = to_side(network, [pore; 2], network.pores[pore].radius, side, domain);
                all.push(Opening { pore, labeled: pore, side, channel, is_whole: true });
            }
        }
        Self { domain, all, narrowed }
    }

    /// The outlines of all pores with a size, in order, each with the index of its pore; those that open with their whole width with their channels.
    pub(super) fn pores(&self, network: &Network) -> Vec<(usize, Outline)> {
        let mut ends = vec![[None; 4]; network.pores.len()];
        for opening in self.all.iter().filter(|opening| opening.is_whole) {
            ends[opening.pore][opening.side] = opening.channel.parts.last().map(|part| part[1]);
        }
        let pores = network.pores.iter().zip(ends).enumerate().filter(|(_, (pore, _))| !pore.is_opening);
        pores.map(|(index, (pore, ends))| (index, outline(pore, ends))).collect()
    }

    /// The openings that are channels apart from their pores, and not outside of the domain, as of a pore whose center lies on the side.
    pub(super) fn apart(&self) -> impl Iterator<Item = &Opening> {
        let is_inside = |opening: &&Opening| {
            let begin = opening.channel.parts.first().map_or(Vec2::zeros(), |part| part[0]);
            distance(begin, self.domain, opening.side) > MARGIN * opening.channel.half
        };
        self.all.iter().filter(|opening| !opening.is_whole).filter(is_inside)
    }

    /// What the user should know of them.
    pub(super) fn notes(&self) -> Vec<String> {
        if self.all.is_empty() {
            let labels = "inlet, outlet, left, right, bottom or top";
            return vec![format!("no openings: no pore has a label {labels} that is True, and all sides are solid")];
        }
        let note = format!("openings ({}) as wide as their pores, narrower than the file says", self.narrowed);
        if self.narrowed > 0 { vec![note] } else { Vec::new() }
    }
}

/// The outline of a pore with channels of its whole width to the given ends, at the left, right, bottom and top.
fn outline(pore: &Pore, ends: [Option<Vec2>; 4]) -> Outline {
    let (center, radius) = (pore.center, pore.radius);
    if ends == [None; 4] {
        return Outline::Disc { center, radius };
    }
    // Counter-clockwise from the right.
    let ends = [1, 3, 0, 2].map(|side| ends[side]);
    let arm = |k: usize| [Vec2::x(), Vec2::y(), -Vec2::x(), -Vec2::y()][k % 4] * radius;
    let at = |p: Vec2, bulge: f64| [p.x, p.y, bulge];
    let quarter = std::f64::consts::FRAC_PI_8.tan();
    let mut vertices = Vec::new();
    for k in 0..4 {
        let next = ends[(k + 1) % 4];
        match ends[k] {
            Some(end) => {
                vertices.extend([at(end - arm(k + 1), 0.0), at(end + arm(k + 1), 0.0)]);
                if next.is_some() {
                    vertices.push(at(center + arm(k) + arm(k + 1), 0.0));
                }
            }
            None => vertices.push(at(center + arm(k), if next.is_none() { quarter } else { 0.0 })),
        }
    }
    Outline::Area { rings: vec![Ring { vertices }], rule: FillRule::EvenOdd }
}

/// Distance of a point from a side of a box.
fn distance(x: Vec2, within: Bounds, side: usize) -> f64 {
    let axis = side / 2;
    if side.is_multiple_of(2) { x[axis] - within.min[axis] } else { within.max[axis] - x[axis] }
}

fn nearest(x: Vec2, within: Bounds) -> usize {
    (0..4).min_by(|&a, &b| distance(x, within, a).total_cmp(&distance(x, within, b))).unwrap_or_default()
}

/// The side at which all inlets or all outlets without a label of a side lie, or nearly so.
fn side_of_end(network: &Network, end: usize, within: Bounds) -> usize {
    let pores = || network.pores.iter().filter(move |pore| pore.at_end[end] && pore.at_side == [false; 4]);
    let farthest = |side: usize| pores().map(|pore| distance(pore.center, within, side)).fold(0.0, f64::max);
    (0..4).min_by(|&a, &b| farthest(a).total_cmp(&farthest(b))).unwrap_or_default()
}

/// The straight channel from a pore to beyond a side, as near to the labeled pore as the disc allows.
fn to_side(network: &Network, [pore, labeled]: [usize; 2], half: f64, side: usize, domain: Bounds) -> Channel {
    let axis = side / 2;
    let pore = &network.pores[pore];
    let mut from = pore.center;
    // A wall that touches the disc in a tangent would not end.
    let reach = (pore.radius * (1.0 - AS_WIDE) - half).max(0.0);
    let along = network.pores[labeled].center[1 - axis];
    from[1 - axis] = along.clamp(from[1 - axis] - reach, from[1 - axis] + reach);
    let outward = if side.is_multiple_of(2) { -1.0 } else { 1.0 };
    let at = if side.is_multiple_of(2) { domain.min[axis] } else { domain.max[axis] };
    let mut to = from;
    // Beyond the side by at least its width, also from a pore whose center lies on it.
    to[axis] = outward * (outward * at).max(outward * from[axis]) + outward * 2.0 * half;
    Channel::straight([from, to], half, 0.5 * (from + to))
}
