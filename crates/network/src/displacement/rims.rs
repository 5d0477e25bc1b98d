//! Boundaries of elements with their kinds, and what has changed in them, for a displacement to play.

use super::loops::{Crossing, GateId, Loop};
use super::progress::Displacement;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::Curve;

/// A passage between two elements, a gate or a throat dissolved in a pore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Joint {
    /// The elements on both sides.
    pub(crate) elements: [usize; 2],
    /// Both ends of its chord in m.
    pub(crate) ends: [Vec2; 2],
    /// The throat of the network, if it is one.
    pub(crate) throat: Option<usize>,
}

/// A curve of a boundary, with its number among the pieces of wall and the shape of it, if it is one.
pub(crate) type RimCurve = (Curve, Option<(usize, u32)>);

impl Displacement {
    /// The boundary of an element; `None` if it does not close, as around a periodic domain.
    pub(crate) fn rim(&self, element: usize) -> Option<Vec<RimCurve>> {
        let part = &self.mesh.loops[element];
        if part.has_seam || !part.apart.is_empty() {
            return None;
        }
        let (mut rim, mut pieces) = (Vec::new(), 0..);
        for (k, wall) in part.walls.iter().enumerate() {
            rim.extend(wall.iter().zip(&mut pieces).map(|(piece, number)| (piece.curve, Some((number, piece.shape)))));
            rim.extend(part.crossings.get(k).map(|it| (Curve::Segment { a: it.from, b: it.to }, None)));
        }
        rim.retain(|(curve, _)| curve.length() > 0.0);
        Some(rim)
    }

    /// All passages between elements.
    pub(crate) fn joints(&self) -> Vec<Joint> {
        let mesh = &self.mesh;
        let of_loop = |(index, part): (usize, &Loop)| {
            let joint = |(slot, crossing): (usize, &Crossing)| {
                let (other, twin, _) = mesh.twin(index, slot)?;
                // Each once.
                if (other, twin) < (index, slot) {
                    return None;
                }
                let throat = match crossing.gate {
                    GateId::Throat(throat, _) => Some(throat as usize),
                    _ => None,
                };
                Some(Joint { elements: [index, other], ends: [crossing.from, crossing.to], throat })
            };
            part.crossings.iter().enumerate().filter_map(joint).collect::<Vec<_>>()
        };
        mesh.loops.iter().enumerate().flat_map(of_loop).collect()
    }

    /// From now on [`Self::take_changed`] tells what changes.
    pub(crate) fn watch_changes(&mut self) {
        self.connection.changed = Some(Vec::new());
    }

    /// The elements whose phase, connection or rings have changed since the last call, in order.
    pub(crate) fn take_changed(&mut self) -> Vec<usize> {
        let nodes = self.connection.changed.as_mut().map(std::mem::take).unwrap_or_default();
        let count = self.mesh.elements.len();
        let at_ring = |ring: usize| self.rings.iter().flat_map(move |rings| rings.elements[ring].iter().copied());
        let elements = nodes.into_iter().flat_map(|node| {
            let (element, ring) = (Some(node).filter(|_| node < count), node.checked_sub(count));
            element.into_iter().chain(ring.into_iter().flat_map(at_ring))
        });
        let mut loops: Vec<usize> = elements.flat_map(|it| self.mesh.elements[it].loops.iter().copied()).collect();
        loops.sort_unstable();
        loops.dedup();
        loops
    }

    /// The elements trapped since the last call.
    pub(crate) fn take_lost(&mut self) -> Vec<usize> {
        let lost = std::mem::take(&mut self.lost);
        lost.iter().flat_map(|&element| &self.mesh.elements[element].loops).copied().collect()
    }
}
