//! Steps of liquids on walls: that turned or renamed problems have turned or renamed solutions, and what contact lines do in a whole flow.

use crate::support::boxes::{SURFACE_FORCES, case, fastest, steps};
use crate::support::flow::{flow, solver};
use meniscus_core::math::Vec2;
use meniscus_core::solver::Solver;
use meniscus_sph::equivalent_forces::volume_forces;
use meniscus_sph::flow::Flow;

/// Walls at the bottom and at the top, or left and right; the other two sides are joined.
const WALLS_BELOW_AND_ABOVE: &str = "left = \"periodic\"\nright = \"periodic\"\n";

const WALLS_LEFT_AND_RIGHT: &str = "bottom = \"periodic\"\ntop = \"periodic\"\n";

/// A box of 1 mm between two walls; the phase that is not the `background` fills a rectangle (center and size in m).
fn liquid_on_a_wall(
    (center, size): ([f64; 2], [f64; 2]),
    gravity: [f64; 2],
    angle: f64,
    sides: &str,
    (background, surface_force): (&str, &str),
) -> String {
    case(&format!(
        "gravity = {gravity:?}\n\
         [sph.phases.wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n\
         [sph.phases.non-wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n[sph.interface]\ntension = 0.02\n\
         [sph.surface-force.{surface_force}]\n[sph.wetting.young]\ncontact-angle-deg = {angle:?}\n[sph.sides]\n{sides}[sph.initial]\nbackground = \"{background}\"\n\
         [[sph.initial.wetting]]\nrectangle = {{ center = {center:?}, size = {size:?} }}\n"
    ))
}

/// The particle of `flow` nearest to `x`, which must be nearer than `reach` (m).
fn nearest(flow: &Flow, x: Vec2, reach: f64) -> usize {
    let distance = |a: &usize| flow.config.domain.separation(flow.state.particles.position[*a], x).norm();
    let found = (0..flow.state.particles.fluids).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
    assert!(distance(&found) < reach, "no particle at {x:?}: the nearest is {:.1e} m away", distance(&found));
    found
}

#[test]
fn a_problem_turned_by_ninety_degrees_has_the_turned_solution() {
    SURFACE_FORCES.iter().for_each(|form| compare_with_turned(form));
}

fn compare_with_turned(form: &str) {
    const DT: f64 = 2.0e-6;
    let mut upright = flow(&liquid_on_a_wall(
        ([-1.0e-4, -4.0e-4], [4.0e-4, 6.0e-4]),
        [0.3, -9.81],
        60.0,
        WALLS_BELOW_AND_ABOVE,
        ("non-wetting", form),
    ));
    let mut turned = flow(&liquid_on_a_wall(
        ([4.0e-4, -1.0e-4], [6.0e-4, 4.0e-4]),
        [9.81, 0.3],
        60.0,
        WALLS_LEFT_AND_RIGHT,
        ("non-wetting", form),
    ));
    assert!(upright.state.particles.len() <= 300, "{}", upright.state.particles.len());
    steps(&mut upright, 10, DT);
    steps(&mut turned, 10, DT);
    let turn = |v: Vec2| Vec2::new(-v.y, v.x);
    let speed = fastest(&upright);
    let pressures = upright.state.particles.pressure.iter().fold(0.0_f64, |most, p| most.max(p.abs()));
    for a in 0..upright.state.particles.fluids {
        let b = nearest(&turned, turn(upright.state.particles.position[a]), 1e-6 * upright.config.method.spacing);
        assert_eq!(upright.state.particles.phase[a], turned.state.particles.phase[b]);
        let change = (turned.state.particles.velocity[b] - turn(upright.state.particles.velocity[a])).norm();
        assert!(change < 1e-8 * speed, "{change:.1e} of {speed:.1e} m/s at {:?}", upright.state.particles.position[a]);
        let change = (turned.state.particles.pressure[b] - upright.state.particles.pressure[a]).abs();
        assert!(change < 1e-8 * pressures, "{change:.1e} of {pressures:.1e} Pa");
    }
}

#[test]
fn exchanged_phases_with_the_supplementary_angle_feel_the_same_forces() {
    for (angle, form) in [0.0, 60.0, 135.0].into_iter().flat_map(|angle| SURFACE_FORCES.map(|form| (angle, form))) {
        let shape = ([-1.0e-4, -4.0e-4], [4.0e-4, 6.0e-4]);
        let mut flows = [(angle, "non-wetting"), (180.0 - angle, "wetting")].map(|(angle, background)| {
            flow(&liquid_on_a_wall(shape, [0.0, -9.81], angle, WALLS_BELOW_AND_ABOVE, (background, form)))
        });
        let [one, other] = &flows;
        let [forces, [surface, line]] = [volume_forces(one), volume_forces(other)];
        let sizes = forces.each_ref().map(|f| f.iter().map(|f| f.norm()).fold(0.0, f64::max));
        assert!(form != "csf" || sizes.iter().all(|size| *size > 0.0), "{sizes:?}");
        for a in 0..one.state.particles.fluids {
            assert_eq!(one.state.particles.position[a], other.state.particles.position[a]);
            assert!(one.state.particles.phase[a] != other.state.particles.phase[a]);
            let change = (forces[0][a] - surface[a]).norm();
            assert!(change <= 1e-9 * sizes[0], "surface force of particle {a}: {:.1e}", change / sizes[0]);
            let change = (forces[1][a] - line[a]).norm();
            assert!(change <= 1e-9 * sizes[1], "line force of particle {a}: {:.1e}", change / sizes[1]);
        }
        flows.iter_mut().for_each(|flow| steps(flow, 10, 2.0e-6));
        let [one, other] = &flows;
        let speed = fastest(one);
        for a in 0..one.state.particles.fluids {
            let change = (one.state.particles.velocity[a] - other.state.particles.velocity[a]).norm();
            assert!(change < 1e-8 * speed, "{form}, {angle}: velocity of particle {a}: {:.1e}", change / speed);
        }
    }
}

#[test]
fn the_lines_of_a_drop_sum_to_the_driving_force_in_a_whole_flow() {
    // At first the interface stands upright on the wall: cos alpha = 0, and each line is driven by sigma cos theta.
    for (angle, form) in [30.0_f64, 90.0, 150.0].into_iter().flat_map(|angle| SURFACE_FORCES.map(|form| (angle, form)))
    {
        let flow = flow(&liquid_on_a_wall(
            ([0.0, -4.0e-4], [4.0e-4, 6.0e-4]),
            [0.0, 0.0],
            angle,
            WALLS_BELOW_AND_ABOVE,
            ("non-wetting", form),
        ));
        assert!(form != "csf" || flow.lines.len() == 2);
        let [_, line_force] = volume_forces(&flow);
        let on_side = |sign: f64| -> Vec2 {
            let side = |a: &usize| sign * flow.state.particles.position[*a].x > 0.0;
            (0..flow.state.particles.fluids).filter(side).map(|a| flow.fields.bulk.volume[a] * line_force[a]).sum()
        };
        let wanted = 0.02 * angle.to_radians().cos();
        let [left, right] = [on_side(-1.0), on_side(1.0)];
        println!("{form}, {angle}: {left:?} {right:?}, wanted {wanted}");
        // alpha is measured from normals that reach up to the corner of the liquid 4 dx above the wall: 1 degree off.
        assert!((right - Vec2::new(wanted, 0.0)).norm() < 0.03 * 0.02, "{right:?}, wanted {wanted}");
        assert!((left + Vec2::new(wanted, 0.0)).norm() < 0.03 * 0.02, "{left:?}, wanted {}", -wanted);
    }
}

#[test]
fn liquid_in_a_corner_stays_symmetric_about_the_diagonal() {
    // The interface crosses the diagonal within the reach of the line force, where both walls are equally near; gravity
    // presses the liquid into the corner.
    for form in SURFACE_FORCES {
        let shape = ([-5.0e-4, -5.0e-4], [6.0e-4, 6.0e-4]);
        stays_symmetric(flow(&liquid_on_a_wall(shape, [-9.81, -9.81], 60.0, "", ("non-wetting", form))));
    }
}

fn stays_symmetric(mut flow: Flow) {
    let on_diagonal = |flow: &Flow, a: usize| {
        let x = flow.state.particles.position[a];
        (x.x - x.y).abs() < 1e-6 * flow.config.method.spacing
    };
    let fields = &flow.fields;
    let between_walls = |a: &usize| on_diagonal(&flow, *a) && fields.interface.normal[*a] != Vec2::zeros();
    let reached = (0..flow.state.particles.fluids)
        .filter(between_walls)
        .filter(|&a| fields.bulk.wall_distance[a] < 3.0e-4)
        .count();
    assert!(flow.state.particles.len() <= 300 && reached > 0, "{} {reached}", flow.state.particles.len());
    let mirrored = |v: Vec2| Vec2::new(v.y, v.x);
    for _ in 0..3 {
        let [_, line_force] = volume_forces(&flow);
        let line_forces: Vec<f64> = line_force.iter().map(|f| f.norm()).collect();
        let (force, speed) = (line_forces.iter().fold(0.0_f64, |m, f| m.max(*f)), fastest(&flow));
        for a in 0..flow.state.particles.fluids {
            let b = nearest(&flow, mirrored(flow.state.particles.position[a]), 1e-6 * flow.config.method.spacing);
            let change = (line_force[b] - mirrored(line_force[a])).norm();
            assert!(change <= 1e-8 * force, "line force: {change:.1e} of {force:.1e} N/m3");
            let change = (flow.state.particles.velocity[b] - mirrored(flow.state.particles.velocity[a])).norm();
            assert!(
                change <= 1e-8 * speed,
                "{change:.1e} of {speed:.1e} m/s at {:?}",
                flow.state.particles.position[a]
            );
        }
        steps(&mut flow, 5, 2.0e-6);
    }
}

#[test]
fn fluid_that_falls_into_a_corner_stays_out_of_both_walls() {
    let text = case(
        "gravity = [-3.0, -9.81]\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n[sph.initial.velocity]\n\
         uniform = [-1.0, -1.0]\n",
    );
    let mut flow = flow(&text);
    for _ in 0..40 {
        flow.step(1.0).unwrap();
        let nearest =
            flow.state.particles.position[..flow.state.particles.fluids].iter().map(|&x| (flow.config.wall)(x).0);
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        // Four passes in a right corner leave a few percent of the distance that is kept.
        assert!(nearest > 0.045 * flow.config.method.spacing, "{nearest:.2e} m at step {}", flow.state.steps);
    }
}

#[test]
fn a_flow_that_is_taken_up_again_remembers_speeds_and_anchors_of_its_lines() {
    const MODELS: [&str; 2] = [
        "hysteresis]\nadvancing-angle-deg = 95.0\nreceding-angle-deg = 60.0",
        "line-friction]\ncontact-angle-deg = 60.0\nfriction = 0.02",
    ];
    for (model, form) in MODELS.iter().flat_map(|model| SURFACE_FORCES.map(|form| (model, form))) {
        // Walls left and right move, so that there is something to remember.
        let sides = "bottom = \"periodic\"\ntop = \"periodic\"\nspeed = { left = 0.05 }\n";
        let place = ([-2.5e-4, 0.0], [5.0e-4, 5.0e-4]);
        let text = liquid_on_a_wall(place, [0.0, 0.0], 60.0, sides, ("non-wetting", form))
            .replace("young]\ncontact-angle-deg = 60.0", model);
        let (mut unbroken, mut again) = (solver(&text), solver(&text));
        for _ in 0..10 {
            unbroken.step(1.0).unwrap();
        }
        again.restore(&unbroken.state()).unwrap();
        let lines = &unbroken.flow.lines;
        assert!(lines.len() >= 2 && lines.iter().any(|line| line.speed != 0.0), "{form}: {lines:?}");
        assert_eq!(*lines, again.flow.lines, "{form}");
        for _ in 0..10 {
            unbroken.step(1.0).unwrap();
            again.step(1.0).unwrap();
        }
        assert_eq!(unbroken.state(), again.state(), "{model}, {form}");
    }
}

#[test]
fn a_drop_over_a_film_has_no_contact_line_and_one_on_the_wall_has_two() {
    // The film between drop and wall is two layers of particles thick, or there is none.
    for (film, lines) in [(2.0e-4, 0), (0.0, 2)] {
        let (bottom, height) = (-5.0e-4 + film, 5.0e-4);
        let shape = ([0.0, bottom + 0.5 * height], [4.0e-4, height]);
        let text = liquid_on_a_wall(shape, [0.0, 0.0], 60.0, WALLS_BELOW_AND_ABOVE, ("non-wetting", "pressure-jump"));
        assert_eq!(flow(&text).lines.len(), lines, "film of {film} m");
    }
}

#[test]
fn a_patch_changes_the_angle_of_its_wall_alone() {
    let sides = "bottom = \"periodic\"\ntop = \"periodic\"\n[[sph.wetting.patches]]\nside = \"right\"\ncontact-angle-deg = 120.0\n";
    // A layer from wall to wall, with two lines at each.
    let place = ([0.0, 0.0], [2.0e-3, 5.0e-4]);
    let flow = flow(&liquid_on_a_wall(place, [0.0, 0.0], 60.0, sides, ("non-wetting", "pressure-jump")));
    assert_eq!(flow.lines.len(), 4, "{:?}", flow.lines);
    for line in &flow.lines {
        let expected = if line.position.x > 0.0 { 120.0 } else { 60.0 };
        assert!((line.angle.to_degrees() - expected).abs() < 1e-9, "{line:?}");
    }
}

/// [Huh1971]
#[test]
fn walls_slip_by_a_spacing_near_contact_lines_and_not_elsewhere() {
    let place = ([0.0, -5.0e-4], [5.0e-4, 7.0e-4]);
    let flow =
        flow(&liquid_on_a_wall(place, [0.0, 0.0], 60.0, WALLS_BELOW_AND_ABOVE, ("non-wetting", "pressure-jump")));
    let (fields, spacing) = (&flow.fields, flow.config.method.spacing);
    assert_eq!(flow.lines.len(), 2, "{:?}", flow.lines);
    let at_walls = (0..flow.state.particles.fluids).filter(|a| fields.bulk.wall_distance[*a].is_finite());
    for a in at_walls {
        let x = flow.state.particles.position[a];
        let nearest = flow
            .lines
            .iter()
            .map(|line| flow.config.domain.separation(x, line.position).norm())
            .fold(f64::MAX, f64::min);
        let b = fields.interface.slip_length[a];
        assert!(nearest > 3.0 * spacing || (b - spacing).abs() < 1e-12 * spacing, "at {x:?}: {b:.1e} m");
        assert!(nearest < 6.0 * spacing || b == 0.0, "at {x:?}: {b:.1e} m");
    }
}

#[test]
fn the_pressure_of_one_side_of_a_thin_plate_does_not_reach_the_other() {
    // A plate of six spacings: the wall particles of both of its sides are neighbors.
    let mut flow = flow(
        "format = 1\ntitle = \"Two chambers\"\n[geometry]\nmin = [-1.5e-3, -5.0e-4]\nmax = [1.5e-3, 5.0e-4]\n\
         shapes = [{ rectangle = { center = [0.0, 0.0], size = [6.0e-4, 2.0e-3] } }]\n[time]\nend = 1.0\n\
         [sph]\nspacing = 1.0e-4\ngravity = [-9.81, 0.0]\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n\
         [sph.sides]\nbottom = \"symmetry\"\ntop = \"symmetry\"\n",
    );
    let near = |flow: &Flow, x: f64| nearest(flow, Vec2::new(x, 0.0), 1.0e-4);
    let part = |x| flow.state.particles.part[near(&flow, x)];
    assert_ne!(part(-4.0e-4), part(4.0e-4), "each chamber has a pressure of its own");
    steps(&mut flow, 5, 1.0e-4);
    // Low on the left of the plate, high on its right, and as far from the mean as at the walls that have nothing behind them.
    for (at_plate, at_wall, sign) in [(-3.5e-4, -1.45e-3, -1.0), (3.5e-4, 1.45e-3, 1.0)] {
        let (plate, wall) =
            (flow.state.particles.pressure[near(&flow, at_plate)], flow.state.particles.pressure[near(&flow, at_wall)]);
        assert!(sign * plate > 4.0 && (plate + wall).abs() < 0.01 * plate.abs(), "{plate} Pa, {wall} Pa at the wall");
    }
}
