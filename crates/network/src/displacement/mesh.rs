//! Elements, the units of filling, and gates between them.
//!
//! With touches and overlaps, an element is a part of a pore region between at most three walls if such a division exists (`divide`), and each throat and each
//! dividing segment is a gate. With bursts alone, an element is a pore of the network with its merged regions, and only the remaining throats are gates.

use super::dead_ends::cut_dead_ends;
use super::divide::divide;
use super::loops::{Crossing, GateId, Loop};
use super::outline::outline;
use crate::graph::{Edge, Network, Pores, Region, Stretch};
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::Outlined;
use rayon::prelude::*;

/// A gate, and its end in an element: that at which a meniscus enters it.
pub(crate) type FrontId = (usize, usize);

/// A part of the pore space that is filled at once.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Element {
    /// Its loops.
    pub(crate) loops: Vec<usize>,
    /// Sides of the domain at which it is open: left, right, bottom, top.
    pub(crate) open: [bool; 4],
    /// Its gates with the end that lies in it, in order.
    pub(crate) gates: Vec<FrontId>,
}

/// A gate between two elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Gate {
    /// On each side the loop and the number of the crossing in it.
    pub(crate) crossings: [(usize, usize); 2],
    /// Shift in m from the frame of the first loop to that of the second.
    pub(crate) shift: Vec2,
    /// The throat, if it is one.
    pub(crate) throat: Option<usize>,
}

/// All elements and gates.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Mesh {
    pub(crate) loops: Vec<Loop>,
    /// The region of each loop.
    pub(crate) region_of: Vec<usize>,
    /// Area of each loop in m².
    pub(crate) area: Vec<f64>,
    /// The element of each loop.
    pub(crate) element_of: Vec<usize>,
    /// The number of the first crossing of each loop in `beyond`.
    first_crossing: Vec<u32>,
    /// What lies beyond each crossing of all loops; `None` at openings.
    beyond: Vec<Option<Beyond>>,
    pub(crate) elements: Vec<Element>,
    pub(crate) gates: Vec<Gate>,
    /// The side of each opening: left, right, bottom, top are 0 to 3.
    pub(crate) side_of_opening: Vec<usize>,
}

/// The other side of a crossing.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Beyond {
    /// The loop and the crossing in it.
    twin: (u32, u32),
    /// Shift in m from the frame of this loop to that of the other one.
    shift: Vec2,
    /// The gate, and whether this loop is on its second side; for a dissolved throat none.
    gate: Option<(u32, bool)>,
}

/// The loop of a region.
pub(super) fn loop_of(region: &Region) -> Loop {
    let mut found = Loop { has_seam: true, ..Loop::default() };
    let mut wall = Stretch::default();
    // Start after a crossing, so that no stretch of wall is split at the start of the list of edges.
    let first = region.edges.iter().position(|edge| !matches!(edge, Edge::Wall(_))).map_or(0, |k| k + 1);
    for k in 0..region.edges.len() {
        let crossing = match &region.edges[(first + k) % region.edges.len()] {
            Edge::Wall(pieces) => {
                wall = joined(&wall, pieces);
                continue;
            }
            Edge::Throat { throat, end, from, to } => {
                Crossing { gate: GateId::Throat(*throat as u32, *end as u8), from: *from, to: *to }
            }
            Edge::Opening { opening, from, to } => {
                Crossing { gate: GateId::Opening(*opening as u32), from: *from, to: *to }
            }
        };
        found.walls.push(std::mem::take(&mut wall));
        found.crossings.push(crossing);
    }
    // A whole side without walls is not part of the path along the walls, which goes around a periodic domain.
    let apart: Vec<bool> = (0..found.crossings.len()).map(|k| misses_walls(&found, k)).collect();
    for k in (0..found.crossings.len()).rev() {
        if apart[k] && found.crossings.len() > 1 {
            let opening = found.crossings.remove(k);
            found.apart.push(opening);
            let before = found.walls.remove(k);
            let next = k % found.walls.len();
            found.walls[next] = joined(&before, &found.walls[next]);
        }
    }
    if found.walls.is_empty() {
        // A closed pore without any throat.
        found.walls.push(wall);
    }
    found.has_seam = found.connected().1;
    found.fitted()
}

/// Two stretches of wall as one.
fn joined(one: &Stretch, next: &Stretch) -> Stretch {
    match (one.is_empty(), next.is_empty()) {
        (true, _) => Stretch::clone(next),
        (_, true) => Stretch::clone(one),
        _ => one.iter().chain(next.iter()).copied().collect(),
    }
}

/// Whether a crossing is an opening, or follows others that are, along sides without walls.
fn misses_walls(part: &Loop, k: usize) -> bool {
    let is_opening = |k: usize| matches!(part.crossings[k].gate, GateId::Opening(_));
    let count = part.crossings.len();
    let mut first = k;
    // Consecutive openings begin at the end of the wall before them.
    while is_opening(first) {
        if part.wall_before(first) != Vec2::zeros() || part.wall_after(first) != Vec2::zeros() {
            return true;
        }
        first = (first + count - 1) % count;
        if first == k || !part.walls[(first + 1) % count].is_empty() {
            return false;
        }
    }
    false
}

impl Outlined for Mesh {
    fn outline(&self, cell: usize) -> Vec<Vec2> {
        outline(&self.loops[cell])
    }
}

impl Mesh {
    /// Elements between at most three walls, as far as segments divide the regions; each dead end is an element of its own.
    pub(crate) fn divided(network: &Network) -> Self {
        let divided = |region: &Region| {
            let mut segments = 0;
            let without = cut_dead_ends(loop_of(region), region.center, &mut segments);
            let parts: Vec<Loop> = without.into_iter().flat_map(|part| divide(part, &mut segments)).collect();
            let areas = if parts.len() == 1 { vec![region.area] } else { parts.iter().map(Loop::area).collect() };
            (parts, areas, segments)
        };
        let all: Vec<(Vec<Loop>, Vec<f64>, usize)> = network.regions.par_iter().map(divided).collect();
        let (mut mesh, mut segments) = (Self::with_room(all.iter().map(|(parts, ..)| parts.len()).sum()), 0);
        for (index, (parts, areas, count)) in all.into_iter().enumerate() {
            mesh.area.extend(areas);
            for mut part in parts {
                part.crossings.iter_mut().for_each(|crossing| crossing.gate.number_from(segments));
                mesh.element_of.push(mesh.elements.len());
                mesh.region_of.push(index);
                mesh.elements.push(Element { loops: vec![mesh.loops.len()], ..Element::default() });
                mesh.loops.push(part);
            }
            segments += count;
        }
        mesh.joined(network, segments, &|_| true)
    }

    /// A mesh without loops, with memory for so many.
    fn with_room(loops: usize) -> Self {
        Self {
            loops: Vec::with_capacity(loops),
            region_of: Vec::with_capacity(loops),
            area: Vec::with_capacity(loops),
            element_of: Vec::with_capacity(loops),
            elements: Vec::with_capacity(loops),
            first_crossing: Vec::with_capacity(loops),
            ..Self::default()
        }
    }

    /// The pores of the network as elements.
    pub(crate) fn of_pores(network: &Network, pores: &Pores) -> Self {
        let mut mesh = Self { elements: vec![Element::default(); pores.area.len()], ..Self::default() };
        for (index, region) in network.regions.iter().enumerate() {
            let pore = pores.pore_of[index];
            mesh.elements[pore].loops.push(index);
            mesh.element_of.push(pore);
            mesh.region_of.push(index);
            mesh.area.push(region.area);
            mesh.loops.push(loop_of(region));
        }
        let mut is_left = vec![false; network.throats.len()];
        pores.throats.iter().for_each(|&throat| is_left[throat] = true);
        mesh.joined(network, 0, &|throat| is_left[throat])
    }

    /// Sets both sides of each gate.
    fn joined(mut self, network: &Network, segments: usize, is_gate: &dyn Fn(usize) -> bool) -> Self {
        self.side_of_opening = network.openings.iter().map(|opening| opening.side).collect();
        let throats = network.throats.len();
        let mut crossings = vec![[None; 2]; throats + segments];
        for (index, part) in self.loops.iter().enumerate() {
            let element = self.element_of[index];
            for (slot, crossing) in part.crossings.iter().enumerate() {
                match crossing.gate {
                    GateId::Throat(throat, end) => crossings[throat as usize][end as usize] = Some((index, slot)),
                    GateId::Segment(segment, side) => {
                        crossings[throats + segment as usize][side as usize] = Some((index, slot))
                    }
                    GateId::Opening(opening) => {
                        self.elements[element].open[network.openings[opening as usize].side] = true;
                    }
                }
            }
        }
        for (part, &element) in self.loops.iter().zip(&self.element_of) {
            for crossing in &part.apart {
                if let GateId::Opening(opening) = crossing.gate {
                    self.elements[element].open[network.openings[opening as usize].side] = true;
                }
            }
        }
        self.number_crossings();
        for (k, sides) in crossings.into_iter().enumerate() {
            let throat = (k < throats).then_some(k);
            let [Some(one), Some(other)] = sides else { continue };
            let shift = throat.map_or_else(Vec2::zeros, |throat| network.throats[throat].shift);
            let gate = throat.is_none_or(is_gate).then_some(self.gates.len());
            for (end, (here, there), shift) in [(0, (one, other), shift), (1, (other, one), -shift)] {
                let at = self.crossing(here.0, here.1);
                let twin = (there.0 as u32, there.1 as u32);
                self.beyond[at] = Some(Beyond { twin, shift, gate: gate.map(|gate| (gate as u32, end == 1)) });
                self.elements[self.element_of[here.0]].gates.extend(gate.map(|gate| (gate, end)));
            }
            self.gates.extend(gate.map(|_| Gate { crossings: [one, other], shift, throat }));
        }
        self.elements.iter_mut().for_each(|element| element.gates.shrink_to_fit());
        self.gates.shrink_to_fit();
        self
    }

    /// Numbers the crossings of all loops in order, with nothing beyond them.
    fn number_crossings(&mut self) {
        let mut count = 0;
        for part in &self.loops {
            self.first_crossing.push(count);
            count += part.crossings.len() as u32;
        }
        self.beyond = vec![None; count as usize];
    }

    /// The number of a crossing of a loop among those of all loops.
    fn crossing(&self, index: usize, slot: usize) -> usize {
        self.first_crossing[index] as usize + slot
    }

    /// The gate at a crossing of a loop, with the end that lies there; `None` at openings and dissolved throats.
    pub(crate) fn gate_at(&self, index: usize, slot: usize) -> Option<FrontId> {
        let (gate, end) = self.beyond[self.crossing(index, slot)]?.gate?;
        Some((gate as usize, usize::from(end)))
    }

    /// The loop and the crossing on the other side of a crossing of a loop, and the shift in m from the frame of this loop to that of the other one; `None` at
    /// openings, and in a loop without crossings.
    pub(crate) fn twin(&self, index: usize, slot: usize) -> Option<(usize, usize, Vec2)> {
        if slot >= self.loops[index].crossings.len() {
            return None;
        }
        let Beyond { twin: (beyond, twin), shift, .. } = self.beyond[self.crossing(index, slot)]?;
        Some((beyond as usize, twin as usize, shift))
    }

    /// The middle of the chord of a gate in m, in the frame of its first loop.
    pub(crate) fn middle(&self, gate: usize) -> Vec2 {
        let (part, slot) = self.gates[gate].crossings[0];
        let Crossing { from, to, .. } = self.loops[part].crossings[slot];
        0.5 * (from + to)
    }

    /// The element on side `end` of a gate.
    pub(crate) fn element(&self, gate: usize, end: usize) -> usize {
        self.element_of[self.gates[gate].crossings[end].0]
    }

    /// The neighbors of an element, one for each of its gates that is not closed and leads to another element.
    pub(crate) fn neighbors<'a>(&'a self, closed: &'a [bool], element: usize) -> impl Iterator<Item = usize> + 'a {
        let gates = self.elements[element].gates.iter().filter(|&&(gate, _)| !closed[gate]);
        gates.map(|&(gate, end)| self.element(gate, 1 - end)).filter(move |&other| other != element)
    }
}
