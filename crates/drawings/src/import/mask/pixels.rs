//! From the bytes of a PNG or TIFF file to the solid fraction in each pixel.
//!
//! Colors count by their luminance (Rec. 709), transparent pixels are blended with white. Sizes are checked against limits before memory is allocated.

use std::io::Cursor;

use png::{BitDepth, DecodingError, Transformations};
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

use crate::import::drawing::Refusal;

/// Longest side of an image in pixels.
const LONGEST_SIDE: u32 = 32_768;
/// Maximum number of pixels of an image: 8192 x 8192.
const MOST_PIXELS: u64 = 1 << 26;
/// Shortest side: fewer pixels cannot contain an outline.
const SHORTEST_SIDE: u32 = 4;
/// Maximum number of bytes of a decoded image: 8192 x 8192 pixels of four channels of 16 bits.
const MOST_BYTES: u64 = 8 * MOST_PIXELS;

/// Gray values in rows from below, 0 black and 1 white.
pub(super) struct Gray {
    width: usize,
    height: usize,
    values: Vec<f32>,
    notes: Vec<String>,
}

/// The solid fraction in each pixel, rows from below; one half is the threshold.
pub(super) struct Solid {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) share: Vec<f32>,
}

impl Solid {
    /// The solid fraction of the image.
    pub(crate) fn mean(&self) -> f64 {
        self.share.iter().map(|&s| f64::from(s)).sum::<f64>() / self.share.len() as f64
    }
}

fn refusal(found: impl Into<String>, expected: impl Into<String>) -> Refusal {
    Refusal { location: "the image".into(), found: found.into(), expected: expected.into() }
}

/// Reads PNG or TIFF, as detected from the first bytes.
pub(super) fn decode(bytes: &[u8]) -> Result<Gray, Refusal> {
    let gray = if bytes.starts_with(b"\x89PNG") {
        png(bytes)?
    } else if [&b"II*\0"[..], b"MM\0*", b"II+\0", b"MM\0+"].iter().any(|magic| bytes.starts_with(magic)) {
        tiff(bytes)?
    } else {
        return Err(refusal(
            "neither PNG nor TIFF, judging by its first bytes",
            "a PNG or TIFF file; convert the image to one of them",
        ));
    };
    match gray.values.iter().position(|v| !v.is_finite()) {
        None => Ok(gray.stretched()),
        Some(i) => {
            let (row, column) = (gray.height - 1 - i / gray.width, i % gray.width);
            Err(Refusal {
                location: format!("pixel ({column}, {row}) from the upper left"),
                found: "a value that is not a number".into(),
                expected: "numbers from 0 (black) to 1 (white)".into(),
            })
        }
    }
}

fn check_size(width: u32, height: u32) -> Result<(), Refusal> {
    let found = format!("{width} x {height} pixels");
    if width.max(height) > LONGEST_SIDE || u64::from(width) * u64::from(height) > MOST_PIXELS {
        let expected = format!(
            "at most {LONGEST_SIDE} pixels a side and {MOST_PIXELS} in all: cut the image, or scale it down to 15 pixels per grain radius"
        );
        return Err(refusal(found, expected));
    }
    if width.min(height) < SHORTEST_SIDE {
        return Err(refusal(found, format!("at least {SHORTEST_SIDE} pixels a side")));
    }
    Ok(())
}

fn png(bytes: &[u8]) -> Result<Gray, Refusal> {
    let unreadable = |error: DecodingError| {
        let found = match error {
            DecodingError::Format(error) => format!("Format error decoding Png: {error}"),
            DecodingError::LimitsExceeded => "Insufficient memory".to_owned(),
            other => other.to_string(),
        };
        refusal(found, "a complete PNG file: export it again")
    };
    let limits = png::Limits { bytes: MOST_BYTES as usize };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    // Palettes and samples of less than 8 bits as 8 bits.
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(unreadable)?;
    let size = reader.info().size();
    check_size(size.0, size.1)?;
    let mut data = vec![0; reader.output_buffer_size().unwrap_or_default()];
    reader.next_frame(&mut data).map_err(unreadable)?;
    let (color, depth) = reader.output_color_type();
    let sample = |k: usize| match depth {
        BitDepth::Sixteen => f32::from(u16::from_be_bytes([data[2 * k], data[2 * k + 1]])),
        _ => f32::from(257 * u16::from(data[k])),
    };
    let channels = color.samples();
    let value = |pixel: usize| {
        let first = pixel * channels;
        let gray =
            if channels < 3 { sample(first) } else { luminance(sample(first), sample(first + 1), sample(first + 2)) };
        let alpha = if channels % 2 == 0 { sample(first + channels - 1) / 65535.0 } else { 1.0 };
        on_white(gray, alpha)
    };
    let pixels = size.0 as usize * size.1 as usize;
    Ok(Gray::from_rows_down(size, (0..pixels).map(value).collect()))
}

fn luminance(r: f32, g: f32, b: f32) -> f32 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// A 16-bit gray value over white, 0 to 1.
fn on_white(value: f32, alpha: f32) -> f32 {
    alpha * value / 65535.0 + (1.0 - alpha)
}

fn tiff(bytes: &[u8]) -> Result<Gray, Refusal> {
    let unreadable = |error: TiffError| refusal(error.to_string(), "a complete TIFF file: export it again, or as PNG");
    let mut decoder = Decoder::new(Cursor::new(bytes)).map_err(unreadable)?;
    let size = decoder.dimensions().map_err(unreadable)?;
    check_size(size.0, size.1)?;
    if decoder.more_images() {
        return Err(refusal("a stack of images", "one image: export the slice that is meant"));
    }
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MOST_BYTES as usize;
    limits.intermediate_buffer_size = MOST_BYTES as usize;
    let mut decoder = decoder.with_limits(limits);
    let color = decoder.colortype().map_err(unreadable)?;
    let (channels, has_alpha) = match color {
        ColorType::Gray(_) | ColorType::Palette(_) => (1, false),
        ColorType::GrayA(_) => (2, true),
        ColorType::RGB(_) => (3, false),
        ColorType::RGBA(_) => (4, true),
        other => {
            return Err(refusal(format!("colors as {other:?}"), "gray, RGB or a palette: convert the image to gray"));
        }
    };
    let map = if matches!(color, ColorType::Palette(_)) {
        Some(decoder.get_tag_u16_vec(Tag::ColorMap).map_err(unreadable)?)
    } else {
        None
    };
    let bits = decoder.find_tag_unsigned_vec::<u16>(Tag::BitsPerSample).map_err(unreadable)?;
    let bits = bits.and_then(|bits| bits.first().copied()).unwrap_or(1).min(64);
    let orientation = decoder.find_tag_unsigned::<u16>(Tag::Orientation).map_err(unreadable)?.unwrap_or(UPRIGHT);
    let result = decoder.read_image().map_err(unreadable)?;
    let pixels = size.0 as usize * size.1 as usize;
    let samples = unpacked(result, bits, size.0 as usize * channels, size.1 as usize)?;
    if samples.len() != pixels * channels {
        return Err(refusal(
            format!("{} samples", samples.len()),
            format!("{} for {} x {} pixels: export the image again", pixels * channels, size.0, size.1),
        ));
    }
    let values = if let Some(map) = map {
        samples.iter().map(|&index| palette(&map, index, bits)).collect()
    } else {
        let one = |s: &[f32]| {
            let gray = if channels < 3 { s[0] } else { luminance(s[0], s[1], s[2]) };
            if has_alpha { on_white(gray * 65535.0, s[channels - 1]) } else { gray }
        };
        samples.chunks_exact(channels).map(one).collect()
    };
    oriented(size, values, orientation)
}

/// The orientation of an image whose rows run down and columns to the right.
const UPRIGHT: u16 = 1;

/// The image in display orientation: tag 274 of TIFF gives the sides of the picture at which the first row and the first column of the file lie.
fn oriented((width, height): (u32, u32), values: Vec<f32>, orientation: u16) -> Result<Gray, Refusal> {
    let (w, h) = (width as usize, height as usize);
    // Column and row of the file for those of the picture.
    let source: fn([usize; 2], [usize; 2]) -> [usize; 2] = match orientation {
        UPRIGHT => return Ok(Gray::from_rows_down((width, height), values)),
        2 => |[x, y], [w, _]| [w - 1 - x, y],
        3 => |[x, y], [w, h]| [w - 1 - x, h - 1 - y],
        4 => |[x, y], [_, h]| [x, h - 1 - y],
        5 => |[x, y], _| [y, x],
        6 => |[x, y], [_, h]| [y, h - 1 - x],
        7 => |[x, y], [w, h]| [w - 1 - y, h - 1 - x],
        8 => |[x, y], [w, _]| [w - 1 - y, x],
        other => return Err(refusal(format!("the orientation {other}"), "1 to 8 in tag 274: export the image again")),
    };
    let size = if orientation < 5 { [w, h] } else { [h, w] };
    let value = |k: usize| {
        let [x, y] = source([k % size[0], k / size[0]], [w, h]);
        values[y * w + x]
    };
    let turned = (0..w * h).map(value).collect();
    let mut gray = Gray::from_rows_down((size[0] as u32, size[1] as u32), turned);
    gray.notes.push(format!("the image is turned or mirrored as its orientation {orientation} says"));
    Ok(gray)
}

fn palette(map: &[u16], index: f32, bits: u16) -> f32 {
    let count = 1_usize << bits.min(16);
    // Samples are scaled to 0..1.
    let index = (index * (count - 1) as f32).round() as usize;
    let channel = |k: usize| map.get(k * count + index).map_or(0.0, |&v| f32::from(v) / 65535.0);
    luminance(channel(0), channel(1), channel(2))
}

/// The samples as numbers, integers scaled to 0..1; samples of less than 8 bits are unpacked row by row.
fn unpacked(result: DecodingResult, bits: u16, row: usize, rows: usize) -> Result<Vec<f32>, Refusal> {
    Ok(match result {
        DecodingResult::U8(bytes) if bits < 8 && bytes.len() != row * rows => {
            let (per_row, top) = ((row * bits as usize).div_ceil(8), (1_u16 << bits) - 1);
            let sample = |line: &[u8], k: usize| {
                let at = k * bits as usize;
                let byte = u16::from(line.get(at / 8).copied().unwrap_or(0));
                f32::from((byte >> (8 - bits as usize - at % 8)) & top) / f32::from(top)
            };
            bytes.chunks(per_row).take(rows).flat_map(|line| (0..row).map(move |k| sample(line, k))).collect()
        }
        DecodingResult::U8(v) => {
            let top = if bits < 8 { f32::from((1_u8 << bits) - 1) } else { 255.0 };
            v.iter().map(|&v| f32::from(v) / top).collect()
        }
        DecodingResult::U16(v) => v.iter().map(|&v| f32::from(v) / 65535.0).collect(),
        DecodingResult::U32(v) => v.iter().map(|&v| (f64::from(v) / f64::from(u32::MAX)) as f32).collect(),
        DecodingResult::F32(v) => v,
        DecodingResult::F64(v) => v.iter().map(|&v| v as f32).collect(),
        _ => {
            return Err(refusal(
                "signed, 16-bit float or 64-bit integer samples",
                "8, 16 or 32 bits, or 32-bit floats",
            ));
        }
    })
}

impl Gray {
    fn from_rows_down((width, height): (u32, u32), values: Vec<f32>) -> Self {
        let width = width as usize;
        let values = values.chunks_exact(width).rev().flatten().copied().collect();
        Self { width, height: height as usize, values, notes: Vec::new() }
    }

    /// Images of two values (0 and 1 of a label image, say) become black and white, and floats outside 0 to 1 are rescaled.
    fn stretched(mut self) -> Self {
        let (low, high) = self.range();
        let is_binary = low < high && self.values.iter().all(|&v| v == low || v == high);
        let is_beyond = low < 0.0 || high > 1.0;
        if high > low && (is_beyond || (is_binary && (low, high) != (0.0, 1.0))) {
            self.notes.push(format!("the gray values from {low} to {high} are read as 0 to 1"));
            self.values.iter_mut().for_each(|v| *v = (*v - low) / (high - low));
        }
        self
    }

    fn range(&self) -> (f32, f32) {
        self.values.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)))
    }

    /// The solid fraction in each pixel: 0 and 1 at the most common gray values on both sides of the threshold, one half at the threshold.
    pub(crate) fn solid(self, threshold: f64, invert: bool) -> Result<(Solid, Vec<String>), Refusal> {
        const BINS: usize = 256;
        let bin = |v: f32| ((v * (BINS - 1) as f32).round() as usize).min(BINS - 1);
        let mut counts = [0_usize; BINS];
        self.values.iter().for_each(|&v| counts[bin(v)] += 1);
        let split = (threshold * (BINS - 1) as f64).ceil() as usize;
        let commonest = |range: std::ops::Range<usize>| range.max_by_key(|&k| (counts[k], std::cmp::Reverse(k)));
        let peak = |range| commonest(range).filter(|&k| counts[k] > 0).map(|k| k as f32 / (BINS - 1) as f32);
        let (Some(dark), Some(bright)) = (peak(0..split), peak(split..BINS)) else {
            let (low, high) = self.range();
            let found = format!("gray values from {low} to {high}, all on one side of the threshold {threshold}");
            return Err(refusal(found, "solid and pore: set `threshold` between their gray values"));
        };
        let mut notes = self.notes;
        let middle = 0.5 * (dark + bright);
        // At thresholds farther from the middle, a blurred wall is visibly displaced.
        const FAR: f64 = 0.1;
        if (f64::from(middle) - threshold).abs() > FAR {
            notes.push(format!(
                "the commonest gray values are {dark:.2} and {bright:.2}; a threshold of {middle:.2}, halfway, leaves blurred walls unshifted"
            ));
        }
        let threshold = threshold as f32;
        let share = |v: f32| {
            let bright_share = if v < threshold {
                0.5 * (v - dark) / (threshold - dark)
            } else {
                0.5 + 0.5 * (v - threshold) / (bright - threshold).max(f32::EPSILON)
            };
            if invert { bright_share.clamp(0.0, 1.0) } else { (1.0 - bright_share).clamp(0.0, 1.0) }
        };
        let share = self.values.iter().map(|&v| share(v)).collect();
        Ok((Solid { width: self.width, height: self.height, share }, notes))
    }
}
