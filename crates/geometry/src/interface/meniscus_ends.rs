//! Contact angles of menisci under a body force in any direction: a drop on an incline, a drop under gravity.
//!
//! Along a static meniscus the curvature is κ = κ_0 + (Δρ/σ) g·(x − x_0) (Young-Laplace). The rotation of its tangent is the integral of that over the arc
//! length, φ = φ_0 + κ_0 s + (Δρ/σ) ∫ g·(x − x_0) ds, linear in the two unknowns if the positions x are those of the contour. The fit is extrapolated to the
//! wall. Without a force it is a circle. Unlike [`contact`](super::contact), which fits distances and has error bars, this one is used for moving drops:
//! where the flow bends the interface the two differ. The bending of a moving interface by the flow is neglected.

use nalgebra::{Matrix2, Vector2};

use super::contact::{ContactSettings, LEAST_POINTS, WettingSide, fitted_points};
use super::polyline::Polyline;
use super::wall::WallPoint;
use meniscus_core::math::{Vec2, perpendicular};

/// A contact line under a body force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeniscusEnd {
    /// Where the fitted meniscus meets the wall, in m.
    pub position: Vec2,
    /// Angle through the wetting phase in degrees.
    pub angle_deg: f64,
}

/// Step from the first fitted point to the wall, over its distance.
const STEP: f64 = 0.01;

/// Maximum number of steps: a meniscus that has not met the wall within twenty distances is given up, as for circles.
const MOST_STEPS: usize = 2000;

/// Both ends of each open contour that lie on the wall and are long enough for a fit.
///
/// `force` = Δρ g/σ in 1/m², Δρ the density of the wetting minus that of the other phase.
pub fn ends_under_force(
    contours: &[Polyline],
    wall: &dyn Fn(Vec2) -> WallPoint,
    settings: &ContactSettings,
    force: Vec2,
) -> Vec<MeniscusEnd> {
    let mut ends = Vec::new();
    for line in contours.iter().filter(|line| !line.closed && line.points.len() > 1) {
        let distances: Vec<f64> = line.points.iter().map(|&p| wall(p).distance).collect();
        for side in [WettingSide::Left, WettingSide::Right] {
            let end = if side == WettingSide::Left { 0 } else { line.points.len() - 1 };
            if distances[end] < settings.reach {
                let mut points = fitted_points(line, &distances, side, settings).to_vec();
                if side == WettingSide::Right {
                    points.reverse();
                }
                ends.extend(follow(&points, side, wall, force));
            }
        }
    }
    ends
}

/// The fit to `points` that run away from the wall, extrapolated back to it.
fn follow(points: &[Vec2], side: WettingSide, wall: &dyn Fn(Vec2) -> WallPoint, force: Vec2) -> Option<MeniscusEnd> {
    if points.len() < LEAST_POINTS {
        return None;
    }
    // In the direction away from the wall the wetting phase is on the left at one end, and on the right at the other.
    let sign = if side == WettingSide::Left { 1.0 } else { -1.0 };
    let from = points[0];
    let (mut s, mut turn, mut last) = (0.0, 0.0, None::<f64>);
    let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for pair in points.windows(2) {
        let along = pair[1] - pair[0];
        let length = along.norm();
        let mut phi = along.y.atan2(along.x);
        if let Some(last) = last {
            phi -= std::f64::consts::TAU * ((phi - last) / std::f64::consts::TAU).round();
        }
        last = Some(phi);
        let middle = 0.5 * (pair[0] + pair[1]) - from;
        let half = 0.5 * length * sign * force.dot(&middle);
        turn += half;
        let row = Vector2::new(1.0, s + 0.5 * length);
        matrix += length * row * row.transpose();
        right += length * (phi - turn) * row;
        turn += half;
        s += length;
    }
    let [phi, kappa] = matrix.cholesky()?.solve(&right).into();
    let slope = |x: Vec2, phi: f64| (Vec2::new(phi.cos(), phi.sin()), kappa + sign * force.dot(&(x - from)));
    // Integrates the curve from the first point, and the mean offset of the points from it.
    let (mut x, mut angle, mut beside) = (from, phi, Vec2::zeros());
    for pair in points.windows(2) {
        let length = (pair[1] - pair[0]).norm();
        let (_, turn) = slope(x, angle);
        let (along, _) = slope(x, angle + 0.5 * length * turn);
        let next = x + length * along;
        let (_, turn) = slope(0.5 * (x + next), angle);
        (x, angle) = (next, angle + length * turn);
        beside += pair[1] - x;
    }
    let start = from + beside / points.len() as f64;
    let step = -STEP * wall(start).distance;
    let (mut x, mut angle) = (start, phi);
    for _ in 0..MOST_STEPS {
        let here = wall(x);
        if here.distance <= 0.0 {
            let into_wetting = sign * perpendicular(Vec2::new(angle.cos(), angle.sin()));
            let cosine = -into_wetting.dot(&here.normal);
            return Some(MeniscusEnd { position: x, angle_deg: cosine.clamp(-1.0, 1.0).acos().to_degrees() });
        }
        let (_, turn) = slope(x, angle);
        let (along, _) = slope(x, angle + 0.5 * step * turn);
        (x, angle) = (x + step * along, angle + step * turn);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::arc::steps_along;
    use super::super::wall::floor;
    use super::*;
    use nalgebra::Rotation2;

    const SETTINGS: ContactSettings = ContactSettings {
        exclusion: 0.1,
        reach: 0.2,
        window: f64::INFINITY,
        force: Vec2::new(0.0, 0.0),
        accuracy: 0.0,
    };

    /// A meniscus that leaves the floor at (1, 0) at the angle of a drop to its left and continues until it returns; every thirtieth step gives a point, as
    /// far apart as those of a grid.
    fn meniscus(degrees: f64, kappa: f64, force: Vec2) -> (Polyline, f64) {
        let mut steps = steps_along(std::f64::consts::PI - degrees.to_radians(), kappa, force).enumerate();
        let mut points = Vec::new();
        let (end, phi) = steps
            .find_map(|(step, (x, phi))| {
                points.extend((step % 30 == 0 && x.y >= 0.0).then_some(x));
                (x.y < 0.0).then_some((x, phi))
            })
            .unwrap();
        points.push(end);
        (Polyline { points, closed: false }, phi.to_degrees() - 180.0)
    }

    #[test]
    fn circles_and_menisci_under_a_force_have_their_angles_at_both_ends() {
        for (degrees, kappa, force) in [(60.0, 0.9, Vec2::zeros()), (100.0, 1.3, Vec2::new(0.5, 0.0))] {
            let (line, other) = meniscus(degrees, kappa, force);
            let ends = ends_under_force(&[line], &floor, &SETTINGS, force);
            assert_eq!(ends.len(), 2, "{degrees}");
            assert!((ends[0].position - Vec2::x()).norm() < 0.01, "{degrees}: {ends:?}");
            for (end, exact) in ends.iter().zip([degrees, other]) {
                // The curve is approximated by chords of 0.03.
                assert!((end.angle_deg - exact).abs() < 0.2, "{degrees}: {exact} {ends:?}");
            }
        }
    }

    #[test]
    fn a_turned_meniscus_has_the_same_angles() {
        let (line, _) = meniscus(80.0, 1.0, Vec2::new(0.3, -0.4));
        let level = ends_under_force(std::slice::from_ref(&line), &floor, &SETTINGS, Vec2::new(0.3, -0.4));
        let turn = Rotation2::new(0.6);
        let turned = Polyline { points: line.points.iter().map(|x| turn * x).collect(), closed: false };
        let up = turn * Vec2::y();
        let wall = |x: Vec2| WallPoint { distance: x.dot(&up), normal: up };
        let ends = ends_under_force(&[turned], &wall, &SETTINGS, turn * Vec2::new(0.3, -0.4));
        assert_eq!(ends.len(), 2);
        for (a, b) in level.iter().zip(&ends) {
            assert!((a.angle_deg - b.angle_deg).abs() < 1e-6, "{a:?} {b:?}");
        }
    }
}
