//! Positions of menisci between walls of several parts, and the areas they have swept.

use std::f64::consts::{FRAC_PI_2, PI};

use super::{Cell, Random, discs, polyline, relative};
use crate::curve::Curve;
use crate::interface::menisci::{Hand, Meniscus, Passage, Wall};
use meniscus_core::math::Vec2;

/// A slit of width 1 along y from −2 to 2 whose walls change their angle at y = 1.
fn patched(near: f64, far: f64) -> Passage {
    let wall = |x: f64, hand| {
        let mut wall = polyline(&[[x, -2.0], [x, 0.0], [x, 1.0], [x, 2.0]], 1, near, hand);
        wall.parts[2].angle = far;
        wall
    };
    Passage::new(wall(0.0, Hand::Left), wall(1.0, Hand::Right))
}

#[test]
fn a_slit_holds_a_meniscus_where_its_angle_falls_and_passes_it_where_the_angle_rises() {
    let [weak, strong] = [80.0_f64, 40.0].map(f64::to_radians);
    let passage = patched(weak, strong);
    assert!(relative(passage.burst().unwrap().curvature, 2.0 * strong.cos()) < 1e-12);
    // In between it is pinned at the patch boundary, at an intermediate angle.
    let meniscus = passage.at(1.0).unwrap();
    assert!((meniscus.left.point - Vec2::new(0.0, 1.0)).norm() < 1e-12);
    assert!((meniscus.bend - PI / 6.0).abs() < 1e-12, "{meniscus:?}");
    assert!(relative(patched(strong, weak).burst().unwrap().curvature, 2.0 * strong.cos()) < 1e-12);
}

#[test]
fn a_step_in_a_channel_is_climbed_over_its_corner() {
    for degrees in [20.0, 40.0, 60.0, 85.0_f64] {
        let theta = degrees.to_radians();
        let left = polyline(&[[0.0, -3.0], [0.0, 1.0], [0.3, 1.0], [0.3, 2.0], [0.3, 4.0]], 3, theta, Hand::Left);
        let right = polyline(&[[1.0, -3.0], [1.0, 2.0], [1.0, 4.0]], 1, theta, Hand::Right);
        let passage = Passage::new(left, right);
        // The narrow part of width 0.7 has the largest entry pressure; the wide one before it is filled.
        assert!(relative(passage.burst().unwrap().curvature, 2.0 * theta.cos() / 0.7) < 1e-12, "{degrees}");
        let wide = 2.0 * theta.cos();
        assert!(passage.at(wide - 1e-6).is_none_or(|meniscus| meniscus.right.point.y < 1.0));
        let held = passage.at(wide + 0.5 * (2.0 * theta.cos() / 0.7 - wide)).unwrap();
        assert!(held.left.point.y > 0.9, "{degrees}: {held:?}");
    }
}

#[test]
fn a_wedge_is_filled_to_where_its_width_belongs_to_the_pressure() {
    // Half angle 20 degrees, closing ahead; walls meet at (0.5, apex).
    let (theta, half) = (30.0_f64.to_radians(), 20.0_f64.to_radians());
    let apex = 0.5 / half.tan();
    let end = 0.99;
    let left = polyline(&[[0.0, 0.0], [0.5 * end, apex * end]], 0, theta, Hand::Left);
    let right = polyline(&[[1.0, 0.0], [1.0 - 0.5 * end, apex * end]], 0, theta, Hand::Right);
    let passage = Passage::new(left, right);
    for k in [3.0, 10.0, 50.0] {
        let meniscus = passage.at(k).unwrap();
        // The angle between interface and chord is 90° − θ − half angle.
        let exact = 2.0 * (theta + half).cos() / meniscus.chord();
        assert!(relative(k, exact) < 1e-9, "{k}: {exact}");
    }
    // k grows without bound towards the corner, where the walls end.
    assert_eq!(passage.burst().unwrap().left.u, 1.0);
}

#[test]
fn the_swept_area_is_that_of_a_polygon_of_many_corners() {
    let mut random = Random(13);
    for case in 0..200 {
        let cell = Cell::random(&mut random);
        let passage = cell.passage(1, 0);
        let (low, high) = (passage.lowest().unwrap(), passage.burst().unwrap());
        let k = random.between(low.curvature, high.curvature);
        let (first, second) = (passage.at(k).unwrap(), high);
        // Boundary between two menisci: one arc, the right wall, the other arc backwards, the left wall backwards.
        let area = passage.swept_area(&second) - passage.swept_area(&first);
        let corners = between(&passage, &first, &second);
        let next = corners.iter().cycle().skip(1);
        let shoelace: f64 = corners.iter().zip(next).map(|(a, b)| 0.5 * (a.x * b.y - a.y * b.x)).sum();
        // Arcs of 2000 vertices each.
        assert!((area - shoelace).abs() < 1e-5 * (1.0 + area.abs()), "{case}: {area} {shoelace}");
    }
}

/// Vertices around the area between two menisci of a passage.
fn between(passage: &Passage, first: &Meniscus, second: &Meniscus) -> Vec<Vec2> {
    let along = |wall: &Wall, from: f64, to: f64, hand: Hand| {
        let behind: f64 = wall.parts[..wall.behind].iter().map(|part| part.curve.length()).sum();
        let at = |advance: f64| {
            let mut rest = advance + behind;
            for (i, part) in wall.parts.iter().enumerate() {
                let length = part.curve.length();
                if rest <= length || i + 1 == wall.parts.len() {
                    let share = rest / length;
                    return part.curve.point(if hand == Hand::Left { share } else { 1.0 - share });
                }
                rest -= length;
            }
            Vec2::zeros()
        };
        (0..=2000).map(|i| at(from + (to - from) * f64::from(i) / 2000.0)).collect::<Vec<_>>()
    };
    let mut corners = first.points(2000);
    corners.extend(along(passage.right(), first.right.advance, second.right.advance, Hand::Right));
    corners.extend(second.points(2000).into_iter().rev());
    corners.extend(along(passage.left(), second.left.advance, first.left.advance, Hand::Left));
    corners
}

#[test]
fn walls_without_parts_hold_nothing() {
    let empty = Passage::new(Wall::default(), Wall::default());
    assert!(empty.burst().is_none() && empty.at(0.0).is_none() && empty.touch(&[], 1.0).is_none());
    let left = polyline(&[[0.0, 0.0], [0.0, 1.0]], 7, FRAC_PI_2, Hand::Left);
    assert!(Passage::new(left, Wall::default()).burst().is_none());
}

/// A horizontal line above both walls, the pore below it.
fn line(y: f64) -> Curve {
    Curve::Segment { a: Vec2::new(-9.0, y), b: Vec2::new(9.0, y) }
}

#[test]
fn beyond_its_burst_a_meniscus_goes_along_the_walls_until_it_touches_a_line() {
    let (radius, distance, theta) = (1.0, 2.8, 40.0_f64.to_radians());
    let passage = discs([radius; 2], distance, [theta; 2]);
    let burst = passage.burst().unwrap();
    let mut before = (passage.swept_area(&burst), burst.curvature);
    for y in [1.2, 1.6, 2.0] {
        let meniscus = passage.reach(&line(y)).unwrap();
        let (center, r) = (meniscus.center().unwrap(), 1.0 / meniscus.curvature);
        assert!(relative(center.y + r, y) < 1e-9, "{y}: {meniscus:?}");
        // It meets both discs at the contact angle.
        let square = radius * radius + r * r + 2.0 * radius * r * theta.cos();
        assert!(relative(center.norm_squared(), square) < 1e-9, "{y}: {meniscus:?}");
        let now = (passage.swept_area(&meniscus), meniscus.curvature);
        assert!(now.0 > before.0 && now.1 < before.1, "{y}: {now:?} after {before:?}");
        before = now;
    }
}

#[test]
fn where_walls_end_a_meniscus_grows_from_their_ends_until_it_touches_a_line() {
    let wall = |x: f64, hand| polyline(&[[x, -1.0], [x, 0.0], [x, 0.5]], 1, FRAC_PI_2, hand);
    let passage = Passage::new(wall(0.0, Hand::Left), wall(1.0, Hand::Right));
    let meniscus = passage.reach(&line(1.0)).unwrap();
    // A semicircle of radius 0.5 on the slit of length 0.5.
    assert!((meniscus.left.point - Vec2::new(0.0, 0.5)).norm() < 1e-12 && (meniscus.bend - FRAC_PI_2).abs() < 1e-9);
    assert!(relative(passage.swept_area(&meniscus), 0.5 + PI / 8.0) < 1e-9);
}
