//! Measures of similarity of two displacements.

/// Spearman's rank correlation of pairs, ties by their mean rank; `None` for fewer than three pairs and if one side is constant.
pub(crate) fn correlation(pairs: &[[usize; 2]]) -> Option<f64> {
    if pairs.len() < 3 {
        return None;
    }
    let [a, b] = [0, 1].map(|side| ranks(pairs.iter().map(|pair| pair[side]).collect()));
    let mean = 0.5 * (pairs.len() + 1) as f64;
    let sum = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum::<f64>();
    let scale = (sum(&a, &a) * sum(&b, &b)).sqrt();
    (scale > 0.0).then(|| sum(&a, &b) / scale)
}

/// The rank of each value, from 1; equal values share the mean of theirs.
fn ranks(values: Vec<usize>) -> Vec<f64> {
    let rank = |value: &usize| {
        let below = values.iter().filter(|other| *other < value).count();
        let equal = values.iter().filter(|other| *other == value).count();
        below as f64 + 0.5 * (equal + 1) as f64
    };
    values.iter().map(rank).collect()
}

/// Number of cells in both divided by that in either (Jaccard index); 1 if there are none.
pub(crate) fn overlap(one: &[bool], other: &[bool]) -> f64 {
    let count = |keep: fn(bool, bool) -> bool| one.iter().zip(other).filter(|(a, b)| keep(**a, **b)).count() as f64;
    let either = count(|a, b| a || b);
    if either > 0.0 { count(|a, b| a && b) / either } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rank_correlation_is_one_in_the_same_order_and_minus_one_in_the_opposite_one() {
        assert_eq!(correlation(&[[1, 2], [5, 3], [7, 9]]), Some(1.0));
        assert_eq!(correlation(&[[1, 9], [5, 3], [7, 2]]), Some(-1.0));
        assert_eq!(correlation(&[[1, 9], [5, 3]]), None);
        assert_eq!(correlation(&[[1, 9], [1, 3], [1, 4]]), None);
        // Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: 4.5 over the square root of 4.5 times 5.
        let tied = correlation(&[[1, 1], [2, 2], [2, 3], [3, 4]]).unwrap();
        assert!((tied - 4.5 / (4.5_f64 * 5.0).sqrt()).abs() < 1e-15);
    }

    #[test]
    fn the_overlap_is_what_both_have_over_what_either_has() {
        assert_eq!(overlap(&[true, true, false, false], &[true, false, true, false]), 1.0 / 3.0);
        assert_eq!(overlap(&[false], &[false]), 1.0);
    }
}
