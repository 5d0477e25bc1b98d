//! Contact of menisci with a third wall, and coalescence of two menisci.

use std::f64::consts::PI;

use super::{Cell, Random, relative};
use crate::curve::{Curve, cross};
use crate::interface::head::Head;
use crate::interface::menisci::{Hand, Passage, Wall, WallPart, overlap};
use meniscus_core::math::Vec2;

/// Asserts that a curvature is that seen by a scan in steps of `step`, and counts the cases with one and those without.
fn assert_seen(case: i32, found: Option<f64>, scan: Option<f64>, step: f64, counts: &mut [i32; 2]) {
    let is_near = |k: f64, scanned: f64| k <= scanned + 1e-9 && k > scanned - 2.0 * step;
    assert!(found.zip(scan).is_none_or(|(k, scanned)| is_near(k, scanned)), "{case}: {found:?} {scan:?} {step}");
    assert_eq!(found.is_some(), scan.is_some(), "{case}: {found:?}, seen {scan:?}");
    counts[usize::from(found.is_none())] += 1;
}

/// [CieplakRobbins1988]
#[test]
fn a_third_wall_is_touched_where_a_dense_scan_sees_it() {
    let mut random = Random(5);
    let mut counts = [0; 2];
    for case in 0..300 {
        let cell = Cell::random(&mut random);
        let passage = cell.passage(1, 0);
        let (Some(low), Some(burst)) = (passage.lowest(), passage.burst()) else { panic!("no path in case {case}") };
        let (low, high) = (low.curvature, burst.curvature);
        let found = passage.touch(&cell.surface(2), high);
        let n = 150;
        let scan = (0..=n)
            .map(|i| low + (high - low) * f64::from(i) / f64::from(n))
            .find(|&k| passage.at(k).unwrap().points(50).iter().any(|&x| cell.is_inside(2, x)));
        let step = (high - low) / f64::from(n);
        assert_seen(case, found, scan, step, &mut counts);
    }
    assert!(counts[0] > 50 && counts[1] > 50, "{counts:?}");
}

#[test]
fn walls_far_behind_a_throat_change_nothing_ahead_of_it() {
    // A disc below a plate, and one beside it that is touched.
    let (center, radius) = (Vec2::new(0.0, -1.3), 1.0);
    let ahead = Curve::circle(Vec2::new(2.8, -1.6), 1.1);
    for deg in [0.0_f64, 0.01, 3.0, 5.0, 20.0, 60.0, 120.0] {
        let angle = PI - deg.to_radians();
        let passage = |begin: f64| {
            let part = |a: f64, b: f64| WallPart {
                curve: Curve::Segment { a: Vec2::new(a, 0.0), b: Vec2::new(b, 0.0) },
                angle,
            };
            let plate = Wall { parts: vec![part(begin, 0.0), part(0.0, 10.0)], behind: 1 };
            Passage::new(plate, Wall::of_disc(center, radius, angle, Vec2::zeros(), Hand::Right))
        };
        let (near, far) = (passage(-5.0), passage(-50.0));
        let burst = [&near, &far].map(|it| it.burst().unwrap().curvature);
        assert!(relative(burst[1], burst[0]) < 1e-12, "{deg}: {burst:?}");
        let touch = [&near, &far].map(|it| it.touch(&[ahead], burst[0]));
        assert_eq!(touch[0].is_some(), touch[1].is_some(), "{deg}: {touch:?}");
        assert!(deg > 90.0 || touch[0].is_some(), "{deg}");
        if let [Some(one), Some(other)] = touch {
            assert!(relative(other, one) < 1e-12, "{deg}: {touch:?}");
        }
    }
}

/// [CieplakRobbins1988]
#[test]
fn neighbors_overlap_where_a_dense_scan_sees_it() {
    let mut random = Random(7);
    let mut counts = [0; 2];
    for case in 0..300 {
        let cell = Cell::random(&mut random);
        // The common wall is body 1: on the right of the first, on the left of the second.
        let (b, a) = (cell.passage(1, 0), cell.passage(2, 1));
        let (Some(one), Some(other)) = (a.burst(), b.burst()) else { panic!("no path in case {case}") };
        let up_to = one.curvature.min(other.curvature);
        let low = a.lowest().unwrap().curvature.max(b.lowest().unwrap().curvature);
        // Length of the common wall between both chords.
        let (from, to) =
            (a.left().parts[a.left().behind].curve.point(0.0), b.right().parts[b.right().behind].curve.point(1.0));
        let shared = length_between(&cell.surface(1), from, to);
        let found = overlap((&a, Head::default()), (&b, Head::default()), shared, up_to);
        let n = 150;
        let at = |i: usize| low + (up_to - low) * i as f64 / n as f64;
        let have_met = |k: f64| {
            let (x, y) = (a.at(k).unwrap(), b.at(k).unwrap());
            let passed = x.left.advance + y.right.advance >= shared * (1.0 - 1e-9);
            passed || polylines_cross(&x.points(50), &y.points(50), |p| a.is_ahead(p) && b.is_ahead(p))
        };
        // Where they have met and remain so: of a meniscus far behind its throat a crossing ahead of both may vanish again.
        let scan = (0..=n).rev().take_while(|&i| have_met(at(i))).last().map(at);
        let step = (up_to - low) / n as f64;
        assert_seen(case, found, scan, step, &mut counts);
    }
    assert!(counts[0] > 50 && counts[1] > 50, "{counts:?}");
}

fn polylines_cross(a: &[Vec2], b: &[Vec2], counts: impl Fn(Vec2) -> bool) -> bool {
    let side = |s: &[Vec2], x: Vec2| cross(s[1] - s[0], x - s[0]);
    let cross = |s: &[Vec2], t: &[Vec2]| side(s, t[0]) * side(s, t[1]) < 0.0 && side(t, s[0]) * side(t, s[1]) < 0.0;
    a.windows(2).any(|s| b.windows(2).any(|t| counts(s[0]) && cross(s, t)))
}

/// Length of a closed surface from one of its points to another.
fn length_between(surface: &[Curve], from: Vec2, to: Vec2) -> f64 {
    let position = |x: Vec2| {
        let mut before = 0.0;
        let mut best = (f64::INFINITY, 0.0);
        for curve in surface {
            let closest = curve.project(x);
            let miss = (closest.point - x).norm();
            if miss < best.0 {
                best = (miss, before + closest.u * curve.length());
            }
            before += curve.length();
        }
        (best.1, before)
    };
    let (a, whole) = position(from);
    (position(to).0 - a).rem_euclid(whole)
}

/// A cell of three equal discs of radius 1 at the distance `l`; the first passage enters from below, the second over the disc on its left.
fn triangle(l: f64, theta: f64) -> (Passage, Passage, Curve) {
    let corners = [Vec2::zeros(), Vec2::new(l, 0.0), Vec2::new(0.5 * l, 0.75_f64.sqrt() * l)];
    let enter = |left: usize, right: usize| {
        Passage::new(
            Wall::of_disc(corners[left], 1.0, theta, corners[right], Hand::Left),
            Wall::of_disc(corners[right], 1.0, theta, corners[left], Hand::Right),
        )
    };
    (enter(0, 1), enter(2, 0), Curve::circle(corners[2], 1.0))
}

#[test]
fn a_flat_meniscus_reaches_the_next_row_of_a_hexagonal_pack_at_the_porosity_that_its_angle_gives() {
    for degrees in [140.0, 160.0, 180.0_f64] {
        let theta = degrees.to_radians();
        // A flat meniscus lies −cos θ above the line of centers, the next row's lower edge √3/2 L − 1.
        let l = (1.0 - theta.cos()) / 0.75_f64.sqrt();
        for (factor, sign) in [(0.99, -1.0), (1.01, 1.0)] {
            let (below, _, next) = triangle(factor * l, theta);
            let k = below.touch(&[next], below.burst().unwrap().curvature).unwrap();
            assert!(k * sign > 0.0, "{degrees} {factor}: {k}");
        }
        let (below, _, next) = triangle(l, theta);
        assert!(below.touch(&[next], 1.0).unwrap().abs() < 1e-12);
    }
}

#[test]
fn wetting_menisci_of_one_cell_meet_in_the_middle_of_the_shared_disc() {
    for l in [2.1, 2.3, 2.6_f64] {
        let (below, beside, next) = triangle(l, PI);
        let k = overlap((&below, Head::default()), (&beside, Head::default()), PI / 3.0, 10.0).unwrap();
        // At 180 degrees a meniscus is tangent to its discs. Contacts 30 degrees from both chords belong to the circle about the middle of the cell that
        // touches all three discs: the last of the defending phase.
        let exact = 1.0 / (1.0 - l / 3_f64.sqrt());
        assert!(relative(k, exact) < 1e-9, "{l}: {k} {exact}");
        assert!(k < below.touch(&[next], 10.0).unwrap());
    }
}
