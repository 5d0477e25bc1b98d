//! Ordered lines of points, such as an interface: length, area, curvature, and the interface reconstructed from a level of the smoothed color.

use super::circle;
use meniscus_core::math::{LINE_MOMENT, Vec2, perpendicular};

/// An ordered line of points; of a contour the high side of the field is on its left.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyline {
    /// Vertices in m; the first one is not repeated at the end of a closed line.
    pub points: Vec<Vec2>,
    /// Whether the last vertex is connected to the first one.
    pub closed: bool,
}

impl Polyline {
    /// Length in m.
    pub fn length(&self) -> f64 {
        self.segments().map(|(a, b)| (b - a).norm()).sum()
    }

    /// The segments between vertices, including the closing one of a closed line.
    pub fn segments(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        let count = self.points.len();
        let segments = if self.closed && count > 1 { count } else { count.saturating_sub(1) };
        (0..segments).map(move |i| (self.points[i], self.points[(i + 1) % count]))
    }

    /// Area in m² on the left of a closed line: positive if it runs counter-clockwise.
    pub fn signed_area(&self) -> f64 {
        let from = self.points.first().copied().unwrap_or_else(Vec2::zeros);
        0.5 * self.segments().map(|(a, b)| (a - from).perp(&(b - from))).sum::<f64>()
    }

    /// Curvature in 1/m at each vertex, by a circle fitted to the vertices within `reach` (m) along the line.
    ///
    /// Positive for a drop of the high side. NaN with fewer than five vertices within reach.
    pub fn curvature(&self, reach: f64) -> Vec<f64> {
        (0..self.points.len())
            .map(|i| {
                let window = self.window(i, reach);
                // Five points for three unknowns: with fewer the curvature is dominated by noise.
                if window.len() < 5 { f64::NAN } else { circle::fit(&window).map_or(f64::NAN, |fit| fit.curvature) }
            })
            .collect()
    }

    /// The interface whose color, smoothed with `smoothing_length` (m), has this line as its level 1/2.
    ///
    /// Smoothing displaces the level towards the center of curvature, see [`LINE_MOMENT`]. The curvature is that within 2.5 smoothing lengths.
    pub fn on_interface(&self, smoothing_length: f64) -> Self {
        let count = self.points.len();
        let limit = 1.0 / smoothing_length;
        let moved = |(i, kappa): (usize, f64)| {
            // A line that ends, or continues across a periodic side, has no neighbor there.
            let near = |j: usize| {
                let offset = self.points[j] - self.points[i];
                if offset.norm() < smoothing_length { offset } else { Vec2::zeros() }
            };
            let (before, after) = (near((i + count - 1) % count), near((i + 1) % count));
            let into_high = perpendicular(after - before).try_normalize(f64::EPSILON * smoothing_length);
            let drawn = LINE_MOMENT * smoothing_length.powi(2) * kappa.clamp(-limit, limit);
            self.points[i] - into_high.filter(|_| kappa.is_finite()).map_or(Vec2::zeros(), |n| drawn * n)
        };
        let points = self.curvature(2.5 * smoothing_length).into_iter().enumerate().map(moved).collect();
        Self { points, closed: self.closed }
    }

    /// The vertices within `reach` (m) along the line on both sides of vertex `i`, in order.
    fn window(&self, i: usize, reach: f64) -> Vec<Vec2> {
        let count = self.points.len();
        let step = |from: usize, forward: bool| -> Option<usize> {
            match (forward, self.closed) {
                (true, true) => Some((from + 1) % count),
                (false, true) => Some((from + count - 1) % count),
                (true, false) => (from + 1 < count).then_some(from + 1),
                (false, false) => from.checked_sub(1),
            }
        };
        let walk = |forward: bool| -> Vec<Vec2> {
            let mut found = Vec::new();
            let (mut at, mut length) = (i, 0.0);
            while let Some(next) = step(at, forward) {
                length += (self.points[next] - self.points[at]).norm();
                // A closed line shorter than the window must not be traversed twice.
                if length > reach || found.len() >= count / 2 {
                    break;
                }
                found.push(self.points[next]);
                at = next;
            }
            found
        };
        let mut window = walk(false);
        window.reverse();
        window.push(self.points[i]);
        window.extend(walk(true));
        window
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interface_of_a_level_is_the_disc_and_a_hole_that_was_smoothed() {
        const H: f64 = 0.15;
        let level = f64::midpoint(1.0, (1.0 - 4.0 * LINE_MOMENT * H * H).sqrt());
        let arc = |from: usize, to: usize| (from..to).map(|i| std::f64::consts::TAU * i as f64 / 200.0);
        let points = |from, to| arc(from, to).map(|t| level * Vec2::new(t.cos(), t.sin())).collect::<Vec<_>>();
        let mut hole = points(0, 200);
        hole.reverse();
        let lines = [
            Polyline { points: points(0, 200), closed: true },
            Polyline { points: hole, closed: true },
            Polyline { points: points(0, 100), closed: false },
        ];
        for line in lines {
            let radii: Vec<f64> = line.on_interface(H).points.iter().map(|x| x.norm()).collect();
            assert!(radii.iter().all(|r| (r - 1.0).abs() < 1e-5), "{radii:?}");
        }
        let single = Polyline { points: vec![Vec2::x()], closed: false };
        assert_eq!(single.on_interface(H), single);
    }
}
