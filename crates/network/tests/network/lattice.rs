//! A flat front in a square lattice of discs: the events of its menisci in closed form, and the wetting transition between them.

use std::f64::consts::PI;

use meniscus_network::displacement::{Conditions, Displacement, Event, EventKind};
use meniscus_network::extract;
use meniscus_network::graph::Pores;

use crate::scenes::{TOP_BOTTOM, disc, grains};

/// The events of invasion from below between rows of discs of the radius `r` at the distance 1, the angle through the invading phase in degrees.
fn events(r: f64, deg: f64) -> Vec<Event> {
    let (columns, rows) = (3_u32, 4_u32);
    let place = |k: u32| f64::from(k) + 0.5;
    let discs = (0..columns).flat_map(|i| (0..rows).map(move |j| disc(place(i), place(j), r)));
    let geometry = grains([3.0, 4.0], discs.collect()).with_periodic([true, false]);
    let network = extract(&geometry, TOP_BOTTOM).unwrap();
    let pores = Pores::merged(&network, 0.95);
    let conditions = Conditions {
        inlet: [false, false, true, false],
        outlet: [false, false, false, true],
        ..Conditions::new(vec![PI - deg.to_radians(); 16])
    };
    Displacement::new(&network, &pores, conditions).collect()
}

/// [CieplakRobbins1990]: the largest curvature between two discs; that at which neighboring menisci meet on top of the disc between them.
fn in_closed_form(r: f64, deg: f64) -> [f64; 2] {
    let (sin, cos) = deg.to_radians().sin_cos();
    [1.0 / (r * cos + (0.25 - r * r * sin * sin).sqrt()), 2.0 * sin]
}

/// [CieplakRobbins1990]: menisci meet first, and the front advances row by row, where tan θ < 1/(2 R).
#[test]
fn a_flat_front_in_a_square_lattice_meets_or_bursts_as_the_closed_form_says() {
    for r in [0.3, 0.35, 0.4] {
        let transition = f64::atan(0.5 / r).to_degrees();
        for deg in [
            10.0,
            30.0,
            45.0,
            transition - 3.0,
            transition - 0.1,
            transition + 0.1,
            transition + 3.0,
            90.0,
            120.0,
            150.0,
        ] {
            let [burst, overlap] = in_closed_form(r, deg);
            let all = events(r, deg);
            let first = &all[0];
            let is_compact = deg < transition;
            let (kind, curvature) = if is_compact { (EventKind::Overlap, overlap) } else { (EventKind::Burst, burst) };
            assert_eq!(first.kind, kind, "R {r}, {deg} degrees");
            assert!(
                (first.curvature - curvature).abs() < 1e-9,
                "R {r}, {deg} degrees: {} {curvature}",
                first.curvature
            );
            // All rows are alike.
            assert!(all.iter().all(|event| event.applied <= curvature + 1e-9), "R {r}, {deg} degrees");
        }
    }
}

/// Touch of the next row, in the narrow window before both others: R .45, 47 degrees, [CieplakRobbins1988].
#[test]
fn in_a_dense_lattice_menisci_touch_the_next_row_in_a_window_of_angles() {
    let (r, deg) = (0.45, 47.0_f64);
    let cos = deg.to_radians().cos();
    // (a² - 1) x² + (2 R cos θ - a) x + 1/2 - R² = 0 for the radius x, a = R (1 + cos θ).
    let a = r * (1.0 + cos);
    let [second, first, constant] = [a * a - 1.0, 2.0 * r * cos - a, 0.5 - r * r];
    let root = (first * first - 4.0 * second * constant).sqrt();
    let radius =
        [(-first + root) / (2.0 * second), (-first - root) / (2.0 * second)].into_iter().find(|x| *x > 0.0).unwrap();
    let found = &events(r, deg)[0];
    assert_eq!(found.kind, EventKind::Touch);
    assert!((found.curvature - 1.0 / radius).abs() < 1e-9, "{} {}", found.curvature, 1.0 / radius);
    assert_eq!(events(r, 45.0)[0].kind, EventKind::Overlap);
    assert_eq!(events(r, 50.0)[0].kind, EventKind::Burst);
}
