//! Contours as output sees them: lines with the curvature on their vertices.

use std::borrow::Cow;

use super::contour::Polyline;
use crate::snapshot::{Field, Lines, Values};

/// `contours` with their curvature in 1/m, from circles fitted within `reach` (m) along the line.
///
/// The curvature is NaN where a line is too short for a fit.
#[must_use]
pub fn with_curvature(contours: &[Polyline], reach: f64) -> Lines<'static> {
    let curvature: Vec<f64> = contours.iter().flat_map(|line| line.curvature(reach)).collect();
    let mut points = Vec::with_capacity(curvature.len());
    let mut lines = Vec::with_capacity(contours.len());
    for contour in contours {
        let first = points.len() as u32;
        points.extend_from_slice(&contour.points);
        let closing = (contour.closed && !contour.points.is_empty()).then_some(first);
        lines.push((first..points.len() as u32).chain(closing).collect());
    }
    let field = Field { name: "curvature", unit: "1/m", values: Values::Scalar(Cow::Owned(curvature)) };
    Lines { points: Cow::Owned(points), lines, fields: vec![field] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec2;

    #[test]
    fn a_closed_line_repeats_its_first_vertex_and_an_open_one_does_not() {
        let corner = |x: f64, y: f64| Vec2::new(x, y);
        let closed = Polyline { points: vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)], closed: true };
        let open = Polyline { points: vec![corner(2.0, 0.0), corner(3.0, 0.0)], closed: false };
        let lines = with_curvature(&[closed, open], 1.0);
        assert_eq!(lines.lines, vec![vec![0, 1, 2, 0], vec![3, 4]]);
        assert_eq!(lines.points.len(), 5);
        assert!(matches!(&lines.fields[0].values, Values::Scalar(values) if values.len() == 5));
    }
}
