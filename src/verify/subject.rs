//! The object of verification: a network with its menisci, and its first displacement up to breakthrough.

use std::f64::consts::PI;

use super::fluids::Chip;
use meniscus_case::{Case, Fluid, Model, on_plates};
use meniscus_geometry::interface::depth::Depth;
use meniscus_geometry::interface::menisci::Passage;
use meniscus_network::cycles::{Cycles, Entry, FluidPhase};
use meniscus_network::displacement::{Conditions, Displacement, EventKind};
use meniscus_network::graph::Throat;
use meniscus_network::setup::{SetupError, build_quasi_static};
use meniscus_network::solver::NetworkSolver;

/// A case whose throats cannot be verified.
#[derive(Debug, thiserror::Error)]
pub enum SubjectError {
    /// Another model.
    #[error("throats are those of a network; the case needs [network]")]
    NoNetwork,
    /// No contact angle.
    #[error(
        "the network has no interface, so that no throat has an entry pressure; add [network.interface] and [network.wetting.young]"
    )]
    NoInterface,
    /// The network cannot be extracted.
    #[error(transparent)]
    Setup(#[from] SetupError),
}

/// A network whose throats are to be verified.
#[derive(Debug)]
pub struct Subject {
    /// The network with its tables.
    pub solver: NetworkSolver,
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// The wetting and the non-wetting phase, if the case gives them.
    pub fluids: [Option<Fluid>; 2],
    /// Floor and lid; `None` in the plane.
    pub chip: Option<Chip>,
    /// The phase that invades first.
    pub invading: FluidPhase,
    /// Conditions of the displacement.
    pub conditions: Conditions,
    /// Events of the first half cycle up to breakthrough, and the applied curvature in 1/m then, positive towards the defending phase; `None`
    /// without a displacement or breakthrough.
    pub to_breakthrough: Option<(Vec<Entry>, f64)>,
    /// Throats through which menisci overlapped in the first half cycle.
    pub overlapped: Vec<usize>,
    fresh: Displacement,
}

impl Subject {
    /// The network of a case, after one displacement. Curvatures are those in the plane: floor and lid do not change the order of events.
    pub fn new(case: &Case) -> Result<Self, SubjectError> {
        let Model::Network(wanted) = &case.model else { return Err(SubjectError::NoNetwork) };
        let Some(interface) = &wanted.interface else { return Err(SubjectError::NoInterface) };
        let solver = build_quasi_static(case, wanted)?;
        let half = solver.cycles().map(|cycles| cycles.half_cycles()[0].clone());
        let invading = half.as_ref().map_or(FluidPhase::NonWetting, |half| half.invading);
        let conditions = half.map(|half| half.conditions).or_else(|| solver.config().entry.clone());
        let Some(conditions) = conditions else { return Err(SubjectError::NoInterface) };
        let receding_or_advancing = usize::from(invading == FluidPhase::Wetting);
        let plates = on_plates(&interface.wetting_model, &interface.patches, |model| {
            model.hysteresis_range()[receding_or_advancing]
        });
        let chip = solver.config().depth_for(invading).map(|depth| Chip { plates, depth });
        let history = solver.cycles().map(first_half_cycle).unwrap_or_default();
        let config = solver.config();
        let fresh = Displacement::new(&config.network, &config.pores, conditions.clone());
        let overlaps = history.0.iter().filter(|entry| entry.kind == EventKind::Overlap);
        Ok(Self {
            tension: interface.tension,
            fluids: [wanted.wetting, wanted.non_wetting],
            chip,
            invading,
            conditions,
            overlapped: overlaps.filter_map(|entry| entry.throat).collect(),
            to_breakthrough: history.1.map(|(count, applied)| (history.0[..count].to_vec(), applied)),
            fresh,
            solver,
        })
    }

    /// The throats of the tables, as indices into those of the network.
    pub fn kept(&self) -> &[usize] {
        &self.solver.config().pores.throats
    }

    /// A throat by its index in the network.
    pub fn throat(&self, throat: usize) -> &Throat {
        &self.solver.config().network.throats[throat]
    }

    /// The passage through a throat into its region `to`, and the other walls ahead.
    pub fn passage(&self, throat: usize, to: usize) -> Option<(Passage, Vec<meniscus_geometry::curve::Curve>)> {
        self.fresh.passage_through(throat, to)
    }

    /// The region into which the entry pressure of a throat is larger, and the curvature in 1/m there, as in `throats.csv`.
    pub fn entry(&self, throat: usize) -> Option<(usize, f64)> {
        let burst = |to| Some((to, self.passage(throat, to)?.0.burst()?.curvature));
        [1, 0].into_iter().filter_map(burst).reduce(|best, next| if next.1 > best.1 { next } else { best })
    }

    /// Whether walls of a contact angle through the defending phase (rad) have the corner films of the network, which are the same on all walls.
    pub(crate) fn has_network_films(&self, angle: f64) -> bool {
        let angle = if self.invading == FluidPhase::NonWetting { angle } else { PI - angle };
        self.chip.is_none_or(|Chip { plates, depth }| Depth::new(depth.distance(), angle, plates).has_films_of(&depth))
    }

    /// Hash of the geometry, as in `network.json`.
    pub(crate) fn geometry_hash(&self) -> &str {
        &self.solver.config().geometry_hash
    }
}

/// The events of the first half cycle, their number up to breakthrough, and the applied curvature in 1/m then.
fn first_half_cycle(cycles: &Cycles) -> (Vec<Entry>, Option<(usize, f64)>) {
    let mut cycles = cycles.clone();
    let sign = cycles.half_cycle().invading.towards_wetting(1.0);
    let mut breakthrough = None;
    while cycles.half_cycle_index() == 0 && cycles.advance().is_some() {
        let events = cycles.history().iter().filter(|entry| entry.half_cycle == 0).count();
        let reached = cycles.record.outcomes.first().and_then(|outcome| outcome.breakthrough);
        if let (None, Some((applied, _))) = (breakthrough, reached) {
            breakthrough = Some((events, sign * applied));
        }
    }
    let first = cycles.history().iter().filter(|entry| entry.half_cycle == 0).copied().collect();
    (first, breakthrough.filter(|(_, applied)| applied.is_finite()))
}
