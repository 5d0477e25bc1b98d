//! Periodic sides and walls on the sides of the domain.

use std::f64::consts::PI;

use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{HalfPlane, ShapeSpec, SolidSide, ThroatCosine};
use proptest::prelude::*;

use crate::shapes::*;

#[test]
fn solids_are_seen_through_periodic_sides() {
    let g = solid(vec![disc(1.9, 0.0, 0.5)]).with_periodic([true, false]);
    assert!((g.signed_distance(v(-1.5, 0.0)) - 0.1).abs() < 1e-12);
    assert!(g.is_solid(v(-1.9, 0.0)));
    assert!((g.wall(v(-1.5, 0.0)).normal - v(1.0, 0.0)).norm() < 1e-12);
    assert!((g.porosity().value - (1.0 - 0.25 * PI / 16.0)).abs() < 1e-12);
    let wall = ShapeSpec::HalfPlane(HalfPlane { point: [-1.5, 0.0], rotation_deg: -90.0 });
    let g = solid(vec![wall]).with_periodic([true, true]);
    assert!((g.signed_distance(v(1.8, 0.3)) - 0.2).abs() < 1e-12);
    assert!((g.signed_distance(v(-1.3, 0.3)) - 0.2).abs() < 1e-12);
    assert!((g.porosity().value - 0.875).abs() < 1e-12);
    let flat = solid(vec![ShapeSpec::HalfPlane(HalfPlane { point: [0.0, -1.0], rotation_deg: 0.0 })]);
    let flat = flat.with_periodic([true, false]);
    assert!((flat.signed_distance(v(1.9, 0.0)) - 1.0).abs() < 1e-12);
    assert!((flat.signed_distance(v(2.0, -2.0)) + 1.0).abs() < 1e-12);
}

#[test]
fn a_cosine_throat_repeats_along_its_axis() {
    let throat = ThroatCosine { center: [1.5, 0.0], width: 1.6, throat: 0.4, length: 2.0, rotation_deg: 0.0 };
    let g = solid(vec![ShapeSpec::ThroatCosine(throat)]).with_periodic([true, false]);
    // The constriction reaches from 0.5 to 2.5; what lies beyond the side is cut, so the image shows the straight part.
    assert!((g.signed_distance(v(1.5, 0.0)) - 0.2).abs() < 1e-6);
    // The cut face of the image: the half width is 0.5 where the side cuts the constriction.
    assert!(g.is_solid(v(-1.99, 0.81)) && !g.is_solid(v(-1.99, 0.79)) && g.is_solid(v(1.99, 0.6)));
    // From the middle of the side, the nearest wall is that of the constriction, seen through the side.
    let half = |s: f64| 0.8 - 0.3 * (1.0 + (PI * s).cos());
    let nearest =
        (0..5000).map(|k| f64::from(k) * 1e-4).map(|s| (0.5 - s).hypot(half(s))).fold(f64::INFINITY, f64::min);
    assert!((g.signed_distance(v(-2.0, 0.0)) - nearest).abs() < 1e-6);
    assert!((g.signed_distance(v(-1.0, 0.0)) - 0.8).abs() < 1e-9);
}

#[test]
fn wall_sides_are_solid_and_come_after_the_shapes() {
    let g = solid(vec![disc(0.0, 0.0, 0.5)]).with_wall_sides([true, false, true, false]);
    assert!((g.signed_distance(v(-1.9, 1.0)) - 0.1).abs() < 1e-12);
    assert_eq!(g.wall(v(-1.9, 1.0)).shape, 1);
    assert_eq!(g.wall(v(1.0, -1.9)).shape, 3);
    assert!(g.is_solid(v(-2.1, 0.0)) && !g.is_solid(v(2.1, 0.0)));
    assert!((g.wall_length() - (8.0 + PI)).abs() < 1e-9);
    assert!((g.porosity().value - (1.0 - 0.25 * PI / 16.0)).abs() < 1e-12);
    // The corner of the box, seen from the solid.
    assert!((g.signed_distance(v(-2.3, -2.4)) + 0.5).abs() < 1e-12);
}

#[test]
fn wall_sides_cut_a_pore_that_is_given_by_its_shapes() {
    let spec = spec(vec![disc(0.0, 0.0, 2.5)], SolidSide::Outside);
    let g = Geometry::new(&spec).unwrap().with_wall_sides([true, true, false, false]);
    assert!((g.signed_distance(v(1.5, 0.0)) - 0.5).abs() < 1e-12);
    assert!((g.signed_distance(v(0.0, 2.3)) - 0.2).abs() < 1e-12);
    // The rim of the pore where the wall cuts the circle.
    assert!((g.signed_distance(v(2.0, 1.5))).abs() < 1e-12);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn periodic_discs_are_as_far_as_the_nearest_of_their_images(
        x in (-2.0..2.0_f64, -2.0..2.0_f64),
        discs in proptest::collection::vec((-2.0..2.0_f64, -2.0..2.0_f64, 0.05..0.6_f64), 1..8),
    ) {
        let x = v(x.0, x.1);
        let g = solid(discs.iter().map(|d| disc(d.0, d.1, d.2)).collect()).with_periodic([true, true]);
        let images = (-1..=1).flat_map(|i| (-1..=1).map(move |j| v(4.0 * f64::from(i), 4.0 * f64::from(j))));
        let nearest = images
            .flat_map(|by| discs.iter().map(move |d| (x - by - v(d.0, d.1)).norm() - d.2))
            .fold(f64::INFINITY, f64::min);
        let found = g.signed_distance(x);
        prop_assert_eq!(found > 0.0, nearest > 0.0);
        if nearest > 0.0 {
            prop_assert!((found - nearest).abs() < 1e-12);
        } else {
            prop_assert!(found <= nearest + 1e-12);
        }
        prop_assert!(g.porosity().uncertainty < 1e-9);
    }
}
