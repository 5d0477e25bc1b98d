//! The fluids: `[sph.phases]`, `[network.phases]` and `[thin-film.fluid]`, and the tension between them.

use super::preset::{COLD, Preset, Properties, WARM};
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, tables, words};

tables! {
    /// The fluids.
    pub struct RawPhases {
        /// Phase through which contact angles are measured (required in `[sph]`).
        pub wetting: RawFluid,
        /// The other phase.
        pub non_wetting: RawFluid,
    }

    /// A Newtonian fluid, by name or by its properties; a property given in addition to a name overrides that of the preset.
    pub struct RawFluid {
        /// Fluid with known properties.
        pub preset: Preset,
        /// Temperature of the preset in °C (default 20).
        pub temperature_c: f64 => Key::within("a temperature in degrees Celsius", COLD, WARM),
        /// Density in kg/m³; the density ratio is 1e-4 to 1e4 (default: that of the preset).
        pub density: f64 => Key::positive("a density in kg/m3"),
        /// Dynamic viscosity in Pa s (default: that of the preset).
        pub viscosity: f64 => Key::positive("a viscosity in Pa s"),
    }

    /// The interface between the fluids.
    pub struct RawInterface {
        /// Interfacial tension in N/m; above 0 in a network (required with two fluids).
        pub tension: f64 => Key::not_negative("a tension in N/m"),
    }
}

words! {
    /// A phase.
    pub enum FluidPhase {
        /// The phase through which contact angles are measured.
        Wetting,
        /// The other phase.
        NonWetting,
    }
}

impl FluidPhase {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wetting => "wetting",
            Self::NonWetting => "non-wetting",
        }
    }

    /// Converts a `curvature` (1/m) of menisci, positive into the defending phase while this fluid invades, to one that is positive into the
    /// wetting phase, so that tension times it is p_n - p_w.
    pub fn towards_wetting(self, curvature: f64) -> f64 {
        match self {
            Self::NonWetting => curvature,
            Self::Wetting => -curvature,
        }
    }

    /// `drainage` or `imbibition`: the process in which this fluid invades.
    pub fn process(self) -> &'static str {
        match self {
            Self::NonWetting => "drainage",
            Self::Wetting => "imbibition",
        }
    }

    /// The saturation of this fluid from that of the wetting one, or back.
    pub fn saturation(self, wetting: f64) -> f64 {
        match self {
            Self::NonWetting => 1.0 - wetting,
            Self::Wetting => wetting,
        }
    }

    /// The other fluid.
    pub fn other(self) -> Self {
        match self {
            Self::Wetting => Self::NonWetting,
            Self::NonWetting => Self::Wetting,
        }
    }
}

/// A Newtonian fluid.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Fluid {
    /// Density in kg/m³.
    pub density: f64,
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
}

impl RawFluid {
    /// The properties of the preset, if there is one.
    pub(crate) fn properties(&self) -> Option<Properties> {
        self.preset.map(|preset| preset.at(self.temperature_c.unwrap_or(COLD)))
    }
}

impl From<Fluid> for RawFluid {
    fn from(fluid: Fluid) -> Self {
        Self { density: Some(fluid.density), viscosity: Some(fluid.viscosity), ..Self::default() }
    }
}

/// Largest ratio of densities for which the pressure solve is known to converge.
const LARGEST_DENSITY_RATIO: f64 = 1.0e4;

/// The fluid of the table at the key path `at`, `None` if it is wrong; the table then has its properties in place of a preset.
pub(super) fn fluid(checker: &mut Checker, at: &str, raw: &mut RawFluid) -> Option<Fluid> {
    let path = format!("{at}.temperature-c");
    if checker.is_given(&path, raw.temperature_c.as_ref()) && raw.preset.is_none() {
        checker.refuse(
            path,
            "a temperature needs a preset",
            "add `preset`, or give the density and viscosity at that temperature",
        );
    }
    let is_given = raw.preset.is_some() || raw.density.is_some() || raw.viscosity.is_some();
    if !is_given && !checker.is_refused(at) {
        let help = "add preset = \"water\", or density in kg/m3 and viscosity in Pa s";
        checker.refuse(format!("{at}.preset"), format!("expected a fluid in [{at}], found no property"), help);
        return None;
    }
    let preset = raw.properties();
    let density = raw.density.or(preset.map(|preset| preset.density));
    let viscosity = raw.viscosity.or(preset.map(|preset| preset.viscosity));
    let density = checker.require(&format!("{at}.density"), density, "density = 998.2 # kg/m3");
    let viscosity = checker.require(&format!("{at}.viscosity"), viscosity, "viscosity = 1.0e-3 # Pa s");
    let fluid = Fluid { density: density?, viscosity: viscosity? };
    *raw = fluid.into();
    Some(fluid)
}

/// Refuses densities too far apart.
pub(super) fn density_ratio(checker: &mut Checker, wetting: &Fluid, other: &Fluid) {
    let ratio = wetting.density / other.density;
    if !(1.0 / LARGEST_DENSITY_RATIO..=LARGEST_DENSITY_RATIO).contains(&ratio) {
        checker.refuse(
            "sph.phases.non-wetting.density",
            format!("the density ratio of the phases is {ratio:.3e}, expected 1e-4 to 1e4"),
            "densities are in kg/m3: water has 998, air 1.2",
        );
    }
}
