//! Construction of a solver from a checked case and its geometry.

mod depth_notes;
mod error;
mod from_network_state;
mod frozen;
mod ground;
mod initial;
mod method;
mod open_sides;
mod positions;
mod surroundings;
mod to_network_state;
mod viscous_time;
mod walls;

use std::sync::Arc;

pub use depth_notes::notes as notes_on_depth;
pub use error::SetupError;
pub use initial::region;

use self::frozen::Pore;
use self::ground::{Ground, start_phase};
use self::open_sides::{inside_of_open_sides, open_sides};
use self::positions::filled;
use self::surroundings::surroundings;
use self::viscous_time::viscous_time;
use self::walls::wall_properties;
use crate::configuration::Configuration;
use crate::domain::WallQuery;
use crate::fill::Region;
use crate::flow::Flow;
use crate::open::{self, Around};
use crate::solver::SphSolver;
use meniscus_case::{Case, Sph};
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;

/// The solids of a case for the solver: periodic sides joined, wall sides closed.
///
/// # Errors
/// [`SetupError::Geometry`] if the shapes are invalid.
pub fn geometry(case: &Case, sph: &Sph) -> Result<Geometry, SetupError> {
    Ok(Geometry::new(&case.geometry)?.with_sides(sph.sides.periodic(), sph.sides.walls()))
}

/// The solids of a case, after the checks that do not need particles: length of periods, and openings of open sides.
pub fn checked_geometry(case: &Case, sph: &Sph) -> Result<Geometry, SetupError> {
    let geometry = geometry(case, sph)?;
    let ground = Ground::new(&geometry, sph)?;
    let region = start_region(case, sph);
    open_sides(sph, &geometry, &ground.lattice, ground.method.kernel.h, &|x| start_phase(sph, &region, x))?;
    Ok(geometry)
}

/// The initial region, from shapes or from the state of a network.
fn start_region(case: &Case, sph: &Sph) -> Region {
    match &sph.initial.network {
        Some(start) => from_network_state::region(case, sph, start),
        // A frozen interface is periodic, as is its flow.
        None if sph.measure.relative_permeability => {
            Region::of_shapes(region(case, &sph.initial.wetting).with_periodic(sph.sides.periodic()))
        }
        None => Region::of_shapes(region(case, &sph.initial.wetting)),
    }
}

/// The solver of a case at time zero.
pub fn build(case: &Case, sph: &Sph) -> Result<SphSolver, SetupError> {
    solver(case, sph, true, &mut |_| {})
}

/// The solver of a case at time zero; reports the completed fraction of the packing, which takes most of the time, to `packed`. Only a solver to be
/// restored from a saved state, which has packed particles, need not be packed.
pub fn solver(case: &Case, sph: &Sph, is_packed: bool, packed: &mut dyn FnMut(f64)) -> Result<SphSolver, SetupError> {
    if sph.measure.relative_permeability {
        return beside_frozen_interface(case, sph, packed);
    }
    let geometry = Arc::new(geometry(case, sph)?);
    let bounds = geometry.bounds();
    let ground = Ground::new(&geometry, sph)?;
    let region = start_region(case, sph);
    let (mut particles, mut depth) = filled(sph, &geometry, &ground, &region, is_packed, packed)?;
    let Ground { lattice, method, domain } = ground;
    let phase = |x: Vec2| start_phase(sph, &region, x);
    let open = open_sides(sph, &geometry, &lattice, method.kernel.h, &phase)?;
    let inside = inside_of_open_sides(&open.sides);
    let around = Around {
        bounds,
        step: lattice.step,
        support: method.kernel.support(),
        walls: sph.sides.walls(),
        signed_distance: &|x| geometry.signed_distance(inside(x)),
        phase: &phase,
    };
    open::fill(&mut particles, &mut depth, &open.sides, &around);
    initial::set(&mut particles, sph, &open, &inside, bounds);
    if let Some(start) = &sph.initial.network {
        let depth = method.plates.map(|plates| plates.depth);
        from_network_state::set_pressures(&mut particles, sph, depth, &open, start);
    }
    let viscous_time = viscous_time(&method, &lattice, &domain, |x| geometry.signed_distance(x));
    let surroundings = surroundings(case, sph, &geometry, &method);
    let wall_properties = wall_properties(sph, &geometry);
    let wall: WallQuery = Box::new(move |x| {
        let wall = geometry.wall(inside(x));
        (wall.distance, wall.normal)
    });
    let config = Configuration { method, domain, wall, wall_properties, open, viscous_time, since: 0.0 };
    Ok(SphSolver::new(Flow::new(config, particles, depth), surroundings))
}

/// The solver for the relative permeabilities: the flows of the whole pore and of each phase, one after the other. Each starts from packed
/// particles, also the later ones of a resumed run.
fn beside_frozen_interface(case: &Case, sph: &Sph, packed: &mut dyn FnMut(f64)) -> Result<SphSolver, SetupError> {
    let geometry = Arc::new(geometry(case, sph)?);
    let region = start_region(case, sph);
    let one_fluid = frozen::with_one_fluid(sph);
    let ground = Ground::new(&geometry, &one_fluid)?;
    let (particles, depth) = filled(sph, &geometry, &ground, &region, true, packed)?;
    let surroundings = surroundings(case, sph, &geometry, &ground.method);
    let pore = Pore { geometry, region: Arc::new(region), sph: Arc::new(one_fluid) };
    Ok(SphSolver::beside(frozen::frozen(&pore, &particles, &depth)?, surroundings))
}
