//! The fluids: `[sph.phases]`, `[network.phases]` and `[thin-film.fluid]`, and the tension between them.

use super::preset::{Preset, Properties, State, Unknown, between, named};
use meniscus_core::input::Checker;
use meniscus_core::input::tables::{Key, Words, tables, words};

tables! {
    /// The fluids.
    pub struct RawPhases {
        /// Phase through which contact angles are measured (required in `[sph]`).
        pub wetting: RawFluid,
        /// The other phase.
        pub non_wetting: RawFluid,
    }

    /// A Newtonian fluid, by name or by its properties; a property given in addition to a name overrides that of the preset, as a note says.
    pub struct RawFluid {
        /// Fluid with known properties.
        pub preset: Preset,
        /// Temperature of the preset in °C, in the range that `meniscus list` prints (default 20, or the next one in this range).
        pub temperature_c: f64 => Key::within("a temperature in degrees Celsius", -50.0, 300.0),
        /// Pressure of `brine`, `carbon-dioxide`, `hydrogen`, `methane`, `nitrogen` in Pa (default 101325).
        pub pressure: f64 => Key::positive("a pressure in Pa"),
        /// Mass fraction of sodium chloride in `brine`, of glycerol in `glycerol-water` (required there).
        pub mass_fraction: f64 => Key::within("a mass fraction", 0.0, 1.0),
        /// Density in kg/m³; the density ratio is 1e-4 to 1e4 (default: that of the preset).
        pub density: f64 => Key::positive("a density in kg/m3"),
        /// Dynamic viscosity in Pa s (default: that of the preset).
        pub viscosity: f64 => Key::positive("a viscosity in Pa s"),
    }

    /// The interface between the fluids.
    pub struct RawInterface {
        /// Interfacial tension in N/m; above 0 in a network (required with two fluids, unless both are presets whose tension `meniscus list` prints).
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
    /// The state that it gives.
    fn state(&self) -> State {
        State { celsius: self.temperature_c, pascal: self.pressure, mass_fraction: self.mass_fraction }
    }

    /// The properties of the preset, if there is one and it is known in this state; notes on those that other keys override.
    pub(crate) fn properties(&self, checker: &mut Checker, at: &str) -> Option<Properties> {
        let preset = self.preset?;
        let known = match preset.at(&self.state()) {
            Ok(known) => known,
            Err(Unknown { key, message, help }) => {
                if !checker.is_refused(&format!("{at}.{key}")) {
                    checker.refuse(format!("{at}.{key}"), message, help);
                }
                return None;
            }
        };
        for (key, given, known, unit) in
            [("density", self.density, known.density, "kg/m3"), ("viscosity", self.viscosity, known.viscosity, "Pa s")]
        {
            if let Some(given) = given.filter(|given| *given != known) {
                checker.note(format!("{at}.{key}: {given} {unit} replaces {known} {unit} of `{}`", preset.word()));
            }
        }
        Some(known)
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
    for (key, what, given) in [
        ("temperature-c", "a temperature", raw.temperature_c),
        ("pressure", "a pressure", raw.pressure),
        ("mass-fraction", "a mass fraction", raw.mass_fraction),
    ] {
        let path = format!("{at}.{key}");
        if checker.is_given(&path, given.as_ref()) && raw.preset.is_none() {
            let help = "add `preset`, or give the density and viscosity in that state";
            checker.refuse(path, format!("{what} needs a preset"), help);
        }
    }
    let is_given = raw.preset.is_some() || raw.density.is_some() || raw.viscosity.is_some();
    if !is_given && !checker.is_refused(at) {
        let help = "add preset = \"water\", or density in kg/m3 and viscosity in Pa s";
        checker.refuse(format!("{at}.preset"), format!("expected a fluid in [{at}], found no property"), help);
        return None;
    }
    let preset = raw.properties(checker, at);
    if raw.preset.is_some() && preset.is_none() {
        return None;
    }
    let density = raw.density.or(preset.map(|preset| preset.density));
    let viscosity = raw.viscosity.or(preset.map(|preset| preset.viscosity));
    let density = checker.require(&format!("{at}.density"), density, "density = 998.2 # kg/m3");
    let viscosity = checker.require(&format!("{at}.viscosity"), viscosity, "viscosity = 1.0e-3 # Pa s");
    let fluid = Fluid { density: density?, viscosity: viscosity? };
    *raw = fluid.into();
    Some(fluid)
}

/// The tension in N/m of the interface, or that of the presets if none is given, which a note tells; read before [`fluid`] replaces presets.
pub(super) fn tension(checker: &mut Checker, at: &str, phases: &RawPhases, given: Option<f64>) -> Option<f64> {
    let preset = |raw: &Option<RawFluid>| raw.as_ref().and_then(|raw| Some((raw.preset?, raw.state())));
    let pair = preset(&phases.wetting).zip(preset(&phases.non_wetting));
    if checker.is_given(&format!("{at}.tension"), given.as_ref()) {
        return given;
    }
    let (one, other) = pair?;
    let (tension, source) = between(one, other)?;
    let rounded = (tension * 1e5).round() / 1e5;
    checker.note(format!("{at}.tension: {rounded} N/m, that of {} ({source})", named(one.0, other.0)));
    Some(rounded)
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
