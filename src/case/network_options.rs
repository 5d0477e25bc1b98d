//! Parameters of a displacement in the network of a drawing: the keys of `[network]` that have their own option or parameter.

use serde::Deserialize;

use super::fluid::RawInterface;
use super::network::{RawNetwork, RawNetworkSide, RawNetworkSides, RawProcess};
use super::side::SideName;
use super::wetting::RawWetting;
use crate::input::tables::Words;
use crate::wetting::{Wetting, Young};

/// Default tension in N/m: pressures are then those per N/m of tension.
const UNIT_TENSION: f64 = 1.0;
/// Default contact angle in degrees: complete wetting.
const WHOLLY_WETTING: f64 = 0.0;

/// The keys; absent ones have the default of the case file, except for the two above.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default, rename_all = "kebab-case")]
pub struct NetworkOptions {
    /// Persistence ratio above which two maxima of the wall distance are one pore.
    pub(crate) persistence: Option<f64>,
    /// Contact angle through the wetting phase in degrees.
    pub(crate) angle_deg: Option<f64>,
    /// Interfacial tension in N/m.
    pub(crate) tension: Option<f64>,
    /// Side through which the invading phase enters; without one there is no displacement.
    pub(crate) inlet: Option<SideName>,
    /// Side through which the defending phase leaves.
    pub(crate) outlet: Option<SideName>,
    /// The process.
    pub(crate) process: Option<RawProcess>,
    /// Number of cycles.
    pub(crate) cycles: Option<u32>,
    /// Whether a defending region without a path to the outlet is trapped.
    pub(crate) trapping: Option<bool>,
    /// Whether the domain is periodic along x and along y.
    pub(crate) periodic: [bool; 2],
    /// Depth of the chip (distance between floor and lid) in m.
    pub(crate) depth: Option<f64>,
}

impl NetworkOptions {
    /// Whether menisci matter: for a displacement, or for entry pressures.
    pub(crate) fn has_interface(&self) -> bool {
        self.inlet.is_some() || self.angle_deg.is_some() || self.tension.is_some()
    }

    /// The table `[network]` of a case.
    pub(crate) fn table(&self) -> RawNetwork {
        let [x, y] = self.periodic.map(|is_periodic| is_periodic.then_some(RawNetworkSide::Periodic));
        let contact_angle_deg = self.angle_deg.unwrap_or(WHOLLY_WETTING);
        let has_interface = self.has_interface();
        RawNetwork {
            inlet: self.inlet,
            outlet: self.outlet,
            sides: Some(RawNetworkSides { left: x, right: x, bottom: y, top: y }),
            interface: has_interface.then(|| RawInterface { tension: Some(self.tension.unwrap_or(UNIT_TENSION)) }),
            wetting: has_interface.then(|| RawWetting::of(&Wetting::Young(Young { contact_angle_deg }), None)),
            process: self.process,
            cycles: self.cycles,
            trapping: self.trapping,
            persistence: self.persistence,
            ..RawNetwork::default()
        }
    }

    /// The same as overrides of a case file that has `[network]`.
    pub(crate) fn overrides(&self) -> Vec<String> {
        let name = |side: SideName| format!("\"{}\"", side.word());
        let process = |process: RawProcess| format!("\"{}\"", process.word());
        let given = [
            ("persistence", self.persistence.map(|value| value.to_string())),
            ("wetting.young.contact-angle-deg", self.angle_deg.map(|value| value.to_string())),
            ("interface.tension", self.tension.map(|value| value.to_string())),
            ("inlet", self.inlet.map(name)),
            ("outlet", self.outlet.map(name)),
            ("process", self.process.map(process)),
            ("cycles", self.cycles.map(|value| value.to_string())),
            ("trapping", self.trapping.map(|value| value.to_string())),
        ];
        let given = given.into_iter().filter_map(|(key, value)| Some(format!("network.{key}={}", value?)));
        let given = given.chain(self.depth.map(|depth| format!("geometry.depth={depth}")));
        let axes = [["left", "right"], ["bottom", "top"]].into_iter().zip(self.periodic);
        let periodic = axes.filter(|(_, is_periodic)| *is_periodic).flat_map(|(sides, _)| sides);
        given.chain(periodic.map(|side| format!("network.sides.{side}=\"periodic\""))).collect()
    }
}
