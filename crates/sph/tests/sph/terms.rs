//! The terms of the method one by one: what they conserve, where they are exact, what they converge to.

use crate::support::cloud::{Cloud, Dice};
use meniscus_case::LineDelta;
use meniscus_core::math::Vec2;
use meniscus_sph::neighborhood::Neighborhood;
use meniscus_sph::terms::transposed_stress::TransposedStress;
use meniscus_sph::terms::viscosity::Viscous;
use meniscus_sph::terms::{color, curvature, divergence, pressure_gradient, surface_tension};
use meniscus_sph::wetting::contact_line::{LineFields, LineParticles};
use meniscus_sph::wetting::lines::ContactLineTracker;
use meniscus_wetting::{Wetting, Young};
use nalgebra::Matrix2;

/// Relative rounding error of the weights of pairs, which are kept in single precision.
const WEIGHTS: f64 = f32::EPSILON as f64;

/// Sums of some thousand terms of double precision, relative to the sum of their sizes.
const ROUNDING: f64 = 1e-12;

/// Densities of two fluids mixed at random, in kg/m³.
fn densities(count: usize, ratio: f64) -> Vec<f64> {
    let mut dice = Dice::new(3);
    (0..count).map(|_| if dice.between(0.0, 1.0) < 0.5 { 1000.0 } else { 1000.0 / ratio }).collect()
}

/// |Σ m_a f_a| over Σ m_a |f_a|: 0 where pairs of particles push each other equally.
fn imbalance(cloud: &Cloud, density: &[f64], acceleration: &[Vec2]) -> f64 {
    let force = |a: usize| density[a] * cloud.volume[a] * acceleration[a];
    let sum: Vec2 = (0..acceleration.len()).map(force).sum();
    let size: f64 = (0..acceleration.len()).map(|a| force(a).norm()).sum();
    sum.norm() / size
}

/// [Huber2013, Eq. 16; Morris1997, Eq. 22]
#[test]
fn viscosity_keeps_momentum_on_shaken_particles() {
    let cloud = Cloud::new(24, true, 0.3);
    let n = cloud.points.len();
    let density = densities(n, 10.0);
    let viscosity: Vec<f64> = density.iter().map(|rho| if *rho > 500.0 { 1e-3 } else { 2e-5 }).collect();
    let mut dice = Dice::new(11);
    let velocity: Vec<Vec2> = (0..n).map(|_| dice.vector()).collect();
    let viscous = Viscous { volume: &cloud.volume, density: &density, viscosity: &viscosity };
    let v_ab = |a: usize, b: usize| velocity[a] - velocity[b];
    assert!(imbalance(&cloud, &density, &viscous.morris(&cloud.pairs, v_ab, n)) < ROUNDING);
    assert!(imbalance(&cloud, &density, &viscous.szewc(&cloud.pairs, v_ab, n)) < ROUNDING);
}

/// [Morris1997, Eq. 22]
#[test]
fn viscosity_takes_energy_from_every_motion() {
    let cloud = Cloud::new(16, true, 0.3);
    let n = cloud.points.len();
    let (density, viscosity) = (vec![1.0; n], vec![1.0; n]);
    let viscous = Viscous { volume: &cloud.volume, density: &density, viscosity: &viscosity };
    for seed in 0..5 {
        let mut dice = Dice::new(seed);
        let velocity: Vec<Vec2> = (0..n).map(|_| dice.vector()).collect();
        let acceleration = viscous.morris(&cloud.pairs, |a, b| velocity[a] - velocity[b], n);
        let power: f64 = (0..n).map(|a| cloud.volume[a] * velocity[a].dot(&acceleration[a])).sum();
        assert!(power < 0.0, "{power}");
    }
}

/// [Huber2013, Eq. 15]
#[test]
fn the_symmetric_pressure_gradient_keeps_momentum_on_shaken_particles() {
    let cloud = Cloud::new(24, true, 0.3);
    let n = cloud.points.len();
    let density = densities(n, 5.0);
    let mut dice = Dice::new(5);
    let pressure: Vec<f64> = (0..n).map(|_| dice.between(-100.0, 300.0)).collect();
    let acceleration = pressure_gradient::symmetric(&cloud.pairs, &cloud.volume, &density, &pressure, n);
    assert!(imbalance(&cloud, &density, &acceleration) < ROUNDING);
}

/// [Huber2013, Eqs. 15, 31]
#[test]
fn divergence_and_pressure_gradient_of_linear_fields_are_exact_on_the_lattice() {
    let cloud = Cloud::new(24, false, 0.0);
    let n = cloud.points.len();
    let volume = vec![cloud.lattice_volume; n];
    let velocity: Vec<Vec2> = cloud.points.iter().map(|x| Vec2::new(3.0 * x.x - x.y, 0.5 * x.x + 2.0 * x.y)).collect();
    let found = divergence::divergence(&cloud.pairs, &volume, &velocity, n);
    let slope = Vec2::new(7.0, -4.0);
    let pressure: Vec<f64> = cloud.points.iter().map(|x| 5.0 + slope.dot(x)).collect();
    let density = vec![2.0; n];
    let by_difference = pressure_gradient::difference(&cloud.pairs, &volume, &density, &pressure, |_, _| 0.0, n);
    let symmetric = pressure_gradient::symmetric(&cloud.pairs, &volume, &density, &pressure, n);
    assert!(!cloud.inner().is_empty());
    for a in cloud.inner() {
        assert!((found[a] - 5.0).abs() < 5.0 * WEIGHTS, "{}", found[a]);
        assert!((by_difference[a] + slope / 2.0).norm() < 10.0 * WEIGHTS, "{:?}", by_difference[a]);
        assert!((symmetric[a] + slope / 2.0).norm() < 10.0 * WEIGHTS, "{:?}", symmetric[a]);
    }
}

#[test]
fn a_gradient_over_its_moment_has_the_mean_of_a_linear_field() {
    // By particle the moment is that of all directions, not of the one of the slope: exact is the mean over two slopes at right angles.
    let cloud = Cloud::new(24, false, 0.3);
    let n = cloud.points.len();
    let density = vec![1.0; n];
    let along = |slope: Vec2| {
        let pressure: Vec<f64> = cloud.points.iter().map(|x| slope.dot(x)).collect();
        let (pairs, volume) = (&cloud.pairs, &cloud.volume);
        let mut gradient = pressure_gradient::difference(pairs, volume, &density, &pressure, |_, _| 0.0, n);
        let plain: Vec<f64> = gradient.iter().map(|g| -g.dot(&slope)).collect();
        let moment = pressure_gradient::moment(pairs, volume, |a, b| cloud.separation(a, b), n);
        pressure_gradient::correct_gradient(&moment, &mut gradient);
        (plain, gradient.iter().map(|g| -g.dot(&slope)).collect::<Vec<f64>>())
    };
    let (slope, across) = (Vec2::new(0.6, -0.8), Vec2::new(0.8, 0.6));
    let ((plain, exact), (plain_across, exact_across)) = (along(slope), along(across));
    let mut largest = 0.0_f64;
    for a in cloud.inner() {
        assert!((0.5 * (exact[a] + exact_across[a]) - 1.0).abs() < 10.0 * ROUNDING, "{} at {a}", exact[a]);
        largest = largest.max((0.5 * (plain[a] + plain_across[a]) - 1.0).abs());
    }
    assert!(largest > 0.01, "without the moment it is off by {largest}");
}

#[test]
fn viscosity_of_a_parabola_is_its_second_derivative_on_the_lattice() {
    let cloud = Cloud::new(24, false, 0.0);
    let n = cloud.points.len();
    let (volume, density, viscosity) = (vec![cloud.lattice_volume; n], vec![2.0; n], vec![3.0; n]);
    let velocity: Vec<Vec2> = cloud.points.iter().map(|x| Vec2::new(x.y * x.y, x.x * x.x)).collect();
    let viscous = Viscous { volume: &volume, density: &density, viscosity: &viscosity };
    let v_ab = |a: usize, b: usize| velocity[a] - velocity[b];
    let acceleration = viscous.morris(&cloud.pairs, v_ab, n);
    for a in cloud.inner() {
        // mu/rho times 2; zeta² = 1e-4 h² takes at most 1e-4 h²/dx² off.
        assert!((acceleration[a] - Vec2::repeat(3.0)).norm() < 1e-3, "{:?}", acceleration[a]);
    }
}

/// The forces in N/m by Morris's form and by the transposed stress on a cloud whose viscosity (Pa s) is `of_place`, .1 or 10, both by particle.
fn viscous_forces(cloud: &Cloud, of_place: impl Fn(Vec2) -> f64, velocity: &[Vec2]) -> [Vec<Vec2>; 2] {
    let n = cloud.points.len();
    let density = vec![1.0; n];
    let viscosity: Vec<f64> = cloud.points.iter().map(|&x| of_place(x)).collect();
    let viscous = Viscous { volume: &cloud.volume, density: &density, viscosity: &viscosity };
    let mut by_morris = viscous.morris(&cloud.pairs, |a, b| velocity[a] - velocity[b], n);
    by_morris.iter_mut().zip(&cloud.volume).for_each(|(f, volume)| *f *= *volume);
    let stress = TransposedStress::new(&cloud.pairs, &cloud.volume, &viscosity, n, [0.1, 10.0]).unwrap();
    [by_morris, stress.force(velocity, n)]
}

/// A disc of 10 Pa s in a fluid of .1 Pa s.
fn viscous_disc(x: Vec2) -> f64 {
    if (x - Vec2::repeat(0.5)).norm() < 0.3 { 10.0 } else { 0.1 }
}

fn power(velocity: &[Vec2], force: &[Vec2]) -> f64 {
    velocity.iter().zip(force).map(|(v, f)| v.dot(f)).sum()
}

#[test]
fn the_transposed_stress_keeps_momentum_and_is_symmetric() {
    let cloud = Cloud::new(24, true, 0.3);
    let mut dice = Dice::new(5);
    let [one, other] = [0, 1].map(|_| cloud.points.iter().map(|_| dice.vector()).collect::<Vec<Vec2>>());
    let [of_one, of_other] = [&one, &other].map(|v| viscous_forces(&cloud, viscous_disc, v)[1].clone());
    let (sum, size) = (of_one.iter().sum::<Vec2>(), of_one.iter().map(|force| force.norm()).sum::<f64>());
    assert!(sum.norm() < ROUNDING * size, "{sum:?} of {size}");
    let (there, back) = (power(&other, &of_one), power(&one, &of_other));
    assert!((there - back).abs() < 1e-9 * power(&one, &of_one).abs(), "{there} {back}");
}

#[test]
fn both_parts_of_the_viscous_stress_take_energy_from_every_motion() {
    for shaken in [0.0, 0.3] {
        let cloud = Cloud::new(24, true, shaken);
        let wave = |k: f64, x: &Vec2| {
            let [u, v] = [x.x, x.y].map(|t| (k * std::f64::consts::TAU * t).sin());
            Vec2::new(v, u)
        };
        let mut dice = Dice::new(7);
        let mut motions: Vec<Vec<Vec2>> =
            (0..5).map(|_| cloud.points.iter().map(|_| dice.vector()).collect()).collect();
        motions.extend([1.0, 2.0, 5.0].map(|k| cloud.points.iter().map(|x| wave(k, x)).collect()));
        for velocity in motions {
            let [morris, transposed] =
                viscous_forces(&cloud, viscous_disc, &velocity).map(|force| power(&velocity, &force));
            assert!(morris < 0.0 && morris + transposed < 0.0, "{morris} {transposed}");
        }
    }
}

#[test]
fn a_viscous_disc_that_turns_as_a_whole_is_slowed_by_the_fluid_around_it_alone() {
    // The fluid around it turns with it: what is left is the friction between both, of twice the smaller viscosity, in a band of a spacing.
    for shaken in [0.0, 0.3] {
        let cloud = Cloud::new(48, true, shaken);
        let turns = |x: &Vec2| {
            Vec2::new(-(x.y - 0.5), x.x - 0.5) * if (x - Vec2::repeat(0.5)).norm() < 0.4 { 1.0 } else { 0.0 }
        };
        let velocity: Vec<Vec2> = cloud.points.iter().map(turns).collect();
        let within = |force: &[Vec2]| {
            let inner = |a: &usize| (cloud.points[*a] - Vec2::repeat(0.5)).norm() < 0.34;
            (0..force.len()).filter(inner).map(|a| velocity[a].dot(&force[a])).sum::<f64>()
        };
        let [morris, transposed] = viscous_forces(&cloud, viscous_disc, &velocity).map(|force| within(&force));
        // 2 mu over the area of the disc is what Morris's form alone takes.
        assert!(morris < -4.0, "{morris}");
        assert!((morris + transposed).abs() < 0.02 * morris.abs(), "{morris} {transposed}, shaken {shaken}");
    }
}

#[test]
fn a_step_of_the_viscosity_in_a_stretched_fluid_bears_the_step_of_the_stress() {
    let gradient = Matrix2::new(-1.0, 0.5, 0.0, 1.0);
    let of_place = |x: Vec2| if x.y < 0.5 { 0.1 } else { 10.0 };
    for (shaken, tolerance) in [(0.0, 1e-3), (0.3, 0.03)] {
        let cloud = Cloud::new(48, false, shaken);
        let velocity: Vec<Vec2> = cloud.points.iter().map(|x| gradient * x).collect();
        let forces = viscous_forces(&cloud, of_place, &velocity);
        let half = 0.25..0.75;
        let meant = (0..cloud.points.len())
            .filter(|a| half.contains(&cloud.points[*a].x) && half.contains(&cloud.points[*a].y));
        let step: Vec2 = meant.map(|a| forces[0][a] + forces[1][a]).sum::<Vec2>() / 0.5;
        // The step of 2μ D·e_y, with 2D = ∇v + ∇vᵀ = ((−2, .5), (.5, 2)).
        let wanted = 9.9 * Vec2::new(0.5, 2.0);
        assert!((step - wanted).norm() < tolerance * wanted.norm(), "{step:?}, shaken {shaken}");
    }
}

/// Smoothed color, normal, unit normal and curvature of the region where `color` is 1.
struct Interface {
    normal: Vec<Vec2>,
    unit_normal: Vec<Vec2>,
    curvature: Vec<f64>,
}

impl Interface {
    fn of(cloud: &Cloud, is_wetting: impl Fn(Vec2) -> bool) -> Self {
        let n = cloud.points.len();
        let sharp: Vec<f64> = cloud.points.iter().map(|&x| f64::from(u8::from(is_wetting(x)))).collect();
        let smooth = color::smoothed_color(&cloud.pairs, &cloud.volume, &sharp, &vec![true; n]);
        let normal = color::color_gradient(&cloud.pairs, &cloud.volume, &smooth, n);
        let unit_normal = curvature::unit_normal(&normal, cloud.kernel.h);
        let curvature = curvature::curvature(&cloud.pairs, &cloud.volume, &unit_normal, n);
        Self { normal, unit_normal, curvature }
    }

    /// Mean curvature, weighted by |n|, and its standard deviation in 1/m: what the surface force feels.
    fn mean_curvature(&self) -> [f64; 2] {
        let weight: f64 = self.normal.iter().map(|n| n.norm()).sum();
        let mean = |value: &dyn Fn(f64) -> f64| -> f64 {
            self.normal.iter().zip(&self.curvature).map(|(n, k)| n.norm() * value(*k)).sum::<f64>() / weight
        };
        let middle = mean(&|k| k);
        [middle, mean(&|k| (k - middle).powi(2)).sqrt()]
    }
}

/// [Huber2013, Eq. 18]
#[test]
fn the_normal_of_a_plane_interface_integrates_to_one() {
    let cloud = Cloud::new(24, true, 0.0);
    let interface = Interface::of(&cloud, |x| x.x < 0.5);
    // Across the interface at x = 0.5 only: the other one is at x = 0. The normal points into the wetting phase. The area
    // of a particle is dx² here: V of Eq. (17) is half a percent less on the lattice.
    let middle = |a: &usize| (0.25..0.75).contains(&cloud.points[*a].x);
    let area = cloud.spacing * cloud.spacing;
    let integral: Vec2 = (0..cloud.points.len()).filter(middle).map(|a| area * interface.normal[a]).sum();
    assert!((integral - Vec2::new(-1.0, 0.0)).norm() < WEIGHTS, "{integral:?}");
}

/// [Huber2013, Eq. 19; Morris2000, Sect. 3.3]
#[test]
fn curvature_of_a_disc_is_one_over_its_radius() {
    const RADIUS: f64 = 0.25;
    let mut errors = Vec::new();
    for side in [40, 80] {
        let cloud = Cloud::new(side, true, 0.0);
        let interface = Interface::of(&cloud, |x| (x - Vec2::repeat(0.5)).norm() < RADIUS);
        let [mean, deviation] = interface.mean_curvature();
        errors.push((mean * RADIUS - 1.0).abs());
        println!("{side}: {} +- {}", mean * RADIUS, deviation * RADIUS);
        let inverse = Interface::of(&cloud, |x| (x - Vec2::repeat(0.5)).norm() >= RADIUS).mean_curvature()[0];
        assert!(
            (inverse + mean).abs() < 1e-9 * mean,
            "a hole must have the opposite curvature: {inverse} against {mean}"
        );
    }
    // The normals of a lattice staircase are smoothed over 2 h = 3 dx, a tenth and a twentieth of the radius here.
    assert!(errors[0] < 0.05 && errors[1] < 0.03, "{errors:?}");
}

/// [Huber2013, Eq. 20]
#[test]
fn the_surface_force_of_a_drop_sums_to_zero() {
    let cloud = Cloud::new(40, true, 0.0);
    let interface = Interface::of(&cloud, |x| (x - Vec2::repeat(0.5)).norm() < 0.25);
    let n = cloud.points.len();
    let ones = vec![1.0; n];
    let force = surface_tension::surface_force(0.02, &interface.curvature, &interface.normal, &ones);
    assert!(imbalance(&cloud, &ones, &force) < ROUNDING, "the lattice is symmetric about the drop");
}

/// The forces per length of the contact lines of a plane interface that stands upright on a wall at y = 0, left (x = 0)
/// and right (x = 0.5), and the number of lines.
fn upright_lines(contact_angle: f64, delta: LineDelta) -> ([Vec2; 2], usize) {
    let cloud = Cloud::new(24, true, 0.0);
    let interface = Interface::of(&cloud, |x| x.x < 0.5);
    let n = cloud.points.len();
    let distance: Vec<f64> = cloud.points.iter().map(|x| if x.y < 0.5 { x.y } else { f64::INFINITY }).collect();
    let normal: Vec<Vec2> = distance.iter().map(|d| if d.is_finite() { Vec2::y() } else { Vec2::zeros() }).collect();
    let ones = vec![1.0; n];
    let zeros = vec![Vec2::zeros(); n];
    let fields = LineFields {
        position: &cloud.points,
        velocity: &zeros,
        normal: &interface.normal,
        unit_normal: &interface.unit_normal,
        wall_distance: &distance,
        wall_normal: &normal,
        volume: &cloud.volume,
        weight: &ones,
    };
    let law = Wetting::Young(Young { contact_angle_deg: contact_angle.to_degrees() });
    let tracker = ContactLineTracker {
        domain: &cloud.domain,
        model: &|_| law,
        wall_velocity: &|_| Vec2::zeros(),
        tension: 0.03,
        viscosity: 1.0,
        other_viscosity: 1.0,
        slip_length: 1.0,
        h: cloud.kernel.h,
        mean_over: 1.0,
    };
    let neighborhood = Neighborhood { pairs: cloud.pairs.clone(), images: cloud.images.clone() };
    let found = LineParticles::find(&neighborhood, &fields, &cloud.kernel, n);
    let lines = tracker.track(&[], &found.detected_lines(&fields, &cloud.domain), 0.0);
    let angles: Vec<f64> = lines.iter().map(|line| line.angle).collect();
    let force = found.line_force(&fields, delta, &angles, 0.03);
    let half = |right: bool| {
        let near = |a: &usize| (0.25..0.75).contains(&cloud.points[*a].x) == right;
        (0..n).filter(near).map(|a| cloud.volume[a] * force[a]).sum()
    };
    ([half(false), half(true)], lines.len())
}

/// [Huber2013, Eqs. 21-23]
#[test]
fn the_force_of_each_contact_line_sums_to_its_driving_force() {
    for degrees in [0.0_f64, 40.0, 120.0, 180.0] {
        let ([left, right], lines) = upright_lines(degrees.to_radians(), LineDelta::Normalized);
        // The interface stands at 90 degrees; the force acts along the wall out of the wetting phase [Huber2013, Eqs. 7, 12].
        let f = 0.03 * degrees.to_radians().cos();
        assert_eq!(lines, 2);
        assert!((right - Vec2::new(f, 0.0)).norm() < 0.03 * ROUNDING, "{right:?} at {degrees}");
        assert!((left - Vec2::new(-f, 0.0)).norm() < 0.03 * ROUNDING, "{left:?} at {degrees}");
        // The local form has the integral in place of the sum over the lattice, which differs by two percent.
        let ([left, right], _) = upright_lines(degrees.to_radians(), LineDelta::Local);
        assert!((right - Vec2::new(f, 0.0)).norm() < 0.03 * f.abs(), "{right:?} at {degrees}");
        assert!((left - Vec2::new(-f, 0.0)).norm() < 0.03 * f.abs(), "{left:?} at {degrees}");
    }
}

#[test]
fn a_line_at_ninety_degrees_set_to_ninety_degrees_feels_no_force() {
    let ([left, right], lines) = upright_lines(90.0_f64.to_radians(), LineDelta::Normalized);
    assert_eq!(lines, 2);
    assert!(left.norm() + right.norm() < 0.03 * ROUNDING, "{left:?} {right:?}");
}
