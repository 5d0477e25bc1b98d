//! What is known of a network, as its writers read it: what stands still, and the displacement in it.

use std::cell::OnceCell;
use std::sync::Arc;

use super::conductance::conductances;
use super::cycles::Cycles;
use super::displacement::{Conditions, Displacement};
use super::graph::{Network, Pores};
use crate::case::Side;
use crate::math::Bounds;
use crate::snapshot::Lines;

/// What stands still: the network and what is known of its walls and fluids.
#[derive(Debug, Clone)]
pub struct Setting {
    /// The network.
    pub network: Arc<Network>,
    /// Its regions joined to pores.
    pub pores: Arc<Pores>,
    /// The domain.
    pub bounds: Bounds,
    /// Whether it is joined along x and y.
    pub periodic: [bool; 2],
    /// The side that is the inlet: left, right, bottom, top are 0 to 3.
    pub inlet: Option<usize>,
    /// The side that is the outlet.
    pub outlet: Option<usize>,
    /// The walls, for pictures.
    pub outline: Lines<'static>,
    /// Pore area over the area of the domain.
    pub porosity: f64,
    /// Interfacial tension in N/m.
    pub tension: Option<f64>,
    /// Viscosities of the wetting and the non-wetting phase in Pa s, where they are given.
    pub viscosities: [Option<f64>; 2],
    /// Conditions of a drainage, for entry pressures.
    pub entry: Option<Conditions>,
    /// The hash of the geometry in hexadecimal digits.
    pub geometry_hash: String,
    /// The left, right, bottom and top side.
    pub sides: [Side; 4],
}

/// A network with its displacement, and what is found from it once.
#[derive(Debug, Clone)]
pub(crate) struct Model {
    /// What stands still.
    pub(crate) setting: Setting,
    /// The displacement; none where the network is extracted only.
    pub(crate) cycles: Option<Cycles>,
    entry_curvatures: OnceCell<Vec<f64>>,
    conductances: OnceCell<Vec<f64>>,
}

impl Model {
    /// A network with nothing displaced yet.
    pub(crate) fn new(setting: Setting, cycles: Option<Cycles>) -> Self {
        Self { setting, cycles, entry_curvatures: OnceCell::new(), conductances: OnceCell::new() }
    }

    /// Curvatures at which drainage enters the throats of the network, in 1/m; none where no angle is known.
    pub(crate) fn entry_curvatures(&self) -> Option<&[f64]> {
        let Setting { network, pores, entry, .. } = &self.setting;
        let conditions = entry.as_ref()?;
        let throats = network.throats.len();
        let find = || {
            let known = self.cycles.as_ref().map(Cycles::displacement).filter(|it| it.events() == conditions.events);
            let new = || Displacement::new(network, pores, conditions.clone()).entry_curvatures(conditions, throats);
            known.map_or_else(new, |displacement| displacement.entry_curvatures(conditions, throats))
        };
        Some(self.entry_curvatures.get_or_init(find))
    }

    /// Number of throats of the network whose measured entry pressure takes the place of that of the formula under some conditions.
    pub(crate) fn measured_throats(&self, conditions: &Conditions) -> usize {
        let Setting { network, pores, .. } = &self.setting;
        let (throats, formula) = (network.throats.len(), Conditions { measured: Vec::new(), ..conditions.clone() });
        let displacement = Displacement::new(network, pores, formula.clone());
        let [with, without] = [conditions, &formula].map(|given| displacement.entry_curvatures(given, throats));
        with.iter().zip(&without).filter(|(with, without)| with.is_finite() && with != without).count()
    }

    /// The conductances of all throats of the network.
    pub(crate) fn conductances(&self) -> &[f64] {
        self.conductances.get_or_init(|| conductances(&self.setting.network))
    }
}
