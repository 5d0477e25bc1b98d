//! The shape of the invading phase: width of fingers, length of the interface.

use super::Dynamic;
use crate::model::Configuration;
use meniscus_core::math::Vec2;

/// Lines across the flow on which fingers are counted.
const CUTS: usize = 64;

/// Fingers of the invading phase, counted on lines across the flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fingers {
    /// Mean width in m from the first to the last pore of a finger on a line; NaN without fingers.
    pub(crate) width: f64,
    /// Mean number per line that the invading phase has reached.
    pub(crate) count: f64,
}

impl Dynamic {
    /// Fingers on lines across the direction from inlet to outlet. A finger ends at the defending phase; solids in it count.
    pub(crate) fn fingers(&self, config: &Configuration) -> Fingers {
        let axis = config.inlet.map_or(0, |inlet| inlet / 2);
        let (low, size) = (config.bounds.min[axis], config.bounds.size()[axis]);
        let (mut widths, mut fingers, mut lines) = (0.0, 0, 0);
        let outlines: Vec<(&[Vec2], bool, [f64; 2])> = (0..self.displacement.elements().len())
            .map(|element| {
                let outline = self.displacement.elements()[element].outline.as_slice();
                let ends = outline
                    .iter()
                    .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x[axis]), b.max(x[axis])]);
                (outline, self.share(element) > 0.5, ends)
            })
            .collect();
        for cut in 0..CUTS {
            let at = low + size * (cut as f64 + 0.5) / CUTS as f64;
            let mut pieces: Vec<([f64; 2], bool)> = outlines
                .iter()
                .filter(|(_, _, [from, to])| *from <= at && at <= *to)
                .flat_map(|(outline, invaded, _)| pieces(outline, axis, at).into_iter().map(|piece| (piece, *invaded)))
                .collect();
            pieces.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
            let before = fingers;
            let mut last: Option<[f64; 2]> = None;
            for (piece, invaded) in pieces {
                last = match (last, invaded) {
                    (Some([from, to]), true) => Some([from, to.max(piece[1])]),
                    (None, true) => Some(piece),
                    (Some([from, to]), false) => {
                        (widths, fingers) = (widths + to - from, fingers + 1);
                        None
                    }
                    (None, false) => None,
                };
            }
            if let Some([from, to]) = last {
                (widths, fingers) = (widths + to - from, fingers + 1);
            }
            lines += usize::from(fingers > before);
        }
        Fingers { width: widths / fingers as f64, count: fingers as f64 / lines as f64 }
    }

    /// Length in m of all menisci before their events.
    pub(crate) fn interface_length(&self) -> f64 {
        self.arcs().map(|arc| arc.curve().length()).sum()
    }
}

/// The segments of the line at `at` across `axis` within a polygon.
fn pieces(outline: &[Vec2], axis: usize, at: f64) -> Vec<[f64; 2]> {
    let mut crossings: Vec<f64> = (0..outline.len())
        .filter_map(|k| {
            let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
            ((a[axis] > at) != (b[axis] > at)).then(|| {
                let share = (at - a[axis]) / (b[axis] - a[axis]);
                a[1 - axis] + share * (b[1 - axis] - a[1 - axis])
            })
        })
        .collect();
    crossings.sort_by(f64::total_cmp);
    crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
}
