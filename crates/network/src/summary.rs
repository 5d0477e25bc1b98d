//! The state of pores from that of their elements, and `network.json`: metadata and parameters of the tables.

use serde::Serialize;

use super::cycles::{Cycles, FluidPhase, Invasion};
use super::model::{Configuration, Model};
use super::occupation::Occupation;
use meniscus_core::table::Document;

/// The state of one pore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PoreState {
    /// The phase of more than half of its area.
    pub(crate) fluid: FluidPhase,
    /// The event of the present half cycle after which the invading phase holds more than half of it.
    pub(crate) invasion: Option<Invasion>,
    /// Whether more than half of it is trapped.
    pub(crate) is_trapped: bool,
}

/// The present states of all pores.
pub(crate) fn pore_states(config: &Configuration, occupation: &Occupation) -> Vec<PoreState> {
    let mut elements_of: Vec<Vec<usize>> = vec![Vec::new(); config.pores.main_region.len()];
    for (index, element) in occupation.elements().iter().enumerate() {
        elements_of[config.pores.pore_of[element.region]].push(index);
    }
    elements_of.iter().map(|elements| state(occupation, elements)).collect()
}

/// Number of pores invaded in the present half cycle.
pub(crate) fn invaded_pores(config: &Configuration, occupation: &Occupation) -> usize {
    let mut filled = vec![[0.0; 2]; config.pores.main_region.len()];
    for (index, element) in occupation.elements().iter().enumerate() {
        let [before, now] = &mut filled[config.pores.pore_of[element.region]];
        match occupation.invasions[index] {
            Some(_) if occupation.is_invaded(index) => *now += element.area,
            None if occupation.is_invaded(index) => *before += element.area,
            _ => {}
        }
    }
    let halves = config.pores.area.iter().map(|area| 0.5 * area);
    filled.iter().zip(halves).filter(|([before, now], half)| before <= half && before + now > *half).count()
}

fn state(occupation: &Occupation, elements: &[usize]) -> PoreState {
    let area = |element: usize| occupation.elements()[element].area;
    let sum = |keep: &dyn Fn(usize) -> bool| elements.iter().filter(|&&e| keep(e)).map(|&e| area(e)).sum::<f64>();
    let half = 0.5 * sum(&|_| true);
    let is_invaded = sum(&|e| occupation.is_invaded(e)) > half;
    // In time, an element that a meniscus has entered is not filled yet.
    let invasion_of = |&e: &usize| occupation.invasions[e].filter(|_| occupation.is_invaded(e));
    let mut filled: Vec<(Invasion, f64)> = elements.iter().filter_map(|e| Some((invasion_of(e)?, area(*e)))).collect();
    filled.sort_by_key(|(invasion, _)| invasion.sequence);
    // Invading phase in it before this half cycle.
    let mut held = sum(&|e| occupation.is_invaded(e) && occupation.invasions[e].is_none());
    let mut invasion = None;
    for (event, area) in filled {
        if held <= half && held + area > half {
            invasion = Some(event);
        }
        held += area;
    }
    PoreState {
        fluid: if is_invaded { occupation.invading } else { occupation.invading.other() },
        invasion,
        is_trapped: sum(&|e| occupation.trapped[e]) > half,
    }
}

/// The content of `network.json`.
#[derive(Serialize)]
struct Description<'a> {
    version: &'static str,
    persistence: f64,
    geometry_hash: String,
    domain_m: [[f64; 2]; 2],
    periodic: [bool; 2],
    inlet: Option<String>,
    outlet: Option<String>,
    tension_n_per_m: Option<f64>,
    viscosity_pa_s: [Option<f64>; 2],
    pores: usize,
    throats: usize,
    regions: usize,
    porosity: f64,
    units: &'static str,
    definitions: Definitions,
    half_cycles: Vec<HalfCycleDescription<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    merges: Option<Merges<'a>>,
}

#[derive(Serialize)]
struct Definitions {
    pore: &'static str,
    throat: &'static str,
    persistence: &'static str,
    area: &'static str,
    length: &'static str,
    curvature: &'static str,
    conductance: &'static str,
    entry_pressure: &'static str,
    sequence: &'static str,
    trapped: &'static str,
    openpnm: &'static str,
}

const DEFINITIONS: Definitions = Definitions {
    pore: "a local maximum of the distance to the nearest wall; its inscribed radius is that distance",
    throat: "a saddle of the distance to the nearest wall; its width is twice that distance, its chord joins both contacts and separates the pores",
    persistence: "a throat is dissolved where its half width exceeds this share of the smaller inscribed radius",
    area: "of the pore region between walls and chords, in closed form; a volume per depth",
    length: "from pore center to pore center through the middle of the throat",
    curvature: "of the walls at both contacts, above 0 where the solid is convex; empty at an edge",
    conductance: "flow per depth times viscosity over pressure difference, by lubrication along arcs that meet both walls at right angles, from pore center to pore center; permeabilities are within 5 % of Stokes flow for random packs above a solid fraction of 0.3",
    entry_pressure: "tension times the largest curvature of a meniscus that passes the throat in drainage, at the receding angle",
    sequence: "number of the event, from 1 on in the last half cycle, by which the invading phase came to hold more than half of the pore; 0 for what is filled at the beginning through an opening of the inlet; empty where none did",
    trapped: "more than half of the pore holds defending phase without a path to the outlet",
    openpnm: "openpnm.csv is for a depth of 1 m: volumes are areas times 1 m, cross sections widths times 1 m, and conductances those of the viscosity of the wetting phase, 1 Pa s where none is given",
};

#[derive(Serialize)]
struct HalfCycleDescription<'a> {
    process: &'a str,
    invading: &'a str,
    events: usize,
    saturation_before: f64,
    saturation_after: f64,
}

/// Sufficient data to merge again with another ratio.
#[derive(Serialize)]
struct Merges<'a> {
    note: &'static str,
    region_pore: &'a [usize],
    region_radius_m: Vec<f64>,
    region_area_m2: Vec<f64>,
    throat_regions: Vec<[usize; 2]>,
    throat_width_m: Vec<f64>,
}

const MERGES: &str = "the network before the merge: regions with their pore, and all throats between regions; going through the throats \
                      from wide to narrow, one is dissolved where its half width exceeds the persistence ratio times the smaller of \
                      both radii, and the joined pore keeps the larger one";

/// `network.json`.
pub(crate) fn network_json(model: &Model) -> Document<'_> {
    Document::new("network.json", |to| {
        serde_json::to_writer(&mut *to, &description(model))?;
        to.write_all(b"\n")
    })
}

fn description(model: &Model) -> Description<'_> {
    let config = &model.config;
    let (network, pores) = (&config.network, &config.pores);
    let [inlet, outlet] = config.ends();
    // Non-finite numbers become null.
    Description {
        version: env!("CARGO_PKG_VERSION"),
        persistence: pores.persistence,
        geometry_hash: config.geometry_hash.clone(),
        domain_m: [config.bounds.min.into(), config.bounds.max.into()],
        periodic: config.periodic,
        inlet,
        outlet,
        tension_n_per_m: config.tension,
        viscosity_pa_s: config.viscosities,
        pores: pores.main_region.len(),
        throats: pores.throats.len(),
        regions: network.regions.len(),
        porosity: config.porosity,
        units: "SI; the unit is at the end of each column name of pores.csv and throats.csv",
        definitions: DEFINITIONS,
        half_cycles: model.cycles.as_ref().map_or_else(Vec::new, half_cycles),
        merges: config.is_whole().then(|| Merges {
            note: MERGES,
            region_pore: &pores.pore_of,
            region_radius_m: network.regions.iter().map(|region| region.radius).collect(),
            region_area_m2: network.regions.iter().map(|region| region.area).collect(),
            throat_regions: network.throats.iter().map(|throat| throat.regions).collect(),
            throat_width_m: network.throats.iter().map(|throat| throat.width).collect(),
        }),
    }
}

fn half_cycles(cycles: &Cycles) -> Vec<HalfCycleDescription<'_>> {
    let outcomes = &cycles.record.outcomes;
    let after = |index: usize| outcomes.get(index + 1).map_or(cycles.saturation(), |next| next.first_saturation[0]);
    outcomes
        .iter()
        .zip(cycles.half_cycles())
        .enumerate()
        .map(|(index, (outcome, half))| HalfCycleDescription {
            process: half.invading.process(),
            invading: half.invading.name(),
            events: outcome.events,
            saturation_before: outcome.first_saturation[0],
            saturation_after: after(index),
        })
        .collect()
}
