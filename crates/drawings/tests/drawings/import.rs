//! Drawings of other programs: one pack by every format, holes, units, windows, what is refused, and bytes that are no drawing at all.

use std::f64::consts::TAU;
use std::path::PathBuf;

use meniscus_core::math::Vec2;
use meniscus_drawings::import::drawing::Refusal;
use meniscus_drawings::import::{Imported, Options, Refused};
use meniscus_drawings::{ShapeFileError, load};
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{ShapeSpec, SolidSide};
use proptest::prelude::*;
use shapefile::{Point, Polygon, PolygonRing, ShapeWriter};

/// A file in a folder that goes with it.
struct File {
    path: PathBuf,
    _folder: tempfile::TempDir,
}

fn file(name: &str, content: impl AsRef<[u8]>) -> File {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, content).unwrap();
    File { path, _folder: folder }
}

fn unit(name: &str) -> Options {
    Options { unit: Some(name.into()), ..Options::default() }
}

fn read(name: &str, content: impl AsRef<[u8]>, options: &Options) -> Imported {
    load(&file(name, content).path, options).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn refused(name: &str, content: impl AsRef<[u8]>, options: &Options) -> ShapeFileError {
    load(&file(name, content).path, options).map(|read| read.spec).expect_err(name)
}

/// Discs in mm: x, y, radius; rows that do not touch.
fn pack() -> Vec<[f64; 3]> {
    let disc = |i: i32, j: i32| {
        let wobble = f64::from((7 * i + 13 * j) % 11) / 11.0;
        [f64::from(i) + 0.1 * wobble, 0.9 * f64::from(j) - 0.05 * wobble, 0.3 + 0.1 * wobble]
    };
    (0..8).flat_map(|i| (0..6).map(move |j| disc(i, j))).collect()
}

/// The disc as a polygon of 64 vertices on it, the first one repeated.
fn sampled([x, y, r]: [f64; 3]) -> Vec<[f64; 2]> {
    let point = |k: usize| {
        let angle = 0.1 + TAU * (k % 64) as f64 / 64.0;
        [x + r * angle.cos(), y + r * angle.sin()]
    };
    (0..=64).map(point).collect()
}

fn well_known_text(rings: &[Vec<[f64; 2]>]) -> String {
    let ring = |ring: &Vec<[f64; 2]>| ring.iter().map(|[x, y]| format!("{x} {y}")).collect::<Vec<_>>().join(", ");
    rings.iter().map(|r| format!("POLYGON (({}))\n", ring(r))).collect()
}

fn geojson(rings: &[Vec<[f64; 2]>]) -> String {
    let features: Vec<_> = rings
        .iter()
        .map(|ring| {
            serde_json::json!({ "type": "Feature", "properties": {},
                "geometry": { "type": "Polygon", "coordinates": [ring] } })
        })
        .collect();
    serde_json::json!({ "type": "FeatureCollection", "features": features }).to_string()
}

/// A main file with one record for each group of rings.
fn shp(groups: &[Vec<Vec<[f64; 2]>>]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut writer = ShapeWriter::new(&mut bytes);
    for rings in groups {
        let ring = |r: &Vec<[f64; 2]>| PolygonRing::Outer(r.iter().map(|[x, y]| Point::new(*x, *y)).collect());
        writer.write_shape(&Polygon::with_rings(rings.iter().map(ring).collect())).unwrap();
    }
    writer.finalize().unwrap();
    drop(writer);
    bytes.into_inner()
}

fn porosity(read: &Imported) -> f64 {
    Geometry::new(&read.spec).unwrap().porosity().value
}

#[test]
fn one_pack_is_the_same_discs_by_every_format() {
    let rings: Vec<_> = pack().into_iter().map(sampled).collect();
    let list: String = pack().iter().map(|[x, y, r]| format!("{x} {y} {r}\n")).collect();
    let groups: Vec<_> = rings.iter().map(|ring| vec![ring.clone()]).collect();
    let mm = unit("mm");
    let expected = read("pack.xyr", list, &mm);
    for (name, found) in [
        ("WKT", read("pack.wkt", well_known_text(&rings), &mm)),
        ("GeoJSON", read("pack.geojson", geojson(&rings), &mm)),
        ("shapefile", read("pack.shp", shp(&groups), &mm)),
    ] {
        assert!((porosity(&found) - porosity(&expected)).abs() < 1e-9, "{name}: {}", porosity(&found));
        assert!(found.notes.iter().any(|note| note.contains("(48 circles recognized")), "{name}: {:?}", found.notes);
        for (a, b) in found.spec.shapes.iter().zip(&expected.spec.shapes) {
            let (ShapeSpec::Disc(a), ShapeSpec::Disc(b)) = (a, b) else { panic!("{name}: {a:?} for {b:?}") };
            assert!((a.radius / b.radius - 1.0).abs() < 1e-9, "{name}");
            assert!((Vec2::from(a.center) - Vec2::from(b.center)).norm() < 1e-9 * b.radius, "{name}");
        }
    }
    // Without recognition discs are polygons, arcs or corners, with the area that these have.
    let as_arcs = Options { recognize_circles: Some(false), ..mm.clone() };
    let as_corners = Options { smooth_below_deg: Some(0.0), ..as_arcs.clone() };
    let solid = |options: &Options| 1.0 - porosity(&read("pack.wkt", well_known_text(&rings), options));
    assert!((solid(&as_arcs) / (1.0 - porosity(&expected)) - 1.0).abs() < 1e-6);
    let inscribed = 32.0 / std::f64::consts::PI * (TAU / 64.0).sin();
    let frame = |read: &Imported| (Vec2::from(read.spec.max) - Vec2::from(read.spec.min)).product();
    let corners = read("pack.wkt", well_known_text(&rings), &as_corners);
    let areas = [(1.0 - porosity(&corners)) * frame(&corners), (1.0 - porosity(&expected)) * frame(&expected)];
    assert!((areas[0] / areas[1] / inscribed - 1.0).abs() < 1e-9);
}

#[test]
fn holes_and_islands_of_a_shapefile_are_told_by_containment() {
    let square = |half: f64| vec![[-half, -half], [-half, half], [half, half], [half, -half], [-half, -half]];
    // The writer turns all rings as outer ones.
    let found = read("nest.shp", shp(&[vec![square(3.0), square(2.0), square(1.0)]]), &unit("um"));
    assert_eq!(found.spec.shapes.len(), 2);
    let area = (Vec2::from(found.spec.max) - Vec2::from(found.spec.min)).product() * (1.0 - porosity(&found));
    assert!((area / ((36.0 - 16.0 + 4.0) * 1e-12) - 1.0).abs() < 1e-9, "{area:e}");
}

#[test]
fn rings_of_a_shapefile_that_cross_are_refused_with_their_record_and_those_that_touch_are_read() {
    let square = |x: f64, y: f64| vec![[x, y], [x, y + 2.0], [x + 2.0, y + 2.0], [x + 2.0, y], [x, y]];
    let apart = vec![square(9.0, 9.0)];
    for (name, rings, place) in [
        // Two outer rings, and a ring that reaches out of the one around it.
        ("side by side", vec![square(0.0, 0.0), square(1.0, 1.0)], "rings 0 and 1 that cross at (1e-6, 2e-6)"),
        ("third", vec![square(0.0, 0.0), square(5.0, 0.0), square(6.0, 1.0)], "rings 1 and 2 that cross"),
    ] {
        let message = refused("a.shp", shp(&[apart.clone(), rings]), &unit("um")).to_string();
        assert!(message.contains("record 2") && message.contains(place), "{name}: {message}");
        assert!(message.contains("a record of its own"), "{name}: {message}");
    }
    let bow = vec![[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 3.0], [0.0, 0.0]];
    let message = refused("a.shp", shp(&[apart.clone(), vec![bow]]), &unit("um")).to_string();
    assert!(message.contains("record 2") && message.contains("self-intersection"), "{message}");
    // At a corner, in one record; overlapping ones in records of their own are united.
    let corner = shp(&[vec![square(0.0, 0.0), square(2.0, 2.0)]]);
    assert_eq!(read("a.shp", corner, &unit("um")).spec.shapes.len(), 2);
    assert_eq!(read("a.shp", shp(&[vec![square(0.0, 0.0)], vec![square(1.0, 1.0)]]), &unit("um")).spec.shapes.len(), 2);
}

#[test]
fn a_unit_is_asked_for_where_the_file_has_none_and_the_projection_gives_one() {
    let rings = [vec![[0.0, 0.0], [4.0, 0.0], [0.0, 3.0], [0.0, 0.0]]];
    for (name, content) in [("a.geojson", geojson(&rings).into_bytes()), ("a.shp", shp(&[rings.to_vec()]))] {
        let found = refused(name, content, &Options::default());
        let ShapeFileError::Refused { refused: Refused::Keys(problems), .. } = found else { panic!("{name}: {found}") };
        assert!(problems[0].path == "unit" && problems[0].help.contains("scale"), "{}", problems[0]);
    }
    let shape = file("a.shp", shp(&[rings.to_vec()]));
    let projection = shape.path.with_extension("prj");
    std::fs::write(&projection, r#"PROJCS["p",GEOGCS["g",UNIT["Degree",0.017]],UNIT["Foot",0.3048]]"#).unwrap();
    let feet = load(&shape.path, &Options::default()).unwrap();
    let ShapeSpec::Polygon(polygon) = &feet.spec.shapes[0] else { panic!("{feet:?}") };
    assert!(polygon.outer.iter().any(|p| (p[0] - 4.0 * 0.3048).abs() < 1e-12), "{polygon:?}");
    assert!(feet.notes[0].contains("Foot"), "{:?}", feet.notes);
    std::fs::write(&projection, r#"GEOGCS["g",UNIT["Degree",0.017]]"#).unwrap();
    assert!(load(&shape.path, &unit("mm")).unwrap_err().to_string().contains("degrees"));
    // Well-known text is in m where nobody says otherwise.
    assert_eq!(read("a.wkt", well_known_text(&rings), &Options::default()).spec.max[0], 4.4);
}

#[test]
fn a_window_takes_what_reaches_into_it_and_inverting_changes_solid_and_pore() {
    let list: String = pack().iter().map(|[x, y, r]| format!("{x} {y} {r}\n")).collect();
    let window = Options { window: Some([[0.5e-3, 0.5e-3], [3.5e-3, 2.5e-3]]), ..unit("mm") };
    let found = read("pack.discs", &list, &window);
    assert_eq!((found.spec.min, found.spec.max), ([0.5e-3, 0.5e-3], [3.5e-3, 2.5e-3]));
    assert!((6..48).contains(&found.spec.shapes.len()), "{}", found.spec.shapes.len());
    assert!(found.notes.iter().any(|note| note.contains("outside of the domain: ")), "{:?}", found.notes);
    let inverted = read("pack.discs", &list, &Options { invert: Some(true), ..window });
    assert_eq!(inverted.spec.solid, SolidSide::Outside);
    assert!((porosity(&found) + porosity(&inverted) - 1.0).abs() < 1e-12);
}

#[test]
fn a_window_with_open_sides_cuts_grains_and_draws_them_out_beyond() {
    let case = |window: &str, sides: &str| {
        let text = format!(
            "format = 1\ntitle = \"t\"\n[geometry]\nfile = \"p.xyr\"\n{window}\n[sph]\nspacing = 0.02\n[sph.phases]\n\
             wetting = {{ density = 1.0e3, viscosity = 1.0e-3 }}\n{sides}[time]\nend = 1.0\n"
        );
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("p.xyr"), "0.2 0.5 0.25\n0.9 0.1 0.3\n3 3 0.1\n").unwrap();
        let path = folder.path().join("case.toml");
        std::fs::write(&path, text).unwrap();
        meniscus_case::load(&path, &meniscus_core::input::Overrides::default())
    };
    let window = "window = [[0.0, 0.0], [1.0, 1.0]]";
    let open = "[sph.sides]\nleft = \"inlet\"\nright = \"outlet\"\n[sph.sides.open]\nleft = { pressure = 1.0 }\n\
                right = { pressure = 0.0 }\n";
    let cut = case(window, open).unwrap();
    assert!(cut.notes.iter().any(|note| note.contains("shapes (2)")), "{:?}", cut.notes);
    let whole = case(window, "").unwrap();
    let [a, b] = [&cut, &whole].map(|loaded| Geometry::new(&loaded.case.geometry).unwrap());
    assert!((a.porosity().value - b.porosity().value).abs() < 1e-12);
    // On the side itself the left disc is 0.15 to each side of its center.
    for (x, expected) in [([-0.3, 0.36], -0.01), ([-0.3, 0.34], 0.01)] {
        assert!((a.signed_distance(Vec2::from(x)) - expected).abs() < 1e-9, "{x:?}");
    }
    assert!(b.signed_distance(Vec2::new(-0.3, 0.5)) > 0.2, "a closed side leaves the disc whole");
    // A joined side ends the drawing: the cut disc has a face there, and its image does not reach in from the other side.
    let joined = case(window, "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n").unwrap().case;
    let g = Geometry::new(&joined.geometry).unwrap().with_periodic([true, false]);
    assert!((g.porosity().value - b.porosity().value).abs() < 1e-12);
    for (keys, message) in [
        ("window = [[0, 0], [1, 1]]\nmin = [0, 0]", "`window` and `min` are both given"),
        ("unit = \"parsec\"", "there is no unit `parsec`"),
        ("min = [0, 0]\nmax = [1, 1]", "`window` in place of"),
    ] {
        let error = case(keys, "").unwrap_err().render();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_place_and_way_out() {
    let m = Options::default();
    let bow = "POLYGON ((0 0, 1 1, 1 0, 0 1, 0 0))";
    let both = Options { scale: Some(1.0), ..unit("mm") };
    let backwards = Options { window: Some([[1.0, 0.0], [0.0, 1.0]]), ..Options::default() };
    let layers = Options { layers: Some(vec!["a".into()]), ..Options::default() };
    for (name, content, options, message) in [
        ("a.xyr", "0 0 1\n0 0\n", &m, "line 2: found `0 0`, expected three numbers"),
        ("a.xyr", "", &m, "no disc at all"),
        ("a.wkt", bow, &m, "line 1, polygon.outer: exterior ring has a self-intersection"),
        ("a.wkt", "POLYGON ((0 0, 1 0, 1 1, 0 1))", &m, "repeats the first point"),
        ("a.wkt", "LINESTRING (0 0, 1 0)", &m, "no polygon at all"),
        ("a.wkt", "POLYGON ((0 0, 1 0, 1 1e999, 0 0))", &m, "finite numbers"),
        ("a.wkt", "POLYGON ((0 0, 1 0, 2 0, 0 0))", &m, "rings without area (1)"),
        (
            "a.xyr",
            "9 9 1",
            &Options { window: Some([[0.0, 0.0], [1.0, 1.0]]), ..Options::default() },
            "the shapes span (8e0, 8e0)",
        ),
        ("a.geojson", "{\"type\": 3}", &m, "expected a FeatureCollection"),
        ("a.shp", "not a shapefile", &m, "code 9994"),
        ("a.xyr", "\u{0}", &m, "line 1"),
        ("a.xyr", "0 0 1", &unit("parsec"), "there is no unit `parsec`"),
        ("a.xyr", "0 0 1", &both, "both given"),
        ("a.xyr", "0 0 1", &backwards, "window = [[x0, y0], [x1, y1]]"),
        ("a.xyr", "0 0 1", &layers, "belongs to SVG and DXF"),
        ("a.stl", "", &m, ".geojson"),
    ] {
        let found = refused(name, content, options).to_string();
        assert!(found.contains(message), "{name}: {found}");
    }
    let found = refused("a.csv", b"0,0,1\n\xff\xfe", &m);
    let ShapeFileError::Refused { refused: Refused::Parts(refusals), .. } = found else { panic!("{found}") };
    assert_eq!(refusals[0].location, "line 2, byte 7");
    let _: &Refusal = &refusals[0];
}

/// Bytes of good files with some of them changed.
fn spoiled() -> impl Strategy<Value = (usize, Vec<(usize, u8)>, usize)> {
    (0..4_usize, prop::collection::vec((0..4000_usize, any::<u8>()), 0..12), 0..4000_usize)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn spoiled_files_are_read_or_refused_without_a_panic((format, changes, length) in spoiled()) {
        let rings: Vec<_> = pack().into_iter().take(2).map(sampled).collect();
        let (name, mut bytes) = match format {
            0 => ("a.wkt", well_known_text(&rings).into_bytes()),
            1 => ("a.geojson", geojson(&rings).into_bytes()),
            2 => ("a.shp", shp(&[rings.clone(), rings[..1].to_vec()])),
            _ => ("a.xyr", b"# domain -9 -9 9 9\n0 0 1\n3 0 .5\n".to_vec()),
        };
        for (at, byte) in changes {
            let at = at % bytes.len();
            bytes[at] = byte;
        }
        if length % 3 == 0 {
            bytes.truncate(length);
        }
        let found = load(&file(name, &bytes).path, &unit("mm"));
        if let Ok(read) = found {
            prop_assert!(read.spec.shapes.iter().all(|shape| shape.problems("shape").is_empty()));
        }
    }

    #[test]
    fn random_bytes_are_read_or_refused_without_a_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        for name in ["a.wkt", "a.geojson", "a.shp", "a.xyr"] {
            let _ = load(&file(name, &bytes).path, &unit("mm"));
        }
    }
}
