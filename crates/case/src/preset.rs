//! Properties of common liquids and of air at 20 and 25 degrees Celsius, linear between.
//!
//! Values of the usual tables (water: IAPWS; alkanes: NIST), rounded to the digits given, at atmospheric pressure.

use meniscus_core::input::tables::words;

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
    }
}

/// Properties of a fluid at one temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Properties {
    /// Density in kg/m³.
    pub density: f64,
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
    /// Surface tension against air in N/m, if tabulated.
    pub tension: Option<f64>,
}

/// Density in kg/m³, viscosity in mPa s, surface tension against air in mN/m.
type Row = (f64, f64, Option<f64>);

/// The lower tabulated temperature in degrees Celsius.
pub const COLD: f64 = 20.0;
/// The upper tabulated temperature in degrees Celsius.
pub const WARM: f64 = 25.0;

impl Preset {
    /// All presets.
    pub const ALL: [Self; 12] = [
        Self::NHexane,
        Self::NHeptane,
        Self::NOctane,
        Self::NNonane,
        Self::NDecane,
        Self::NUndecane,
        Self::NDodecane,
        Self::NTridecane,
        Self::NHexadecane,
        Self::Water,
        Self::Air,
        Self::Glycerol,
    ];

    /// The properties at `celsius`, from [`COLD`] to [`WARM`]; outside, those at the nearer end.
    pub fn at(self, celsius: f64) -> Properties {
        const PER_MILLI: f64 = 1.0e3;
        let (cold, warm) = self.rows();
        let fraction = ((celsius - COLD) / (WARM - COLD)).clamp(0.0, 1.0);
        let between = |a: f64, b: f64| (1.0 - fraction) * a + fraction * b;
        let tension = match (cold.2, warm.2) {
            (Some(a), Some(b)) => Some(between(a, b) / PER_MILLI),
            (None, Some(b)) if fraction >= 1.0 => Some(b / PER_MILLI),
            _ => None,
        };
        Properties { density: between(cold.0, warm.0), viscosity: between(cold.1, warm.1) / PER_MILLI, tension }
    }

    fn rows(self) -> (Row, Row) {
        match self {
            Self::NHexane => ((659.4, 0.3132, Some(18.4)), (654.9, 0.2980, Some(17.9))),
            Self::NHeptane => ((683.8, 0.4121, Some(20.2)), (679.6, 0.3901, Some(19.7))),
            Self::NOctane => ((702.6, 0.5441, Some(21.6)), (698.6, 0.5115, Some(21.1))),
            Self::NNonane => ((718.0, 0.6983, Some(22.9)), (714.1, 0.6540, Some(22.4))),
            Self::NDecane => ((730.4, 0.9135, Some(23.9)), (726.5, 0.8481, Some(23.4))),
            Self::NUndecane => ((740.3, 1.169, Some(24.7)), (736.5, 1.080, Some(24.2))),
            Self::NDodecane => ((749.4, 1.489, Some(25.4)), (745.7, 1.359, Some(24.9))),
            Self::NTridecane => ((754.0, 1.867, Some(26.1)), (750.6, 1.693, Some(25.6))),
            Self::NHexadecane => ((773.8, 3.482, Some(27.7)), (770.3, 3.081, Some(27.2))),
            Self::Water => ((998.2, 1.0016, Some(72.8)), (997.0, 0.8900, Some(72.0))),
            Self::Air => ((1.205, 0.01821, None), (1.184, 0.01845, None)),
            Self::Glycerol => ((1261.0, 1410.0, None), (1258.0, 906.0, Some(63.2))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_preset_is_linear_between_its_two_temperatures() {
        let middle = Preset::Water.at(22.5);
        assert!((middle.density - 997.6).abs() < 1e-9);
        assert!((middle.viscosity - 9.458e-4).abs() < 1e-12);
        assert_eq!(Preset::Water.at(20.0).tension, Some(72.8e-3));
    }

    #[test]
    fn every_preset_flows_more_easily_when_warm_except_for_air() {
        for preset in Preset::ALL {
            let (cold, warm) = (preset.at(COLD), preset.at(WARM));
            assert_eq!(warm.viscosity > cold.viscosity, preset == Preset::Air, "{preset:?}");
            assert!(warm.density < cold.density, "{preset:?}");
        }
    }
}
