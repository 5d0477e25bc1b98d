//! Root of a function of one variable by bisection.

/// The root in `[low, high]` (m, rad or whatever `function` takes); `None` if the signs at the ends are equal.
///
/// Bisects until the interval is as small as rounding allows.
pub fn bisect(function: impl Fn(f64) -> f64, low: f64, high: f64) -> Option<f64> {
    let (mut low, mut high) = (low, high);
    let at_low = function(low);
    let at_high = function(high);
    if at_low == 0.0 {
        return Some(low);
    }
    let product = at_low * at_high;
    if product.is_nan() || product > 0.0 {
        return None;
    }
    // 200 halvings exhaust the digits of any interval that does not contain 0.
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        if (function(middle) > 0.0) == (at_low > 0.0) { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::bisect;

    #[test]
    fn a_root_is_found_to_rounding_and_none_is_invented() {
        let root = bisect(|x| x * x - 2.0, 0.0, 2.0).expect("a root");
        assert!((root - 2.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(bisect(|x| x * x + 1.0, -1.0, 1.0), None);
        assert_eq!(bisect(|_| f64::NAN, -1.0, 1.0), None);
    }
}
