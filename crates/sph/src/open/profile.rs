//! Velocity profiles over the openings between the solids on a side.

/// An interval of a side between solids, along the side in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opening {
    /// Lower end in m.
    pub from: f64,
    /// Upper end in m.
    pub to: f64,
}

impl Opening {
    /// Width in m.
    pub(crate) fn width(&self) -> f64 {
        self.to - self.from
    }

    /// Number of rows of about `spacing` (m) that fit.
    pub fn rows(&self, spacing: f64) -> usize {
        (self.width() / spacing).round() as usize
    }

    /// Distance in m of the coordinate `y` (m) from it, 0 within.
    pub(crate) fn distance(&self, y: f64) -> f64 {
        (self.from - y).max(y - self.to).max(0.0)
    }
}

/// Form of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// The same velocity everywhere.
    Plug,
    /// A parabola that vanishes at both ends of the opening.
    Parabola,
    /// Half a parabola, with its maximum on a mirror at the lower or the upper end.
    HalfParabola {
        /// Whether the mirror is at the upper end.
        mirror_above: bool,
    },
}

impl Shape {
    /// The velocity over its mean at the fraction `s` of the width of the opening.
    fn at(self, s: f64) -> f64 {
        match self {
            Self::Plug => 1.0,
            Self::Parabola => 6.0 * s * (1.0 - s),
            Self::HalfParabola { mirror_above: true } => 1.5 * (1.0 - (1.0 - s).powi(2)),
            Self::HalfParabola { mirror_above: false } => 1.5 * (1.0 - s.powi(2)),
        }
    }

    /// Fraction of the flow up to `s`: ∫ of [`Self::at`] from 0 to `s`.
    fn below(self, s: f64) -> f64 {
        match self {
            Self::Plug => s,
            Self::Parabola => s * s * (3.0 - 2.0 * s),
            Self::HalfParabola { mirror_above: true } => 0.5 * s * s * (3.0 - s),
            Self::HalfParabola { mirror_above: false } => 0.5 * s * (3.0 - s * s),
        }
    }
}

/// Profile of the inward velocity along a side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    /// Mean velocity over the openings in m/s.
    pub mean: f64,
    /// Form.
    pub shape: Shape,
}

impl Profile {
    /// Inward velocity in m/s at the coordinate `y` (m) in an `opening`.
    pub(crate) fn at(&self, opening: &Opening, y: f64) -> f64 {
        self.mean * self.shape.at((y - opening.from) / opening.width())
    }

    /// The mean in m/s over the row at `y` (m) of `rows` equal ones that fill the `opening`: together they have the flow rate of the profile.
    pub(crate) fn of_row(&self, opening: &Opening, rows: usize, y: f64) -> f64 {
        let rows = rows.max(1) as f64;
        let row = (rows * (y - opening.from) / opening.width()).floor().clamp(0.0, rows - 1.0);
        self.mean * rows * (self.shape.below((row + 1.0) / rows) - self.shape.below(row / rows))
    }
}

/// Bisections for an end of an opening, enough for machine precision.
const BISECTIONS: usize = 60;

/// The openings between `from` and `to` (m), where `is_open` holds, searched in steps of `step` (m).
pub(crate) fn openings(from: f64, to: f64, step: f64, is_open: impl Fn(f64) -> bool) -> Vec<Opening> {
    let count = ((to - from) / step).ceil().max(1.0) as usize;
    let center = |i: usize| from + (to - from) * (i as f64 + 0.5) / count as f64;
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
        let (y, open) = (center(i), is_open(center(i)));
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
        for (end, wanted) in [(found[0].from, 0.1), (found[0].to, 0.3), (found[1].from, 0.55), (found[1].to, 1.0)] {
            assert!((end - wanted).abs() < 1e-12, "{end}, wanted {wanted}");
        }
    }

    #[test]
    fn every_profile_has_its_mean_velocity_and_however_few_rows_bring_its_flow() {
        let opening = Opening { from: -0.3, to: 1.1 };
        for shape in [
            Shape::Plug,
            Shape::Parabola,
            Shape::HalfParabola { mirror_above: true },
            Shape::HalfParabola { mirror_above: false },
        ] {
            let profile = Profile { mean: 0.7, shape };
            let mean = |parts: u32, velocity: &dyn Fn(f64) -> f64| {
                let middle = |i: u32| opening.from + opening.width() * (f64::from(i) + 0.5) / f64::from(parts);
                (0..parts).map(|i| velocity(middle(i))).sum::<f64>() / f64::from(parts)
            };
            // The midpoint rule is exact to second order for a parabola.
            assert!((mean(1000, &|y| profile.at(&opening, y)) / 0.7 - 1.0).abs() < 1e-6, "{shape:?}");
            for rows in 1..12 {
                let of_rows = mean(rows, &|y| profile.of_row(&opening, rows as usize, y));
                assert!((of_rows / 0.7 - 1.0).abs() < 1e-14, "{shape:?}, {rows} rows");
            }
        }
    }
}
