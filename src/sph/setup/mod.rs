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

pub(crate) use depth_notes::notes as notes_on_depth;
pub(crate) use error::SetupError;
pub(crate) use initial::region;

use self::frozen::Pore;
use self::ground::{Ground, start_phase};
use self::open_sides::{inside_of_open_sides, open_sides};
use self::positions::{Filling, positions};
use self::surroundings::surroundings;
use self::viscous_time::viscous_time;
use self::walls::wall_properties;
use crate::case::{Case, Side, Sph};
use crate::geometry::Geometry;
use crate::math::Vec2;
use crate::sph::configuration::Configuration;
use crate::sph::domain::WallQuery;
use crate::sph::fill::Region;
use crate::sph::flow::Flow;
use crate::sph::open::{self, Around};
use crate::sph::particles::Particles;
use crate::sph::solver::SphSolver;

/// The solids of a case for the solver: periodic sides joined, wall sides closed.
///
/// # Errors
/// [`SetupError::Geometry`] if the shapes are invalid.
pub(crate) fn geometry(case: &Case, sph: &Sph) -> Result<Geometry, SetupError> {
    let sides = sph.sides.each();
    let periodic = [sides[0] == Side::Periodic, sides[2] == Side::Periodic];
    let walls = sides.map(|side| side == Side::Wall);
    Ok(Geometry::new(&case.geometry)?.with_sides(periodic, walls))
}

/// The solids of a case, after the checks that do not need particles: length of periods, and openings of open sides.
pub(crate) fn checked_geometry(case: &Case, sph: &Sph) -> Result<Geometry, SetupError> {
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
            let periodic = [sph.sides.left == Side::Periodic, sph.sides.bottom == Side::Periodic];
            Region::of_shapes(region(case, &sph.initial.wetting).with_periodic(periodic))
        }
        None => Region::of_shapes(region(case, &sph.initial.wetting)),
    }
}

/// The solver of a case at time zero.
pub fn build(case: &Case, sph: &Sph) -> Result<SphSolver, SetupError> {
    build_watched(case, sph, &mut |_| {})
}

/// The solver of a case at time zero; reports the completed fraction of the packing, which takes most of the time, to `packed`.
pub(crate) fn build_watched(case: &Case, sph: &Sph, packed: &mut dyn FnMut(f64)) -> Result<SphSolver, SetupError> {
    placed(case, sph, Some(packed))
}

/// The solver of a case to be restored from a saved state: with the number of particles at time zero, which are not packed.
pub(crate) fn build_to_resume(case: &Case, sph: &Sph) -> Result<SphSolver, SetupError> {
    placed(case, sph, None)
}

/// The solver of a case. The particles are packed only if there is a progress function `packed`; a resumed state has packed particles.
fn placed(case: &Case, sph: &Sph, packed: Option<&mut dyn FnMut(f64)>) -> Result<SphSolver, SetupError> {
    if sph.measure.relative_permeability {
        return beside_frozen_interface(case, sph, packed.unwrap_or(&mut |_| {}));
    }
    let geometry = Arc::new(geometry(case, sph)?);
    let bounds = geometry.bounds();
    let ground = Ground::new(&geometry, sph)?;
    let region = start_region(case, sph);
    let (mut particles, mut depth) = filled(sph, &geometry, (&ground, &region), packed)?;
    let Ground { lattice, method, domain } = ground;
    let phase = |x: Vec2| start_phase(sph, &region, x);
    let open = open_sides(sph, &geometry, &lattice, method.kernel.h, &phase)?;
    let inside = inside_of_open_sides(&open.sides);
    let around = Around {
        bounds,
        step: lattice.step,
        support: method.kernel.support(),
        walls: sph.sides.each().map(|side| side == Side::Wall),
        signed_distance: &|x| geometry.signed_distance(inside(x)),
        phase: &phase,
    };
    open::fill(&mut particles, &mut depth, &open.sides, &around);
    initial::set(&mut particles, sph, &open, &inside, bounds);
    if let Some(start) = &sph.initial.network {
        let depth = method.plates.map(|plates| plates.depth);
        from_network_state::set_pressures(&mut particles, (sph, depth), &open, start);
    }
    let viscous_time = viscous_time(&method, &lattice, &domain, |x| geometry.signed_distance(x));
    let surroundings = surroundings(case, sph, &geometry, &method);
    let wall_properties = wall_properties(sph, &geometry).unwrap_or_default();
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
    let (particles, depth) = filled(sph, &geometry, (&ground, &region), Some(packed))?;
    let surroundings = surroundings(case, sph, &geometry, &ground.method);
    let pore = Pore { geometry, region: Arc::new(region), sph: Arc::new(one_fluid) };
    Ok(SphSolver::beside(frozen::frozen(&pore, &particles, &depth)?, surroundings))
}

/// The particles of pore and walls, and the depth in m of wall particles.
fn filled(
    sph: &Sph,
    geometry: &Geometry,
    (ground, region): (&Ground, &Region),
    packed: Option<&mut dyn FnMut(f64)>,
) -> Result<(Particles, Vec<f64>), SetupError> {
    let interface = (sph.non_wetting.is_some() && sph.numerics.fitted_interface).then_some(region);
    let filling = Filling {
        geometry,
        domain: &ground.domain,
        lattice: &ground.lattice,
        method: &ground.method,
        sides: sph.sides.each(),
        fitted_walls: sph.numerics.fitted_walls,
    };
    let positions = positions(&filling, interface, packed);
    let particles = positions.particles(|x| start_phase(sph, region, x));
    if particles.fluids == 0 {
        return Err(SetupError::NoFluid(sph.spacing));
    }
    Ok((particles, positions.depth))
}
