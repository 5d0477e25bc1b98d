//! Drawings whose networks were refused or drained wrongly: lattices of posts, tall boxes, mirror images, corners that touch, rows of one pixel and
//! dead ends, each with what a symmetry or a closed form gives.

use meniscus_drawings::import::Options;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::GeometrySpec;
use meniscus_network::displacement::{Conditions, Displacement, Phase};
use meniscus_network::extract;
use meniscus_network::graph::Pores;

use crate::drawings::contents::imported;

/// Left, right, bottom and top.
const LEFT_RIGHT: [usize; 2] = [0, 1];
const RIGHT_LEFT: [usize; 2] = [1, 0];
const BOTTOM_TOP: [usize; 2] = [2, 3];

fn read(name: &str) -> GeometrySpec {
    let pixel_size = name.ends_with("png").then_some(1e-6);
    imported(&format!("kinds/{name}"), &Options { pixel_size, ..Options::default() }).spec
}

/// Curvatures in 1/m at breakthrough and at the end, and the share that is left of the defending phase.
fn drained(name: &str, sides: [usize; 2], angle_deg: f64, trapping: bool) -> [f64; 3] {
    drained_from(name, &read(name), sides, angle_deg, trapping)
}

/// The same of a geometry; `name` is for messages.
pub fn drained_from(
    name: &str,
    spec: &GeometrySpec,
    [inlet, outlet]: [usize; 2],
    angle_deg: f64,
    trapping: bool,
) -> [f64; 3] {
    let is_open = [0, 1, 2, 3].map(|side| side == inlet || side == outlet);
    let geometry = Geometry::new(spec).unwrap().with_wall_sides(is_open.map(|is_open| !is_open));
    let network = extract(&geometry, is_open).unwrap_or_else(|error| panic!("{name}: {error}"));
    let conditions = Conditions {
        inlet: [0, 1, 2, 3].map(|side| side == inlet),
        outlet: [0, 1, 2, 3].map(|side| side == outlet),
        trapping: trapping.into(),
        ..Conditions::new(vec![angle_deg.to_radians(); spec.shapes.len() + 4])
    };
    let mut state = Displacement::new(&network, &Pores::merged(&network, 0.95), conditions);
    let (mut breakthrough, mut last) = (f64::INFINITY, 0.0);
    while let Some(event) = state.next() {
        last = event.applied;
        if state.reached_outlet() {
            breakthrough = breakthrough.min(last);
        }
    }
    let elements = || state.elements().iter().enumerate();
    let all: f64 = elements().map(|(_, element)| element.area).sum();
    let left: f64 = elements().filter(|(k, _)| state.phase(*k) == Phase::Defending).map(|(_, it)| it.area).sum();
    [breakthrough, last, left / all]
}

fn assert_near(name: &str, found: f64, right: f64, share: f64) {
    assert!((found - right).abs() <= share * right.abs(), "{name}: {found} for {right}");
}

#[test]
fn a_lattice_of_posts_drains_alike_along_both_axes() {
    let [along, across] = [LEFT_RIGHT, BOTTOM_TOP].map(|sides| drained("posts.xyr", sides, 0.0, true)[0]);
    // Two over the gap of 120 um.
    assert_near("posts.xyr, left to right", along, 2.0 / 1.2e-4, 1e-9);
    assert_near("posts.xyr, bottom to top", across, 2.0 / 1.2e-4, 1e-9);
    drained("post.xyr", BOTTOM_TOP, 0.0, true);
}

#[test]
fn a_tall_box_drains_like_the_same_box_on_its_side() {
    for angle in [0.0, 40.0] {
        let (tall, wide) = (drained("tall.xyr", BOTTOM_TOP, angle, true), drained("wide.xyr", LEFT_RIGHT, angle, true));
        (0..2).for_each(|k| assert_near("tall.xyr and wide.xyr", tall[k], wide[k], 1e-9));
        assert!((tall[2] - wide[2]).abs() < 1e-9, "{tall:?} {wide:?}");
    }
}

#[test]
fn discs_drain_like_their_mirror_image() {
    for angle in [0.0, 5.0, 20.0, 40.0] {
        let a = drained("mirror_a.xyr", LEFT_RIGHT, angle, true);
        let b = drained("mirror_b.xyr", RIGHT_LEFT, angle, true);
        (0..2).for_each(|k| assert_near("mirror_a.xyr and mirror_b.xyr", a[k], b[k], 1e-9));
        assert!((a[2] - b[2]).abs() < 1e-9, "{angle} degrees: {a:?} {b:?}");
    }
}

#[test]
fn grains_that_share_a_corner_let_nothing_through() {
    for (angle, right) in [(30.0_f64, (1.0 + 30.0_f64.to_radians().cos()) / 0.2), (0.0, 10.0)] {
        assert_near("corner-contact.wkt", drained("corner-contact.wkt", LEFT_RIGHT, angle, true)[0], right, 1e-9);
    }
}

#[test]
fn rectangles_that_abut_within_their_digits_have_one_outline_and_a_network() {
    // Their union is 12 of 900, by the exact construction.
    for (name, digits) in [("near-collinear-6.wkt", 1e-6), ("near-collinear-4.wkt", 1e-4)] {
        let spec = read(name);
        assert_near(name, 1.0 - Geometry::new(&spec).unwrap().porosity().value, 12.0 / 900.0, digits);
        assert!(drained(name, LEFT_RIGHT, 0.0, true)[0].is_finite());
    }
}

#[test]
fn a_disc_at_a_rounding_error_from_a_side_lies_inside() {
    let porosity = Geometry::new(&read("near-side.xyr")).unwrap().porosity().value;
    assert!((porosity - (1.0 - std::f64::consts::PI / 16.0)).abs() < 1e-9, "{porosity}");
}

#[test]
fn near_equal_posts_have_the_entry_pressure_of_their_gap() {
    for name in ["three-by-three", "two-by-two", "last-digit", "turned-20"] {
        let [breakthrough, ..] = drained(&format!("near-equal-{name}.xyr"), LEFT_RIGHT, 0.0, true);
        // Two over the gap of .4 of the pitch of 1.
        assert_near(name, breakthrough, 5.0, 2e-5);
    }
}

#[test]
fn rectangles_and_equal_discs_drain_like_their_mirror_image() {
    let rectangles = ["a", "b"].map(|name| drained(&format!("rectangles-{name}.wkt"), LEFT_RIGHT, 0.0, true));
    let discs = [("equal-discs.xyr", LEFT_RIGHT), ("equal-discs-mirrored.xyr", RIGHT_LEFT)];
    let discs = discs.map(|(name, sides)| drained(name, sides, 0.0, true));
    for [one, other] in [rectangles, discs] {
        (0..3).for_each(|k| assert_near("mirrored", one[k], other[k], 1e-9));
    }
}

#[test]
fn a_row_of_one_pixel_of_pore_along_a_side_has_a_network() {
    for name in ["left", "right", "bottom", "top", "two-rows", "smallest", "blobs-150"] {
        let [breakthrough, ..] = drained(&format!("row-{name}.png"), LEFT_RIGHT, 0.0, true);
        assert!(breakthrough.is_finite(), "{name}");
    }
    let [bottom, top] = ["row-bottom.png", "row-top.png"].map(|name| drained(name, LEFT_RIGHT, 0.0, true)[0]);
    assert_near("row-bottom.png and row-top.png", bottom, top, 1e-9);
}

#[test]
fn a_dead_end_keeps_what_cannot_leave_it_and_drains_at_the_pressure_of_its_width() {
    let [.., left] = drained("dead-end.wkt", LEFT_RIGHT, 30.0, true);
    // 200 by 300 um beside a channel of 200 um by 3 mm.
    assert!((left - 1.0 / 11.0).abs() < 1e-9, "{left}");
    let [_, last, left] = drained("narrow.wkt", LEFT_RIGHT, 30.0, false);
    assert_near("narrow.wkt", last, 2.0 * 30.0_f64.to_radians().cos() / 5e-5, 1e-9);
    assert_eq!(left, 0.0);
}
