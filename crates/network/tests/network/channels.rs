//! Channels: level passages, straight and bent, open, closed and periodic.

use std::f64::consts::PI;

use meniscus_geometry::spec::{Channel, ShapeSpec, ThroatCosine};

use crate::invariants::assert_distances;
use crate::scenes::*;

/// A channel of width 0.4 along the middle of a box of 3 x 1.
fn channel() -> ShapeSpec {
    ShapeSpec::Channel(Channel { center: [1.5, 0.5], width: 0.4, rotation_deg: 0.0 })
}

#[test]
fn an_open_slit_is_one_throat_in_its_middle() {
    for g in [
        grains([3.0, 1.0], vec![channel()]),
        grains([3.0, 0.4], Vec::new()).with_wall_sides([false, false, true, true]),
    ] {
        let n = network(&g, LEFT_RIGHT);
        assert_values(&widths(&n), &[0.4]);
        assert_values(&areas(&n), &[0.6; 2]);
        assert_eq!(n.openings.len(), 2);
        assert!(n.throats[0].contacts.iter().all(|contact| (contact.x - 1.5).abs() < 1e-12));
        assert_eq!(n.throats[0].curvatures, [0.0; 2]);
    }
}

#[test]
fn a_periodic_slit_is_a_pore_and_a_throat() {
    let g = grains([3.0, 0.4], Vec::new()).with_wall_sides([false, false, true, true]).with_periodic([true, false]);
    let n = network(&g, CLOSED);
    assert_distances(&g, &n);
    assert_values(&widths(&n), &[0.4]);
    assert_values(&radii(&n), &[0.2]);
    assert_values(&areas(&n), &[1.2]);
    assert_eq!(n.throats[0].shift.x.abs(), 3.0);
    let apart = (n.regions[0].center.x - n.throats[0].contacts[0].x).abs();
    assert!((apart - 1.5).abs() < 1e-9, "{apart}");
}

#[test]
fn a_closed_slit_is_a_pore() {
    let g = grains([3.0, 0.4], Vec::new()).with_wall_sides([true; 4]);
    let n = network(&g, CLOSED);
    assert_distances(&g, &n);
    assert_values(&radii(&n), &[0.2]);
    assert!(n.throats.is_empty());
    assert!((n.regions[0].center.x - 1.5).abs() < 1e-9);
    let square = grains([1.0, 1.0], Vec::new()).with_wall_sides([true; 4]);
    assert_values(&radii(&network(&square, CLOSED)), &[0.5]);
}

#[test]
fn a_turned_channel_ends_at_the_sides_that_it_meets() {
    for rotation_deg in [27.0, 45.0, -60.0] {
        let g = grains([1.0, 1.0], vec![ShapeSpec::Channel(Channel { center: [0.5, 0.5], width: 0.2, rotation_deg })]);
        let n = network(&g, [true; 4]);
        assert_values(&widths(&n), &[0.2]);
        assert_eq!(n.regions.len(), 2);
        assert!(n.throats[0].contacts.iter().map(|c| c.x).sum::<f64>() - 1.0 < 1e-9);
        // Through a corner of the box two sides open.
        assert_eq!(n.openings.len(), if rotation_deg == 45.0 { 4 } else { 2 });
    }
}

#[test]
fn a_cosine_throat_is_one_throat_with_its_curvature() {
    let throat = ThroatCosine { center: [1.5, 0.5], width: 0.8, throat: 0.3, length: 2.0, rotation_deg: 0.0 };
    let g = grains([3.0, 1.0], vec![ShapeSpec::ThroatCosine(throat)]);
    let n = network(&g, LEFT_RIGHT);
    assert_eq!((n.regions.len(), n.throats.len(), n.openings.len()), (2, 1, 2));
    assert!((n.throats[0].width - 0.3).abs() < 1e-7);
    // The second derivative of the wall there.
    let curvature = 0.5 * 0.5 * 0.5 * (2.0 * PI / 2.0).powi(2);
    assert!(n.throats[0].curvatures.iter().all(|k| (k - curvature).abs() < 0.02 * curvature), "{:?}", n.throats[0]);
    let g = g.with_periodic([true, false]);
    let n = network(&g, CLOSED);
    assert_eq!((n.regions.len(), n.throats.len()), (1, 1));
}

/// The pore of a channel of width 0.2 that runs right, turns up by a quarter circle and goes on; each end closed or at the box.
fn bend(is_open: bool) -> Vec<[f64; 3]> {
    let bulge = (PI / 8.0).tan();
    let (x, y) = if is_open { (-0.5, 2.5) } else { (0.2, 1.6) };
    // Around the center (1, 1): radii 0.4 and 0.6.
    vec![
        [x, 0.4, 0.0],
        [1.0, 0.4, bulge],
        [1.6, 1.0, 0.0],
        [1.6, y, 0.0],
        [1.4, y, 0.0],
        [1.4, 1.0, -bulge],
        [1.0, 0.6, 0.0],
        [x, 0.6, 0.0],
    ]
}

#[test]
fn a_bent_channel_of_constant_width_is_one_passage() {
    let g = pores([2.0, 2.0], vec![curved(bend(true))]);
    let n = network(&g, [true, false, false, true]);
    assert_values(&widths(&n), &[0.2]);
    assert_eq!((n.regions.len(), n.openings.len()), (2, 2));
    // Both legs are 1 long: the middle is that of the bend.
    let middle = 0.5 * (n.throats[0].contacts[0] + n.throats[0].contacts[1]);
    let expected = 1.0 + 0.5 * 0.5_f64.sqrt();
    assert!((middle.x - expected).abs() < 1e-9 && (middle.y - (2.0 - expected)).abs() < 1e-9, "{middle:?}");
    let mut curvatures = n.throats[0].curvatures;
    curvatures.sort_by(f64::total_cmp);
    assert!((curvatures[0] + 1.0 / 0.6).abs() < 1e-9 && (curvatures[1] - 1.0 / 0.4).abs() < 1e-9);
    let g = pores([2.0, 2.0], vec![curved(bend(false))]);
    let n = network(&g, CLOSED);
    assert_distances(&g, &n);
    assert_values(&radii(&n), &[0.1]);
    assert!(n.throats.is_empty());
}

#[test]
fn a_sharp_bend_is_a_pore_between_two_slits() {
    let points = vec![[-0.5, 0.4], [1.6, 0.4], [1.6, 2.5], [1.4, 2.5], [1.4, 0.6], [-0.5, 0.6]];
    let n = network(&pores([2.0, 2.0], vec![polygon(points)]), [true, false, false, true]);
    assert_values(&widths(&n), &[0.2; 2]);
    assert_eq!(n.regions.len(), 3);
    let in_bend = 0.2 * 2.0_f64.sqrt() / (1.0 + 2.0_f64.sqrt());
    assert!((radii(&n)[2] - in_bend).abs() < 1e-9, "{:?}", radii(&n));
}

#[test]
fn a_disc_in_a_channel_leaves_two_throats() {
    let g = grains([3.0, 1.0], vec![disc(1.5, 0.45, 0.3)]).with_wall_sides([false, false, true, true]);
    let n = network(&g, LEFT_RIGHT);
    // Beyond the disc the slit is level up to the side, where it opens: nothing but the disc divides it.
    assert_values(&widths(&n)[..2], &[0.15, 0.25]);
    let g = g.with_periodic([true, false]);
    let n = network(&g, CLOSED);
    assert_distances(&g, &n);
    assert_values(&widths(&n), &[0.15, 0.25]);
    assert_values(&radii(&n), &[0.5]);
}

#[test]
fn an_obstacle_splits_a_slit_and_ends_its_level_part() {
    // A plate along the middle: two slits of width 0.4 beside it, level over its length.
    let g = grains([3.0, 1.0], vec![rectangle([1.5, 0.5], [1.0, 0.2])]).with_wall_sides([false, false, true, true]);
    let n = network(&g, LEFT_RIGHT);
    assert_values(&widths(&n)[..2], &[0.4, 0.4]);
    assert!(n.throats[0].contacts.iter().all(|contact| (contact.x - 1.5).abs() < 1e-9));
}
