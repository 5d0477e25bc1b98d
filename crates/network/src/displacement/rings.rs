//! Rings: the corner films of a chip along a closed wall, that of a post or of a side, at floor and lid.
//!
//! A ring passes all elements at its wall, whatever phase fills them, and meets the wetting phase in those that this fills, and at the open sides that its wall
//! reaches. Films of different rings touch only in a throat: where the wetting phase fills it, as after
//! snap-off, or where the films of both meet at the present pressure. So the paths of the wetting phase are those in a graph of elements and rings.

use super::loops::GateId;
use super::mesh::Mesh;
use meniscus_core::math::root;

/// The rings of a mesh.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Rings {
    /// For each loop the ring of each of its pieces of wall in order; `None` without a film.
    pub(crate) of_piece: Vec<Vec<Option<u32>>>,
    /// The rings at the walls of each element.
    pub(super) of_element: Vec<Vec<u32>>,
    /// The elements at the wall of each ring.
    pub(super) elements: Vec<Vec<usize>>,
    /// The rings at both ends of each gate.
    pub(super) of_gate: Vec<[Option<u32>; 2]>,
    /// The gates that begin or end at each ring and join it to another one where they are bridged.
    pub(super) gates: Vec<Vec<usize>>,
    /// The open sides that the wall of each ring reaches: left, right, bottom, top.
    pub(super) open: Vec<[bool; 4]>,
}

/// The films at both ends of a stretch of wall, as nodes of the forest of films.
type Ends = [Option<usize>; 2];

impl Rings {
    /// The rings of a mesh; `has_films` tells for each written shape and side whether its corners hold a film.
    pub(super) fn of(mesh: &Mesh, has_films: &[bool]) -> Self {
        let mut parent: Vec<usize> = Vec::new();
        let mut new_node = || {
            parent.push(parent.len());
            parent.len() - 1
        };
        let (mut of_piece, mut ends) = (Vec::new(), Vec::new());
        for part in &mesh.loops {
            let (mut pieces, mut of_stretch): (Vec<Option<usize>>, Vec<Ends>) = (Vec::new(), Vec::new());
            for wall in &part.walls {
                // A stretch without pieces is a point of a wall.
                let mut found: Ends = if wall.is_empty() { [Some(new_node()); 2] } else { [None; 2] };
                let mut before = None;
                for (k, piece) in wall.iter().enumerate() {
                    let has_film = has_films.get(piece.shape as usize).copied().unwrap_or(false);
                    before = if has_film { before.or_else(|| Some(new_node())) } else { None };
                    pieces.push(before);
                    if k == 0 {
                        found[0] = before;
                    }
                    found[1] = before;
                }
                of_stretch.push(found);
            }
            of_piece.push(pieces);
            ends.push(of_stretch);
        }
        let mut join = |one: Option<usize>, other: Option<usize>| {
            if let (Some(one), Some(other)) = (one, other) {
                let [one, other] = [root(&mut parent, one), root(&mut parent, other)];
                parent[one.max(other)] = one.min(other);
            }
        };
        for (index, part) in mesh.loops.iter().enumerate() {
            for k in 0..part.crossings.len() {
                let Some((beyond, twin, _)) = mesh.twin(index, k) else { continue };
                // The wall before a chord continues after it on the other side.
                let next = (twin + 1) % mesh.loops[beyond].walls.len();
                join(ends[index][k][1], ends[beyond][next][0]);
            }
            if part.crossings.is_empty() {
                join(ends[index][0][1], ends[index][0][0]);
            }
        }
        let mut number = vec![None; parent.len()];
        let mut count = 0;
        let mut ring = |node: Option<usize>| {
            node.map(|node| {
                *number[root(&mut parent, node)].get_or_insert_with(|| {
                    count += 1;
                    count - 1
                })
            })
        };
        let of_piece: Vec<Vec<Option<u32>>> =
            of_piece.into_iter().map(|pieces| pieces.into_iter().map(&mut ring).collect()).collect();
        let of_gate: Vec<[Option<u32>; 2]> = (mesh.gates.iter())
            .map(|gate| {
                let (index, slot) = gate.crossings[0];
                let next = (slot + 1) % mesh.loops[index].walls.len();
                [ends[index][slot][1], ends[index][next][0]].map(&mut ring)
            })
            .collect();
        let mut reached = Vec::new();
        for (index, part) in mesh.loops.iter().enumerate() {
            for (k, crossing) in part.crossings.iter().enumerate() {
                let GateId::Opening(opening) = crossing.gate else { continue };
                let next = (k + 1) % part.walls.len();
                let beside = [ends[index][k][1], ends[index][next][0]].map(&mut ring);
                reached.extend(
                    beside.into_iter().flatten().map(|ring| (ring as usize, mesh.side_of_opening[opening as usize])),
                );
            }
        }
        let mut open = vec![[false; 4]; count as usize];
        reached.into_iter().for_each(|(ring, side)| open[ring][side] = true);
        Self::collected(mesh, of_piece, of_gate, open)
    }

    fn collected(
        mesh: &Mesh,
        of_piece: Vec<Vec<Option<u32>>>,
        of_gate: Vec<[Option<u32>; 2]>,
        open: Vec<[bool; 4]>,
    ) -> Self {
        let count = open.len();
        let mut of_element: Vec<Vec<u32>> = vec![Vec::new(); mesh.elements.len()];
        for (index, pieces) in of_piece.iter().enumerate() {
            of_element[mesh.element_of[index]].extend(pieces.iter().flatten());
        }
        let (mut elements, mut gates) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        for (element, rings) in of_element.iter_mut().enumerate() {
            rings.sort_unstable();
            rings.dedup();
            rings.iter().for_each(|&ring| elements[ring as usize].push(element));
        }
        for (gate, ends) in of_gate.iter().enumerate().filter(|(gate, _)| mesh.gates[*gate].throat.is_some()) {
            ends.iter().flatten().for_each(|&ring| gates[ring as usize].push(gate));
        }
        gates.iter_mut().for_each(Vec::dedup);
        Self { of_piece, of_element, elements, of_gate, gates, open }
    }

    /// Whether each ring reaches one of these sides.
    pub(super) fn reach(&self, sides: [bool; 4]) -> Vec<bool> {
        self.open.iter().map(|open| (0..4).any(|side| open[side] && sides[side])).collect()
    }

    /// Number of rings.
    pub(super) fn count(&self) -> usize {
        self.elements.len()
    }

    /// The rings that a bridged gate joins, if they differ.
    pub(super) fn joined_by(&self, gate: usize) -> Option<[usize; 2]> {
        match self.of_gate[gate] {
            [Some(one), Some(other)] if one != other => Some([one as usize, other as usize]),
            _ => None,
        }
    }

    /// The other ring of a gate.
    pub(super) fn across(&self, gate: usize, ring: usize) -> Option<usize> {
        self.joined_by(gate).map(|[one, other]| if one == ring { other } else { one })
    }
}

#[cfg(test)]
mod tests {
    use super::super::connected::Held;
    use super::super::trapping::Connection;
    use super::super::{Conditions, CornerFilms, Displacement, FilmPaths, Trapping};
    use crate::extract;
    use crate::graph::Pores;
    use meniscus_geometry::Geometry;
    use meniscus_geometry::spec::{Disc, GeometrySpec, ShapeSpec, SolidSide};

    /// Whether a pack is regular, with many events at a time.
    fn is_regular(seed: u64) -> bool {
        seed % 4 == 3
    }

    /// Discs of random radii on a lattice, of which some touch their neighbors.
    fn pack(seed: u64) -> Geometry {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1_u32 << 31)
        };
        let place = |k: u32| f64::from(k) + 0.5;
        let discs = (0..7_u32).flat_map(|i| (0..7_u32).map(move |j| (i, j)));
        let shapes = discs.map(|(i, j)| {
            let [x, y, r] = [0.15, 0.15, 0.25].map(|most| if is_regular(seed) { 0.0 } else { most * random() });
            ShapeSpec::Disc(Disc { center: [place(i) + x, place(j) + y], radius: 0.25 + r })
        });
        let spec = GeometrySpec { min: [0.0; 2], max: [7.0; 2], solid: SolidSide::Inside, shapes: shapes.collect() };
        Geometry::new(&spec).unwrap().with_sides([false; 2], [false, false, true, true])
    }

    /// What is connected after each event is what is found anew \[EvenShiloach1981\].
    #[test]
    fn what_reaches_an_outlet_after_each_event_is_what_is_found_anew() {
        let (mut trapped, mut along_rings) = (0, 0);
        for seed in 0..12 {
            let geometry = pack(seed);
            let network = extract(&geometry, [true, true, false, false]).unwrap();
            let pores = Pores::merged(&network, 0.95);
            let walls = geometry.shape_count() as usize + 4;
            let meeting: Vec<f64> = network.throats.iter().map(|throat| 0.8 / throat.width).collect();
            let paths = |sign: f64| FilmPaths {
                meeting: meeting.iter().map(|meeting| sign * meeting).collect(),
                rings: Some((0..walls).map(|wall| !(wall as u64 + seed).is_multiple_of(5)).collect()),
            };
            let conditions = |films: CornerFilms, [inlet, outlet]: [usize; 2], angle: f64| Conditions {
                inlet: [0, 1, 2, 3].map(|side| side == inlet),
                outlet: [0, 1, 2, 3].map(|side| side == outlet),
                trapping: Trapping::Disconnected,
                films,
                ..Conditions::new(vec![angle; walls])
            };
            let is_same = |state: &mut Displacement| {
                let mesh = state.mesh.clone();
                let opens = |sides: [bool; 4]| -> Vec<bool> {
                    mesh.elements.iter().map(|element| (0..4).any(|side| element.open[side] && sides[side])).collect()
                };
                let (inlets, outlets) = (opens(state.conditions.inlet), opens(state.conditions.outlet));
                let given = state.conditions.clone();
                let (held, connection) = state.held(&mesh);
                let Held { invaded, .. } = held;
                let found = Connection::begin(&given, held, [&inlets, &outlets]).0;
                assert_eq!(connection.trapped, found.trapped);
                for element in (0..invaded.len()).filter(|&element| invaded[element]) {
                    assert_eq!(connection.is_joined(element), found.is_joined(element), "element {element}");
                }
            };
            let drain = conditions(CornerFilms::Drain(paths(1.0)), [0, 1], 0.3);
            let mut state = Displacement::new(&network, &pores, drain);
            is_same(&mut state);
            while state.next().is_some() {
                if state.tied.is_empty() {
                    is_same(&mut state);
                }
            }
            let without = conditions(CornerFilms::Absent, [0, 1], 0.3);
            let mut plain = Displacement::new(&network, &pores, without);
            while plain.next().is_some() {
                if plain.tied.is_empty() {
                    is_same(&mut plain);
                }
            }
            let count = |state: &Displacement| (0..state.elements().len()).filter(|&e| state.is_trapped(e)).count();
            trapped += count(&state);
            along_rings += count(&plain);
            if is_regular(seed) {
                // What films cut off at an outlet element is beside it when the invading phase fills that.
                continue;
            }
            let angle = std::f64::consts::PI - 0.3;
            let mut back = state.reverse(conditions(CornerFilms::Join(paths(-1.0)), [1, 0], angle));
            is_same(&mut back);
            while back.next().is_some() {
                if back.tied.is_empty() {
                    is_same(&mut back);
                }
            }
        }
        // Rings drain a part of what is trapped without films.
        assert!(trapped > 0 && along_rings > trapped, "{trapped} {along_rings}");
    }
}
