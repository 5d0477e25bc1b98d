//! Masks: images of grains in a pore, PNG or TIFF, turned into smooth outlines in pixels.
//!
//! The contour runs where the linearly interpolated gray value passes the threshold (marching squares). A ring that is a circle within
//! what pixels can tell is read as a disc; any other one is smoothed within the same bounds (a spline that bends as little as the
//! pixels allow) and written as arcs. Both keep the area: that of the pixels, partly covered ones counted by their gray value. A
//! contour of straight pieces alone lies 0.14 κ pixels inside of a wall of curvature κ per pixel. Walls that leave the image go straight
//! on outside of it. Measured: areas of discs in gray images within 0.1 % from a radius of 5 pixels on; in black and white images that of the
//! mean of many, since the number of pixels in one disc scatters (the circle problem of Gauss).
//!
//! Left out: stacks of images, and walls that are blurred over more than two pixels (their areas are those of the contour).

mod arcs;
mod circle;
mod contour;
mod outlines;
mod pixels;
mod smooth;
mod wall;

use outlines::Outlines;

use crate::geometry::import::drawing::{Drawing, Refusal, Unit};
use crate::math::{Bounds, Vec2};

/// How a mask is read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MaskOptions {
    /// Gray value that divides solid from pore, above 0 (black) and below 1 (white); one half where there is none.
    pub threshold: Option<f64>,
    /// Bright is solid; else dark is.
    pub invert: bool,
    /// Side of a pixel in m.
    pub pixel_size: Option<f64>,
}

/// Gray value that divides solid from pore where no other is given.
const THRESHOLD: f64 = 0.5;

/// Reads a PNG or TIFF image. The drawing is in pixels: x to the right, y up, the image's lower left corner at the origin.
///
/// # Errors
/// What is wrong with the file, the threshold or the image.
pub fn read(bytes: &[u8], options: &MaskOptions) -> Result<Drawing, Vec<Refusal>> {
    let threshold = options.threshold.unwrap_or(THRESHOLD);
    if !(threshold > 0.0 && threshold < 1.0) {
        return Err(vec![Refusal {
            place: "threshold".into(),
            found: format!("{threshold}"),
            expected: "a gray value above 0 (black) and below 1 (white)".into(),
        }]);
    }
    let image = pixels::decode(bytes).map_err(|refusal| vec![refusal])?;
    let (solid, mut notes) = image.solid(threshold, options.invert).map_err(|refusal| vec![refusal])?;
    let Outlines { entities, specks, rough } = outlines::outlines(&solid);
    let share = solid.mean();
    let kind = if options.invert { "bright" } else { "dark" };
    notes.insert(
        0,
        format!(
            "{} x {} pixels; {kind} is solid: {:.2} % of the image (threshold {threshold})",
            solid.width,
            solid.height,
            100.0 * share
        ),
    );
    let mut unused = std::collections::BTreeMap::new();
    if specks > 0 {
        unused.insert(format!("specks below {} pixels", wall::SPECK), specks);
    }
    if rough > 0 {
        notes.push(format!(
            "at {rough} narrow places smooth walls would cross: the straight edges of the contour are kept there; a finer image has fewer"
        ));
    }
    Ok(Drawing {
        entities,
        unit: options.pixel_size.map(|meters| Unit { name: "pixel".into(), meters }),
        frame: Some(Bounds { min: Vec2::zeros(), max: Vec2::new(solid.width as f64, solid.height as f64) }),
        is_of_pixels: true,
        unused,
        notes,
        ..Drawing::default()
    })
}
