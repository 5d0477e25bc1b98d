//! Porosity, specific surface, outline, distance grid and throats.

use std::f64::consts::PI;

use meniscus_core::snapshot::Values;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Channel, ShapeSpec, ThroatCosine, ThroatDiscs};
use meniscus_geometry::throats::throats;

use crate::shapes::*;

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
            !crate::shapes::zoo().iter().any(|shape| is_in(shape, x))
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
    assert!(lines.lines.len() <= 10, "{} lines", lines.lines.len());
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
