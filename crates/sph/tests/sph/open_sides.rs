//! Open sides: flows that must pass them unchanged, the balance of what passes, and resuming with buffers.

use crate::support::dice::Dice;
use crate::support::flow::{flow, solver};
use meniscus_case::ViscousStep;
use meniscus_core::solver::Solver;
use meniscus_sph::flow::Flow;
use meniscus_sph::open::BoundaryFluxes;
use meniscus_sph::particles::Phase;

/// A channel of 2 mm by 1 mm with free slip at the bottom and the top, and 20 particles along it.
fn channel(rest: &str) -> String {
    format!(
        "format = 1\ntitle = \"A channel\"\n[geometry]\nmin = [0.0, 0.0]\nmax = [2.0e-3, 1.0e-3]\n[time]\nend = 1.0\n\
         [sph]\nspacing = 1.0e-4\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n{rest}"
    )
}

const PLUG: &str = "[sph.sides]\nleft = \"inlet\"\nright = \"outlet\"\nbottom = \"symmetry\"\ntop = \"symmetry\"\n\
                    [sph.sides.open.left]\nvelocity = 0.01\n[sph.initial.velocity]\nuniform = [0.01, 0.0]\n";

const OTHER_FLUID: &str = "[sph.phases.non-wetting]\ndensity = 1000.0\nviscosity = 2.0e-3\n[sph.interface]\ntension = 0.001\n\
                           [[sph.initial.wetting]]\nrectangle = { center = [1.0e-3, 0.0], size = [4.0e-3, 1.0e-3] }\n";

fn run(flow: &mut Flow, until: f64) {
    while flow.state.time < until {
        flow.step(until).unwrap();
    }
}

/// What is missing in the balance of each phase, in particles.
fn missing(flow: &Flow) -> [i64; 2] {
    let (inflow, outflow) = flow.state.fluxes.totals();
    let inside = BoundaryFluxes::count(&flow.state.particles.phase[..flow.state.particles.fluids]);
    [0, 1].map(|i| flow.state.fluxes.initial[i] as i64 + inflow[i] as i64 - outflow[i] as i64 - inside[i] as i64)
}

#[test]
fn a_uniform_flow_passes_open_sides_and_stays_uniform() {
    let mut flow = flow(&channel(PLUG));
    let start = flow.state.particles.fluids;
    // The fluid is replaced once and a half.
    run(&mut flow, 0.3);
    let worst = flow.state.particles.velocity[..flow.state.particles.fluids]
        .iter()
        .map(|v| (v.x - 0.01).hypot(v.y))
        .fold(0.0, f64::max);
    // The files move as one lattice: all that is left is the residual of the pressure solve.
    assert!(worst < 1e-8, "{worst:.1e} m/s");
    assert_eq!(missing(&flow), [0, 0]);
    assert_eq!(flow.state.particles.fluids, start);
    let (inflow, _) = flow.state.fluxes.totals();
    assert_eq!(inflow[0], 300, "10 files, 3 mm long");
}

#[test]
fn a_column_between_two_pressures_that_carry_its_weight_rests() {
    let sides = "[sph.sides]\nleft = \"symmetry\"\nright = \"symmetry\"\nbottom = \"inlet\"\ntop = \"outlet\"\n\
                 [sph.sides.open.bottom]\npressure = 10.0\n[sph.sides.open.top]\npressure = 0.19\n";
    let text = channel(sides).replace("[sph]\n", "[sph]\ngravity = [0.0, -9.81]\n");
    let mut flow = flow(&text);
    run(&mut flow, 0.05);
    let fastest = flow.state.particles.fluid_speed();
    // Falling freely it would have reached 0.5 m/s.
    assert!(fastest < 1e-4, "{fastest:.1e} m/s");
    for a in 0..flow.state.particles.fluids {
        let exact = 10.0 - 9810.0 * flow.state.particles.position[a].y;
        assert!(
            (flow.state.particles.pressure[a] - exact).abs() < 0.02,
            "{} for {exact}",
            flow.state.particles.pressure[a]
        );
    }
}

#[test]
fn a_large_common_pressure_changes_nothing() {
    let sides = |more: f64| {
        let [a, b] = [1.0 + more, more];
        format!(
            "[sph.sides]\nleft = \"inlet\"\nright = \"outlet\"\n[sph.sides.open.left]\npressure = {a:?}\n[sph.sides.open.right]\npressure = {b:?}\n"
        )
    };
    let speeds = [0.0, 1.0e5].map(|more| {
        let mut flow = flow(&channel(&sides(more)));
        run(&mut flow, 0.01);
        flow.state.particles.velocity[..flow.state.particles.fluids].iter().map(|v| v.x).sum::<f64>()
    });
    // 1e5 Pa have digits of 1e-11 Pa, and the solve leaves 1e-6 of the right side.
    assert!((speeds[0] / speeds[1] - 1.0).abs() < 1e-6, "{speeds:?}");
    assert!(speeds[0] > 0.0);
}

/// With the pressure before seen as acting on the fluid and not on the buffers, long steps press the files at the sides together by 3 %.
#[test]
fn long_steps_between_two_pressures_leave_the_flow_as_short_ones_do() {
    let walls = "[sph.sides]\nleft = \"inlet\"\nright = \"outlet\"\n[sph.sides.open.left]\npressure = 0.024\n";
    let [long, short] = [ViscousStep::Implicit, ViscousStep::Explicit].map(|viscous_step| {
        let mut flow = flow(&channel(walls));
        flow.config.method.numerics.viscous_step = viscous_step;
        run(&mut flow, 1.0);
        let fluids = flow.state.particles.fluids;
        let flux = flow.state.particles.velocity[..fluids].iter().map(|v| v.x).sum::<f64>() / fluids as f64;
        let density_error = |volume: &f64| (flow.config.method.volume / volume - 1.0).abs();
        (flow.state.steps, flux, flow.fields.bulk.volume[..fluids].iter().map(density_error).fold(0.0, f64::max))
    });
    assert!(2 * long.0 < short.0, "{long:?} and {short:?}");
    assert!((long.1 / short.1 - 1.0).abs() < 5e-3, "{long:?} and {short:?}");
    assert!(long.2 < 6e-3, "{long:?} and {short:?}");
}

#[test]
fn layers_come_in_and_leave_as_layers() {
    let mut flow = flow(&channel(&format!("{PLUG}{OTHER_FLUID}")));
    run(&mut flow, 0.3);
    assert_eq!(missing(&flow), [0, 0]);
    for a in 0..flow.state.particles.moving() {
        let below = flow.state.particles.position[a].y < 5.0e-4;
        assert_eq!(flow.state.particles.phase[a] == Phase::Wetting, below, "at {:?}", flow.state.particles.position[a]);
    }
    let (inflow, outflow) = flow.state.fluxes.totals();
    assert_eq!((inflow, outflow), ([150; 2], [150; 2]));
}

#[test]
fn the_phase_of_an_inlet_drives_the_other_one_out() {
    let sides = PLUG.replace("velocity = 0.01\n[", "velocity = 0.01\nphase = \"non-wetting\"\n[");
    let filled = OTHER_FLUID.replace("size = [4.0e-3, 1.0e-3]", "size = [4.0e-3, 4.0e-3]");
    let mut flow = flow(&channel(&format!("{sides}{filled}")));
    run(&mut flow, 0.3);
    // The flat front has left.
    let inside = BoundaryFluxes::count(&flow.state.particles.phase[..flow.state.particles.fluids]);
    assert_eq!(inside, [0, 200]);
    assert_eq!(missing(&flow), [0, 0]);
}

#[test]
fn a_run_that_stops_at_breakthrough_ends_when_20_particles_have_passed() {
    let sides = PLUG.replace("velocity = 0.01\n[", "velocity = 0.01\nphase = \"non-wetting\"\n[");
    let filled = OTHER_FLUID.replace("size = [4.0e-3, 1.0e-3]", "size = [4.0e-3, 4.0e-3]");
    let text = channel(&format!("{sides}{filled}[sph.stop]\nbreakthrough = true\n"));
    let mut solver = solver(&text);
    while !solver.is_done() && solver.time() < 0.3 {
        solver.step(0.3).unwrap();
    }
    // The flat front passes 2 mm in 0.2 s, and a row of ten particles each 0.01 s.
    assert!(solver.is_done() && (solver.time() - 0.215).abs() < 0.0051, "{} s", solver.time());
}

#[test]
fn a_resumed_flow_with_open_sides_takes_the_same_steps() {
    let given_rate = "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n[sph.sides.open.left]\nvelocity = 0.01\n";
    for sides in [PLUG, given_rate] {
        let text = channel(&format!("{sides}{OTHER_FLUID}"));
        let (mut whole, mut first) = (flow(&text), flow(&text));
        run(&mut first, 0.03);
        run(&mut whole, 0.03);
        let mut second = flow(&text);
        second.load(&first.save()).unwrap();
        for flow in [&mut whole, &mut second] {
            run(flow, 0.06);
        }
        assert_eq!(whole.state.particles, second.state.particles);
        assert_eq!(whole.state.fluxes, second.state.fluxes);
        assert_eq!(whole.state.given_flows, second.state.given_flows);
    }
}

/// Set back to a twentieth of a spacing, each row that entered was pressed into the fluid: peaks of seven times the pressure.
#[test]
fn rows_of_particles_enter_without_peaks_of_the_driving_pressure() {
    let walls = "[sph.sides]\nleft = \"inlet\"\nright = \"outlet\"\n[sph.sides.open.left]\nvelocity = 0.01\n";
    let meniscus = OTHER_FLUID
        .replace("center = [1.0e-3, 0.0], size = [4.0e-3, 1.0e-3]", "center = [0.0, 0.0], size = [1.0e-3, 4.0e-3]");
    let angle = "[sph.wetting.young]\ncontact-angle-deg = 60.0\n";
    let mut flow = flow(&channel(&format!("{walls}{meniscus}{angle}")));
    let (period, steps) = (1.0e-2, 50);
    let mut driving = Vec::new();
    for i in 1..=6 * steps {
        run(&mut flow, f64::from(i) * period / f64::from(steps));
        let particles = &flow.state.particles;
        let near: Vec<usize> = (0..particles.moving()).filter(|&a| particles.position[a].x.abs() < 2.0e-4).collect();
        driving.push(near.iter().map(|&a| particles.pressure[a]).sum::<f64>() / near.len() as f64);
    }
    let median = |values: &[f64]| {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    };
    let scale = median(&driving).abs();
    let later = 2 * steps as usize..driving.len() - 5;
    let worst = later.map(|i| (driving[i] - median(&driving[i - 5..=i + 5])).abs() / scale).fold(0.0, f64::max);
    println!("median {scale:.3} Pa, largest deviation from the running median {worst:.3} of it");
    assert!(worst < 0.08, "{worst}");
}

/// Issue: a particle of water at an inlet of air was held at the side, kept its outward velocity, and reached hundreds of meters per second along the side.
#[test]
fn water_that_reaches_an_inlet_of_air_turns_back() {
    let fluids = "[sph.phases.wetting]\npreset = \"water\"\n[sph.phases.non-wetting]\npreset = \"air\"\n[sph.interface]\ntension = 0.0728\n\
                  [sph.wetting.young]\ncontact-angle-deg = 30.0\n[sph.sides]\nleft = \"inlet\"\nright = \"outlet\"\n\
                  [sph.sides.open.left]\nvelocity = 0.1\nphase = \"non-wetting\"\n\
                  [[sph.initial.wetting]]\nrectangle = { center = [4.0e-4, 0.0], size = [6.0e-4, 6.0e-4] }\n";
    let one_fluid = "[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n";
    let text = channel("").replace(one_fluid, fluids).replace("spacing = 1.0e-4", "spacing = 5.0e-5");
    let mut flow = flow(&text);
    run(&mut flow, 2.5e-3);
    // The drop spreads at √(σ/(ρ h)), 0.5 m/s; measured: 0.96.
    let fastest = flow.state.particles.fluid_speed();
    assert!(fastest < 1.9, "{fastest} m/s");
    assert_eq!(missing(&flow), [0, 0]);
}

#[test]
fn a_given_flow_through_periodic_sides_brings_back_one_phase() {
    let sides = "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"symmetry\"\ntop = \"symmetry\"\n\
                 [sph.sides.open.left]\nvelocity = 0.01\nphase = \"non-wetting\"\n[sph.initial.velocity]\nuniform = [0.01, 0.0]\n";
    let drop = OTHER_FLUID.replace(
        "center = [1.0e-3, 0.0], size = [4.0e-3, 1.0e-3]",
        "center = [1.5e-3, 5.0e-4], size = [4.0e-4, 2.0e-3]",
    );
    let mut flow = flow(&channel(&format!("{sides}{drop}")));
    assert_eq!(BoundaryFluxes::count(&flow.state.particles.phase[..flow.state.particles.fluids])[0], 40);
    run(&mut flow, 0.15);
    assert_eq!(BoundaryFluxes::count(&flow.state.particles.phase[..flow.state.particles.fluids]), [0, 200]);
    assert_eq!(missing(&flow), [0, 0]);
    let mean = flow.state.particles.velocity[..200].iter().map(|v| v.x).sum::<f64>() / 200.0;
    assert!((mean / 0.01 - 1.0).abs() < 1e-6, "{mean}");
}

/// The larger relative error of the flow rates over `count` steps of `dt` (s), by the ways of all particles.
fn rate_error(flow: &mut Flow, count: usize, dt: f64) -> f64 {
    flow.state.given_flows.iter_mut().for_each(|given| given.largest_error = 0.0);
    for _ in 0..count {
        let (before, passed): (f64, Vec<f64>) =
            (flow.state.time, flow.state.given_flows.iter().map(|given| given.passed).collect());
        flow.step(before + dt).unwrap();
        let taken = flow.state.time - before;
        for ((side, given), passed) in flow.config.open.through.iter().zip(&mut flow.state.given_flows).zip(passed) {
            let rate = (given.passed - passed) / taken;
            let error = (rate / side.flow_rate() - 1.0).abs();
            given.largest_error = given.largest_error.max(error);
        }
    }
    flow.state.given_flows.iter().map(|given| given.largest_error).fold(0.0, f64::max)
}

/// [PatankarLiuSparrow1977]
#[test]
fn a_given_flow_rate_holds_in_every_step_and_takes_the_pressure_of_a_parabola() {
    // The step is twice as long as viscosity allows explicitly, and 16 times that.
    for (dt, profile) in [(1.5e-3, "plug"), (1.2e-2, "parabolic")] {
        let sides = format!(
            "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n[sph.sides.open.left]\nvelocity = 1.0e-3\nprofile = \"{profile}\"\n"
        );
        let mut flow = flow(&channel(&sides).replace("spacing = 1.0e-4", "spacing = 5.0e-5"));
        let error = rate_error(&mut flow, 4, dt);
        assert!(error < 1e-9, "{error:.1e} at {dt} s from the start");
        // Three times density H²/viscosity/π²: what is left of the start is exp(-12) of it.
        run(&mut flow, 1.2);
        let error = rate_error(&mut flow, 4, dt);
        assert!(error < 1e-9, "{error:.1e} at {dt} s at the end");
        let exact = 12.0 * 1.0e-3 * 1.0e-3 / 1.0e-6;
        let gradient = flow.view().driving_gradient().x;
        println!("{profile}: gradient over exact {:.5}", gradient / exact);
        assert!((gradient / exact - 1.0).abs() < 0.01, "{gradient:.4} Pa/m, exact {exact:.4}");
    }
}

/// [PatankarLiuSparrow1977]
#[test]
fn given_flows_along_both_axes_pass_an_obstacle_and_a_second_phase() {
    let text = channel(&format!(
        "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n\
         [sph.sides.open.left]\nvelocity = 1.0e-3\n[sph.sides.open.top]\nflow-rate = 3.0e-6\n{}",
        OTHER_FLUID.replace("density = 1000.0", "density = 10.0").replace(
            "rectangle = { center = [1.0e-3, 0.0], size = [4.0e-3, 1.0e-3] }",
            "disc = { center = [4.0e-4, 5.0e-4], radius = 2.5e-4 }"
        )
    ));
    let solid = "max = [2.0e-3, 1.0e-3]\nshapes = [{ disc = { center = [1.3e-3, 4.0e-4], radius = 2.5e-4 } }]\n";
    let wetting = "[sph.wetting.young]\ncontact-angle-deg = 60.0\n";
    let mut flow = flow(&(text.replace("max = [2.0e-3, 1.0e-3]\n", solid) + wetting));
    let error = rate_error(&mut flow, 40, 1.0e-3);
    println!("error {error:.1e}, particles set back {}", flow.work.set_back);
    assert!(error < 1e-6, "{error:.1e}");
    let (left, top) = (&flow.state.given_flows[0], &flow.state.given_flows[1]);
    assert!(left.gradient > 0.0 && top.gradient > 0.0, "{left:?}, {top:?}");
}

#[test]
fn a_given_flow_that_solids_block_is_refused() {
    let text = channel(
        "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n[sph.sides.open.left]\nvelocity = 1.0e-3\n",
    )
    .replace(
        "max = [2.0e-3, 1.0e-3]\n",
        "max = [2.0e-3, 1.0e-3]\nshapes = [{ rectangle = { center = [1.0e-3, 5.0e-4], size = [8.0e-4, 2.0e-3] } }]\n",
    );
    let error = flow(&text).step(1.0).unwrap_err().to_string();
    assert!(error.contains("through the side `left`"), "{error}");
}

/// A channel of 1 mm between walls or mirrors, with a solid below and above of random heights, none of which the lattice fits.
fn narrowed(dice: &mut Dice) -> (String, f64) {
    let [low, high] = [dice.between(0.05e-3, 0.35e-3), dice.between(0.6e-3, 0.95e-3)];
    // Two openings between three solids, or one.
    let middle = if dice.between(0.0, 1.0) < 0.5 { 0.0 } else { dice.between(0.06e-3, 0.12e-3) };
    let shape = |from: f64, to: f64| {
        let (center, size) = (0.5 * (from + to), to - from);
        format!("{{ rectangle = {{ center = [1.0e-3, {center:e}], size = [4.0e-3, {size:e}] }} }}")
    };
    let mut shapes = vec![shape(-1e-3, low), shape(high, 2e-3)];
    if middle > 0.0 {
        shapes.push(shape(0.45e-3, 0.45e-3 + middle));
    }
    let form = if middle == 0.0 && dice.between(0.0, 1.0) < 0.5 { "parabolic" } else { "plug" };
    let given = if dice.between(0.0, 1.0) < 0.5 { "velocity = 1.0e-2" } else { "flow-rate = 4.0e-6" };
    let width = high - low - middle;
    let sides = format!(
        "[sph.sides]\nleft = \"inlet\"\nright = \"outlet\"\n[sph.sides.open.left]\n{given}\nprofile = \"{form}\"\n"
    );
    let spacing = dice.between(4e-5, 9e-5);
    let asked = if given.starts_with("flow") { 4.0e-6 } else { 1.0e-2 * width };
    let text = channel(&sides)
        .replace("max = [2.0e-3, 1.0e-3]\n", &format!("max = [2.0e-3, 1.0e-3]\nshapes = [{}]\n", shapes.join(", ")))
        .replace("spacing = 1.0e-4", &format!("spacing = {spacing:e}"))
        .replace("viscosity = 1.0e-3", "viscosity = 1.0e-2");
    (text, asked)
}

/// Issue: an opening of 6.5 rows brought 1.154 times the velocity that was asked for, as the rows counted as whole spacings.
#[test]
fn an_inlet_brings_the_flow_that_is_asked_for_whatever_the_width_of_its_openings() {
    let count = std::env::var("MENISCUS_INLETS").ok().and_then(|count| count.parse().ok()).unwrap_or(2);
    let mut dice = Dice::new(5);
    for _ in 0..count {
        let (text, asked) = narrowed(&mut dice);
        let mut flow = flow(&text);
        let end = 1.0e-3 * 1.0e-3 / asked;
        run(&mut flow, end);
        let volume = flow.config.method.volume;
        let side = &flow.config.open.sides[0];
        assert!((side.flow_rate() / asked - 1.0).abs() < 1e-9, "{} of {asked}", side.flow_rate());
        assert!(
            (flow.state.fluxes.passed[0] / (asked * end) - 1.0).abs() < 1e-9,
            "{} in {text}",
            flow.state.fluxes.passed[0]
        );
        // What is counted comes in whole particles of each row.
        let rows: Vec<usize> = side.openings.iter().map(|opening| opening.rows(side.row_spacing)).collect();
        let came = flow.state.fluxes.totals().0[0] as f64 * volume;
        assert!(
            (came - asked * end).abs() < rows.iter().sum::<usize>() as f64 * volume,
            "{came} of {} in {text}",
            asked * end
        );
        assert_eq!(missing(&flow), [0, 0]);
        // And it goes on through the channel: n rows sample the parabola across it as the midpoint rule does, 1/(2n²) too high.
        let fewest = *rows.iter().min().unwrap() as f64;
        let fluids = flow.state.particles.fluids;
        let carried = flow.state.particles.velocity[..fluids].iter().map(|v| v.x).sum::<f64>() * volume / 2.0e-3;
        println!("{fewest} rows: {:.4} of the flow", carried / asked);
        assert!((carried / asked - 1.0).abs() < 0.02 + 0.5 / (fewest * fewest), "{carried} of {asked} in {text}");
    }
}

#[test]
fn a_given_velocity_rises_at_its_rate_through_an_inlet_and_a_period() {
    let (first, acceleration, end) = (0.01, 0.2, 0.05);
    // Rows at an outlet leave with the velocity that they have.
    for (right, tolerance) in [("periodic", 1e-14), ("outlet", 1.2e-4)] {
        let left = if right == "periodic" { right } else { "inlet" };
        let sides = format!(
            "[sph.sides]\nleft = \"{left}\"\nright = \"{right}\"\nbottom = \"symmetry\"\ntop = \"symmetry\"\n\
             [sph.sides.open.left]\nvelocity = {first}\nacceleration = {acceleration}\n[sph.initial.velocity]\nuniform = [{first}, 0.0]\n"
        );
        let mut flow = flow(&channel(&sides));
        while flow.state.time < end {
            flow.step((flow.state.time + 2.0e-4).min(end)).unwrap();
        }
        let mean = flow.state.particles.velocity[..200].iter().map(|v| v.x).sum::<f64>() / 200.0;
        // The velocity of a step is that at its beginning.
        let exact = first + acceleration * (end - flow.state.last_dt);
        println!("{right}: mean velocity over exact {:.2e}", mean / exact - 1.0);
        assert!((mean / exact - 1.0).abs() < tolerance, "{right}: {mean} m/s, exact {exact}");
        let side = flow.config.open.sides.iter().chain(&flow.config.open.through).find(|side| side.number == 0);
        assert!((side.unwrap().velocity_at(end).unwrap() / 0.02 - 1.0).abs() < 1e-12);
    }
}
