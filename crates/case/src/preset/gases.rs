//! Gases at the pressures of reservoirs: equations of state and viscosities of reference, tabulated over temperature and density.
//!
//! `gases.csv` is written by `postprocess/gas_tables.py`. Over density p/(ρ T) and the viscosity are smooth even near a critical point: cubic in between, and
//! linear over temperature, they differ from the equations by less than 0.4 %, for hydrogen and nitrogen by less than 0.1 %.

use std::sync::LazyLock;

use super::properties::Properties;

const TABLE: &str = include_str!("gases.csv");
/// 0 °C in K.
const FREEZING: f64 = 273.15;

/// The rows of a gas at one temperature in °C: density in kg/m³, pressure in Pa, viscosity in Pa s, by rising density.
struct Isotherm {
    celsius: f64,
    rows: Vec<[f64; 3]>,
}

/// All isotherms of each gas by rising temperature.
static GASES: LazyLock<Vec<(&'static str, Vec<Isotherm>)>> = LazyLock::new(|| {
    let mut found: Vec<(&str, Vec<Isotherm>)> = Vec::new();
    for line in TABLE.lines().skip(1) {
        let (name, numbers) = line.split_once(',').unwrap_or_default();
        let numbers: Vec<f64> = numbers.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
        let &[celsius, density, pressure, viscosity] = &numbers[..] else { continue };
        if found.last().is_none_or(|(last, _)| *last != name) {
            found.push((name, Vec::new()));
        }
        let Some((_, isotherms)) = found.last_mut() else { continue };
        if isotherms.last().is_none_or(|last| last.celsius != celsius) {
            isotherms.push(Isotherm { celsius, rows: Vec::new() });
        }
        if let Some(isotherm) = isotherms.last_mut() {
            isotherm.rows.push([density, pressure, viscosity]);
        }
    }
    found
});

fn isotherms(gas: &str) -> &'static [Isotherm] {
    GASES.iter().find(|(of, _)| *of == gas).map_or(&[], |(_, isotherms)| isotherms)
}

/// The range of temperatures in °C.
pub(super) fn temperatures(gas: &str) -> [f64; 2] {
    match isotherms(gas) {
        [first, .., last] => [first.celsius, last.celsius],
        _ => [f64::NAN; 2],
    }
}

/// Density and viscosity at a temperature in °C and a pressure in Pa within the table.
pub(super) fn at(gas: &str, celsius: f64, pascal: f64) -> Properties {
    const HALVINGS: usize = 60;
    let isotherms = isotherms(gas);
    let upper = isotherms.partition_point(|isotherm| isotherm.celsius < celsius).clamp(1, isotherms.len() - 1);
    let pair = [&isotherms[upper - 1], &isotherms[upper]];
    let share = (celsius - pair[0].celsius) / (pair[1].celsius - pair[0].celsius);
    let between = |density: f64, value: fn(&Isotherm, &[f64; 3]) -> f64| {
        let [cold, warm] = pair.map(|isotherm| cubic(density, &isotherm.rows, |row| value(isotherm, row)));
        (1.0 - share) * cold + share * warm
    };
    let compressed = |isotherm: &Isotherm, row: &[f64; 3]| row[1] / (row[0] * (isotherm.celsius + FREEZING));
    let pressure = |density: f64| between(density, compressed) * density * (celsius + FREEZING);
    let (mut low, mut high) = (0.0, pair[0].rows.last().map_or(0.0, |row| row[0]));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if pressure(middle) < pascal {
            low = middle;
        } else {
            high = middle;
        }
    }
    Properties { density: low, viscosity: between(low, |_, row| row[2]), tension: None }
}

/// The polynomial through the four rows about a density.
fn cubic(density: f64, rows: &[[f64; 3]], value: impl Fn(&[f64; 3]) -> f64) -> f64 {
    let after = rows.partition_point(|row| row[0] < density).min(rows.len() - 1);
    let first = after.saturating_sub(2).min(rows.len() - 4);
    let four = &rows[first..first + 4];
    let weight = |a: usize| {
        let others = (0..4).filter(|&b| b != a);
        others.map(|b| (density - four[b][0]) / (four[a][0] - four[b][0])).product::<f64>()
    };
    (0..4).map(|a| weight(a) * value(&four[a])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equations of state of reference, by CoolProp 8.0: 50 °C and 10 MPa.
    #[test]
    fn gases_have_the_density_and_the_viscosity_of_their_equations_of_state() {
        for (gas, density, viscosity) in [
            ("carbon-dioxide", 384.3272, 2.779092e-5),
            ("hydrogen", 7.100073, 9.509863e-6),
            ("methane", 66.59591, 1.418287e-5),
            ("nitrogen", 102.4973, 2.076772e-5),
        ] {
            let found = at(gas, 50.0, 1e7);
            assert!((found.density / density - 1.0).abs() < 4e-3, "{gas:?} {found:?}");
            assert!((found.viscosity / viscosity - 1.0).abs() < 4e-3, "{gas:?} {found:?}");
        }
    }
}
