//! Regular arrays of equal discs: square, or hexagonal with rows along x.

use super::error::{MOST_DISCS, PackError, size_of};
use crate::spec::{Arrangement, Array, Disc};

/// The discs of an array, as many as fit completely into the region, centered in it.
///
/// # Errors
/// Invalid sizes, or a region that holds no disc.
pub fn array(spec: &Array) -> Result<Vec<Disc>, PackError> {
    let size = size_of(spec.region)?;
    let (radius, gap) = (spec.radius, spec.gap);
    PackError::require_size("radius", radius)?;
    PackError::require_size("gap", gap)?;
    let pitch = 2.0 * radius + gap;
    let row = if spec.arrangement == Arrangement::Square { pitch } else { 0.5 * 3.0_f64.sqrt() * pitch };
    let shift = if spec.arrangement == Arrangement::Square { 0.0 } else { 0.5 * pitch };
    // Tolerance, so that rounding does not lose a row of discs that just fits.
    const ROUNDING: f64 = 1e-9;
    let fits =
        |room: f64, step: f64| if room < -ROUNDING * step { 0.0 } else { (room / step + ROUNDING).floor() + 1.0 };
    let rows = fits(size[1] - 2.0 * radius, row);
    let shift = if rows > 1.0 { shift } else { 0.0 };
    let columns = fits(size[0] - 2.0 * radius - shift, pitch);
    PackError::require(
        rows * columns >= 1.0,
        "region",
        format!("{:e} x {:e} m holds no disc of radius {radius:e} m", size[0], size[1]),
        "enlarge the region or make the discs smaller",
    )?;
    PackError::require(
        rows * columns <= MOST_DISCS,
        "radius",
        format!("the region would hold {:.1e} discs, expected at most {MOST_DISCS:e}", rows * columns),
        "are all lengths in m?",
    )?;
    let middle = [0, 1].map(|k| 0.5 * (spec.region[0][k] + spec.region[1][k]));
    let first = [middle[0] - 0.5 * ((columns - 1.0) * pitch + shift), middle[1] - 0.5 * (rows - 1.0) * row];
    let mut discs = Vec::new();
    for j in 0..rows as usize {
        let begin = first[0] + if j % 2 == 1 { shift } else { 0.0 };
        for i in 0..columns as usize {
            discs.push(Disc { center: [begin + i as f64 * pitch, first[1] + j as f64 * row], radius });
        }
    }
    Ok(discs)
}
