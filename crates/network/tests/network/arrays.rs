//! Regular arrays of discs and posts in closed form.

use std::f64::consts::PI;

use crate::invariants::assert_distances;
use crate::scenes::*;

/// [Lieutier2004]
#[test]
fn a_hexagonal_array_has_the_pores_and_throats_of_its_triangles() {
    let (r, l) = (0.4, 1.0);
    let h = 3.0_f64.sqrt() * l;
    // The cell is cut through grains and through throats.
    for shift in [0.0, 0.13] {
        let shapes = vec![disc(0.25 + shift, 0.3, r), disc(0.75 + shift, 0.3 + 0.5 * h, r)];
        let g = grains([l, h], shapes).with_periodic([true, true]);
        let n = network(&g, CLOSED);
        assert_distances(&g, &n);
        assert_values(&radii(&n), &[l / 3.0_f64.sqrt() - r; 4]);
        assert_values(&widths(&n), &[l - 2.0 * r; 6]);
        assert_values(&areas(&n), &[3.0_f64.sqrt() / 4.0 * l * l - 0.5 * PI * r * r; 4]);
        assert!(n.throats.iter().all(|throat| throat.curvatures.iter().all(|k| (k - 1.0 / r).abs() < 1e-12)));
    }
}

/// [Lieutier2004]
#[test]
fn a_square_array_has_one_pore_with_four_contacts_and_two_throats_per_cell() {
    for center in [[0.5, 0.5], [0.0, 0.0], [0.2, 1.0]] {
        let g = grains([1.0, 1.0], vec![disc(center[0], center[1], 0.3)]).with_periodic([true, true]);
        let n = network(&g, CLOSED);
        assert_distances(&g, &n);
        assert_values(&radii(&n), &[0.5_f64.sqrt() - 0.3]);
        assert_values(&widths(&n), &[0.4; 2]);
        assert_values(&areas(&n), &[1.0 - 0.09 * PI]);
        assert!(n.throats.iter().all(|throat| throat.regions == [0, 0]));
        let mut shifts: Vec<[f64; 2]> = n.throats.iter().map(|t| [t.shift.x.abs(), t.shift.y.abs()]).collect();
        shifts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        assert_eq!(shifts, [[0.0, 1.0], [1.0, 0.0]]);
    }
}

#[test]
fn a_square_array_in_a_box_has_throats_to_its_walls() {
    let shapes = (0..9).map(|k| disc(0.5 + f64::from(k % 3), 0.5 + f64::from(k / 3), 0.3)).collect();
    let g = grains([3.0, 3.0], shapes).with_wall_sides([true; 4]);
    let n = network(&g, CLOSED);
    assert_distances(&g, &n);
    // Four pores between four discs each, eight between two discs and a wall, four in the corners.
    assert_eq!((n.regions.len(), n.throats.len()), (16, 24));
    let gaps: Vec<f64> = [0.2; 12].into_iter().chain([0.4; 12]).collect();
    assert_values(&widths(&n), &gaps);
    // In a corner: the circle that touches both walls and the disc about (0.5, 0.5), x sqrt(2) = (0.5 sqrt(2) - 0.3) - x.
    let in_corner = (0.5 * 2.0_f64.sqrt() - 0.3) / (1.0 + 2.0_f64.sqrt());
    let between_four = 0.5_f64.sqrt() - 0.3;
    let found = radii(&n);
    assert_values(&found[..4], &[in_corner; 4]);
    assert_values(&found[12..], &[between_four; 4]);
}

#[test]
fn square_posts_leave_slits_and_crossings() {
    // Posts of side 0.6 at distance 1: slits of width 0.4, level along 0.6, meet in crossings.
    let g = grains([1.0, 1.0], vec![rectangle([0.5, 0.5], [0.6, 0.6])]).with_periodic([true, true]);
    let n = network(&g, CLOSED);
    assert_distances(&g, &n);
    assert_values(&radii(&n), &[0.2 * 2.0_f64.sqrt()]);
    assert_values(&widths(&n), &[0.4; 2]);
    assert_values(&areas(&n), &[0.64]);
    // The same with vertices along the sides, which turn by nothing.
    let points: Vec<[f64; 2]> = (0..60)
        .map(|k| {
            let (side, s) = (k / 15, 0.2 + 0.04 * f64::from(k % 15));
            [[s, 0.2], [0.8, s], [1.0 - s, 0.8], [0.2, 1.0 - s]][side as usize]
        })
        .collect();
    let g = grains([1.0, 1.0], vec![polygon(points)]).with_periodic([true, true]);
    let fine = network(&g, CLOSED);
    assert_values(&radii(&fine), &radii(&n));
    assert_values(&widths(&fine), &widths(&n));
    assert_values(&areas(&fine), &areas(&n));
}

#[test]
fn an_array_of_posts_in_an_open_box_counts_its_openings() {
    let shapes = (0..6).map(|k| rectangle([0.5 + f64::from(k % 3), 0.5 + f64::from(k / 3)], [0.6, 0.6])).collect();
    let g = grains([3.0, 2.0], shapes).with_wall_sides([false, false, true, true]);
    let n = network(&g, LEFT_RIGHT);
    assert_eq!(n.openings.len(), 2);
    assert!(n.openings.iter().all(|opening| ((opening.ends[1] - opening.ends[0]).norm() - 2.0).abs() < 1e-12));
}
