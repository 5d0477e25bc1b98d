//! PNG masks: the exact fraction of solid in each pixel, black for 1.
//!
//! Each edge of a polygon adds, in every row that it crosses, the area between itself and the right side of the image; the cumulative sum from left to right
//! is the fraction. Arcs are approximated by chords within 1e-3 of a pixel. Overlapping shapes within a pixel count at most once.

use super::error::ExportError;
use super::sheet::{Sheet, rings_of, sampled};
use crate::import::drawing::Ring;
use meniscus_core::math::{Bounds, Vec2};

/// Maximum distance of chords from arcs over the pixel size.
const CHORD: f64 = 1e-3;
/// Most pixels along a side.
const MOST: f64 = 8192.0;
/// Fewest pixels along a side.
const FEWEST: f64 = 4.0;

pub(super) fn png(sheet: &Sheet, pixel: f64) -> Result<Vec<u8>, ExportError> {
    let size = (sheet.frame.size() / pixel).map(|v| v.round());
    if !(pixel > 0.0 && size.min() >= FEWEST && size.max() <= MOST) {
        return Err(ExportError::Pixels { pixel, width: size.x, height: size.y });
    }
    let (width, height) = (size.x as usize, size.y as usize);
    let mut share = vec![0.0_f32; width * height];
    for outline in &sheet.outlines {
        cover(&rings_of(outline), &sheet.frame, pixel, [width, height], &mut share);
    }
    let gray = |solid: &f32| (255.0 * (1.0 - solid.clamp(0.0, 1.0))).round() as u8;
    let pixels: Vec<u8> = share.chunks_exact(width).rev().flatten().map(gray).collect();
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_filter(png::Filter::Adaptive);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels));
    written.map_err(|error| ExportError::Library(error.to_string()))?;
    Ok(bytes)
}

/// Adds the fraction of the pixels covered by rings together.
fn cover(rings: &[Ring], frame: &Bounds, pixel: f64, [width, height]: [usize; 2], share: &mut [f32]) {
    let points: Vec<Vec<Vec2>> = rings
        .iter()
        .map(|ring| {
            let largest = super::sheet::edges(ring).map(|edge| edge.bounds().size().max()).fold(pixel, f64::max);
            let error = (CHORD * pixel / largest).min(0.1);
            sampled(ring, error).into_iter().map(|p| (p - frame.min) / pixel).collect()
        })
        .collect();
    let (low, high) = points
        .iter()
        .flatten()
        .fold((Vec2::repeat(f64::INFINITY), Vec2::repeat(f64::NEG_INFINITY)), |(a, b), p| (a.inf(p), b.sup(p)));
    let clip = |v: f64, count: usize| v.clamp(0.0, count as f64) as usize;
    let (left, right) = (clip(low.x.floor(), width), clip(high.x.ceil(), width));
    let (bottom, top) = (clip(low.y.floor(), height), clip(high.y.ceil(), height));
    if left >= right || bottom >= top {
        return;
    }
    let columns = right - left;
    // One more column takes contributions to the right of the last one.
    let mut sums = vec![0.0_f64; (columns + 1) * (top - bottom)];
    for ring in &points {
        for (k, &p) in ring.iter().enumerate() {
            let q = ring[(k + 1) % ring.len()];
            edge(
                p - Vec2::new(left as f64, bottom as f64),
                q - Vec2::new(left as f64, bottom as f64),
                columns,
                &mut sums,
            );
        }
    }
    for (row, line) in sums.chunks_exact(columns + 1).enumerate() {
        let mut sum = 0.0;
        for (column, step) in line[..columns].iter().enumerate() {
            sum += step;
            // Counter-clockwise rings run upwards on their right side: the cumulative sum is negative inside.
            share[(bottom + row) * width + left + column] += (-sum).abs() as f32;
        }
    }
}

/// Adds an edge to the differences along the rows that it crosses.
fn edge(p: Vec2, q: Vec2, columns: usize, sums: &mut [f64]) {
    if p.y == q.y {
        return;
    }
    let rows = sums.len() / (columns + 1);
    let (sign, a, b) = if p.y < q.y { (1.0, p, q) } else { (-1.0, q, p) };
    let slope = (b.x - a.x) / (b.y - a.y);
    let (first, last) = (a.y.max(0.0), b.y.min(rows as f64));
    let mut y = first;
    while y < last {
        let row = (y.floor() as usize).min(rows - 1);
        let end = last.min(row as f64 + 1.0);
        if end <= y {
            break;
        }
        let at = |y: f64| (a.x + slope * (y - a.y)).clamp(0.0, columns as f64);
        span(at(y), at(end), sign * (end - y), &mut sums[row * (columns + 1)..(row + 1) * (columns + 1)]);
        y = end;
    }
}

/// The part of an edge within one row, from `x0` to `x1` and `rise` high: the pixels that it crosses get their fraction, those to the right all of it.
fn span(x0: f64, x1: f64, rise: f64, line: &mut [f64]) {
    let (x0, x1) = (x0.min(x1), x0.max(x1));
    let last = line.len() - 1;
    let (first, end) = ((x0.floor() as usize).min(last), (x1.floor() as usize).min(last));
    // The rise times the width to the right of the edge, summed up to a pixel's right side.
    let covered = |x: f64| {
        if x1 > x0 {
            let t = (x - x0).clamp(0.0, x1 - x0);
            rise * (t * t / (2.0 * (x1 - x0)) + (x - x1).max(0.0))
        } else {
            rise * (x - x0).max(0.0)
        }
    };
    let (mut before, mut done) = (0.0, 0.0);
    for (column, pixel) in line.iter_mut().enumerate().take((end + 1).min(last) + 1).skip(first) {
        let to = covered(column as f64 + 1.0);
        let area = to - before;
        *pixel += area - done;
        (before, done) = (to, area);
    }
}
