//! Menisci against closed forms and against root searches.

use std::f64::consts::{PI, TAU};

use super::*;
use crate::geometry::curve::Curve;
use crate::math::Vec2;

/// Two discs, the right one to the right of the left one; the advance is upwards.
fn discs(radii: [f64; 2], distance: f64, angles: [f64; 2]) -> Passage {
    let (l, r) = (Vec2::zeros(), Vec2::new(distance, 0.0));
    Passage::new(
        Wall::of_disc(l, radii[0], angles[0], r, Hand::Left),
        Wall::of_disc(r, radii[1], angles[1], l, Hand::Right),
    )
}

fn relative(value: f64, exact: f64) -> f64 {
    (value / exact - 1.0).abs()
}

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

/// Straight pieces from point to point in the order of the advance; the chord ends at the point of index `behind`.
fn polyline(points: &[[f64; 2]], behind: usize, angle: f64, hand: Hand) -> Wall {
    let part = |pair: &[[f64; 2]]| {
        let curve = Curve::Segment { a: pair[0].into(), b: pair[1].into() };
        WallPart { curve: if hand == Hand::Left { curve } else { curve.reversed() }, angle }
    };
    Wall { parts: points.windows(2).map(part).collect(), behind }
}

/// A polygon with corners on a circle, in place of [`Wall::of_disc`], turned by a share of its edges; at 0 a corner ends the chord.
fn polygon(center: Vec2, radius: f64, corners: usize, turned: f64, angle: f64, hand: Hand) -> Wall {
    let sign = if hand == Hand::Left { 1.0 } else { -1.0 };
    let corner = |i: usize| {
        let polar = ((i as f64 + turned) / corners as f64 - 0.5) * TAU;
        [center.x + sign * radius * polar.cos(), center.y + radius * polar.sin()]
    };
    let points: Vec<_> = (0..=corners).map(corner).collect();
    polyline(&points, corners / 2, angle, hand)
}

/// The same passage seen in a mirror.
fn mirrored(left: &Wall, right: &Wall) -> Passage {
    let flip = |p: Vec2| Vec2::new(-p.x, p.y);
    let mirror = |wall: &Wall| {
        let part = |part: &WallPart| {
            let curve = match part.curve {
                Curve::Segment { a, b } => Curve::Segment { a: flip(b), b: flip(a) },
                Curve::Arc { center, radius, start, sweep } => {
                    Curve::Arc { center: flip(center), radius, start: PI - (start + sweep), sweep }
                }
            };
            WallPart { curve, ..*part }
        };
        Wall { parts: wall.parts.iter().map(part).collect(), behind: wall.behind }
    };
    Passage::new(mirror(right), mirror(left))
}

fn posts(width: f64, theta: f64) -> Passage {
    let (s, h) = (3.0, 0.5 * width);
    let left = [[-h - s, 0.0], [-h, 0.0], [-h, s / 2.0], [-h, s], [-h - s, s]];
    let right = left.map(|[x, y]| [-x, y]);
    Passage::new(polyline(&left, 2, theta, Hand::Left), polyline(&right, 2, theta, Hand::Right))
}

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
        // Just below the pressure of the slit it is held at the near edges, or before; just above it stands at the far ones.
        let slit = 2.0 * theta.cos() / w;
        assert!(passage.at(slit - 1e-6).unwrap().left.point.y < 1e-9, "{degrees}");
        assert!((passage.at(slit + 1e-6).unwrap().left.point.y - 3.0).abs() < 1e-9, "{degrees}");
        let lowest = -passage.reversed().burst().unwrap().curvature;
        assert!(relative(passage.lowest().unwrap().curvature, lowest) < 1e-12);
    }
}

#[test]
fn corners_of_polygons_pin_menisci_by_the_shares_of_the_method_note() {
    // 64-gons of radius 1, edges facing each other, in place of discs with a gap of 0.5.
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
    // Rounding of the discriminant, worst in the narrowest gaps.
    assert!(worst < 2e-13, "{worst}");
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
        // Between the interface, seen from the contact, and the wall ahead.
        let ahead = |x: Vec2, center: Vec2, sign: f64| sign * crate::math::perpendicular((x - center).normalize());
        let left = ahead(meniscus.left.point, l, 1.0).dot(&curve.tangent(0.0)).acos();
        let right = ahead(meniscus.right.point, r, -1.0).dot(&-curve.tangent(1.0)).acos();
        // An arc cosine near 0 and π has half the digits only.
        assert!(
            (left - angles[0]).abs() < 1e-6 && (right - angles[1]).abs() < 1e-6,
            "{case}: {left} {right} {angles:?}"
        );
        let radius = meniscus.center().map_or(f64::INFINITY, |c| (c - meniscus.left.point).norm());
        assert!((1.0 / radius - k.abs()).abs() < 1e-9 * (1.0 + k.abs()), "{case}");
    }
}

/// A small generator of numbers that are the same everywhere (Knuth's multiplier).
struct Random(u64);

impl Random {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }
}

/// Three bodies about a cell, counter-clockwise, as walls of the passages between them: round, polygonal, or a plate.
struct Cell {
    centers: [Vec2; 3],
    radii: [f64; 3],
    corners: [Option<usize>; 3],
    theta: f64,
}

impl Cell {
    fn random(random: &mut Random) -> Self {
        loop {
            let center = |polar: f64, random: &mut Random| {
                let polar = polar + random.between(-0.4, 0.4);
                Vec2::new(polar.cos(), polar.sin()) * random.between(0.8, 1.6)
            };
            let centers = [center(0.0, random), center(TAU / 3.0, random), center(2.0 * TAU / 3.0, random)];
            let radii = [0; 3].map(|_| random.between(0.1, 1.0));
            let corners = [0; 3].map(|_| (random.between(0.0, 1.0) < 0.5).then(|| random.between(3.0, 12.0) as usize));
            let theta = random.between(0.0, PI);
            let apart = |i: usize, j: usize| (centers[i] - centers[j]).norm() > 1.02 * (radii[i] + radii[j]);
            if apart(0, 1) && apart(1, 2) && apart(2, 0) {
                return Self { centers, radii, corners, theta };
            }
        }
    }

    fn wall(&self, body: usize, other: usize, hand: Hand) -> Wall {
        let (center, radius) = (self.centers[body], self.radii[body]);
        let Some(corners) = self.corners[body] else {
            return Wall::of_disc(center, radius, self.theta, self.centers[other], hand);
        };
        // Corners stand at polar angles that do not depend on the passage; the chord ends on the line of centers.
        let toward = self.centers[other] - center;
        let polar = toward.y.atan2(toward.x);
        let step = TAU / corners as f64;
        let sign = if hand == Hand::Left { 1.0 } else { -1.0 };
        let corner = |i: f64| center + radius * crate::geometry::curve::unit(i * step);
        let at = |polar: f64| {
            let first = (polar / step).floor();
            let (a, b) = (corner(first), corner(first + 1.0));
            let ray = crate::geometry::curve::unit(polar);
            let cross = crate::geometry::curve::cross;
            a + (b - a) * (cross(ray, center - a) / cross(ray, b - a))
        };
        let back = polar - sign * PI;
        let mut points = vec![at(back)];
        let mut behind = 0;
        let indices: Vec<f64> = (-3 * corners as i64..=3 * corners as i64).map(|i| i as f64).collect();
        let mut between: Vec<f64> = indices
            .iter()
            .map(|i| i * step)
            .filter(|p| (p - back) * sign > 1e-9 && (back + sign * TAU - p) * sign > 1e-9)
            .collect();
        between.sort_by(|a, b| (a * sign).total_cmp(&(b * sign)));
        let mut is_past = false;
        for p in between {
            if !is_past && (p - polar) * sign > 1e-9 {
                points.push(at(polar));
                behind = points.len() - 1;
                is_past = true;
            }
            points.push(corner((p / step).round()));
        }
        if !is_past {
            points.push(at(polar));
            behind = points.len() - 1;
        }
        points.push(at(back));
        let points: Vec<[f64; 2]> = points.iter().map(|p| [p.x, p.y]).collect();
        polyline(&points, behind, self.theta, hand)
    }

    /// Through the chord of two bodies into the cell.
    fn passage(&self, right: usize, left: usize) -> Passage {
        Passage::new(self.wall(left, right, Hand::Left), self.wall(right, left, Hand::Right))
    }

    fn surface(&self, body: usize) -> Vec<Curve> {
        self.wall(body, (body + 1) % 3, Hand::Left).parts.iter().map(|part| part.curve).collect()
    }

    fn is_inside(&self, body: usize, x: Vec2) -> bool {
        self.surface(body).iter().map(|curve| curve.winding(x)).sum::<f64>() > PI
    }
}

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
        match (found, scan) {
            (Some(k), Some(seen)) => {
                counts[0] += 1;
                assert!(k <= seen + 1e-9 && k > seen - 2.0 * step, "{case}: {k} {seen} {step}");
            }
            (None, None) => counts[1] += 1,
            _ => panic!("{case}: {found:?}, seen {scan:?}"),
        }
    }
    assert!(counts[0] > 50 && counts[1] > 50, "{counts:?}");
}

#[test]
fn neighbors_overlap_where_a_dense_scan_sees_it() {
    let mut random = Random(7);
    let mut counts = [0; 2];
    for case in 0..300 {
        let cell = Cell::random(&mut random);
        // The shared wall is body 1: on the right of the first, on the left of the second.
        let (b, a) = (cell.passage(1, 0), cell.passage(2, 1));
        let (Some(one), Some(other)) = (a.burst(), b.burst()) else { panic!("no path in case {case}") };
        let up_to = one.curvature.min(other.curvature);
        let low = a.lowest().unwrap().curvature.max(b.lowest().unwrap().curvature);
        // Length of the shared wall between both chords.
        let (from, to) =
            (a.left().parts[a.left().behind].curve.point(0.0), b.right().parts[b.right().behind].curve.point(1.0));
        let shared = length_between(&cell.surface(1), from, to);
        let found = overlap(&a, &b, shared, up_to);
        let n = 150;
        let scan = (0..=n).map(|i| low + (up_to - low) * f64::from(i) / f64::from(n)).find(|&k| {
            let (x, y) = (a.at(k).unwrap(), b.at(k).unwrap());
            let passed = x.left.advance + y.right.advance >= shared * (1.0 - 1e-9);
            passed || polylines_cross(&x.points(50), &y.points(50), |p| a.is_ahead(p) || b.is_ahead(p))
        });
        let step = (up_to - low) / f64::from(n);
        match (found, scan) {
            (Some(k), Some(seen)) => {
                counts[0] += 1;
                assert!(k <= seen + 1e-9 && k > seen - 2.0 * step, "{case}: {k} {seen} {step}");
            }
            (None, None) => counts[1] += 1,
            _ => panic!("{case}: {found:?}, seen {scan:?}"),
        }
    }
    assert!(counts[0] > 50 && counts[1] > 50, "{counts:?}");
}

fn polylines_cross(a: &[Vec2], b: &[Vec2], counts: impl Fn(Vec2) -> bool) -> bool {
    let side = |s: &[Vec2], x: Vec2| crate::geometry::curve::cross(s[1] - s[0], x - s[0]);
    let cross = |s: &[Vec2], t: &[Vec2]| side(s, t[0]) * side(s, t[1]) < 0.0 && side(t, s[0]) * side(t, s[1]) < 0.0;
    a.windows(2).any(|s| b.windows(2).any(|t| counts(s[0]) && cross(s, t)))
}

/// Length of a closed surface from one of its points to another.
fn length_between(surface: &[Curve], from: Vec2, to: Vec2) -> f64 {
    let position = |x: Vec2| {
        let mut before = 0.0;
        let mut best = (f64::INFINITY, 0.0);
        for curve in surface {
            let foot = curve.project(x);
            let miss = (foot.point - x).norm();
            if miss < best.0 {
                best = (miss, before + foot.u * curve.length());
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
fn wetting_menisci_of_one_cell_meet_on_the_shared_disc_before_they_reach_the_third() {
    // Under 180 degrees a meniscus touches a disc where it meets it: contacts at 30 degrees from the chord,
    // (L/2)² = ... both circles coincide with the circle through three points of touch.
    for l in [2.1, 2.3, 2.6_f64] {
        let (below, beside, next) = triangle(l, PI);
        let k = overlap(&below, &beside, PI / 3.0, 10.0).unwrap();
        // The arcs meet at 30 degrees, center of the circle at the distance L/√3 … on the other side: 2 cos 30 (1 − r) = L.
        println!("{l} {k} {}", 1.0 / (1.0 - l / 3f64.sqrt()));
        let touch = below.touch(&[next], 10.0).unwrap();
        assert!(k < touch);
    }
    for (phi, degrees) in [(0.37, 180.0), (0.29, 160.0), (0.14, 140.0_f64)] {
        let l = (PI / (1.0 - phi) * 2.0 / 3f64.sqrt()).sqrt();
        let (below, beside, next) = triangle(l, degrees.to_radians());
        println!(
            "{phi} {degrees} touch {:?} overlap {:?} low {}",
            below.touch(&[next], 10.0),
            overlap(&below, &beside, PI / 3.0, 10.0),
            below.lowest().unwrap().curvature
        );
    }
}

#[test]
fn timing() {
    let mut random = Random(2);
    let n = 15_000;
    let cells: Vec<_> = (0..n).map(|_| (random.between(2.05, 3.0), random.between(0.0, PI))).collect();
    let start = std::time::Instant::now();
    let built: Vec<_> = cells.iter().map(|&(l, theta)| triangle(l, theta)).collect();
    println!("30000 passages {:?}", start.elapsed());
    let start = std::time::Instant::now();
    let s: f64 = built.iter().map(|(a, _, c)| a.touch(&[*c], 10.0).unwrap_or(0.0)).sum();
    println!("15000 touches {:?} {s}", start.elapsed());
    let start = std::time::Instant::now();
    let s: f64 = built.iter().map(|(a, b, _)| overlap(a, b, PI / 3.0, 10.0).unwrap_or(0.0)).sum();
    println!("15000 overlaps {:?} {s}", start.elapsed());
    let start = std::time::Instant::now();
    let s: f64 = built.iter().map(|(a, _, _)| a.at(0.3).map_or(0.0, |m| a.swept_area(&m))).sum();
    println!("15000 at and areas {:?} {s}", start.elapsed());
}
