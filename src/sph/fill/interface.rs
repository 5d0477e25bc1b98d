//! Fills both sides of an interface that no lattice fits: a layer of particles on either side of it, and as many in each phase as it has room for.

use super::{CLOSEST, EQUAL, Lattice, Places, SAMPLING, apart, deepest};
use crate::geometry::Geometry;
use crate::geometry::shells::FreeSurface;
use crate::math::Vec2;
use crate::sph::domain::Domain;

/// The initial interface between two phases in a pore.
pub struct Interface<'a> {
    /// What its shapes enclose, as a solid: negative distance within.
    pub region: &'a Geometry,
    /// The pore that both phases fill.
    pub pore: &'a Geometry,
}

impl Interface<'_> {
    /// Takes the fluid particles next to the interface out of `places`, so that as many are left on each side as its area has room for
    /// beside the layers, and returns these: particles half a spacing from the interface on both sides, evenly along it.
    ///
    /// Nothing is changed, and there are no layers, where the lattice fits the interface, and where a phase is too small for one.
    pub fn layers(&self, (lattice, domain): (&Lattice, &Domain), places: &mut Places) -> Vec<Vec2> {
        let free = FreeSurface::new(self.region, 0.0, |a, b| lattice.fits(a, b));
        if free.is_empty() {
            return Vec::new();
        }
        let spacing = lattice.volume().sqrt();
        let [inner, outer] = [0.5, -0.5].map(|depth| self.layer(&free, depth * spacing, (lattice, domain)));
        let within = (self.area(lattice) / lattice.volume()).round() as usize;
        let core = within.checked_sub(inner.len());
        let rest = places.fluid.len().checked_sub(within + outer.len());
        let (Some(core), Some(rest), false) = (core, rest, inner.is_empty() || outer.is_empty()) else {
            return Vec::new();
        };
        let far = |x: Vec2| if free.own(x) { self.region.signed_distance(x).abs() } else { f64::INFINITY };
        let (inside, outside): (Vec<Vec2>, Vec<Vec2>) =
            places.fluid.iter().partition(|x| self.region.signed_distance(**x) < 0.0);
        let farthest = |points: Vec<Vec2>, count| {
            deepest(points.into_iter().map(|x| (far(x), x)).collect(), count, EQUAL * spacing)
        };
        places.fluid = [farthest(inside, core), farthest(outside, rest)].concat();
        [inner, outer].concat()
    }

    /// The particles at `depth` (m) within the shapes.
    fn layer(&self, free: &FreeSurface, depth: f64, (lattice, domain): (&Lattice, &Domain)) -> Vec<Vec2> {
        let spacing = lattice.volume().sqrt();
        // A line that meets a wall ends where its last particle, half a spacing along the line from its end, has half a spacing of room.
        let is_in_pore = |x: Vec2| {
            let wall = self.pore.wall(x);
            let across = wall.normal.dot(&self.region.wall(x).normal);
            let along = (1.0 - across * across).max(0.0).sqrt();
            lattice.holds(x) && wall.distance > 0.5 * spacing * (1.0 - along)
        };
        let lines = free.shells(depth, SAMPLING * spacing, is_in_pore);
        let mut points: Vec<Vec2> = lines.iter().flat_map(|line| line.every(spacing)).collect();
        let mut kept = apart(&points, domain, CLOSEST * spacing).into_iter();
        points.retain(|_| kept.next().unwrap_or(true));
        points
    }

    /// The part of the pore in m² that the shapes take.
    fn area(&self, lattice: &Lattice) -> f64 {
        /// Parts of a cell along each side, where it is cut.
        const PARTS: usize = 4;
        let share = |x: Vec2| {
            let is_cut = [self.region, self.pore].iter().any(|of| of.signed_distance(x).abs() < lattice.step.norm());
            let parts = if is_cut { PARTS } else { 1 };
            let size = lattice.step / parts as f64;
            let middle = |k: usize| (k as f64 + 0.5) - 0.5 * parts as f64;
            let middles =
                (0..parts * parts).map(|k| Vec2::new(middle(k % parts), middle(k / parts)).component_mul(&size));
            let shares = middles.map(|by| (1.0 - above(self.region, x + by, size)) * above(self.pore, x + by, size));
            shares.sum::<f64>() / (parts * parts) as f64
        };
        lattice.points(0.0, [false; 4]).map(share).sum::<f64>() * lattice.volume()
    }
}

/// The share of a cell of `size` around `x` (m) on the positive side of a surface, which is straight within it: exact where the surface lies along an
/// axis or halves the cell.
fn above(surface: &Geometry, x: Vec2, size: Vec2) -> f64 {
    let wall = surface.wall(x);
    let width = wall.normal.abs().dot(&size);
    if width > 0.0 { (0.5 + wall.distance / width).clamp(0.0, 1.0) } else { f64::from(wall.distance > 0.0) }
}
