//! Distances and normals against closed forms and brute force.

use std::f64::consts::{FRAC_PI_2, PI};

use meniscus_core::math::Vec2;
use meniscus_geometry::spec::{Capsule, HalfPlane, Polygon, ShapeSpec};
use proptest::prelude::*;

use crate::shapes::*;

/// Points of the true surface: places where membership in the union changes, found on many short lines.
fn distance_by_search(is_solid: &dyn Fn(Vec2) -> bool, x: Vec2, reach: f64) -> f64 {
    let here = is_solid(x);
    let first_change = |angle: f64| {
        let t = v(angle.cos(), angle.sin());
        let step = 4e-3;
        let mut far = step;
        while far < reach {
            if is_solid(x + t * far) != here {
                let (mut a, mut b) = (far - step, far);
                for _ in 0..40 {
                    let middle = 0.5 * (a + b);
                    if is_solid(x + t * middle) == here { a = middle } else { b = middle }
                }
                return b;
            }
            far += step;
        }
        f64::INFINITY
    };
    (0..2000).map(|k| first_change(2.0 * PI * f64::from(k) / 2000.0)).fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn distance_never_changes_faster_than_the_point_moves(x in point(), y in point(), t in 0.0..1.0_f64) {
        let y = x + (y - x) * t.powi(4);
        for g in [solid(zoo()), outside()] {
            let (dx, dy) = (g.signed_distance(x), g.signed_distance(y));
            prop_assert!((dx - dy).abs() <= (x - y).norm() + 1e-12, "{dx} {dy} {}", (x - y).norm());
        }
    }

    #[test]
    fn sign_agrees_with_membership_and_the_complement_turns_it(x in point()) {
        let inside = zoo().iter().any(|shape| is_in(shape, x));
        let (g, c) = (solid(zoo()), outside());
        let (wall, other) = (g.wall(x), c.wall(x));
        prop_assume!(wall.distance.abs() > 1e-9);
        prop_assert_eq!(wall.distance < 0.0, inside);
        prop_assert_eq!(g.is_solid(x), inside);
        prop_assert_eq!(c.is_solid(x), !inside);
        prop_assert!((wall.distance + other.distance).abs() < 1e-12);
    }

    #[test]
    fn the_normal_is_a_unit_vector_and_the_gradient_of_the_distance(x in point()) {
        let g = solid(zoo());
        let wall = g.wall(x);
        prop_assert!((wall.normal.norm() - 1.0).abs() < 1e-12);
        let step = 1e-6;
        let slope = |e: Vec2| (g.signed_distance(x + e * step) - g.signed_distance(x - e * step)) / (2.0 * step);
        let gradient = v(slope(Vec2::x()), slope(Vec2::y()));
        // Across the medial axis and at corners the central difference sees two walls: its length falls below 1.
        prop_assume!((gradient.norm() - 1.0).abs() < 1e-4);
        prop_assert!((gradient - wall.normal).norm() < 1e-3, "{gradient} {}", wall.normal);
    }

    #[test]
    fn stepping_along_the_normal_reaches_the_surface(x in point()) {
        let g = solid(zoo());
        let wall = g.wall(x);
        prop_assert!(g.signed_distance(x - wall.normal * wall.distance).abs() < 1e-9);
    }

    #[test]
    fn turned_and_shifted_shapes_give_turned_and_shifted_distances(
        x in point(), angle in -180.0..180.0_f64, dx in -0.3..0.3_f64, dy in -0.3..0.3_f64,
    ) {
        let turn = nalgebra::Rotation2::new(angle.to_radians());
        let by = v(dx, dy);
        let outer = vec![[-0.5, -0.4], [0.6, -0.3], [0.1, 0.1], [0.2, 0.7]];
        let place = |p: [f64; 2]| -> [f64; 2] { (turn * Vec2::from(p) + by).into() };
        let shapes = |rotation_deg: f64, position: [f64; 2], ends: [[f64; 2]; 2], center: [f64; 2]| vec![
            ShapeSpec::Polygon(Polygon { outer: outer.clone(), holes: vec![], position, rotation_deg }),
            ShapeSpec::Capsule(Capsule { ends, radius: 0.2 }),
            rectangle(center, [0.5, 0.2], rotation_deg),
        ];
        let (ends, center) = ([[-0.9, 0.3], [0.1, 0.4]], [0.5, -0.5]);
        let still = solid(shapes(0.0, [0.0; 2], ends, center));
        let moved = solid(shapes(angle, by.into(), ends.map(place), place(center)));
        let (a, b) = (still.wall(x), moved.wall(turn * x + by));
        prop_assert!((a.distance - b.distance).abs() < 1e-12);
    }

    #[test]
    fn in_the_pore_the_union_is_as_far_as_its_nearest_shape(x in point()) {
        let all = solid(zoo()).wall(x);
        prop_assume!(all.distance > 0.0);
        let nearest = zoo().into_iter().map(|shape| solid(vec![shape]).signed_distance(x)).fold(f64::INFINITY, f64::min);
        prop_assert!((all.distance - nearest).abs() < 1e-12);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn depth_in_overlapping_solids_is_the_distance_to_their_common_surface(x in (-1.4..-0.3_f64, -1.8..-0.7_f64)) {
        let x = v(x.0, x.1);
        let shapes = zoo();
        let is_solid = |y: Vec2| shapes.iter().any(|shape| is_in(shape, y));
        let found = solid(zoo()).signed_distance(x).abs();
        // 2000 rays see the nearest point within an angle of 0.0016: second order in it, but first order at a corner.
        let searched = distance_by_search(&is_solid, x, 1.5);
        prop_assert!(found <= searched + 1e-9 && searched < found + 2e-3, "{found} {searched}");
    }

    #[test]
    fn the_cosine_throat_is_as_far_as_newton_finds(x in point()) {
        let throat = cosine();
        let g = solid(vec![ShapeSpec::ThroatCosine(throat.clone())]);
        let d = x - Vec2::from(throat.center);
        let angle = throat.rotation_deg.to_radians();
        let local = v(d.x * angle.cos() + d.y * angle.sin(), -d.x * angle.sin() + d.y * angle.cos());
        let squared = |s: f64, side: f64| (s - local.x).powi(2) + (side * cosine_half_width(&throat, s) - local.y).powi(2);
        let mut best = f64::INFINITY;
        for side in [1.0, -1.0] {
            let nodes = 6000;
            let at = |k: i32| 6.0 * (f64::from(k) / f64::from(nodes) - 0.5) * 2.0;
            let k = (1..nodes).min_by(|a, b| squared(at(*a), side).total_cmp(&squared(at(*b), side))).unwrap();
            let (mut low, mut high) = (at(k - 1), at(k + 1));
            for _ in 0..80 {
                let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                if squared(a, side) < squared(b, side) { high = b } else { low = a }
            }
            best = best.min(squared(low, side).sqrt());
        }
        let wall = g.wall(x);
        prop_assert!((wall.distance.abs() - best).abs() < 1e-6, "{} {best}", wall.distance);
        if best > 1e-6 {
            prop_assert_eq!(wall.distance < 0.0, is_in(&ShapeSpec::ThroatCosine(throat), x));
        }
    }
}

#[test]
fn special_points_have_finite_distances_and_unit_normals() {
    let shapes = vec![
        disc(0.0, 0.0, 0.5),
        rectangle([1.2, 1.0], [0.4, 0.6], 0.0),
        polygon(&[[-1.5, -1.5], [-0.5, -1.5], [-1.0, -0.7]], &[]),
    ];
    let g = solid(shapes);
    let points = [
        (v(0.0, 0.0), -0.5),
        (v(0.5, 0.0), 0.0),
        (v(0.0, -0.5), 0.0),
        (v(1.0, 0.7), 0.0),
        (v(1.4, 1.3), 0.0),
        (v(1.2, 0.7), 0.0),
        (v(1.2, 1.0), -0.2),
        (v(-1.5, -1.5), 0.0),
        (v(-1.0, -0.7), 0.0),
        (v(1.7, 1.7), 0.5),
    ];
    for (x, distance) in points {
        let wall = g.wall(x);
        assert!((wall.distance - distance).abs() < 1e-12, "{x} {wall:?}");
        assert!((wall.normal.norm() - 1.0).abs() < 1e-12, "{x} {wall:?}");
    }
    // On a corner: the mean of both sides.
    assert!((g.wall(v(1.4, 1.3)).normal - v(1.0, 1.0).normalize()).norm() < 1e-9);
    assert_eq!(g.wall(v(1.4, 1.3)).shape, 1);
}

#[test]
fn the_normal_stays_right_within_a_trillionth_of_the_wall() {
    let g = solid(vec![disc(0.3, 0.1, 0.5)]);
    for k in 0..100 {
        let t = v((0.1 * f64::from(k)).cos(), (0.1 * f64::from(k)).sin());
        for offset in [-1e-13, 0.0, 1e-13] {
            assert!((g.wall(v(0.3, 0.1) + t * (0.5 + offset)).normal - t).norm() < 1e-9);
        }
    }
}

#[test]
fn two_overlapping_discs_are_deepest_where_their_circles_cross() {
    let g = solid(vec![disc(-0.3, 0.0, 0.5), disc(0.3, 0.0, 0.5)]);
    // The middle lies 0.2 below each circle, but those points are within the other disc: the crossings are 0.4 away.
    let wall = g.wall(v(0.0, 0.1));
    assert!((wall.distance + 0.3).abs() < 1e-12);
    assert!((wall.normal - v(0.0, 1.0)).norm() < 1e-12);
    assert!((g.signed_distance(v(0.0, 0.0)) + 0.4).abs() < 1e-12);
}

#[test]
fn coinciding_and_touching_shapes_leave_no_wall_between_them() {
    let twice = solid(vec![disc(0.0, 0.0, 0.5), disc(0.0, 0.0, 0.5)]);
    assert!((twice.wall_length() - PI).abs() < 1e-12);
    let halves = solid(vec![rectangle([-0.5, 0.0], [1.0, 1.0], 0.0), rectangle([0.5, 0.1], [1.0, 1.0], 0.0)]);
    // The line where they touch is no wall: the nearest is the foot of the right block's lower edge.
    assert!((halves.signed_distance(v(0.0, 0.0)) + 0.4).abs() < 1e-9);
    assert!((halves.wall_length() - (2.0 * 3.0 + 0.2)).abs() < 1e-9);
    assert!((halves.porosity().value - 14.0 / 16.0).abs() < 1e-12);
}

#[test]
fn without_solid_the_wall_is_infinitely_far() {
    let wall = solid(vec![]).wall(v(0.0, 0.0));
    assert_eq!((wall.distance, wall.normal, wall.shape), (f64::INFINITY, Vec2::zeros(), u32::MAX));
}

#[test]
fn hundreds_of_overlapping_discs_are_as_far_as_a_plain_loop_finds() {
    let shapes: Vec<ShapeSpec> = (0..400)
        .map(|k| {
            let (i, j) = (f64::from(k % 20), f64::from(k / 20));
            disc(0.2 * i - 1.9 + 0.03 * (i * j).sin(), 0.2 * j - 1.9, 0.07 + 0.05 * (3.0 * i + j).cos().abs())
        })
        .collect();
    let g = solid(shapes.clone());
    for k in 0..1000 {
        let x = v(1.9 * (1.3 * f64::from(k)).sin(), 1.9 * (0.7 * f64::from(k)).cos());
        let brute = shapes.iter().map(|s| {
            let ShapeSpec::Disc(d) = s else { return f64::INFINITY };
            (x - Vec2::from(d.center)).norm() - d.radius
        });
        let nearest = brute.fold(f64::INFINITY, f64::min);
        let found = g.signed_distance(x);
        assert!(if nearest > 0.0 { (found - nearest).abs() < 1e-12 } else { found <= nearest + 1e-12 });
    }
}

#[test]
fn a_quarter_turn_of_a_half_plane_puts_the_solid_on_the_right() {
    let g = solid(vec![ShapeSpec::HalfPlane(HalfPlane { point: [0.5, 0.0], rotation_deg: FRAC_PI_2.to_degrees() })]);
    assert!((g.signed_distance(v(0.0, 0.3)) - 0.5).abs() < 1e-12);
    assert!((g.wall(v(0.0, 0.3)).normal - v(-1.0, 0.0)).norm() < 1e-12);
}

#[test]
fn at_the_contact_of_touching_discs_signs_are_right() {
    let g = solid(vec![disc(-0.5, 0.0, 0.5), disc(0.5, 0.0, 0.5)]);
    for (x, is_solid) in [(v(0.0, 1e-3), false), (v(0.0, -1e-3), false), (v(1e-3, 0.0), true), (v(-1e-3, 0.0), true)] {
        assert_eq!(g.signed_distance(x) < 0.0, is_solid, "{x}");
    }
    let contact = g.wall(v(0.0, 0.0));
    assert!(contact.distance.abs() < 1e-12 && (contact.normal.norm() - 1.0).abs() < 1e-12);
}
