//! A mask and its images, mirrored and turned, have one network and one displacement.
//!
//! `MENISCUS_MASKS=1000 cargo test --release --test network mask_images -- --nocapture` tries so many masks.

use image::{GrayImage, ImageFormat, Luma, imageops};
use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use meniscus_geometry::spec::GeometrySpec;
use rayon::prelude::*;

use crate::drawings::contents::imported;
use crate::kinds_of_networks::drained_from;

/// Masks in CI.
const FEW: u64 = 24;

/// The equations of a smooth wall lose up to eight digits: 16 times the fourth power of the length in points over which noise is averaged.
const ROUNDING: f64 = 1e-8;

/// Left, right, bottom and top.
const SIDES: [&str; 4] = ["left", "right", "bottom", "top"];

/// An image of a mask.
type Moved = fn(&GrayImage) -> GrayImage;

/// The images of an upright mask: what is done to its pixels, and where its left and right sides lie then.
const IMAGES: [(Moved, [usize; 2]); 7] = [
    (imageops::flip_horizontal, [1, 0]),
    (imageops::flip_vertical, [0, 1]),
    (imageops::rotate180, [1, 0]),
    (imageops::rotate90, [3, 2]),
    (imageops::rotate270, [2, 3]),
    (transposed, [3, 2]),
    (anti_transposed, [2, 3]),
];

fn transposed(image: &GrayImage) -> GrayImage {
    imageops::flip_horizontal(&imageops::rotate90(image))
}

fn anti_transposed(image: &GrayImage) -> GrayImage {
    imageops::flip_vertical(&imageops::rotate90(image))
}

/// A mask of its own for each number: blobs of noise or discs, in gray, black and white, or symmetric about its middle.
fn mask(number: u64) -> GrayImage {
    let mut state = number.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let size = [0, 1].map(|_| 40 + (30.0 * random()) as u32);
    let waves: Vec<[f64; 4]> = (0..40).map(|_| [0.0; 4].map(|_| random())).collect();
    let reach = 0.25 + 0.5 * random();
    let level = 0.1 + 0.2 * random();
    let is_gray = number.is_multiple_of(2);
    let has_discs = number.is_multiple_of(3);
    let is_symmetric = number.is_multiple_of(5);
    let value = |x: f64, y: f64| {
        if has_discs {
            let depth = |w: &[f64; 4]| {
                let center = [w[0] * f64::from(size[0]), w[1] * f64::from(size[1])];
                3.0 + 3.0 * w[2] - (x - center[0]).hypot(y - center[1])
            };
            return 0.5 + waves[..16].iter().map(depth).fold(f64::NEG_INFINITY, f64::max);
        }
        let wave = |w: &[f64; 4]| (reach * ((2.0 * w[0] - 1.0) * x + (2.0 * w[1] - 1.0) * y) + 6.3 * w[2]).sin();
        0.5 + 0.5 * (waves.iter().map(wave).sum::<f64>() / 4.0 - level)
    };
    GrayImage::from_fn(size[0], size[1], |column, row| {
        let column = if is_symmetric { column.min(size[0] - 1 - column) } else { column };
        let solid = value(f64::from(column) + 0.5, f64::from(row) + 0.5).clamp(0.0, 1.0);
        let solid = if is_gray { solid } else { solid.round() };
        Luma([(255.0 * (1.0 - solid)).round() as u8])
    })
}

fn read(image: &GrayImage) -> Result<GeometrySpec, String> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mask.png");
    image.save_with_format(&file, ImageFormat::Png).unwrap();
    let options = Options { pixel_size: Some(1e-6), ..Options::default() };
    load(&file, &options).map(|read| read.spec).map_err(|error| error.to_string())
}

/// What differs in an image of a mask: as read, and as drained.
fn difference(number: u64) -> Option<String> {
    let image = mask(number);
    let angle_deg = [0.0, 5.0, 20.0, 40.0, 60.0, 120.0][(number % 6) as usize];
    let drained = |image: &GrayImage, sides: [usize; 2]| {
        let spec = read(image)?;
        let porosity = meniscus_geometry::Geometry::new(&spec).map_err(|error| format!("{error:?}"))?.porosity().value;
        let name = format!("mask {number}, {} to {}", SIDES[sides[0]], SIDES[sides[1]]);
        let [breakthrough, last, left] = drained_from(&name, &spec, sides, angle_deg, true);
        Ok::<_, String>([porosity, breakthrough, last, left])
    };
    let upright = drained(&image, [0, 1]);
    IMAGES.iter().find_map(|(moved, sides)| match (&upright, drained(&moved(&image), *sides)) {
        (Ok(a), Ok(b)) => {
            let is_near = |a: f64, b: f64| a == b || (a - b).abs() <= ROUNDING * (1.0 + a.abs());
            let is_same = a.iter().zip(b).all(|(&a, b)| is_near(a, b));
            (!is_same).then(|| format!("mask {number} at {angle_deg} degrees to {}: {a:?} {b:?}", SIDES[sides[0]]))
        }
        (Err(_), Err(_)) => None,
        (a, b) => Some(format!("mask {number} to {}: {a:?} {b:?}", SIDES[sides[0]])),
    })
}

#[test]
fn generated_masks_drain_like_their_images() {
    let count = std::env::var("MENISCUS_MASKS").ok().and_then(|count| count.parse().ok()).unwrap_or(FEW);
    let found: Vec<String> = (0..count).into_par_iter().filter_map(difference).collect();
    println!("{count} masks, {} failed", found.len());
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn a_mask_of_blobs_drains_like_its_mirror_image_and_its_transpose() {
    let options = Options { pixel_size: Some(1e-6), ..Options::default() };
    let spec = |name: &str| imported(&format!("kinds/mask-{name}.png"), &options).spec;
    let upright = drained_from("mask-a.png", &spec("a"), [0, 1], 45.0, true);
    for (name, sides) in [("mirrored", [1, 0]), ("transposed", [3, 2])] {
        let found = drained_from(name, &spec(name), sides, 45.0, true);
        let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-9 * a.abs();
        assert!(upright.iter().zip(&found).all(is_near), "{name}: {upright:?} {found:?}");
    }
}
