//! Evaluation of the time series for benchmarks: pairs of columns, means over the last records, extrema between records.

use meniscus_core::solver::Series;

/// The values of two columns of the series, row by row.
pub(crate) fn pairs(series: &Series, column: &str) -> (Vec<f64>, Vec<f64>) {
    series.column("time_s").zip(series.column(column)).unzip()
}

/// A maximum or minimum, interpolated between records.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extremum {
    /// Time in s.
    pub(crate) time: f64,
    /// The value, in the unit of the column.
    pub(crate) value: f64,
}

/// The vertex of the parabola through the record `row` and its neighbors, if `row` is the largest or smallest of the three; else the record itself.
pub(crate) fn extremum(times: &[f64], values: &[f64], row: usize) -> Extremum {
    let at = |row: usize| Some((*times.get(row)?, *values.get(row)?));
    let (time, value) = at(row).unwrap_or((f64::NAN, f64::NAN));
    let vertex = || {
        let ((t0, v0), (t2, v2)) = (at(row.checked_sub(1)?)?, at(row + 1)?);
        let (before, after) = ((value - v0) / (time - t0), (v2 - value) / (t2 - time));
        let bend = (after - before) / (t2 - t0);
        let slope = before + bend * (time - t0);
        let step = -slope / (2.0 * bend);
        let inside = (t0 - time..=t2 - time).contains(&step);
        inside.then_some(Extremum { time: time + step, value: value + 0.5 * slope * step })
    };
    vertex().unwrap_or(Extremum { time, value })
}

/// Last fraction of the time over which means are taken.
pub(crate) const LAST_QUARTER: f64 = 0.25;

/// Mean and standard deviation of a column over the last part of the records, omitting missing values.
pub(crate) fn last_mean(series: &Series, column: &str) -> (f64, f64) {
    let values: Vec<f64> = last(series, column, LAST_QUARTER).into_iter().map(|(_, value)| value).collect();
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    (mean, (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt())
}

/// Times in s and values of a column over the last fraction `part` of the time.
pub(crate) fn last(series: &Series, column: &str, part: f64) -> Vec<(f64, f64)> {
    let end = series.column("time_s").last().unwrap_or(f64::NAN);
    let all = series.column("time_s").zip(series.column(column));
    all.filter(|(time, value)| *time >= (1.0 - part) * end && value.is_finite()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_between_records_is_found() {
        let times: Vec<f64> = (0..=20).map(|i| 0.1 * f64::from(i)).collect();
        let values: Vec<f64> = times.iter().map(|t| (t * 1.5).sin()).collect();
        let peak = extremum(&times, &values, 10);
        assert!((peak.time - std::f64::consts::FRAC_PI_2 / 1.5).abs() < 1e-3 && (peak.value - 1.0).abs() < 1e-4);
        let end = extremum(&times, &values, 20);
        assert_eq!((end.time, end.value), (times[20], values[20]));
    }
}
