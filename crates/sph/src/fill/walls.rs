//! Fills the pore along walls that are not aligned with the lattice.

use super::kept::{CLOSEST, EQUAL, SAMPLING, apart, deepest};
use super::lattice::{Lattice, each_with};
use super::positions::Positions;
use crate::domain::Domain;
use meniscus_core::math::Vec2;
use meniscus_geometry::offset_curves::UnfittedSurface;

/// Lattice points farther than this from a wall, in spacings, are certainly fluid or certainly not.
const DOUBTFUL: f64 = 0.5;

/// Fills the domain with wall particles in layers at depths of half a spacing, one and a half, ... below the unfitted walls, evenly spaced
/// along each layer, so that each has the volume of the lattice; all else as in [`super::on_lattice`].
///
/// The number of fluid particles follows from `pore_area` (m²). They are still on the lattice, to be packed next.
pub(crate) fn along_walls(
    lattice: &Lattice,
    domain: &Domain,
    support: f64,
    walls: [bool; 4],
    unfitted: &UnfittedSurface,
    signed_distance: impl Fn(Vec2) -> f64 + Sync,
    pore_area: f64,
) -> Positions {
    let spacing = lattice.step.product().sqrt();
    let mut positions = Positions::default();
    let mut doubtful: Vec<(f64, Vec2)> = Vec::new();
    for (x, (d, own)) in each_with(lattice.points(support, walls), |x| (signed_distance(x), unfitted.own(x))) {
        if own && d.abs() < DOUBTFUL * spacing && lattice.contains(x) {
            doubtful.push((d, x));
        } else if d > 0.0 && lattice.contains(x) {
            positions.fluid.push(x);
        } else if d <= 0.0 && d > -support && !own {
            positions.push_wall(x, -d);
        }
    }
    let wanted = (pore_area / (spacing * spacing)).round() as usize;
    positions.fluid.extend(deepest(doubtful, wanted.saturating_sub(positions.fluid.len()), EQUAL * spacing));
    let extent = lattice.extent(support, walls);
    let mut depth = 0.5 * spacing;
    while depth < support {
        let lines = unfitted.offset_curves(depth, SAMPLING * spacing, |x| extent.contains(x));
        lines.iter().flat_map(|line| line.every(spacing)).for_each(|x| positions.push_wall(x, depth));
        depth += spacing;
    }
    let kept = apart(&positions.walls, domain, CLOSEST * spacing);
    positions.walls = kept.iter().map(|a| positions.walls[*a]).collect();
    positions.depth = kept.iter().map(|a| positions.depth[*a]).collect();
    positions
}
