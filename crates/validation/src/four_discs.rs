//! Menisci of a wetting liquid between four discs (C8 of the benchmarks), compared with their closed form.

use super::disc_pair::disc_pair;
use meniscus_core::solver::{Measure, measure};
use meniscus_sph::measures::Subject;

pub(super) fn measures(s: &Subject) -> Vec<Measure> {
    let found: Vec<f64> = s.observed.lines_with_angle().map(|line| line.curvature).collect();
    let mean = found.iter().sum::<f64>() / found.len() as f64;
    let of_fits =
        s.observed.lines_with_angle().map(|line| line.curvature_uncertainty).sum::<f64>() / found.len() as f64;
    let spread = (found.iter().map(|k| (k - mean).powi(2)).sum::<f64>() / found.len() as f64).sqrt();
    let error = spread.hypot(of_fits);
    let exact = disc_pair(s).and_then(|pair| pair.liquid_between_four(s.observed.areas.wetting));
    let over_exact = |curvature: f64| exact.map_or(f64::NAN, |exact| curvature / exact.curvature);
    let (pressure, tension) = (s.observed.capillary_pressure, s.flow.config.method.tension);
    vec![
        measure("interface-curvature-per-m", mean, "1/m")
            .by("mean over the fitted menisci, negative where the wetting liquid is concave")
            .with_uncertainty(error),
        measure("interface-curvature-ratio", over_exact(-mean), "")
            .by("curvature over that of the exact menisci with the same area and the requested angle")
            .with_uncertainty(error / mean.abs()),
        measure("capillary-pressure-ratio", over_exact(pressure.value / tension), "")
            .by("capillary pressure over that of the exact menisci with the same area and the requested angle")
            .with_uncertainty(over_exact(s.capillary_pressure_error() / tension).abs())
            .moving_with("capillary_pressure_Pa", over_exact(1.0 / tension)),
    ]
}
