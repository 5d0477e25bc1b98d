//! Samples of several uncertain values: an Owen-scrambled Sobol sequence (Burley 2020), a Gaussian copula, and the matrices of Saltelli.

use nalgebra::{DMatrix, DVector};
use sobol_burley::{NUM_DIMENSIONS, sample};
use statrs::distribution::{ContinuousCDF, Normal};

/// Most inputs: for Sobol indices each needs two dimensions of the sequence.
pub(super) const MOST_INPUTS: usize = NUM_DIMENSIONS as usize / 2;

/// Half the step of the sequence, which has 23 bits: with it, no coordinate is 0 or 1.
const HALF_A_STEP: f64 = 0.5 / (1 << 23) as f64;

/// The role of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Matrix {
    /// The first sample.
    A,
    /// A second one, independent of it.
    B,
    /// The first sample with the input of this index from the second one.
    Mixed(usize),
}

/// A row of probabilities, one for each input, each between 0 and 1.
pub(super) type Row = (Matrix, Vec<f64>);

/// The coordinate of a point of the sequence in a dimension.
fn coordinate(point: usize, dimension: usize, seed: u32) -> f64 {
    f64::from(sample(point as u32, dimension as u32, seed)) + HALF_A_STEP
}

/// `count` independent samples of `inputs` inputs \[Burley2020\].
pub(super) fn plain(count: usize, inputs: usize, seed: u32) -> Vec<Row> {
    (0..count).map(|point| (Matrix::A, (0..inputs).map(|k| coordinate(point, k, seed)).collect())).collect()
}

/// The rows for Sobol indices [SaltelliEtAl2010, Sect. 3]: for each sample one of A, one of B, and one of A with the column of B for each input. Samples follow
/// one another, so that the first rows are those of fewer samples.
pub(super) fn saltelli(count: usize, inputs: usize, seed: u32) -> Vec<Row> {
    let rows = |point: usize| {
        let [a, b] =
            [0, inputs].map(|first| (first..first + inputs).map(|k| coordinate(point, k, seed)).collect::<Vec<_>>());
        let mixed = |k: usize| {
            let mut row = a.clone();
            row[k] = b[k];
            (Matrix::Mixed(k), row)
        };
        let mixed: Vec<Row> = (0..inputs).map(mixed).collect();
        [(Matrix::A, a), (Matrix::B, b)].into_iter().chain(mixed)
    };
    (0..count).flat_map(rows).collect()
}

/// Correlates the probabilities by a Gaussian copula with the lower triangular `factor`.
pub(super) fn correlated(probabilities: &[f64], factor: &DMatrix<f64>) -> Vec<f64> {
    let normal = Normal::standard();
    let independent =
        DVector::from_iterator(probabilities.len(), probabilities.iter().map(|it| normal.inverse_cdf(*it)));
    (factor * independent).iter().map(|value| normal.cdf(*value)).collect()
}

/// The lower triangular factor of a correlation matrix; `None` if it is not positive definite.
pub(super) fn factor(matrix: DMatrix<f64>) -> Option<DMatrix<f64>> {
    Some(matrix.cholesky()?.l())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Burley2020]
    #[test]
    fn a_sample_of_a_power_of_two_has_one_value_in_each_stratum() {
        const COUNT: usize = 256;
        for dimension in 0..3 {
            let mut strata: Vec<usize> =
                plain(COUNT, 3, 7).iter().map(|(_, row)| (row[dimension] * COUNT as f64) as usize).collect();
            strata.sort_unstable();
            assert_eq!(strata, (0..COUNT).collect::<Vec<_>>());
        }
        assert_ne!(plain(4, 1, 1), plain(4, 1, 2));
        assert_eq!(plain(4, 2, 1), plain(8, 2, 1)[..4]);
    }

    /// [SaltelliEtAl2010, Sect. 3]
    #[test]
    fn a_mixed_row_has_one_column_of_the_other_matrix() {
        let rows = saltelli(8, 2, 1);
        assert_eq!(rows.len(), 8 * 4);
        for sample in rows.chunks(4) {
            let [a, b, first, second] = [0, 1, 2, 3].map(|k| &sample[k].1);
            assert_eq!((first, second), (&vec![b[0], a[1]], &vec![a[0], b[1]]));
        }
    }

    #[test]
    fn the_copula_has_the_correlation_that_was_asked_for() {
        let factor = factor(DMatrix::from_row_slice(2, 2, &[1.0, 0.6, 0.6, 1.0])).unwrap();
        let normal = Normal::standard();
        let rows: Vec<Vec<f64>> = plain(4096, 2, 3)
            .iter()
            .map(|(_, row)| correlated(row, &factor).iter().map(|it| normal.inverse_cdf(*it)).collect())
            .collect();
        let mean = |of: &dyn Fn(&Vec<f64>) -> f64| rows.iter().map(of).sum::<f64>() / rows.len() as f64;
        for k in 0..2 {
            assert!(mean(&|row| row[k]).abs() < 2e-3 && (mean(&|row| row[k] * row[k]) - 1.0).abs() < 5e-3);
        }
        assert!((mean(&|row| row[0] * row[1]) - 0.6).abs() < 5e-3);
    }

    #[test]
    fn correlations_that_contradict_each_other_have_no_factor() {
        let matrix = DMatrix::from_row_slice(3, 3, &[1.0, 0.9, 0.9, 0.9, 1.0, -0.9, 0.9, -0.9, 1.0]);
        assert_eq!(factor(matrix), None);
    }
}
