//! Animated GIF.

use gif::{DisposalMethod, Encoder, Frame, Repeat};

use super::error::MovieError;
use super::frame::{CLEAR, Difference};
use super::palette::Palette;

/// Units of time per second.
const TICKS: f64 = 100.0;

/// The file at `rate` pictures per second, which begins again at its end.
pub(super) fn encoded(
    size: [u32; 2],
    palette: &Palette,
    frames: impl Iterator<Item = Difference>,
    rate: f64,
) -> Result<Vec<u8>, MovieError> {
    let failed = |error: gif::EncodingError| MovieError::Encode(error.to_string());
    let [width, height] = size.map(|pixels| pixels as u16);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height, &palette.bytes()).map_err(failed)?;
    encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
    let mut before = 0;
    for frame in frames {
        let [left, top] = frame.corner.map(|pixels| pixels as u16);
        let [width, height] = frame.size.map(|pixels| pixels as u16);
        // From the start, so that rounding does not add up.
        let tick = |pictures: u32| (TICKS * f64::from(pictures) / rate).round();
        let delay = (tick(before + frame.shown) - tick(before)) as u16;
        before += frame.shown;
        let written = encoder.write_frame(&Frame {
            delay,
            dispose: DisposalMethod::Keep,
            transparent: Some(CLEAR),
            left,
            top,
            width,
            height,
            buffer: frame.indices.into(),
            ..Frame::default()
        });
        written.map_err(failed)?;
    }
    drop(encoder);
    Ok(bytes)
}
