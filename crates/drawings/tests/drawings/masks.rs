//! Masks: areas, radii and centers of drawn discs, walls of polygons, edges of the image, pixel formats, and files that are refused.

use std::f64::consts::{PI, TAU};
use std::io::Cursor;

use image::{DynamicImage, GrayImage, ImageFormat, Luma};
use meniscus_core::math::Vec2;
use meniscus_drawings::import::Options;
use meniscus_drawings::import::drawing::{Drawing, Outline, Ring};
use meniscus_drawings::import::mask::read;
use meniscus_geometry::curve::Curve;
use tiff::encoder::{TiffEncoder, colortype};

/// What is written into a TIFF file.
type Encoded<'a> = &'a dyn Fn(&mut TiffEncoder<&mut Cursor<Vec<u8>>>);

/// A gray image whose pixels are covered by the solid as `is_solid` says, sampled `fine` x `fine` times: 1 draws black and white.
/// y runs up; solid is black.
fn drawn([width, height]: [u32; 2], fine: u32, is_solid: impl Fn(Vec2) -> bool) -> GrayImage {
    GrayImage::from_fn(width, height, |column, row| {
        let corner = Vec2::new(f64::from(column), f64::from(height - 1 - row));
        let samples = (0..fine * fine).filter(|k| {
            let [i, j] = [k % fine, k / fine].map(|k| (f64::from(k) + 0.5) / f64::from(fine));
            is_solid(corner + Vec2::new(i, j))
        });
        let share = samples.count() as f64 / f64::from(fine * fine);
        Luma([(255.0 * (1.0 - share)).round() as u8])
    })
}

fn png(image: &DynamicImage) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

fn read_gray(image: &GrayImage) -> Drawing {
    read(&png(&DynamicImage::ImageLuma8(image.clone())), &Options::default()).unwrap()
}

fn curves(ring: &Ring) -> Vec<Curve> {
    let vertices = &ring.vertices;
    let at = |i: usize| Vec2::new(vertices[i % vertices.len()][0], vertices[i % vertices.len()][1]);
    (0..vertices.len())
        .filter(|&i| at(i) != at(i + 1))
        .map(|i| Curve::from_bulge(at(i), at(i + 1), vertices[i][2]))
        .collect()
}

fn area(ring: &Ring) -> f64 {
    curves(ring).iter().map(|curve| curve.area_about(Vec2::zeros())).sum()
}

fn distance(ring: &Ring, x: Vec2) -> f64 {
    curves(ring).iter().map(|curve| (curve.project(x).point - x).norm()).fold(f64::INFINITY, f64::min)
}

fn only_ring(drawing: &Drawing) -> &Ring {
    let Outline::Area { rings, .. } = &drawing.entities[0].outline else { panic!("a disc") };
    assert_eq!((drawing.entities.len(), rings.len()), (1, 1));
    &rings[0]
}

#[test]
fn drawn_discs_come_back_with_their_area_radius_and_center() {
    println!("image   radius  area error  radius error (px)  center error (px), largest of 20 places");
    for (kind, fine) in [("binary", 1), ("gray", 16)] {
        for radius in [5.0, 10.0, 15.0, 20.0, 40.0] {
            let (mut sum, mut most_area, mut most_radius, mut most_center) = (0.0, 0.0_f64, 0.0_f64, 0.0_f64);
            for k in 0..20 {
                // Centers spread over a pixel by the golden ratio.
                let shift = Vec2::new((0.618 * f64::from(k)).fract(), (0.755 * f64::from(k)).fract());
                let center = Vec2::repeat(radius + 4.0) + shift;
                let side = (2.0 * radius) as u32 + 10;
                let drawing = read_gray(&drawn([side; 2], fine, |x| (x - center).norm() < radius));
                let [entity] = &drawing.entities[..] else { panic!("{} shapes", drawing.entities.len()) };
                let Outline::Disc { center: found, radius: r } = entity.outline else {
                    panic!("{kind} disc of radius {radius} at {center:?} was not recognized")
                };
                sum += r * r / (radius * radius) - 1.0;
                most_area = most_area.max((r * r / (radius * radius) - 1.0).abs());
                most_radius = most_radius.max((r - radius).abs());
                most_center = most_center.max((found - center).norm());
            }
            println!(
                "{kind:6}  {radius:4}  {:8.4} %  {most_radius:8.4}  {most_center:8.4} (mean area error {:8.4} %)",
                100.0 * most_area,
                5.0 * sum
            );
            // A black and white disc is known by its number of pixels, which scatters by some of those on its rim (Gauss's circle
            // problem); partly covered pixels tell the area to their 256 steps.
            let bound = if fine > 1 { 1e-3 } else { 2.5 * radius.sqrt() / (PI * radius * radius) };
            if radius >= 15.0 {
                assert!((sum / 20.0).abs() < 1e-3, "mean area error {}", sum / 20.0);
                assert!(most_area < bound, "{most_area}");
            }
            // Half-pixel steps averaged over the rim.
            let bound = if fine > 1 { 0.05 } else { 0.55 / radius.sqrt() };
            assert!(most_center < bound, "{most_center}");
        }
    }
}

#[test]
fn walls_of_polygons_are_smooth_and_keep_their_area_and_nearly_their_corners() {
    let (sin, cos) = 0.3_f64.sin_cos();
    let (half, middle) = (30.0, Vec2::new(50.3, 49.8));
    let turned =
        |x: Vec2| Vec2::new(cos * (x - middle).x + sin * (x - middle).y, cos * (x - middle).y - sin * (x - middle).x);
    for (fine, roughness, corner) in [(1, 0.25, 2.0), (16, 0.1, 1.2)] {
        let drawing = read_gray(&drawn([100; 2], fine, |x| turned(x).amax() < half));
        let ring = only_ring(&drawing);
        // The pixels of a square of 60 x 60, give or take those of its rim.
        assert!((area(ring) / (4.0 * half * half) - 1.0).abs() < 2e-3, "{}", area(ring));
        for (side, along) in (0..4).flat_map(|side| (-20..=20).map(move |along| (side, f64::from(along)))) {
            let (s, c) = (TAU / 4.0 * f64::from(side) + 0.3).sin_cos();
            let x = middle + Vec2::new(c * half - s * along, s * half + c * along);
            assert!(distance(ring, x) < roughness, "{fine} {side} {along} {}", distance(ring, x));
        }
        let farthest = distance(ring, middle + Vec2::new((cos - sin) * half, (cos + sin) * half));
        assert!(farthest < corner, "{fine} corner {farthest}");
        assert!(ring.vertices.len() < 120, "{fine} {} arcs", ring.vertices.len());
    }
}

#[test]
fn an_ellipse_and_a_square_are_no_discs() {
    for fine in [1, 16] {
        for grain in [|x: Vec2| x.x.hypot(x.y / 0.9) < 20.0, |x: Vec2| x.amax() < 12.0, |x: Vec2| x.abs().sum() < 16.0]
        {
            let drawing = read_gray(&drawn([60; 2], fine, |x| grain(x - Vec2::new(30.3, 29.6))));
            assert!(matches!(drawing.entities[0].outline, Outline::Area { .. }), "{fine}");
        }
    }
}

#[test]
fn grains_that_leave_the_image_go_straight_on() {
    // A disc across the left side, a bar from bottom to top, a quarter disc in the upper right corner, a disc apart.
    let is_solid = |x: Vec2| {
        (x - Vec2::new(4.0, 40.0)).norm() < 20.0
            || (x.x - 50.0).abs() < 8.0
            || (x - Vec2::new(120.0, 100.0)).norm() < 25.0
            || (x - Vec2::new(85.0, 40.0)).norm() < 15.0
    };
    let drawing = read_gray(&drawn([120, 100], 16, is_solid));
    assert_eq!(drawing.entities.len(), 4);
    let frame = drawing.frame.unwrap();
    assert_eq!((frame.min, frame.max), (Vec2::zeros(), Vec2::new(120.0, 100.0)));
    let rings: Vec<&Ring> = drawing
        .entities
        .iter()
        .filter_map(|e| if let Outline::Area { rings, .. } = &e.outline { Some(&rings[0]) } else { None })
        .collect();
    assert_eq!(rings.len(), 3);
    let inside = |x: Vec2| rings.iter().any(|ring| curves(ring).iter().map(|c| c.winding(x)).sum::<f64>() > PI);
    for (x, y) in [(2.0, 40.0), (-30.0, 40.0), (50.0, 2.0), (50.0, -40.0), (50.0, 140.0), (119.0, 99.0), (140.0, 120.0)]
    {
        assert!(inside(Vec2::new(x, y)), "({x}, {y}) is solid");
    }
    for (x, y) in [(2.0, 10.0), (-30.0, 10.0), (-30.0, 70.0), (30.0, -40.0), (70.0, 140.0), (140.0, 60.0), (90.0, 99.0)]
    {
        assert!(!inside(Vec2::new(x, y)), "({x}, {y}) is pore");
    }
    // The wall is where it should be up to the edge, and the wall outside runs straight from there.
    let edge = Vec2::new(0.0, 40.0 + (400.0_f64 - 16.0).sqrt());
    let nearest = rings.iter().map(|ring| distance(ring, edge)).fold(f64::INFINITY, f64::min);
    // The last half pixel is drawn on along the tangent of a wall that is smooth to .1 pixels and meets the edge at 12 degrees.
    assert!(nearest < 0.4, "{nearest}");
    assert!(rings.iter().map(|ring| distance(ring, edge - Vec2::new(20.0, 0.0))).fold(f64::INFINITY, f64::min) < 0.4);
}

#[test]
fn holes_belong_to_their_grain_and_islands_stand_alone() {
    // A ring around an island, and a plate from side to side with two holes.
    let is_solid = |x: Vec2| {
        let r = (x - Vec2::new(50.0, 70.0)).norm();
        (r > 15.0 && r < 25.0)
            || r < 6.0
            || (x.y < 35.0 && (x - Vec2::new(25.0, 18.0)).norm() > 8.0 && (x - Vec2::new(70.0, 18.0)).norm() > 9.0)
    };
    for fine in [1, 8] {
        let drawing = read_gray(&drawn([100; 2], fine, is_solid));
        let rings = |k: usize| match &drawing.entities[k].outline {
            Outline::Disc { .. } => 0,
            Outline::Area { rings, .. } => rings.len(),
        };
        let mut counts: Vec<usize> = (0..drawing.entities.len()).map(rings).collect();
        counts.sort_unstable();
        assert_eq!(counts, [0, 2, 3]);
    }
}

#[test]
fn white_and_black_change_places_and_a_note_tells_the_share() {
    let image = drawn([40; 2], 1, |x| (x - Vec2::repeat(20.0)).norm() < 10.0);
    let bytes = png(&DynamicImage::ImageLuma8(image.clone()));
    let drawing = read(&bytes, &Options { invert: Some(true), pixel_size: Some(2e-6), ..Options::default() }).unwrap();
    let Outline::Area { rings, .. } = &drawing.entities[0].outline else { panic!() };
    assert_eq!(rings.len(), 2, "all around the disc is solid");
    assert_eq!(drawing.unit.as_ref().map(|unit| unit.meters), Some(2e-6));
    let dark = image.pixels().filter(|p| p[0] == 0).count();
    let share = format!("{:.2} %", 100.0 - 100.0 * dark as f64 / 1600.0);
    assert!(drawing.notes[0].contains(&share), "{:?}", drawing.notes);
}

#[test]
fn specks_are_dropped_and_counted() {
    let drawing =
        read_gray(&drawn([40; 2], 1, |x| (x - Vec2::repeat(20.0)).norm() < 8.0 || x.amax() < 3.0 && x.amin() > 1.0));
    assert_eq!((drawing.entities.len(), drawing.unused.values().sum::<usize>()), (1, 1));
}

/// One disc in every pixel format gives one drawing.
#[test]
fn all_pixel_formats_give_the_same_disc() {
    let image = drawn([40, 36], 1, |x| (x - Vec2::new(18.0, 17.5)).norm() < 12.0);
    let eight = DynamicImage::ImageLuma8(image.clone());
    let binary: Vec<u8> = image
        .rows()
        .flat_map(|row| {
            let bits: Vec<bool> = row.map(|p| p[0] > 0).collect();
            bits.chunks(8)
                .map(|c| c.iter().enumerate().map(|(k, &b)| u8::from(b) << (7 - k)).sum::<u8>())
                .collect::<Vec<_>>()
        })
        .collect();
    let floats: Vec<f32> = image.pixels().map(|p| f32::from(p[0]) / 255.0).collect();
    let mut rgba = eight.to_rgba8();
    // Black on a transparent ground, as drawing programs write it.
    rgba.pixels_mut().filter(|p| p[0] > 0).for_each(|p| p.0 = [0, 0, 0, 0]);
    let tiff = |write: Encoded<'_>| {
        let mut bytes = Cursor::new(Vec::new());
        write(&mut TiffEncoder::new(&mut bytes).unwrap());
        bytes.into_inner()
    };
    let sixteen: Vec<u16> = image.pixels().map(|p| u16::from(p[0]) * 257).collect();
    let files = [
        ("8 bit", png(&eight)),
        ("16 bit", png(&DynamicImage::ImageLuma16(eight.to_luma16()))),
        ("RGB", png(&DynamicImage::ImageRgb8(eight.to_rgb8()))),
        ("gray and alpha", png(&DynamicImage::ImageLumaA8(eight.to_luma_alpha8()))),
        ("transparent", png(&DynamicImage::ImageRgba8(rgba))),
        ("TIFF 8 bit", tiff(&|t| t.write_image::<colortype::Gray8>(40, 36, image.as_raw()).unwrap())),
        ("TIFF 16 bit", tiff(&|t| t.write_image::<colortype::Gray16>(40, 36, &sixteen).unwrap())),
        ("TIFF float", tiff(&|t| t.write_image::<colortype::Gray32Float>(40, 36, &floats).unwrap())),
        ("TIFF 1 bit", bilevel_tiff(40, 36, &binary)),
    ];
    let expected = read_gray(&image).entities;
    assert!(matches!(expected[0].outline, Outline::Disc { .. }));
    for (name, bytes) in files {
        assert_eq!(read(&bytes, &Options::default()).unwrap().entities, expected, "{name}");
    }
}

/// A TIFF file of one strip of 1-bit samples, 1 white, written by hand.
fn bilevel_tiff(width: u32, height: u32, data: &[u8]) -> Vec<u8> {
    let entries: [(u16, u16, u32); 8] = [
        (256, 4, width),
        (257, 4, height),
        (258, 3, 1),
        (259, 3, 1),
        (262, 3, 1),
        (273, 4, 8 + 2 + 8 * 12 + 4),
        (278, 4, height),
        (279, 4, data.len() as u32),
    ];
    let mut bytes = b"II*\0\x08\0\0\0".to_vec();
    bytes.extend((entries.len() as u16).to_le_bytes());
    for (tag, kind, value) in entries {
        bytes.extend(tag.to_le_bytes());
        bytes.extend(kind.to_le_bytes());
        bytes.extend(1_u32.to_le_bytes());
        bytes.extend(value.to_le_bytes());
    }
    bytes.extend([0; 4]);
    bytes.extend(data);
    bytes
}

#[test]
fn what_is_no_mask_is_refused_with_a_way_out() {
    let stack = {
        let mut bytes = Cursor::new(Vec::new());
        let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
        for _ in 0..2 {
            encoder.write_image::<colortype::Gray8>(8, 8, &[0; 64]).unwrap();
        }
        bytes.into_inner()
    };
    // A header that declares 1e9 pixels, and no data.
    let bomb = bilevel_tiff(32_000, 32_000, &[]);
    let plain = png(&DynamicImage::ImageLuma8(GrayImage::from_pixel(20, 20, Luma([30]))));
    let half = png(&DynamicImage::ImageLuma8(drawn([40; 2], 1, |x| x.x < 20.0)));
    for (bytes, wanted) in [
        (&b"<svg/>"[..], "neither PNG nor TIFF"),
        (&stack, "a stack of images"),
        (&bomb, "32000 x 32000 pixels"),
        (&plain, "all on one side of the threshold"),
        (&half[..half.len() / 2], "a complete PNG file"),
    ] {
        let refusals = read(bytes, &Options::default()).unwrap_err();
        assert!(refusals[0].to_string().contains(wanted), "{}", refusals[0]);
    }
    let options = Options { threshold: Some(1.5), ..Options::default() };
    assert_eq!(read(&half, &options).unwrap_err()[0].location, "threshold");
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(300))]
    #[test]
    fn changed_bytes_give_a_drawing_or_a_message(changes in proptest::collection::vec((0_usize..400, 0_u8..=255), 1..6), is_tiff: bool) {
        let image = drawn([24, 20], 1, |x| (x - Vec2::new(12.0, 10.0)).norm() < 7.0);
        let mut bytes = if is_tiff {
            bilevel_tiff(24, 20, &[0x3c; 60])
        } else {
            png(&DynamicImage::ImageLuma8(image))
        };
        let count = bytes.len();
        changes.iter().for_each(|&(at, value)| bytes[at % count] = value);
        if let Err(refusals) = read(&bytes, &Options::default()) {
            proptest::prop_assert!(!refusals.is_empty());
        }
    }
}
