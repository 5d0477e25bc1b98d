//! Observed orders of convergence.
//!
//! Against a known reference: the slope of log error over log spacing. Without one: the order, the limit and the error
//! estimate of Richardson's extrapolation from three spacings, the ratios of which may differ (Roache 1998).

use super::roots::bisect;

/// Slope of log(error) over log(spacing) by least squares; NaN for fewer than two points or an error of 0.
#[must_use]
pub fn observed_order(spacings: &[f64], errors: &[f64]) -> f64 {
    let count = spacings.len().min(errors.len()) as f64;
    let points = || spacings.iter().zip(errors).map(|(h, e)| (h.ln(), e.abs().ln()));
    let mean_x = points().map(|(x, _)| x).sum::<f64>() / count;
    let mean_y = points().map(|(_, y)| y).sum::<f64>() / count;
    let xy: f64 = points().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let xx: f64 = points().map(|(x, _)| (x - mean_x).powi(2)).sum();
    xy / xx
}

/// What three spacings tell of the limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extrapolation {
    /// Observed order.
    pub order: f64,
    /// Value at spacing zero.
    pub limit: f64,
    /// Estimate of the error of the finest value.
    pub finest_error: f64,
}

/// Highest order that is looked for.
const HIGHEST_ORDER: f64 = 12.0;
/// Lowest order that is looked for.
const LOWEST_ORDER: f64 = 0.01;

/// Richardson's extrapolation of three `values` at the `spacings`, coarse to fine.
///
/// Nothing where the values do not approach a limit monotonically: then the spacings are not in the range of convergence.
#[must_use]
pub fn extrapolate(spacings: [f64; 3], values: [f64; 3]) -> Option<Extrapolation> {
    let [h1, h2, h3] = spacings;
    let [f1, f2, f3] = values;
    // f = limit + c h^p: the ratio of the differences fixes p.
    let ratio = (f1 - f2) / (f2 - f3);
    let order = bisect(|p| (h1.powf(p) - h2.powf(p)) / (h2.powf(p) - h3.powf(p)) - ratio, LOWEST_ORDER, HIGHEST_ORDER)?;
    let finest_error = (f2 - f3) / ((h2 / h3).powf(order) - 1.0);
    Some(Extrapolation { order, limit: f3 - finest_error, finest_error: finest_error.abs() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_and_limit_of_a_power_law_are_recovered() {
        let h = [0.1, 0.06, 0.02];
        let values = h.map(|h: f64| 3.0 - 5.0 * h.powf(1.5));
        let found = extrapolate(h, values).expect("convergent");
        assert!((found.order - 1.5).abs() < 1e-10 && (found.limit - 3.0).abs() < 1e-10, "{found:?}");
        let errors = values.map(|v| v - 3.0);
        assert!((observed_order(&h, &errors) - 1.5).abs() < 1e-12);
    }

    #[test]
    fn values_that_swing_have_no_extrapolation() {
        assert_eq!(extrapolate([0.4, 0.2, 0.1], [1.0, 2.0, 1.5]), None);
        assert_eq!(extrapolate([0.4, 0.2, 0.1], [1.0, 1.1, 1.3]), None);
    }

    #[test]
    fn an_error_that_grows_on_refinement_has_a_negative_order() {
        assert!(observed_order(&[0.1, 0.05, 0.025], &[1.0, 1.2, 1.5]) < 0.0);
    }
}
