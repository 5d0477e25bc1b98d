//! The work of fixed small runs, counted: time steps, iterations of the pressure and of the viscous solve, pairs. Wall time varies with
//! the machine and with what else it does; counts do not. A run that needs more than it did fails here.
//!
//! `cargo test --release --test sph counted_work -- --nocapture` prints the counts. Where a change is worth its price, or makes work
//! less, write the printed counts here.

use crate::support::flow::flow;
use meniscus_sph::flow::Flow;

/// Counts may rise by this share: rounding differs between processors and may add an iteration here and there.
const RISE: f64 = 0.03;

/// What is counted over a run.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Counts {
    steps: u64,
    pressure_iterations: u64,
    viscous_iterations: u64,
    /// Pairs of neighbors at the end.
    pairs: u64,
}

/// The fluids of a drop, wetting phase first: density in kg/m³ and viscosity in Pa s.
fn drop_of([density, viscosity]: [f64; 2], [other_density, other_viscosity]: [f64; 2]) -> String {
    format!(
        "[sph.phases.wetting]\ndensity = {density:?} # kg/m3\nviscosity = {viscosity:?} # Pa s\n\
         [sph.phases.non-wetting]\ndensity = {other_density:?} # kg/m3\nviscosity = {other_viscosity:?} # Pa s\n\
         [sph.interface]\ntension = 0.02 # N/m\n"
    )
}

/// A case in a box of 1 mm by 0.6 mm, a fluid of 375 particles, until `end` in s.
fn case(end: f64, sph: &str) -> String {
    format!(
        "format = 1\ntitle = \"Counted work\"\n[geometry]\nmin = [0.0, 0.0] # m\nmax = [1.0e-3, 6.0e-4] # m\n\
         [time]\nend = {end:?} # s\n[sph]\nspacing = 4.0e-5 # m\n{sph}"
    )
}

const WALLS: &str = "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n";
const ON_FLOOR: &str = "[[sph.initial.wetting]]\ndisc = { center = [5.0e-4, 0.0], radius = 2.8e-4 } # m\n";
const ANGLE: &str = "[sph.wetting.young]\ncontact-angle-deg = 60.0\n";

/// Runs the case to `end` in s and holds the counts against those it had.
#[track_caller]
fn holds(text: &str, end: f64, had: Counts) {
    let mut flow: Flow = flow(text);
    while flow.state.time < end {
        flow.step(end).expect("a step");
    }
    let found = Counts {
        steps: flow.work.steps,
        pressure_iterations: flow.work.iterations,
        viscous_iterations: flow.work.viscous_iterations,
        pairs: flow.neighborhood.pairs.len() as u64,
    };
    println!("{found:?}");
    let more = |found: u64, had: u64| found as f64 > (1.0 + RISE) * had as f64;
    let is_more = more(found.steps, had.steps)
        || more(found.pressure_iterations, had.pressure_iterations)
        || more(found.viscous_iterations, had.viscous_iterations)
        || more(found.pairs, had.pairs);
    assert!(!is_more, "the run needs more than it did, by more than {RISE}:\nfound {found:?}\nhad   {had:?}");
}

#[test]
fn a_drop_that_spreads_on_a_wall() {
    let fluids = drop_of([800.0, 8.0e-3], [800.0, 8.0e-3]);
    let had = Counts { steps: 13, pressure_iterations: 119, viscous_iterations: 105, pairs: 13_426 };
    holds(&case(1.0e-3, &format!("{fluids}{WALLS}{ON_FLOOR}{ANGLE}")), 1.0e-3, had);
}

#[test]
fn a_drop_in_a_light_gas() {
    let fluids = drop_of([1000.0, 5.0e-3], [1.0, 2.0e-5]);
    let had = Counts { steps: 17, pressure_iterations: 160, viscous_iterations: 107, pairs: 13_246 };
    holds(&case(5.0e-4, &format!("{fluids}{WALLS}{ON_FLOOR}{ANGLE}")), 5.0e-4, had);
}

#[test]
fn a_thick_drop() {
    let fluids = drop_of([1000.0, 0.2], [100.0, 0.02]);
    let had = Counts { steps: 16, pressure_iterations: 128, viscous_iterations: 145, pairs: 13_042 };
    holds(&case(1.0e-3, &format!("{fluids}{WALLS}{ON_FLOOR}{ANGLE}")), 1.0e-3, had);
}

#[test]
fn a_drop_with_the_continuum_surface_force() {
    let fluids = drop_of([800.0, 8.0e-3], [800.0, 8.0e-3]);
    let had = Counts { steps: 8, pressure_iterations: 88, viscous_iterations: 61, pairs: 13_066 };
    holds(&case(5.0e-4, &format!("{fluids}{WALLS}{ON_FLOOR}{ANGLE}[sph.surface-force.csf]\n")), 5.0e-4, had);
}

#[test]
fn a_flow_between_plates() {
    let fluid =
        "gravity = [1.0, 0.0] # m/s2\n[sph.phases.wetting]\ndensity = 1000.0 # kg/m3\nviscosity = 5.0e-3 # Pa s\n";
    let had = Counts { steps: 23, pressure_iterations: 322, viscous_iterations: 239, pairs: 12_632 };
    holds(&case(2.0e-2, &format!("{fluid}{WALLS}")), 2.0e-2, had);
}
