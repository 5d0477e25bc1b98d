//! Drawings that the program writes, read back by its own readers where the shape-file module has them.

use std::f64::consts::PI;

use meniscus_drawings::export::{Beside, ExportError, Format, write};
use meniscus_drawings::import::Options;
use meniscus_drawings::import::drawing::Outline;
use meniscus_drawings::import::mask::read;
use meniscus_drawings::load;
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Capsule, Disc, GeometrySpec, Polygon, Rectangle, ShapeSpec, SolidSide};

/// Discs, one across a side, a capsule, a turned rectangle and a polygon with a hole, apart from each other.
fn shapes() -> GeometrySpec {
    let square = |h: f64, turn: bool| {
        let mut ring = vec![[-h, -h], [h, -h], [h, h], [-h, h]];
        if turn {
            ring.reverse();
        }
        ring
    };
    GeometrySpec {
        min: [-1e-3, -1e-3],
        max: [3e-3, 2e-3],
        solid: SolidSide::Inside,
        shapes: vec![
            ShapeSpec::Disc(Disc { center: [0.0, 0.0], radius: 5e-4 }),
            ShapeSpec::Disc(Disc { center: [3e-3, 1.5e-3], radius: 4e-4 }),
            ShapeSpec::Capsule(Capsule { ends: [[1.5e-3, 0.0], [2.2e-3, 0.3e-3]], radius: 2e-4 }),
            ShapeSpec::Rectangle(Rectangle { center: [0.2e-3, 1.4e-3], size: [6e-4, 3e-4], rotation_deg: 20.0 }),
            ShapeSpec::Polygon(Polygon {
                outer: square(4e-4, false),
                holes: vec![square(2e-4, true)],
                position: [1.4e-3, 1.3e-3],
                rotation_deg: 10.0,
            }),
        ],
    }
}

fn discs() -> GeometrySpec {
    let mut spec = shapes();
    spec.shapes.truncate(2);
    spec
}

fn porosity(spec: &GeometrySpec) -> f64 {
    Geometry::new(spec).unwrap().porosity().value
}

fn read_back(bytes: &[u8], name: &str) -> GeometrySpec {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    load(&path, &Options::default()).unwrap().spec
}

#[test]
fn a_list_of_discs_comes_back_to_rounding() {
    let spec = discs();
    let back = read_back(&write(&spec, Format::Discs, Beside::default()).unwrap(), "a.xyr");
    assert_eq!((back.min, back.max, back.shapes.len()), (spec.min, spec.max, spec.shapes.len()));
    for pair in back.shapes.iter().zip(&spec.shapes) {
        let (ShapeSpec::Disc(found), ShapeSpec::Disc(disc)) = pair else { panic!("{pair:?}") };
        let offset = (found.center[0] - disc.center[0]).hypot(found.center[1] - disc.center[1]);
        assert!(offset.max((found.radius - disc.radius).abs()) < 1e-15 * (spec.max[0] - spec.min[0]), "{pair:?}");
    }
    let refused = write(&shapes(), Format::Discs, Beside::default()).unwrap_err();
    assert!(matches!(refused, ExportError::NoDisc { others: 3, all: 5 }), "{refused}");
}

#[test]
fn a_shape_file_comes_back_bit_by_bit() {
    let text = String::from_utf8(write(&shapes(), Format::Toml, Beside::default()).unwrap()).unwrap();
    let rest = text.strip_prefix("format = 1\n").unwrap();
    assert_eq!(toml::from_str::<GeometrySpec>(rest).unwrap(), shapes());
}

#[test]
fn well_known_text_keeps_domain_and_area() {
    let back = read_back(&write(&shapes(), Format::Wkt, Beside::default()).unwrap(), "a.wkt");
    assert_eq!((back.min, back.max, back.shapes.len()), (shapes().min, shapes().max, 5));
    // 100 chords take 6.6e-4 of a disc's area.
    assert!((porosity(&back) - porosity(&shapes())).abs() < 7e-4 * (1.0 - porosity(&shapes())));
}

#[test]
fn a_pore_between_shapes_is_written_as_the_solid_around_it() {
    let spec = GeometrySpec { solid: SolidSide::Outside, ..discs() };
    let back = read_back(&write(&spec, Format::Wkt, Beside::default()).unwrap(), "a.wkt");
    assert!((porosity(&back) - porosity(&spec)).abs() < 7e-4, "{} {}", porosity(&back), porosity(&spec));
}

#[test]
fn geojson_tells_its_unit_and_holds_every_ring() {
    let bytes = write(&shapes(), Format::GeoJson, Beside::default()).unwrap();
    let value: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
    assert_eq!(value["unit"], "m");
    let features = value["features"].as_array().unwrap();
    assert_eq!(features.len(), 5);
    assert_eq!(features[4]["geometry"]["coordinates"].as_array().unwrap().len(), 2);
}

#[test]
fn svg_holds_circles_and_arcs_with_their_radii_in_mm() {
    let text = String::from_utf8(write(&shapes(), Format::Svg, Beside::default()).unwrap()).unwrap();
    assert_eq!(text.matches("<circle").count(), 2);
    assert_eq!(text.matches("<path").count(), 3);
    let radii: Vec<f64> = text.split(" A").skip(1).map(|arc| arc.split(' ').next().unwrap().parse().unwrap()).collect();
    assert!(
        radii.len() == 2 && radii.iter().all(|r| (r - 0.2).abs() < 1e-12),
        "the round ends of the capsule: {radii:?}"
    );
    assert!(text.contains("viewBox=\"-1 -2 4 3\"") && text.contains("width=\"4mm\""), "{text}");
}

#[test]
fn dxf_holds_circles_and_bulges_in_mm() {
    let bytes = write(&shapes(), Format::Dxf, Beside::default()).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    assert_eq!(lines.len() % 2, 0);
    let groups: Vec<[&str; 2]> = lines.chunks(2).map(|pair| [pair[0], pair[1]]).collect();
    let unit = groups.iter().position(|group| *group == ["9", "$INSUNITS"]).unwrap();
    assert_eq!(groups[unit + 1], ["70", "4"]);
    let handles: Vec<&str> =
        groups.iter().filter(|group| ["5", "105"].contains(&group[0])).map(|group| group[1]).collect();
    let different: std::collections::BTreeSet<&str> = handles.iter().copied().collect();
    assert_eq!(handles.len(), different.len(), "{handles:?}");
    let begin = groups.iter().position(|group| *group == ["2", "ENTITIES"]).unwrap();
    let entities = groups[begin + 1..].split(|group| group[0] == "0").skip(1);
    let kinds = groups[begin + 1..].iter().filter(|group| group[0] == "0").map(|group| group[1]);
    let (mut radii, mut bulges) = (Vec::new(), 0);
    for (kind, entity) in kinds.zip(entities).take_while(|(kind, _)| *kind != "ENDSEC") {
        let numbers = |code: &str| {
            let values = entity.iter().filter(|group| group[0] == code);
            values.map(|group| group[1].parse::<f64>().unwrap()).collect::<Vec<_>>()
        };
        match kind {
            "CIRCLE" => radii.extend(numbers("40")),
            "LWPOLYLINE" => {
                assert_eq!((numbers("70"), numbers("90")[0] as usize), (vec![1.0], numbers("42").len()));
                // Both ends of the capsule are half circles.
                bulges += numbers("42").iter().filter(|&&bulge| (bulge - 1.0).abs() < 1e-12).count();
            }
            other => panic!("{other}"),
        }
    }
    assert_eq!((radii, bulges), (vec![0.5, 0.4], 2));
}

#[test]
fn a_mask_holds_the_share_of_solid_of_every_pixel() {
    let spec = shapes();
    let pixel = 1e-5;
    let bytes = write(&spec, Format::Png, Beside { pixel: Some(pixel), ..Beside::default() }).unwrap();
    let image = image::load_from_memory(&bytes).unwrap().to_luma8();
    assert_eq!(image.dimensions(), (400, 300));
    let solid: f64 = image.pixels().map(|p| 1.0 - f64::from(p[0]) / 255.0).sum::<f64>() / 120_000.0;
    // 256 steps of gray in some thousand pixels along the walls.
    assert!((solid - (1.0 - porosity(&spec))).abs() < 2e-5, "{solid} {}", 1.0 - porosity(&spec));
    let drawing = read(&bytes, &Options { pixel_size: Some(pixel), ..Options::default() }).unwrap();
    let radii = drawing
        .entities
        .iter()
        .filter_map(|e| if let Outline::Disc { radius, .. } = e.outline { Some(radius * pixel) } else { None });
    let radii: Vec<f64> = radii.collect();
    assert_eq!(radii.len(), 1);
    assert!((PI * radii[0].powi(2) / (PI * 25e-8) - 1.0).abs() < 1e-3);
}

#[test]
fn endings_that_name_no_format_are_refused() {
    assert!(matches!(Format::of("a.DXF".as_ref()), Ok(Format::Dxf)));
    assert!(Format::of("a.pdf".as_ref()).unwrap_err().to_string().contains(".svg"));
    assert!(write(&discs(), Format::Png, Beside { pixel: Some(1.0), ..Beside::default() }).is_err());
}
