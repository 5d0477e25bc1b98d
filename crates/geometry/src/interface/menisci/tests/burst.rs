//! Where menisci burst.

use std::f64::consts::{PI, TAU};

use super::{Cell, Random, discs, mirrored, polyline, relative};
use crate::curve::Curve;
use crate::interface::menisci::{Hand, Passage, Wall, WallPart};
use meniscus_core::math::{Vec2, perpendicular};

/// [CieplakRobbins1988]
#[test]
fn equal_discs_burst_at_the_tabulated_pressures() {
    // Benchmark C7, printed to five decimals.
    let table = [(0.5, [4.0, 3.80798, 3.26775, 2.49136, 1.33333]), (1.0, [2.0, 1.92014, 1.69707, 1.37980, 0.89443])];
    for (gap, pressures) in table {
        for (degrees, printed) in [0.0, 20.0, 40.0, 60.0, 90.0_f64].into_iter().zip(pressures) {
            let theta = degrees.to_radians();
            let l: f64 = 2.0 + gap;
            let exact = 1.0 / ((0.25 * l * l - theta.sin().powi(2)).sqrt() - theta.cos());
            let k = discs([1.0, 1.0], l, [theta; 2]).burst().unwrap().curvature;
            assert!((k - printed).abs() < 6e-6, "{gap} {degrees}: {k}");
            assert!(relative(k, exact) < 1e-12, "{gap} {degrees}: {k} {exact}");
        }
    }
}

#[test]
fn a_disc_over_a_plate_bursts_where_the_closed_form_says() {
    for degrees in [0.0, 30.0, 60.0, 90.0, 120.0, 150.0_f64] {
        let (r, w, theta) = (1.3, 0.4, degrees.to_radians());
        let disc = Wall::of_disc(Vec2::zeros(), r, theta, Vec2::new(5.0, 0.0), Hand::Left);
        let line = |a: f64, b: f64| WallPart {
            curve: Curve::Segment { a: Vec2::new(r + w, a), b: Vec2::new(r + w, b) },
            angle: theta,
        };
        // Solid on the left of a curve that runs downwards: at larger x.
        let plate = Wall {
            parts: vec![line(0.0, 50.0), line(-50.0, 0.0)]
                .into_iter()
                .map(|p| WallPart { curve: p.curve.reversed(), ..p })
                .rev()
                .collect(),
            behind: 1,
        };
        let k = Passage::new(disc, plate).burst().unwrap().curvature;
        let (s, c, q) = (theta.sin(), theta.cos(), 2.0 * r + w);
        // (r_m sin)² + 2 r_m cos (2R + w) = w (2R + w) in k = 1/r_m.
        let exact = (c * q + (c * c * q * q + s * s * w * q).sqrt()) / (w * q);
        assert!(relative(k, exact) < 1e-12, "{degrees}: {k} {exact}");
    }
}

/// [CieplakRobbins1988]
#[test]
fn random_discs_burst_where_a_root_search_says() {
    let mut random = Random(1);
    let mut worst: f64 = 0.0;
    for _ in 0..20_000 {
        let radii = [random.between(0.1, 2.0), random.between(0.1, 2.0)];
        let distance = radii[0] + radii[1] + 10.0_f64.powf(random.between(-2.0, 0.5));
        let angles = [random.between(0.0, PI), random.between(0.0, PI)];
        let k = discs(radii, distance, angles).burst().unwrap().curvature;
        // a + b = L in r = 1/k.
        let excess = |r: f64| {
            let side = |i: usize| (radii[i].powi(2) + r * r + 2.0 * radii[i] * r * angles[i].cos()).max(0.0).sqrt();
            side(0) + side(1) - distance
        };
        let (mut low, mut high) = (0.0, 1e4);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if excess(middle) < 0.0 { low = middle } else { high = middle }
        }
        worst = worst.max(relative(k * low, 1.0));
    }
    // Rounding of the discriminant, largest in the narrowest gaps.
    assert!(worst < 2e-13, "{worst}");
}

/// A polygon with corners on a circle instead of [`Wall::of_disc`], rotated by a fraction of its edges; at 0 a corner ends the chord.
fn polygon(center: Vec2, radius: f64, corners: usize, turned: f64, angle: f64, hand: Hand) -> Wall {
    let sign = if hand == Hand::Left { 1.0 } else { -1.0 };
    let corner = |i: usize| {
        let polar = ((i as f64 + turned) / corners as f64 - 0.5) * TAU;
        [center.x + sign * radius * polar.cos(), center.y + radius * polar.sin()]
    };
    let points: Vec<_> = (0..=corners).map(corner).collect();
    polyline(&points, corners / 2, angle, hand)
}

#[test]
fn corners_of_polygons_pin_menisci_by_the_shares_of_the_method_note() {
    // 64-gons of radius 1, edges facing each other, instead of discs with a gap of 0.5.
    for (degrees, share) in [(20.0, 1.3), (40.0, 2.9), (60.0, 4.6), (90.0_f64, 6.5)] {
        let theta = degrees.to_radians();
        let (l, r) = (Vec2::zeros(), Vec2::new(2.5, 0.0));
        let side = |center, hand| polygon(center, 1.0, 64, 0.5, theta, hand);
        let polygons = Passage::new(side(l, Hand::Left), side(r, Hand::Right));
        let smooth = discs([1.0, 1.0], 2.5, [theta; 2]).burst().unwrap().curvature;
        let raised = 100.0 * (polygons.burst().unwrap().curvature / smooth - 1.0);
        // Printed to one decimal.
        assert!((raised - share).abs() < 0.05, "{degrees}: {raised}");
    }
}

fn posts(width: f64, theta: f64) -> Passage {
    let (s, h) = (3.0, 0.5 * width);
    let left = [[-h - s, 0.0], [-h, 0.0], [-h, s / 2.0], [-h, s], [-h - s, s]];
    let right = left.map(|[x, y]| [-x, y]);
    Passage::new(polyline(&left, 2, theta, Hand::Left), polyline(&right, 2, theta, Hand::Right))
}

/// [Oliver1977]
#[test]
fn square_posts_are_left_at_their_edges() {
    let w = 0.8;
    for degrees in [10.0, 40.0, 80.0, 90.0, 100.0, 120.0, 150.0, 170.0_f64] {
        let theta = degrees.to_radians();
        let passage = posts(w, theta);
        let burst = passage.burst().unwrap();
        let leaving =
            2.0 * degrees.min(180.0 - degrees).max(if degrees <= 90.0 { 90.0 } else { 0.0 }).to_radians().sin() / w;
        assert!(relative(burst.curvature, leaving) < 1e-12, "{degrees}: {burst:?}");
        assert!((burst.left.point.y - 3.0).abs() < 1e-12);
        // Just below the pressure of the slit it is pinned at the near edges, or before; just above it is at the far ones.
        let slit = 2.0 * theta.cos() / w;
        assert!(passage.at(slit - 1e-6).unwrap().left.point.y < 1e-9, "{degrees}");
        assert!((passage.at(slit + 1e-6).unwrap().left.point.y - 3.0).abs() < 1e-9, "{degrees}");
        let lowest = -passage.reversed().burst().unwrap().curvature;
        assert!(relative(passage.lowest().unwrap().curvature, lowest) < 1e-12);
    }
}

#[test]
fn a_mirror_changes_nothing_and_the_reversed_throat_gives_the_lower_end() {
    let mut random = Random(3);
    for case in 0..200 {
        let cell = Cell::random(&mut random);
        let passage = cell.passage(1, 0);
        let mirror = mirrored(passage.left(), passage.right());
        let (burst, lowest) = (passage.burst().unwrap(), passage.lowest().unwrap());
        let twin = mirror.burst().unwrap();
        assert!((twin.curvature - burst.curvature).abs() < 1e-9 * burst.curvature.abs(), "{case}: {burst:?} {twin:?}");
        assert!((mirror.lowest().unwrap().curvature - lowest.curvature).abs() < 1e-9, "{case}");
        let back = -passage.reversed().burst().unwrap().curvature;
        assert!((back - lowest.curvature).abs() < 1e-9, "{case}: {back} {lowest:?}");
    }
}

#[test]
fn menisci_leave_smooth_walls_under_their_angles() {
    let mut random = Random(11);
    for case in 0..2000 {
        let radii = [random.between(0.1, 2.0), random.between(0.1, 2.0)];
        let angles = [random.between(0.0, PI), random.between(0.0, PI)];
        let distance = radii[0] + radii[1] + random.between(0.05, 2.0);
        let passage = discs(radii, distance, angles);
        let (low, high) = (passage.lowest().unwrap().curvature, passage.burst().unwrap().curvature);
        let k = random.between(low, high);
        let meniscus = passage.at(k).unwrap();
        let curve = meniscus.curve();
        let (l, r) = (Vec2::zeros(), Vec2::new(distance, 0.0));
        // Angle between the interface and the wall ahead, at the contact.
        let ahead = |x: Vec2, center: Vec2, sign: f64| sign * perpendicular((x - center).normalize());
        let left = ahead(meniscus.left.point, l, 1.0).dot(&curve.tangent(0.0)).acos();
        let right = ahead(meniscus.right.point, r, -1.0).dot(&-curve.tangent(1.0)).acos();
        // An arc cosine near 0 and π has only half the digits.
        assert!(
            (left - angles[0]).abs() < 1e-6 && (right - angles[1]).abs() < 1e-6,
            "{case}: {left} {right} {angles:?}"
        );
        let radius = meniscus.center().map_or(f64::INFINITY, |c| (c - meniscus.left.point).norm());
        assert!((1.0 / radius - k.abs()).abs() < 1e-9 * (1.0 + k.abs()), "{case}");
    }
}
