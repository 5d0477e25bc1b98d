//! A dynamic displacement with its network, for output.

use std::f64::consts::TAU;

use super::Dynamic;
use crate::cycles::{FluidPhase, Invasion};
use crate::model::Model;
use crate::occupation::Occupation;
use crate::pictures::through;

/// A network and the displacement in it.
pub(crate) struct DynamicModel {
    /// The network, without a displacement.
    pub(crate) quasi_static: Model,
    /// The displacement.
    pub(crate) dynamic: Dynamic,
    /// The invading phase.
    pub(crate) invading: FluidPhase,
}

impl DynamicModel {
    /// Pore volumes injected.
    pub(crate) fn injected(&self) -> f64 {
        self.dynamic.state.passed[0] / self.dynamic.space.pore_area
    }

    /// Saturation of the invading phase.
    pub(crate) fn saturation(&self) -> f64 {
        self.dynamic.invading_area() / self.dynamic.space.pore_area
    }

    /// Saturation of the wetting phase.
    pub(crate) fn wetting_saturation(&self) -> f64 {
        self.invading.saturation(self.saturation())
    }

    /// Capillary number μ U/σ: viscosity of the invading phase, U the inflow over the length of the inlet side or around the inlet disc.
    pub(crate) fn capillary_number(&self) -> f64 {
        let (_, inflow) = self.dynamic.drive_now();
        let terms = self.dynamic.terms();
        let config = &self.quasi_static.config;
        let around = config.inlet_disc.map_or(f64::NAN, |disc| TAU * disc.radius);
        let length = config.inlet.map_or(around, |inlet| config.bounds.size()[1 - inlet / 2]);
        terms.viscosity[0] * inflow / (length * terms.tension)
    }

    /// The present state.
    pub(crate) fn occupation(&self) -> Occupation<'_> {
        let displacement = self.dynamic.displacement();
        let towards_wetting =
            |invasion: Invasion| Invasion { applied: self.invading.towards_wetting(invasion.applied), ..invasion };
        Occupation {
            displacement,
            invading: self.invading,
            share: (0..displacement.elements().len()).map(|element| self.dynamic.share(element)).collect(),
            trapped: self.dynamic.trapped(),
            invasions: self.dynamic.invasions().iter().map(|invasion| invasion.map(towards_wetting)).collect(),
            passed: self.dynamic.history().iter().map(|event| event.throat).collect(),
            open: self.quasi_static.config.sides.map(through),
            half_cycle: 0,
            films: None,
        }
    }

    /// Process and progress as text.
    pub(crate) fn progress(&self) -> String {
        format!(
            "{} at t = {:.3e} s: {:.3} pore volumes injected, Ca {:.1e}",
            self.invading.process(),
            self.dynamic.time(),
            self.injected(),
            self.capillary_number()
        )
    }
}
