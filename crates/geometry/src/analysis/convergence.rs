//! Observed orders of convergence.
//!
//! With a known reference: the slope of log error over log spacing. Without one: the order, the limit and the error estimate by Richardson extrapolation from
//! three spacings, the ratios of which may differ (Roache 1998), and the resulting uncertainties.

use super::roots::bisect;

/// Slope of log(error) over log(spacing) by least squares; NaN for fewer than two points or an error of 0 \[Roache1998\].
pub fn observed_order(spacings: &[f64], errors: &[f64]) -> f64 {
    let logs: Vec<(f64, f64)> = spacings.iter().zip(errors).map(|(h, e)| (h.ln(), e.abs().ln())).collect();
    slope(&logs).unwrap_or(f64::NAN)
}

/// The slope of a straight line by least squares; `None` for fewer than two points.
pub fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / points.len() as f64;
    let (mean_x, mean_y) = (mean(|p| p.0), mean(|p| p.1));
    let xy: f64 = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let xx: f64 = points.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    (xx > 0.0).then(|| xy / xx)
}

/// Richardson extrapolation from three spacings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extrapolation {
    /// Observed order.
    pub(crate) order: f64,
    /// Value at spacing zero.
    pub(crate) limit: f64,
    /// Estimate of the error of the finest value.
    pub(crate) finest_error: f64,
}

/// Upper bound of the search for the order.
const HIGHEST_ORDER: f64 = 12.0;
/// Lower bound of the search for the order.
const LOWEST_ORDER: f64 = 0.01;

/// Richardson extrapolation of three `values` at the `spacings`, coarse to fine.
///
/// `None` if the values do not approach a limit monotonically: then the spacings are outside the asymptotic range.
pub(crate) fn extrapolate(spacings: [f64; 3], values: [f64; 3]) -> Option<Extrapolation> {
    let [h1, h2, h3] = spacings;
    let [f1, f2, f3] = values;
    // f = limit + c h^p: the ratio of the differences fixes p.
    let ratio = (f1 - f2) / (f2 - f3);
    let order = bisect(|p| (h1.powf(p) - h2.powf(p)) / (h2.powf(p) - h3.powf(p)) - ratio, LOWEST_ORDER, HIGHEST_ORDER)?;
    let finest_error = (f2 - f3) / ((h2 / h3).powf(order) - 1.0);
    Some(Extrapolation { order, limit: f3 - finest_error, finest_error: finest_error.abs() })
}

/// The safety factor on an extrapolated error that covers the true one in 95 of 100 cases (Roache 1998): two standard uncertainties.
const SAFETY: f64 = 1.25;

/// Below this order, values do not converge yet.
const LEAST_ORDER: f64 = 0.5;

/// An observed order higher than that of the method is coincidence.
const ORDER_OF_METHOD: f64 = 2.0;

/// The standard uncertainty of the value at each spacing, `spacings` from coarse to fine; `None` for fewer than three \[Eca2014; Roache1998\]. If the finest
/// three converge: half of `SAFETY` times the distance from their limit, at least that of the finest; else their range, at least the distance from the finest.
pub fn discretization_uncertainties(spacings: &[f64], values: &[f64]) -> Option<Vec<f64>> {
    let (&[.., h1, h2, h3], &[.., f1, f2, f3]) = (spacings, values) else { return None };
    let observed = extrapolate([h1, h2, h3], [f1, f2, f3]).map(|found| found.order);
    let (limit, factor, least) = match observed.filter(|order| *order >= LEAST_ORDER) {
        Some(order) => {
            let error = (f2 - f3) / ((h2 / h3).powf(order.min(ORDER_OF_METHOD)) - 1.0);
            (f3 - error, 0.5 * SAFETY, 0.5 * SAFETY * error.abs())
        }
        None => (f3, 1.0, f1.max(f2).max(f3) - f1.min(f2).min(f3)),
    };
    Some(values.iter().map(|value| (factor * (value - limit).abs()).max(least)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Roache1998]
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

    /// [Eca2014]
    #[test]
    fn two_uncertainties_cover_the_errors_of_power_laws() {
        let h = [0.1, 0.05, 0.025, 0.0125];
        for order in [0.7, 1.0, 1.5, 2.0, 3.0] {
            let errors = h.map(|h: f64| 0.3 * h.powf(order));
            let found = discretization_uncertainties(&h, &errors.map(|error| 1.0 + error)).unwrap();
            for (error, uncertainty) in errors.iter().zip(&found) {
                assert!(2.0 * uncertainty >= 1.2 * error, "order {order}: {found:?}");
                // Above second order, the uncertainty of the finest is conservative.
                assert!(order > 2.0 || 2.0 * uncertainty <= 1.3 * error, "order {order}: {found:?}");
            }
        }
        assert_eq!(discretization_uncertainties(&h[..2], &[1.0, 2.0]), None);
    }

    #[test]
    fn values_that_swing_are_as_uncertain_as_they_swing() {
        let found = discretization_uncertainties(&[0.8, 0.4, 0.2, 0.1], &[4.0, 1.0, 2.0, 1.5]).unwrap();
        assert_eq!(found, [2.5, 1.0, 1.0, 1.0]);
    }
}
