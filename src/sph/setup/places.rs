//! Where particles stand at time zero.

use crate::geometry::Geometry;
use crate::geometry::shells::FreeSurface;
use crate::math::Vec2;
use crate::sph::domain::Domain;
use crate::sph::fill::{self, Interface, Lattice, Places};
use crate::sph::method::Method;
use crate::sph::packing::{Packing, Surface};

/// Where the particles stand: along walls and, with a `region` that one phase fills, along its interface, where the lattice does not fit these, and packed to
/// them.
pub(super) fn places(
    (geometry, domain): (&Geometry, &Domain),
    region: Option<&Geometry>,
    lattice: &Lattice,
    (method, fitted_walls): (&Method, bool),
    walls: [bool; 4],
) -> Places {
    let support = method.kernel.support();
    let signed_distance = |x| geometry.signed_distance(x);
    let free = FreeSurface::new(geometry, support, |a, b| lattice.fits(a, b));
    let follows_walls = fitted_walls && !free.is_empty();
    let mut places = if follows_walls {
        let pore_area = geometry.porosity().value * geometry.bounds().area();
        fill::along_walls((lattice, domain), (support, walls), &free, signed_distance, pore_area)
    } else {
        fill::on_lattice(lattice, support, walls, signed_distance)
    };
    let interface = region.map(|region| Interface { region, pore: geometry });
    let layers = interface.map(|interface| interface.layers((lattice, domain), &mut places)).unwrap_or_default();
    if follows_walls || !layers.is_empty() {
        let fixed = [&places.walls[..], &layers].concat();
        let interface = region.filter(|_| !layers.is_empty()).map(surface);
        let packing = Packing {
            fixed: &fixed,
            domain,
            kernel: &method.kernel,
            spacing: method.spacing,
            volume: method.volume,
            wall: &surface(geometry),
            interface: interface.as_ref().map(|interface| interface as Surface),
        };
        packing.pack(&mut places.fluid);
    }
    places.fluid.extend(layers);
    places
}

/// Distance from the surface of a geometry, and its normal.
fn surface(of: &Geometry) -> impl Fn(Vec2) -> (f64, Vec2) + Sync {
    move |x| {
        let wall = of.wall(x);
        (wall.distance, wall.normal)
    }
}
