//! One pack and one drawing of grains as other programs write them: the same porosity, network and capillary pressures by every route,
//! and the network of an independent brute-force search. The files are told in `drawings/README.md`.

use std::cell::Cell;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use cpu_time::ThreadTime;
use meniscus::geometry::curve::Curve;
use meniscus::geometry::import::{Imported, Options};
use meniscus::geometry::spec::{Disc, GeometrySpec, ShapeSpec};
use meniscus::geometry::{Geometry, load};
use meniscus::math::Vec2;
use meniscus::network::displacement::{Conditions, Displacement, Events, Phase};
use meniscus::network::extract;
use meniscus::network::graph::{Network, Pores, Throat};
use meniscus::network::menisci::{Hand, Passage, Wall, WallPart};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use serde_json::Value;

/// The box of the pack in m.
const PACK: [[f64; 2]; 2] = [[0.0, 0.0], [14e-3, 9e-3]];
/// The box of the grains in m.
const GRAINS: [[f64; 2]; 2] = [[0.0, 0.0], [10e-3, 6e-3]];

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/drawings").join(name)
}

fn reference() -> Value {
    serde_json::from_slice(&std::fs::read(file("reference.json")).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn rows(value: &Value) -> Vec<Vec<Value>> {
    value.as_array().unwrap().iter().map(|row| row.as_array().unwrap().clone()).collect()
}

fn unit(name: &str) -> Options {
    Options { unit: Some(name.into()), ..Options::default() }
}

fn in_box(options: Options, window: [[f64; 2]; 2]) -> Options {
    Options { window: Some(window), ..options }
}

/// How a file describes the discs of the pack.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// To the digits of the file.
    Exact,
    /// By polygons on the circles, or cubic curves.
    Sampled,
    /// By the share of solid in each pixel.
    Gray,
    /// By black and white pixels.
    Binary,
}

/// Columns x and y in mm; the column of diameters stands where a radius is expected.
fn columns() -> Options {
    let scale = Some(1e-3);
    in_box(Options { scale, columns: Some([2, 3, 1]), separator: Some(';'), ..Options::default() }, PACK)
}

/// Files of the pack with what their readers need, how they describe discs, and what the notes must say of the unit.
fn packs() -> Vec<(&'static str, Options, Kind, &'static str)> {
    let plain = Options::default;
    let mask = || Options { pixel_size: Some(2e-5), ..Options::default() };
    vec![
        ("pack.xyr", in_box(plain(), PACK), Kind::Exact, "drawing unit m"),
        ("pack.wkt", in_box(unit("mm"), PACK), Kind::Sampled, "drawing unit mm (unit)"),
        ("pack.geojson", in_box(unit("um"), PACK), Kind::Sampled, "drawing unit um (unit)"),
        ("pack.shp", in_box(plain(), PACK), Kind::Sampled, "as the file says"),
        ("pack-r12.dxf", in_box(unit("mm"), PACK), Kind::Exact, "drawing unit mm (unit)"),
        ("pack-r2000-inch.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit in"),
        ("pack-r2010.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit mm"),
        ("pack-r2018-binary.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit m "),
        ("pack-arcs.dxf", in_box(unit("mm"), PACK), Kind::Exact, "drawing unit mm (unit)"),
        ("pack-bulges.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit mm"),
        ("pack-blocks.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit um"),
        ("pack-splines.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit cm"),
        ("pack-inkscape.svg", plain(), Kind::Exact, "as the file says"),
        ("pack-matplotlib.svg", plain(), Kind::Sampled, "as the file says"),
        ("pack-collection.svg", plain(), Kind::Sampled, "as the file says"),
        ("pack-matplotlib.png", mask(), Kind::Gray, "1 pixel = 2e-5 m (pixel-size)"),
        ("pack-grey.png", mask(), Kind::Gray, "1 pixel = 2e-5 m (pixel-size)"),
        ("pack-16bit.png", mask(), Kind::Gray, "1 pixel = 2e-5 m (pixel-size)"),
        ("pack-1bit.tif", mask(), Kind::Binary, "1 pixel = 2e-5 m (pixel-size)"),
    ]
}

fn imported(name: &str, options: &Options) -> Imported {
    load(&file(name), options).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn porosity(spec: &GeometrySpec) -> f64 {
    Geometry::new(spec).unwrap().porosity().value
}

/// The discs by their centers, so that packs in another order can be compared.
fn discs(spec: &GeometrySpec) -> Vec<Disc> {
    let disc = |shape: &ShapeSpec| if let ShapeSpec::Disc(disc) = shape { Some(disc.clone()) } else { None };
    spec.shapes.iter().filter_map(disc).collect()
}

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
fn columns_are_picked_and_the_third_is_a_radius() {
    let radii = rows(&reference()["discs"]).into_iter().map(|row| [0, 1, 2].map(|i| number(&row[i])));
    let found = discs(&imported("pack-columns.csv", &columns()).spec);
    assert_eq!(found.len(), 60);
    for (disc, [x, y, radius]) in found.iter().zip(radii) {
        // The file lists diameters: taken for radii they are twice too large.
        let off = (disc.center[0] - x).hypot(disc.center[1] - y).max((0.5 * disc.radius - radius).abs());
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

/// The network between walls at the bottom and at the top, open on the left and on the right, and its pores.
fn channel(spec: &GeometrySpec) -> (Network, Pores) {
    let geometry = Geometry::new(spec).unwrap().with_wall_sides([false, false, true, true]);
    let network = extract(&geometry, [true, true, false, false]).unwrap();
    let pores = Pores::merged(&network, 0.95);
    (network, pores)
}

fn conditions(angle_deg: f64, shapes: usize, trapping: bool) -> Conditions {
    Conditions {
        angle: vec![angle_deg.to_radians(); shapes + 4],
        inlet: [true, false, false, false],
        outlet: [false, true, false, false],
        trapping,
        events: Events::All,
        largest_curvature: f64::INFINITY,
    }
}

/// Drainage at 40 degrees from left to right: saturation with the invading phase and applied curvature in 1/m after each event.
fn drainage(spec: &GeometrySpec, trapping: bool) -> (usize, usize, Vec<[f64; 2]>) {
    let (network, pores) = channel(spec);
    let mut state = Displacement::new(&network, &pores, conditions(40.0, spec.shapes.len(), trapping));
    let areas: Vec<f64> = state.elements().iter().map(|element| element.area).collect();
    let whole: f64 = areas.iter().sum();
    // What is open to the inlet is filled from the start.
    let is_filled = |&element: &usize| state.phase(element) == Phase::Invading;
    let mut filled: f64 = (0..areas.len()).filter(is_filled).map(|element| areas[element]).sum();
    let mut curve = vec![[filled / whole, 0.0]];
    for event in state.by_ref() {
        filled += event.elements.iter().map(|&element| areas[element]).sum::<f64>();
        curve.push([filled / whole, event.applied]);
    }
    (pores.area.len(), pores.throats.len(), curve)
}

/// The applied curvature at which a saturation is reached.
fn curvature_at(curve: &[[f64; 2]], saturation: f64) -> f64 {
    curve.iter().find(|point| point[0] >= saturation).map_or(f64::INFINITY, |point| point[1])
}

#[test]
fn every_route_leads_to_the_same_network_and_the_same_drainage() {
    let list = imported("pack.xyr", &in_box(Options::default(), PACK)).spec;
    let [expected, trapped] = [false, true].map(|trapping| drainage(&list, trapping));
    for (name, options, kind, _) in packs() {
        let spec = imported(name, &options).spec;
        for (trapping, (pores, throats, expected)) in [(false, &expected), (true, &trapped)] {
            let (found_pores, found_throats, curve) = drainage(&spec, trapping);
            let last = expected.last().unwrap()[0];
            let mut worst: f64 = 0.0;
            for saturation in (1..10).map(|i| 0.1 * f64::from(i)).filter(|s| *s < last) {
                // The curve has steps: an event may fill its element a little before or after the saturation that is asked for.
                let [low, high] = [-5e-3, 5e-3].map(|off| curvature_at(expected, saturation + off));
                let found = curvature_at(&curve, saturation);
                worst = worst.max(found / high - 1.0).max(1.0 - found / low);
            }
            println!(
                "{name:24} {found_pores} pores, {found_throats} throats, trapping {trapping}: pressure off by {worst:.1e}, end {:.4} of {last:.4}",
                curve.last().unwrap()[0]
            );
            if !trapping {
                assert!(worst < 0.01, "{name}: {worst:e}");
            }
            if kind == Kind::Exact {
                assert_eq!((found_pores, found_throats), (*pores, *throats), "{name}");
                assert!(worst < 1e-6, "{name}: {worst:e}");
            }
        }
    }
}

/// Network of the pack as in the reference: in a closed box, or periodic in both directions.
fn of_reference(periodic: bool) -> (Network, usize) {
    let spec = imported("pack.xyr", &in_box(Options::default(), PACK)).spec;
    let geometry = Geometry::new(&spec).unwrap();
    let geometry = if periodic { geometry.with_periodic([true; 2]) } else { geometry.with_wall_sides([true; 4]) };
    (extract(&geometry, [false; 4]).unwrap(), spec.shapes.len())
}

/// Distance of two points of the pack in m; through periodic sides where there are some.
fn distance(a: Vec2, b: Vec2, periodic: bool) -> f64 {
    let size = Vec2::from(PACK[1]);
    let gap =
        |i: usize| if periodic { (a[i] - b[i]) - size[i] * ((a[i] - b[i]) / size[i]).round() } else { a[i] - b[i] };
    gap(0).hypot(gap(1))
}

/// Index of the shape that a body of the reference is: discs, then the walls.
fn shape_of(body: &str) -> u32 {
    let wall = ["left", "right", "bottom", "top"].iter().position(|side| *side == body);
    wall.map_or_else(|| body.strip_prefix("disc-").unwrap().parse().unwrap(), |wall| 60 + wall as u32)
}

#[test]
fn the_network_is_that_of_a_brute_force_search() {
    let reference = reference();
    for (key, periodic) in [("closed", false), ("periodic", true)] {
        let (network, _) = of_reference(periodic);
        let expected = &reference[key];
        for row in rows(&expected["merged"]) {
            let pores = Pores::merged(&network, number(&row[0]));
            assert_eq!(
                [pores.area.len(), pores.throats.len()],
                [1, 2].map(|i| number(&row[i]) as usize),
                "{key} {row:?}"
            );
        }
        let pores = rows(&expected["pores"]);
        // The reference stops its iterations at 1e-12 m.
        let near = |row: &[Value], at: Vec2, length: f64| {
            let place = Vec2::new(number(&row[0]), number(&row[1]));
            distance(place, at, periodic) < 1e-9 && (number(&row[2]) - length).abs() < 1e-11
        };
        for row in &pores {
            let found = network.regions.iter().filter(|region| near(row, region.center, region.radius)).count();
            assert_eq!(found, 1, "{key}: the pore {row:?}");
        }
        let throats = rows(&expected["throats"]);
        for row in &throats {
            let middle = |k: usize| 0.5 * (network.throats[k].contacts[0] + network.throats[k].contacts[1]);
            let found: Vec<usize> =
                (0..network.throats.len()).filter(|&k| near(row, middle(k), network.throats[k].width)).collect();
            let [k] = found[..] else { panic!("{key}: {} throats for {row:?}", found.len()) };
            let mut bodies = [5, 6].map(|i| shape_of(row[i].as_str().unwrap()));
            let mut walls = network.throats[k].shapes;
            bodies.sort_unstable();
            walls.sort_unstable();
            assert_eq!(walls, bodies, "{key}: {row:?}");
            let joins = |end: usize| {
                let region = &network.regions[network.throats[k].regions[end]];
                [3, 4].map(|i| near(&pores[number(&row[i]) as usize], region.center, region.radius))
            };
            let (one, other) = (joins(0), joins(1));
            assert!((one[0] && other[1]) || (one[1] && other[0]), "{key}: the throat {row:?} joins other pores");
        }
        println!("{key}: {} pores, {} throats", pores.len(), throats.len());
    }
}

/// How far entry curvatures are off by those of the reference, for the throats and angles that are wanted: a share.
fn entries_off(wanted: impl Fn(bool, f64) -> bool) -> f64 {
    let (reference, mut worst) = (reference(), 0.0_f64);
    for (key, periodic) in [("closed", false), ("periodic", true)] {
        let (network, shapes) = of_reference(periodic);
        let pores = Pores::merged(&network, 1.0);
        for (angle, column) in [(40.0, 7), (120.0, 8)] {
            let conditions = Conditions { inlet: [false; 4], outlet: [false; 4], ..conditions(angle, shapes, false) };
            let entries = Displacement::new(&network, &pores, conditions).entry_curvatures(network.throats.len());
            for row in rows(&reference[key]["throats"]) {
                let meets_a_side = [5, 6].iter().any(|&i| shape_of(row[i].as_str().unwrap()) >= 60);
                if !wanted(meets_a_side, angle) {
                    continue;
                }
                let is_it = |throat: &Throat| {
                    let middle = 0.5 * (throat.contacts[0] + throat.contacts[1]);
                    distance(Vec2::new(number(&row[0]), number(&row[1])), middle, periodic) < 1e-9
                };
                let found = entries[network.throats.iter().position(is_it).unwrap()];
                assert!(found.is_finite(), "{key}: {row:?}");
                worst = worst.max((found / number(&row[column]) - 1.0).abs());
            }
        }
    }
    worst
}

#[test]
fn entry_curvatures_are_those_of_arcs_shot_from_wall_to_wall() {
    let worst = entries_off(|meets_a_side, angle| !meets_a_side || angle < 90.0);
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn entry_curvatures_at_sides_are_those_of_arcs_shot_from_wall_to_wall() {
    let worst = entries_off(|meets_a_side, angle| meets_a_side && angle > 90.0);
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn bursts_between_whole_walls_are_those_of_arcs_shot_from_wall_to_wall() {
    let reference = reference();
    let radius = |body: &Value| {
        let shape = shape_of(body.as_str().unwrap()) as usize;
        (shape < 60).then(|| number(&rows(&reference["discs"])[shape][2]))
    };
    let mut worst: f64 = 0.0;
    for row in rows(&reference["closed"]["throats"]) {
        let width = number(&row[2]);
        // A side comes second; the disc stands above it, on the left of the advance.
        let (above, below) = (radius(&row[5]).unwrap(), radius(&row[6]));
        for (angle, column) in [(40.0_f64.to_radians(), 7), (120.0_f64.to_radians(), 8)] {
            let left = Wall::of_disc(Vec2::new(0.0, width + above), above, angle, Vec2::zeros(), Hand::Left);
            let right = match below {
                Some(r) => Wall::of_disc(Vec2::new(0.0, -r), r, angle, Vec2::new(0.0, width), Hand::Right),
                None => {
                    // Far longer than the meniscus.
                    let [far, near] = [1.0, 0.0].map(|x| Vec2::new(x, 0.0));
                    let part = |a, b| WallPart { curve: Curve::Segment { a, b }, angle };
                    Wall { parts: vec![part(near, -far), part(far, near)], behind: 1 }
                }
            };
            let found = Passage::new(left, right).burst().unwrap().curvature;
            worst = worst.max((found / number(&row[column]) - 1.0).abs());
        }
    }
    println!("bursts off by {worst:.1e}");
    // The reference knows them to 1e-12.
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn the_area_of_the_pores_is_that_of_the_box_without_discs() {
    let discs: f64 = rows(&reference()["discs"]).iter().map(|row| PI * number(&row[2]).powi(2)).sum();
    for periodic in [false, true] {
        let (network, _) = of_reference(periodic);
        let area: f64 = network.regions.iter().map(|region| region.area).sum();
        // Sums of some hundred areas.
        assert!((area / (14e-3 * 9e-3 - discs) - 1.0).abs() < 1e-12);
    }
}

/// A damage: where it begins as a share of the file, what is written there, and how many bytes it replaces.
type Damage = (f64, Vec<u8>, usize);

/// Bytes at random, or words that readers may trip over.
fn damage() -> impl Strategy<Value = Vec<Damage>> {
    let words: Vec<Vec<u8>> = [
        "1e999",
        "-1",
        "NaN",
        "inf",
        "1000000000",
        "0",
        "1e-320",
        "\n",
        ",",
        "(",
        ")",
        "[[",
        "<g>",
        "/>",
        "\0",
        "\u{e9}",
    ]
    .map(|word| word.as_bytes().to_vec())
    .into();
    let written = prop_oneof![
        2 => proptest::sample::select(words),
        2 => proptest::collection::vec(any::<u8>(), 1..5),
        1 => Just(vec![0xff; 4]),
        1 => Just(vec![0x7f, 0xff, 0xff, 0xff]),
        1 => Just(Vec::new()),
    ];
    // The head of a file, which holds its counts, is hit as often as the rest.
    let place = prop_oneof![0.0..1.0_f64, 0.0..0.02_f64];
    proptest::collection::vec((place, written, prop_oneof![0_usize..6, 0_usize..200]), 1..5)
}

fn damaged(bytes: &[u8], damages: &[Damage]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for (place, written, replaced) in damages {
        let from = ((bytes.len() as f64 * place) as usize).min(bytes.len());
        let to = (from + replaced).min(bytes.len());
        bytes.splice(from..to, written.iter().copied());
    }
    bytes
}

/// Damaged copies of a file of tests/drawings are read or refused, each in less than a second of this thread.
fn survives_damage(name: &str, options: &Options) {
    let whole = std::fs::read(file(name)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let mut runner = TestRunner::new(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(512) });
    let slowest = Cell::new(0.0_f64);
    let outcome = runner.run(&damage(), |damages| {
        std::fs::write(&path, damaged(&whole, &damages)).unwrap();
        let clock = ThreadTime::now();
        let found = load(&path, options);
        let seconds = clock.elapsed().as_secs_f64();
        slowest.set(seconds.max(slowest.get()));
        prop_assert!(seconds < 1.0, "{seconds} s");
        if let Ok(found) = found {
            prop_assert!(found.spec.problems().is_empty());
        }
        Ok(())
    });
    println!("{name}: at most {:.0} ms", 1e3 * slowest.get());
    if let Err(error) = outcome {
        panic!("{name}: {error}");
    }
}

macro_rules! survive {
    ($($test:ident: $file:literal, $options:expr;)*) => {
        $(#[test]
        fn $test() {
            survives_damage($file, &$options);
        })*
    };
}

survive! {
    damaged_lists_are_read_or_refused: "pack.xyr", Options::default();
    damaged_columns_are_read_or_refused: "pack-columns.csv", columns();
    damaged_well_known_text_is_read_or_refused: "grains.wkt", unit("mm");
    damaged_geojson_is_read_or_refused: "grains.geojson", unit("mm");
    damaged_shapefiles_are_read_or_refused: "grains.shp", unit("mm");
    damaged_svg_is_read_or_refused: "pack-inkscape.svg", Options::default();
    damaged_svg_of_grains_is_read_or_refused: "grains.svg", in_box(Options::default(), GRAINS);
    damaged_dxf_is_read_or_refused: "grains.dxf", unit("mm");
    damaged_dxf_with_blocks_is_read_or_refused: "pack-blocks.dxf", unit("mm");
    damaged_dxf_with_splines_is_read_or_refused: "grains-splines.dxf", unit("mm");
    damaged_binary_dxf_is_read_or_refused: "pack-r2018-binary.dxf", unit("mm");
    damaged_png_masks_are_read_or_refused: "pack-grey.png", Options { pixel_size: Some(2e-5), ..Options::default() };
    damaged_tiff_masks_are_read_or_refused: "pack-1bit.tif", Options { pixel_size: Some(2e-5), ..Options::default() };
}
