//! Elements, the units of filling, and gates between them.
//!
//! With touches and overlaps, an element is a part of a pore region between at most three walls if such a division exists (`divide`), and each throat and each
//! dividing segment is a gate. With bursts alone, an element is a pore of the network with its merged regions, and only the remaining throats are gates.

use super::dead_ends::cut_dead_ends;
use super::divide::divide;
use super::loops::{Crossing, GateId, Loop};
use crate::graph::{Edge, Network, Pores, Region};
use meniscus_core::math::Vec2;
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
    /// The gate of each crossing of each loop, with the end that lies there; `None` at openings and dissolved throats.
    pub(crate) gate_at: Vec<Vec<Option<FrontId>>>,
    /// For each crossing of each loop: the loop and the crossing on its other side, and the shift in m from the frame of this loop to that of
    /// the other one; `None` at openings.
    pub(crate) twins: Vec<Vec<Option<(usize, usize, Vec2)>>>,
    pub(crate) elements: Vec<Element>,
    pub(crate) gates: Vec<Gate>,
    /// The side of each opening: left, right, bottom, top are 0 to 3.
    pub(crate) side_of_opening: Vec<usize>,
}

/// The loop of a region.
pub(super) fn loop_of(region: &Region) -> Loop {
    let mut found = Loop { has_seam: true, ..Loop::default() };
    let mut wall = Vec::new();
    // Start after a crossing, so that no stretch of wall is split at the start of the list of edges.
    let first = region.edges.iter().position(|edge| !matches!(edge, Edge::Wall(_))).map_or(0, |k| k + 1);
    for k in 0..region.edges.len() {
        let crossing = match &region.edges[(first + k) % region.edges.len()] {
            Edge::Wall(pieces) => {
                wall.extend_from_slice(pieces);
                continue;
            }
            Edge::Throat { throat, end, from, to } => {
                Crossing { gate: GateId::Throat(*throat, *end), from: *from, to: *to }
            }
            Edge::Opening { opening, from, to } => Crossing { gate: GateId::Opening(*opening), from: *from, to: *to },
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
            found.walls[next].splice(0..0, before);
        }
    }
    if found.walls.is_empty() {
        // A closed pore without any throat.
        found.walls.push(wall);
    }
    found.has_seam = found.connected().1;
    found
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
        let (mut mesh, mut segments) = (Self::default(), 0);
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
                    GateId::Throat(throat, end) => crossings[throat][end] = Some((index, slot)),
                    GateId::Segment(segment, side) => crossings[throats + segment][side] = Some((index, slot)),
                    GateId::Opening(opening) => {
                        self.elements[element].open[network.openings[opening].side] = true;
                    }
                }
            }
        }
        for (part, &element) in self.loops.iter().zip(&self.element_of) {
            for crossing in &part.apart {
                if let GateId::Opening(opening) = crossing.gate {
                    self.elements[element].open[network.openings[opening].side] = true;
                }
            }
        }
        self.gate_at = self.loops.iter().map(|part| vec![None; part.crossings.len()]).collect();
        self.twins = self.loops.iter().map(|part| vec![None; part.crossings.len()]).collect();
        for (k, sides) in crossings.into_iter().enumerate() {
            let throat = (k < throats).then_some(k);
            let [Some(one), Some(other)] = sides else { continue };
            let shift = throat.map_or_else(Vec2::zeros, |throat| network.throats[throat].shift);
            self.twins[one.0][one.1] = Some((other.0, other.1, shift));
            self.twins[other.0][other.1] = Some((one.0, one.1, -shift));
            if throat.is_some_and(|throat| !is_gate(throat)) {
                continue;
            }
            let gate = self.gates.len();
            for (end, (index, slot)) in [one, other].into_iter().enumerate() {
                self.gate_at[index][slot] = Some((gate, end));
                self.elements[self.element_of[index]].gates.push((gate, end));
            }
            self.gates.push(Gate { crossings: [one, other], shift, throat });
        }
        self
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
