//! Open sides, and periodic sides with a given flow: openings, given pressure or velocity, and the phase that comes in.

use super::error::SetupError;
use crate::fill::Lattice;
use crate::open::{self, Open, OpenSide, Opening, Profile, Ramp, Shape, Staircase};
use crate::particles::Phase;
use meniscus_case::{SIDES, Side, Sph};
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;

/// Distance inside a side at which its openings are searched, over the spacing: on the side itself a solid can end.
const INSIDE: f64 = 1e-3;

/// The open sides, and the periodic ones with a given flow; `h` is the smoothing length in m.
pub(super) fn open_sides(
    sph: &Sph,
    geometry: &Geometry,
    lattice: &Lattice,
    h: f64,
    phase: &dyn Fn(Vec2) -> Phase,
) -> Result<Open, SetupError> {
    let bounds = geometry.bounds();
    let kinds = sph.sides.each();
    let mut open = Open::default();
    for (number, given) in sph.open.iter().enumerate() {
        let Some(given) = given else { continue };
        let (axis, along) = (number / 2, 1 - number / 2);
        let at = if number.is_multiple_of(2) { bounds.min[axis] } else { bounds.max[axis] };
        let inflow_phase = given.enters_wetting.map(|wetting| if wetting { Phase::Wetting } else { Phase::NonWetting });
        let layers = (open::DEPTH * h / lattice.step[axis]).ceil();
        let mut side = OpenSide {
            number,
            at,
            drive: open::Drive::Pressure(0.0),
            inflow_phase,
            main: Phase::Wetting,
            openings: Vec::new(),
            row_spacing: lattice.step[along],
            cell: lattice.volume(),
            depth: layers * lattice.step[axis],
            steps: None,
            ramp: None,
        };
        let near_side = |y: f64| {
            let mut x = Vec2::zeros();
            x[along] = y;
            side.projected(x, -INSIDE * sph.spacing)
        };
        // Narrower solids are no obstacle at the resolution of the particles.
        let step = 0.1 * sph.spacing;
        let is_pore = |y: f64| geometry.signed_distance(near_side(y)) > 0.0;
        let openings = open::openings(bounds.min[along], bounds.max[along], step, is_pore);
        if openings.is_empty() {
            return Err(SetupError::Blocked(SIDES[number]));
        }
        if kinds[number] != Side::Periodic {
            check_walls_beyond(&side, geometry, &openings, &near_side, lattice.step)?;
        }
        // Openings too narrow for a row are closed.
        let openings: Vec<Opening> =
            openings.into_iter().filter(|opening| opening.rows(lattice.step[along]) > 0).collect();
        if openings.is_empty() {
            return Err(SetupError::Blocked(SIDES[number]));
        }
        side.main = inflow_phase.unwrap_or_else(|| main_phase(&openings, |y| phase(near_side(y)), step));
        let width: f64 = openings.iter().map(Opening::width).sum();
        let profile = |mean: f64, form| {
            shape(form, SIDES[number], &openings, [kinds[2 * along], kinds[2 * along + 1]])
                .map(|shape| open::Drive::Velocity(Profile { mean, shape }))
        };
        side.drive = match given.drive {
            meniscus_case::Drive::Pressure(first) => {
                let staircase =
                    |steps: meniscus_case::PressureSteps| Staircase { first, rise: steps.rise, hold: steps.every_time };
                side.steps = given.pressure_steps.map(staircase);
                open::Drive::Pressure(first)
            }
            meniscus_case::Drive::Velocity(mean, form) => profile(mean, form)?,
            meniscus_case::Drive::FlowRate(rate, form) => profile(rate / sph.thickness() / width, form)?,
        };
        side.ramp =
            given.acceleration.and_then(|acceleration| Some(Ramp { first: side.velocity_at(0.0)?, acceleration }));
        side.openings = openings;
        if kinds[number] == Side::Periodic {
            open.through.push(side);
        } else {
            open.sides.push(side);
        }
    }
    Ok(open)
}

/// Form of a profile over the openings of a side, between the sides of the kinds `ends`.
fn shape(
    form: meniscus_case::Profile,
    side: &'static str,
    openings: &[Opening],
    ends: [Side; 2],
) -> Result<Shape, SetupError> {
    match (form, ends) {
        (meniscus_case::Profile::Plug, _) => Ok(Shape::Plug),
        _ if openings.len() > 1 => Err(SetupError::Openings { side, openings: openings.len() }),
        (_, [Side::Symmetry, _]) => Ok(Shape::HalfParabola { mirror_above: false }),
        (_, [_, Side::Symmetry]) => Ok(Shape::HalfParabola { mirror_above: true }),
        _ => Ok(Shape::Parabola),
    }
}

/// Checks that solids at the side extend beyond it, as the walls of its buffer do.
fn check_walls_beyond(
    side: &OpenSide,
    geometry: &Geometry,
    openings: &[Opening],
    near_side: &dyn Fn(f64) -> Vec2,
    step: Vec2,
) -> Result<(), SetupError> {
    let (bounds, along) = (geometry.bounds(), 1 - side.axis());
    let reach = 2.0 * step[side.axis()];
    let count = (bounds.size()[along] / step[along]).round() as usize;
    for i in 0..count {
        let y = bounds.min[along] + (i as f64 + 0.5) * step[along];
        let position = near_side(y);
        let is_open = openings.iter().any(|o| (o.from..=o.to).contains(&y));
        // Near its edges an opening may change along an inclined wall.
        let is_near_edge = openings.iter().any(|o| (y - o.from).abs().min((y - o.to).abs()) < reach);
        if !is_near_edge && is_open != (geometry.signed_distance(side.projected(position, reach)) > 0.0) {
            return Err(SetupError::EndsAtSide { side: SIDES[side.number], position, reach });
        }
    }
    Ok(())
}

/// The phase that occupies the larger part of the openings.
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

/// The point at which walls are evaluated: beyond an open side the nearest point on the side, so that walls continue along its normal.
pub(super) fn inside_of_open_sides(sides: &[OpenSide]) -> impl Fn(Vec2) -> Vec2 + Send + Sync + use<> {
    let sides = sides.to_vec();
    move |x| sides.iter().fold(x, |x, side| if side.overshoot(x) > 0.0 { side.projected(x, 0.0) } else { x })
}
