//! The state that a direct run returns to the network from which it started: the phase that fills more than half of each element.

use std::sync::Arc;

use crate::particles::{Particles, Phase};
use crate::solver::StateExport;
use meniscus_case::FluidPhase;
use meniscus_case::network::state::{ElementState, NetworkState, Start};
use meniscus_core::math::Vec2;
use meniscus_core::table::Document;
use meniscus_geometry::elements::Elements;
use meniscus_geometry::interface::depth::Depth;

const NOTE: &str = "phases by area share of a direct simulation: in each element the phase of more than half of its particles; menisci and trapped \
                    fluid are determined by the network; SI units";

/// `at-end.json` of a direct run that started from `start`, from its particles and its capillary pressure p_n - p_w in Pa.
pub(super) fn state_export(start: &Start, tension: f64, depth: Option<Depth>) -> StateExport {
    let start = Arc::clone(&start.state);
    Box::new(move |particles: &Particles, pressure| {
        let fluid = (0..particles.fluids).map(|a| (particles.position[a], particles.phase[a]));
        // Serialization of numbers, strings and lists of them cannot fail.
        let text = serde_json::to_string(&state(&start, tension, depth, fluid, pressure)).unwrap_or_default();
        Document::new("at-end.json", move |to| to.write_all(text.as_bytes()).and_then(|()| to.write_all(b"\n")))
    })
}

fn state(
    start: &NetworkState,
    tension: f64,
    depth: Option<Depth>,
    fluid: impl Iterator<Item = (Vec2, Phase)>,
    pressure: f64,
) -> NetworkState {
    let shares = shares(start, fluid);
    let element = |(old, [wetting, other]): (&ElementState, [usize; 2])| ElementState {
        phase: match wetting.cmp(&other) {
            std::cmp::Ordering::Greater => FluidPhase::Wetting,
            std::cmp::Ordering::Less => FluidPhase::NonWetting,
            // As in an element too small for a particle.
            std::cmp::Ordering::Equal => old.phase,
        },
        trapped: false,
        trapped_curvature_per_m: None,
        ..old.clone()
    };
    let elements: Vec<ElementState> = start.elements.iter().zip(shares).map(element).collect();
    let area = |keep: &dyn Fn(&ElementState) -> bool| -> f64 {
        elements.iter().filter(|element| keep(element)).map(|element| element.area_m2).sum()
    };
    let saturation = area(&|element| element.phase == FluidPhase::Wetting) / area(&|_| true);
    let pressure = if pressure.is_finite() { pressure } else { start.capillary_pressure_pa };
    let applied = depth.map_or(pressure / tension, |depth| depth.plane(pressure / tension));
    NetworkState {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        note: NOTE.to_owned(),
        tension_n_per_m: tension,
        applied_curvature_per_m: applied,
        capillary_pressure_pa: pressure,
        largest_applied_curvature_per_m: Some(applied),
        saturation,
        saturation_with_menisci: None,
        elements,
        menisci: Vec::new(),
        snapped_throats: Vec::new(),
        invading_outline: Vec::new(),
        ..start.clone()
    }
}

/// Numbers of wetting and non-wetting particles in each element.
fn shares(start: &NetworkState, fluid: impl Iterator<Item = (Vec2, Phase)>) -> Vec<[usize; 2]> {
    let boundaries = start.elements.iter().map(|element| NetworkState::curves(&element.boundary)).collect();
    let elements = Elements::new(boundaries, start.images());
    let mut shares = vec![[0; 2]; start.elements.len()];
    for (x, phase) in fluid {
        if let Some(element) = elements.at(x) {
            shares[element][usize::from(phase == Phase::NonWetting)] += 1;
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_case::Side;

    /// Two square elements side by side, the left one invaded.
    fn start() -> NetworkState {
        let square = |x: f64, phase| ElementState {
            phase,
            trapped: true,
            trapped_curvature_per_m: Some(1.0),
            area_m2: 1.0,
            // Clockwise, so that the pore is on the right.
            boundary: vec![
                vec![x, 0.0, x, 1.0],
                vec![x, 1.0, x + 1.0, 1.0],
                vec![x + 1.0, 1.0, x + 1.0, 0.0],
                vec![x + 1.0, 0.0, x, 0.0],
            ],
        };
        NetworkState {
            domain_m: [[0.0, 0.0], [2.0, 1.0]],
            tension_n_per_m: 1.0,
            elements: vec![square(0.0, FluidPhase::NonWetting), square(1.0, FluidPhase::Wetting)],
            ..empty()
        }
    }

    /// A state without elements in a domain of zero size.
    fn empty() -> NetworkState {
        NetworkState {
            format: 1,
            version: String::new(),
            note: String::new(),
            geometry_hash: String::new(),
            domain_m: [[0.0; 2]; 2],
            sides: [Side::Wall; 4],
            invading: FluidPhase::NonWetting,
            half_cycle: 1,
            events: 0,
            tension_n_per_m: 0.0,
            applied_curvature_per_m: 0.0,
            capillary_pressure_pa: 0.0,
            largest_applied_curvature_per_m: None,
            contact_angles_deg: [0.0; 2],
            saturation: 0.0,
            saturation_with_menisci: None,
            elements: Vec::new(),
            menisci: Vec::new(),
            snapped_throats: Vec::new(),
            invading_outline: Vec::new(),
        }
    }

    #[test]
    fn an_element_belongs_to_the_phase_of_more_than_half_of_its_particles() {
        let at = |x: f64, phase| (Vec2::new(x, 0.5), phase);
        let (wet, dry) = (Phase::Wetting, Phase::NonWetting);
        let fluid = [at(0.2, wet), at(0.4, wet), at(0.6, dry), at(1.2, dry), at(1.4, dry), at(1.6, wet)];
        let state = state(&start(), 2.0, None, fluid.into_iter(), 6.0);
        let phases: Vec<FluidPhase> = state.elements.iter().map(|element| element.phase).collect();
        assert_eq!(phases, [FluidPhase::Wetting, FluidPhase::NonWetting]);
        assert!(state.elements.iter().all(|element| !element.trapped));
        assert_eq!((state.saturation, state.applied_curvature_per_m), (0.5, 3.0));
    }

    #[test]
    fn an_element_without_particles_keeps_its_phase() {
        let state = state(&start(), 1.0, None, std::iter::empty(), f64::NAN);
        assert_eq!(state.elements[0].phase, FluidPhase::NonWetting);
        assert_eq!(state.elements[1].phase, FluidPhase::Wetting);
    }
}
