//! Animated PNG.

use png::{BlendOp, ColorType, DisposeOp, Encoder};

use super::error::MovieError;
use super::frame::{CLEAR, Difference};
use super::palette::Palette;

/// The file of `count` frames at `rate` pictures per second, which begins again at its end.
pub(super) fn encoded(
    [width, height]: [u32; 2],
    palette: &Palette,
    frames: impl Iterator<Item = Difference>,
    rate: f64,
    count: usize,
) -> Result<Vec<u8>, MovieError> {
    /// Delays are in ms.
    const TICKS: f64 = 1000.0;
    let failed = |error: png::EncodingError| MovieError::Encode(error.to_string());
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Indexed);
    encoder.set_palette(palette.bytes());
    let mut alpha = vec![u8::MAX; usize::from(CLEAR) + 1];
    alpha[usize::from(CLEAR)] = 0;
    encoder.set_trns(alpha);
    encoder.set_animated(count as u32, 0).map_err(failed)?;
    encoder.set_blend_op(BlendOp::Over).map_err(failed)?;
    encoder.set_dispose_op(DisposeOp::None).map_err(failed)?;
    let mut writer = encoder.write_header().map_err(failed)?;
    for frame in frames {
        let [width, height] = frame.size;
        // The position first leaves the size, which must fit.
        writer.reset_frame_position().map_err(failed)?;
        writer.set_frame_dimension(width, height).map_err(failed)?;
        writer.set_frame_position(frame.corner[0], frame.corner[1]).map_err(failed)?;
        let delay = (TICKS * f64::from(frame.shown) / rate).round().min(f64::from(u16::MAX));
        writer.set_frame_delay(delay as u16, TICKS as u16).map_err(failed)?;
        writer.write_image_data(&frame.indices).map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    Ok(bytes)
}
