//! The data of a network for output: its static configuration and its displacement.

use std::sync::{Arc, OnceLock};

use super::conductance::conductances;
use super::cycles::{Cycles, FluidPhase};
use super::displacement::{Conditions, Displacement};
use super::graph::{Network, Pores};
use super::gravity::Gravity;
use meniscus_case::network::{FilmModel, InletDisc, NetworkResults};
use meniscus_case::{SIDES, Side};
use meniscus_core::math::Bounds;
use meniscus_core::snapshot::Lines;
use meniscus_geometry::interface::depth::Depth;

/// The static configuration: the network, its walls and fluids.
#[derive(Debug, Clone)]
pub struct Configuration {
    /// The network.
    pub network: Arc<Network>,
    /// Its regions joined to pores.
    pub pores: Arc<Pores>,
    /// The domain.
    pub bounds: Bounds,
    /// Whether it is periodic along x and y.
    pub periodic: [bool; 2],
    /// The side that is the inlet: left, right, bottom, top are 0 to 3.
    pub inlet: Option<usize>,
    /// The disc that is the inlet in place of a side.
    pub inlet_disc: Option<InletDisc>,
    /// The regions of which it covers a part.
    pub(crate) inlet_regions: Vec<usize>,
    /// Whether the left, right, bottom and top side is an outlet.
    pub outlet: [bool; 4],
    /// The walls, for pictures.
    pub outline: Arc<Lines<'static>>,
    /// Porosity: pore area over the area of the domain or of its region.
    pub porosity: f64,
    /// Interfacial tension in N/m.
    pub tension: Option<f64>,
    /// Floor and lid with the angles for invasion by the non-wetting and by the wetting phase; `None` in the plane.
    pub depth: Option<[Depth; 2]>,
    /// Viscosities of the wetting and the non-wetting phase in Pa s, if given.
    pub viscosities: [Option<f64>; 2],
    /// Conditions of a drainage, for entry pressures.
    pub entry: Option<Conditions>,
    /// The hash of the geometry in hexadecimal digits.
    pub geometry_hash: String,
    /// The left, right, bottom and top side.
    pub sides: [Side; 4],
    /// Gravity for the phase that invades first, if it acts.
    pub gravity: Option<Gravity>,
    /// The region of saturations and porosity, if it is not the whole domain.
    pub region: Option<Bounds>,
    /// What is found besides events, curve and measures of the displacement.
    pub results: NetworkResults,
    /// What follows from the network alone.
    pub(crate) derived: Arc<Derived>,
}

impl Configuration {
    /// Whether all is found, with tables and fields of pores and throats.
    pub(crate) fn is_whole(&self) -> bool {
        self.results == NetworkResults::All
    }

    /// Capillary pressure p_n - p_w in Pa during invasion by a phase, at a meniscus of this curvature in the plane (1/m), positive if it bulges
    /// into the wetting phase; NaN without a tension.
    pub fn pressure(&self, invading: FluidPhase, curvature: f64) -> f64 {
        self.tension.unwrap_or(f64::NAN) * self.curvature(invading, curvature)
    }

    /// (p_n - p_w)/σ in 1/m of such a meniscus, including the curvature by floor and lid.
    pub(crate) fn curvature(&self, invading: FluidPhase, in_plane: f64) -> f64 {
        self.depth_for(invading).map_or(in_plane, |depth| depth.curvature(in_plane))
    }

    /// Floor and lid with the angles for an invading phase; `None` in the plane.
    pub fn depth_for(&self, invading: FluidPhase) -> Option<Depth> {
        self.depth.map(|[drainage, imbibition]| if invading == FluidPhase::Wetting { imbibition } else { drainage })
    }

    /// Whether there is an outlet.
    pub(crate) fn has_outlet(&self) -> bool {
        self.outlet.contains(&true)
    }

    /// Whether each region opens at the inlet.
    pub(crate) fn at_inlet(&self) -> Vec<bool> {
        let mut opens = self.opens_at(|side| Some(side) == self.inlet);
        self.inlet_regions.iter().for_each(|&region| opens[region] = true);
        opens
    }

    /// Whether each region opens at the outlet.
    pub(crate) fn at_outlet(&self) -> Vec<bool> {
        self.opens_at(|side| self.outlet[side])
    }

    fn opens_at(&self, is_open: impl Fn(usize) -> bool) -> Vec<bool> {
        let mut opens = vec![false; self.network.regions.len()];
        let openings = self.network.openings.iter().filter(|opening| is_open(opening.side));
        openings.for_each(|opening| opens[opening.region] = true);
        opens
    }

    /// The inlet and the outlet by name.
    pub(crate) fn ends(&self) -> [Option<String>; 2] {
        let disc = self.inlet_disc.map(|_| "disc".to_owned());
        let outlet: Vec<&str> =
            SIDES.into_iter().zip(self.outlet).filter(|(_, is)| *is).map(|(name, _)| name).collect();
        let inlet = self.inlet.map(|side| SIDES[side].to_owned());
        [inlet.or(disc), self.has_outlet().then(|| outlet.join(", "))]
    }

    /// The length of a period along x and y in m; `None` if not periodic.
    pub(crate) fn periods(&self) -> [Option<f64>; 2] {
        [0, 1].map(|axis| self.periodic[axis].then(|| self.bounds.size()[axis]))
    }

    /// The reference of saturations, as text.
    pub(crate) fn space(&self) -> &'static str {
        if self.region.is_some() { "pore space of network.region without manifolds" } else { "pore space" }
    }

    /// Distance between floor and lid in m; 1 in the plane, where volumes and rates are per meter of depth.
    pub(crate) fn thickness(&self) -> f64 {
        self.network.depth.unwrap_or(1.0)
    }
}

/// What follows from a network alone and takes long, found when it is first asked for and shared by all cases of the network.
#[derive(Debug, Default)]
pub(crate) struct Derived {
    /// The conductances of all throats.
    conductances: OnceLock<Vec<f64>>,
    /// The permeabilities along x and y.
    pub(super) permeabilities: [OnceLock<f64>; 2],
}

/// A network with its displacement and cached derived quantities.
#[derive(Debug, Clone)]
pub(crate) struct Model {
    /// The static configuration.
    pub(crate) config: Configuration,
    /// The displacement; `None` if the network is only extracted.
    pub(crate) cycles: Option<Cycles>,
    entry_curvatures: OnceLock<Vec<f64>>,
    trapped_otherwise: OnceLock<Vec<(FilmModel, f64)>>,
    /// Wetting saturation and relative permeabilities after a number of steps.
    pub(super) relative_at_end: OnceLock<(u64, Option<[f64; 3]>)>,
}

impl Model {
    /// A network in its initial state.
    pub(crate) fn new(config: Configuration, cycles: Option<Cycles>) -> Self {
        Self {
            config,
            cycles,
            entry_curvatures: OnceLock::new(),
            trapped_otherwise: OnceLock::new(),
            relative_at_end: OnceLock::new(),
        }
    }

    /// Entry curvatures of the throats of the network in drainage, in 1/m; `None` without a contact angle.
    pub(crate) fn entry_curvatures(&self) -> Option<&[f64]> {
        let Configuration { network, pores, entry, .. } = &self.config;
        let conditions = entry.as_ref()?;
        let throats = network.throats.len();
        let find = || {
            let known =
                self.cycles.as_ref().map(|cycles| &cycles.displacement).filter(|it| it.events() == conditions.events);
            let new = || Displacement::new(network, pores, conditions.clone()).entry_curvatures(conditions, throats);
            known.map_or_else(new, |displacement| displacement.entry_curvatures(conditions, throats))
        };
        Some(self.entry_curvatures.get_or_init(find))
    }

    /// Trapped saturation with corner films that are connected in the two other ways; empty if no corner holds any.
    pub(crate) fn trapped_otherwise(&self) -> &[(FilmModel, f64)] {
        let find = || {
            let Some((cycles, present)) = self.cycles.as_ref().and_then(|cycles| Some((cycles, cycles.film_model()?)))
            else {
                return Vec::new();
            };
            let others =
                [FilmModel::None, FilmModel::Rings, FilmModel::Joined].into_iter().filter(|model| *model != present);
            let Configuration { network, pores, .. } = &self.config;
            others.filter_map(|model| Some((model, cycles.trapped_with(network, pores, model)?))).collect()
        };
        self.trapped_otherwise.get_or_init(find)
    }

    /// Number of throats of the network whose measured entry pressure replaces the formula under given conditions.
    pub(crate) fn measured_throats(&self, conditions: &Conditions) -> usize {
        let Configuration { network, pores, .. } = &self.config;
        let (throats, formula) = (network.throats.len(), Conditions { measured: Vec::new(), ..conditions.clone() });
        let displacement = Displacement::new(network, pores, formula.clone());
        let [with, without] = [conditions, &formula].map(|given| displacement.entry_curvatures(given, throats));
        with.iter().zip(&without).filter(|(with, without)| with.is_finite() && with != without).count()
    }

    /// Entry pressures in Pa of all throats of the network; `None` without a contact angle or tension.
    pub(crate) fn entry_pressures(&self) -> Option<Vec<f64>> {
        self.config.tension?;
        let pressure = |&curvature: &f64| self.config.pressure(FluidPhase::NonWetting, curvature);
        Some(self.entry_curvatures()?.iter().map(pressure).collect())
    }

    /// The conductances of all throats of the network.
    pub(crate) fn conductances(&self) -> &[f64] {
        self.config.derived.conductances.get_or_init(|| conductances(&self.config.network))
    }
}
