//! Initial state from that of a network: the region of its invading phase, and the pressures of both phases.

use std::f64::consts::{PI, TAU};

use crate::fill::Region;
use crate::open::Open;
use crate::particles::{Particles, Phase};
use meniscus_case::FluidPhase;
use meniscus_case::network::state::{NetworkState, Start};
use meniscus_case::{Case, Sph};
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::Geometry;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::interface::depth::Depth;

/// Interfaces are extended by this many spacings into the solid, so that the distance to them is defined everywhere along the wall.
const INTO_SOLID: f64 = 3.0;

/// Largest angle of an extended arc in rad: it must not meet itself.
const WIDEST: f64 = 0.9 * TAU;

/// The region of the invading phase.
pub(super) fn region(case: &Case, sph: &Sph, start: &Start) -> Region {
    let bounds = Bounds { min: case.geometry.min.into(), max: case.geometry.max.into() };
    let outline = NetworkState::curves(&start.state.invading_outline);
    // The menisci come last.
    let interfaces = &outline[outline.len().saturating_sub(start.state.menisci.len())..];
    let extended: Vec<Curve> = interfaces.iter().map(|curve| extended(curve, INTO_SOLID * sph.spacing)).collect();
    let of = |pieces: &[Curve]| Geometry::of_surface(bounds, sph.sides.periodic(), pieces);
    let pore_area: f64 = start.state.elements.iter().map(|element| element.area_m2).sum();
    let area = start.state.saturation_with_menisci.map(|wetting| match start.state.invading {
        FluidPhase::Wetting => wetting * pore_area,
        FluidPhase::NonWetting => (1.0 - wetting) * pore_area,
    });
    Region::bounded(of(&outline), of(&extended), area)
}

/// A curve extended by `length` (m) at both ends.
fn extended(curve: &Curve, length: f64) -> Curve {
    let share = length / curve.length();
    let share = match curve {
        Curve::Segment { .. } => share,
        Curve::Arc { sweep, .. } => share.min(0.5 * (WIDEST / sweep.abs() - 1.0)).max(0.0),
    };
    curve.part(-share, 1.0 + share)
}

/// Sets the pressures of the fluid particles: uniform in each phase, with a difference p_n − p_w of tension times applied curvature; in trapped
/// clusters by the curvature of their own menisci. A side with a given pressure fixes the level.
pub(super) fn set_pressures(particles: &mut Particles, sph: &Sph, depth: Option<Depth>, open: &Open, start: &Start) {
    let state = &start.state;
    let jump_at = |curvature: f64| sph.tension * depth.map_or(curvature, |depth| depth.curvature(curvature));
    let jump = jump_at(state.applied_curvature_per_m);
    let of_phase = |phase: Phase| if phase == Phase::NonWetting { jump } else { 0.0 };
    let given = open.sides.iter().find_map(|side| Some(side.given_pressure()? - of_phase(side.main)));
    let base = given.unwrap_or(0.0);
    let clusters = Clusters::new(state, jump_at, jump);
    for a in 0..particles.fluids {
        let phase = particles.phase[a];
        let own = clusters.pressure(phase, particles.position[a]);
        particles.pressure[a] = base + own.unwrap_or_else(|| of_phase(phase));
    }
}

/// The elements with trapped fluid.
struct Clusters {
    phase: Phase,
    elements: Vec<(Bounds, Vec<Curve>, f64)>,
}

impl Clusters {
    /// Pressures in Pa relative to that of the wetting phase connected to a side; `jump` is that of the connected non-wetting phase.
    fn new(state: &NetworkState, jump_at: impl Fn(f64) -> f64, jump: f64) -> Self {
        let (phase, invading, sign) = match state.invading {
            FluidPhase::NonWetting => (Phase::Wetting, jump, -1.0),
            FluidPhase::Wetting => (Phase::NonWetting, 0.0, 1.0),
        };
        let trapped = state.elements.iter().filter_map(|element| Some((element, element.trapped_curvature_per_m?)));
        let elements = trapped.filter_map(|(element, curvature)| {
            let curves = NetworkState::curves(&element.boundary);
            let bounds = curves.iter().map(Curve::bounds).reduce(|a, b| a.united(&b))?;
            Some((bounds, curves, invading + sign * jump_at(curvature)))
        });
        Self { phase, elements: elements.collect() }
    }

    /// The pressure of a trapped phase at `x` (m); `None` where it is not trapped.
    fn pressure(&self, phase: Phase, x: Vec2) -> Option<f64> {
        // The pore is to the right of a boundary.
        let winds = |curves: &[Curve]| curves.iter().map(|curve| curve.winding(x)).sum::<f64>() < -PI;
        let mut around = self.elements.iter().filter(|(bounds, curves, _)| bounds.contains(x) && winds(curves));
        if phase == self.phase { around.next().map(|(.., pressure)| *pressure) } else { None }
    }
}
