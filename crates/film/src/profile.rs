//! Quantities derived from a profile h̄(x): the contact line by the tangent construction, heights, distances between profiles.

use meniscus_geometry::analysis::convergence::slope;

/// A maximum below this fraction of the highest does not count as a droplet.
const PEAK: f64 = 0.05;

/// h̄ and two derivatives at equidistant, ascending positions.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Profile {
    /// Positions.
    pub x: Vec<f64>,
    /// h̄.
    pub height: Vec<f64>,
    /// h̄ₓ.
    pub slope: Vec<f64>,
    /// h̄ₓₓ.
    pub curvature: Vec<f64>,
}

/// The advancing edge of a droplet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLine {
    /// Intersection of the tangent at the steepest point with the wall: the contact line.
    pub position: f64,
    /// The steepest point y*.
    pub steepest: f64,
    /// |h̄ₓ| there: the slope of the apparent contact angle.
    pub slope: f64,
}

impl Profile {
    /// The contact line on the right by the tangent at the steepest point, y* = argmax(−h̄ₓ) over x > `from` [Pang2022, Sect. 4]. It is y* + h̄/|h̄ₓ|.
    ///
    /// The paper's text names the maximum of h̄, where the tangent is horizontal; the steepest point is meant. The position is stationary in y*, so that a
    /// parabola through three slopes gives it with an error of fourth order in their spacing.
    pub fn contact_line(&self, from: f64) -> Option<ContactLine> {
        let right = (1..self.x.len().saturating_sub(1)).filter(|&i| self.x[i] > from);
        let i = right.min_by(|&i, &j| self.slope[i].total_cmp(&self.slope[j]))?;
        let step = self.x[i + 1] - self.x[i];
        let (before, here, after) = (self.slope[i - 1], self.slope[i], self.slope[i + 1]);
        let bend = before - 2.0 * here + after;
        let offset = if bend > 0.0 { (0.5 * (before - after) / bend).clamp(-1.0, 1.0) } else { 0.0 };
        let slope = here + 0.25 * (after - before) * offset;
        let d = offset * step;
        let height = self.height[i] + here * d + 0.25 * (after - before) / step * d * d;
        let steepest = self.x[i] + d;
        (slope < 0.0).then(|| ContactLine { position: steepest - height / slope, steepest, slope: -slope })
    }

    /// Number of droplets: maxima above a twentieth of the highest.
    pub(crate) fn peaks(&self) -> usize {
        let least = PEAK * self.height.iter().copied().fold(0.0, f64::max);
        let h = &self.height;
        // An axisymmetric film has its maximum at the first point.
        let rises = |i: usize| i == 0 || h[i] > h[i - 1];
        let falls = |i: usize| i + 1 == h.len() || h[i] >= h[i + 1];
        (0..h.len()).filter(|&i| h[i] > least && rises(i) && falls(i)).count()
    }

    /// ∫ |h̄ − f| dx by the trapezoidal rule.
    pub fn distance_to(&self, f: impl Fn(f64) -> f64) -> f64 {
        let off: Vec<f64> = self.x.iter().zip(&self.height).map(|(&x, h)| (h - f(x)).abs()).collect();
        self.x.windows(2).zip(off.windows(2)).map(|(x, off)| 0.5 * (x[1] - x[0]) * (off[0] + off[1])).sum()
    }
}

/// The exponent of a power law y ~ t^n by least squares in log t and log y; `None` with fewer than two points.
pub fn exponent(points: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    let logs: Vec<(f64, f64)> =
        points.into_iter().filter(|(t, y)| *t > 0.0 && *y > 0.0).map(|(t, y)| (t.ln(), y.ln())).collect();
    slope(&logs)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// [Pang2022, Sect. 4]
    #[test]
    fn the_foot_of_a_cosine_is_one_quarter_wave_and_one_slope_away() {
        let x: Vec<f64> = (-200..=200).map(|i| 0.01 * f64::from(i) + 0.003).collect();
        let profile = Profile {
            height: x.iter().map(|x| x.cos() + 1.0).collect(),
            slope: x.iter().map(|x| -x.sin()).collect(),
            curvature: x.iter().map(|x| -x.cos()).collect(),
            x,
        };
        let line = profile.contact_line(0.0).unwrap();
        assert!((line.position - std::f64::consts::FRAC_PI_2 - 1.0).abs() < 1.0e-7, "{line:?}");
        assert!((line.slope - 1.0).abs() < 1.0e-8);
    }
}
