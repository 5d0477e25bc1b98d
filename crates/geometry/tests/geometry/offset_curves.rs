//! Lines at a constant depth in the solid: their lengths in closed form, and that every point of them has its depth.

use std::f64::consts::PI;

use meniscus_core::math::Vec2;
use meniscus_geometry::Geometry;
use meniscus_geometry::interface::polyline::Polyline;
use meniscus_geometry::offset_curves::UnfittedSurface;
use meniscus_geometry::spec::{HalfPlane, ShapeSpec, SolidSide};

use crate::shapes::{disc, polygon, rectangle, solid, spec, v, zoo};

const STEP: f64 = 1e-3;

fn all(geometry: &Geometry) -> UnfittedSurface<'_> {
    UnfittedSurface::new(geometry, 0.0, |_, _| false)
}

fn within(x: Vec2) -> bool {
    x.amax() < 2.0
}

fn assert_one(curves: &[Polyline], length: f64, closed: bool) {
    assert_eq!(
        curves.len(),
        1,
        "{} lines of lengths {:?}",
        curves.len(),
        curves.iter().map(Polyline::length).collect::<Vec<_>>()
    );
    assert_eq!(curves[0].closed, closed);
    // Chords of arcs, and ends of lines that are found to a share of a step.
    assert!((curves[0].length() - length).abs() < 0.2 * STEP, "{} in place of {length}", curves[0].length());
}

#[test]
fn a_line_in_a_disc_is_a_circle() {
    let geometry = solid(vec![disc(0.3, 0.2, 1.0)]);
    assert_one(&all(&geometry).offset_curves(0.25, STEP, within), 2.0 * PI * 0.75, true);
}

#[test]
fn a_line_around_a_disc_is_a_larger_circle() {
    let geometry = solid(vec![disc(0.3, 0.2, 1.0)]);
    assert_one(&all(&geometry).offset_curves(-0.25, STEP, within), 2.0 * PI * 1.25, true);
}

#[test]
fn a_line_around_a_rectangle_goes_around_its_corners() {
    let geometry = solid(vec![rectangle([0.1, 0.0], [1.0, 0.6], 20.0)]);
    assert_one(&all(&geometry).offset_curves(-0.1, STEP, within), 2.0 * (1.0 + 0.6) + 2.0 * PI * 0.1, true);
}

#[test]
fn a_line_in_a_rectangle_is_cut_at_each_corner() {
    let geometry = solid(vec![rectangle([0.1, 0.0], [1.0, 0.6], 20.0)]);
    assert_one(&all(&geometry).offset_curves(0.1, STEP, within), 2.0 * (1.0 + 0.6) - 8.0 * 0.1, true);
}

#[test]
fn a_line_around_a_rectangular_pore_goes_around_its_corners() {
    let pore = spec(vec![rectangle([0.1, 0.0], [1.0, 0.6], 20.0)], SolidSide::Outside);
    let geometry = Geometry::new(&pore).unwrap();
    assert_one(&all(&geometry).offset_curves(0.1, STEP, within), 2.0 * (1.0 + 0.6) + 2.0 * PI * 0.1, true);
}

#[test]
fn a_line_in_a_bracket_goes_around_one_corner_and_is_cut_at_five() {
    let bracket = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.5], [0.5, 0.5], [0.5, 1.0], [0.0, 1.0]];
    let geometry = solid(vec![polygon(&bracket, &[])]);
    assert_one(&all(&geometry).offset_curves(0.1, STEP, within), 4.0 - 10.0 * 0.1 + 0.5 * PI * 0.1, true);
}

#[test]
fn a_line_in_overlapping_discs_goes_around_both() {
    let geometry = solid(vec![disc(-0.6, 0.0, 1.0), disc(0.6, 0.0, 1.0)]);
    // The necks are corners of the pore; around each the line is an arc between the radii of the two discs.
    let meet = 0.6_f64.acos();
    let arcs = 2.0 * (2.0 * PI - 2.0 * meet) * 0.8;
    let fans = 2.0 * (2.0 * (PI / 2.0 - meet)) * 0.2;
    let curves = all(&geometry).offset_curves(0.2, STEP, within);
    let length: f64 = curves.iter().map(Polyline::length).sum();
    assert!(curves.len() == 1 && curves[0].closed);
    assert!((length - arcs - fans).abs() < 1.0 * STEP, "{length} in place of {}", arcs + fans);
}

#[test]
fn a_line_ends_on_the_sides_of_the_box_and_at_walls_that_are_left_out() {
    let slope = ShapeSpec::HalfPlane(HalfPlane { point: [0.0, 0.0], rotation_deg: 30.0 });
    let geometry = solid(vec![slope]);
    assert_one(&all(&geometry).offset_curves(0.1, STEP, within), 4.0 / 30_f64.to_radians().cos(), false);
    // A half disc on the floor: the line ends above the floor, at whose foot the floor's own particles begin.
    let floor = ShapeSpec::HalfPlane(HalfPlane { point: [0.0, 0.0], rotation_deg: 0.0 });
    let geometry = solid(vec![floor, disc(0.0, 0.0, 1.0)]);
    let walls = UnfittedSurface::new(&geometry, 0.0, |a, b| a.y == b.y);
    assert!(!walls.is_empty() && walls.own(v(0.3, 0.8)) && !walls.own(v(1.5, -0.1)));
    // The arc, and a quarter of a circle around each of the two corners between disc and floor.
    assert_one(&walls.offset_curves(0.1, STEP, within), PI * 0.9 + 2.0 * 0.5 * PI * 0.1, false);
}

#[test]
fn every_point_of_every_line_has_its_depth() {
    for geometry in [solid(zoo()), solid(zoo()).with_periodic([true, true]), solid(zoo()).with_wall_sides([true; 4])] {
        for depth in [0.01, 0.05, 0.12] {
            let curves = all(&geometry).offset_curves(depth, 0.01, within);
            assert!(curves.len() > 3);
            for x in curves.iter().flat_map(|curve| curve.divided((curve.length() / 0.02).round() as usize)) {
                let found = -geometry.signed_distance(x);
                // Between two samples of an arc of radius 0.15, and across a cut.
                assert!((found - depth).abs() < 1e-3, "{found} in place of {depth} at {x:?}");
            }
        }
    }
}

#[test]
fn points_along_a_line_are_evenly_apart() {
    let curve = Polyline { points: vec![v(0.0, 0.0), v(1.0, 0.0), v(1.0, 1.0)], closed: false };
    assert_eq!(curve.divided(2), [v(0.5, 0.0), v(1.0, 0.5)]);
    let ring = Polyline { points: vec![v(0.0, 0.0), v(1.0, 0.0), v(1.0, 1.0), v(0.0, 1.0)], closed: true };
    assert_eq!(ring.divided(4), [v(0.5, 0.0), v(1.0, 0.5), v(0.5, 1.0), v(0.0, 0.5)]);
}
