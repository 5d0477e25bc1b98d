use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::import::drawing::seen::{area, counts, discs, only};
use meniscus_core::math::Vec2;

/// Groups in short notation: `0 LINE; 8 walls; 10 0.5`.
fn lines(groups: &str) -> String {
    let groups = groups.split(';').map(str::trim).filter(|group| !group.is_empty());
    groups
        .map(|group| group.split_once(' ').map_or(format!("{group}\n\n"), |(code, value)| format!("{code}\n{value}\n")))
        .collect()
}

fn file(blocks: &str, entities: &str) -> String {
    lines(&format!(
        "0 SECTION; 2 HEADER; 9 $INSUNITS; 70 4; 0 ENDSEC; 0 SECTION; 2 TABLES; 0 TABLE; 2 LAYER; \
         0 LAYER; 2 walls; 70 0; 62 7; 0 LAYER; 2 cold; 70 1; 62 7; 0 LAYER; 2 dark; 70 0; 62 -7; 0 ENDTAB; 0 ENDSEC; \
         0 SECTION; 2 BLOCKS; {blocks}; 0 ENDSEC; 0 SECTION; 2 ENTITIES; {entities}; 0 ENDSEC; 0 EOF"
    ))
}

fn drawn(entities: &str) -> Drawing {
    read(file("", entities).as_bytes(), None, None).unwrap()
}

fn assert_discs(drawing: &Drawing, expected: &[[f64; 3]]) {
    let found = discs(drawing);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for ((center, radius), [x, y, r]) in found.iter().zip(expected) {
        assert!((center - Vec2::new(*x, *y)).norm().max((radius - r).abs()) < 1e-12, "{found:?} {expected:?}");
    }
}

#[test]
fn a_circle_in_any_entity_is_the_same_disc() {
    for entities in [
        "0 CIRCLE; 5 2F; 10 3; 20 4; 40 2",
        "0 ARC; 10 3; 20 4; 40 2; 50 30; 51 390",
        "0 ARC; 10 3; 20 4; 40 2; 50 0; 51 90; 0 ARC; 10 3; 20 4; 40 2; 50 90; 51 0",
        "0 LWPOLYLINE; 90 2; 70 1; 10 1; 20 4; 42 1; 10 5; 20 4; 42 1",
        "0 LWPOLYLINE; 90 3; 70 0; 10 1; 20 4; 42 -1; 10 5; 20 4; 42 -1; 10 1; 20 4",
        "0 POLYLINE; 70 1; 0 VERTEX; 10 1; 20 4; 42 1; 0 VERTEX; 10 5; 20 4; 42 1; 0 SEQEND",
        "0 ELLIPSE; 10 3; 20 4; 11 0; 21 2; 40 1; 41 0; 42 6.283185307179586",
        // A normal that points down mirrors x; the axes of an ellipse are those of the drawing.
        "0 CIRCLE; 10 -3; 20 4; 40 2; 210 0; 220 0; 230 -1",
        "0 ELLIPSE; 10 3; 20 4; 11 2; 21 0; 40 1; 230 -1",
    ] {
        assert_discs(&drawn(entities), &[[3.0, 4.0, 2.0]]);
    }
}

#[test]
fn areas_of_outlines_are_those_of_closed_formulas() {
    let half = 0.5 * PI;
    let below = "0 LINE; 10 -2; 20 0; 11 2; 21 0";
    let ellipse = "0 ELLIPSE; 10 0; 20 0; 11 2; 21 0; 40 0.5; 41 0; 42 3.141592653589793";
    let stadium = "0 LINE; 10 0; 20 -1; 11 4; 21 -1; 0 ARC; 10 0; 20 0; 40 1; 50 90; 51 270; \
                   0 LINE; 10 0; 20 1; 11 4; 21 1; 0 ARC; 10 4; 20 0; 40 1; 50 -90; 51 90";
    let knots = "40 0; 40 0; 40 0; 40 0; 40 1; 40 1; 40 1; 40 1";
    let bezier = format!("0 SPLINE; 70 8; 71 3; {knots}; 10 -2; 20 0; 10 -2; 20 2; 10 2; 20 2; 10 2; 20 0; {below}");
    // A rational half circle with the weights 1, 1/3, 1/3, 1.
    let rational = format!(
        "0 SPLINE; 70 12; 71 3; {knots}; 41 1; 41 0.3333333333333333; 41 0.3333333333333333; 41 1; \
         10 1; 20 0; 10 1; 20 2; 10 -1; 20 2; 10 -1; 20 0; 0 LINE; 10 -1; 20 0; 11 1; 21 0"
    );
    for (entities, expected, tolerance) in [
        ("0 LWPOLYLINE; 70 1; 10 0; 20 0; 10 3; 20 0; 10 3; 20 2; 10 0; 20 2", 6.0, 1e-14),
        ("0 LWPOLYLINE; 70 1; 10 0; 20 0; 42 1; 10 2; 20 0; 10 2; 20 2; 10 0; 20 2", 4.0 + half, 1e-14),
        ("0 SOLID; 10 0; 20 0; 11 3; 21 0; 12 0; 22 2; 13 3; 23 2", 6.0, 1e-14),
        ("0 SOLID; 10 0; 20 0; 11 3; 21 0; 12 0; 22 2; 13 0; 23 2", 3.0, 1e-14),
        // Two lines and two arcs in any order; a half disc.
        (stadium, 8.0 + PI, 1e-14),
        ("0 ARC; 10 0; 20 0; 40 1; 50 0; 51 180; 0 LINE; 10 -1; 20 0; 11 1; 21 0", half, 1e-14),
        ("0 ELLIPSE; 10 1; 20 1; 11 3; 21 4; 40 0.4; 41 0; 42 6.283185307179586", 10.0 * PI, 1e-5),
        (&format!("{ellipse}; {below}"), PI, 1e-5),
        // The mirrored upper half is the lower one.
        (&format!("{ellipse}; 230 -1; {below}"), PI, 1e-5),
        (&bezier, 4.8, 1e-5),
        (&rational, half, 1e-5),
    ] {
        let drawing = drawn(entities);
        let found = area(only(&drawing));
        assert!((found - expected).abs() < tolerance * expected, "{entities}: {found} {expected}");
        assert_eq!(drawing.unused.len(), 0);
    }
}

#[test]
fn a_spline_with_fit_points_only_goes_through_them() {
    let points: String =
        (0..=16).map(|k| (k % 16) as f64 * PI / 8.0).map(|t| format!("; 11 {}; 21 {}", t.cos(), t.sin())).collect();
    let drawing = drawn(&format!("0 SPLINE; 70 11; 71 3; 74 17{points}"));
    // The interpolation error is (2π/16)⁴/384 = 6e-5 of the radius.
    assert!((area(only(&drawing)) / PI - 1.0).abs() < 1e-4);
}

const POST: &str = "0 BLOCK; 2 Post; 10 1; 20 0; 0 CIRCLE; 8 0; 10 2; 20 0; 40 0.5; 0 ENDBLK";

#[test]
fn blocks_are_expanded_turned_scaled_and_repeated() {
    let read_with = |entities: &str| {
        let nested = "0 BLOCK; 2 ROW; 10 0; 20 0; 0 INSERT; 2 post; 10 0; 20 0; 70 2; 44 3; 0 ENDBLK";
        read(file(&format!("{POST}; {nested}"), entities).as_bytes(), None, None).unwrap()
    };
    assert_discs(&read_with("0 INSERT; 2 POST; 10 5; 20 5"), &[[6.0, 5.0, 0.5]]);
    assert_discs(&read_with("0 INSERT; 2 POST; 10 5; 20 5; 41 2; 42 2; 43 2; 50 90"), &[[5.0, 7.0, 1.0]]);
    assert_discs(&read_with("0 INSERT; 2 POST; 10 5; 20 5; 41 -1; 42 1"), &[[4.0, 5.0, 0.5]]);
    assert_discs(&read_with("0 INSERT; 2 POST; 10 -5; 20 5; 230 -1"), &[[4.0, 5.0, 0.5]]);
    // Steps rotate with the insertion, but are not scaled.
    let rows = "0 INSERT; 2 POST; 10 0; 20 0; 41 2; 42 2; 50 90; 70 1; 71 3; 45 10";
    assert_discs(&read_with(rows), &[[0.0, 2.0, 1.0], [-10.0, 2.0, 1.0], [-20.0, 2.0, 1.0]]);
    assert_discs(&read_with("0 INSERT; 2 Row; 10 0; 20 9; 41 2; 42 2"), &[[2.0, 9.0, 1.0], [8.0, 9.0, 1.0]]);
    let stretched = read_with("0 INSERT; 2 POST; 10 5; 20 5; 41 2; 42 1");
    assert!((area(only(&stretched)) / (0.5 * PI) - 1.0).abs() < 1e-5, "a circle becomes an ellipse");
}

#[test]
fn layers_are_chosen_and_those_off_are_left_out() {
    let blocks =
        "0 BLOCK; 2 B; 10 0; 20 0; 0 CIRCLE; 8 0; 10 0; 20 0; 40 1; 0 CIRCLE; 8 cold; 10 0; 20 0; 40 2; 0 ENDBLK";
    let entities = "0 INSERT; 8 walls; 2 B; 10 0; 20 0; 0 CIRCLE; 8 dark; 10 0; 20 0; 40 3; 0 CIRCLE; 10 0; 20 0; 40 4; \
                    0 CIRCLE; 67 1; 10 0; 20 0; 40 5; 0 CIRCLE; 60 1; 10 0; 20 0; 40 6";
    let text = file(blocks, entities);
    let radii = |layers: Option<&[String]>| {
        let drawing = read(text.as_bytes(), layers, None).unwrap();
        assert_eq!(counts(&drawing.layers), [("0", 1), ("cold", 1), ("dark", 1), ("walls", 1)]);
        discs(&drawing).iter().map(|disc| disc.1).collect::<Vec<_>>()
    };
    assert_eq!(radii(None), [1.0, 4.0]);
    assert_eq!(radii(Some(&["walls".to_owned()])), [1.0]);
    assert_eq!(radii(Some(&["dark".to_owned(), "cold".to_owned()])), [2.0, 3.0], "layers that are named are read");
    assert_eq!(
        counts(&read(text.as_bytes(), None, None).unwrap().unused),
        [("entities in paper space", 1), ("entities on layers that are off or frozen", 2), ("invisible entities", 1)]
    );
    let refusals = read(text.as_bytes(), Some(&["posts".to_owned()]), None).unwrap_err();
    assert_eq!(
        refusals[0].to_string(),
        "layers: found `posts`, which is not in the file, expected one of `0`, `cold`, `dark`, `walls`"
    );
}

#[test]
fn what_encloses_nothing_is_counted_by_its_kind() {
    let drawing = drawn(
        "0 HATCH; 10 0; 20 0; 0 HATCH; 0 MPOLYGON; 0 TEXT; 1 x; 0 POINT; 10 0; 20 0; 0 LINE; 10 0; 20 0; 11 1; 21 0; \
         0 LWPOLYLINE; 70 0; 10 5; 20 5; 10 6; 20 6; 10 7; 20 5; 0 CIRCLE; 10 0; 20 0; 40 1; 220 1; 230 0; \
         0 POLYLINE; 70 64; 0 VERTEX; 10 0; 20 0; 0 SEQEND; 0 CIRCLE; 10 0; 20 0; 40 1",
    );
    assert_discs(&drawing, &[[0.0, 0.0, 1.0]]);
    let expected = [
        ("HATCH", 2),
        ("MPOLYGON", 1),
        ("POINT", 1),
        ("TEXT", 1),
        ("entities out of the plane", 1),
        ("meshes", 1),
        ("open lines", 3),
    ];
    assert_eq!(counts(&drawing.unused), expected);
}

#[test]
fn units_are_those_of_the_header_and_places_those_of_handles() {
    let drawing = drawn("0 CIRCLE; 5 2F; 10 3; 20 4; 40 2; 0 CIRCLE; 10 3; 20 4; 40 2");
    assert_eq!(drawing.unit.as_ref().map(|unit| (unit.name.as_str(), unit.meters)), Some(("mm", 1e-3)));
    assert_eq!(drawing.entities[0].location, "CIRCLE 2F");
    assert_eq!(drawing.entities[1].location, "CIRCLE at line 68");
    let old = lines("0 SECTION; 2 ENTITIES; 0 CIRCLE; 10 3; 20 4; 40 2; 0 ENDSEC; 0 EOF");
    assert!(read(old.as_bytes(), None, None).unwrap().unit.is_none());
}

#[test]
fn bad_files_are_refused_with_place_and_reason() {
    let chain: String =
        (0..70).map(|i| format!("0 BLOCK; 2 B{i}; 0 INSERT; 2 B{}; 10 0; 20 0; 0 ENDBLK;", i + 1)).collect();
    let many =
        format!("{POST}; 0 BLOCK; 2 ROW; 10 0; 20 0; 0 INSERT; 2 POST; 10 0; 20 0; 70 30000; 71 30000; 0 ENDBLK");
    let entities = "
0 CIRCLE; 5 2F; 10 3; 20 4; 40 -2 => CIRCLE 2F: found radius -2, expected a radius above 0
0 CIRCLE; 5 2F; 10 3; 20 4 => CIRCLE 2F: found a truncated entity, expected a value behind group code 40
0 CIRCLE; 5 2F; 10 3,5; 20 4; 40 1 => line 62, CIRCLE 2F: found `3,5` behind group code 10, expected a finite number
0 CIRCLE; 5 2F; 10 nan; 20 4; 40 1 => line 62, CIRCLE 2F: found `nan` behind group code 10, expected a finite number
0 CIRCLE; 5 2F; 10 1e99; 20 4; 40 1 => CIRCLE 2F: found a coordinate out of range, expected coordinates below
0 SPLINE; 5 2F; 71 3; 72 1000000000; 10 0; 20 0 => SPLINE 2F: found 1 control points for degree 3, expected knots
0 SPLINE; 5 2F; 71 3; 74 0 => SPLINE 2F: found no points, expected control points or fit points
0 ELLIPSE; 5 2F; 10 0; 20 0; 11 1; 21 0; 40 0 => ELLIPSE 2F: found an axis of no length
0 INSERT; 5 2F; 2 Nobody; 10 0; 20 0 => INSERT 2F: found the block `NOBODY`, which is not in the file";
    let entities = entities.trim().lines().map(|row| row.split_once(" => ").unwrap());
    let (itself, empty) = ("0 BLOCK; 2 A; 0 INSERT; 5 7; 2 A; 10 0; 20 0; 0 ENDBLK", "0 BLOCK; 2 E; 0 ENDBLK");
    let copies = "0 INSERT; 5 7; 2 E; 10 0; 20 0; 70 1000000000; 71 1000000000";
    let deep = "INSERT at line 938: found the block `B64` within itself, or within 64 others";
    let of_blocks = [
        (itself, "0 INSERT; 2 A; 10 0; 20 0", "INSERT 7: found the block `A` within itself"),
        (&chain, "0 INSERT; 2 B0; 10 0; 20 0", deep),
        (&many, "0 INSERT; 5 7; 2 ROW; 10 0; 20 0; 70 30000", ": found blocks that unfold into more than"),
        (empty, copies, "INSERT 7: found blocks that unfold into"),
    ];
    for (blocks, entities, expected) in entities.map(|(entities, expected)| ("", entities, expected)).chain(of_blocks) {
        let refusals = read(file(blocks, entities).as_bytes(), None, None).expect_err(entities);
        assert!(refusals[0].to_string().contains(expected), "{}\n{expected}", refusals[0]);
    }
    let whole = file("", "0 CIRCLE; 10 3; 20 4; 40 2");
    let broken = whole.replace("40\n2\n", "x\n2\n");
    let line = 1 + broken.lines().position(|line| line == "x").unwrap();
    let at_line = format!("line {line}: found `x`, expected a group code");
    for (text, expected) in [
        (String::new(), "line 2: found something else, expected `SECTION`"),
        ("hello".to_owned(), "line 1: found `hello`, expected a group code"),
        ("0".to_owned(), "line 1: found the end of the file, expected the value of a group"),
        (whole.replace("ENDSEC\n0\nEOF\n", "LINE\n"), "end of the file: found a section without an end"),
        (broken, at_line.as_str()),
    ] {
        let found = read(text.as_bytes(), None, None).unwrap_err()[0].to_string();
        assert!(found.starts_with(expected), "{found}\n{expected}");
    }
    let two = file("", "0 CIRCLE; 10 a; 20 4; 40 2; 0 CIRCLE; 10 b; 20 4; 40 2");
    assert_eq!(read(two.as_bytes(), None, None).unwrap_err().len(), 2, "all mistakes at once");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn damaged_text_files_are_read_or_refused_without_panic(at in 0usize..1100, with in "[ -~\n]{0,4}", cut in 0usize..8) {
        let nested = format!("{POST}; 0 BLOCK; 2 ROW; 10 0; 20 0; 0 INSERT; 2 post; 10 0; 20 0; 70 2; 44 3; 0 ENDBLK");
        let mut bytes = file(
            &nested,
            "0 INSERT; 2 ROW; 10 1; 20 2; 71 3; 45 2; 50 30; 0 SPLINE; 71 2; 40 0; 40 0; 40 0; 40 .5; 40 1; 40 1; 40 1; \
             10 0; 20 0; 10 1; 20 0; 10 1; 20 1; 10 0; 20 0; 0 SPLINE; 70 1; 11 0; 21 0; 11 1; 21 0; 11 1; 21 1; 0 ARC; 10 0; 20 0; 40 1; \
             50 10; 51 40; 0 LWPOLYLINE; 70 1; 10 0; 20 0; 42 .3; 10 1; 20 0; 10 1; 20 4; 0 POLYLINE; 70 1; 0 VERTEX; 10 0; 20 0; \
             0 VERTEX; 10 1; 20 1; 0 SEQEND; 0 LINE; 10 0; 20 0; 11 1; 21 1; 0 LINE; 10 0; 20 0; 11 1; 21 1; 0 ELLIPSE; 10 0; 20 0; 11 2; 21 1; 40 .5",
        )
        .into_bytes();
        let at = at.min(bytes.len());
        let end = (at + cut).min(bytes.len());
        bytes.splice(at..end, with.bytes());
        let _ = read(&bytes, None, None);
    }
}
