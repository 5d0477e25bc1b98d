//! Particle positions at time zero.

use super::walls::coordinates_of_sides;
use crate::case::Side;
use crate::geometry::Geometry;
use crate::geometry::offset_curves::UnfittedSurface;
use crate::math::Vec2;
use crate::sph::domain::Domain;
use crate::sph::fill::{self, Interface, Lattice, Positions, Region, Room};
use crate::sph::method::Method;
use crate::sph::packing::Packing;

/// The domain to fill with particles.
pub(super) struct Filling<'a> {
    /// The pore.
    pub(crate) geometry: &'a Geometry,
    /// Box and sides.
    pub(crate) domain: &'a Domain,
    /// The lattice.
    pub(crate) lattice: &'a Lattice,
    /// Constants of the method.
    pub(crate) method: &'a Method,
    /// The left, right, bottom and top side.
    pub(crate) sides: [Side; 4],
    /// Whether wall particles follow walls that are not aligned with the lattice.
    pub(crate) fitted_walls: bool,
}

/// The particle positions: aligned with walls and, with a `region` filled by one phase, with its interface, where these are not aligned with the
/// lattice, and then packed. Reports the completed fraction of the packing to `done`; without it nothing is packed.
pub(super) fn positions(filling: &Filling, region: Option<&Region>, done: Option<&mut dyn FnMut(f64)>) -> Positions {
    let &Filling { geometry, domain, lattice, method, sides, fitted_walls } = filling;
    let support = method.kernel.support();
    let signed_distance = |x| geometry.signed_distance(x);
    let walls = sides.map(|side| side == Side::Wall);
    let unfitted = UnfittedSurface::new(geometry, support, |a, b| lattice.fits(a, b));
    let follows_walls = fitted_walls && !unfitted.is_empty();
    let mut positions = if follows_walls {
        let pore_area = geometry.porosity().value * geometry.bounds().area();
        fill::along_walls(&Room { lattice, domain, support, walls }, &unfitted, signed_distance, pore_area)
    } else {
        fill::on_lattice(lattice, support, walls, signed_distance)
    };
    let interface = region.map(|region| Interface::new(region, geometry, lattice));
    let layers =
        interface.as_ref().map(|interface| interface.make_room(lattice, domain, &mut positions)).unwrap_or_default();
    if let Some(done) = done.filter(|_| follows_walls || !layers.is_empty()) {
        let open = sides.map(|side| matches!(side, Side::Inlet | Side::Outlet));
        let closed = coordinates_of_sides(domain.bounds).into_iter().zip(sides);
        let closed = closed.filter(|(_, side)| !matches!(side, Side::Wall | Side::Periodic)).map(|(at, _)| at);
        let beyond: Vec<Vec2> = lattice.beyond(support, walls, open).collect();
        let packing = Packing {
            fixed: &[&positions.walls[..], &layers, &beyond].concat(),
            domain,
            kernel: &method.kernel,
            spacing: method.spacing,
            volume: method.volume,
            pore: geometry,
            interface: interface.as_ref().filter(|_| !layers.is_empty()).map(Interface::surface),
            sides: &closed.collect::<Vec<_>>(),
        };
        packing.pack(&mut positions.fluid, done);
    }
    positions.fluid.extend(layers);
    positions
}
