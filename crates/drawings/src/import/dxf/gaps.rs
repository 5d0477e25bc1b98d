//! Gaps between ends of lines.

use meniscus_core::math::Vec2;

/// Maximum width of a gap over the size of the lines.
const WIDEST: f64 = 1e-3;
/// Maximum number of ends; a drawing with more open lines is a sketch.
const MOST: usize = 100_000;

/// A gap between two free ends, by their indices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gap {
    pub(crate) width: f64,
    pub(crate) ends: [usize; 2],
}

/// The gap from each free end of a line to the nearest other one, each once, the widest first.
pub(crate) fn gaps(ends: &[Vec2], size: f64) -> Vec<Gap> {
    let reach = WIDEST * size;
    let mut order: Vec<usize> = (0..ends.len().min(MOST)).collect();
    order.sort_by(|&i, &j| ends[i].x.total_cmp(&ends[j].x));
    let mut nearest: Vec<Option<Gap>> = vec![None; ends.len()];
    for (k, &i) in order.iter().enumerate() {
        for &j in order[k + 1..].iter().take_while(|&&j| ends[j].x - ends[i].x <= reach) {
            let gap = Gap { width: (ends[j] - ends[i]).norm(), ends: [i.min(j), i.max(j)] };
            for end in [i, j].into_iter().filter(|_| gap.width <= reach) {
                if nearest[end].is_none_or(|known| gap.width < known.width) {
                    nearest[end] = Some(gap);
                }
            }
        }
    }
    let mut found: Vec<Gap> = nearest.into_iter().flatten().collect();
    found.sort_by(|a, b| b.width.total_cmp(&a.width).then(a.ends.cmp(&b.ends)));
    found.dedup();
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_gap_is_told_once_and_far_ends_have_none() {
        let ends = [[0.0, 0.0], [9.0, 9.0], [1e-3, 0.0], [5.0, 5.0], [5.0, 5.002]].map(Vec2::from);
        let found = gaps(&ends, 12.0);
        assert_eq!(found.iter().map(|gap| gap.ends).collect::<Vec<_>>(), [[3, 4], [0, 2]]);
        assert!((found[0].width - 2e-3).abs() < 1e-12 && (found[1].width - 1e-3).abs() < 1e-12);
    }
}
