//! Aqueous solutions by formulas: brine at the pressure of a reservoir, glycerol in water.

use std::f64::consts::PI;

use super::properties::Properties;

/// Water with a mass fraction of sodium chloride at a temperature in °C and a pressure in Pa \[BatzleWang1992, Eqs. 27a, 27b and 32\].
pub(super) fn brine(celsius: f64, pascal: f64, salt: f64) -> Properties {
    let (t, p, s) = (celsius, pascal * 1e-6, salt);
    let water = 1.0
        + 1e-6
            * (-80.0 * t - 3.3 * t * t + 0.00175 * t.powi(3) + 489.0 * p - 2.0 * t * p + 0.016 * t * t * p
                - 1.3e-5 * t.powi(3) * p
                - 0.333 * p * p
                - 0.002 * t * p * p);
    let with_salt = 0.668
        + 0.44 * s
        + 1e-6 * (300.0 * p - 2400.0 * p * s + t * (80.0 + 3.0 * t - 3300.0 * s - 13.0 * p + 47.0 * p * s));
    let decay = (0.42 * (s.powf(0.8) - 0.17).powi(2) + 0.045) * t.powf(0.8);
    let viscosity = 0.1 + 0.333 * s + (1.65 + 91.9 * s.powi(3)) * (-decay).exp();
    Properties { density: 1e3 * (water + s * with_salt), viscosity: 1e-3 * viscosity, tension: None }
}

/// Water with a mass fraction of glycerol at a temperature in °C: viscosity \[Cheng2008\], density \[VolkKahler2018\].
pub(super) fn glycerol_water(celsius: f64, glycerol: f64) -> Properties {
    let (t, c) = (celsius, glycerol);
    let water = 1.790 * ((-1230.0 - t) * t / (36_100.0 + 360.0 * t)).exp();
    let pure = 12_100.0 * ((-1233.0 + t) * t / (9900.0 + 70.0 * t)).exp();
    let a = 0.705 - 0.0017 * t;
    let b = (4.9 + 0.036 * t) * a.powf(2.5);
    let of_water = 1.0 - c + a * b * c * (1.0 - c) / (a * c + b * (1.0 - c));
    let viscosity = water.powf(of_water) * pure.powf(1.0 - of_water);
    let [heavy, light] = [1277.0 - 0.654 * t, 1000.0 * (1.0 - ((t - 4.0).abs() / 622.0).powf(1.7))];
    let by_volume = c / heavy / (c / heavy + (1.0 - c) / light);
    let largest = 1.78e-6 * t * t - 1.82e-4 * t + 1.41e-2;
    let contraction = 1.0 + largest * (c.powf(1.31) * PI).sin().max(0.0).powf(0.81);
    let density = contraction * (by_volume * heavy + (1.0 - by_volume) * light);
    Properties { density, viscosity: 1e-3 * viscosity, tension: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the usual tables of glycerol in water at 20 °C (Segur and Oberstar 1951; density at 20 °C).
    #[test]
    fn glycerol_in_water_has_the_viscosity_of_the_tables() {
        for (fraction, viscosity, density) in [
            (0.0, 1.005e-3, 998.2),
            (0.2, 1.76e-3, 1047.0),
            (0.5, 6.00e-3, 1126.0),
            (0.8, 60.1e-3, 1208.5),
            (1.0, 1.41, 1261.0),
        ] {
            let found = glycerol_water(20.0, fraction);
            assert!((found.viscosity / viscosity - 1.0).abs() < 0.04, "{fraction}: {found:?}");
            assert!((found.density / density - 1.0).abs() < 4e-3, "{fraction}: {found:?}");
        }
    }
}
