//! The shape of the invading phase: width of fingers, length of the interface.

use std::f64::consts::TAU;

use super::Dynamic;
use crate::displacement::{contains, edges};
use crate::model::Configuration;
use meniscus_core::math::{Bounds, Vec2};

/// Number of lines across the flow on which fingers are counted.
const CUTS: usize = 64;

/// Fingers of the invading phase, counted on lines across the flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fingers {
    /// Mean width in m from the first to the last pore of a finger on a line; NaN without fingers.
    pub(crate) width: f64,
    /// Mean number per line that the invading phase has reached.
    pub(crate) count: f64,
}

/// A line across the flow: a straight one, or a circle about the disc that is the inlet.
#[derive(Debug, Clone, Copy)]
enum Line {
    /// At a place along an axis.
    Straight { axis: usize, at: f64 },
    /// About a center.
    Circle { center: Vec2, radius: f64 },
}

impl Line {
    /// The lines of a domain, equally spaced from the inlet to the outlet.
    fn all(config: &Configuration) -> Vec<Self> {
        let share = |cut: usize| (cut as f64 + 0.5) / CUTS as f64;
        let Bounds { min, max } = config.bounds;
        if let Some(disc) = config.inlet_disc {
            let center = Vec2::from(disc.center);
            let free = (center - min).min().min((max - center).min()) - disc.radius;
            return (0..CUTS).map(|cut| Self::Circle { center, radius: disc.radius + share(cut) * free }).collect();
        }
        let axis = config.inlet.map_or(0, |inlet| inlet / 2);
        let at = |cut| min[axis] + share(cut) * (max - min)[axis];
        (0..CUTS).map(|cut| Self::Straight { axis, at: at(cut) }).collect()
    }

    /// Its length in m if it is closed.
    fn period(self) -> Option<f64> {
        match self {
            Self::Straight { .. } => None,
            Self::Circle { radius, .. } => Some(TAU * radius),
        }
    }

    /// Whether it may cross what lies within bounds.
    fn may_cross(self, bounds: &Bounds) -> bool {
        let Bounds { min, max } = bounds;
        match self {
            Self::Straight { axis, at } => min[axis] <= at && at <= max[axis],
            Self::Circle { center, radius } => {
                let farthest = (center - min).abs().sup(&(max - center).abs()).norm();
                (center.sup(min).inf(max) - center).norm() <= radius && radius <= farthest
            }
        }
    }

    /// Its parts within a polygon, as places along it in m.
    fn within(self, outline: &[Vec2]) -> Vec<[f64; 2]> {
        let edges = edges(outline);
        let mut crossings: Vec<f64> = match self {
            Self::Straight { axis, at } => edges
                .filter(|(a, b)| (a[axis] > at) != (b[axis] > at))
                .map(|(a, b)| a[1 - axis] + (at - a[axis]) / (b[axis] - a[axis]) * (b[1 - axis] - a[1 - axis]))
                .collect(),
            Self::Circle { center, radius } => {
                edges.flat_map(|(a, b)| around(a - center, b - center, radius)).flatten().collect()
            }
        };
        crossings.sort_by(f64::total_cmp);
        let pairs = |places: &[f64]| places.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
        let Self::Circle { center, radius } = self else { return pairs(&crossings) };
        let at = |place: f64| center + radius * Vec2::new((place / radius).cos(), (place / radius).sin());
        let (Some(&first), Some(&second)) = (crossings.first(), crossings.get(1)) else {
            return if contains(outline, at(0.0)) { vec![[0.0, TAU * radius]] } else { Vec::new() };
        };
        if !contains(outline, at(0.5 * (first + second))) {
            // It lies within around the beginning of the circle.
            crossings.insert(0, 0.0);
            crossings.push(TAU * radius);
        }
        pairs(&crossings)
    }
}

/// Where an edge crosses a circle about the origin, as places along this from 0 on in m.
fn around(a: Vec2, b: Vec2, radius: f64) -> [Option<f64>; 2] {
    let along = b - a;
    let (square, half, rest) = (along.norm_squared(), a.dot(&along), a.norm_squared() - radius * radius);
    let root = (half * half - square * rest).sqrt();
    [-root, root].map(|root| {
        let share = (root - half) / square;
        // Half open, so that a vertex counts once.
        (0.0..1.0).contains(&share).then(|| {
            let at = a + share * along;
            radius * at.y.atan2(at.x).rem_euclid(TAU)
        })
    })
}

/// The fingers on a line: runs of the invading phase from its first to its last part, solids within counted. `pieces` are the parts in pores and
/// whether they hold the phase; on a closed line of the length `period` a run may pass its beginning.
fn runs(mut pieces: Vec<([f64; 2], bool)>, period: Option<f64>) -> Vec<[f64; 2]> {
    pieces.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    let mut runs: Vec<[f64; 2]> = Vec::new();
    let mut goes_on = false;
    for ([from, to], holds) in pieces.iter().copied() {
        match runs.last_mut().filter(|_| goes_on && holds) {
            Some(run) => run[1] = run[1].max(to),
            None => runs.extend(holds.then_some([from, to])),
        }
        goes_on = holds;
    }
    if let (Some(period), [first, .., last]) = (period, &mut runs[..])
        && goes_on
        && pieces.first().is_some_and(|(_, holds)| *holds)
    {
        first[0] = last[0] - period;
        runs.pop();
    }
    runs
}

impl Dynamic {
    /// Fingers on lines across the direction from inlet to outlet, on circles about a disc. A finger ends at the defending phase; solids in it count.
    pub(crate) fn fingers(&self, config: &Configuration) -> Fingers {
        let outlines = (0..self.displacement.elements().len()).filter_map(|element| {
            let outline = self.displacement.outline(element);
            Some((Bounds::around(outline.iter().copied())?, outline, self.share(element) > 0.5))
        });
        let outlines: Vec<(Bounds, Vec<Vec2>, bool)> = outlines.collect();
        let (mut width, mut fingers, mut lines) = (0.0, 0, 0_usize);
        for line in Line::all(config) {
            let crossed = outlines.iter().filter(|(bounds, ..)| line.may_cross(bounds));
            let pieces =
                crossed.flat_map(|(_, outline, holds)| line.within(outline).into_iter().map(|it| (it, *holds)));
            let runs = runs(pieces.collect(), line.period());
            width = runs.iter().fold(width, |width, [from, to]| width + to - from);
            fingers += runs.len();
            lines += usize::from(!runs.is_empty());
        }
        Fingers { width: width / fingers as f64, count: fingers as f64 / lines as f64 }
    }

    /// Length in m of all menisci before their events.
    pub(crate) fn interface_length(&self) -> f64 {
        self.arcs().map(|arc| arc.curve().length()).sum()
    }
}
