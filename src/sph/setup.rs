//! From a checked case and its geometry to a solver: the only SPH file that sees both.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::analysis::contour::Polyline;
use crate::analysis::phases::wall_samples;
use crate::case::checked::{self, Case, InitialVelocity, PatchedWall, Side, Sph, WettingModel, WettingPatch};
use crate::geometry::Geometry;
use crate::geometry::shells::FreeWalls;
use crate::geometry::spec::{GeometrySpec, ShapeSpec, SolidSide};
use crate::math::{Bounds, Vec2};
use crate::snapshot::Lines;
use crate::sph::boundary::no_slip::NoSlip;
use crate::sph::domain::{Domain, ImageVelocity, Mirror};
use crate::sph::fill::{self, Lattice, Places};
use crate::sph::kernel::WendlandC2;
use crate::sph::measures::DiscOf;
use crate::sph::method::{Fluid, Method, ViscousTerm};
use crate::sph::open::{self, Around, Ledger, Open, OpenSide, Opening, Profile, Shape};
use crate::sph::packing::Packing;
use crate::sph::particles::Phase;
use crate::sph::poisson::Tolerance;
use crate::sph::projection::{Flow, WallQuery};
use crate::sph::solver::{SphSolver, Surroundings};
use crate::sph::surface_force::SurfaceForce;
use crate::sph::wetting::contact_line::LineDelta;
use crate::sph::wetting::wall::{WallSpot, WallSpots};
use crate::sph::wetting::{
    CoxVoinov, Hysteresis, Jiang, Kistler, LineFriction, MolecularKinetic, TadmorAngle, Wetting, YoungForce,
};

/// Most iterations of a pressure solve; a healthy one takes about ten.
const ITERATIONS: usize = 300;

/// A case that cannot be filled with particles.
#[derive(Debug, thiserror::Error)]
pub enum SetupError {
    /// A shape is not usable.
    #[error("{0}")]
    Geometry(#[from] crate::geometry::GeometryError),
    /// The box is too small for its periodic sides.
    #[error(
        "a periodic domain must be at least {needed:.3e} m long (three kernel supports), found {width:.3e} m by {height:.3e} m; \
         use a smaller spacing or a longer domain"
    )]
    PeriodTooShort {
        /// Least length in m.
        needed: f64,
        /// Width in m.
        width: f64,
        /// Height in m.
        height: f64,
    },
    /// An open side that nothing can pass through.
    #[error("solids block the open side `{0}` all along; open another side, or leave a gap in the solids")]
    Blocked(&'static str),
    /// A parabola over several openings.
    #[error(
        "the side `{side}` has {openings} openings between its solids, and a parabola needs one; use profile = \"plug\" or a pressure"
    )]
    Openings {
        /// The side.
        side: &'static str,
        /// Number of its openings.
        openings: usize,
    },
    /// A solid or a pore that ends at an open side.
    #[error(
        "a shape ends at the open side `{side}` near ({:.3e}, {:.3e}) m; walls go on beyond an open side, so let the shape reach \
         {reach:.1e} m beyond it, or end before it", place.x, place.y
    )]
    EndsAtSide {
        /// The side.
        side: &'static str,
        /// Where, in m.
        place: Vec2,
        /// How far the shape must reach beyond the side, in m.
        reach: f64,
    },
    /// No room for a single particle.
    #[error("no fluid particle fits into the pore at a spacing of {0:.3e} m; use a smaller spacing")]
    NoFluid(f64),
}

/// The solids of a case as its solver sees them: periodic sides joined, wall sides closed.
///
/// # Errors
/// [`SetupError::Geometry`] with what is wrong with the shapes.
pub fn geometry(case: &Case, sph: &Sph) -> Result<Geometry, SetupError> {
    let sides = [sph.sides.left, sph.sides.right, sph.sides.bottom, sph.sides.top];
    let periodic = [sides[0] == Side::Periodic, sides[2] == Side::Periodic];
    let walls = sides.map(|side| side == Side::Wall);
    Ok(Geometry::new(&case.geometry)?.with_periodic(periodic).with_wall_sides(walls))
}

/// The solver of a case at time zero.
///
/// # Errors
/// See [`SetupError`].
pub fn build(case: &Case, sph: &Sph) -> Result<SphSolver, SetupError> {
    let geometry = Arc::new(geometry(case, sph)?);
    let bounds = geometry.bounds();
    let sides = [sph.sides.left, sph.sides.right, sph.sides.bottom, sph.sides.top];
    let lattice = Lattice::fitting(bounds, sph.spacing);
    let method = method(sph, &lattice);
    let domain = Domain::new(bounds, geometry.periodic(), mirrors(bounds, sides));
    let support = method.kernel.support();
    if !fill::fits(&domain, support) {
        let size = bounds.size();
        let needed = fill::PERIODIC_SUPPORTS * support;
        return Err(SetupError::PeriodTooShort { needed, width: size.x, height: size.y });
    }
    let region = region(case, &sph.initial.wetting);
    let phase = |x: Vec2| {
        let inside = region.signed_distance(x) < 0.0;
        let wetting = inside != sph.initial.wetting_is_background;
        if wetting || sph.non_wetting.is_none() { Phase::Wetting } else { Phase::NonWetting }
    };
    let walls = sides.map(|side| side == Side::Wall);
    let places = if sph.numerics.fitted_walls {
        fitted_places((&geometry, &domain), &lattice, &method, walls)
    } else {
        fill::on_lattice(&lattice, support, walls, |x| geometry.signed_distance(x))
    };
    let mut particles = places.particles(phase);
    let mut depth = places.depth;
    if particles.fluids == 0 {
        return Err(SetupError::NoFluid(sph.spacing));
    }
    let open = open(sph, (&geometry, &lattice, method.kernel.h), &phase)?;
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
    for a in 0..particles.moving() {
        let x = particles.position[a];
        let given = open.sides.iter().filter(|side| side.beyond(x) > 0.0).find_map(|side| side.given_velocity(x));
        particles.velocity[a] = given.unwrap_or_else(|| velocity(&sph.initial.velocity, inside(x), bounds));
    }
    // The slopes of the first step begin at zero: each side sees its own pressure.
    for a in 0..particles.len() {
        let x = particles.position[a];
        let given = open.sides.iter().filter_map(|side| Some((side.beyond(x), side.given_pressure()?)));
        particles.pressure[a] = given.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, pressure)| pressure);
    }
    let outline = geometry.outline();
    for a in particles.moving()..particles.len() {
        particles.velocity[a] = wall_velocity(sph.wall_speeds, inside(particles.position[a]), bounds);
    }
    let ledger = Ledger::new(&particles.phase[..particles.fluids], u32::try_from(particles.len()).unwrap_or(u32::MAX));
    let surroundings = Surroundings {
        wall_samples: wall_samples(&polylines(&outline), 0.5 * sph.spacing),
        outline,
        discs: discs(&case.geometry),
        plates: plates(&case.geometry),
        wall_speeds: sph.wall_speeds,
        measures: sph.measure.clone(),
        grid_spacing: case.output.grid_ratio * sph.spacing,
    };
    let walls = wall_spots(sph, &geometry);
    let query: WallQuery = Box::new(move |x| {
        let wall = geometry.wall(inside(x));
        (wall.distance, wall.normal)
    });
    let open = Open { ledger, cell: lattice.step.x * lattice.step.y, ..open };
    let mut flow = Flow::new(method, domain, query, (particles, depth), open);
    if let Some(walls) = walls {
        flow = flow.with_walls(walls);
    }
    Ok(SphSolver::new(flow, surroundings))
}

/// Patches and velocities of the walls; none where all walls are alike and at rest.
fn wall_spots(sph: &Sph, geometry: &Arc<Geometry>) -> Option<WallSpots> {
    if sph.wetting_patches.is_empty() && sph.wall_speeds == [0.0; 4] {
        return None;
    }
    let (patches, speeds, geometry) = (sph.wetting_patches.clone(), sph.wall_speeds, Arc::clone(geometry));
    Some(WallSpots::new(Box::new(move |x| {
        let wall = geometry.wall(x);
        // Walls at the sides are numbered after the shapes.
        let side = wall.shape.checked_sub(geometry.shape_count()).filter(|side| *side < 4);
        let velocity = match side {
            Some(side @ (0 | 1)) => Vec2::new(0.0, speeds[side as usize]),
            Some(side) => Vec2::new(speeds[side as usize], 0.0),
            None => Vec2::zeros(),
        };
        let foot = geometry.wrapped(x - wall.distance * wall.normal);
        let lies_there = |patch: &WettingPatch| {
            let on = match patch.on {
                PatchedWall::All => true,
                PatchedWall::Shape(shape) => wall.shape == shape,
                PatchedWall::Side(number) => side == Some(number),
            };
            on && wall.distance.is_finite() && patch.stripes.is_none_or(|stripes| stripes.contains(foot))
        };
        WallSpot { patch: patches.iter().rposition(lies_there), velocity }
    })))
}

fn wetting(model: WettingModel) -> Wetting {
    match model {
        WettingModel::Young { contact_angle } => Wetting::Young(YoungForce { contact_angle }),
        WettingModel::Tadmor { advancing, receding } => Wetting::Tadmor(TadmorAngle { advancing, receding }),
        WettingModel::LineFriction { contact_angle, friction } => {
            Wetting::LineFriction(LineFriction { contact_angle, friction })
        }
        WettingModel::MolecularKinetic { contact_angle, frequency, jump_length, temperature } => {
            Wetting::MolecularKinetic(MolecularKinetic { contact_angle, frequency, jump_length, temperature })
        }
        WettingModel::CoxVoinov { contact_angle, slip_length } => {
            Wetting::CoxVoinov(CoxVoinov { contact_angle, slip_length })
        }
        WettingModel::Kistler { contact_angle } => Wetting::Kistler(Kistler { contact_angle }),
        WettingModel::Jiang { contact_angle } => Wetting::Jiang(Jiang { contact_angle }),
        WettingModel::Hysteresis { advancing, receding } => Wetting::Hysteresis(Hysteresis { advancing, receding }),
    }
}

/// Where the particles stand at time zero: along walls that the lattice does not fit, and packed to them.
fn fitted_places(
    (geometry, domain): (&Geometry, &Domain),
    lattice: &Lattice,
    method: &Method,
    walls: [bool; 4],
) -> Places {
    let support = method.kernel.support();
    let signed_distance = |x| geometry.signed_distance(x);
    let free = FreeWalls::new(geometry, support, |a, b| lattice.fits(a, b));
    if free.is_empty() {
        return fill::on_lattice(lattice, support, walls, signed_distance);
    }
    let pore_area = geometry.porosity().value * geometry.bounds().area();
    let mut places = fill::along_walls((lattice, domain), (support, walls), &free, signed_distance, pore_area);
    let packing = Packing {
        walls: &places.walls,
        domain,
        kernel: &method.kernel,
        spacing: method.spacing,
        volume: method.volume,
        wall: |x| {
            let wall = geometry.wall(x);
            (wall.distance, wall.normal)
        },
    };
    packing.pack(&mut places.fluid);
    places
}

/// Names of the sides in the order of their numbers.
const SIDES: [&str; 4] = ["left", "right", "bottom", "top"];

/// The open sides, and the periodic ones with a given flow.
fn open(
    sph: &Sph,
    (geometry, lattice, h): (&Geometry, &Lattice, f64),
    phase: &dyn Fn(Vec2) -> Phase,
) -> Result<Open, SetupError> {
    let bounds = geometry.bounds();
    let kinds = [sph.sides.left, sph.sides.right, sph.sides.bottom, sph.sides.top];
    let mut open = Open::default();
    for (number, given) in sph.open.iter().enumerate() {
        let Some(given) = given else { continue };
        let (axis, along) = (number / 2, 1 - number / 2);
        let at = if number.is_multiple_of(2) { bounds.min[axis] } else { bounds.max[axis] };
        let enters = given.enters_wetting.map(|wetting| if wetting { Phase::Wetting } else { Phase::NonWetting });
        let layers = (open::DEPTH * h / lattice.step[axis]).ceil();
        let mut side = OpenSide {
            number,
            at,
            drive: open::Drive::Pressure(0.0),
            enters,
            main: Phase::Wetting,
            depth: layers * lattice.step[axis],
        };
        let near_side = |y: f64| {
            let mut x = Vec2::zeros();
            x[along] = y;
            side.placed(x, -INSIDE * sph.spacing)
        };
        // Solids narrower than this are no obstacle that particles would see.
        let step = 0.1 * sph.spacing;
        let is_pore = |y: f64| geometry.signed_distance(near_side(y)) > 0.0;
        let openings = open::openings((bounds.min[along], bounds.max[along]), step, is_pore);
        if openings.is_empty() {
            return Err(SetupError::Blocked(SIDES[number]));
        }
        if kinds[number] != Side::Periodic {
            goes_on(&side, (geometry, &openings), &near_side, lattice.step)?;
        }
        side.main = enters.unwrap_or_else(|| main_phase(&openings, |y| phase(near_side(y)), step));
        let width: f64 = openings.iter().map(|o| o.to - o.from).sum();
        let profile = |mean: f64, form| {
            shape(form, (SIDES[number], &openings), [kinds[2 * along], kinds[2 * along + 1]])
                .map(|shape| open::Drive::Velocity(Profile { mean, shape, openings: openings.clone() }))
        };
        side.drive = match given.drive {
            checked::Drive::Pressure(pressure) => open::Drive::Pressure(pressure),
            checked::Drive::Velocity(mean, form) => profile(mean, form)?,
            checked::Drive::FlowRate(rate, form) => profile(rate / width, form)?,
        };
        if kinds[number] == Side::Periodic {
            side.depth = open::Through::WIDTH * h;
            open.through.push(open::Through { side });
        } else {
            open.sides.push(side);
        }
    }
    Ok(open)
}

/// How far inside of a side its openings are looked for, over the spacing: on the side itself a solid can end.
const INSIDE: f64 = 1e-3;

/// Form of a profile over the openings of a side, between the sides of the kinds `ends`.
fn shape(
    form: checked::Profile,
    (side, openings): (&'static str, &[Opening]),
    ends: [Side; 2],
) -> Result<Shape, SetupError> {
    match (form, ends) {
        (checked::Profile::Plug, _) => Ok(Shape::Plug),
        _ if openings.len() > 1 => Err(SetupError::Openings { side, openings: openings.len() }),
        (_, [Side::Symmetry, _]) => Ok(Shape::HalfParabola { mirror_above: false }),
        (_, [_, Side::Symmetry]) => Ok(Shape::HalfParabola { mirror_above: true }),
        _ => Ok(Shape::Parabola),
    }
}

/// Whether solids at the side reach beyond it, as the walls of its buffer do.
fn goes_on(
    side: &OpenSide,
    (geometry, openings): (&Geometry, &[Opening]),
    near_side: &dyn Fn(f64) -> Vec2,
    step: Vec2,
) -> Result<(), SetupError> {
    let (bounds, along) = (geometry.bounds(), 1 - side.axis());
    let reach = 2.0 * step[side.axis()];
    let count = (bounds.size()[along] / step[along]).round() as usize;
    for i in 0..count {
        let y = bounds.min[along] + (i as f64 + 0.5) * step[along];
        let place = near_side(y);
        let is_open = openings.iter().any(|o| (o.from..=o.to).contains(&y));
        // A slanted wall may come or go near its edge.
        let is_near_edge = openings.iter().any(|o| (y - o.from).abs().min((y - o.to).abs()) < reach);
        if !is_near_edge && is_open != (geometry.signed_distance(side.placed(place, reach)) > 0.0) {
            return Err(SetupError::EndsAtSide { side: SIDES[side.number], place, reach });
        }
    }
    Ok(())
}

/// The phase that fills more of the openings.
fn main_phase(openings: &[Opening], phase: impl Fn(f64) -> Phase, step: f64) -> Phase {
    let mut wetting = 0_i64;
    for opening in openings {
        let count = ((opening.to - opening.from) / step).ceil() as usize;
        for i in 0..count {
            let y = opening.from + (opening.to - opening.from) * (i as f64 + 0.5) / count as f64;
            wetting += if phase(y) == Phase::Wetting { 1 } else { -1 };
        }
    }
    if wetting >= 0 { Phase::Wetting } else { Phase::NonWetting }
}

/// The place from which walls are seen: beyond an open side the nearest one on the side, so that walls go on along its normal.
fn inside_of_open_sides(sides: &[OpenSide]) -> impl Fn(Vec2) -> Vec2 + Send + Sync + use<> {
    let sides = sides.to_vec();
    move |x| sides.iter().fold(x, |x, side| if side.beyond(x) > 0.0 { side.placed(x, 0.0) } else { x })
}

fn method(sph: &Sph, lattice: &Lattice) -> Method {
    let kernel = lattice.consistent(WendlandC2::new(sph.smoothing_ratio * sph.spacing));
    let fluid = |f: &checked::Fluid| Fluid { density: f.density, viscosity: f.viscosity };
    let wetting_fluid = fluid(&sph.wetting);
    let numerics = &sph.numerics;
    Method {
        kernel,
        spacing: sph.spacing,
        volume: lattice.volume(&kernel),
        wetting_fluid,
        other_fluid: sph.non_wetting.as_ref().map_or(wetting_fluid, fluid),
        tension: sph.tension,
        surface_force: match sph.surface_force {
            Some(checked::SurfaceForce::PressureJump) => SurfaceForce::PressureJump,
            Some(checked::SurfaceForce::Csf { line_delta: checked::LineDelta::Local }) => {
                SurfaceForce::Csf(LineDelta::Local)
            }
            Some(checked::SurfaceForce::Csf { .. }) | None => SurfaceForce::Csf(LineDelta::Normalized),
        },
        wetting: sph.wetting_model.map(wetting),
        patches: sph.wetting_patches.iter().map(|patch| wetting(patch.model)).collect(),
        gravity: sph.gravity,
        no_slip: NoSlip { spacing: sph.spacing, largest_stretch: numerics.wall_stretch, slip_length: sph.slip_length },
        viscous_term: match numerics.viscous_term {
            checked::ViscousTerm::Szewc => ViscousTerm::Szewc,
            checked::ViscousTerm::Morris => ViscousTerm::Morris,
            checked::ViscousTerm::Stress => ViscousTerm::Stress,
        },
        drift_source: numerics.drift_source,
        background_pressure: numerics.background_pressure,
        shifting: numerics.shifting,
        tolerance: Tolerance { residual: numerics.pressure_tolerance, iterations: ITERATIONS },
        time_step_factor: numerics.time_step_factor,
    }
}

fn mirrors(bounds: Bounds, sides: [Side; 4]) -> Vec<Mirror> {
    let places = [(0, bounds.min.x), (0, bounds.max.x), (1, bounds.min.y), (1, bounds.max.y)];
    let mirror = |(side, (axis, at)): (Side, (usize, f64))| match side {
        Side::Image => Some(Mirror { axis, at, image: ImageVelocity::Reversed }),
        Side::Symmetry => Some(Mirror { axis, at, image: ImageVelocity::Mirrored }),
        Side::Periodic | Side::Wall | Side::Inlet | Side::Outlet => None,
    };
    sides.into_iter().zip(places).filter_map(mirror).collect()
}

/// Shapes of the initial wetting phase as a solid: negative distance inside of them.
#[must_use]
pub fn region(case: &Case, shapes: &[ShapeSpec]) -> Geometry {
    Geometry::unchecked(&GeometrySpec { shapes: shapes.to_vec(), solid: SolidSide::Inside, ..case.geometry.clone() })
}

fn velocity(initial: &InitialVelocity, x: Vec2, bounds: Bounds) -> Vec2 {
    match *initial {
        InitialVelocity::Rest => Vec2::zeros(),
        InitialVelocity::Uniform(v) => v,
        InitialVelocity::TaylorGreen(speed) => {
            let phase = (x - bounds.min).component_div(&bounds.size()) * TAU;
            speed * Vec2::new(-phase.x.cos() * phase.y.sin(), phase.x.sin() * phase.y.cos())
        }
    }
}

/// Velocity of a wall particle in m/s: that of the side which it stands behind, none behind a corner.
fn wall_velocity(speeds: [f64; 4], x: Vec2, bounds: Bounds) -> Vec2 {
    let [left, right, bottom, top] = speeds;
    let behind = |i: usize, lower: f64, upper: f64| match () {
        () if x[i] < bounds.min[i] => Some(lower),
        () if x[i] > bounds.max[i] => Some(upper),
        () => None,
    };
    match (behind(0, left, right), behind(1, bottom, top)) {
        (Some(along), None) => Vec2::new(0.0, along),
        (None, Some(along)) => Vec2::new(along, 0.0),
        _ => Vec2::zeros(),
    }
}

/// The upright rectangles among the solids.
fn plates(spec: &GeometrySpec) -> Vec<Bounds> {
    let plate = |shape: &ShapeSpec| match shape {
        ShapeSpec::Rectangle(r) if r.rotation_deg == 0.0 => {
            let (center, half) = (Vec2::from(r.center), 0.5 * Vec2::from(r.size));
            Some(Bounds { min: center - half, max: center + half })
        }
        _ => None,
    };
    spec.shapes.iter().filter_map(plate).collect()
}

fn discs(spec: &GeometrySpec) -> Vec<DiscOf> {
    let disc = |shape: &ShapeSpec| match shape {
        ShapeSpec::Disc(disc) => Some(DiscOf { center: Vec2::from(disc.center), radius: disc.radius }),
        _ => None,
    };
    spec.shapes.iter().filter_map(disc).collect()
}

fn polylines(outline: &Lines) -> Vec<Polyline> {
    let line = |line: &Vec<u32>| Polyline {
        points: line.iter().map(|&i| outline.points[i as usize]).collect(),
        closed: false,
    };
    outline.lines.iter().map(line).collect()
}
