//! Warnings: what moves by itself is no current of the method.

use crate::equal_fluids::equal_fluids;
use crate::support::flow::solver;
use meniscus_core::solver::{Series, Solver};

/// The warnings at the end of a run of a free drop of a thin liquid, with `records` until `end` (s).
fn warnings(wetting: &str, velocity: &str, end: f64, records: u32) -> Vec<String> {
    let mut solver = solver(&format!(
        "{}[[sph.initial.wetting]]\n{wetting}\n[sph.initial.velocity]\n{velocity}\n",
        equal_fluids(8.0e-4, 5.0e-5, 1.2e-3)
    ));
    let mut series = Series::default();
    for record in 0..=records {
        while solver.time() < end * f64::from(record) / f64::from(records) {
            solver.step(end * f64::from(record) / f64::from(records)).unwrap();
        }
        let row = solver.sample();
        series.columns = row.iter().map(|sample| sample.name.to_owned()).collect();
        series.rows.push(row.iter().map(|sample| sample.value).collect());
    }
    solver.warnings(&series)
}

#[test]
fn a_drop_that_moves_with_its_surroundings_has_no_parasitic_currents() {
    let found = warnings("disc = { center = [0.0, 0.0], radius = 4.0e-4 }", "uniform = [1.0, 0.3]", 2.0e-3, 30);
    assert!(found.is_empty(), "{found:?}");
}

/// Half a period of the oscillation is `π/√(3σ/(ρR³))` in two equal fluids: 3.2 ms.
#[test]
fn an_oscillation_is_no_parasitic_current() {
    let ellipse = "polygon = { outer = [[4.1e-4, 0.0], [3.79e-4, 1.49e-4], [2.9e-4, 2.76e-4], [1.57e-4, 3.6e-4], [0.0, 3.9e-4], \
                   [-1.57e-4, 3.6e-4], [-2.9e-4, 2.76e-4], [-3.79e-4, 1.49e-4], [-4.1e-4, 0.0], [-3.79e-4, -1.49e-4], \
                   [-2.9e-4, -2.76e-4], [-1.57e-4, -3.6e-4], [0.0, -3.9e-4], [1.57e-4, -3.6e-4], [2.9e-4, -2.76e-4], \
                   [3.79e-4, -1.49e-4]] }";
    let found = warnings(ellipse, "rest = {}", 16.0e-3, 100);
    assert!(found.is_empty(), "{found:?}");
}
