//! Velocity profiles over the openings that solids leave of a side.

/// A piece of a side between solids, along the side in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opening {
    /// Lower end in m.
    pub from: f64,
    /// Upper end in m.
    pub to: f64,
}

/// Form of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// The same velocity everywhere.
    Plug,
    /// A parabola that vanishes at both ends of the opening.
    Parabola,
    /// Half a parabola, with its top on a mirror at the lower or the upper end.
    HalfParabola {
        /// Whether the mirror is at the upper end.
        mirror_above: bool,
    },
}

/// Velocity inwards along a side.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Mean velocity over the openings in m/s.
    pub mean: f64,
    /// Form.
    pub shape: Shape,
    /// The openings; one where the form is a parabola.
    pub openings: Vec<Opening>,
}

impl Profile {
    /// Velocity inwards in m/s at the coordinate `y` (m) along the side, zero outside of the openings.
    #[must_use]
    pub fn at(&self, y: f64) -> f64 {
        let Some(opening) = self.openings.iter().find(|o| (o.from..=o.to).contains(&y)) else { return 0.0 };
        let share = (y - opening.from) / (opening.to - opening.from);
        self.mean
            * match self.shape {
                Shape::Plug => 1.0,
                Shape::Parabola => 6.0 * share * (1.0 - share),
                Shape::HalfParabola { mirror_above: true } => 1.5 * (1.0 - (1.0 - share).powi(2)),
                Shape::HalfParabola { mirror_above: false } => 1.5 * (1.0 - share.powi(2)),
            }
    }

    /// Area that comes in per time in m²/s.
    #[must_use]
    pub fn flow_rate(&self) -> f64 {
        self.mean * self.openings.iter().map(|o| o.to - o.from).sum::<f64>()
    }
}

/// Bisections of an end of an opening: to rounding.
const BISECTIONS: usize = 60;

/// The openings between `from` and `to` (m), where `is_open` holds, looked for at steps of `step` (m).
#[must_use]
pub fn openings(from: f64, to: f64, step: f64, is_open: impl Fn(f64) -> bool) -> Vec<Opening> {
    let count = ((to - from) / step).ceil().max(1.0) as usize;
    let place = |i: usize| from + (to - from) * (i as f64 + 0.5) / count as f64;
    let edge = |mut closed: f64, mut open: f64| {
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (closed + open);
            if is_open(middle) { open = middle } else { closed = middle }
        }
        open
    };
    let mut found: Vec<Opening> = Vec::new();
    let mut last = (from, false);
    for i in 0..count {
        let (y, open) = (place(i), is_open(place(i)));
        match (last.1, open) {
            (false, true) => {
                let lower = if i == 0 && is_open(from) { from } else { edge(last.0, y) };
                found.push(Opening { from: lower, to: y });
            }
            (true, false) => {
                if let Some(opening) = found.last_mut() {
                    opening.to = edge(y, last.0);
                }
            }
            _ => {}
        }
        last = (y, open);
    }
    if let (true, Some(opening)) = (last.1, found.last_mut()) {
        opening.to = if is_open(to) { to } else { edge(to, last.0) };
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn openings_end_where_solids_begin() {
        let is_open = |y: f64| (0.1..0.3).contains(&y) || y > 0.55;
        let found = openings(0.0, 1.0, 0.02, is_open);
        assert_eq!(found.len(), 2);
        for (place, wanted) in [(found[0].from, 0.1), (found[0].to, 0.3), (found[1].from, 0.55), (found[1].to, 1.0)] {
            assert!((place - wanted).abs() < 1e-12, "{place}, wanted {wanted}");
        }
    }

    #[test]
    fn every_profile_carries_its_mean_velocity() {
        let opening = Opening { from: 1.0, to: 3.0 };
        for shape in [
            Shape::Plug,
            Shape::Parabola,
            Shape::HalfParabola { mirror_above: true },
            Shape::HalfParabola { mirror_above: false },
        ] {
            let profile = Profile { mean: 0.7, shape, openings: vec![opening] };
            let n = 1000;
            let sum: f64 = (0..n).map(|i| profile.at(1.0 + 2.0 * (f64::from(i) + 0.5) / f64::from(n))).sum();
            // The midpoint rule is exact to second order for a parabola.
            assert!((2.0 * sum / f64::from(n) / profile.flow_rate() - 1.0).abs() < 1e-6, "{shape:?}");
            assert_eq!(profile.at(0.9), 0.0);
        }
    }
}
