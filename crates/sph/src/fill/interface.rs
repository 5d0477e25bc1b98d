//! Fills both sides of an interface that is not aligned with the lattice: one layer of particles on each side of it, and the number of particles
//! in each phase given by its area.

use super::kept::{CLOSEST, EQUAL, SAMPLING, apart, deepest};
use super::lattice::{Lattice, each_with};
use super::positions::Positions;
use super::region::Region;
use crate::domain::Domain;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::offset_curves::UnfittedSurface;
use meniscus_geometry::{Geometry, Wall};

/// Lattice points farther from the interface than this, in spacings, are always kept.
const DOUBTFUL: f64 = 3.0;

/// The initial interface between two phases in a pore.
pub(crate) struct Interface<'a> {
    region: &'a Region,
    pore: &'a Geometry,
    /// The parts of the outline of the region that are interface.
    pub(crate) surface: UnfittedSurface<'a>,
}

impl<'a> Interface<'a> {
    /// The interface around a `region` filled with one phase in a `pore`.
    pub(crate) fn new(region: &'a Region, pore: &'a Geometry, lattice: &'a Lattice) -> Self {
        let spacing = lattice.volume().sqrt();
        let surface = UnfittedSurface::new(&region.surface, 0.0, |a, b| lattice.fits(a, b))
            .restricted(move |closest, normal| is_interface(closest, normal, pore, spacing));
        Self { region, pore, surface }
    }

    /// Makes room in `positions` for layers beside the interface, and returns these: particles half a spacing from it on both sides, evenly spaced along
    /// it. Of the other fluid particles on each side those farthest from the interface are kept, as many as the area allows besides the layer.
    ///
    /// Where the interface is aligned with the lattice, or a phase is too small for a layer, `positions` is unchanged and there are no layers.
    pub(crate) fn make_room(&self, lattice: &Lattice, domain: &Domain, positions: &mut Positions) -> Vec<Vec2> {
        if self.surface.is_empty() {
            return Vec::new();
        }
        let spacing = lattice.volume().sqrt();
        let [inner, outer] = [0.5, -0.5].map(|depth| self.layer(depth * spacing, lattice, domain));
        let within = (self.region.area.unwrap_or_else(|| self.area(lattice)) / lattice.volume()).round() as usize;
        let core = within.checked_sub(inner.len());
        let rest = positions.fluid.len().checked_sub(within + outer.len());
        let (Some(core), Some(rest), false) = (core, rest, inner.is_empty() || outer.is_empty()) else {
            return Vec::new();
        };
        let far = |x: Vec2| match self.surface.near(x, DOUBTFUL * spacing) {
            Some(near) if near.is_unfitted => near.distance.abs(),
            Some(_) => f64::INFINITY,
            None => self.region.signed_distance(x).abs().max(DOUBTFUL * spacing),
        };
        let found = each_with(positions.fluid.drain(..), |x| (far(x), self.region.contains(x)));
        let (mut inside, mut outside) = (Vec::new(), Vec::new());
        for (x, (far, is_inside)) in found {
            if is_inside { &mut inside } else { &mut outside }.push((far, x));
        }
        let farthest = |points, count| deepest(points, count, EQUAL * spacing);
        positions.fluid = [farthest(inside, core), farthest(outside, rest)].concat();
        [inner, outer].concat()
    }

    /// The particles at `depth` (m) within the region.
    fn layer(&self, depth: f64, lattice: &Lattice, domain: &Domain) -> Vec<Vec2> {
        let spacing = lattice.volume().sqrt();
        // A layer that meets a wall ends where its last particle, half a spacing along the layer from its end, is half a spacing from the wall.
        let is_in_pore = |x: Vec2| {
            let has_room = || {
                let wall = self.pore.wall(x);
                let across = wall.normal.dot(&self.region.wall(x).normal);
                let along = (1.0 - across * across).max(0.0).sqrt();
                wall.distance > 0.5 * spacing * (1.0 - along)
            };
            lattice.contains(x) && has_room()
        };
        let lines = self.surface.offset_curves(depth, SAMPLING * spacing, is_in_pore);
        let points: Vec<Vec2> = lines.iter().flat_map(|line| line.every(spacing)).collect();
        apart(&points, domain, CLOSEST * spacing).into_iter().map(|a| points[a]).collect()
    }

    /// Area in m² of the region within the pore.
    fn area(&self, lattice: &Lattice) -> f64 {
        /// Subdivisions of a cut cell along each side.
        const PARTS: usize = 4;
        let share = |x: Vec2| {
            let distances = [self.region.signed_distance(x), self.pore.signed_distance(x)];
            let is_cut = distances.iter().any(|distance| distance.abs() < lattice.step.norm());
            let parts = if is_cut { PARTS } else { 1 };
            let size = lattice.step / parts as f64;
            let middle = |k: usize| (k as f64 + 0.5) - 0.5 * parts as f64;
            let middles =
                (0..parts * parts).map(|k| Vec2::new(middle(k % parts), middle(k / parts)).component_mul(&size));
            let shares =
                middles.map(|by| (1.0 - above(self.region.wall(x + by), size)) * above(self.pore.wall(x + by), size));
            shares.sum::<f64>() / (parts * parts) as f64
        };
        each_with(lattice.points(0.0, [false; 4]), share).map(|(_, share)| share).sum::<f64>() * lattice.volume()
    }
}

/// Whether a point of the outline of a region is on the interface: not deep in a wall or outside the box, and not on a part of the outline along
/// a wall or a side of the box, as for a rectangle that spans from wall to wall.
fn is_interface(closest: Vec2, normal: Vec2, pore: &Geometry, spacing: f64) -> bool {
    let lies_along = |distance: f64, wall: Vec2| {
        /// Cosine of the angle between two surfaces that count as parallel.
        const ALONG: f64 = 0.99;
        distance < -spacing || (distance.abs() < 0.5 * spacing && normal.dot(&wall).abs() > ALONG)
    };
    let Bounds { min, max } = pore.bounds();
    let wall = pore.wall(closest);
    let lies_along_a_side = [Vec2::x(), Vec2::y()].into_iter().enumerate().any(|(axis, across)| {
        lies_along(closest[axis] - min[axis], across) || lies_along(max[axis] - closest[axis], across)
    });
    !lies_along(wall.distance, wall.normal) && !lies_along_a_side
}

/// Fraction of a cell of `size` (m) on the positive side of a surface, straight within the cell; `wall` is the surface's distance and normal at
/// the center of the cell. Exact where the surface is parallel to an axis or halves the cell.
fn above(wall: Wall, size: Vec2) -> f64 {
    let width = wall.normal.abs().dot(&size);
    if width > 0.0 { (0.5 + wall.distance / width).clamp(0.0, 1.0) } else { f64::from(wall.distance > 0.0) }
}
