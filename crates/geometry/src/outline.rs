//! The visible walls: the united solid surface within the domain, as lines for output and as a length.

use std::borrow::Cow;

use crate::body::{Body, Location};
use crate::boundary::{Piece, chains, followers, split};
use crate::curve::Curve;
use crate::solid::Geometry;
use meniscus_core::snapshot::{Field, Lines, Values};
use rayon::prelude::*;

/// Angle between neighboring vertices of a finely drawn arc, in rad: 1 degree, chords within 4e-5 of the radius.
const FINE_ANGLE: f64 = std::f64::consts::PI / 180.0;

/// Largest angle between neighboring vertices of a drawn arc, in rad: 15 degrees, so that a circle of any size looks like one.
const COARSE_ANGLE: f64 = std::f64::consts::PI / 12.0;

impl Geometry {
    /// The surface of the united solid within the domain, circles finely sampled, with the field `shape`.
    pub fn outline(&self) -> Lines<'static> {
        self.outline_within(0.0)
    }

    /// The same with chords within `error` (m) of their arcs, but angles between vertices of 1 to 15 degrees.
    pub fn outline_within(&self, error: f64) -> Lines<'static> {
        let pieces = self.visible_pieces();
        let next = followers(&pieces, 10.0 * self.tolerance());
        let (mut points, mut shapes, mut lines) = (Vec::new(), Vec::new(), Vec::new());
        for (chain, is_closed) in chains(&pieces, &next) {
            let begin = points.len() as u32;
            for &i in &chain {
                for u in samples(&pieces[i].curve, error) {
                    points.push(pieces[i].curve.point(u));
                    shapes.push(i64::from(pieces[i].shape));
                }
            }
            if let Some(&last) = chain.last().filter(|_| !is_closed) {
                points.push(pieces[last].curve.point(1.0));
                shapes.push(i64::from(pieces[last].shape));
            }
            let mut line: Vec<u32> = (begin..points.len() as u32).collect();
            if is_closed {
                line.push(begin);
            }
            lines.push(line);
        }
        let shape = Field { name: "shape", unit: "", values: Values::Integer(Cow::Owned(shapes)) };
        Lines { points: Cow::Owned(points), lines, fields: vec![shape] }
    }

    /// Length of the walls within the domain in m, walls on its sides included.
    pub fn wall_length(&self) -> f64 {
        self.visible_pieces().iter().map(|piece| piece.curve.length()).sum()
    }

    /// The parts of the surface within the domain or on its sides.
    pub(crate) fn visible_pieces(&self) -> Vec<Piece> {
        let frame = Body::of_box(u32::MAX, self.bounds());
        let is_visible = |curve: &Curve| frame.locate(curve.point(0.5), self.tolerance()) != Location::Out;
        let parts = |piece: &Piece| {
            let shape = piece.shape;
            let parts = split(&piece.curve, frame.curves.iter(), self.tolerance()).into_iter();
            parts.filter(is_visible).map(move |curve| Piece { curve, shape })
        };
        self.boundary.pieces.par_iter().flat_map_iter(parts).collect()
    }
}

/// Parameters of the vertices of a curve whose chords lie within `error` (m) of it, without its end.
fn samples(curve: &Curve, error: f64) -> impl Iterator<Item = f64> + use<> {
    let count = match *curve {
        Curve::Segment { .. } => 1,
        Curve::Arc { radius, sweep, .. } => {
            // Sagitta of a chord of this angle: radius (1 − cos(angle/2)).
            let angle = 2.0 * (1.0 - error / radius).clamp(-1.0, 1.0).acos();
            (sweep.abs() / angle.clamp(FINE_ANGLE, COARSE_ANGLE)).ceil().max(1.0) as usize
        }
    };
    (0..count).map(move |k| k as f64 / count as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::math::Vec2;

    #[test]
    fn chords_lie_within_the_error_asked_for_and_no_denser_than_a_degree() {
        for (error, count) in [(0.0, 360), (1e-3, 71), (10.0, 24)] {
            let circle = Curve::circle(Vec2::zeros(), 1.0);
            let parameters: Vec<f64> = samples(&circle, error).collect();
            assert_eq!(parameters.len(), count);
            let middle = 0.5 * (circle.point(parameters[0]) + circle.point(parameters[1]));
            assert!(1.0 - middle.norm() <= error.max(4e-5));
        }
    }
}
