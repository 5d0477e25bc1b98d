//! Fluids by name: density, viscosity and surface tension at a temperature and a pressure, each with its source.

use super::properties::{ATMOSPHERE, Properties, State, Unknown};
use super::{aqueous, gases};
use meniscus_core::input::tables::{Words, words};

words! {
    /// A fluid with known properties.
    pub enum Preset {
        /// Hexane.
        NHexane,
        /// Heptane.
        NHeptane,
        /// Octane.
        NOctane,
        /// Nonane.
        NNonane,
        /// Decane.
        NDecane,
        /// Undecane.
        NUndecane,
        /// Dodecane.
        NDodecane,
        /// Tridecane.
        NTridecane,
        /// Hexadecane.
        NHexadecane,
        /// Water.
        Water,
        /// Air at atmospheric pressure.
        Air,
        /// Glycerol.
        Glycerol,
        /// Glycerol in water.
        GlycerolWater,
        /// Silicone oil of 5 mm²/s.
        SiliconeOil5 = "silicone-oil-5",
        /// Silicone oil of 10 mm²/s.
        SiliconeOil10 = "silicone-oil-10",
        /// Silicone oil of 20 mm²/s.
        SiliconeOil20 = "silicone-oil-20",
        /// Silicone oil of 50 mm²/s.
        SiliconeOil50 = "silicone-oil-50",
        /// Silicone oil of 100 mm²/s.
        SiliconeOil100 = "silicone-oil-100",
        /// Silicone oil of 1000 mm²/s.
        SiliconeOil1000 = "silicone-oil-1000",
        /// Fluorinert FC-40.
        Fc40 = "fc-40",
        /// Novec 7500.
        Novec7500 = "novec-7500",
        /// Sodium chloride in water, at the pressure of a reservoir.
        Brine,
        /// Carbon dioxide above its critical temperature.
        CarbonDioxide,
        /// Hydrogen.
        Hydrogen,
        /// Methane.
        Methane,
        /// Nitrogen.
        Nitrogen,
    }
}

/// Density in kg/m³, viscosity in mPa s, surface tension against air in mN/m.
type Row = (f64, f64, Option<f64>);

/// The temperatures in °C of the tables of liquids.
const COLD: f64 = 20.0;
const WARM: f64 = 25.0;
/// Temperature in °C if none is given.
const ROOM: f64 = 20.0;

/// How the properties of a fluid are known.
enum Known {
    /// At both temperatures, linear between them, at atmospheric pressure.
    Between(Row, Row),
    /// At the higher one, at atmospheric pressure.
    Warm(Row),
    /// By formulas of the mass fraction of a solute.
    Glycerol,
    Brine,
    /// By a table over temperature and density.
    Gas,
}

impl Preset {
    /// All presets.
    pub fn all() -> impl Iterator<Item = Self> {
        Self::ALL.iter().map(|(preset, _)| *preset)
    }

    /// The range of temperatures in °C in which the properties are known.
    pub fn temperatures(self) -> [f64; 2] {
        match self.known() {
            Known::Between(..) => [COLD, WARM],
            Known::Warm(_) => [WARM; 2],
            Known::Glycerol => [0.0, 100.0],
            Known::Brine => [20.0, 120.0],
            Known::Gas => gases::temperatures(&self.word()),
        }
    }

    /// The range of pressures in Pa; `None`: atmospheric only.
    pub fn pressures(self) -> Option<[f64; 2]> {
        matches!(self.known(), Known::Brine | Known::Gas).then_some([1.0e5, 4.0e7])
    }

    /// The range of the mass fraction of the solute, and its name; `None` for a pure fluid.
    pub fn solute(self) -> Option<([f64; 2], &'static str)> {
        match self.known() {
            Known::Glycerol => Some(([0.0, 1.0], "glycerol")),
            Known::Brine => Some(([0.0, 0.25], "sodium chloride")),
            _ => None,
        }
    }

    /// Where the properties come from.
    pub fn source(self) -> &'static str {
        match self {
            Self::Water => "IAPWS",
            Self::Air | Self::Glycerol => "usual tables",
            Self::GlycerolWater => "Cheng 2008; Volk and Kaehler 2018",
            Self::Brine => "Batzle and Wang 1992",
            Self::CarbonDioxide => "Span and Wagner 1996; Laesecke and Muzny 2017",
            Self::Hydrogen => "Leachman et al. 2009; Muzny et al. 2013",
            Self::Methane => "Setzmann and Wagner 1991; Quinones-Cisneros and Deiters 2006",
            Self::Nitrogen => "Span et al. 2000; Lemmon and Jacobsen 2004",
            Self::Fc40 | Self::Novec7500 => "data sheet of 3M",
            _ if matches!(self.known(), Known::Warm(_)) => "data sheet of Shin-Etsu, KF-96",
            _ => "NIST",
        }
    }

    /// The temperature in °C of a state.
    pub fn temperature(self, state: &State) -> f64 {
        let [low, high] = self.temperatures();
        state.celsius.unwrap_or(ROOM.clamp(low, high))
    }

    /// The properties in a state.
    ///
    /// # Errors
    /// If the state is outside the range in which they are known, or has too few or too many keys.
    pub fn at(self, state: &State) -> Result<Properties, Unknown> {
        const PER_MILLI: f64 = 1.0e3;
        let (celsius, pascal) = (self.temperature(state), state.pascal.unwrap_or(ATMOSPHERE));
        let fraction = self.check(state, celsius, pascal)?;
        let of = |(density, viscosity, tension): Row| Properties {
            density,
            viscosity: viscosity / PER_MILLI,
            tension: tension.map(|tension| tension / PER_MILLI),
        };
        Ok(match self.known() {
            Known::Between(cold, warm) => {
                let share = (celsius - COLD) / (WARM - COLD);
                let between = |a: f64, b: f64| (1.0 - share) * a + share * b;
                let tension = match (cold.2, warm.2) {
                    (Some(a), Some(b)) => Some(between(a, b)),
                    (None, Some(b)) if share >= 1.0 => Some(b),
                    _ => None,
                };
                of((between(cold.0, warm.0), between(cold.1, warm.1), tension))
            }
            Known::Warm(row) => of(row),
            Known::Glycerol => aqueous::glycerol_water(celsius, fraction),
            Known::Brine => aqueous::brine(celsius, pascal, fraction),
            Known::Gas => gases::at(&self.word(), celsius, pascal),
        })
    }

    /// The mass fraction of a state; refuses states out of range.
    fn check(self, state: &State, celsius: f64, pascal: f64) -> Result<f64, Unknown> {
        let name = self.word();
        let unknown = |key: &'static str, message: String, help: String| Err(Unknown { key, message, help });
        let own = "give density in kg/m3 and viscosity in Pa s instead of the preset";
        let [low, high] = self.temperatures();
        if !(low..=high).contains(&celsius) {
            let range = if low == high { format!("at {low} C only") } else { format!("from {low} to {high} C") };
            let message = format!("`{name}` is known {range}, found {celsius} C");
            return unknown("temperature-c", message, format!("take a temperature in this range, or {own}"));
        }
        match (self.pressures(), state.pascal) {
            (None, Some(_)) => {
                let message = format!("`{name}` is known at atmospheric pressure only");
                return unknown("pressure", message, format!("leave the pressure out, or {own}"));
            }
            (Some([low, high]), _) if !(low..=high).contains(&pascal) => {
                let message = format!("`{name}` is known from {low:e} to {high:e} Pa, found {pascal:e} Pa");
                return unknown("pressure", message, format!("pressures are in Pa: 10 MPa are 1.0e7; or {own}"));
            }
            _ => {}
        }
        match (self.solute(), state.mass_fraction) {
            (None, Some(_)) => {
                let help = "leave it out, or take the preset `brine` or `glycerol-water`".to_owned();
                unknown("mass-fraction", format!("`{name}` has no solute"), help)
            }
            (None, None) => Ok(0.0),
            (Some((_, what)), None) => {
                let message = format!("missing key `mass-fraction`, that of {what} in `{name}`");
                unknown("mass-fraction", message, "add mass-fraction = 0.1".to_owned())
            }
            (Some(([low, high], what)), Some(fraction)) if !(low..=high).contains(&fraction) => {
                let message = format!("`{name}` is known from {low} to {high} of its mass as {what}, found {fraction}");
                unknown("mass-fraction", message, "a mass fraction is a share: 10 % are 0.1".to_owned())
            }
            (Some(_), Some(fraction)) => Ok(fraction),
        }
    }

    fn known(self) -> Known {
        use Known::{Between, Warm};
        match self {
            Self::NHexane => Between((659.4, 0.3132, Some(18.4)), (654.9, 0.2980, Some(17.9))),
            Self::NHeptane => Between((683.8, 0.4121, Some(20.2)), (679.6, 0.3901, Some(19.7))),
            Self::NOctane => Between((702.6, 0.5441, Some(21.6)), (698.6, 0.5115, Some(21.1))),
            Self::NNonane => Between((718.0, 0.6983, Some(22.9)), (714.1, 0.6540, Some(22.4))),
            Self::NDecane => Between((730.4, 0.9135, Some(23.9)), (726.5, 0.8481, Some(23.4))),
            Self::NUndecane => Between((740.3, 1.169, Some(24.7)), (736.5, 1.080, Some(24.2))),
            Self::NDodecane => Between((749.4, 1.489, Some(25.4)), (745.7, 1.359, Some(24.9))),
            Self::NTridecane => Between((754.0, 1.867, Some(26.1)), (750.6, 1.693, Some(25.6))),
            Self::NHexadecane => Between((773.8, 3.482, Some(27.7)), (770.3, 3.081, Some(27.2))),
            Self::Water => Between((998.2, 1.0016, Some(72.8)), (997.0, 0.8900, Some(72.0))),
            Self::Air => Between((1.205, 0.01821, None), (1.184, 0.01845, None)),
            Self::Glycerol => Between((1261.0, 1410.0, None), (1258.0, 906.0, Some(63.2))),
            Self::SiliconeOil5 => Warm((915.0, 4.575, Some(19.7))),
            Self::SiliconeOil10 => Warm((935.0, 9.35, Some(20.1))),
            Self::SiliconeOil20 => Warm((950.0, 19.0, Some(20.6))),
            Self::SiliconeOil50 => Warm((960.0, 48.0, Some(20.8))),
            Self::SiliconeOil100 => Warm((965.0, 96.5, Some(20.9))),
            Self::SiliconeOil1000 => Warm((970.0, 970.0, Some(21.2))),
            Self::Fc40 => Warm((1855.0, 4.1, Some(16.0))),
            Self::Novec7500 => Warm((1614.0, 1.24, Some(16.2))),
            Self::GlycerolWater => Known::Glycerol,
            Self::Brine => Known::Brine,
            Self::CarbonDioxide | Self::Hydrogen | Self::Methane | Self::Nitrogen => Known::Gas,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(preset: Preset, celsius: f64) -> Properties {
        let mass_fraction = preset.solute().map(|_| 0.1);
        preset.at(&State { celsius: Some(celsius), mass_fraction, ..State::default() }).unwrap()
    }

    #[test]
    fn a_preset_is_linear_between_its_two_temperatures() {
        let middle = at(Preset::Water, 22.5);
        assert!((middle.density - 997.6).abs() < 1e-9);
        assert!((middle.viscosity - 9.458e-4).abs() < 1e-12);
        assert_eq!(at(Preset::Water, 20.0).tension, Some(72.8e-3));
    }

    #[test]
    fn every_liquid_flows_more_easily_when_warm_and_every_gas_less() {
        for preset in Preset::all() {
            let [low, high] = preset.temperatures();
            let (cold, warm) = (at(preset, low), at(preset, high));
            if low < high {
                let is_gas = cold.density < 10.0;
                assert_eq!(warm.viscosity > cold.viscosity, is_gas, "{preset:?}");
                assert!(warm.density < cold.density, "{preset:?}");
            }
        }
    }

    /// IAPWS R6-95 and R12-08; CoolProp 8.0.
    #[test]
    fn brine_without_salt_is_water_at_the_pressure_of_a_reservoir() {
        for (celsius, pascal, density, viscosity) in
            [(20.0, 1e5, 998.2065, 1.001597e-3), (50.0, 1e7, 992.3080, 5.48538e-4), (80.0, 2e7, 980.4937, 3.59378e-4)]
        {
            let state = State { celsius: Some(celsius), pascal: Some(pascal), mass_fraction: Some(0.0) };
            let found = Preset::Brine.at(&state).unwrap();
            assert!((found.density / density - 1.0).abs() < 2e-3, "{found:?}");
            assert!((found.viscosity / viscosity - 1.0).abs() < 0.04, "{found:?}");
        }
    }

    #[test]
    fn states_out_of_range_are_refused_with_the_key() {
        let of = |preset: Preset, state: State| preset.at(&state).unwrap_err().key;
        assert_eq!(of(Preset::Water, State { celsius: Some(60.0), ..State::default() }), "temperature-c");
        assert_eq!(of(Preset::Water, State { pascal: Some(1e6), ..State::default() }), "pressure");
        assert_eq!(of(Preset::Brine, State::default()), "mass-fraction");
        assert_eq!(of(Preset::Methane, State { mass_fraction: Some(0.1), ..State::default() }), "mass-fraction");
        assert_eq!(of(Preset::Nitrogen, State { pascal: Some(1e9), ..State::default() }), "pressure");
    }
}
