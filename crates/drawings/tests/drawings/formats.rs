//! Every file has the porosity, the discs and the unit of what was drawn.

use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use meniscus_geometry::spec::Disc;

use crate::contents::*;
use crate::files::*;

#[test]
fn every_file_of_the_pack_has_its_porosity_its_discs_and_its_unit() {
    let reference = reference();
    let expected: Vec<[f64; 3]> =
        rows(&reference["discs"]).iter().map(|row| [0, 1, 2].map(|i| number(&row[i]))).collect();
    for (name, options, kind, says) in packs() {
        let found = imported(name, &options);
        let (spec, notes) = (&found.spec, found.notes.join("\n"));
        assert!(notes.contains(says), "{name}: {notes}");
        let error = porosity(spec) / number(&reference["porosity"]) - 1.0;
        let discs = discs(spec);
        // The nearest disc of the file for each of the pack: center and radius in m.
        let off = expected.iter().map(|&[x, y, r]| {
            let off = |d: &Disc| (d.center[0] - x).hypot(d.center[1] - y).max((d.radius - r).abs());
            discs.iter().map(off).fold(f64::INFINITY, f64::min)
        });
        let off = off.fold(0.0, f64::max);
        println!(
            "{name:24} porosity {error:+.2e}  {} discs of {} shapes, off {off:.1e} m",
            discs.len(),
            spec.shapes.len()
        );
        assert!((spec.max[0] - 14e-3).abs() < 1e-9 && (spec.max[1] - 9e-3).abs() < 1e-9, "{name}: {:?}", spec.max);
        // Two per mille are asked for. Exact files have coordinates in steps of 1e-7 m at worst.
        let (share, length) = match kind {
            Kind::Exact => (1e-6, 1e-9),
            Kind::Sampled => (2e-3, 1e-6),
            // A tenth and a fifth of a pixel.
            Kind::Gray => (2e-3, 2e-6),
            Kind::Binary => (2e-3, 4e-6),
        };
        assert!(error.abs() < share, "{name}: {error:e}");
        assert_eq!((discs.len(), spec.shapes.len()), (60, 60), "{name}: {notes}");
        assert!(off < length, "{name}: {off:e}");
    }
}

#[test]
fn every_file_of_the_grains_has_their_porosity_and_their_number() {
    let expected = number(&reference()["grains"]["porosity"]);
    let scaled = Options { scale: Some(1e-3), ..Options::default() };
    for (name, options) in [
        ("grains.dxf", Options::default()),
        ("grains.svg", Options::default()),
        ("grains.wkt", unit("mm")),
        ("grains.geojson", unit("mm")),
        ("grains.shp", scaled),
    ] {
        let found = imported(name, &in_box(options, GRAINS));
        let error = porosity(&found.spec) / expected - 1.0;
        println!("{name:24} porosity {error:+.2e}  {} shapes\n  {}", found.spec.shapes.len(), found.notes.join("\n  "));
        assert!(error.abs() < 2e-3, "{name}: {error:e}");
        // A square with a hole, the disc in the hole, triangle, angle, stadium, ellipse, rounded rectangle.
        assert_eq!(found.spec.shapes.len(), 7, "{name}");
        assert_eq!(discs(&found.spec).len(), 1, "{name}");
    }
}

#[test]
fn columns_are_picked_and_diameters_halved() {
    let radii = rows(&reference()["discs"]).into_iter().map(|row| [0, 1, 2].map(|i| number(&row[i])));
    let found = discs(&imported("pack-columns.csv", &columns()).spec);
    assert_eq!(found.len(), 60);
    for (disc, [x, y, radius]) in found.iter().zip(radii) {
        let off = (disc.center[0] - x).hypot(disc.center[1] - y).max((disc.radius - radius).abs());
        assert!(off < 1e-12, "{disc:?}");
    }
}

#[test]
fn windows_cut_grains_to_their_exact_porosity() {
    for row in rows(&reference()["windows"]) {
        let [x0, y0, x1, y1, expected] = [0, 1, 2, 3, 4].map(|i| number(&row[i]));
        for (name, options) in [("pack.xyr", Options::default()), ("pack-r2010.dxf", Options::default())] {
            let found = imported(name, &in_box(options, [[x0, y0], [x1, y1]]));
            // Closed form; the steps of coordinates of the drawing.
            assert!((porosity(&found.spec) - expected).abs() < 1e-9, "{name} {row:?}: {}", porosity(&found.spec));
        }
    }
}

#[test]
fn drawings_without_a_known_length_are_refused_with_a_way_out() {
    let refusal = |name: &str, options: &Options| load(&file(name), options).unwrap_err().to_string();
    let degrees = refusal("degrees.shp", &Options::default());
    assert!(degrees.contains("degrees") && degrees.contains("degrees.shp"), "{degrees}");
    for name in ["pack-r12.dxf", "pack-arcs.dxf", "pack.geojson", "grains.geojson"] {
        let message = refusal(name, &Options::default());
        assert!(message.contains("unit of the drawing is not known") && message.contains("unit = \"mm\""), "{message}");
    }
    let message = refusal("pack-grey.png", &Options::default());
    assert!(message.contains("pixel-size"), "{message}");
}

#[test]
fn a_white_page_is_left_out() {
    let found = imported("page.svg", &Options::default());
    let notes = found.notes.join("\n");
    assert!(notes.contains("white"), "{notes}");
    assert!(porosity(&found.spec) > 0.3, "{notes}");
}
