//! Ticks that a person would choose: round steps, the given positions where these are few and short, and their labels.

use std::ops::Range;

/// Wanted number of labels at round steps; seldom one more is all there is.
const LABELS: std::ops::RangeInclusive<usize> = 4..=7;

/// The ticks in a range of an axis.
pub(crate) fn ticks(range: &Range<f64>, logarithmic: bool) -> Vec<f64> {
    if logarithmic { logarithmic_ticks(range) } else { linear_ticks(range) }
}

/// Height of a label with the space to the next one in pixels.
pub(super) const LABEL_HEIGHT: f64 = 20.0;

/// Width of a label with the space to the next one in pixels.
pub(super) fn label_width(value: f64) -> f64 {
    const CHARACTER: f64 = 8.5;
    const APART: f64 = 8.0;
    CHARACTER * short(value).chars().count() as f64 + APART
}

/// The given positions if they are few, short and apart; else round ticks. `extent` is that of a label along the axis, over the length of the axis.
pub(super) fn ticks_at(
    positions: &[f64],
    range: &Range<f64>,
    logarithmic: bool,
    extent: &dyn Fn(f64) -> f64,
) -> Vec<f64> {
    /// More labels would crowd an axis.
    const MOST: usize = 8;
    let mut positions = positions.to_vec();
    positions.sort_by(f64::total_cmp);
    positions.dedup();
    let on = |x: f64| if logarithmic { x.ln() } else { x };
    let size = on(range.end) - on(range.start);
    let apart = |pair: &[f64]| (on(pair[1]) - on(pair[0])) / size >= 0.5 * (extent(pair[0]) + extent(pair[1]));
    let fit = !positions.is_empty() && positions.len() <= MOST && positions.windows(2).all(apart);
    if fit && positions.iter().all(|x| is_readable(*x)) { positions } else { ticks(range, logarithmic) }
}

/// Whether a number has at most two significant digits, or three that end in 0 or 5.
fn is_readable(value: f64) -> bool {
    let three = format!("{value:.2e}");
    let is_exact = three.parse().is_ok_and(|rounded: f64| (rounded - value).abs() <= 1.0e-9 * value.abs());
    is_exact && three.split('e').next().is_some_and(|digits| digits.ends_with(['0', '5']))
}

/// Multiples of 1, 2, 5 times a power of ten, or of 2.5 where these give too few or too many.
fn linear_ticks(range: &Range<f64>) -> Vec<f64> {
    // Tenths, so that a multiple is exact.
    const MANTISSAS: [i64; 4] = [10, 20, 50, ODD];
    const ODD: i64 = 25;
    /// Most welcome number of labels.
    const BEST: usize = 6;
    let size = range.end - range.start;
    if !(size > 0.0 && size.is_finite()) {
        return Vec::new();
    }
    let coarsest = size.log10().floor() as i32;
    let multiples = |mantissa: i64, exponent: i32| -> Vec<f64> {
        let step = mantissa as f64 * 10_f64.powi(exponent - 1);
        let (first, last) = ((range.start / step).ceil() as i64, (range.end / step).floor() as i64);
        // A product with a power of ten would have spurious trailing digits.
        let tick = |k: i64| format!("{}e{}", k.saturating_mul(mantissa), exponent - 1).parse().unwrap_or(f64::NAN);
        (first..=last).take(2 * LABELS.end()).map(tick).collect()
    };
    let steps = MANTISSAS.iter().flat_map(|mantissa| [coarsest - 1, coarsest].map(|exponent| (*mantissa, exponent)));
    let candidates = steps.map(|(mantissa, exponent)| (mantissa == ODD, multiples(mantissa, exponent)));
    let rank =
        |(is_odd, ticks): &(bool, Vec<f64>)| (!LABELS.contains(&ticks.len()), *is_odd, ticks.len().abs_diff(BEST));
    candidates.min_by_key(rank).map(|(_, ticks)| ticks).unwrap_or_default()
}

/// Powers of ten, every second one and so on if there are many; with few of them 1, 2, 5; within less, the ticks of a linear axis.
fn logarithmic_ticks(range: &Range<f64>) -> Vec<f64> {
    /// Fewest tick values that show a scale.
    const FEWEST: usize = 3;
    let exponents = range.start.log10().floor() as i32..=range.end.log10().floor() as i32;
    let ticks = |steps: &[i32]| -> Vec<f64> {
        let tick = |step: &i32, exponent: i32| format!("{step}e{exponent}").parse().unwrap_or(f64::NAN);
        let all = exponents.clone().flat_map(|e| steps.iter().map(move |step| tick(step, e)));
        all.filter(|tick| range.contains(tick)).collect()
    };
    let powers = ticks(&[1]);
    if powers.len() >= FEWEST {
        let every = powers.len().div_ceil(*LABELS.end());
        return powers.into_iter().step_by(every).collect();
    }
    Some(ticks(&[1, 2, 5])).filter(|ticks| ticks.len() >= FEWEST).unwrap_or_else(|| linear_ticks(range))
}

/// The label of a tick or a cell: only significant digits.
pub(super) fn short(value: f64) -> String {
    /// Outside of this range, an exponent is shorter than zeros.
    const FIXED: Range<f64> = 1.0e-3..1.0e5;
    /// Rounds off the rounding errors of ticks.
    const DIGITS: usize = 6;
    let rounded: f64 = format!("{value:.DIGITS$e}").parse().unwrap_or(value);
    if rounded == 0.0 || FIXED.contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_axes_have_four_to_seven_round_numbers() {
        assert_eq!(linear_ticks(&(0.0..1.0)), [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]);
        assert_eq!(linear_ticks(&(-286.0..260.0)), [-200.0, -100.0, 0.0, 100.0, 200.0]);
        assert_eq!(linear_ticks(&(0.16..0.34)), [0.175, 0.2, 0.225, 0.25, 0.275, 0.3, 0.325]);
        let mut seven = 0;
        for k in 0..4000 {
            let (start, size) = (0.37 * f64::from(k % 61) - 11.0, 10_f64.powf(f64::from(k) / 400.0 - 5.0));
            let found = linear_ticks(&(start..start + size));
            seven += usize::from(LABELS.contains(&found.len()));
            assert!((4..=8).contains(&found.len()), "{found:?} from {start} to {}", start + size);
            assert!(found.iter().all(|tick| short(*tick).len() <= 12), "{found:?}");
        }
        assert!(seven > 3900, "{seven}");
    }

    #[test]
    fn logarithmic_axes_have_powers_of_ten_or_other_round_numbers() {
        assert_eq!(logarithmic_ticks(&(0.5e-3..2.0)), [1.0e-3, 1.0e-2, 0.1, 1.0]);
        assert_eq!(logarithmic_ticks(&(0.7..30.0)), [1.0, 2.0, 5.0, 10.0, 20.0]);
        assert_eq!(logarithmic_ticks(&(0.3..1.4)), [0.4, 0.6, 0.8, 1.0, 1.2]);
        assert!(logarithmic_ticks(&(1.0e-12..1.0e9)).len() <= 7);
    }

    #[test]
    fn positions_have_labels_if_they_are_few_short_and_apart() {
        let at = |x: &[f64]| ticks_at(x, &(20.0..100.0), false, &|value| label_width(value) / 500.0);
        assert_eq!(at(&[30.0, 50.0, 70.0, 90.0]), [30.0, 50.0, 70.0, 90.0]);
        // Too many, not short, too close.
        let many: Vec<f64> = (0..30).map(|k| 20.0 + 2.5 * f64::from(k)).collect();
        let round = [20.0, 40.0, 60.0, 80.0];
        assert!(at(&many).starts_with(&round));
        assert!(at(&[33.1, 66.27]).starts_with(&round));
        assert!(at(&[30.0, 31.0, 90.0]).starts_with(&round));
        assert_eq!([0.165, 0.331, 1.25e-5, 105.0, 1010.0].map(is_readable), [true, false, true, true, false]);
    }
}
