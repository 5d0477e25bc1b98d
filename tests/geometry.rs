//! Distances, normals, measures and refusals of the geometry module against closed forms and brute force.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::{Path, PathBuf};

use meniscus::geometry::spec::{
    Capsule, Channel, Disc, GeometrySpec, HalfPlane, Polygon, Rectangle, ShapeSpec, SolidSide, ThroatCosine,
    ThroatDiscs,
};
use meniscus::geometry::throats::throats;
use meniscus::geometry::{Geometry, ShapeFileError, load};
use meniscus::math::Vec2;
use meniscus::snapshot::Values;
use proptest::prelude::*;

fn disc(x: f64, y: f64, radius: f64) -> ShapeSpec {
    ShapeSpec::Disc(Disc { center: [x, y], radius })
}

fn rectangle(center: [f64; 2], size: [f64; 2], rotation_deg: f64) -> ShapeSpec {
    ShapeSpec::Rectangle(Rectangle { center, size, rotation_deg })
}

fn polygon(outer: &[[f64; 2]], holes: &[&[[f64; 2]]]) -> ShapeSpec {
    let holes = holes.iter().map(|hole| hole.to_vec()).collect();
    ShapeSpec::Polygon(Polygon { outer: outer.to_vec(), holes, position: [0.0; 2], rotation_deg: 0.0 })
}

fn spec(shapes: Vec<ShapeSpec>, solid: SolidSide) -> GeometrySpec {
    GeometrySpec { min: [-2.0, -2.0], max: [2.0, 2.0], solid, shapes }
}

fn solid(shapes: Vec<ShapeSpec>) -> Geometry {
    Geometry::new(&spec(shapes, SolidSide::Inside)).unwrap()
}

fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

/// One of each shape, some of them overlapping.
fn zoo() -> Vec<ShapeSpec> {
    vec![
        ShapeSpec::HalfPlane(HalfPlane { point: [0.0, -1.6], rotation_deg: 5.0 }),
        disc(-1.0, -1.2, 0.45),
        rectangle([1.1, 1.1], [0.8, 0.5], 27.0),
        ShapeSpec::Capsule(Capsule { ends: [[0.6, 0.7], [1.2, 0.2]], radius: 0.15 }),
        polygon(
            &[[-1.5, 0.2], [-0.3, 0.1], [-0.5, 0.7], [-0.2, 1.5], [-1.4, 1.3]],
            &[&[[-1.2, 0.5], [-1.1, 1.0], [-0.7, 0.9], [-0.8, 0.4]]],
        ),
        ShapeSpec::ThroatDiscs(ThroatDiscs { center: [0.3, -0.7], radii: [0.3, 0.25], gap: 0.2, rotation_deg: 40.0 }),
        disc(-0.6, -1.1, 0.3),
    ]
}

/// Membership by the definition of each shape, independent of the library.
fn is_in(shape: &ShapeSpec, x: Vec2) -> bool {
    let unit = |degrees: f64| v(degrees.to_radians().cos(), degrees.to_radians().sin());
    let across = |degrees: f64| v(-unit(degrees).y, unit(degrees).x);
    match shape {
        ShapeSpec::HalfPlane(s) => (x - Vec2::from(s.point)).dot(&across(s.rotation_deg)) < 0.0,
        ShapeSpec::Disc(s) => (x - Vec2::from(s.center)).norm() < s.radius,
        ShapeSpec::Rectangle(s) => {
            let d = x - Vec2::from(s.center);
            d.dot(&unit(s.rotation_deg)).abs() < 0.5 * s.size[0]
                && d.dot(&across(s.rotation_deg)).abs() < 0.5 * s.size[1]
        }
        ShapeSpec::Capsule(s) => {
            let (a, b) = (Vec2::from(s.ends[0]), Vec2::from(s.ends[1]));
            let u = ((x - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
            (x - a - (b - a) * u).norm() < s.radius
        }
        ShapeSpec::Polygon(s) => {
            // Even-odd rule over all rings.
            let mut inside = false;
            for ring in std::iter::once(&s.outer).chain(&s.holes) {
                for (i, p) in ring.iter().enumerate() {
                    let q = ring[(i + 1) % ring.len()];
                    if (p[1] > x.y) != (q[1] > x.y) && x.x < p[0] + (x.y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) {
                        inside = !inside;
                    }
                }
            }
            inside
        }
        ShapeSpec::Channel(s) => (x - Vec2::from(s.center)).dot(&across(s.rotation_deg)).abs() > 0.5 * s.width,
        ShapeSpec::ThroatDiscs(s) => [(-1.0, s.radii[0]), (1.0, s.radii[1])].iter().any(|(side, r)| {
            (x - Vec2::from(s.center) - across(s.rotation_deg) * (side * (0.5 * s.gap + r))).norm() < *r
        }),
        ShapeSpec::ThroatCosine(s) => {
            let d = x - Vec2::from(s.center);
            let (along, high) = (d.dot(&unit(s.rotation_deg)), d.dot(&across(s.rotation_deg)));
            high.abs() > cosine_half_width(s, along)
        }
    }
}

fn cosine_half_width(s: &ThroatCosine, along: f64) -> f64 {
    let narrowing = if along.abs() < 0.5 * s.length { 0.5 * (1.0 + (2.0 * PI * along / s.length).cos()) } else { 0.0 };
    0.5 * (s.width - (s.width - s.throat) * narrowing)
}

fn cosine() -> ThroatCosine {
    ThroatCosine { center: [0.2, -0.1], width: 1.6, throat: 0.4, length: 2.5, rotation_deg: 27.0 }
}

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

fn point() -> impl Strategy<Value = Vec2> {
    (-2.2..2.2_f64, -2.2..2.2_f64).prop_map(|(x, y)| v(x, y))
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

fn outside() -> Geometry {
    Geometry::new(&spec(zoo(), SolidSide::Outside)).unwrap()
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

#[test]
fn porosity_and_specific_surface_are_exact() {
    let g = solid(vec![disc(0.0, 0.0, 1.0), disc(2.0, 2.0, 0.8)]);
    let expected = 1.0 - (PI + 0.25 * PI * 0.64) / 16.0;
    let porosity = g.porosity();
    assert!((porosity.value - expected).abs() < 1e-12 && porosity.uncertainty < 1e-12);
    assert!((g.specific_surface() - (2.0 * PI + 0.25 * 2.0 * PI * 0.8) / 16.0).abs() < 1e-12);
    let zoo = solid(zoo()).porosity();
    let nodes = 800;
    let pore = (0..nodes * nodes)
        .filter(|k| {
            let at = |i: i32| 4.0 * (f64::from(i) + 0.5) / f64::from(nodes) - 2.0;
            let x = v(at(k % nodes), at(k / nodes));
            !self::zoo().iter().any(|shape| is_in(shape, x))
        })
        .count();
    assert!((zoo.value - pore as f64 / f64::from(nodes * nodes)).abs() < 1e-3);
    assert!(zoo.uncertainty < 1e-9);
    let complement = outside().porosity();
    assert!((zoo.value + complement.value - 1.0).abs() < 1e-9);
}

#[test]
fn the_outline_runs_along_the_walls() {
    let g = solid(zoo());
    let lines = g.outline();
    let length: f64 = lines
        .lines
        .iter()
        .flat_map(|line| line.windows(2).map(|w| (lines.points[w[1] as usize] - lines.points[w[0] as usize]).norm()))
        .sum();
    assert!((length - g.wall_length()).abs() < 1e-4 * length);
    assert!(lines.points.iter().all(|&x| g.signed_distance(x).abs() < 1e-9 && g.bounds().grown(1e-9).contains(x)));
    let Values::Integer(shapes) = &lines.fields[0].values else { panic!("shape is no integer field") };
    assert_eq!((lines.fields[0].name, shapes.len()), ("shape", lines.points.len()));
    // The wedge-shaped hole, the capsule with the rectangle, and the rest: no line is cut into its pieces.
    assert!(lines.lines.len() <= 8, "{} lines", lines.lines.len());
}

#[test]
fn the_distance_grid_covers_the_domain() {
    let grid = solid(vec![disc(0.0, 0.0, 1.0)]).distance_grid(0.11);
    assert_eq!(grid.counts, [37, 37]);
    let Values::Scalar(distance) = &grid.fields[0].values else { panic!("distance is no scalar field") };
    assert!((distance[0] - (8.0_f64.sqrt() - 1.0)).abs() < 1e-12);
    assert_eq!((grid.fields[0].name, grid.fields[0].unit, grid.fields[1].name), ("wall-distance", "m", "wall-normal"));
}

fn widths(geometry: &Geometry) -> Vec<f64> {
    throats(geometry).iter().map(|throat| throat.width).collect()
}

fn assert_widths(geometry: &Geometry, expected: &[f64]) {
    let found = widths(geometry);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() < 1e-6 * b, "{found:?} {expected:?}");
    }
}

#[test]
fn throats_of_discs_are_the_gaps_of_neighbors() {
    assert_widths(&solid(vec![disc(-0.8, 0.0, 0.5), disc(0.5, 0.3, 0.4)]), &[1.3_f64.hypot(0.3) - 0.9]);
    // Four discs: four gaps along the sides; the diagonals are a pore body, not a throat.
    let four = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| disc(x, y, 0.8));
    assert_widths(&solid(four.to_vec()), &[0.4; 4]);
    let between = ThroatDiscs { center: [0.1, 0.2], radii: [1.0, 0.6], gap: 0.3, rotation_deg: 33.0 };
    let g = solid(vec![ShapeSpec::ThroatDiscs(between)]);
    assert_widths(&g, &[0.3]);
    assert!((g.narrowest_throat().unwrap().center - v(0.1, 0.2)).norm() < 1e-9);
}

#[test]
fn throats_of_channels_are_their_widths() {
    for rotation_deg in [0.0, 27.0, 90.0] {
        let channel = ShapeSpec::Channel(Channel { center: [0.1, 0.0], width: 0.7, rotation_deg });
        assert_widths(&solid(vec![channel]), &[0.7]);
        let throat = ThroatCosine { rotation_deg, ..cosine() };
        let g = solid(vec![ShapeSpec::ThroatCosine(throat)]);
        assert_widths(&g, &[0.4]);
        assert!((g.narrowest_throat().unwrap().center - v(0.2, -0.1)).norm() < 1e-3);
    }
}

#[test]
fn throats_of_polygons_join_corners_and_edges() {
    let corner = polygon(&[[-0.5, 0.5], [0.0, 0.1], [0.5, 0.5]], &[]);
    assert_widths(&solid(vec![corner.clone(), rectangle([0.0, -0.6], [2.0, 1.0], 0.0)]), &[0.2]);
    let other = polygon(&[[-0.4, -1.0], [0.4, -1.0], [0.1, -0.2]], &[]);
    assert_widths(&solid(vec![corner, other]), &[0.1_f64.hypot(0.3)]);
    let blocks = vec![rectangle([-1.0, 0.0], [1.0, 1.0], 0.0), rectangle([0.3, 0.2], [1.0, 1.0], 0.0)];
    assert_widths(&solid(blocks), &[0.3]);
}

#[test]
fn a_throat_across_a_periodic_side_counts_once() {
    let g = solid(vec![disc(0.0, 0.0, 1.5)]).with_periodic([true, true]);
    assert_widths(&g, &[1.0, 1.0]);
    let g = solid(vec![disc(0.0, 0.0, 1.5)]).with_wall_sides([false, false, true, true]);
    assert_widths(&g, &[0.5, 0.5]);
}

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

#[test]
fn every_geometry_in_the_repository_is_sound() {
    let mut count = 0;
    for entry in std::fs::read_dir(repository("geometries")).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.starts_with('#'), "{} has no first comment", path.display());
        let spec = meniscus::case::load_shapes(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let g = Geometry::new(&spec).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert!((0.2..1.0).contains(&g.porosity().value), "{}", path.display());
        assert!(g.porosity().uncertainty < 1e-9);
        count += 1;
    }
    assert!(count >= 7);
}

#[test]
fn narrowest_throats_of_the_shipped_geometries_are_as_their_comments_say() {
    let gap = |shapes: &[ShapeSpec]| {
        let discs: Vec<_> =
            shapes.iter().filter_map(|s| if let ShapeSpec::Disc(d) = s { Some(d.clone()) } else { None }).collect();
        let pairs = discs.iter().enumerate().flat_map(|(i, a)| discs[..i].iter().map(move |b| (a, b)));
        let gaps = pairs.map(|(a, b)| (Vec2::from(a.center) - Vec2::from(b.center)).norm() - a.radius - b.radius);
        gaps.fold(f64::INFINITY, f64::min)
    };
    for (file, width) in
        [("four-discs", None), ("two-discs", None), ("throat", Some(5.0e-4)), ("cosine-throat", Some(3.0e-4))]
    {
        let spec = meniscus::case::load_shapes(&repository(&format!("geometries/{file}.toml"))).unwrap();
        let width = width.unwrap_or_else(|| gap(&spec.shapes));
        let g = Geometry::new(&spec).unwrap();
        let found = g.narrowest_throat().unwrap().width;
        assert!((found - width).abs() < 1e-6 * width, "{file}: {found:e}");
    }
}

#[test]
fn bad_shape_files_are_refused_with_all_their_lines() {
    let Err(ShapeFileError::Lines { lines, .. }) = load(&repository("tests/shapes/bad.xyr")) else {
        panic!("accepted")
    };
    assert_eq!(lines.iter().map(|l| l.line).collect::<Vec<_>>(), [4, 5, 6, 7]);
    assert!(matches!(load(&repository("tests/shapes/overlapping-rings.wkt")), Err(ShapeFileError::Shapes { .. })));
    let missing = load(Path::new("no-such-file.wkt")).unwrap_err().to_string();
    assert!(missing.contains(&std::env::current_dir().unwrap().display().to_string()), "{missing}");
    assert!(matches!(load(Path::new("a.stl")), Err(ShapeFileError::Ending { .. })));
}

#[test]
fn every_mistake_in_a_specification_is_named_with_its_place() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let reversed: Vec<[f64; 2]> = square.iter().rev().copied().collect();
    let closed = [&square[..], &square[..1]].concat();
    let doubled = [&square[..2], &square[1..]].concat();
    let bow = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.5]];
    let far_hole = [[5.0, 5.0], [5.0, 6.0], [6.0, 5.0]];
    let cases = [
        (disc(0.0, 0.0, -1.0), "disc.radius"),
        (disc(f64::NAN, 0.0, 1.0), "disc.center"),
        (rectangle([0.0; 2], [1.0, 0.0], 0.0), "rectangle.size"),
        (ShapeSpec::Capsule(Capsule { ends: [[0.0; 2]; 2], radius: f64::INFINITY }), "capsule.radius"),
        (polygon(&square[..2], &[]), "polygon.outer"),
        (polygon(&reversed, &[]), "polygon.outer"),
        (polygon(&closed, &[]), "polygon.outer"),
        (polygon(&doubled, &[]), "polygon.outer"),
        (polygon(&bow, &[]), "polygon.outer"),
        (polygon(&square, &[&[[0.2, 0.2], [0.8, 0.2], [0.5, 0.5]]]), "polygon.holes[0]"),
        (polygon(&square, &[&far_hole]), "polygon.holes"),
        (ShapeSpec::ThroatCosine(ThroatCosine { throat: 2.0, ..cosine() }), "throat-cosine.throat"),
        (
            ShapeSpec::ThroatDiscs(ThroatDiscs { center: [0.0; 2], radii: [1.0, 1.0], gap: 0.0, rotation_deg: 0.0 }),
            "throat-discs.gap",
        ),
        (disc(9.0, 0.0, 1.0), "disc"),
        (ShapeSpec::Channel(Channel { center: [0.0; 2], width: 40.0, rotation_deg: 10.0 }), "channel"),
    ];
    for (shape, path) in cases {
        let problems = spec(vec![disc(0.0, 0.0, 0.1), shape], SolidSide::Inside).problems();
        assert!(problems.iter().any(|p| p.path == format!("shapes[1].{path}")), "{path}: {problems:?}");
    }
    let several = spec(vec![disc(0.0, 0.0, -1.0), disc(0.0, 0.0, 0.0)], SolidSide::Inside).problems();
    assert_eq!(several.len(), 2);
    assert_eq!(spec(vec![disc(0.0, 0.0, 9.0)], SolidSide::Inside).problems()[0].path, "shapes");
    assert_eq!(spec(vec![], SolidSide::Outside).problems()[0].path, "shapes");
    let inverted = GeometrySpec { min: [0.0, 1.0], max: [1.0, 0.0], solid: SolidSide::Inside, shapes: vec![] };
    assert_eq!(inverted.problems()[0].path, "max");
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

#[test]
fn at_the_contact_of_touching_discs_signs_are_right() {
    let g = solid(vec![disc(-0.5, 0.0, 0.5), disc(0.5, 0.0, 0.5)]);
    for (x, is_solid) in [(v(0.0, 1e-3), false), (v(0.0, -1e-3), false), (v(1e-3, 0.0), true), (v(-1e-3, 0.0), true)] {
        assert_eq!(g.signed_distance(x) < 0.0, is_solid, "{x}");
    }
    let contact = g.wall(v(0.0, 0.0));
    assert!(contact.distance.abs() < 1e-12 && (contact.normal.norm() - 1.0).abs() < 1e-12);
}
