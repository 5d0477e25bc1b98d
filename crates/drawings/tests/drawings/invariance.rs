//! Drawings that only differ in how they are written have one porosity: by every format, wherever a ring begins, whichever way it runs,
//! mirrored; and what is painted over another shape counts as it is seen.
//!
//! `MENISCUS_DRAWINGS=3000 cargo test --release --test drawings invariance -- --nocapture` tries so many drawings.

use std::fmt::Write;
use std::path::Path;

use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use shapefile::{Point, Polygon, PolygonRing, ShapeWriter};

use crate::contents::porosity;

/// Drawings in CI.
const FEW: usize = 40;
/// Side of the box of a grain, and of the drawing, in units of the drawing.
const BOX: i64 = 100;
const BOXES: i64 = 3;

type Ring = Vec<[i64; 2]>;

/// A grain: its outer ring first, then holes; and the islands in these.
struct Grain {
    rings: Vec<Ring>,
    islands: Vec<Ring>,
}

struct Random(u64);

impl Random {
    fn below(&mut self, end: i64) -> i64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as i64).rem_euclid(end)
    }
}

/// Twice the area, exact in whole numbers.
fn twice_area(ring: &Ring) -> i64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

/// A star around a place.
fn star(random: &mut Random, [x, y]: [i64; 2], reach: i64) -> Ring {
    let count = 5 + random.below(6);
    (0..count)
        .map(|k| {
            let angle = std::f64::consts::TAU * (k as f64 + 0.4 * random.below(100) as f64 / 100.0) / count as f64;
            let far = (0.6 + 0.4 * random.below(100) as f64 / 100.0) * reach as f64;
            [x + (far * angle.cos()).round() as i64, y + (far * angle.sin()).round() as i64]
        })
        .collect()
}

/// A grain in the box around a place: a star; one with a hole, which may touch it at a corner; one with an island in the hole.
fn grain(random: &mut Random, [x, y]: [i64; 2]) -> Grain {
    let outer = star(random, [x, y], 46);
    let tip = outer[random.below(outer.len() as i64) as usize];
    let (hole, islands) = match random.below(4) {
        0 => (None, Vec::new()),
        // A narrow triangle from the middle to a corner.
        1 => (Some(vec![tip, [x + 3 * (y - tip[1]) / 20, y + 3 * (tip[0] - x) / 20], [x, y]]), Vec::new()),
        2 => (Some(star(random, [x, y], 14)), vec![vec![[x - 2, y - 2], [x + 3, y - 1], [x, y + 3]]]),
        _ => (Some(star(random, [x, y], 14)), Vec::new()),
    };
    Grain { rings: std::iter::once(outer).chain(hole).collect(), islands }
}

/// The drawing written differently: rings begin elsewhere and run the other way, x and y are mirrored or exchanged.
fn rewritten(random: &mut Random, grains: &[Grain], mirror: i64) -> Vec<Grain> {
    let side = BOX * BOXES;
    let mut ring = |ring: &Ring| {
        let mut ring: Ring = ring
            .iter()
            .map(|&[x, y]| {
                let x = if mirror & 1 == 1 { side - x } else { x };
                if mirror & 2 == 2 { [y, x] } else { [x, y] }
            })
            .collect();
        let start = random.below(ring.len() as i64) as usize;
        ring.rotate_left(start);
        if random.below(2) == 1 {
            ring.reverse();
        }
        ring
    };
    let mut each = |rings: &[Ring]| rings.iter().map(&mut ring).collect::<Vec<_>>();
    grains.iter().map(|grain| Grain { rings: each(&grain.rings), islands: each(&grain.islands) }).collect()
}

fn closed(ring: &Ring) -> Ring {
    ring.iter().chain(ring.first()).copied().collect()
}

fn points(ring: &Ring, between: &str) -> String {
    ring.iter().map(|[x, y]| format!("{x} {y}")).collect::<Vec<_>>().join(between)
}

/// Polygons of a grain: itself with its holes, and its islands.
fn polygons(grain: &Grain) -> impl Iterator<Item = Vec<Ring>> + '_ {
    std::iter::once(grain.rings.clone()).chain(grain.islands.iter().map(|island| vec![island.clone()]))
}

fn write(path: &Path, grains: &[Grain]) {
    let all = grains.iter().flat_map(polygons);
    let mut text = String::new();
    match path.extension().unwrap().to_str().unwrap() {
        "wkt" => {
            for rings in all {
                let rings: Vec<String> = rings.iter().map(|r| format!("({})", points(&closed(r), ", "))).collect();
                let _ = writeln!(text, "POLYGON ({})", rings.join(", "));
            }
        }
        "geojson" => {
            let coordinates: Vec<Vec<Ring>> = all.map(|rings| rings.iter().map(closed).collect()).collect();
            text = serde_json::json!({"type": "MultiPolygon", "coordinates": coordinates}).to_string();
        }
        "svg" => {
            let side = BOX * BOXES;
            let _ = write!(text, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {side} {side}'>");
            for grain in grains {
                let data: String =
                    grain.rings.iter().chain(&grain.islands).map(|r| format!("M{}Z", points(r, " "))).collect();
                let _ = write!(text, "<path fill-rule='evenodd' d='{data}'/>");
            }
            text += "</svg>";
        }
        "dxf" => {
            text = "0\nSECTION\n2\nENTITIES\n".to_owned();
            for ring in grains.iter().flat_map(|grain| grain.rings.iter().chain(&grain.islands)) {
                let _ = write!(text, "0\nLWPOLYLINE\n8\n0\n90\n{}\n70\n1\n", ring.len());
                ring.iter().for_each(|[x, y]| {
                    let _ = write!(text, "10\n{x}\n20\n{y}\n");
                });
            }
            text += "0\nENDSEC\n0\nEOF\n";
        }
        _ => {
            let mut bytes = std::io::Cursor::new(Vec::new());
            let mut writer = ShapeWriter::new(&mut bytes);
            for grain in grains {
                let ring = |r: &Ring| {
                    PolygonRing::Outer(closed(r).iter().map(|&[x, y]| Point::new(x as f64, y as f64)).collect())
                };
                let rings = grain.rings.iter().chain(&grain.islands).map(ring).collect();
                writer.write_shape(&Polygon::with_rings(rings)).unwrap();
            }
            writer.finalize().unwrap();
            drop(writer);
            return std::fs::write(path, bytes.into_inner()).unwrap();
        }
    }
    std::fs::write(path, text).unwrap();
}

/// The drawing as it is, polygons with corners, in um.
fn options() -> Options {
    let side = (BOX * BOXES) as f64 * 1e-6;
    Options {
        unit: Some("um".into()),
        window: Some([[0.0; 2], [side; 2]]),
        recognize_circles: Some(false),
        smooth_below_deg: Some(0.0),
        ..Options::default()
    }
}

fn drawings() -> usize {
    std::env::var("MENISCUS_DRAWINGS").map_or(FEW, |text| text.parse().unwrap())
}

#[test]
fn the_porosity_does_not_depend_on_how_a_drawing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let (mut inputs, mut failed) = (0, 0);
    for number in 0..drawings() {
        let mut random = Random(number as u64);
        let places = (0..BOXES).flat_map(|i| (0..BOXES).map(move |j| [BOX * i + BOX / 2, BOX * j + BOX / 2]));
        let grains: Vec<Grain> = places.map(|place| grain(&mut random, place)).collect();
        let area = |grain: &Grain| {
            let of = |ring: &Ring| twice_area(ring).abs();
            of(&grain.rings[0]) - grain.rings[1..].iter().map(of).sum::<i64>()
                + grain.islands.iter().map(of).sum::<i64>()
        };
        let side = (BOX * BOXES) as f64;
        let right = 1.0 - 0.5 * grains.iter().map(area).sum::<i64>() as f64 / (side * side);
        for ending in ["wkt", "geojson", "svg", "dxf", "shp"] {
            let path = folder.path().join(format!("a.{ending}"));
            let mirror = random.below(4);
            write(&path, &rewritten(&mut random, &grains, mirror));
            inputs += 1;
            match load(&path, &options()).map(|read| porosity(&read.spec)) {
                Ok(found) if (found - right).abs() < 1e-9 => {}
                other => {
                    failed += 1;
                    println!("drawing {number}, {ending}, mirror {mirror}: {other:?} for {right}");
                }
            }
        }
    }
    println!("{inputs} inputs, {failed} failed");
    assert_eq!(failed, 0);
}

#[test]
fn what_is_painted_white_is_pore_in_the_order_of_painting() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.svg");
    let (mut inputs, mut failed) = (0, 0);
    for number in 0..drawings() {
        let mut random = Random(7_000_000 + number as u64);
        const SIDE: i64 = 12;
        let mut cells = vec![false; (SIDE * SIDE) as usize];
        let mut text = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {SIDE} {SIDE}'>");
        // Black and white bars, the last one black so that there is a solid.
        for k in 0..8 {
            let is_black = k == 0 || k == 7 || random.below(2) == 1;
            let [w, h] = [1 + random.below(SIDE - 2), 1 + random.below(SIDE - 2)];
            let [x, y] = [random.below(SIDE - w), random.below(SIDE - h)];
            (x..x + w)
                .flat_map(|i| (y..y + h).map(move |j| (i, j)))
                .for_each(|(i, j)| cells[(j * SIDE + i) as usize] = is_black);
            let fill = if is_black { "#000" } else { "white" };
            let _ = write!(text, "<rect x='{x}' y='{y}' width='{w}' height='{h}' fill='{fill}'/>");
        }
        std::fs::write(&path, text + "</svg>").unwrap();
        let right = cells.iter().filter(|solid| !**solid).count() as f64 / (SIDE * SIDE) as f64;
        let plain = Options { window: None, ..options() };
        inputs += 1;
        match load(&path, &plain).map(|read| porosity(&read.spec)) {
            Ok(found) if (found - right).abs() < 1e-9 => {}
            other => {
                failed += 1;
                println!("painting {number}: {other:?} for {right}");
            }
        }
    }
    println!("{inputs} paintings, {failed} failed");
    assert_eq!(failed, 0);
}
