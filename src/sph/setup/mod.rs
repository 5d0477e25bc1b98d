//! From a checked case and its geometry to a solver: the only SPH folder that sees both.

mod error;
mod handed_back;
mod handed_over;
mod initial;
mod method;
mod open_sides;
mod places;
mod surroundings;
mod walls;

use std::sync::Arc;

pub use error::SetupError;
pub use initial::region;

use self::method::method;
use self::open_sides::{inside_of_open_sides, open_sides};
use self::places::{Filling, places};
use self::surroundings::surroundings;
use self::walls::{mirrors, wall_spots};
use crate::case::checked::{Case, Side, Sph};
use crate::geometry::Geometry;
use crate::math::Vec2;
use crate::sph::domain::{Domain, WallQuery};
use crate::sph::fill::{self, Lattice, Region};
use crate::sph::flow::Flow;
use crate::sph::method::Method;
use crate::sph::open::{self, Around, Open};
use crate::sph::particles::Phase;
use crate::sph::setting::Setting;
use crate::sph::solver::SphSolver;

/// The solids of a case as its solver sees them: periodic sides joined, wall sides closed.
///
/// # Errors
/// [`SetupError::Geometry`] with what is wrong with the shapes.
pub fn geometry(case: &Case, sph: &Sph) -> Result<Geometry, SetupError> {
    let sides = [sph.sides.left, sph.sides.right, sph.sides.bottom, sph.sides.top];
    let periodic = [sides[0] == Side::Periodic, sides[2] == Side::Periodic];
    let walls = sides.map(|side| side == Side::Wall);
    Ok(Geometry::new(&case.geometry)?.with_sides(periodic, walls))
}

/// The solids of a case, after a look at what else can be told without its particles: the length of periods, and the openings of open sides.
///
/// # Errors
/// See [`SetupError`].
pub fn checked_geometry(case: &Case, sph: &Sph) -> Result<Geometry, SetupError> {
    let geometry = geometry(case, sph)?;
    let ground = Ground::new(&geometry, sph)?;
    let region = start_region(case, sph);
    open_sides(sph, &geometry, &ground.lattice, ground.method.kernel.h, &|x| start_phase(sph, &region, x))?;
    Ok(geometry)
}

/// Lattice, method and domain of a case.
struct Ground {
    lattice: Lattice,
    method: Method,
    domain: Domain,
}

impl Ground {
    fn new(geometry: &Geometry, sph: &Sph) -> Result<Self, SetupError> {
        let bounds = geometry.bounds();
        let sides = [sph.sides.left, sph.sides.right, sph.sides.bottom, sph.sides.top];
        let lattice = Lattice::fitting(bounds, sph.spacing);
        let method = method(sph, &lattice);
        let domain = Domain::new(bounds, geometry.periodic(), mirrors(bounds, sides));
        let support = method.kernel.support();
        if !fill::fits(&domain, support) {
            let (size, needed) = (bounds.size(), fill::PERIODIC_SUPPORTS * support);
            return Err(SetupError::PeriodTooShort { needed, width: size.x, height: size.y });
        }
        Ok(Self { lattice, method, domain })
    }
}

/// The region of the shapes, or of the state of a network, that a case begins with.
fn start_region(case: &Case, sph: &Sph) -> Region {
    match &sph.initial.network {
        Some(start) => handed_over::region(case, sph, start),
        None => Region::of_shapes(region(case, &sph.initial.wetting)),
    }
}

/// The phase at `x` at time zero.
fn start_phase(sph: &Sph, region: &Region, x: Vec2) -> Phase {
    let wetting = region.holds(x) != sph.initial.wetting_is_background;
    if wetting || sph.non_wetting.is_none() { Phase::Wetting } else { Phase::NonWetting }
}

/// The solver of a case at time zero.
///
/// # Errors
/// See [`SetupError`].
pub fn build(case: &Case, sph: &Sph) -> Result<SphSolver, SetupError> {
    build_watched(case, sph, &mut |_| {})
}

/// The solver of a case at time zero; `packed` is told the share of the packing of particles that is done, which takes most of the time.
///
/// # Errors
/// See [`SetupError`].
pub fn build_watched(case: &Case, sph: &Sph, packed: &mut dyn FnMut(f64)) -> Result<SphSolver, SetupError> {
    placed(case, sph, Some(packed))
}

/// The solver of a case that takes up a saved state before anything else: as many particles as at time zero, which are not packed.
///
/// # Errors
/// See [`SetupError`].
pub fn build_to_resume(case: &Case, sph: &Sph) -> Result<SphSolver, SetupError> {
    placed(case, sph, None)
}

/// The solver with particles that are packed where someone is there to be told of it.
fn placed(case: &Case, sph: &Sph, packed: Option<&mut dyn FnMut(f64)>) -> Result<SphSolver, SetupError> {
    let geometry = Arc::new(geometry(case, sph)?);
    let bounds = geometry.bounds();
    let sides = [sph.sides.left, sph.sides.right, sph.sides.bottom, sph.sides.top];
    let Ground { lattice, method, domain } = Ground::new(&geometry, sph)?;
    let support = method.kernel.support();
    let region = start_region(case, sph);
    let phase = |x: Vec2| start_phase(sph, &region, x);
    let walls = sides.map(|side| side == Side::Wall);
    let interface = (sph.non_wetting.is_some() && sph.numerics.fitted_interface).then_some(&region);
    let filling = Filling {
        geometry: &geometry,
        domain: &domain,
        lattice: &lattice,
        method: &method,
        sides,
        fitted_walls: sph.numerics.fitted_walls,
    };
    let places = places(&filling, interface, packed);
    let mut particles = places.particles(phase);
    let mut depth = places.depth;
    if particles.fluids == 0 {
        return Err(SetupError::NoFluid(sph.spacing));
    }
    let open = open_sides(sph, &geometry, &lattice, method.kernel.h, &phase)?;
    let inside = inside_of_open_sides(&open.sides);
    let around = Around {
        bounds,
        step: lattice.step,
        support,
        walls,
        signed_distance: &|x| geometry.signed_distance(inside(x)),
        phase: &phase,
    };
    open::fill(&mut particles, &mut depth, &open.sides, &around);
    initial::set(&mut particles, sph, &open, &inside, bounds);
    if let Some(start) = &sph.initial.network {
        handed_over::set_pressures(&mut particles, sph, &open, start);
    }
    let open = Open { cell: lattice.step.x * lattice.step.y, ..open };
    let surroundings = surroundings(case, sph, &geometry);
    let spots = wall_spots(sph, &geometry).unwrap_or_default();
    let wall: WallQuery = Box::new(move |x| {
        let wall = geometry.wall(inside(x));
        (wall.distance, wall.normal)
    });
    let setting = Setting { method, domain, wall, spots, open };
    Ok(SphSolver::new(Flow::new(setting, particles, depth), surroundings))
}
