//! Parameters of a displacement in the network of a drawing: the keys of `[network]` that have their own option or parameter.

use serde::Deserialize;

use super::fluid::RawInterface;
use super::network::{
    FilmModel, NetworkResults, RawNetwork, RawNetworkSide, RawNetworkSides, RawProcess, RawRegion, RegionExtent,
};
use super::side::SideName;
use super::wetting::RawWetting;
use meniscus_wetting::{Wetting, Young};

/// Default tension in N/m: pressures are then those per N/m of tension.
const UNIT_TENSION: f64 = 1.0;
/// Default contact angle in degrees: complete wetting.
const WHOLLY_WETTING: f64 = 0.0;

/// The keys; absent ones have the default of the case file, except for the two above.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default, rename_all = "kebab-case")]
pub struct NetworkOptions {
    /// Persistence ratio above which two maxima of the wall distance are one pore.
    pub persistence: Option<f64>,
    /// Contact angle through the wetting phase in degrees.
    pub angle_deg: Option<f64>,
    /// Interfacial tension in N/m.
    pub tension: Option<f64>,
    /// Side through which the invading phase enters; without one there is no displacement.
    pub inlet: Option<SideName>,
    /// Side through which the defending phase leaves.
    pub outlet: Option<SideName>,
    /// The process.
    pub process: Option<RawProcess>,
    /// Number of cycles.
    pub cycles: Option<u32>,
    /// Whether a defending region without a path to the outlet is trapped.
    pub trapping: Option<bool>,
    /// How films in the corners of a chip are connected.
    pub films: Option<FilmModel>,
    /// The region of saturations (default: the pack, where the drawing has manifolds).
    pub region: Option<RegionExtent>,
    /// What is found besides events, curve and measures of the displacement.
    pub results: Option<NetworkResults>,
    /// Whether the domain is periodic along x and along y.
    pub periodic: [bool; 2],
    /// Depth of the chip (distance between floor and lid) in m.
    pub depth: Option<f64>,
}

impl NetworkOptions {
    /// The name of the option that gives the key `path` of a case file.
    pub fn name_of(path: &str) -> String {
        match path.trim_start_matches("network.").trim_start_matches("geometry.") {
            "wetting.young.contact-angle-deg" => "angle-deg".to_owned(),
            "interface.tension" => "tension".to_owned(),
            sides if sides.starts_with("sides") => "periodic".to_owned(),
            other => other.replace(['.', '_'], "-"),
        }
    }

    /// Whether menisci matter: for a displacement, or for entry pressures.
    pub fn has_interface(&self) -> bool {
        self.inlet.is_some() || self.angle_deg.is_some() || self.tension.is_some()
    }

    /// The table `[network]` of a case.
    pub fn table(&self) -> RawNetwork {
        let with_interface = |given: Option<f64>, default| self.has_interface().then(|| given.unwrap_or(default));
        self.keys(with_interface(self.angle_deg, WHOLLY_WETTING), with_interface(self.tension, UNIT_TENSION))
    }

    /// The same as overrides of a case file that has `[network]`.
    pub fn overrides(&self) -> Vec<String> {
        // Numbers, words and tables of them can be written as TOML.
        let keys = toml::Value::try_from(self.keys(self.angle_deg, self.tension));
        let mut overrides = Vec::new();
        collect("network".to_owned(), &keys.unwrap_or(toml::Value::Table(toml::Table::new())), &mut overrides);
        overrides.extend(self.depth.map(|depth| format!("geometry.depth={depth}")));
        overrides
    }

    fn keys(&self, contact_angle_deg: Option<f64>, tension: Option<f64>) -> RawNetwork {
        let [x, y] = self.periodic.map(|is_periodic| is_periodic.then_some(RawNetworkSide::Periodic));
        let young = |contact_angle_deg| RawWetting::of(&Wetting::Young(Young { contact_angle_deg }), None);
        RawNetwork {
            inlet: self.inlet,
            outlet: self.outlet.map(Into::into),
            sides: Some(RawNetworkSides { left: x, right: x, bottom: y, top: y }),
            interface: tension.map(|tension| RawInterface { tension: Some(tension) }),
            wetting: contact_angle_deg.map(young),
            process: self.process,
            cycles: self.cycles,
            trapping: self.trapping,
            films: self.films,
            region: self.region.map(|extent| RawRegion { extent: Some(extent), ..RawRegion::default() }),
            persistence: self.persistence,
            results: self.results,
            ..RawNetwork::default()
        }
    }
}

/// Overrides with the values in a table at the key path `path`.
fn collect(path: String, value: &toml::Value, overrides: &mut Vec<String>) {
    match value {
        toml::Value::Table(table) => {
            table.iter().for_each(|(key, value)| collect(format!("{path}.{key}"), value, overrides))
        }
        value => overrides.push(format!("{path}={value}")),
    }
}
