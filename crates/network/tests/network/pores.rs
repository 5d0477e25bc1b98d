//! Single pores: islands, bottles, bodies that face themselves, cut grains.

use std::f64::consts::PI;

use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{CurvedPolygon, ShapeSpec};
use meniscus_network::graph::{Network, Pores};
use meniscus_network::{ExtractError, extract};

use crate::invariants::assert_distances;
use crate::scenes::*;

#[test]
fn an_island_leaves_a_pore_with_a_throat_to_itself() {
    let shape = CurvedPolygon {
        outer: vec![[0.0, 1.0, 1.0], [2.0, 1.0, 1.0]],
        holes: vec![vec![[0.9, 0.9, -1.0], [1.5, 0.9, -1.0]]],
        position: [0.0; 2],
        rotation_deg: 0.0,
    };
    let g = pores([2.0, 2.0], vec![ShapeSpec::CurvedPolygon(shape)]);
    let n = network(&g, CLOSED);
    assert_distances(&g, &n);
    // Center of the island (1.2, 0.9), radius 0.3.
    let off = 0.2_f64.hypot(0.1);
    assert_values(&widths(&n), &[1.0 - 0.3 - off]);
    assert_values(&radii(&n), &[0.5 * (1.0 - 0.3 + off)]);
    assert_values(&areas(&n), &[PI * (1.0 - 0.09)]);
    assert_eq!(n.throats[0].regions, [0, 0]);
    assert_eq!(n.throats[0].shift.norm(), 0.0);
}

#[test]
fn a_concentric_ring_is_a_pore_and_a_throat_at_opposite_places() {
    let shape = CurvedPolygon {
        outer: vec![[0.0, 1.0, 1.0], [2.0, 1.0, 1.0]],
        holes: vec![vec![[0.5, 1.0, -1.0], [1.5, 1.0, -1.0]]],
        position: [0.0; 2],
        rotation_deg: 20.0,
    };
    let g = pores([2.0, 2.0], vec![ShapeSpec::CurvedPolygon(CurvedPolygon { rotation_deg: 0.0, ..shape })]);
    let n = network(&g, CLOSED);
    assert_values(&widths(&n), &[0.5]);
    assert_values(&radii(&n), &[0.25]);
    let middle = 0.5 * (n.throats[0].contacts[0] + n.throats[0].contacts[1]);
    assert!(((middle - n.regions[0].center).norm() - 1.5).abs() < 1e-9);
}

#[test]
fn a_round_pore_is_one_region() {
    let g = pores([2.0, 2.0], vec![disc(1.0, 0.9, 0.7)]);
    let n = network(&g, CLOSED);
    assert_values(&radii(&n), &[0.7]);
    assert_values(&areas(&n), &[0.49 * PI]);
    assert!((n.regions[0].center.y - 0.9).abs() < 1e-12);
    // Two that overlap: the chord between the two edges.
    let g = pores([3.0, 2.0], vec![disc(1.0, 1.0, 0.7), disc(2.0, 1.0, 0.7)]);
    let n = network(&g, CLOSED);
    assert_values(&radii(&n), &[0.7; 2]);
    assert_values(&widths(&n), &[2.0 * (0.49_f64 - 0.25).sqrt()]);
    assert_eq!(n.throats[0].curvatures, [f64::INFINITY; 2]);
}

#[test]
fn an_ink_bottle_has_a_neck_and_a_belly() {
    // A neck of width 0.2 and length 0.5 on a square belly, closed at the bottom, open at the top.
    let points = vec![[0.5, 0.5], [1.5, 0.5], [1.5, 1.5], [1.1, 1.5], [1.1, 2.5], [0.9, 2.5], [0.9, 1.5], [0.5, 1.5]];
    let n = network(&pores([2.0, 2.0], vec![polygon(points)]), [false, false, false, true]);
    assert_values(&widths(&n), &[0.2]);
    assert_eq!((n.regions.len(), n.openings.len()), (2, 1));
    let y = n.throats[0].contacts[0].y;
    assert!((y - 1.75).abs() < 1e-9, "the middle of the neck, from 1.5 to the side at 2, is not {y}");
    assert_values(&areas(&n), &[0.05, 1.05]);
}

#[test]
fn a_c_shaped_body_faces_itself_across_its_mouth() {
    // A ring of radii 0.5 and 0.7 about (1, 1) with a mouth of 60 degrees to the right.
    let (open, sweep) = (PI / 6.0, 2.0 * PI - PI / 3.0);
    let at = |r: f64, angle: f64| [1.0 + r * angle.cos(), 1.0 + r * angle.sin()];
    let bulge = (sweep / 8.0).tan();
    // Each arc in two, since a bulge is the tangent of a quarter of the angle and half the arc stays below a half circle's.
    let ([a, b], [c, d]) = (at(0.7, open), at(0.7, PI));
    let ([e, f], [g, h]) = (at(0.7, -open), at(0.5, -open));
    let ([i, j], [k, l]) = (at(0.5, PI), at(0.5, open));
    let ring = vec![[a, b, bulge], [c, d, bulge], [e, f, 0.0], [g, h, -bulge], [i, j, -bulge], [k, l, 0.0]];
    let g = grains([3.0, 2.0], vec![curved(ring)]).with_wall_sides([true; 4]);
    let n = network(&g, CLOSED);
    assert_distances(&g, &n);
    let mouth = n.throats.iter().find(|t| t.shapes == [0, 0]).unwrap();
    assert!((mouth.width - 0.5).abs() < 1e-9, "{mouth:?}");
    assert!(radii(&n).iter().any(|r| (r - 0.5).abs() < 1e-9));
}

#[test]
fn grains_that_touch_leave_no_throat() {
    let g = grains([3.0, 2.0], vec![disc(1.0, 1.0, 0.5), disc(2.0, 1.0, 0.5)]).with_wall_sides([true; 4]);
    let n = network(&g, CLOSED);
    assert!(widths(&n).iter().all(|&w| w > 0.1), "{:?}", widths(&n));
    let g = grains([3.0, 2.0], vec![rectangle([1.0, 0.5], [1.0, 1.0]), rectangle([2.0, 1.5], [1.0, 1.0])]);
    let n = network(&g.with_wall_sides([true; 4]), CLOSED);
    assert_eq!(n.regions.len(), 2, "two pores that meet in a point are apart");
    assert!(n.throats.is_empty() || n.throats.iter().all(|t| t.regions[0] == t.regions[1]));
}

/// Radii, areas and widths of a network.
fn table(network: &Network) -> [Vec<f64>; 3] {
    [radii(network), areas(network), widths(network)]
}

fn scene(turn: f64, is_mirrored: bool) -> Geometry {
    let turned = |[x, y]: [f64; 2]| {
        let y = if is_mirrored { -y } else { y };
        let (s, c) = turn.sin_cos();
        [5.0 + c * x - s * y, 5.0 + s * x + c * y]
    };
    let mut shapes: Vec<ShapeSpec> =
        [[0.0, 0.0, 0.5], [1.3, 0.4, 0.6], [-0.9, 1.1, 0.4], [0.6, -1.2, 0.5], [0.4, 1.5, 0.3]]
            .into_iter()
            .map(|[x, y, r]| {
                let [x, y] = turned([x, y]);
                disc(x, y, r)
            })
            .collect();
    let ring = |points: &[[f64; 2]]| {
        let mut points: Vec<[f64; 2]> = points.iter().map(|&p| turned(p)).collect();
        if is_mirrored {
            points.reverse();
        }
        polygon(points)
    };
    shapes.push(ring(&[[-1.4, -0.9], [-0.6, -1.1], [-0.8, -0.4]]));
    // A frame around all of it.
    shapes.push(ring(&[[-2.6, -2.6], [2.6, -2.6], [2.6, -2.1], [-2.6, -2.1]]));
    shapes.push(ring(&[[-2.6, 2.1], [2.6, 2.1], [2.6, 2.6], [-2.6, 2.6]]));
    shapes.push(ring(&[[-2.6, -2.6], [-2.1, -2.6], [-2.1, 2.6], [-2.6, 2.6]]));
    shapes.push(ring(&[[2.1, -2.6], [2.6, -2.6], [2.6, 2.6], [2.1, 2.6]]));
    grains([10.0, 10.0], shapes)
}

#[test]
fn a_network_turns_and_mirrors_with_its_grains() {
    let keep = |n: &Network| {
        // The region around the frame is not turned with it.
        let [mut r, mut a, w] = table(n);
        r.pop();
        a.pop();
        [r, a, w]
    };
    let straight = keep(&network(&scene(0.0, false), CLOSED));
    assert!(straight[2].len() > 10);
    for (turn, is_mirrored) in [(27.0_f64.to_radians(), false), (0.0, true), (1.0, true)] {
        let other = keep(&network(&scene(turn, is_mirrored), CLOSED));
        for (a, b) in straight.iter().zip(&other) {
            assert_values(b, a);
        }
    }
}

#[test]
fn open_sides_may_cut_grains_anywhere() {
    for k in 0..40 {
        let x = -0.19 + 0.02 * f64::from(k);
        let shapes = vec![
            disc(x, 0.3, 0.25),
            disc(x + 0.1, 0.9, 0.2),
            disc(1.05 - x, 0.5, 0.3),
            disc(0.5 + 0.3 * x, -0.1, 0.15),
        ];
        let g = grains([1.0, 1.1], shapes);
        network(&g, [true; 4]);
        network(&g.clone().with_wall_sides([false, false, true, true]), LEFT_RIGHT);
        network(&g.with_wall_sides([true, true, false, false]), TOP_BOTTOM);
    }
}

#[test]
fn pores_are_joined_where_a_throat_is_nearly_as_wide() {
    // Discs of radius 0.3 along a box: between two of them and the walls the distance falls to throats of 0.2.
    let g = grains([3.0, 1.0], (0..3).map(|k| disc(0.5 + f64::from(k), 0.5, 0.3)).collect()).with_wall_sides([true; 4]);
    let n = network(&g, CLOSED);
    let all = Pores::merged(&n, 1.0);
    assert_eq!((all.main_region.len(), all.throats.len()), (n.regions.len(), n.throats.len()));
    let total: f64 = areas(&n).iter().sum();
    let mut last = n.regions.len();
    for f in [0.95, 0.8, 0.5, 0.2, 1e-3] {
        let pores = Pores::merged(&n, f);
        assert!((pores.area.iter().sum::<f64>() - total).abs() < 1e-12);
        assert!(pores.main_region.len() <= last);
        last = pores.main_region.len();
        // Each joined region dissolves one throat.
        assert_eq!(n.throats.len() - pores.throats.len(), n.regions.len() - pores.main_region.len());
        for (region, &pore) in pores.pore_of.iter().enumerate() {
            assert!(n.regions[pores.main_region[pore]].radius >= n.regions[region].radius);
        }
        for &throat in &pores.throats {
            let [a, b] = n.throats[throat].regions.map(|region| pores.pore_of[region]);
            let smaller = [a, b].map(|pore| n.regions[pores.main_region[pore]].radius);
            assert!(a == b || 0.5 * n.throats[throat].width <= f * smaller[0].min(smaller[1]));
        }
    }
    assert_eq!(last, 1, "in the end all of the pore space is one pore");
}

#[test]
fn what_has_no_network_is_refused_with_the_reason() {
    let bare = grains([1.0, 1.0], Vec::new());
    assert_eq!(extract(&bare, [true; 4]).unwrap_err(), ExtractError::NoWalls { is_solid: false });
    let g = grains([1.0, 1.0], vec![disc(0.5, 0.5, 0.2)]).with_periodic([true, false]);
    let refused = extract(&g, LEFT_RIGHT).unwrap_err().to_string();
    assert!(refused.contains("left") && refused.contains("periodic"), "{refused}");
    let g = g.with_periodic([false; 2]).with_wall_sides([true; 4]);
    assert!(extract(&g, LEFT_RIGHT).unwrap_err().to_string().contains("a wall"));
}
