//! Polygons whose edges may be arcs: area, distance and what is refused.

use std::f64::consts::PI;

use meniscus_core::math::Vec2;
use meniscus_geometry::spec::{CurvedPolygon, ShapeSpec, SolidSide};

use crate::shapes::*;

/// Area between a chord of this length and its arc: radius²/2 times (angle − sine of the angle).
fn segment_area(chord: f64, bulge: f64) -> f64 {
    let angle = 4.0 * bulge.atan();
    let radius = chord / (2.0 * (0.5 * angle).sin());
    0.5 * radius * radius * (angle - angle.sin())
}

#[test]
fn the_area_is_that_of_the_chords_and_the_segments_of_circles() {
    // A unit square whose sides bend outwards and inwards by less and by more than half a circle.
    let bulges = [0.3, -0.2, 1.7, 0.0];
    let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let outer: Vec<[f64; 3]> = corners.iter().zip(bulges).map(|(c, bulge)| [c[0], c[1], bulge]).collect();
    let hole = [[-0.1, 0.0, -1.0], [0.1, 0.0, -1.0]];
    for rotation_deg in [0.0, 27.0, -90.0] {
        let polygon =
            CurvedPolygon { outer: outer.clone(), holes: vec![hole.to_vec()], position: [0.2, -0.1], rotation_deg };
        let g = solid(vec![ShapeSpec::CurvedPolygon(polygon)]);
        let area = 1.0 + bulges.iter().map(|&bulge| segment_area(1.0, bulge)).filter(|a| a.is_finite()).sum::<f64>()
            - PI * 0.01;
        assert!((g.porosity().value - (1.0 - area / 16.0)).abs() < 1e-13, "{rotation_deg}");
        assert!(g.porosity().uncertainty < 1e-13);
    }
}

#[test]
fn two_half_circles_are_a_disc() {
    let (ring, full) =
        (solid(vec![curved(&[[-0.3, 0.1, 1.0], [0.7, 0.1, 1.0]], &[])]), solid(vec![disc(0.2, 0.1, 0.5)]));
    for k in 0..2000 {
        let x = v(2.0 * (1.3 * f64::from(k)).sin(), 2.0 * (0.7 * f64::from(k)).cos());
        assert!((ring.signed_distance(x) - full.signed_distance(x)).abs() < 1e-12, "{x}");
        assert_eq!(ring.is_solid(x), full.is_solid(x));
    }
}

#[test]
fn straight_edges_make_the_polygon_of_the_same_points() {
    let points = [[-1.5, 0.2], [-0.3, 0.1], [-0.5, 0.7], [-0.2, 1.5], [-1.4, 1.3]];
    let hole = [[-1.2, 0.5], [-1.1, 1.0], [-0.7, 0.9], [-0.8, 0.4]];
    let straight = |points: &[[f64; 2]]| points.iter().map(|p| [p[0], p[1], 0.0]).collect::<Vec<_>>();
    let (plain, bent) =
        (solid(vec![polygon(&points, &[&hole])]), solid(vec![curved(&straight(&points), &[&straight(&hole)])]));
    assert_eq!(plain.porosity(), bent.porosity());
    for k in 0..2000 {
        let x = v(2.0 * (1.3 * f64::from(k)).sin(), 2.0 * (0.7 * f64::from(k)).cos());
        assert_eq!(plain.wall(x), bent.wall(x));
        assert_eq!(plain.is_solid(x), bent.is_solid(x));
    }
}

#[test]
fn level_with_vertices_and_tangents_points_are_told_in_from_out() {
    // A gear of half circles: its vertices and the tops of its teeth stand on common lines through every point of the grid below.
    let teeth = 200;
    let at = |k: usize| {
        let t = 2.0 * PI * k as f64 / teeth as f64;
        [t.cos(), t.sin()]
    };
    let ring: Vec<[f64; 3]> = (0..teeth).map(|k| [at(k)[0], at(k)[1], if k % 2 == 0 { 1.0 } else { -1.0 }]).collect();
    let shape = curved(&ring, &[]);
    let g = solid(vec![shape.clone()]);
    for k in 0..teeth {
        for x in [at(k)[0], 0.5 * at(k)[0], 1.2 * at(k)[0]] {
            for y in [at(k)[1], at((k + 50) % teeth)[1], 0.0] {
                let x = v(x, y);
                if g.signed_distance(x).abs() > 1e-9 {
                    assert_eq!(g.is_solid(x), is_in(&shape, x), "{x}");
                    assert_eq!(g.signed_distance(x) < 0.0, g.is_solid(x), "{x}");
                }
            }
        }
    }
}

#[test]
fn the_tip_of_a_crescent_has_the_pore_around_it() {
    // Two arcs that meet with no angle between them: no mean normal tells in from out there.
    let g = solid(vec![curved(&[[0.0, -1.0, 1.0], [0.0, 1.0, -0.999]], &[])]);
    for (x, is_solid) in [(v(0.0, 1.1), false), (v(-0.3, 1.0), false), (v(0.0, -1.001), false), (v(0.9993, 0.0), true)]
    {
        assert_eq!(g.is_solid(x), is_solid, "{x}");
    }
    assert!((g.signed_distance(v(0.0, 1.1)) - 0.1).abs() < 1e-12);
}

#[test]
fn curved_polygons_that_make_no_sense_are_refused_with_their_place() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let with = |i: usize, bulge: f64| {
        let mut ring = square;
        ring[i][2] = bulge;
        curved(&ring, &[])
    };
    let reversed: Vec<[f64; 3]> = square.iter().rev().copied().collect();
    let round_hole = |x: f64, y: f64, r: f64| [[x - r, y, -1.0], [x + r, y, -1.0]];
    let cases = [
        (curved(&square[..1], &[]), "outer", "1 point(s)"),
        (curved(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[]), "outer", "no area"),
        (with(1, f64::NAN), "outer", "not a finite number"),
        (with(1, 1e9), "outer", "full circle"),
        (curved(&reversed, &[]), "outer", "runs clockwise"),
        (curved(&[square[0], square[0], square[1], square[2]], &[]), "outer", "points 0 and 1 are both"),
        (curved(&[square[0], square[1], square[2], square[0]], &[]), "outer", "last point repeats"),
        // A long side that bends inwards by more than the width of the rectangle crosses the opposite one.
        (
            curved(&[[0.0, 0.0, -0.55], [2.0, 0.0, 0.0], [2.0, 0.5, 0.0], [0.0, 0.5, 0.0]], &[]),
            "outer",
            "self-intersection: the edges from its points 0 and 2",
        ),
        (curved(&square, &[&square]), "holes[0]", "runs counter-clockwise"),
        (curved(&square, &[&round_hole(0.5, 0.95, 0.2)]), "holes", "not contained"),
        (curved(&square, &[&round_hole(5.0, 5.0, 0.2)]), "holes", "not contained"),
        (curved(&square, &[&round_hole(0.4, 0.5, 0.2), &round_hole(0.6, 0.5, 0.2)]), "holes", "on an area"),
        (curved(&square, &[&round_hole(0.5, 0.5, 0.3), &round_hole(0.5, 0.5, 0.1)]), "holes", "on an area"),
    ];
    for (shape, key, message) in cases {
        let problems = spec(vec![shape], SolidSide::Inside).problems();
        let is_named = |p: &&meniscus_core::input::Problem| {
            p.path == format!("shapes[0].curved-polygon.{key}") && p.message.contains(message)
        };
        assert!(problems.iter().any(|p| is_named(&p)), "{key}, {message}: {problems:?}");
    }
    let sound = [with(2, 0.5), with(2, -0.5), curved(&square, &[&round_hole(0.5, 0.5, 0.5 - 1e-6)])];
    for shape in sound {
        assert_eq!(spec(vec![shape], SolidSide::Inside).problems(), []);
    }
    // A hole may touch the outer ring at a point.
    assert_eq!(spec(vec![curved(&square, &[&round_hole(0.5, 0.5, 0.5)])], SolidSide::Inside).problems(), []);
    assert_eq!(solid(vec![curved(&square, &[])]).signed_distance(Vec2::new(0.5, 0.5)), -0.5);
}
