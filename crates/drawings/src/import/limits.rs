//! Limits that keep a small file from expanding to a huge drawing: nested copies, declared counts, extreme coordinates.

use meniscus_core::math::Vec2;

/// The largest magnitude of a coordinate, in any unit: a hundred times the diameter of the observable universe in nm. Its square is finite, so that no length
/// derived from it overflows.
const LARGEST_COORDINATE: f64 = 1e38;
/// Number of items allowed for a file of any size; each takes about 100 bytes.
const FREE_ITEMS: usize = 500_000;

/// The remaining number of items, shapes and vertices alike, that a file may expand to.
#[derive(Debug)]
pub(crate) struct Budget {
    left: usize,
    /// Number of items that the file could expand to.
    pub(crate) total: usize,
}

impl Budget {
    /// The budget of a file of `bytes` bytes: 500,000 items and one more for each byte.
    pub(crate) fn of_file(bytes: usize) -> Self {
        let total = FREE_ITEMS.saturating_add(bytes);
        Self { left: total, total }
    }

    /// Subtracts `items`; false if fewer are left.
    pub(crate) fn spend(&mut self, items: usize) -> bool {
        match self.left.checked_sub(items) {
            Some(left) => {
                self.left = left;
                true
            }
            None => false,
        }
    }
}

/// Whether the coordinates of a point are in range.
pub(crate) fn is_in_range(x: Vec2) -> bool {
    x.x.abs() <= LARGEST_COORDINATE && x.y.abs() <= LARGEST_COORDINATE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_is_spent_to_its_end_and_not_beyond() {
        let mut budget = Budget::of_file(10);
        assert_eq!(budget.total, FREE_ITEMS + 10);
        assert!(budget.spend(FREE_ITEMS) && budget.spend(10));
        assert!(!budget.spend(1) && budget.spend(0));
    }

    #[test]
    fn numbers_that_are_none_are_out_of_range() {
        assert!(is_in_range(Vec2::new(1e38, -1e38)));
        for bad in [f64::NAN, f64::INFINITY, 1e39] {
            assert!(!is_in_range(Vec2::new(bad, 0.0)) && !is_in_range(Vec2::new(0.0, bad)));
        }
    }
}
