//! Masks: images of grains in a pore, PNG or TIFF, turned into smooth outlines in pixels.
//!
//! The contour lies where the linearly interpolated gray value equals the threshold (marching squares). A ring that is a circle within the pixel noise is
//! read as a disc; any other one is smoothed within the same bounds (a spline that bends as little as the pixels allow) and converted to arcs. Both preserve
//! the area: that of the pixels, with partly covered ones weighted by their gray value. A contour of straight segments alone lies 0.14 κ pixels inside a wall
//! of curvature κ per pixel. Walls that leave the image continue straight outside it. Measured: areas of discs in gray images within 0.1 % from a radius of 5
//! pixels on; in black and white images that of the mean of many, since the number of pixels in one disc scatters (Gauss circle problem).
//!
//! Not supported: stacks of images, and walls blurred over more than two pixels (their areas are those of the contour).

mod arcs;
mod circle;
mod contour;
mod outlines;
mod pixels;
mod smooth;
mod symmetry;
mod wall;

use outlines::Outlines;

use crate::import::drawing::{Drawing, Refusal, Unit};
use crate::import::options::Options;
use meniscus_core::math::{Bounds, Vec2};

/// Default gray value that separates solid from pore.
const THRESHOLD: f64 = 0.5;

/// Reads a PNG or TIFF image. The drawing is in pixels: x to the right, y up, the image's lower left corner at the origin.
///
/// # Errors
/// Problems of the file, the threshold or the image.
pub fn read(bytes: &[u8], options: &Options) -> Result<Drawing, Vec<Refusal>> {
    let threshold = options.threshold.unwrap_or(THRESHOLD);
    if !(threshold > 0.0 && threshold < 1.0) {
        let expected = "a gray value above 0 (black) and below 1 (white)";
        return Err(vec![Refusal::new("threshold", threshold.to_string(), expected)]);
    }
    let image = pixels::decode(bytes).map_err(|refusal| vec![refusal])?;
    let (solid, mut notes) = image.solid(threshold, options.is_inverted()).map_err(|refusal| vec![refusal])?;
    let Outlines { entities, specks, rough } = outlines::outlines(&solid);
    let share = solid.mean();
    let kind = if options.is_inverted() { "bright" } else { "dark" };
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
            "at {rough} narrow points smooth walls would cross: the straight edges of the contour are kept there; a finer image has fewer"
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
