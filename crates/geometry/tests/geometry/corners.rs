//! Concave corners, where several walls are equally near and the distance has no gradient.

use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;

use crate::shapes::*;

fn assert_normal(geometry: &Geometry, x: Vec2, wanted: Vec2) {
    let found = geometry.wall(x).normal;
    assert!((found - wanted.normalize()).norm() < 1e-9, "{found} at {x}, wanted {}", wanted.normalize());
}

#[test]
fn on_the_diagonals_of_a_box_the_normal_halves_the_corner() {
    let g = solid(vec![]).with_wall_sides([true; 4]);
    for (x, y) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        // Down to the corner itself, where the distance is zero.
        for t in [0.3, 1.0, 1.999, 2.0 - 1e-7, 2.0] {
            let at = v(x * t, y * t);
            assert_normal(&g, at, v(-x, -y));
            assert!((g.signed_distance(at) - (2.0 - t)).abs() < 1e-12);
        }
        // Beside the diagonal the nearer wall alone counts.
        assert_normal(&g, v(1.5 * x, 1.4999 * y), v(-x, 0.0));
        assert_normal(&g, v(1.4999 * x, 1.5 * y), v(0.0, -y));
    }
}

#[test]
fn in_a_wedge_the_normal_on_the_bisector_points_along_it() {
    for opening_deg in [20.0_f64, 60.0, 90.0, 140.0] {
        let half = 0.5 * opening_deg.to_radians();
        // Two long blocks whose upper and lower sides make a wedge that opens to the right, its tip at the origin.
        let reach = v(3.0 * half.cos(), 3.0 * half.sin());
        let blocks = vec![
            polygon(&[[0.0, 0.0], [reach.x, reach.y], [-3.0, 3.0], [-3.0, 0.0]], &[]),
            polygon(&[[0.0, 0.0], [-3.0, 0.0], [-3.0, -3.0], [reach.x, -reach.y]], &[]),
        ];
        let g = solid(blocks);
        for t in [1e-4, 0.01, 0.3, 0.9] {
            assert_normal(&g, v(t, 0.0), v(1.0, 0.0));
            assert!((g.signed_distance(v(t, 0.0)) - t * half.sin()).abs() < 1e-12);
        }
        assert_normal(&g, v(0.5, 0.001), v(half.sin(), -half.cos()));
    }
}

#[test]
fn three_walls_equally_near_count_once_each() {
    // A slot: two sides and a floor, all 1 away from the middle; the sides cancel.
    let walls = [[-1.5, 0.0], [1.5, 0.0]].map(|center| rectangle(center, [1.0, 4.0], 0.0));
    let floor = rectangle([0.0, -1.5], [2.0, 1.0], 0.0);
    assert_normal(&solid([walls.to_vec(), vec![floor]].concat()), v(0.0, 0.0), v(0.0, 1.0));
}

#[test]
fn between_opposite_walls_the_normal_is_that_of_one_of_them() {
    let g = solid(vec![]).with_wall_sides([true; 4]);
    let center = g.wall(v(0.0, 0.0));
    assert!((center.normal.norm() - 1.0).abs() < 1e-12 && (center.distance - 2.0).abs() < 1e-12, "{center:?}");
    let plates = solid(vec![]).with_wall_sides([false, false, true, true]);
    assert!((plates.wall(v(0.7, 0.0)).normal.y.abs() - 1.0).abs() < 1e-12);
}

#[test]
fn corners_of_many_pieces_are_found_by_the_tree_too() {
    // 25 blocks with square yards between them: more pieces than a plain loop searches.
    let blocks = (0..25).map(|k| {
        let (i, j) = (f64::from(k % 5) - 2.0, f64::from(k / 5) - 2.0);
        rectangle([0.8 * i, 0.8 * j], [0.5, 0.5], 0.0)
    });
    let yard = polygon(
        &[[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]],
        &[&[[-0.5, -0.5], [-0.5, 0.5], [0.5, 0.5], [0.5, -0.5]]],
    );
    let g = solid(vec![yard]);
    assert_normal(&g, v(0.4, 0.4), v(-1.0, -1.0));
    let many = solid(blocks.collect());
    // The crossing of two lanes: four convex corners equally near, whose normals cancel.
    assert!((many.wall(v(0.4, 0.4)).normal.norm() - 1.0).abs() < 1e-12);
    // In a lane, both sides are equally near and opposite.
    assert!((many.wall(v(0.4, 0.0)).normal.x.abs() - 1.0).abs() < 1e-12);
    let rows = many.with_wall_sides([true, false, true, false]);
    assert_normal(&rows, v(-1.95, -1.95), v(1.0, 1.0));
}
