//! Whole steps of the solver away from walls: what must not happen.

use std::f64::consts::TAU;

use crate::support::boxes::{SURFACE_FORCES, case, fastest, steps};
use crate::support::flow::{flow, solver};
use meniscus_core::math::Vec2;
use meniscus_core::solver::Solver;
use meniscus_sph::equivalent_forces::volume_forces;
use meniscus_sph::flow::Flow;
use meniscus_sph::particles::Phase;
use meniscus_sph::terms::shifting::{anti_clustering, carried_velocity, keep_along, take_out_mean};

const PERIODIC: &str =
    "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

/// Moves the fluid particles off the lattice: each by a tenth of the spacing in a direction that depends on its place.
fn shake(flow: &mut Flow) {
    let spacing = flow.config.method.spacing;
    for a in 0..flow.state.particles.fluids {
        let x = flow.state.particles.position[a] / spacing;
        let by = Vec2::new((7.1 * x.x + 3.3 * x.y).sin(), (5.7 * x.y - 2.9 * x.x).cos());
        flow.state.particles.position[a] =
            flow.config.domain.wrapped(flow.state.particles.position[a] + 0.1 * spacing * by);
    }
    flow.prepare();
}

/// [Huber2013, Eqs. 1-3]
#[test]
fn a_uniform_flow_of_one_fluid_stays_uniform() {
    let text = case(&format!(
        "[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n{PERIODIC}[sph.initial.velocity]\nuniform = [0.3, -0.1]\n"
    ));
    let mut flow = flow(&text);
    for _ in 0..20 {
        flow.step(1.0).unwrap();
    }
    let change = flow.state.particles.velocity.iter().map(|v| (v - Vec2::new(0.3, -0.1)).norm()).fold(0.0, f64::max);
    assert!(change < 1e-9 * 0.3, "rounding of twenty steps on the lattice: {change:.1e} m/s");
}

#[test]
fn the_density_error_shifting_evens_the_density_of_a_fluid_at_rest_and_leaves_it_at_rest() {
    let text = case(&format!("[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n{PERIODIC}"));
    let mut flow = flow(&text);
    shake(&mut flow);
    let uneven = |flow: &Flow| {
        let errors = flow.fields.bulk.volume[..flow.state.particles.fluids]
            .iter()
            .map(|v| (flow.config.method.volume / v - 1.0).powi(2));
        errors.sum::<f64>().sqrt()
    };
    let before = uneven(&flow);
    steps(&mut flow, 20, 1.0e-6);
    assert!(uneven(&flow) < 0.5 * before, "{:.1e} of {before:.1e} are left", uneven(&flow));
    assert_eq!(fastest(&flow), 0.0);
}

#[test]
fn a_uniform_flow_of_two_fluids_without_tension_stays_uniform() {
    let text = case(&format!(
        "[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n[sph.phases.non-wetting]\ndensity = 10.0\nviscosity = 1.0e-5\n\
         [sph.interface]\ntension = 0.0\n{PERIODIC}[sph.initial.velocity]\nuniform = [0.3, -0.1]\n\
         [[sph.initial.wetting]]\ndisc = {{ center = [0.0, 0.0], radius = 3.0e-4 }}\n"
    ));
    let mut flow = flow(&text);
    for _ in 0..20 {
        flow.step(1.0).unwrap();
    }
    let change = flow.state.particles.velocity.iter().map(|v| (v - Vec2::new(0.3, -0.1)).norm()).fold(0.0, f64::max);
    assert!(change < 1e-9 * 0.3, "rounding of twenty steps on the lattice: {change:.1e} m/s");
}

/// The largest speed after one step of a fluid that started at rest, over that of free fall.
fn share_of_free_fall(flow: &mut Flow) -> f64 {
    flow.step(1.0).unwrap();
    fastest(flow) / (flow.config.method.gravity.norm() * flow.state.time)
}

#[test]
fn a_fluid_in_a_box_rests_under_gravity_however_its_particles_lie() {
    // On walls, on an image wall and on a plane of symmetry, and between walls that gravity is not normal to.
    for (gravity, bottom) in
        [([0.0, -9.81], "wall"), ([5.0, -8.0], "wall"), ([0.0, -9.81], "image"), ([0.0, -9.81], "symmetry")]
    {
        let mut flow = flow(&case(&format!(
            "gravity = {gravity:?}\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n\
             [sph.numerics]\nbackground-pressure = 0.0\n[sph.sides]\nbottom = \"{bottom}\"\n"
        )));
        shake(&mut flow);
        let share = share_of_free_fall(&mut flow);
        assert!(share < 1.0e-9, "{share:.1e} of free fall under {gravity:?} on the side {bottom}");
    }
}

#[test]
fn a_heavy_fluid_below_a_light_one_rests() {
    let mut flow = flow(&case(
        "gravity = [0.0, -9.81]\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n\
         [sph.phases.non-wetting]\ndensity = 10.0\nviscosity = 1.0e-5\n[sph.interface]\ntension = 0.02\n\
         [sph.wetting.young]\ncontact-angle-deg = 90.0\n\
         [[sph.initial.wetting]]\nrectangle = { center = [0.0, -3.0e-4], size = [2.0e-3, 6.0e-4] }\n",
    ));
    let share = share_of_free_fall(&mut flow);
    assert!(share < 1.0e-9, "{share:.1e} of free fall");
}

/// An oblong drop in a periodic box, with tension.
fn drop(density: f64, velocity: [f64; 2], surface_force: &str) -> String {
    case(&format!(
        "[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n\
         [sph.phases.non-wetting]\ndensity = {density:?}\nviscosity = 5.0e-3\n\
         [sph.interface]\ntension = 0.02\n[sph.surface-force.{surface_force}]\n{PERIODIC}[sph.initial.velocity]\nuniform = {velocity:?}\n\
         [[sph.initial.wetting]]\nrectangle = {{ center = [0.0, 0.0], size = [6.0e-4, 4.0e-4] }}\n"
    ))
}

/// [Huber2013, Eqs. 1-3; Skillen2013; Lind2012, Eq. 26]
#[test]
fn a_moving_observer_sees_the_same_flow() {
    const DT: f64 = 2.0e-6;
    let by = Vec2::new(0.02, -0.03);
    for (density, form) in [1000.0, 100.0].into_iter().flat_map(|density| SURFACE_FORCES.map(|form| (density, form))) {
        let [mut still, mut moving] = [[0.0, 0.0], [by.x, by.y]].map(|velocity| flow(&drop(density, velocity, form)));
        shake(&mut still);
        shake(&mut moving);
        steps(&mut still, 10, DT);
        steps(&mut moving, 10, DT);
        let speed = fastest(&still);
        assert!(speed > 1e-3, "nothing moves: {speed:.1e} m/s");
        let place = |flow: &Flow, a: usize| {
            flow.state.particles.id[..flow.state.particles.fluids].iter().position(|id| *id == a as u32)
        };
        for a in 0..still.state.particles.fluids {
            let (here, there) = (place(&still, a).unwrap(), place(&moving, a).unwrap());
            let change = moving.state.particles.velocity[there] - by - still.state.particles.velocity[here];
            assert!(change.norm() < 1e-7 * speed, "{form}, particle {a}: {:.1e} of {speed:.1e} m/s", change.norm());
        }
    }
}

#[test]
fn a_heavy_particle_that_is_shifted_takes_hardly_any_velocity_from_a_light_fluid() {
    for (density, largest_share) in [(1000.0, 1.5), (1.0, 2e-3)] {
        let mut flow = flow(&drop(density, [0.0, 0.0], "pressure-jump"));
        shake(&mut flow);
        // The fluid around the drop moves by 1 m/s, the drop does not.
        let moves = |a: usize| flow.state.particles.phase[a] == Phase::NonWetting;
        let velocity: Vec<Vec2> =
            (0..flow.state.particles.len()).map(|a| if moves(a) { Vec2::x() } else { Vec2::zeros() }).collect();
        let velocity = flow.neighborhood.images.velocity_field(velocity);
        let by = vec![Vec2::new(0.0, 0.1 * flow.config.method.spacing); flow.state.particles.fluids];
        let change = carried_velocity(
            &flow.neighborhood.pairs,
            &flow.fields.bulk.volume,
            &flow.fields.bulk.density,
            &velocity,
            &by,
        );
        let largest = |of_moving: bool| {
            let meant = (0..flow.state.particles.fluids).filter(|a| moves(*a) == of_moving);
            meant.map(|a| change[a].norm()).fold(0.0, f64::max)
        };
        let (drop, around) = (largest(false), largest(true));
        assert!(around > 0.02 && drop < largest_share * around, "ratio {density}: {drop:.1e}, {around:.1e} m/s");
    }
}

/// [Monaghan2000]
#[test]
fn the_anti_clustering_force_parts_a_pair_and_moves_no_crowds() {
    let mut flow = flow(&drop(1000.0, [0.0, 0.0], "pressure-jump"));
    let (dx, fluids) = (flow.config.method.spacing, flow.state.particles.fluids);
    let push = |flow: &Flow| {
        let w_of_spacing = flow.config.method.kernel.w(dx);
        anti_clustering(&flow.neighborhood.pairs, &flow.fields.bulk.fluid_volume, 0.2, w_of_spacing, fluids)
    };
    let largest = |push: &[Vec2]| push.iter().map(|s| s.norm()).fold(0.0, f64::max);
    assert!(largest(&push(&flow)) < 1e-9 / dx, "nothing is pushed on the lattice");

    // What is the same everywhere would move all, and is taken out.
    let mut all_alike = vec![Vec2::new(1.0, -2.0) / dx; fluids];
    take_out_mean(&flow.neighborhood.pairs, &flow.neighborhood.images, &flow.fields.bulk.fluid_volume, &mut all_alike);
    assert!(largest(&all_alike) < 1e-9 / dx, "{:.1e} of 2.2/dx", largest(&all_alike) * dx);

    // Two neighbors come to half of the spacing: the sum points to the other, shifting goes down it.
    let a = (0..fluids)
        .min_by(|&a, &b| flow.state.particles.position[a].norm().total_cmp(&flow.state.particles.position[b].norm()))
        .unwrap();
    let near = flow.state.particles.position[a] + Vec2::new(dx, 0.0);
    let b = (0..fluids).find(|&b| (flow.state.particles.position[b] - near).norm() < 0.1 * dx).unwrap();
    let moved = flow.state.particles.position[a] + Vec2::new(0.5 * dx, 0.0);
    flow.state.particles.position[b] = moved;
    flow.prepare();
    let of =
        |flow: &Flow, x: Vec2| (0..fluids).find(|&c| (flow.state.particles.position[c] - x).norm() < 0.1 * dx).unwrap();
    let (left, right) = (of(&flow, moved - Vec2::new(0.5 * dx, 0.0)), of(&flow, moved));
    let mut push = push(&flow);
    take_out_mean(&flow.neighborhood.pairs, &flow.neighborhood.images, &flow.fields.bulk.fluid_volume, &mut push);
    assert!(
        push[left].x * dx > 0.1 && push[right].x * dx < -0.1,
        "{} and {} over 1/dx",
        push[left] * dx,
        push[right] * dx
    );
}

/// The fluid particle nearest to `x` (m).
fn nearest(flow: &Flow, x: Vec2) -> usize {
    let distance = |a: &usize| (flow.state.particles.position[*a] - x).norm();
    (0..flow.state.particles.fluids).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
}

/// [Monaghan2000]
#[test]
fn pushes_part_a_crowded_row_across_the_interface() {
    // Two neighbors of the first row under the upper side of the drop come to 0.6 spacings, one a little higher.
    let [upper, lower] = [Vec2::new(-0.5e-4, 1.5e-4), Vec2::new(0.1e-4, 1.4e-4)];
    let moved = |strength: f64| {
        let text =
            format!("{}[sph.numerics]\nanti-clustering = {strength:?}\n", drop(1000.0, [0.0, 0.0], "pressure-jump"));
        let mut flow = flow(&text);
        let id = |flow: &Flow, x: Vec2| flow.state.particles.id[nearest(flow, x)];
        let pair = [id(&flow, upper), id(&flow, Vec2::new(0.5e-4, 1.5e-4))];
        let at = |flow: &Flow, id: u32| flow.state.particles.id.iter().position(|other| *other == id).unwrap();
        let second = at(&flow, pair[1]);
        flow.state.particles.position[second] = lower;
        // Shifts need motion.
        let far = nearest(&flow, Vec2::new(4.5e-4, -4.5e-4));
        flow.state.particles.velocity[far] = Vec2::new(0.05, 0.0);
        flow.prepare();
        flow.step(1.0).unwrap();
        pair.map(|id| flow.state.particles.position[at(&flow, id)])
    };
    let [with, without] = [0.2, 0.0].map(moved);
    let by = [0, 1].map(|k| with[k] - without[k]);
    assert!(by[0].y > 0.0 && by[1].y < 0.0, "the upper one is pushed by {:?} m, the lower one by {:?} m", by[0], by[1]);
}

/// [Skillen2013]
#[test]
fn particles_go_down_the_concentration_along_the_interface_only() {
    let flow = flow(&drop(1000.0, [0.0, 0.0], "pressure-jump"));
    let (fluids, h, normal) = (flow.state.particles.fluids, flow.config.method.kernel.h, &flow.fields.interface.normal);
    let given = Vec2::new(1.0, -2.0);
    let mut kept = vec![given; fluids];
    keep_along(normal, h, &mut kept);
    let near: Vec<usize> = (0..fluids).filter(|&a| normal[a].norm() > 0.05 / h).collect();
    assert!((20..fluids - 20).contains(&near.len()));
    for a in 0..fluids {
        let across = if near.contains(&a) { normal[a].normalize() } else { Vec2::zeros() };
        assert!((kept[a] - (given - given.dot(&across) * across)).norm() < 1e-12, "{} at {across}", kept[a]);
    }
}

#[test]
fn momentum_is_kept_at_equal_densities() {
    let mut flow = flow(&drop(1000.0, [0.0, 0.0], "csf"));
    shake(&mut flow);
    let momentum = |flow: &Flow| -> Vec2 { flow.state.particles.velocity.iter().sum() };
    let [surface_force, _] = volume_forces(&flow);
    let force: Vec2 = surface_force.iter().zip(&*flow.fields.bulk.volume).map(|(f, v)| *v * f).sum();
    let sizes: f64 = surface_force.iter().zip(&*flow.fields.bulk.volume).map(|(f, v)| v * f.norm()).sum();
    // The continuum surface force is no sum of pair forces: on shaken particles this much of it is left over.
    println!("surface force left over: {:.1e}", force.norm() / sizes);
    // What is left over acts as long as they move: these are a quarter of what surface tension allows.
    steps(&mut flow, 10, 8.0e-5);
    let size: f64 = flow.state.particles.velocity.iter().map(|v| v.norm()).sum();
    println!("momentum over sizes after ten steps: {:.1e}", momentum(&flow).norm() / size);
    assert!(momentum(&flow).norm() < 0.02 * size, "{:.1e}", momentum(&flow).norm() / size);
}

#[test]
fn the_curvature_of_a_resolved_wave_keeps_its_amplitude() {
    // A flat interface in the middle of the box, then all particles moved along y = a cos kx without a change of volume.
    for (cells, tolerance) in [(16, 0.03), (32, 0.003), (64, 0.001)] {
        let spacing = 1.0e-3 / f64::from(cells);
        let sides = "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n";
        let mut flow = flow(&format!(
            "format = 1\ntitle = \"A wave\"\n[geometry]\nmin = [0.0, -5.0e-4]\nmax = [1.0e-3, 5.0e-4]\n[time]\nend = 1.0\n\
             [sph]\nspacing = {spacing}\n\
             [sph.phases.wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n\
             [sph.phases.non-wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n[sph.interface]\ntension = 0.02\n{sides}\
             [[sph.initial.wetting]]\nrectangle = {{ center = [5.0e-4, -2.5e-4], size = [1.0e-3, 5.0e-4] }}\n"
        ));
        let (k, a) = (TAU / 1.0e-3, 0.3 * spacing);
        for x in &mut flow.state.particles.position[..flow.state.particles.fluids] {
            // The stream function of the displacement is −(a/k) sin kx cos ky/2, which vanishes on both walls.
            let (across, along) = (0.5 * k * x.y, k * x.x);
            *x += a * Vec2::new(0.5 * along.sin() * across.sin(), along.cos() * across.cos());
        }
        flow.prepare();
        let near = (0..flow.state.particles.fluids).filter(|&i| flow.fields.interface.curvature[i] != 0.0);
        let (sum, norm) = near.fold((0.0, 0.0), |(sum, norm), i| {
            let wave = (k * flow.state.particles.position[i].x).cos();
            (sum + wave * flow.fields.interface.curvature[i], norm + wave * wave)
        });
        let ratio = sum / norm / (a * k * k);
        println!("{cells} spacings per wavelength: {ratio}");
        assert!((ratio - 1.0).abs() < tolerance, "{cells} spacings per wavelength: {ratio}");
    }
}

#[test]
fn the_friction_on_the_plates_of_a_channel_carries_the_force_on_the_fluid() {
    const GRAVITY: f64 = 0.01;
    for slip in ["0.0", "5.0e-5"] {
        let mut flow = flow(&case(&format!(
            "gravity = [{GRAVITY:?}, 0.0]\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 0.1\n\
             [sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n[sph.walls]\nslip-length = {slip}\n"
        )));
        // Three viscous times, density H²/viscosity: the slowest part has decayed by exp(-30), with slip by exp(-24).
        steps(&mut flow, 375, 8e-5);
        let weight = 1000.0 * flow.config.method.volume * flow.state.particles.fluids as f64 * GRAVITY;
        let all = flow.view().friction(|_, _| true);
        assert!((all.x / weight - 1.0).abs() < 1e-6, "slip {slip} m: {:.6} of the weight", all.x / weight);
        let below = flow.view().friction(|_, x| x.y < 0.0);
        assert!((below.x / all.x - 0.5).abs() < 1e-6 && all.y.abs() < 1e-6 * weight, "{below:?} of {all:?}");
    }
}

#[test]
fn the_density_error_correction_rests_where_the_fluid_does() {
    let mut method = flow(&drop(1000.0, [0.0, 0.0], "pressure-jump")).config.method;
    // Share of the density error taken back in its time, where the fastest particle goes so many spacings in one that it does not shorten.
    let share = |displacement: f64| {
        let speed = displacement * method.spacing / method.density_correction_time(0.0);
        method.density_correction_rate(speed) * method.density_correction_time(speed)
    };
    assert_eq!(
        (share(0.0), share(0.02), share(1.0)),
        (0.0, method.numerics.density_error_correction, method.numerics.density_error_correction)
    );
    for (displacement, of_all) in [(0.0025, 0.5), (0.005, 1.0)] {
        assert!(
            (share(displacement) - of_all * method.numerics.density_error_correction).abs() < 1e-15,
            "{displacement}: {}",
            share(displacement)
        );
    }
    // Errors come in time, not in steps.
    let rate = method.density_correction_rate(0.01);
    method.numerics.time_step_factor = 0.5;
    assert_eq!(method.density_correction_rate(0.01), rate);
}

/// A disc in a periodic cell, and a force that turns from x to y at 0.5 ms.
const TURNING: &str = r#"
format = 1
title = "a force that turns"
[geometry]
min = [0.0, 0.0]
max = [4.0e-4, 4.0e-4]
shapes = [{ disc = { center = [2.1e-4, 2.0e-4], radius = 1.0e-4 } }]
[sph]
spacing = 2.0e-5
gravity = [1.0, 2.0]
[sph.phases.wetting]
density = 1000.0
viscosity = 0.01
[sph.sides]
left = "periodic"
right = "periodic"
bottom = "periodic"
top = "periodic"
[sph.measure.permeability]
[time]
end = 1.0e-3
"#;

#[test]
fn a_run_resumed_before_at_or_after_the_turn_of_its_force_takes_the_same_steps() {
    let to = |solver: &mut dyn Solver, until: f64| {
        while solver.time() < until {
            solver.step(until).unwrap();
        }
    };
    for resumed_at in [3.0e-4, 5.0e-4, 7.0e-4] {
        let (mut whole, mut first, mut second) = (solver(TURNING), solver(TURNING), solver(TURNING));
        to(&mut first, resumed_at);
        to(&mut whole, resumed_at);
        second.restore(&first.state()).unwrap();
        to(&mut whole, 1.0e-3);
        to(&mut second, 1.0e-3);
        assert_eq!(whole.flow.state.particles, second.flow.state.particles, "resumed at {resumed_at} s");
        assert_eq!(whole.flow.config.method.gravity, Vec2::new(0.0, 2.0));
    }
    let mut solver = solver(TURNING);
    assert_eq!(solver.flow.config.method.gravity, Vec2::new(1.0, 0.0));
    // A step that would pass the turn ends there.
    while solver.time() < 5.0e-4 {
        solver.step(1.0).unwrap();
    }
    assert_eq!(solver.time(), 5.0e-4);
}
