//! Masks of noise: every contour is accepted, and the porosity of black and white ones is that of their pixels.
//!
//! `MENISCUS_MASKS=60 cargo test --release --test drawings noise -- --nocapture` tries so many images of each kind.

use std::io::Cursor;

use image::{DynamicImage, GrayImage, ImageFormat, Luma};
use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use meniscus_geometry::Geometry;

/// Pixels along a side.
const SIDE: usize = 50;
/// Grains and holes below so many pixels are specks, which are left out.
const SPECK: usize = 12;
/// Images of each kind in CI.
const FEW: usize = 6;

/// Noise smoothed by a Gaussian of `sigma` pixels, from side to side, between about -1 and 1.
fn noise(seed: usize, sigma: f64) -> Vec<f64> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(seed as u64 + 1);
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    let field: Vec<f64> = (0..SIDE * SIDE).map(|_| random()).collect();
    let reach = (4.0 * sigma).ceil() as usize;
    let weight = |d: usize| (-0.5 * (d as f64 / sigma).powi(2)).exp();
    let along = |field: &[f64], step: usize, other: usize| -> Vec<f64> {
        let at = |k: usize| (k / step % SIDE, k / other % SIDE);
        (0..SIDE * SIDE)
            .map(|k| {
                let (i, j) = at(k);
                let near = (0..=2 * reach).map(|d| {
                    let moved = (i + SIDE * 8 + d - reach) % SIDE;
                    weight(d.abs_diff(reach)) * field[moved * step + j * other]
                });
                near.sum()
            })
            .collect()
    };
    let smooth = along(&along(&field, 1, SIDE), SIDE, 1);
    let most = smooth.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
    smooth.into_iter().map(|v| v / most).collect()
}

/// The image with specks filled: solid pixels hold together across corners, those of the pore do not.
fn without_specks(solid: &[bool]) -> Vec<bool> {
    let mut filled = solid.to_vec();
    let mut seen = vec![false; solid.len()];
    for start in 0..solid.len() {
        if seen[start] {
            continue;
        }
        let (mut stack, mut part, mut touches) = (vec![start], Vec::new(), false);
        seen[start] = true;
        while let Some(at) = stack.pop() {
            part.push(at);
            let (x, y) = (at % SIDE, at / SIDE);
            touches |= x == 0 || y == 0 || x + 1 == SIDE || y + 1 == SIDE;
            for (dx, dy) in (-1_isize..=1).flat_map(|dx| (-1_isize..=1).map(move |dy| (dx, dy))) {
                let (Some(u), Some(v)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else { continue };
                let is_near = solid[start] || dx == 0 || dy == 0;
                if u < SIDE && v < SIDE && is_near && !seen[v * SIDE + u] && solid[v * SIDE + u] == solid[start] {
                    seen[v * SIDE + u] = true;
                    stack.push(v * SIDE + u);
                }
            }
        }
        if part.len() < SPECK && !touches {
            part.into_iter().for_each(|at| filled[at] = !solid[start]);
        }
    }
    filled
}

#[test]
fn noise_is_read_with_the_porosity_of_its_pixels() {
    let images = std::env::var("MENISCUS_MASKS").map_or(FEW, |text| text.parse().unwrap());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("noise.png");
    let options = Options { pixel_size: Some(1e-6), ..Options::default() };
    let (mut inputs, mut refused, mut rough, mut worst) = (0, 0, 0, [0.0_f64; 2]);
    for (is_gray, sigma, seed) in [false, true]
        .into_iter()
        .flat_map(|gray| [0.7, 1.0, 1.5, 2.0].into_iter().flat_map(move |s| (0..images).map(move |k| (gray, s, k))))
    {
        let field = noise(seed, sigma);
        let image = GrayImage::from_fn(SIDE as u32, SIDE as u32, |x, y| {
            let v = field[y as usize * SIDE + x as usize];
            // Gray at the walls, black and white away from them.
            let bright = if is_gray { (0.5 + 4.0 * v).clamp(0.0, 1.0) } else { f64::from(u8::from(v > 0.0)) };
            Luma([(255.0 * bright).round() as u8])
        });
        let mut bytes = Cursor::new(Vec::new());
        DynamicImage::ImageLuma8(image.clone()).write_to(&mut bytes, ImageFormat::Png).unwrap();
        std::fs::write(&path, bytes.into_inner()).unwrap();
        inputs += 1;
        let read = match load(&path, &options) {
            Ok(read) => read,
            Err(error) => {
                println!("gray {is_gray}, sigma {sigma}, seed {seed}: {error}");
                refused += 1;
                continue;
            }
        };
        rough += usize::from(read.notes.iter().any(|note| note.contains("narrow points")));
        let found = Geometry::new(&read.spec).unwrap().porosity().value;
        let solid: Vec<bool> = image.pixels().map(|p| p[0] < 128).collect();
        let pore = without_specks(&solid).iter().filter(|solid| !**solid).count();
        let off = (found - pore as f64 / (SIDE * SIDE) as f64).abs();
        worst[usize::from(is_gray)] = worst[usize::from(is_gray)].max(off);
    }
    println!(
        "{inputs} images, {refused} refused, {rough} with narrow points; porosity off by {worst:.4?} at most (binary, gray)"
    );
    assert_eq!(refused, 0);
    // Cut corners at narrow points. Gray pixels are counted by their share, which the count at the threshold only comes near to.
    assert!(worst[0] < 0.01, "{worst:?}");
}
