use super::*;
use crate::interface::contour::contour;
use crate::interface::lattice::Lattice;
use crate::interface::wall::clip;
use nalgebra::Rotation2;

const H: f64 = 1.5 / 40.0;

/// A color that falls over about one smoothing length across a circle.
fn tanh_disc(x: Vec2, center: Vec2, radius: f64) -> f64 {
    0.5 - 0.5 * (((x - center).norm() - radius) / H).tanh()
}

fn angles(color: impl Fn(Vec2) -> f64, wall: &dyn Fn(Vec2) -> WallPoint) -> Vec<ContactLine> {
    let lattice = Lattice::open(Vec2::repeat(-2.5), Vec2::repeat(0.025), [201, 201]);
    let value = |x: Vec2| if wall(x).distance < -0.05 { f64::NAN } else { color(x) };
    let values: Vec<f64> = lattice.nodes().into_iter().map(value).collect();
    let contours = clip(&contour(&lattice, &values, 0.5), wall);
    contact_lines(&contours, wall, &ContactSettings::for_smoothing_length(H))
}

fn assert_angles(lines: &[ContactLine], angle: f64, tolerance: f64) {
    assert_eq!(lines.len(), 2, "angle {angle}: {lines:?}");
    assert!(lines.iter().all(|line| (line.angle_deg - angle).abs() < tolerance), "angle {angle}: {lines:?}");
}

#[test]
fn a_drop_on_a_turned_wall_has_its_angle_on_both_sides() {
    for turn in [0.0, 27.0, 90.0, -133.0_f64] {
        for theta in [20.0, 40.0, 90.0, 140.0, 160.0_f64] {
            let up = Rotation2::new(turn.to_radians()) * Vec2::y();
            let wall = |x: Vec2| WallPoint { distance: x.dot(&up) + 0.2, normal: up };
            // A flat cap of radius 1 would lie within the excluded band of 2h.
            let radius = if theta < 30.0 { 3.0 } else { 1.0 };
            let center = -(0.2 + radius * theta.to_radians().cos()) * up;
            let lines = angles(|x| tanh_disc(x, center, radius), &wall);
            assert_angles(&lines, theta, 0.3);
            for line in &lines {
                assert!(line.uncertainty_deg < 2.0 && (line.curvature * radius - 1.0).abs() < 0.01, "{line:?}");
                assert!(wall(line.position).distance.abs() < 1e-9);
            }
            assert_ne!(lines[0].side, lines[1].side);
        }
    }
}

#[test]
fn a_hollow_in_the_wetting_phase_has_the_supplement_of_the_bubble_angle() {
    let wall = |x: Vec2| WallPoint { distance: x.y + 0.5, normal: Vec2::y() };
    let lines = angles(|x| 1.0 - tanh_disc(x, Vec2::new(0.1, -0.2), 0.8), &wall);
    let bubble = (-0.3_f64 / 0.8).acos().to_degrees();
    assert_angles(&lines, 180.0 - bubble, 0.3);
    assert!(lines.iter().all(|line| (line.curvature + 1.25).abs() < 0.02), "{lines:?}");
}

#[test]
fn a_drop_on_a_disc_has_its_angle() {
    for theta in [40.0, 90.0, 120.0_f64] {
        let wall = |x: Vec2| WallPoint { distance: x.norm() - 1.0, normal: x / x.norm().max(1e-12) };
        let r = 0.7_f64;
        let c = (1.0 + r * r - 2.0 * r * theta.to_radians().cos()).sqrt();
        let lines = angles(|x| tanh_disc(x, Vec2::new(0.6 * c, 0.8 * c), r), &wall);
        let summary = summarize(&lines);
        assert_eq!((summary.measured, summary.failed), (2, 0), "angle {theta}: {lines:?}");
        assert!((summary.mean_deg - theta).abs() < 0.5, "angle {theta}: {summary:?}");
    }
}

/// [Oliver1977]
#[test]
fn a_drop_that_ends_at_the_edges_of_a_pillar_has_its_angle_to_the_face_below_it() {
    // The pillar |x| < 0.7, y < 0, with a cap over the whole of its top.
    let wall = |x: Vec2| {
        let beyond = Vec2::new((x.x.abs() - 0.7).max(0.0), x.y.max(0.0));
        let outside = Vec2::new(x.x.signum() * beyond.x, beyond.y);
        if outside != Vec2::zeros() {
            return WallPoint { distance: outside.norm(), normal: outside.normalize() };
        }
        let (to_side, to_top) = (x.x.abs() - 0.7, x.y);
        let normal = if to_side > to_top { Vec2::new(x.x.signum(), 0.0) } else { Vec2::y() };
        WallPoint { distance: to_side.max(to_top), normal }
    };
    for theta in [75.0, 100.0, 130.0_f64] {
        let radius = 0.7 / theta.to_radians().sin();
        let lines = angles(|x| tanh_disc(x, Vec2::new(0.0, -radius * theta.to_radians().cos()), radius), &wall);
        assert_angles(&lines, theta, 0.3);
    }
}

#[test]
fn a_flat_meniscus_between_plates_has_its_angle() {
    let wall = |x: Vec2| {
        let sign = x.y.signum();
        WallPoint { distance: 0.6 - x.y.abs(), normal: Vec2::new(0.0, -sign) }
    };
    let lines = angles(|x| 0.5 - 0.5 * (x.x / H).tanh(), &wall);
    assert_angles(&lines, 90.0, 0.1);
    assert!(lines.iter().all(|line| line.curvature.abs() < 0.01), "{lines:?}");
}

#[test]
fn a_meniscus_that_is_too_short_is_kept_with_the_reason() {
    let wall = |x: Vec2| WallPoint { distance: x.y, normal: Vec2::y() };
    let lines = angles(|x| tanh_disc(x, Vec2::zeros(), 0.03), &wall);
    assert_eq!(lines.len(), 2);
    assert!(lines.iter().all(|line| line.angle_deg.is_nan()));
    assert!(matches!(lines[0].problem, Some(ContactProblem::TooFewPoints { .. })), "{lines:?}");
    assert_eq!(summarize(&lines).failed, 2);
}

#[test]
fn a_free_drop_has_no_contact_line() {
    let wall = |x: Vec2| WallPoint { distance: x.y + 2.0, normal: Vec2::y() };
    assert!(angles(|x| tanh_disc(x, Vec2::zeros(), 0.8), &wall).is_empty());
}
