//! Test whether a ring of pixels is a circle: the residuals about the circle of the same area and centroid are within the pixel noise.

use meniscus_core::math::Vec2;

/// Bounds of the residuals, in pixels: the noise of contours was measured on rasterized discs of radius 5 to 40.
#[derive(Debug, Clone, Copy)]
pub(super) struct Noise {
    /// Largest distance.
    pub(crate) most: f64,
    /// Root mean square.
    pub(crate) rms: f64,
}

/// Black and white pixels: half a pixel step, .23 rms.
pub(super) const BINARY: Noise = Noise { most: 0.65, rms: 0.32 };
/// Gray pixels: .05 rms by linear interpolation, more if walls are blurred or the image was compressed.
pub(super) const GRAY: Noise = Noise { most: 0.25, rms: 0.09 };

/// Fourier modes around the circle in which other shapes appear first: ellipse, triangle, square, up to the octagon.
const WAVES: std::ops::RangeInclusive<usize> = 2..=8;

/// The center of the circle of the given area (px²) formed by a closed contour, within the noise; `None` if it is another shape.
pub(super) fn center(points: &[Vec2], area: f64, noise: Noise) -> Option<Vec2> {
    let radius = (area / std::f64::consts::PI).sqrt();
    let center = centroid(points)?;
    let (mut squares, mut length, mut most) = (0.0, 0.0, 0.0_f64);
    let mut waves = [(0.0, 0.0); *WAVES.end() + 1];
    for (i, &p) in points.iter().enumerate() {
        // Each point represents half of the adjacent edges.
        let (before, after) = (points[(i + points.len() - 1) % points.len()], points[(i + 1) % points.len()]);
        let weight = 0.5 * ((p - before).norm() + (after - p).norm());
        let arm = p - center;
        let rest = arm.norm() - radius;
        most = most.max(rest.abs());
        squares += weight * rest * rest;
        length += weight;
        let angle = arm.y.atan2(arm.x);
        for k in WAVES {
            let (sin, cos) = (k as f64 * angle).sin_cos();
            waves[k].0 += 2.0 * weight * rest * cos;
            waves[k].1 += 2.0 * weight * rest * sin;
        }
    }
    if !(length > 0.0) || most > noise.most || squares / length > noise.rms * noise.rms {
        return None;
    }
    // Noise correlated over about two pixels leaves a mode of rms √(2 · 2 / length); three times that is a shape.
    let amplitude = 3.0 * noise.rms * (4.0 / length).sqrt();
    let is_shape = WAVES.filter(|&k| k % 4 != 0).any(|k| waves[k].0.hypot(waves[k].1) / length > amplitude);
    // The pixel grid itself has the symmetry of the square.
    let is_square = WAVES.filter(|&k| k % 4 == 0).any(|k| waves[k].0.hypot(waves[k].1) / length > 1.5 * amplitude);
    (!is_shape && !is_square).then_some(center)
}

fn centroid(points: &[Vec2]) -> Option<Vec2> {
    let origin = *points.first()?;
    let (mut twice, mut moment) = (0.0, Vec2::zeros());
    for i in 0..points.len() {
        let (p, q) = (points[i] - origin, points[(i + 1) % points.len()] - origin);
        let piece = p.perp(&q);
        twice += piece;
        moment += (p + q) * piece;
    }
    (twice != 0.0).then(|| origin + moment / (3.0 * twice))
}
