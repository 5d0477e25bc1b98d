//! Shape files: those that ship with the program, and what is refused.

use std::path::{Path, PathBuf};

use meniscus_core::math::Vec2;
use meniscus_drawings::ShapeFileError;
use meniscus_drawings::import::{Options, Refused};
use meniscus_geometry::Geometry;
use meniscus_geometry::spec::{Capsule, Channel, GeometrySpec, ShapeSpec, SolidSide, ThroatCosine, ThroatDiscs};

use crate::shapes::*;

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

#[test]
fn every_geometry_in_the_repository_is_sound() {
    let mut count = 0;
    for entry in std::fs::read_dir(repository("geometries")).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        // 999 is the group code of comments in DXF.
        let begins = ["#", "999\n"].iter().any(|mark| text.starts_with(mark));
        let has_comment = begins || text.lines().take(2).any(|line| line.starts_with("<!--"));
        assert!(has_comment, "{} has no first comment", path.display());
        // As laboratories write it, the DXF has no unit.
        let unit = path.extension().filter(|ending| *ending == "dxf").map(|_| "um".to_owned());
        let read = meniscus_case::load_shapes(&path, &Options { unit, ..Options::default() });
        let spec = read.unwrap_or_else(|error| panic!("{}: {error}", path.display())).spec;
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
    for (file, at_least) in
        [("four-discs", 40e-6), ("small-pack", 50e-6), ("wide-pack", 80e-6), ("pore-pack", 65e-6), ("long-pack", 80e-6)]
    {
        let path = repository(&format!("geometries/{file}.toml"));
        let spec = meniscus_case::load_shapes(&path, &Options::default()).unwrap().spec;
        let width = gap(&spec.shapes);
        assert!(width > at_least * (1.0 - 1e-6), "{file}: {width:e}");
        let g = Geometry::new(&spec).unwrap();
        let found = g.narrowest_throat().unwrap().width;
        assert!((found - width).abs() < 1e-6 * width, "{file}: {found:e}");
    }
}

#[test]
fn bad_shape_files_are_refused_with_all_their_lines() {
    let load = |path: &Path| meniscus_drawings::load(path, &Options::default());
    let refused = |name: &str| match load(&repository(name)) {
        Err(ShapeFileError::Refused { refused, .. }) => refused,
        other => panic!("{other:?}"),
    };
    let Refused::Parts(refusals) = refused("crates/drawings/tests/shapes/bad.xyr") else { panic!("other mistakes") };
    let places: Vec<_> = refusals.iter().map(|refusal| refusal.location.as_str()).collect();
    assert_eq!(places, ["line 4", "line 5", "line 6", "line 7"]);
    let Refused::Shapes(problems) = refused("crates/drawings/tests/shapes/overlapping-rings.wkt") else {
        panic!("other mistakes")
    };
    assert!(problems[0].path.starts_with("line "), "{}", problems[0]);
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
