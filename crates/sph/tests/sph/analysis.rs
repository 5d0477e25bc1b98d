//! Measurements from particles to angle, curvature and lengths, on states whose answer is known.

use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::analysis::phases::PhaseAreas;
use meniscus_geometry::analysis::resample::{Samples, Stencils};
use meniscus_geometry::interface::cap::cap;
use meniscus_geometry::interface::contact::{ContactLine, ContactSettings, contact_lines, summarize};
use meniscus_geometry::interface::contour::contour;
use meniscus_geometry::interface::lattice::Lattice;
use meniscus_geometry::interface::lengths::{interface_length, wall_samples, wetted_length};
use meniscus_geometry::interface::polyline::Polyline;
use meniscus_geometry::interface::wall::WallPoint;
use meniscus_geometry::interface::wall::clip;
use meniscus_validation::disc_pair::DiscPair;

type Wall<'a> = &'a dyn Fn(Vec2) -> WallPoint;

/// Fluid particles in a square, their color and the smoothing length.
struct State {
    points: Vec<Vec2>,
    volumes: Vec<f64>,
    colors: Vec<f64>,
    dx: f64,
}

/// A number in [-1, 1] that looks random.
fn noise(i: usize, seed: f64) -> f64 {
    let x = (i as f64 * 12.9898 + seed * 78.233).sin() * 43_758.545_3;
    2.0 * (x - x.floor()) - 1.0
}

impl State {
    /// Particles of spacing `dx` in the pore within `half` of the origin, shaken by a fifth of the spacing as in a run.
    fn new(half: f64, dx: f64, wall: Wall, wetting: impl Fn(Vec2) -> bool) -> Self {
        let count = (2.0 * half / dx).round() as usize;
        let lattice = Lattice::open(Vec2::repeat(-half + 0.5 * dx), Vec2::repeat(dx), [count, count]);
        let shaken = |(i, p): (usize, Vec2)| p + 0.2 * dx * Vec2::new(noise(i, 1.0), noise(i, 2.0));
        let points: Vec<Vec2> =
            lattice.nodes().into_iter().enumerate().map(shaken).filter(|&p| wall(p).distance > 0.0).collect();
        let colors = points.iter().map(|&p| f64::from(wetting(p))).collect();
        Self { volumes: vec![dx * dx; points.len()], points, colors, dx }
    }

    fn smoothing_length(&self) -> f64 {
        1.5 * self.dx
    }

    fn smoothed(&self, nodes: &[Vec2]) -> Vec<f64> {
        let h = self.smoothing_length();
        let samples =
            Samples { points: &self.points, volumes: &self.volumes, smoothing_length: h, period: [None, None] };
        Stencils::new(&samples, nodes).scalar(&self.colors)
    }

    fn contours(&self, half: f64, wall: Wall) -> Vec<Polyline> {
        let count = (2.0 * half / self.dx).round() as usize;
        let lattice = Lattice::open(Vec2::repeat(-half), Vec2::repeat(self.dx), [count + 1, count + 1]);
        clip(&contour(&lattice, &self.smoothed(&lattice.nodes()), 0.5), wall)
    }

    fn contact_lines(&self, half: f64, wall: Wall) -> Vec<ContactLine> {
        let settings = ContactSettings::for_smoothing_length(self.smoothing_length());
        contact_lines(&self.contours(half, wall), wall, &settings)
    }
}

/// A floor 0.6 below the origin, turned by `degrees`.
fn floor(degrees: f64) -> (impl Fn(Vec2) -> WallPoint, Vec2) {
    let turn = degrees.to_radians();
    let up = Vec2::new(-turn.sin(), turn.cos());
    (move |x: Vec2| WallPoint { distance: x.dot(&up) + 0.6, normal: up }, up)
}

#[test]
fn angles_of_drops_of_particles_are_measured_to_two_degrees() {
    // sqrt(area)/dx = 40: the coarse one of the benchmarks.
    let (half, dx) = (2.0, 1.0 / 40.0);
    for turn in [0.0, 27.0] {
        for theta in [30.0, 60.0, 90.0, 120.0, 150.0_f64] {
            let (wall, up) = floor(turn);
            let center = -(0.6 + cap(1.0, theta.to_radians()).radius * theta.to_radians().cos()) * up;
            let radius = cap(1.0, theta.to_radians()).radius;
            for swapped in [false, true] {
                let inside = |x: Vec2| ((x - center).norm() < radius) != swapped;
                let lines = State::new(half, dx, &wall, inside).contact_lines(half, &wall);
                let at_floor: Vec<ContactLine> = lines.into_iter().filter(|l| wall(l.position).distance < dx).collect();
                let summary = summarize(&at_floor);
                let expected = if swapped { 180.0 - theta } else { theta };
                let place = format!("turn {turn}, angle {theta}, swapped {swapped}");
                assert_eq!((summary.measured, summary.failed), (2, 0), "{place}: {at_floor:?}");
                assert!((summary.mean_deg - expected).abs() < 2.0, "{place}: {summary:?}");
                // Error bars are of use where they are neither absurd nor blind.
                assert!(summary.uncertainty_deg < 3.0, "{place}: {summary:?}");
                assert!(
                    (summary.mean_deg - expected).abs() < 4.0 * summary.uncertainty_deg + 0.3,
                    "{place}: {summary:?}"
                );
            }
        }
    }
}

#[test]
fn base_length_and_area_of_a_drop_of_particles_are_those_of_the_cap() {
    let (half, dx) = (2.0, 1.0 / 40.0);
    let theta = 60.0_f64.to_radians();
    let (wall, up) = floor(27.0);
    let expected = cap(1.0, theta);
    let center = -(0.6 + expected.radius * theta.cos()) * up;
    let state = State::new(half, dx, &wall, |x| (x - center).norm() < expected.radius);
    // The particles of the box number those of the lattice, so the area is good to the cut cells at the rim.
    assert!((PhaseAreas::new(&state.volumes, &state.colors).wetting - 1.0).abs() < 0.02);
    let length = interface_length(&state.contours(half, &wall));
    assert!((length / (2.0 * expected.radius * theta) - 1.0).abs() < 0.04, "interface length {length}");
    let foot = -0.6 * up;
    let ends = vec![foot + 1.5 * perpendicular(up), foot - 1.5 * perpendicular(up)];
    let samples = wall_samples(&[Polyline { points: ends, closed: false }], 0.25 * dx);
    let places: Vec<Vec2> = samples.iter().map(|sample| sample.point).collect();
    let wetted = wetted_length(&samples, &state.smoothed(&places));
    assert!((wetted.wetting - expected.base).abs() < 3.0 * dx, "base {} for {}", wetted.wetting, expected.base);
}

#[test]
fn liquid_between_four_discs_has_the_angle_and_the_curvature_of_theory() {
    // 60 spacings from disc to disc, of which the bands at the walls leave out six: fewer leave the fit to the noise.
    let (half, dx, theta) = (2.2, 1.0 / 60.0, 40.0_f64);
    let discs = DiscPair { radius: 1.0, half_gap: 0.5, angle: theta.to_radians() };
    let b = 10.0_f64.to_radians();
    let offset = discs.radius + discs.half_gap;
    let disc_center = |x: Vec2| Vec2::new(offset.copysign(x.x), offset.copysign(x.y));
    let wall = |x: Vec2| {
        let away = x - disc_center(x);
        WallPoint { distance: away.norm() - discs.radius, normal: away / away.norm().max(1e-12) }
    };
    // The meniscus on the right bulges inward: a circle about a point outside of the gap.
    let kappa = discs.curvature(b);
    let foot = Vec2::new(offset + discs.radius * b.sin(), offset - discs.radius * b.cos());
    let middle = foot.x + (kappa.powi(-2) - foot.y * foot.y).sqrt();
    let inside = |x: Vec2| {
        let (far, near) = (x.x.abs().max(x.y.abs()), x.x.abs().min(x.y.abs()));
        far < foot.x && (far < offset - 0.1 || (Vec2::new(far, near) - Vec2::new(middle, 0.0)).norm() > 1.0 / kappa)
    };
    let lines = State::new(half, dx, &wall, inside).contact_lines(half, &wall);
    let menisci: Vec<ContactLine> = lines.into_iter().filter(|line| line.position.norm() < 2.2).collect();
    let summary = summarize(&menisci);
    assert_eq!((summary.measured, summary.failed), (8, 0), "{menisci:?}");
    // The targets of the benchmark: 3 degrees and 5 %, the curvature negative since the non-wetting phase bulges.
    assert!((summary.mean_deg - theta).abs() < 3.0, "{summary:?}");
    let mean = menisci.iter().map(|line| line.curvature).sum::<f64>() / 8.0;
    assert!((-mean / kappa - 1.0).abs() < 0.05, "curvature {mean} for {}", -kappa);
}
