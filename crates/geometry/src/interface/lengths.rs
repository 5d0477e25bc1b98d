//! Lengths of the interface and of the walls covered by each phase.

use super::polyline::Polyline;
use meniscus_core::math::Vec2;

/// Color above which a point belongs to the wetting phase: the level of the interface.
pub(crate) const WETTING_COLOR: f64 = 0.5;

/// Total length of `contours` in m.
pub fn interface_length(contours: &[Polyline]) -> f64 {
    contours.iter().map(Polyline::length).sum()
}

/// Lengths of wall in contact with the phases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WettedLength {
    /// Length in contact with the wetting phase in m.
    pub wetting: f64,
    /// Length in contact with the non-wetting phase in m.
    pub non_wetting: f64,
}

/// A short segment of wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallSample {
    /// Its midpoint in m.
    pub point: Vec2,
    /// Its length in m.
    pub length: f64,
}

/// Divides wall outlines into segments no longer than `longest` (m).
pub fn wall_samples(outlines: &[Polyline], longest: f64) -> Vec<WallSample> {
    let mut samples = Vec::new();
    for (a, b) in outlines.iter().flat_map(Polyline::segments) {
        let pieces = ((b - a).norm() / longest).ceil().max(1.0);
        let length = (b - a).norm() / pieces;
        samples.extend(
            (0..pieces as usize).map(|i| WallSample { point: a + (b - a) * ((i as f64 + 0.5) / pieces), length }),
        );
    }
    samples
}

/// Wetted length from the smoothed color at each sample; samples without one (NaN: no fluid near) are left out.
pub fn wetted_length(samples: &[WallSample], colors: &[f64]) -> WettedLength {
    let sum = |inside: &dyn Fn(f64) -> bool| {
        samples.iter().zip(colors).filter(|(_, c)| inside(**c)).map(|(sample, _)| sample.length).sum()
    };
    WettedLength { wetting: sum(&|c| c > WETTING_COLOR), non_wetting: sum(&|c| c <= WETTING_COLOR) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interface_length_of_a_disc_is_its_circumference() {
        let at = |i: i32| std::f64::consts::TAU * f64::from(i) / 400.0;
        let points = (0..400).map(|i| 0.5 * Vec2::new(at(i).cos(), at(i).sin())).collect();
        let length = interface_length(&[Polyline { points, closed: true }]);
        assert!((length - std::f64::consts::PI).abs() < 1e-4 * std::f64::consts::PI);
    }

    #[test]
    fn wetted_length_is_the_part_of_the_wall_with_color_one() {
        let wall = Polyline { points: vec![Vec2::zeros(), Vec2::new(4.0, 0.0)], closed: false };
        let samples = wall_samples(&[wall], 0.01);
        let color = |x: f64| if x > 3.5 { f64::NAN } else { f64::from((1.0..2.5).contains(&x)) };
        let colors: Vec<f64> = samples.iter().map(|s| color(s.point.x)).collect();
        let wetted = wetted_length(&samples, &colors);
        assert!((wetted.wetting - 1.5).abs() < 0.011 && (wetted.non_wetting - 2.0).abs() < 0.011, "{wetted:?}");
    }
}
