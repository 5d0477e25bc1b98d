//! Kinds of drawings that readers get wrong: each with the porosity that a closed form gives. The files are told in `README.md`.

use std::f64::consts::PI;

use meniscus_drawings::import::{Frame, Imported, Nested, Options};
use meniscus_drawings::load;
use meniscus_geometry::spec::ShapeSpec;

use crate::contents::*;
use crate::files::*;

/// A box of 10 mm.
const TEN: [[f64; 2]; 2] = [[0.0, 0.0], [10e-3, 10e-3]];

fn read(name: &str, options: &Options) -> Imported {
    imported(&format!("kinds/{name}"), options)
}

/// Reads the files and holds their porosities against what is right.
fn check(rows: &[(&str, f64)], options: &Options) {
    for (name, right) in rows {
        let found = porosity(&read(name, options).spec);
        println!("{name:28} {found:.6} {right:.6}");
        assert!((found - right).abs() < 1e-9, "{name}: {found} {right}");
    }
}

#[test]
fn contours_of_masks_never_cross_themselves() {
    let options = Options { pixel_size: Some(1e-6), ..Options::default() };
    for (name, pixels) in [("binary-60", 0.5), ("grey-60", 0.5027), ("grey-80", 0.5027), ("smallest", 0.6875)] {
        let found = read(&format!("contour-{name}.png"), &options);
        println!("{name:12} {:.4}  {}", porosity(&found.spec), found.notes.join("; "));
        // Specks are left out; a corner of the contour of 4 x 4 pixels is an eighth of a pixel.
        let bound = if name == "smallest" { 0.05 } else { 0.01 };
        assert!((porosity(&found.spec) - pixels).abs() < bound, "{name}");
    }
}

#[test]
fn holes_that_touch_their_ring_are_holes_wherever_they_begin() {
    let plain = Options::default();
    check(&[("touching-a.wkt", 1.0 - 34.0 / 64.0), ("touching-b.wkt", 1.0 - 34.0 / 64.0)], &plain);
    check(&[("touching-corner.wkt", 1.0 - 30.0 / 64.0), ("touching-corner.svg", 0.7)], &plain);
}

#[test]
fn transforms_of_css_move_shapes_as_those_of_attributes_do() {
    let circle = 1.0 - 0.04 * PI;
    let names = ["attribute", "css", "class", "group-scale"].map(|name| (format!("transform-{name}.svg"), circle));
    check(&names.each_ref().map(|(name, right)| (name.as_str(), *right)), &Options::default());
    // A square of 2 mm, turned about its center.
    check(&[("transform-origin.svg", 0.96)], &Options::default());
}

#[test]
fn polylines_are_as_wide_as_they_are_drawn() {
    // Two discs of radius .5 beside a disc of radius 1, and beside a square of 5, in a box of 10.8.
    let right = |area: f64| 1.0 - (area + 0.5 * PI) / (10.8 * 10.8);
    check(&[("width-donut.dxf", right(PI)), ("width-wide-closed.dxf", right(25.0))], &Options::default());
}

#[test]
fn all_geometries_of_a_line_of_well_known_text_are_read() {
    let plain = Options::default();
    let right = 1.0 - 37.0 / (9.6 * 9.6);
    check(&[("wkt-semicolon.wkt", right), ("wkt-space.wkt", right), ("wkt-two-lines.wkt", right)], &plain);
    let message = load(&file("kinds/wkt-comma.wkt"), &plain).unwrap_err().to_string();
    assert!(message.contains("line 1"), "{message}");
}

#[test]
fn columns_of_lists_are_told_by_their_names() {
    let right = 1.0 - PI * (0.25 + 0.5625) / (4.8 * 2.3);
    let rows = ["xyr", "radius-first", "row-column", "unit"].map(|name| format!("list-{name}.csv"));
    let found = rows.each_ref().map(|name| porosity(&read(name, &Options::default()).spec));
    println!("{found:?} {right}");
    assert!(found.iter().all(|porosity| (porosity - found[0]).abs() < 1e-12), "{found:?}");
}

#[test]
fn channels_from_side_to_side_of_a_plate_are_channels_and_posts_at_its_sides_stay() {
    let window = in_box(Options::default(), TEN);
    check(
        &[
            ("channel-starts-at-left.dxf", 0.2),
            ("channel-starts-at-right.dxf", 0.2),
            ("channel-overshoots.dxf", 0.2),
            ("channel-post-at-left-wall.dxf", 0.02),
            ("channel-post-at-right-wall.dxf", 0.02),
        ],
        &window,
    );
    let notes = read("channel-overshoots.dxf", &window).notes.join("\n");
    assert!(notes.contains("LWPOLYLINE 30 in LWPOLYLINE 2F"), "{notes}");
}

#[test]
fn slits_enclose_nothing_and_figures_of_eight_enclose_both_loops() {
    let plain = Options::default();
    check(&[("keyhole.svg", 0.68), ("keyhole.wkt", 0.68), ("keyhole-bowtie.svg", 0.82)], &plain);
    check(&[("keyhole.dxf", 1.0 - (32.0 + 0.25 * PI) / 81.0)], &plain);
}

#[test]
fn white_shapes_and_outlines_without_fill_on_filled_ones_are_pore() {
    let plain = Options::default();
    check(&[("paint-white.svg", 0.52), ("paint-nofill.svg", 0.52), ("paint-frame.svg", 1.0 - 0.04 * PI)], &plain);
}

#[test]
fn gaps_of_outlines_are_told_with_place_and_width_and_what_closes_them() {
    let open = read("open-gap.dxf", &Options::default());
    let notes = open.notes.join("\n");
    for told in ["4 gaps of up to 1.000e-4", "LINE 2F and LINE 32", "(3, 3)", "join-within = 1.1e-4"] {
        assert!(notes.contains(told), "{told}: {notes}");
    }
    let joined = read("open-gap.dxf", &Options { join_within: Some(1.1e-4), ..Options::default() });
    assert_eq!(joined.spec.shapes.len(), 2);
    let right = 1.0 - (16.0 + 0.25 * PI) / (7.8 * 7.8);
    // The corners are those of the file, each line by its first end.
    assert!((porosity(&joined.spec) - right).abs() < 1e-4, "{} {right}", porosity(&joined.spec));
}

#[test]
fn tiff_images_stand_as_their_orientation_says() {
    let options = Options { pixel_size: Some(1e-6), ..Options::default() };
    let notes = read("orientation.tif", &options).notes.join("\n");
    assert!(notes.contains("as its orientation"), "{notes}");
}

/// Porosity of discs of this radius in a box.
fn discs_in(count: f64, radius: f64, [width, height]: [f64; 2]) -> f64 {
    1.0 - count * PI * radius * radius / (width * height)
}

#[test]
fn frames_of_any_outline_are_no_grains_and_a_question_where_they_may_be_plates() {
    // Layers or fills tell what is a frame.
    let posts = |name: &str| -> f64 {
        let found = read(name, &Options::default());
        let discs = discs(&found.spec);
        let size = [0, 1].map(|i| found.spec.max[i] - found.spec.min[i]);
        let right = discs_in(discs.len() as f64, discs[0].radius, size);
        assert!((porosity(&found.spec) - right).abs() < 1e-9, "{name}: {}", porosity(&found.spec));
        discs.len() as f64
    };
    assert_eq!(["frame-octagon.dxf", "frame-rounded.dxf", "frame-two.svg"].map(posts), [16.0; 3]);
    // Without them the command asks, with both readings, and the option answers.
    let nine = [9.0, 9.0];
    for (name, pore, solid) in [
        ("frame-circle.svg", discs_in(9.0, 0.5, [10.0; 2]), 1.0 - PI * (4.9 * 4.9 - 9.0 * 0.25) / 100.0),
        ("frame-rectangle.svg", discs_in(16.0, 0.5, [10.0; 2]), 1.0 - (81.0 - 16.0 * PI * 0.25) / 100.0),
        (
            "frame-lines.dxf",
            discs_in(16.0, 0.5, nine),
            discs_in(-16.0, 0.5, nine.map(|x| 1.2 * x)) - 81.0 / 1.44 / 81.0,
        ),
    ] {
        let error = load(&file(&format!("kinds/{name}")), &Options::default()).unwrap_err().to_string();
        assert!(error.contains("two ways"), "{name}: {error}");
        for (frame, right) in [(Frame::Pore, pore), (Frame::Solid, solid)] {
            let found = porosity(&read(name, &Options { frame: Some(frame), ..Options::default() }).spec);
            println!("{name:24} {frame:?} {found:.6} {right:.6}");
            assert!((found - right).abs() < 1e-9, "{name} {frame:?}: {found} {right}");
        }
    }
}

#[test]
fn a_chamber_in_a_wafer_is_the_pore_and_posts_may_cross_its_wall() {
    let found = read("lab-chip.dxf", &Options::default()).spec;
    // The chamber of 12 by 8 with two channels of 2 by 1, in a box of 16 by 8.
    let posts: f64 = discs(&found).iter().map(|post| PI * post.radius * post.radius * 1e6).sum();
    let right = (12.0 * 8.0 + 2.0 * 2.0 - posts) / (16.0 * 8.0);
    assert!((porosity(&found) - right).abs() < 1e-9, "{} {right}", porosity(&found));
    let cut = porosity(&read("lab-chip-cut-lattice.dxf", &Options::default()).spec);
    // By the union of shapely with 1024 and 4096 points on each circle, extrapolated.
    assert!((cut - 0.594_451_391_6).abs() < 1e-9, "{cut}");
}

#[test]
fn what_lies_in_shapes_of_another_color_or_in_outlines_of_gds_is_asked() {
    let gds = Options { layers: Some(vec!["L1D0".into()]), window: Some([[0.0; 2], [1e-4, 4e-5]]), ..unit("um") };
    // KLayout has 3200 um2 of the merged layer of 4000. A plate of 18 by 6, a channel of 16 by 1 and a circle of radius .9 on its axis, in 240.
    let (radius, half): (f64, f64) = (0.9, 0.5);
    let beyond = PI * radius * radius
        - 2.0 * (half * (radius * radius - half * half).sqrt() + radius * radius * (half / radius).asin());
    let channels = 1.0 - (108.0 - 16.0 - beyond) / 240.0;
    for (name, options, pore, solid) in
        [("nested-gds.dxf", gds, 0.3, 0.2), ("plate.svg", Options::default(), channels, 0.55)]
    {
        let error = load(&file(&format!("kinds/{name}")), &options).unwrap_err().to_string();
        assert!(error.contains("two ways"), "{name}: {error}");
        for (nested, right) in [(Nested::Pore, pore), (Nested::Solid, solid)] {
            let found = porosity(&read(name, &Options { nested: Some(nested), ..options.clone() }).spec);
            println!("{name:24} {nested:?} {found:.6} {right:.6}");
            assert!((found - right).abs() < 1e-9, "{name} {nested:?}: {found} {right}");
        }
    }
}

#[test]
fn outlines_that_overlap_by_a_rounding_error_are_those_that_abut() {
    let found = ["a", "a-over", "b-over", "c-over", "d-over"]
        .map(|name| porosity(&read(&format!("abutting-{name}.dxf"), &Options::default()).spec));
    assert!(found.iter().all(|porosity| (porosity - found[0]).abs() < 1e-7), "{found:?}");
}

#[test]
fn lists_with_more_numbers_than_names_are_refused() {
    let options = Options { window: Some([[0.0; 2], [1e-4, 6e-5]]), ..Options::default() };
    for name in ["list-comma-decimals.csv", "list-one-comma-decimal.csv"] {
        let error = load(&file(&format!("kinds/{name}")), &options).unwrap_err().to_string();
        assert!(error.contains("one for each name"), "{name}: {error}");
    }
    let right = porosity(&read("list-right.csv", &options).spec);
    assert!((right - (1.0 - PI * (10.5 * 10.5 + 12.5 * 12.5) / 6000.0)).abs() < 1e-9, "{right}");
}

#[test]
fn white_of_any_kind_and_languages_of_svg_are_read_as_browsers_do() {
    let square = 1.0 - (36.0 - 4.0 * PI) / 100.0;
    check(&[("white-fefefe.svg", square), ("white-gradient.svg", square), ("white.svg", square)], &Options::default());
    check(&[("language-switch.svg", 0.96), ("language-extension.svg", 0.96)], &Options::default());
}

#[test]
fn frames_of_chips_are_no_grains() {
    for (name, right) in [("frame-inside-page.svg", 0.7374), ("frame-on-page.svg", 0.7374), ("frame-layer.dxf", 0.7053)]
    {
        let found = read(name, &Options::default());
        let is_grain = |shape: &&ShapeSpec| !matches!(shape, ShapeSpec::HalfPlane(_));
        println!("{name:28} {:.4}", porosity(&found.spec));
        assert!((porosity(&found.spec) - right).abs() < 1e-3, "{name}: {}", porosity(&found.spec));
        assert!(found.spec.shapes.iter().filter(is_grain).count() == 40, "{name}");
        assert!(found.notes.iter().any(|note| note.contains("frame of the chip")), "{name}: {:?}", found.notes);
    }
}
