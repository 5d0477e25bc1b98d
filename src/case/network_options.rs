//! What a displacement in the network of a drawing needs beside the drawing: the keys of `[network]` that have an option or a parameter of their own.

use serde::Deserialize;

use super::fluid::RawInterface;
use super::network::{RawNetwork, RawNetworkSide, RawNetworkSides, RawProcess};
use super::side::SideName;
use super::wetting::RawWetting;
use crate::input::tables::Words;
use crate::wetting::{Wetting, Young};

/// Tension in N/m where none is given: pressures are then those per N/m of tension.
const UNIT_TENSION: f64 = 1.0;
/// Contact angle in degrees where none is given: the wetting phase wets wholly.
const WHOLLY_WETTING: f64 = 0.0;

/// The keys; what is absent has the default of the case file, but for the two above.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct NetworkOptions {
    /// Persistence ratio above which two maxima of the wall distance are one pore.
    pub(crate) persistence: Option<f64>,
    /// Contact angle through the wetting phase in degrees.
    pub(crate) angle_deg: Option<f64>,
    /// Interfacial tension in N/m.
    pub(crate) tension: Option<f64>,
    /// Side that the invading phase enters through; without one nothing is displaced.
    pub(crate) inlet: Option<SideName>,
    /// Side that the defending phase leaves through.
    pub(crate) outlet: Option<SideName>,
    /// What is displaced.
    pub(crate) process: Option<RawProcess>,
    /// Number of cycles.
    pub(crate) cycles: Option<u32>,
    /// Whether a defending region without a way to the outlet is trapped.
    pub(crate) trapping: Option<bool>,
    /// Whether opposite sides are joined along x and along y.
    pub(crate) periodic: [bool; 2],
    /// Distance of floor and lid in m.
    pub(crate) depth: Option<f64>,
}

impl NetworkOptions {
    /// Whether menisci matter: something is displaced, or entry pressures are asked for.
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

    /// The same as changes of a case file that has `[network]`.
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
