//! Statistics of samples: moments, quantiles, and the decomposition of the variance over independent inputs (Sobol indices).

/// Arithmetic mean; exact for equal values.
pub fn mean(values: &[f64]) -> f64 {
    let Some(&first) = values.first() else { return f64::NAN };
    first + values.iter().map(|value| value - first).sum::<f64>() / values.len() as f64
}

/// Sample standard deviation, with n - 1.
pub fn deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (squares / (values.len() as f64 - 1.0)).sqrt()
}

/// The quantile at `probability`, 0 to 1, of ascending values, by linear interpolation (definition 7) \[HyndmanFan1996\]. Values may be infinite; between an
/// infinite and another value the lower one counts.
pub fn quantile(ascending: &[f64], probability: f64) -> f64 {
    let Some(last) = ascending.len().checked_sub(1) else { return f64::NAN };
    let position = probability.clamp(0.0, 1.0) * last as f64;
    let below = position.floor() as usize;
    let (low, high) = (ascending[below], ascending[(below + 1).min(last)]);
    let remainder = position - below as f64;
    if remainder == 0.0 || low == high || low.is_infinite() {
        low
    } else if high.is_infinite() {
        high
    } else {
        low + remainder * (high - low)
    }
}

/// The first-order and the total index of each input \[SaltelliEtAl2010; Jansen1999\]. `a` and `b` are the results for two independent samples, each of `mixed`
/// those for `a` with one input as in `b`. First order by the estimator (b) of table 2 of Saltelli et al., with the mean subtracted; total by (f), that of
/// Jansen. `None` if nothing varies.
pub fn sobol_indices(a: &[f64], b: &[f64], mixed: &[Vec<f64>]) -> Option<Vec<[f64; 2]>> {
    let all: Vec<f64> = a.iter().chain(b).copied().collect();
    let center = mean(&all);
    let variance = all.iter().map(|value| (value - center).powi(2)).sum::<f64>() / all.len() as f64;
    // Below this fraction of the squared mean the variance is rounding.
    const ROUNDING: f64 = 1e-20;
    if !(variance > ROUNDING * center * center) {
        return None;
    }
    let count = a.len() as f64;
    let of = |mixed: &Vec<f64>| {
        let (mut first, mut total) = (0.0, 0.0);
        for ((a, b), mixed) in a.iter().zip(b).zip(mixed) {
            first += (b - center) * (mixed - a);
            total += 0.5 * (a - mixed).powi(2);
        }
        [first / count / variance, total / count / variance]
    };
    Some(mixed.iter().map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [HyndmanFan1996]
    #[test]
    fn quantiles_lie_between_order_statistics() {
        let values = [1.0, 2.0, 4.0, f64::INFINITY];
        assert_eq!((quantile(&values, 0.0), quantile(&values, 0.5)), (1.0, 3.0));
        assert!((quantile(&values, 0.6) - 3.6).abs() < 1e-15);
        assert_eq!((quantile(&values, 0.9), quantile(&values, 1.0)), (f64::INFINITY, f64::INFINITY));
        assert_eq!(quantile(&[f64::NEG_INFINITY, 1.0], 0.5), f64::NEG_INFINITY);
        assert!(quantile(&[], 0.5).is_nan());
        assert_eq!((mean(&[1.0, 3.0]), deviation(&[1.0, 3.0])), (2.0, 2.0_f64.sqrt()));
        assert_eq!((mean(&[0.1; 7]), deviation(&[0.1; 7])), (0.1, 0.0));
    }

    /// [SaltelliEtAl2010; Jansen1999]
    #[test]
    fn a_sum_shares_its_variance_by_that_of_its_terms() {
        // Pseudo-random numbers between 0 and 1, the same each time.
        let mut state: u64 = 1;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1u32 << 31)
        };
        let rows: Vec<[f64; 4]> = (0..20_000).map(|_| [next(), next(), next(), next()]).collect();
        let result = |x: f64, y: f64| 2.0 * x + y;
        let of = |k: [usize; 2]| rows.iter().map(|row| result(row[k[0]], row[k[1]])).collect::<Vec<f64>>();
        let found = sobol_indices(&of([0, 1]), &of([2, 3]), &[of([2, 1]), of([0, 3])]).unwrap();
        for (found, expected) in found.iter().zip([0.8, 0.2]) {
            assert!(found.iter().all(|index| (index - expected).abs() < 0.03), "{found:?}, expected {expected}");
        }
        assert_eq!(sobol_indices(&[1.0, 1.0], &[1.0, 1.0], &[vec![1.0, 1.0]]), None);
    }
}
