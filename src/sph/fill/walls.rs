//! Fills the pore along walls that are not aligned with the lattice.

use super::kept::{CLOSEST, EQUAL, SAMPLING, apart, deepest};
use super::lattice::{Lattice, each_with};
use super::places::Places;
use crate::geometry::offset_curves::UnfittedSurface;
use crate::math::Vec2;
use crate::sph::domain::Domain;

/// Lattice points farther than this from a wall, in spacings, are certainly fluid or certainly not.
const DOUBTFUL: f64 = 0.5;

/// The domain to fill with particles.
pub(crate) struct Room<'a> {
    /// The lattice.
    pub(crate) lattice: &'a Lattice,
    /// Box and sides.
    pub(crate) domain: &'a Domain,
    /// Support of the kernel in m, the thickness of the walls.
    pub(crate) support: f64,
    /// Whether the left, right, bottom and top side is a wall of particles.
    pub(crate) walls: [bool; 4],
}

/// Fills the domain with wall particles in layers at depths of half a spacing, one and a half, ... below the unfitted walls, evenly spaced
/// along each layer, so that each has the volume of the lattice; all else as in [`super::on_lattice`].
///
/// The number of fluid particles follows from `pore_area` (m²). They are still on the lattice, to be packed next.
pub(crate) fn along_walls(
    room: &Room,
    unfitted: &UnfittedSurface,
    signed_distance: impl Fn(Vec2) -> f64 + Sync,
    pore_area: f64,
) -> Places {
    let &Room { lattice, domain, support, walls } = room;
    let spacing = lattice.step.product().sqrt();
    let mut places = Places::default();
    let mut doubtful: Vec<(f64, Vec2)> = Vec::new();
    for (x, (d, own)) in each_with(lattice.points(support, walls), |x| (signed_distance(x), unfitted.own(x))) {
        if own && d.abs() < DOUBTFUL * spacing && lattice.holds(x) {
            doubtful.push((d, x));
        } else if d > 0.0 && lattice.holds(x) {
            places.fluid.push(x);
        } else if d <= 0.0 && d > -support && !own {
            places.push_wall(x, -d);
        }
    }
    let wanted = (pore_area / (spacing * spacing)).round() as usize;
    places.fluid.extend(deepest(doubtful, wanted.saturating_sub(places.fluid.len()), EQUAL * spacing));
    let extent = lattice.extent(support, walls);
    let mut depth = 0.5 * spacing;
    while depth < support {
        let lines = unfitted.offset_curves(depth, SAMPLING * spacing, |x| extent.contains(x));
        lines.iter().flat_map(|line| line.every(spacing)).for_each(|x| places.push_wall(x, depth));
        depth += spacing;
    }
    let kept = apart(&places.walls, domain, CLOSEST * spacing);
    places.walls = kept.iter().map(|a| places.walls[*a]).collect();
    places.depth = kept.iter().map(|a| places.depth[*a]).collect();
    places
}
