//! Viscosity by the velocity at the end of the step: what it shares with the explicit form, and what long steps must not do.

use crate::support::boxes::{case, fastest, steps};
use crate::support::cloud::Dice;
use crate::support::flow::flow;
use meniscus_case::ViscousStep;
use meniscus_core::math::Vec2;
use meniscus_sph::flow::Flow;

/// The forms of the viscous term.
const FORMS: [&str; 3] = ["stress", "morris", "szewc"];

/// Sides of all kinds but open ones, with slip: a mirror of each kind and two walls.
const SIDES: &str = "[sph.sides]\nleft = \"image\"\nright = \"symmetry\"\n[sph.walls]\nslip-length = 5.0e-5\n";

const PERIODIC: &str =
    "[sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n";

/// Two fluids of densities 1000 and 100 kg/m³ and viscosities 1 and 0.01 Pa s without tension, and a random velocity of each particle.
fn stirred(form: &str, sides: &str) -> Flow {
    let mut flow = flow(&case(&format!(
        "[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0\n[sph.phases.non-wetting]\ndensity = 100.0\nviscosity = 0.01\n\
         [sph.interface]\ntension = 0.0\n[[sph.initial.wetting]]\ndisc = {{ center = [0.0, 0.0], radius = 3.0e-4 }}\n\
         [sph.numerics]\nviscous-term = \"{form}\"\ndensity-error-shifting = 0.0\nshifting = 0.0\n{sides}"
    )));
    flow.config.method.numerics.viscous_step = ViscousStep::Implicit;
    flow.config.viscous_time = f64::INFINITY;
    let mut dice = Dice::new(1);
    for a in 0..flow.state.particles.fluids {
        flow.state.particles.velocity[a] = 1.0e-3 * dice.vector();
    }
    flow
}

/// Twice the kinetic energy of the fluid in J/m.
fn energy(flow: &Flow) -> f64 {
    let of = |a: usize| {
        flow.config.method.fluid(flow.state.particles.phase[a]).density
            * flow.state.particles.velocity[a].norm_squared()
    };
    (0..flow.state.particles.fluids).map(of).sum::<f64>() * flow.config.method.volume
}

/// The explicit limit of the step in s.
fn explicit_limit(flow: &Flow) -> f64 {
    1.0 / flow.view().viscous_rate()
}

/// [Liniger1970]
#[test]
fn a_channel_starts_as_with_the_explicit_form() {
    // Two layers of a fluid at rest, pushed along the walls, on which they slip, for a third of the time that they take to become steady.
    let text = |form: &str| {
        case(&format!(
            "gravity = [0.01, 0.0]\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 0.1\n\
             [sph.phases.non-wetting]\ndensity = 1000.0\nviscosity = 0.02\n[sph.interface]\ntension = 0.0\n\
             [[sph.initial.wetting]]\nrectangle = {{ center = [0.0, -5.0e-4], size = [2.0e-3, 1.0e-3] }}\n\
             [sph.numerics]\nviscous-term = \"{form}\"\n\
             [sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n[sph.walls]\nslip-length = 5.0e-5\n"
        ))
    };
    for form in FORMS {
        let after = |step: ViscousStep, count: usize| {
            let mut flow = flow(&text(form));
            flow.config.method.numerics.viscous_step = step;
            flow.config.viscous_time = f64::INFINITY;
            steps(&mut flow, count, 5.0e-3 / count as f64);
            flow.state.particles.velocity[..flow.state.particles.fluids].iter().map(|v| v.x).sum::<f64>()
        };
        let oracle = after(ViscousStep::Explicit, 2000);
        // Steps of 4 and 2 times the explicit limit, whose errors are between the first and the second order.
        let [long, short] = [50, 100].map(|count| (after(ViscousStep::Implicit, count) / oracle - 1.0).abs());
        assert!(long < 0.01 && short < 0.6 * long, "{form}: off by {long:.1e}, with half the step {short:.1e}");
    }
}

/// [Liniger1970]
#[test]
fn a_shear_wave_decays_by_the_factor_of_the_method() {
    let shear = |step: ViscousStep, dt: f64| {
        let mut flow = flow(&case(&format!("[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 0.1\n{PERIODIC}")));
        flow.config.method.numerics.viscous_step = step;
        flow.config.viscous_time = f64::INFINITY;
        let wave = |x: Vec2| (std::f64::consts::TAU * x.y / 1.0e-3).cos();
        for a in 0..flow.state.particles.fluids {
            flow.state.particles.velocity[a] = Vec2::new(1.0e-4 * wave(flow.state.particles.position[a]), 0.0);
        }
        let limit = explicit_limit(&flow);
        steps(&mut flow, 1, dt);
        let left = |a: usize| flow.state.particles.velocity[a].x * wave(flow.state.particles.position[a]);
        let fluids = flow.state.particles.fluids;
        (2.0e4 * (0..fluids).map(left).sum::<f64>() / fluids as f64, limit)
    };
    let short = 1.0e-6;
    let (left, limit) = shear(ViscousStep::Explicit, short);
    let rate = (1.0 - left) / short;
    for dt in [2.0 * limit, 20.0 * limit] {
        // The largest rate is twice the inverse of the limit.
        let z = 2.0 * dt / limit;
        let theta = 1.0 / (1.0 - (-z).exp()) - 1.0 / z;
        let factor = 1.0 - rate * dt / (1.0 + theta * rate * dt);
        let (left, _) = shear(ViscousStep::Implicit, dt);
        assert!((left - factor).abs() < 1e-5, "{left} is left of {factor} after {:.1} limits", dt / limit);
    }
}

#[test]
fn steps_far_beyond_the_explicit_limit_bring_every_motion_to_rest() {
    for (form, sides) in FORMS.into_iter().flat_map(|form| [(form, SIDES), (form, PERIODIC)]) {
        for times in [3.0, 30.0] {
            let mut flow = stirred(form, sides);
            let dt = times * explicit_limit(&flow);
            let before = energy(&flow);
            for _ in 0..20 {
                let until = flow.state.time + dt;
                while flow.state.time < until {
                    flow.step(until).unwrap();
                }
            }
            // Momentum stays where no wall takes it.
            let last = energy(&flow);
            assert!(last < 0.2 * before, "{form}, {times} times the limit: {before:.3e} to {last:.3e} J/m");
        }
    }
}

#[test]
fn viscosity_at_the_end_of_the_step_keeps_momentum() {
    let mut flow = stirred("morris", PERIODIC);
    let momentum = |flow: &Flow| -> Vec2 {
        let of = |a: usize| {
            flow.config.method.fluid(flow.state.particles.phase[a]).density * flow.state.particles.velocity[a]
        };
        (0..flow.state.particles.fluids).map(of).sum()
    };
    let size: f64 = (0..flow.state.particles.fluids)
        .map(|a| {
            flow.config.method.fluid(flow.state.particles.phase[a]).density * flow.state.particles.velocity[a].norm()
        })
        .sum();
    let (before, dt) = (momentum(&flow), 30.0 * explicit_limit(&flow));
    steps(&mut flow, 1, dt);
    // The pressure gradient by differences keeps momentum on the lattice only, where the particles are; the rest is the residual.
    assert!((momentum(&flow) - before).norm() < 1e-5 * size, "{:.1e}", (momentum(&flow) - before).norm() / size);
}

#[test]
fn a_steady_flow_does_not_hang_on_the_step() {
    let steady = |dt: f64| {
        let mut flow = flow(&case(
            "gravity = [0.01, 0.0]\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 0.1\n\
             [sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\n",
        ));
        flow.config.method.numerics.viscous_step = ViscousStep::Implicit;
        flow.config.viscous_time = f64::INFINITY;
        // Three viscous times density H²/viscosity.
        steps(&mut flow, (0.03 / dt).round() as usize, dt);
        fastest(&flow)
    };
    let (short, long) = (steady(2.0e-5), steady(1.0e-3));
    assert!((long / short - 1.0).abs() < 1e-5, "{short} and, with steps 50 times as long, {long} m/s");
}

/// Neighbors on a lattice lie on the edge of the support but for rounding, where ∇W is next to nothing, and its square less.
#[test]
fn pairs_on_the_edge_of_the_support_do_not_stop_the_viscous_step() {
    for spacing in ["0.025", "0.1"] {
        let mut flow = flow(&format!(
            "format = 1\ntitle = \"A lattice\"\n[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\n[time]\nend = 1.0\n\
             [sph]\nspacing = {spacing}\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 100.0\n\
             [sph.sides]\nspeed = {{ top = 1.0 }}\n[sph.numerics]\nviscous-term = \"szewc\"\n"
        ));
        flow.config.method.numerics.viscous_step = ViscousStep::Implicit;
        flow.config.viscous_time = f64::INFINITY;
        steps(&mut flow, 2, 1.0e-4);
    }
}

/// [Kan1986]
#[test]
fn a_flow_around_a_cylinder_hardly_hangs_on_the_step() {
    let mean = |dt: f64| {
        let mut flow = flow(
            "format = 1\ntitle = \"A cylinder\"\n[geometry]\nmin = [-5.0e-4, -5.0e-4]\nmax = [5.0e-4, 5.0e-4]\n\
             shapes = [{ disc = { center = [0.0, 0.0], radius = 2.5e-4 } }]\n[time]\nend = 1.0\n\
             [sph]\nspacing = 4.0e-5\ngravity = [0.01, 0.0]\n[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 0.01\n\
             [sph.sides]\nleft = \"periodic\"\nright = \"periodic\"\nbottom = \"periodic\"\ntop = \"periodic\"\n",
        );
        flow.config.method.numerics.viscous_step = ViscousStep::Implicit;
        flow.config.viscous_time = f64::INFINITY;
        // Six times of its slowest mode.
        steps(&mut flow, (0.024 / dt).round() as usize, dt);
        flow.state.particles.velocity[..flow.state.particles.fluids].iter().map(|v| v.x).sum::<f64>()
    };
    let (short, long) = (mean(4.0e-5), mean(8.0e-4));
    // Without the leak of the pressure taken out, the flow of long steps is a tenth faster.
    assert!((long / short - 1.0).abs() < 0.01, "{long} and {short}");
}

/// [Brackbill1992]
#[test]
fn no_particle_goes_farther_in_a_step_than_its_limit_allows() {
    // The corners of a square drop, and a lid that moves at once; the largest displacement in a step over h, from the page on forces.
    let drop = "[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n[sph.phases.non-wetting]\ndensity = 1000.0\nviscosity = 5.0e-3\n\
                [sph.interface]\ntension = 0.02\n[[sph.initial.wetting]]\nrectangle = { center = [0.0, 0.0], size = [6.0e-4, 6.0e-4] }\n\
                [sph.numerics]\ntime-step-factor = 2.0\n";
    let lid = "[sph.phases.wetting]\ndensity = 1000.0\nviscosity = 1.0e-3\n[sph.sides]\nspeed = { top = 0.1 }\n";
    let slower = drop.replace("2.0\n", "1.0\n");
    for (name, text, limit) in [("drop", drop, 0.3), ("drop, no factor", &slower, 0.25), ("lid", lid, 0.125)] {
        let mut flow = flow(&case(text));
        flow.config.method.numerics.viscous_step = ViscousStep::Implicit;
        flow.config.viscous_time = f64::INFINITY;
        for _ in 0..20 {
            flow.step(1.0).unwrap();
            let displacement = flow.state.particles.fluid_speed() * flow.state.last_dt / flow.config.method.kernel.h;
            // What shifted particles take along of the velocity around them comes on top.
            assert!(displacement < 1.1 * 1.5 * limit, "{name}: {displacement} h in step {}", flow.state.steps);
        }
    }
}
