//! The flows for a relative permeability: the whole pore, and each phase with a frozen interface, from the particles of both phases.

use std::sync::Arc;

use super::error::SetupError;
use super::ground::{Ground, start_phase};
use super::viscous_time::viscous_time;
use crate::configuration::Configuration;
use crate::fill::Region;
use crate::flow::Flow;
use crate::frozen::{FlowAtRest, FrozenInterface};
use crate::open::Open;
use crate::particles::{Particles, Phase};
use meniscus_case::Sph;
use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;

/// Distance from a wall at which the phase on it is evaluated, over the spacing.
const BESIDE: f64 = 0.1;

/// Walls and initial phases of a case.
#[derive(Clone)]
pub(super) struct Pore {
    /// The solids.
    pub(crate) geometry: Arc<Geometry>,
    /// The region of the initial state.
    pub(crate) region: Arc<Region>,
    /// The case.
    pub(crate) sph: Arc<Sph>,
}

/// The case with the wetting fluid in both phases and without interfacial forces: the permeability in creeping flow does not depend on the fluid.
pub(super) fn with_one_fluid(sph: &Sph) -> Sph {
    Sph {
        non_wetting: sph.non_wetting.map(|_| sph.wetting),
        tension: 0.0,
        surface_force: None,
        wetting_model: None,
        wetting_patches: Vec::new(),
        ..sph.clone()
    }
}

/// The flows of the pore and of its phases, from the particles of both and the `depth` (m) of wall particles.
pub(super) fn frozen(pore: &Pore, particles: &Particles, depth: &[f64]) -> Result<FrozenInterface, SetupError> {
    for (phase, name) in [(Phase::Wetting, "wetting"), (Phase::NonWetting, "non-wetting")] {
        if !particles.phase.contains(&phase) {
            return Err(SetupError::NoPhase(name));
        }
    }
    let whole = (particles.clone(), depth.to_vec());
    let of_phase = |phase| at_rest(pore, Some(phase), pore.beside(phase, particles));
    let flows = [at_rest(pore, None, whole), of_phase(Phase::Wetting), of_phase(Phase::NonWetting)];
    Ok(FrozenInterface { flows })
}

/// Constructor of the flow of a phase, or of the whole pore, from its particles and the depth in m of wall particles.
fn at_rest(pore: &Pore, phase: Option<Phase>, start: (Particles, Vec<f64>)) -> FlowAtRest {
    let pore = pore.clone();
    Box::new(move || {
        let wall = pore.clone();
        // The periods were checked when the particles were filled.
        let Ground { lattice, method, domain } = Ground::of(&pore.geometry, &pore.sph);
        let viscous_time = viscous_time(&method, &lattice, &domain, |x| wall.wall(phase, x).0);
        let config = Configuration {
            method,
            domain,
            wall: Box::new(move |x| wall.wall(phase, x)),
            wall_properties: None,
            open: Open::default(),
            viscous_time,
            since: 0.0,
        };
        let (particles, depth) = start.clone();
        Flow::new(config, particles, depth)
    })
}

impl Pore {
    /// The particles of one phase as fluid, with walls of the solids and the other phase down to the depth of the support, and the depth in m of
    /// wall particles below the boundary of the phase.
    fn beside(&self, phase: Phase, of_both: &Particles) -> (Particles, Vec<f64>) {
        let support = Ground::of(&self.geometry, &self.sph).method.kernel.support();
        let (mut particles, mut depth) = (Particles::default(), Vec::new());
        let own = |a: &usize| of_both.phase[*a] == phase;
        let all = 0..of_both.len();
        all.clone().filter(own).for_each(|a| particles.push(phase, of_both.position[a]));
        for x in all.filter(|a| !own(a)).map(|a| of_both.position[a]) {
            let below = -self.wall(Some(phase), x).0;
            if below < support {
                particles.push(Phase::Solid, x);
                depth.push(below);
            }
        }
        (particles, depth)
    }

    /// Signed distance in m to the boundary of the fluid, positive in the fluid, and normal into it: of a `phase` bounded by the solids and the
    /// other phase, or of both phases.
    fn wall(&self, phase: Option<Phase>, x: Vec2) -> (f64, Vec2) {
        let x = self.geometry.wrapped(x);
        let solid = self.geometry.wall(x);
        let Some(phase) = phase else { return (solid.distance, solid.normal) };
        let is_pore = solid.distance > 0.0;
        let beside = if is_pore { x } else { x + (BESIDE * self.sph.spacing - solid.distance) * solid.normal };
        let (away, normal) = self.interface(x);
        let own = start_phase(&self.sph, &self.region, self.geometry.wrapped(beside)) == phase;
        match () {
            () if own && is_pore && away < solid.distance => (away, normal),
            () if own => (solid.distance, solid.normal),
            // Behind the other phase the closest part of the phase is at the interface.
            () => (-away.max(-solid.distance), -normal),
        }
    }

    /// Distance from the interface in m, and the direction away from it.
    fn interface(&self, x: Vec2) -> (f64, Vec2) {
        let surface = self.region.surface.wall(x);
        (surface.distance.abs(), surface.distance.signum() * surface.normal)
    }
}
