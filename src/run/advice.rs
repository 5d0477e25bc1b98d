//! Advice on the model: the cost of the network and of a direct simulation of a case's geometry, the dimensionless numbers of its pores, and the resolution of
//! its throats.

use std::time::Instant;

use serde::Serialize;

use super::numbers::{Length, expected_speed};
use super::setup;
use super::trial::Trial;
use meniscus_case::{Case, Model, Sph};
use meniscus_network::graph::Pores;

/// Spacings across a throat from which its entry pressure is accurate (measured: `docs/validation/angles-at-rest.md`).
const ACROSS: f64 = 8.0;
/// Relative rounding error of a width, from the positions of shapes.
const ROUNDING: f64 = 1e-9;
/// Above this capillary number, viscous pressure drops over a few pores change which one is invaded.
const QUASI_STATIC: f64 = 1e-4;
/// Above this Bond number of the largest pore, gravity deforms its menisci by more than a few percent.
const WEIGHTLESS: f64 = 0.1;
/// A direct run of more hours than this deserves a second thought.
const LONG_HOURS: f64 = 24.0;
/// Geometries of more shapes are not partitioned into pores for an advice.
const MOST_SHAPES: usize = 20_000;
/// Persistence ratio above which two maxima of the wall distance count as one pore: the default of `[network]`.
const PERSISTENCE: f64 = 0.95;

/// Properties of a case that guide the choice of the model.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) struct Advice {
    /// Number of pores.
    pub(crate) pores: usize,
    /// Number of throats.
    pub(crate) throats: usize,
    /// Wall time of the extraction in s.
    pub(crate) network_s: f64,
    /// Width of the narrowest throat in m.
    pub(crate) narrowest_throat_m: f64,
    /// Widths of the narrowest and of the median throat relative to the depth of the chip; `None` in the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) widths_over_depth: Option<[f64; 2]>,
    /// Spacing in m of a direct simulation: that of the case, or the one with eight spacings across the narrowest throat.
    pub(crate) spacing_m: f64,
    /// Spacings across the narrowest throat.
    pub(crate) spacings_across: f64,
    /// Throats with fewer than eight spacings across.
    pub(crate) coarse_throats: usize,
    /// Particles of a direct simulation at that spacing.
    pub(crate) particles: f64,
    /// Steps of a direct simulation, if trial steps were done.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) steps: Option<f64>,
    /// Hours of a direct simulation with the present number of threads, if trial steps were done.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) hours: Option<f64>,
    /// Numbers of the smallest, the median and the largest pore.
    pub(crate) numbers: Vec<PoreNumbers>,
    /// Which model is applicable.
    pub(crate) sentence: String,
}

/// Dimensionless numbers of a pore of inscribed radius R.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) struct PoreNumbers {
    /// Which pore: `smallest`, `median`, `largest`.
    pub(crate) pore: &'static str,
    /// R in m.
    pub(crate) radius_m: f64,
    /// Ca = mu U / sigma, U being the prescribed speed, or sqrt(sigma / rho R) if menisci drive the flow.
    pub(crate) capillary: f64,
    /// Oh = mu / sqrt(rho sigma R): viscous forces relative to inertia if menisci drive the flow.
    pub(crate) viscous: f64,
    /// Bo = |rho_w - rho_n| g R² / sigma.
    pub(crate) bond: f64,
}

/// The advice for a case with two fluids and solids that leave throats between them; `trial` is that of its direct simulation.
pub(crate) fn advice(case: &Case, trial: Option<&Trial>) -> Option<Advice> {
    if case.geometry.shapes.is_empty() || case.geometry.shapes.len() > MOST_SHAPES {
        return None;
    }
    let sph = match &case.model {
        Model::Sph(sph) if sph.acting_tension() > 0.0 => Some(sph.as_ref()),
        Model::Network(_) => None,
        _ => return None,
    };
    let trial = trial.filter(|_| sph.is_some());
    let clock = Instant::now();
    let (geometry, open) = (setup::geometry(case).ok()?, case.model.sides()?.open());
    let network = meniscus_network::extract(&geometry, open).ok()?;
    let pores = Pores::merged(&network, PERSISTENCE);
    let network_s = clock.elapsed().as_secs_f64();
    let mut widths: Vec<f64> = pores.throats.iter().map(|&throat| network.throats[throat].width).collect();
    widths.sort_by(f64::total_cmp);
    let narrowest = *widths.first()?;
    let spacing = sph.map_or(narrowest / ACROSS, |sph| sph.spacing);
    let mut radii: Vec<f64> = pores.main_region.iter().map(|&region| network.regions[region].radius).collect();
    radii.sort_by(f64::total_cmp);
    let (smallest, median, largest) = (*radii.first()?, radii[radii.len() / 2], *radii.last()?);
    let pore = |pore, radius_m| sph.map(|sph| numbers(case, sph, pore, radius_m));
    let is_coarse = |width: &&f64| **width < (1.0 - ROUNDING) * ACROSS * spacing;
    let mut advice = Advice {
        pores: pores.main_region.len(),
        throats: widths.len(),
        network_s,
        narrowest_throat_m: narrowest,
        widths_over_depth: case.depth.map(|depth| [narrowest, widths[widths.len() / 2]].map(|width| width / depth)),
        spacing_m: spacing,
        spacings_across: narrowest / spacing,
        coarse_throats: widths.iter().filter(is_coarse).count(),
        particles: trial.map_or_else(
            || (network.regions.iter().map(|region| region.area).sum::<f64>() / (spacing * spacing)).round(),
            |trial| trial.unknowns as f64,
        ),
        steps: trial.map(|trial| trial.steps),
        hours: trial.map(|trial| trial.duration_s / 3600.0),
        numbers: [pore("smallest", smallest), pore("median", median), pore("largest", largest)]
            .into_iter()
            .flatten()
            .collect(),
        sentence: String::new(),
    };
    advice.sentence = sentence(&advice);
    Some(advice)
}

fn numbers(case: &Case, sph: &Sph, pore: &'static str, radius: f64) -> PoreNumbers {
    let (rho, mu, sigma) = (sph.wetting.density, sph.wetting.viscosity, sph.tension);
    let other = sph.non_wetting.map_or(0.0, |fluid| fluid.density);
    let (speed, _) = expected_speed(case, Length { value: radius, name: "inscribed radius" });
    PoreNumbers {
        pore,
        radius_m: radius,
        capillary: mu * speed / sigma,
        viscous: mu / (rho * sigma * radius).sqrt(),
        bond: (rho - other).abs() * sph.gravity.norm() * radius * radius / sigma,
    }
}

/// One sentence: what of the case each model can answer.
fn sentence(advice: &Advice) -> String {
    let largest = advice.numbers.last();
    let across = advice.spacings_across;
    let Advice { throats, coarse_throats: coarse, particles, .. } = *advice;
    if let Some(bond) = largest.map(|pore| pore.bond).filter(|bond| *bond > WEIGHTLESS) {
        return format!(
            "Bo is {bond:.2} in the largest pore, and the network neglects gravity: use the direct simulation"
        );
    }
    if coarse > 0 {
        let spacing = advice.narrowest_throat_m / ACROSS;
        let all = if coarse == throats { "all".to_owned() } else { format!("the {coarse}") };
        return format!(
            "{across:.1} spacings across the narrowest throat at this spacing: use the network, and verify {all} throats below {ACROSS:.0} \
             spacings, or take sph.spacing = {spacing:.1e}"
        );
    }
    match advice.hours {
        Some(hours) if hours > LONG_HOURS => format!(
            "{across:.1} spacings across the narrowest throat, and {hours:.0} hours: use the network, and the direct simulation for single throats \
             and events"
        ),
        Some(_) => format!(
            "{across:.1} spacings across the narrowest throat: the direct simulation is feasible; the network computes quasi-static displacement in {:.1} s \
             (Ca below {QUASI_STATIC:.0e})",
            advice.network_s
        ),
        None => format!(
            "use the network for quasi-static displacement (Ca below {QUASI_STATIC:.0e}); a full direct simulation takes {particles:.1e} particles for \
             {ACROSS:.0} spacings across the narrowest throat"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known() -> Advice {
        Advice {
            pores: 10,
            throats: 20,
            network_s: 0.1,
            narrowest_throat_m: 1e-5,
            widths_over_depth: None,
            spacing_m: 1e-6,
            spacings_across: 10.0,
            coarse_throats: 0,
            particles: 1e4,
            steps: Some(100.0),
            hours: Some(1.0),
            numbers: Vec::new(),
            sentence: String::new(),
        }
    }

    #[test]
    fn the_sentence_names_the_model_that_can_answer() {
        assert!(sentence(&known()).contains("the direct simulation is feasible"));
        let coarse = Advice { spacings_across: 2.0, coarse_throats: 12, ..known() };
        assert!(sentence(&coarse).starts_with(
            "2.0 spacings across the narrowest throat at this spacing: use the network, and verify the 12"
        ));
        assert!(sentence(&Advice { hours: Some(100.0), ..known() }).contains("100 hours: use the network"));
        let pore = PoreNumbers { pore: "largest", radius_m: 1e-3, capillary: 0.1, viscous: 0.1, bond: 2.0 };
        assert!(sentence(&Advice { numbers: vec![pore], ..known() }).contains("neglects gravity"));
        assert!(sentence(&Advice { hours: None, steps: None, ..known() }).starts_with("use the network"));
    }
}
