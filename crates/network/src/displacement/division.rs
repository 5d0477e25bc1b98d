//! The division of the pore space into elements.

use std::sync::Arc;

use super::conditions::OpenDisc;
use super::mesh::Mesh;
use super::outline::outline;
use crate::graph::{Network, Pores};
use meniscus_case::network::Events;
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::Outlines;

/// A part of the pore space between walls and gates.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// The region that it is part of.
    pub region: usize,
    /// Area in m².
    pub area: f64,
}

/// The division of the pore space into elements, independent of contact angles.
#[derive(Debug, Clone, Default)]
pub(crate) struct Division {
    pub(super) mesh: Arc<Mesh>,
    pub(super) elements: Arc<Vec<Element>>,
    pub(super) centers: Arc<Vec<Vec2>>,
}

impl Division {
    /// The division of a network for these types of events.
    pub(crate) fn of(network: &Network, pores: &Pores, events: Events) -> Self {
        let mesh = match events {
            Events::All => Mesh::divided(network),
            Events::Burst => Mesh::of_pores(network, pores),
        };
        let centers = Arc::new(network.regions.iter().map(|region| region.center).collect());
        let elements = mesh.region_of.iter().zip(&mesh.area).map(|(&region, &area)| Element { region, area });
        let elements = Arc::new(elements.collect());
        Self { mesh: Arc::new(mesh), elements, centers }
    }

    /// The elements; they tile the pore space.
    pub(crate) fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// The boundary of an element in m, arcs as chords; the last point is not repeated.
    pub(crate) fn outline(&self, element: usize) -> Vec<Vec2> {
        outline(&self.mesh.loops[element])
    }

    /// The boundaries of all elements, made when they are needed.
    pub(crate) fn outlines(&self) -> Outlines {
        Outlines(Arc::clone(&self.mesh) as _)
    }

    /// The elements of which a disc covers a part, in order.
    pub(super) fn under(&self, disc: &OpenDisc) -> Vec<usize> {
        let mut under: Vec<usize> = (0..self.elements.len())
            .filter(|&index| disc.covers(&self.outline(index)))
            .map(|index| self.mesh.element_of[index])
            .collect();
        under.sort_unstable();
        under.dedup();
        under
    }

    /// The regions of which a disc covers a part, in order.
    pub(crate) fn regions_under(&self, disc: &OpenDisc) -> Vec<usize> {
        let covered = (0..self.elements.len()).filter(|&index| disc.covers(&self.outline(index)));
        let mut regions: Vec<usize> = covered.map(|index| self.mesh.region_of[index]).collect();
        regions.sort_unstable();
        regions.dedup();
        regions
    }
}
