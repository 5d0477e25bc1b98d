//! Area and centroid within a closed line of segments and arcs, by Green's theorem in closed form.

use meniscus_core::math::Vec2;
use meniscus_geometry::curve::{Curve, cross, unit};

/// Area, and first moment about a point, of the region on the left of a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moments {
    origin: Vec2,
    last: Option<[Vec2; 2]>,
    /// Area in m2.
    pub(crate) area: f64,
    /// First moment in m3.
    pub(crate) first: Vec2,
    /// Length of the curves in m.
    pub(crate) length: f64,
}

impl Moments {
    /// Zero moments about a point (m) near the line, which reduces rounding.
    pub(crate) fn about(origin: Vec2) -> Self {
        Self { origin, last: None, area: 0.0, first: Vec2::zeros(), length: 0.0 }
    }

    /// Continues along a straight line to `b`, from the present point or from `a`.
    pub(crate) fn straight(&mut self, a: Vec2, b: Vec2) {
        self.jump(a);
        self.triangle(a, b);
        self.last = self.last.map(|[start, _]| [start, b]).or(Some([a, b]));
    }

    /// Continues along a curve.
    pub(crate) fn curve(&mut self, curve: &Curve) {
        let (a, b) = (curve.point(0.0), curve.point(1.0));
        self.straight(a, b);
        self.length += curve.length();
        if let Curve::Arc { center, radius, start, sweep } = *curve {
            // The circular segment between arc and chord.
            let area = 0.5 * radius * radius * (sweep - sweep.sin());
            let moment = unit(start + 0.5 * sweep) * (2.0 / 3.0 * (radius * (0.5 * sweep).sin()).powi(3));
            self.area += area;
            self.first += moment + (center - self.origin) * area;
        }
    }

    /// Closes the line.
    pub(crate) fn closed(mut self) -> Self {
        if let Some([start, _]) = self.last {
            self.jump(start);
        }
        self
    }

    fn jump(&mut self, to: Vec2) {
        if let Some([start, end]) = self.last {
            self.triangle(end, to);
            self.last = Some([start, to]);
        }
    }

    fn triangle(&mut self, a: Vec2, b: Vec2) {
        let (a, b) = (a - self.origin, b - self.origin);
        let area = 0.5 * cross(a, b);
        self.area += area;
        self.first += (a + b) * (area / 3.0);
    }

    /// The centroid in m.
    pub(crate) fn centroid(&self) -> Vec2 {
        self.origin + self.first / self.area
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_disc_has_its_area_and_centroid() {
        let origin = Vec2::new(0.3, -2.0);
        let mut moments = Moments::about(origin);
        let arc = Curve::Arc { center: Vec2::new(1.0, 1.0), radius: 2.0, start: 0.0, sweep: std::f64::consts::PI };
        moments.curve(&arc);
        let moments = moments.closed();
        assert!((moments.area - 2.0 * std::f64::consts::PI).abs() < 1e-14);
        let expected = Vec2::new(1.0, 1.0 + 8.0 / (3.0 * std::f64::consts::PI));
        assert!((moments.centroid() - expected).norm() < 1e-14);
    }

    #[test]
    fn a_clockwise_circle_encloses_nothing_but_its_outside() {
        let mut moments = Moments::about(Vec2::new(5.0, 0.0));
        moments.curve(&Curve::circle(Vec2::new(1.0, 0.0), 0.5).reversed());
        let moments = moments.closed();
        assert!((moments.area + 0.25 * std::f64::consts::PI).abs() < 1e-14);
        assert!((moments.centroid() - Vec2::new(1.0, 0.0)).norm() < 1e-13);
    }
}
