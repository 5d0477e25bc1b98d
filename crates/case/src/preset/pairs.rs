//! Interfacial tensions of pairs of fluids.

use super::fluids::Preset;
use super::properties::{ATMOSPHERE, State};
use meniscus_core::input::tables::Words;

/// A pair of fluids whose tension is known, in words, for lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pair {
    /// Both fluids.
    pub fluids: &'static str,
    /// The states in which it is known.
    pub range: &'static str,
    /// Where it comes from.
    pub source: &'static str,
}

/// All pairs.
pub const PAIRS: [Pair; 4] = [
    Pair { fluids: "a liquid and air", range: "20 to 25 C", source: "that of the liquid" },
    Pair { fluids: "water and an alkane", range: "20 to 25 C, to 1 mN/m", source: "Goebel and Lunkenheimer 1997" },
    Pair {
        fluids: "brine and carbon-dioxide",
        range: "32 to 100 C, 5 to 25 MPa, to 2.75 mol/kg",
        source: "Chalbaud et al. 2009",
    },
    Pair {
        fluids: "brine without salt and hydrogen, methane or nitrogen",
        range: "20 to 30 C, to 8 MPa",
        source: "Massoudi and King 1974",
    },
];

/// The interfacial tension in N/m of two fluids, and its source; `None` if it is not known in these states.
pub fn between(one: (Preset, State), other: (Preset, State)) -> Option<(f64, &'static str)> {
    of(one, other).or_else(|| of(other, one))
}

fn of((liquid, state): (Preset, State), (other, of_other): (Preset, State)) -> Option<(f64, &'static str)> {
    let same = |a: Option<f64>, b: Option<f64>, default: f64| a.unwrap_or(default) == b.unwrap_or(default);
    let celsius = liquid.temperature(&state);
    let is_one_state = celsius == other.temperature(&of_other) && same(state.pascal, of_other.pascal, ATMOSPHERE);
    let found = match (liquid, other) {
        _ if !is_one_state => return None,
        (_, Preset::Air) => (liquid.at(&state).ok()?.tension?, liquid.source()),
        (Preset::Water, _) => (1e-3 * with_water(other)?, PAIRS[1].source),
        (Preset::Brine, Preset::CarbonDioxide) => (brine_and_carbon_dioxide(&state)?, PAIRS[2].source),
        (Preset::Brine, _) => (water_and_gas(other, celsius, &state)?, PAIRS[3].source),
        _ => return None,
    };
    Some(found)
}

/// Tension of an alkane against water in mN/m \[GoebelLunkenheimer1997\].
fn with_water(alkane: Preset) -> Option<f64> {
    Some(match alkane {
        Preset::NHexane => 51.4,
        Preset::NHeptane => 51.9,
        Preset::NOctane => 52.5,
        Preset::NNonane => 52.4,
        Preset::NDecane => 53.2,
        Preset::NUndecane => 53.1,
        Preset::NDodecane => 53.7,
        Preset::NHexadecane => 55.2,
        _ => return None,
    })
}

/// Molality of sodium chloride in mol/kg at a mass fraction.
fn molality(mass_fraction: f64) -> f64 {
    /// Molar mass of sodium chloride in kg/mol.
    const SALT: f64 = 0.058_44;
    mass_fraction / (1.0 - mass_fraction) / SALT
}

/// \[Chalbaud2009\]: a plateau that rises with the molality of the salt, and a power of the difference of both densities, in N/m.
fn brine_and_carbon_dioxide(state: &State) -> Option<f64> {
    /// Plateau in mN/m, its rise in mN/m per mol/kg, and the largest molality in mol/kg.
    const PLATEAU: [f64; 3] = [26.0, 1.255, 2.75];
    /// Parachor over molar mass of carbon dioxide in cm³/g; exponents of density and temperature.
    const POWERS: [f64; 3] = [82.0 / 44.01, 4.7180, 1.0243];
    /// Critical temperature in K.
    const CRITICAL: f64 = 304.13;
    let celsius = Preset::CarbonDioxide.temperature(state);
    let (pascal, salt) = (state.pascal?, molality(state.mass_fraction?));
    if !((5.0e6..=2.5e7).contains(&pascal) && celsius <= 100.0 && salt <= PLATEAU[2]) {
        return None;
    }
    let density = |fluid: Preset, state: &State| fluid.at(state).ok().map(|found| found.density);
    let gas = density(Preset::CarbonDioxide, &State { mass_fraction: None, ..*state })?;
    let difference = 1e-3 * (density(Preset::Brine, state)? - gas);
    let reduced = (celsius + 273.15) / CRITICAL;
    let above = (POWERS[0] * difference).powf(POWERS[1]) * reduced.powf(POWERS[2]);
    Some(1e-3 * (PLATEAU[0] + PLATEAU[1] * salt + above))
}

/// \[MassoudiKing1974\]: that of water at 25 °C less what the gas adsorbs, up to 8 MPa, in N/m.
fn water_and_gas(gas: Preset, celsius: f64, state: &State) -> Option<f64> {
    /// Tension of water at 25 °C in mN/m, and how it falls per K.
    const WATER: [f64; 2] = [72.0, 0.16];
    let [linear, square] = match gas {
        Preset::Hydrogen => [-0.0250, 0.0],
        Preset::Nitrogen => [-0.0835, 0.000_194],
        Preset::Methane => [-0.1547, 0.000_456],
        _ => return None,
    };
    let atmospheres = state.pascal.unwrap_or(ATMOSPHERE) / ATMOSPHERE;
    let is_known = (20.0..=30.0).contains(&celsius) && atmospheres * ATMOSPHERE <= 8.0e6;
    (is_known && state.mass_fraction == Some(0.0)).then(|| {
        let water = WATER[0] - WATER[1] * (celsius - 25.0);
        1e-3 * (water + linear * atmospheres + square * atmospheres * atmospheres)
    })
}

/// The names of both fluids, for messages.
pub(crate) fn named(one: Preset, other: Preset) -> String {
    format!("`{}` and `{}`", one.word(), other.word())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tensions_of_pairs_do_not_depend_on_their_order_and_need_one_state() {
        let room = State::default();
        assert_eq!(between((Preset::Water, room), (Preset::Air, room)), Some((72.8e-3, "IAPWS")));
        let near = |one, other, tension: f64| {
            let found = between((one, room), (other, room)).unwrap().0;
            assert!((found - tension).abs() < 1e-12, "{found}");
        };
        near(Preset::Air, Preset::NDecane, 23.9e-3);
        near(Preset::NDecane, Preset::Water, 53.2e-3);
        let warm = State { celsius: Some(25.0), ..room };
        assert_eq!(between((Preset::Water, room), (Preset::Air, warm)), None);
        assert_eq!(between((Preset::Fc40, room), (Preset::Water, warm)), None);
    }

    /// \[Chalbaud2009\]: about 26 mN/m and 1.255 mN/m per mol/kg where carbon dioxide is dense.
    #[test]
    fn dense_carbon_dioxide_has_the_tension_of_the_plateau() {
        let state = |pascal: f64, mass_fraction: f64| State {
            celsius: Some(50.0),
            pascal: Some(pascal),
            mass_fraction: Some(mass_fraction),
        };
        let tension = |pascal: f64, salt: f64| {
            let gas = State { mass_fraction: None, ..state(pascal, salt) };
            between((Preset::CarbonDioxide, gas), (Preset::Brine, state(pascal, salt))).map(|found| found.0)
        };
        let plateau = tension(2.4e7, 0.0).unwrap();
        assert!((plateau - 26e-3).abs() < 0.3e-3, "{plateau}");
        assert!(tension(5.5e6, 0.0).unwrap() > 33e-3);
        let salty = tension(2.4e7, 0.1).unwrap() - plateau;
        assert!((salty - 1.255e-3 * 1.9013).abs() < 0.15e-3, "{salty}");
        assert_eq!(tension(3.0e7, 0.1), None);
    }
}
