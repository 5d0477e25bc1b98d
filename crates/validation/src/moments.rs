//! Center and second moments of a drop or bubble: its position, deformation and extent along the axes.

use std::f64::consts::TAU;

use meniscus_core::math::{Mat2, Vec2};
use meniscus_sph::flow::Flow;
use meniscus_sph::particles::Phase;

/// Moments of an area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Moments {
    /// Center in m.
    pub(crate) center: Vec2,
    /// Mean of (x - center)(x - center)ᵀ in m².
    pub(crate) second: Mat2,
}

impl Moments {
    /// Of `points` (m), each of the same area; NaN without points.
    pub(crate) fn of(points: &[Vec2]) -> Self {
        let count = points.len() as f64;
        let center = points.iter().sum::<Vec2>() / count;
        let second = points.iter().map(|x| (x - center) * (x - center).transpose()).sum::<Mat2>() / count;
        Self { center, second }
    }

    /// Of the wetting phase of a flow.
    pub(crate) fn of_wetting_phase(flow: &Flow) -> Self {
        Self::of(&wetting_points(flow))
    }

    /// (L_x - L_y)/(L_x + L_y) with the lengths along x and y of the ellipse that has these moments.
    pub(crate) fn elongation(&self) -> f64 {
        relative_difference(self.second[(0, 0)].sqrt(), self.second[(1, 1)].sqrt())
    }

    /// (L - B)/(L + B) with length and breadth of the ellipse that has these moments, along its principal axes.
    pub(crate) fn deformation(&self) -> f64 {
        let axes = self.second.symmetric_eigenvalues();
        relative_difference(axes.max().max(0.0).sqrt(), axes.min().max(0.0).sqrt())
    }
}

fn relative_difference(a: f64, b: f64) -> f64 {
    (a - b) / (a + b)
}

/// Positions in m of the wetting particles, unwrapped across periodic sides: correct for drops smaller than a period.
fn wetting_points(flow: &Flow) -> Vec<Vec2> {
    let fluids = flow.state.particles.fluids;
    let wetting = |a: &usize| flow.state.particles.phase[*a] == Phase::Wetting;
    let inside: Vec<Vec2> = (0..fluids).filter(wetting).map(|a| flow.state.particles.position[a]).collect();
    let middle = Vec2::from_fn(|axis, _| match flow.config.domain.periods()[axis] {
        Some(period) => mean_on_circle(inside.iter().map(|x| x[axis]), period),
        None => 0.0,
    });
    // Points of a drop wider than half a period are still within half a period of its center.
    inside.into_iter().map(|x| middle + flow.config.domain.separation(x, middle)).collect()
}

/// The circular mean of coordinates with the given `period`, in m.
fn mean_on_circle(coordinates: impl Iterator<Item = f64>, period: f64) -> f64 {
    let (sine, cosine) = coordinates.fold((0.0, 0.0), |(sine, cosine), x| {
        let angle = TAU * x / period;
        (sine + angle.sin(), cosine + angle.cos())
    });
    sine.atan2(cosine) / TAU * period
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_geometry::interface::lattice::Lattice;

    /// Lattice points in the ellipse with semi-axes 1.2 and 0.8, rotated by `turn` (rad).
    fn ellipse(turn: f64) -> Vec<Vec2> {
        let mut points = Lattice::open(Vec2::repeat(-1.5), Vec2::repeat(0.01), [301, 301]).nodes();
        points.retain(|x| {
            let (c, s) = (turn.cos(), turn.sin());
            let (u, v) = (c * x.x + s * x.y, c * x.y - s * x.x);
            (u / 1.2).powi(2) + (v / 0.8).powi(2) < 1.0
        });
        points
    }

    #[test]
    fn the_deformation_of_an_ellipse_does_not_depend_on_its_turn() {
        // The staircase boundary of the lattice changes the moments by some hundredths of a spacing.
        for turn in [0.0, 0.4, 1.2] {
            let moments = Moments::of(&ellipse(turn));
            assert!((moments.deformation() - 0.2).abs() < 1e-3, "{turn}: {moments:?}");
            assert!(moments.center.norm() < 1e-3);
        }
    }

    #[test]
    fn the_elongation_has_a_sign() {
        let quarter = std::f64::consts::FRAC_PI_2;
        assert!((Moments::of(&ellipse(0.0)).elongation() - 0.2).abs() < 1e-3);
        assert!((Moments::of(&ellipse(quarter)).elongation() + 0.2).abs() < 1e-3);
    }

    #[test]
    fn the_mean_on_a_circle_lies_in_the_middle_of_a_part_across_the_seam() {
        // From 0.8 across the seam at 1 to 0.4: more than half of the period 1.
        let part = (0..=60).map(|i| (0.8 + 0.01 * f64::from(i)).rem_euclid(1.0));
        let mean = mean_on_circle(part, 1.0);
        assert!((mean - 0.1).abs() < 1e-12, "{mean}");
    }
}
