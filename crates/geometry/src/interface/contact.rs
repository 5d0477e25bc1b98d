//! Contact angles: the shape of a static meniscus fitted to the c = 0.5 contour away from the wall and extrapolated to the wall.
//!
//! The shape is a circle, or under a body force the arc of the Young-Laplace equation ([`arc`](super::arc)). Vertices nearer to the wall than the exclusion
//! distance (2h, down to h for short menisci) are left out, since the wall distorts the smoothed color there; particle normals are never used. One fit serves
//! both contact lines of a meniscus, unless a window limits it to the part next to each. The angle is measured through the phase on the left of the contour
//! (the wetting one). A shape that passes the wall within the exclusion distance is taken as tangent to it: 0 or 180 degrees.
//!
//! The standard uncertainty of an angle has three contributions: the scatter of the contour about the shape; the choice of the exclusion distance, half the
//! spread between fits with other distances; and the accuracy of the contour, as if its ends were displaced by [`ACCURACY`].

use nalgebra::{Matrix3, Vector3};

use super::arc::Arc;
use super::circle;
use super::polyline::Polyline;
use super::wall::{WallPoint, face_beside, is_edge_between};
use meniscus_core::math::{Vec2, halved};

/// Settings of the fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSettings {
    /// Vertices nearer to the wall than this are left out, in m; 2h.
    pub exclusion: f64,
    /// An open contour ends on the wall if its end is nearer to it than this, in m.
    pub reach: f64,
    /// Only vertices within this arc length from the first one used are fitted, in m; infinite: the whole meniscus.
    pub window: f64,
    /// Δρ g/σ in 1/m², Δρ the density of the wetting minus that of the other phase.
    pub force: Vec2,
    /// Systematic displacement of the contour from the interface, in m.
    pub accuracy: f64,
}

/// Displacement of a contour from the interface beyond its scatter, over h. Calibrated: docs/numerics/error-bars.md.
pub const ACCURACY: f64 = 0.015;

/// Upper bound of the exclusion distance over the length of a meniscus: five sixths of a short one are kept. The distance is at least half of that of long
/// menisci.
const LARGEST_SHARE: f64 = 1.0 / 12.0;

/// Upper bound of the exclusion distance over the largest distance of the meniscus from walls: low puddles bend near the wall only.
const LARGEST_SHARE_OF_HEIGHT: f64 = 1.0 / 3.0;

/// Under a body force this many capillary lengths of a meniscus are fitted, from its end.
const CAPILLARY_LENGTHS: f64 = 4.0;

/// Factors of the exclusion distance for the fits that estimate the uncertainty of its choice.
const OTHER_EXCLUSIONS: [f64; 2] = [0.5, 1.5];

impl ContactSettings {
    /// The settings for a smoothing length in m: 2h left out, ends within 3h of the wall, whole menisci, no body force.
    pub fn for_smoothing_length(h: f64) -> Self {
        let window = f64::INFINITY;
        Self { exclusion: 2.0 * h, reach: 3.0 * h, window, force: Vec2::zeros(), accuracy: ACCURACY * h }
    }

    /// The same under the body force Δρ g/σ (1/m²).
    pub fn under(self, force: Vec2) -> Self {
        Self { force, ..self }
    }

    /// The same for a meniscus of the `length` (m) whose largest distance from walls is `height` (m).
    fn for_size(self, length: f64, height: f64) -> Self {
        // Farther from its end a puddle carries no information, and integration of the arc becomes unstable.
        let window = self.window.min(CAPILLARY_LENGTHS / self.force.norm().sqrt());
        Self {
            window,
            exclusion: (LARGEST_SHARE * length)
                .min(LARGEST_SHARE_OF_HEIGHT * height)
                .clamp(0.5 * self.exclusion, self.exclusion),
            ..self
        }
    }
}

/// On which side of the contact line the wetting phase touches the wall, looking from the wall into the pore.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WettingSide {
    /// On the left: the contour begins here.
    Left,
    /// On the right: the contour ends here.
    Right,
}

/// Why a contact line has no angle.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ContactProblem {
    /// The meniscus is too short for a fit.
    #[error("only {found} contour points are farther than {exclusion:.3e} m from the wall, {LEAST_POINTS} are needed")]
    TooFewPoints {
        /// Number of points beyond the exclusion distance.
        found: usize,
        /// The exclusion distance in m.
        exclusion: f64,
    },
    /// The points do not determine a circle.
    #[error("no circle fits the contour: {0}")]
    NoCircle(#[from] circle::CircleError),
    /// The fitted shape misses the wall.
    #[error("the fitted meniscus does not meet the wall")]
    NoIntersection,
}

/// A contact line: in the plane, a point on the wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLine {
    /// Where the fitted meniscus meets the wall, in m; the end of the contour where it does not.
    pub position: Vec2,
    /// Angle through the wetting phase in degrees, NaN if it could not be determined.
    pub angle_deg: f64,
    /// Standard uncertainty of the angle in degrees.
    pub uncertainty_deg: f64,
    /// Curvature in 1/m in the middle of the fitted points, positive where the wetting phase is convex.
    pub curvature: f64,
    /// Standard uncertainty of the curvature in 1/m.
    pub curvature_uncertainty: f64,
    /// Where the wetting phase is.
    pub side: WettingSide,
    /// Index of the contour.
    pub contour: usize,
    /// Why there is no angle.
    pub problem: Option<ContactProblem>,
}

/// An arc that passes an edge at less than this times the exclusion distance ends there.
const GRAZE: f64 = 0.2;

/// An arc whose smallest distance from a wall is below this times the exclusion distance is tangent to the wall.
const MISSED: f64 = 0.5;

/// Longest extrapolation over the exclusion distance: an arc that leaves the band at 10 degrees crosses it over six times its width.
const LONGEST: f64 = 20.0;

/// Minimum number of fitted points: twice the number of unknowns.
pub(crate) const LEAST_POINTS: usize = 6;

/// The contact lines of `contours`: both ends of each open contour that end on the wall.
///
/// Ends away from walls (at an open boundary, or at the seam of a periodic one) are not contact lines.
pub fn contact_lines(
    contours: &[Polyline],
    wall: &dyn Fn(Vec2) -> WallPoint,
    settings: &ContactSettings,
) -> Vec<ContactLine> {
    let mut lines = Vec::new();
    for (contour, line) in contours.iter().enumerate().filter(|(_, line)| !line.closed && line.points.len() > 1) {
        let distances: Vec<f64> = line.points.iter().map(|&p| wall(p).distance).collect();
        let height = distances.iter().copied().fold(0.0, f64::max);
        let settings = settings.for_size(line.length(), height);
        for side in [WettingSide::Left, WettingSide::Right] {
            let end = if side == WettingSide::Left { 0 } else { line.points.len() - 1 };
            if distances[end] < settings.reach {
                let with = |exclusion: f64| {
                    let settings = ContactSettings { exclusion, ..settings };
                    measure(fitted_points(line, &distances, side, &settings), side, wall, &settings)
                };
                lines.push(match with(settings.exclusion) {
                    Ok(found) => {
                        let others = OTHER_EXCLUSIONS.map(|factor| with(factor * settings.exclusion));
                        let off = others.iter().flatten().map(|other| other.angle_deg - found.angle_deg);
                        let by_choice = 0.5 * off.fold(0.0, |largest: f64, off| largest.max(off.abs()));
                        ContactLine { contour, uncertainty_deg: found.uncertainty_deg.hypot(by_choice), ..found }
                    }
                    Err(problem) => unmeasured(line.points[end], side, contour, problem),
                });
            }
        }
    }
    lines
}

fn unmeasured(position: Vec2, side: WettingSide, contour: usize, problem: ContactProblem) -> ContactLine {
    let nan = f64::NAN;
    let problem = Some(problem);
    ContactLine {
        position,
        angle_deg: nan,
        uncertainty_deg: nan,
        curvature: nan,
        curvature_uncertainty: nan,
        side,
        contour,
        problem,
    }
}

/// The vertices beyond the exclusion distance next to one end, limited to the window.
pub(super) fn fitted_points<'a>(
    line: &'a Polyline,
    distances: &[f64],
    side: WettingSide,
    settings: &ContactSettings,
) -> &'a [Vec2] {
    let away = |i: &usize| distances[*i] > settings.exclusion;
    let count = line.points.len();
    let walk: Vec<usize> = match side {
        WettingSide::Left => (0..count).collect(),
        WettingSide::Right => (0..count).rev().collect(),
    };
    let run: Vec<usize> = walk.into_iter().skip_while(|i| !away(i)).take_while(away).collect();
    let mut arc_length = 0.0;
    let within = run.windows(2).take_while(|w| {
        arc_length += (line.points[w[1]] - line.points[w[0]]).norm();
        arc_length <= settings.window
    });
    let used = within.count() + 1;
    match (run.first(), run.get(used - 1)) {
        (Some(&first), Some(&last)) => &line.points[first.min(last)..=first.max(last)],
        _ => &[],
    }
}

fn measure(
    points: &[Vec2],
    side: WettingSide,
    wall: &dyn Fn(Vec2) -> WallPoint,
    settings: &ContactSettings,
) -> Result<ContactLine, ContactProblem> {
    let (found, exclusion) = (points.len(), settings.exclusion);
    if found < LEAST_POINTS {
        return Err(ContactProblem::TooFewPoints { found, exclusion });
    }
    let arc = Arc::fit(points, settings.force, LONGEST * exclusion)?;
    let from = if side == WettingSide::Left { points[0] } else { points[found - 1] };
    let angle_of = |arc: &Arc| {
        let position = meet(arc, from, side, wall, exclusion)?;
        // An interface at an edge makes its angle with the face that the wetting phase covers.
        let normal = face_beside(wall, position, side == WettingSide::Left, exclusion);
        Some((position, angle(arc.normal_at(position), normal)))
    };
    let (position, theta) = angle_of(&arc).ok_or(ContactProblem::NoIntersection)?;
    // Displacement by the accuracy: the ends against the middle, the ends in opposite directions, and all points together.
    let length = (points[found - 1] - points[0]).norm();
    let accuracy = settings.accuracy * Vector3::new(8.0 / (length * length), 2.0 / length, 1.0);
    let covariance = arc.middle.covariance + Matrix3::from_diagonal(&accuracy.component_mul(&accuracy));
    // Near 0 and 180 degrees the angle varies as the square root of small changes: each parameter is changed by its standard error in both directions.
    let mut slope = Vector3::zeros();
    for k in 0..3 {
        let step = covariance[(k, k)].max(0.0).sqrt();
        let mut change = Vector3::zeros();
        change[k] = step;
        let [ahead, behind] = [change, -change].map(|by| angle_of(&arc.perturbed(by)).map_or(theta, |(_, a)| a));
        let larger = if (ahead - theta).abs() > (behind - theta).abs() { ahead - theta } else { theta - behind };
        slope[k] = if step > 0.0 { larger / step } else { 0.0 };
    }
    let variance = (slope.transpose() * covariance * slope)[(0, 0)];
    Ok(ContactLine {
        position,
        angle_deg: theta.to_degrees(),
        uncertainty_deg: variance.max(0.0).sqrt().to_degrees(),
        curvature: arc.middle.curvature,
        curvature_uncertainty: covariance[(0, 0)].max(0.0).sqrt(),
        side,
        contour: 0,
        problem: None,
    })
}

/// Angle in rad between interface and wall, from the normals into the wetting phase and into the pore.
fn angle(into_wetting: Vec2, into_pore: Vec2) -> f64 {
    // cos = -n.e; the two-argument arctangent keeps its accuracy near 0 and 180 degrees.
    into_wetting.perp(&into_pore).abs().atan2(-into_wetting.dot(&into_pore))
}

/// Follows the arc from the vertex `from` towards the wall until the wall distance is zero, past an edge, or to its point nearest to a wall that it misses.
fn meet(arc: &Arc, from: Vec2, side: WettingSide, wall: &dyn Fn(Vec2) -> WallPoint, exclusion: f64) -> Option<Vec2> {
    let direction = if side == WettingSide::Left { -1.0 } else { 1.0 };
    // A contact line is at most half the circle away.
    let longest = (LONGEST * exclusion).min(std::f64::consts::PI / arc.curvature_at(from).abs());
    let at = |arc_length: f64| arc.walk(from, direction * arc_length);
    let distance = |arc_length: f64| wall(at(arc_length)).distance;
    // The wall is never nearer than its distance, so steps of that length cannot cross it; the minimum step crosses in the end.
    let least = 1e-3 * exclusion;
    let (mut before, mut arc_length, mut last, mut nearest) = (0.0, 0.0, f64::INFINITY, (f64::INFINITY, 0.0));
    loop {
        let d = distance(arc_length);
        if d.is_nan() {
            return None;
        }
        if d <= 0.0 {
            break;
        }
        // An interface that ends at an edge may miss it by the error of the fit.
        if d > last && last < GRAZE * exclusion {
            let [behind, here, ahead] = [-exclusion, 0.0, exclusion].map(|by| at(before + by));
            if is_edge_between(wall, behind, ahead) {
                return Some(here);
            }
        }
        if d < nearest.0 {
            nearest = (d, arc_length);
        }
        last = d;
        before = arc_length;
        arc_length += d.max(least);
        if arc_length > longest || d > nearest.0 + exclusion {
            return (nearest.0 < MISSED * exclusion).then(|| at(nearest.1));
        }
    }
    let [before, beyond] = halved([before, arc_length], 60, |middle| distance(middle) > 0.0);
    Some(at(0.5 * (before + beyond)))
}

/// Statistics of the angles of several contact lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AngleSummary {
    /// Mean angle in degrees, NaN where none was measured.
    pub mean_deg: f64,
    /// Standard deviation over the contact lines in degrees, 0 for a single one.
    pub spread_deg: f64,
    /// Standard error of the mean in degrees: the larger of that of the fits and that of the spread.
    pub uncertainty_deg: f64,
    /// Number of contact lines with an angle.
    pub measured: usize,
    /// Number of contact lines without one.
    pub failed: usize,
}

/// Mean and spread over the contact lines that have an angle.
pub fn summarize(lines: &[ContactLine]) -> AngleSummary {
    let good: Vec<&ContactLine> = lines.iter().filter(|line| line.angle_deg.is_finite()).collect();
    let (measured, count) = (good.len(), good.len() as f64);
    let mean_deg = good.iter().map(|line| line.angle_deg).sum::<f64>() / count;
    let squares: f64 = good.iter().map(|line| (line.angle_deg - mean_deg).powi(2)).sum();
    let spread_deg = if measured > 1 { (squares / (count - 1.0)).sqrt() } else { squares.sqrt() };
    // Both ends of a meniscus share one fit, so the fits are not independent: their errors are averaged, not reduced.
    let from_fits = (good.iter().map(|line| line.uncertainty_deg.powi(2)).sum::<f64>() / count).sqrt();
    let uncertainty_deg = if measured == 0 { f64::NAN } else { from_fits.max(spread_deg / count.sqrt()) };
    AngleSummary { mean_deg, spread_deg, uncertainty_deg, measured, failed: lines.len() - measured }
}

#[cfg(test)]
mod tests;
