//! Band matrices: LU factors by Gaussian elimination with row exchanges inside the band.
//!
//! For matrices of many narrow rows; the work is that of n·below·(below + above) products. No blocking, no refinement.

/// A square matrix of few diagonals, before or after its factorization.
#[derive(Debug, Clone)]
pub struct Banded {
    size: usize,
    below: usize,
    above: usize,
    /// Row by row, from column i − below to column i + above + below: exchanges of rows widen the upper part.
    values: Vec<f64>,
    pivots: Vec<usize>,
}

impl Banded {
    /// A matrix of zeros with `below` diagonals under and `above` diagonals over the main one.
    #[must_use]
    pub fn new(size: usize, below: usize, above: usize) -> Self {
        let width = 2 * below + above + 1;
        Self { size, below, above, values: vec![0.0; size * width], pivots: Vec::with_capacity(size) }
    }

    fn width(&self) -> usize {
        2 * self.below + self.above + 1
    }

    fn place(&self, row: usize, column: usize) -> usize {
        row * self.width() + column + self.below - row
    }

    /// Adds to an entry inside the band.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        debug_assert!(column + self.below >= row && column <= row + self.above);
        let place = self.place(row, column);
        self.values[place] += value;
    }

    /// The product with `x`, before the factorization.
    #[cfg(test)]
    pub fn times(&self, x: &[f64]) -> Vec<f64> {
        let entries = |row: usize| row.saturating_sub(self.below)..(row + self.above + 1).min(self.size);
        (0..self.size).map(|row| entries(row).map(|j| self.values[self.place(row, j)] * x[j]).sum()).collect()
    }

    /// Replaces the matrix by its factors; false where it is singular or not finite.
    pub fn factor(&mut self) -> bool {
        self.pivots.clear();
        for k in 0..self.size {
            let last_row = (k + self.below).min(self.size - 1);
            let last_column = (k + self.above + self.below).min(self.size - 1);
            let entry = |row: usize| self.values[self.place(row, k)].abs();
            let pivot = (k + 1..=last_row).fold(k, |best, row| if entry(row) > entry(best) { row } else { best });
            let largest = entry(pivot);
            if !(largest > 0.0 && largest.is_finite()) {
                return false;
            }
            self.pivots.push(pivot);
            if pivot != k {
                for column in k..=last_column {
                    let (a, b) = (self.place(k, column), self.place(pivot, column));
                    self.values.swap(a, b);
                }
            }
            let inverse = 1.0 / self.values[self.place(k, k)];
            let length = last_column - k;
            let upper = self.place(k, k);
            for row in k + 1..=last_row {
                let start = self.place(row, k);
                let share = self.values[start] * inverse;
                self.values[start] = share;
                if share != 0.0 {
                    // Row k stands before this one in memory.
                    let (head, tail) = self.values.split_at_mut(start);
                    let source = &head[upper + 1..upper + 1 + length];
                    tail[1..=length].iter_mut().zip(source).for_each(|(value, above)| *value -= share * above);
                }
            }
        }
        true
    }

    /// Replaces `b` by the solution of the factored system.
    pub fn solve(&self, b: &mut [f64]) {
        for (k, &pivot) in self.pivots.iter().enumerate() {
            b.swap(k, pivot);
            let value = b[k];
            let last = (k + self.below).min(self.size - 1);
            for (offset, later) in b[k + 1..=last].iter_mut().enumerate() {
                *later -= self.values[self.place(k + 1 + offset, k)] * value;
            }
        }
        for k in (0..self.size).rev() {
            let last = (k + self.above + self.below).min(self.size - 1);
            let known: f64 = (k + 1..=last).map(|j| self.values[self.place(k, j)] * b[j]).sum();
            b[k] = (b[k] - known) / self.values[self.place(k, k)];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solved_system_gives_back_its_right_side() {
        for (size, below, above) in [(1, 0, 0), (6, 2, 1), (40, 7, 5), (40, 1, 6), (4, 3, 3)] {
            let mut matrix = Banded::new(size, below, above);
            for row in 0..size {
                for column in row.saturating_sub(below)..(row + above + 1).min(size) {
                    // No large diagonal: rows have to be exchanged.
                    matrix.add(row, column, (1.0 + (3 * row * row + 7 * column + 5 * row * column) as f64).sin());
                }
            }
            let x: Vec<f64> = (0..size).map(|i| 1.0 + (0.7 * i as f64).cos()).collect();
            let mut b = matrix.times(&x);
            assert!(matrix.factor());
            matrix.solve(&mut b);
            let error = b.iter().zip(&x).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(error < 1.0e-9, "{size} {below} {above}: {error}");
        }
    }

    #[test]
    fn a_singular_matrix_is_refused() {
        let mut matrix = Banded::new(3, 1, 1);
        matrix.add(0, 0, 1.0);
        assert!(!matrix.factor());
    }
}
