//! Dirichlet values in the pressure equation: their rows are decoupled, and their couplings to other rows move to the right-hand side.

use crate::poisson::matrix::Matrix;

/// Eliminates the unknowns with `given` values from M x = b. Their own rows become D x = 0, decoupled from all others, so
/// that the matrix remains symmetric; the caller inserts the values after the solve.
pub(crate) fn impose(matrix: &mut Matrix, b: &mut [f64], given: impl Fn(usize) -> Option<f64>) {
    let rows: Vec<(usize, f64)> = (0..matrix.rows()).filter_map(|a| given(a).map(|value| (a, value))).collect();
    let mut touched: Vec<usize> = rows.iter().flat_map(|&(a, _)| matrix.row(a).map(|(b, _)| b)).collect();
    touched.sort_unstable();
    touched.dedup();
    for a in touched.into_iter().filter(|&a| given(a).is_none()) {
        for k in matrix.start[a]..matrix.start[a + 1] {
            if let Some(value) = given(matrix.column[k] as usize) {
                b[a] += f64::from(matrix.coupling[k]) * value;
                matrix.coupling[k] = 0.0;
            }
        }
    }
    for (a, _) in rows {
        matrix.coupling[matrix.start[a]..matrix.start[a + 1]].fill(0.0);
        b[a] = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::conjugate_gradients::SymmetricMatrix;

    #[test]
    fn a_chain_between_two_given_values_is_linear() {
        // x_0 = 3 and x_3 = 0 are given; each of the two unknowns between them is the mean of its neighbors.
        let mut matrix = Matrix {
            start: Arc::new(vec![0, 1, 3, 5, 6]),
            column: Arc::new(vec![1, 0, 2, 1, 3, 2]),
            coupling: vec![1.0; 6],
            diagonal: vec![1.0, 2.0, 2.0, 1.0],
        };
        let mut b = vec![0.0; 4];
        impose(&mut matrix, &mut b, |a| [Some(3.0), None, None, Some(0.0)][a]);
        let x = [0.0, 2.0, 1.0, 0.0];
        let mut r = vec![1.0; 4];
        matrix.residual(&b, &x, &mut r);
        assert_eq!(r, [0.0; 4]);
    }
}
