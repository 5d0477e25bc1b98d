//! Particles at time zero.

use super::error::SetupError;
use super::ground::{Ground, start_phase};
use super::walls::coordinates_of_sides;
use crate::fill::{self, Interface, Region};
use crate::packing::Packing;
use crate::particles::Particles;
use meniscus_case::{Side, Sph};
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::offset_curves::UnfittedSurface;

/// The particles of pore and walls, and the depth in m of wall particles.
///
/// They are aligned with walls and with the interface of the `region` filled by one phase, where these are not aligned with the lattice, and then
/// packed if `is_packed`. Reports the completed fraction of the packing to `packed`.
pub(super) fn filled(
    sph: &Sph,
    geometry: &Geometry,
    ground: &Ground,
    region: &Region,
    is_packed: bool,
    packed: &mut dyn FnMut(f64),
) -> Result<(Particles, Vec<f64>), SetupError> {
    let Ground { lattice, method, domain } = ground;
    let (support, walls) = (method.kernel.support(), sph.sides.walls());
    let signed_distance = |x| geometry.signed_distance(x);
    let unfitted = UnfittedSurface::new(geometry, support, |a, b| lattice.fits(a, b));
    let follows_walls = sph.numerics.fitted_walls && !unfitted.is_empty();
    let mut positions = if follows_walls {
        let pore_area = geometry.porosity().value * geometry.bounds().area();
        fill::along_walls(lattice, domain, support, walls, &unfitted, signed_distance, pore_area)
    } else {
        fill::on_lattice(lattice, support, walls, signed_distance)
    };
    let follows_interface = sph.non_wetting.is_some() && sph.numerics.fitted_interface;
    let interface = follows_interface.then(|| Interface::new(region, geometry, lattice));
    let layers =
        interface.as_ref().map(|interface| interface.make_room(lattice, domain, &mut positions)).unwrap_or_default();
    if is_packed && (follows_walls || !layers.is_empty()) {
        let closed = coordinates_of_sides(domain.bounds).into_iter().zip(sph.sides.each());
        let closed = closed.filter(|(_, side)| !matches!(side, Side::Wall | Side::Periodic)).map(|(at, _)| at);
        let beyond: Vec<Vec2> = lattice.beyond(support, walls, sph.sides.open()).collect();
        let packing = Packing {
            fixed: &[&positions.walls[..], &layers, &beyond].concat(),
            domain,
            kernel: &method.kernel,
            spacing: method.spacing,
            volume: method.volume,
            pore: geometry,
            interface: interface.as_ref().filter(|_| !layers.is_empty()).map(|interface| &interface.surface),
            sides: &closed.collect::<Vec<_>>(),
        };
        packing.pack(&mut positions.fluid, packed);
    }
    positions.fluid.extend(layers);
    let particles = positions.particles(|x| start_phase(sph, region, x));
    if particles.fluids == 0 {
        return Err(SetupError::NoFluid(sph.spacing));
    }
    Ok((particles, positions.depth))
}
