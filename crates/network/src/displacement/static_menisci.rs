//! Menisci at rest as exact arcs, and the boundary of the invading phase along walls and menisci.
//!
//! All connected menisci have one curvature: the applied one, or that of the next event if it is lower, to which the pressure falls during
//! an avalanche at given area. Menisci around trapped ganglia keep the curvature at which these were cut off, or the lowest at which one of
//! them would advance, since their area is constant. Two menisci that have met on a grain are merged, between the outer walls of both.
//!
//! Left out: menisci of different pressures around one ganglion that was cut off in several parts; contact angles of menisci from an earlier
//! half cycle on walls with hysteresis. Arcs that would cross are replaced by the chords of their gates.

use std::f64::consts::PI;

use super::conditions::Conditions;
use super::division::Division;
use super::event::{Candidate, EventKind};
use super::fronts::Neighbor;
use super::loops::GateId;
use super::merged::Merged;
use super::mesh::{FrontId, Gate};
use super::progress::Displacement;
use super::wall_chains::{Side, WallChains};
use crate::graph::{Network, Pores};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::menisci::{Meniscus, Passage};

/// An interface between two elements.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StaticMeniscus {
    /// Elements of the invading and of the defending phase.
    pub(crate) between: [usize; 2],
    /// From the left wall to the right one in m, the defending phase on its left.
    pub(crate) curve: Curve,
    /// Curvature in 1/m, positive if it bulges into the defending phase; `None` if the chord of the gate replaces the meniscus.
    pub(crate) curvature: Option<f64>,
    /// Signed angle between the chord of both contacts and the interface in rad.
    pub(crate) bend: f64,
    /// Area in m² between the chord of the gate and the interface; `None` for a merged meniscus.
    pub(crate) swept: Option<f64>,
    /// Length of wall in m from the gate to the left and the right contact, each from its own gate.
    pub(crate) advances: [f64; 2],
    /// Its gate, or both gates of a merged meniscus, with the ends at which they enter.
    gates: Vec<FrontId>,
}

/// All interfaces, and the boundary of the invading phase.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Interfaces {
    pub(crate) menisci: Vec<StaticMeniscus>,
    /// The boundary of the invading phase in m, the phase on its left: along walls, then along menisci.
    pub(crate) outline: Vec<Curve>,
    /// For each element the curvature in 1/m of the menisci around its trapped phase; NaN if not trapped.
    pub(crate) trapped: Vec<f64>,
    /// Area of the invading phase in m²; `None` in a periodic domain with merged menisci.
    pub(crate) area: Option<f64>,
}

/// Two menisci that have met and merged.
struct Pair {
    /// Their gates with the ends at which they enter.
    gates: [FrontId; 2],
    /// The passage between the outer walls of both.
    passage: Passage,
}

/// The initial phases of a displacement.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Beginning {
    /// Whether the invading phase holds an element.
    pub(crate) invaded: Vec<bool>,
    /// The applied curvature in 1/m so far; -∞ if the half cycle starts with this state.
    pub(crate) applied: f64,
    /// Curvature in 1/m at which an element was trapped; NaN if it was not.
    pub(crate) held: Vec<f64>,
    /// Throats that films have closed.
    pub(crate) closed: Vec<usize>,
}

impl Displacement {
    /// A displacement with given initial phases; like [`new`](Self::new), it fills elements open at an inlet.
    pub(crate) fn beginning(network: &Network, pores: &Pores, conditions: Conditions, beginning: &Beginning) -> Self {
        let division = Division::of(network, pores, conditions.events);
        let mut invaded = vec![false; division.mesh.elements.len()];
        let mut held = vec![f64::NAN; division.mesh.elements.len()];
        for (index, &element) in division.mesh.element_of.iter().enumerate() {
            invaded[element] |= beginning.invaded[index];
            held[element] = beginning.held[index];
        }
        let is_closed = |gate: &Gate| gate.throat.is_some_and(|throat| beginning.closed.contains(&throat));
        let closed = division.mesh.gates.iter().map(is_closed).collect();
        let applied = if beginning.applied.is_finite() { beginning.applied } else { f64::INFINITY };
        let mut begun = Self::begun(division, conditions, invaded, closed, applied);
        (begun.applied, begun.held) = (beginning.applied, held);
        begun
    }

    /// The applied curvature in 1/m at which all connected menisci can be at rest: `applied`, or that of the next event if it is lower.
    pub(crate) fn resting_curvature(&self, applied: f64) -> f64 {
        let is_open = |it: &&Candidate| {
            let front = (it.gate, it.to);
            let meets = |(other, hand)| {
                self.neighbor(&self.mesh, front, hand).is_some_and(|neighbor: Neighbor| neighbor.front == other)
            };
            self.fronts[it.gate][it.to].is_some() && it.partner.is_none_or(meets)
        };
        self.queue.iter().filter(is_open).map(|it| it.curvature).fold(applied, f64::min)
    }

    /// All interfaces at a resting curvature (1/m), in a domain `periodic` along x and y.
    pub(crate) fn interfaces(&self, applied: f64, bounds: Bounds, periodic: [bool; 2]) -> Interfaces {
        let mesh = &self.mesh;
        let trapped = self.trapped_curvatures();
        let mut menisci = self.static_menisci(applied, &trapped);
        let is_invaded: Vec<bool> = mesh.element_of.iter().map(|&element| self.invaded[element]).collect();
        let chains = WallChains::new(mesh, &is_invaded, bounds, periodic);
        let walls = loop {
            let ends: Vec<[(Vec2, f64); 2]> = menisci
                .iter()
                .map(|it| [(it.curve.point(0.0), it.advances[0]), (it.curve.point(1.0), it.advances[1])])
                .collect();
            let traced = chains.traced(&ends);
            let crossed: Vec<usize> =
                traced.crossed.iter().copied().filter(|&index| menisci[index].curvature.is_some()).collect();
            if crossed.is_empty() {
                break traced.sides;
            }
            for index in crossed {
                let gates = menisci[index].gates.clone();
                menisci[index] = self.chord(gates[0]);
                menisci.extend(gates[1..].iter().map(|&gate| self.chord(gate)));
            }
        };
        let mut outline: Vec<Curve> = walls
            .into_iter()
            .map(|Side { piece, from, to }| chains.curves[piece].part(from, to).reversed())
            .filter(|curve| curve.length() > 0.0)
            .collect();
        outline.extend(menisci.iter().map(|it| it.curve.reversed()));
        let area = self.invading_area(&outline, &menisci, periodic);
        let trapped = mesh.element_of.iter().map(|&element| trapped[element]).collect();
        Interfaces { menisci, outline, trapped, area }
    }

    /// The interfaces in all gates between the phases; `trapped` are the curvatures of trapped elements.
    fn static_menisci(&self, applied: f64, trapped: &[f64]) -> Vec<StaticMeniscus> {
        let mesh = &self.mesh;
        let joined = self.joined();
        let is_joined = |front: FrontId| joined.iter().any(|pair| pair.gates.contains(&front));
        let mut found = Vec::new();
        for (gate, to) in (0..mesh.gates.len()).flat_map(|gate| [(gate, 0), (gate, 1)]) {
            let (from, into) = (mesh.element(gate, 1 - to), mesh.element(gate, to));
            if !self.invaded[from] || self.invaded[into] || is_joined((gate, to)) {
                continue;
            }
            let head = self.head(mesh, gate);
            let at_rest = |applied: f64, held: f64| head.local(if held.is_nan() { applied } else { held });
            let curvature = match &self.fronts[gate][to] {
                Some(front) => head.local(applied).min(front.own),
                None if self.connection.trapped[into] => at_rest(applied, trapped[into]),
                None => at_rest(applied, self.held[from]),
            };
            let own = self.fronts[gate][to].as_ref().map(|front| front.passage.clone());
            let passage = own.unwrap_or_else(|| self.passage(mesh, (gate, to), Vec2::zeros()).0);
            let burst = passage.burst().map_or(f64::INFINITY, |meniscus| meniscus.curvature);
            found.extend(self.at(&passage, curvature.min(burst), &[(gate, to)]));
        }
        for pair in &joined {
            let head = self.head_between(mesh, pair.gates.map(|(gate, _)| gate));
            found.extend(self.at(&pair.passage, head.local(applied), &pair.gates));
        }
        found
    }

    /// The meniscus of a passage at a curvature, or the chords of its gates.
    fn at(&self, passage: &Passage, curvature: f64, gates: &[FrontId]) -> Vec<StaticMeniscus> {
        let found = passage.at(curvature).filter(|it: &Meniscus| it.bend.abs() < PI && it.chord() > 0.0);
        let Some(meniscus) = found else { return gates.iter().map(|&gate| self.chord(gate)).collect() };
        let is_one = gates.len() == 1;
        let advance = |length: f64| if is_one { length } else { f64::INFINITY };
        vec![StaticMeniscus {
            curve: meniscus.curve(),
            curvature: Some(meniscus.curvature),
            bend: meniscus.bend,
            swept: is_one.then(|| passage.swept_area(&meniscus)),
            advances: [advance(meniscus.left.advance), advance(meniscus.right.advance)],
            gates: gates.to_vec(),
            ..self.chord(gates[0])
        }]
    }

    /// The chord of a gate as a substitute for its meniscus.
    fn chord(&self, (gate, to): FrontId) -> StaticMeniscus {
        let sides = self.mesh.gates[gate].crossings;
        let crossing = self.mesh.loops[sides[to].0].crossings[sides[to].1];
        StaticMeniscus {
            between: [sides[1 - to].0, sides[to].0],
            // The wall on the left continues at the end of the crossing.
            curve: Curve::Segment { a: crossing.to, b: crossing.from },
            curvature: None,
            bend: 0.0,
            swept: Some(0.0),
            advances: [0.0; 2],
            gates: vec![(gate, to)],
        }
    }

    /// Pairs of merged menisci.
    fn joined(&self) -> Vec<Pair> {
        let mut waiting: Vec<_> =
            self.queue.iter().filter(|it| it.is_joined && it.kind == EventKind::Overlap).collect();
        waiting.sort();
        let mut pairs: Vec<Pair> = Vec::new();
        for candidate in waiting.into_iter().rev() {
            let Some((other, hand)) = candidate.partner else { continue };
            let one = (candidate.gate, candidate.to);
            let is_new = |front: FrontId| pairs.iter().all(|pair| !pair.gates.contains(&front));
            if self.fronts[one.0][one.1].is_none() || !is_new(one) || !is_new(other) {
                continue;
            }
            let neighbor = self.neighbor(&self.mesh, one, hand).filter(|neighbor| neighbor.front == other);
            if let Some(neighbor) = neighbor {
                let (passage, _) = self.merged_passage(&self.mesh, &Merged::of(one, hand, &neighbor));
                pairs.push(Pair { gates: [one, other], passage });
            }
        }
        pairs
    }

    /// Area of the invading phase in m²: within its outline (Green), or by elements plus areas swept past gates.
    fn invading_area(&self, outline: &[Curve], menisci: &[StaticMeniscus], periodic: [bool; 2]) -> Option<f64> {
        let mesh = &self.mesh;
        let holds = |index: usize| self.invaded[mesh.element_of[index]];
        if periodic == [false; 2] {
            let origin = outline.first().map_or_else(Vec2::zeros, |curve| curve.point(0.0));
            let openings = mesh.loops.iter().enumerate().filter(|(index, _)| holds(*index)).flat_map(|(_, part)| {
                let crossings = part.crossings.iter().chain(&part.apart);
                crossings.filter(|crossing| matches!(crossing.gate, GateId::Opening(_)))
            });
            let openings = openings.map(|it| Curve::Segment { a: it.to, b: it.from }.area_about(origin));
            return Some(outline.iter().map(|curve| curve.area_about(origin)).sum::<f64>() + openings.sum::<f64>());
        }
        let elements: f64 = (0..mesh.loops.len()).filter(|&index| holds(index)).map(|index| mesh.area[index]).sum();
        menisci.iter().try_fold(elements, |area, it| Some(area + it.swept?))
    }

    /// The exact boundary of an element in m, pore on the right.
    pub(crate) fn boundary(&self, element: usize) -> Vec<Curve> {
        let part = &self.mesh.loops[element];
        let apart = part.apart.iter().map(|crossing| Curve::Segment { a: crossing.from, b: crossing.to });
        part.curves().into_iter().chain(apart).filter(|curve| curve.length() > 0.0).collect()
    }
}
