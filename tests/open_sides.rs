//! Open sides: flows that must pass them unchanged, the balance of what passes, and resuming with buffers.

#[path = "support/flow.rs"]
mod flow;

use flow::flow;
use meniscus::sph::open::Ledger;
use meniscus::sph::particles::Phase;
use meniscus::sph::projection::Flow;

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
    while flow.time < until {
        flow.step(until).unwrap();
    }
}

/// What is missing in the balance of each phase, in particles.
fn missing(flow: &Flow) -> [i64; 2] {
    let (came, left) = flow.open.ledger.totals();
    let inside = Ledger::count(&flow.particles.phase[..flow.particles.fluids]);
    [0, 1].map(|i| flow.open.ledger.at_start[i] as i64 + came[i] as i64 - left[i] as i64 - inside[i] as i64)
}

#[test]
fn a_uniform_flow_passes_open_sides_and_stays_uniform() {
    let mut flow = flow(&channel(PLUG));
    let start = flow.particles.fluids;
    // The fluid is replaced once and a half.
    run(&mut flow, 0.3);
    let worst =
        flow.particles.velocity[..flow.particles.fluids].iter().map(|v| (v.x - 0.01).hypot(v.y)).fold(0.0, f64::max);
    // The files move as one lattice: all that is left is the residual of the pressure solve.
    assert!(worst < 1e-8, "{worst:.1e} m/s");
    assert_eq!(missing(&flow), [0, 0]);
    assert_eq!(flow.particles.fluids, start);
    let (came, _) = flow.open.ledger.totals();
    assert_eq!(came[0], 300, "10 files, 3 mm long");
}

#[test]
fn a_column_between_two_pressures_that_carry_its_weight_rests() {
    let sides = "[sph.sides]\nleft = \"symmetry\"\nright = \"symmetry\"\nbottom = \"inlet\"\ntop = \"outlet\"\n\
                 [sph.sides.open.bottom]\npressure = 10.0\n[sph.sides.open.top]\npressure = 0.19\n";
    let text = channel(sides).replace("[sph]\n", "[sph]\ngravity = [0.0, -9.81]\n");
    let mut flow = flow(&text);
    run(&mut flow, 0.05);
    let fastest = flow.particles.velocity[..flow.particles.fluids].iter().map(|v| v.norm()).fold(0.0, f64::max);
    // Falling freely it would have reached 0.5 m/s.
    assert!(fastest < 1e-4, "{fastest:.1e} m/s");
    for a in 0..flow.particles.fluids {
        let exact = 10.0 - 9810.0 * flow.particles.position[a].y;
        assert!((flow.particles.pressure[a] - exact).abs() < 0.02, "{} for {exact}", flow.particles.pressure[a]);
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
        flow.particles.velocity[..flow.particles.fluids].iter().map(|v| v.x).sum::<f64>()
    });
    // 1e5 Pa have digits of 1e-11 Pa, and the solve leaves 1e-6 of the right side.
    assert!((speeds[0] / speeds[1] - 1.0).abs() < 1e-6, "{speeds:?}");
    assert!(speeds[0] > 0.0);
}

#[test]
fn layers_come_in_and_leave_as_layers() {
    let mut flow = flow(&channel(&format!("{PLUG}{OTHER_FLUID}")));
    run(&mut flow, 0.3);
    assert_eq!(missing(&flow), [0, 0]);
    for a in 0..flow.particles.moving() {
        let below = flow.particles.position[a].y < 5.0e-4;
        assert_eq!(flow.particles.phase[a] == Phase::Wetting, below, "at {:?}", flow.particles.position[a]);
    }
    let (came, left) = flow.open.ledger.totals();
    assert_eq!((came, left), ([150; 2], [150; 2]));
}

#[test]
fn the_phase_of_an_inlet_drives_the_other_one_out() {
    let sides = PLUG.replace("velocity = 0.01\n[", "velocity = 0.01\nphase = \"non-wetting\"\n[");
    let filled = OTHER_FLUID.replace("size = [4.0e-3, 1.0e-3]", "size = [4.0e-3, 4.0e-3]");
    let mut flow = flow(&channel(&format!("{sides}{filled}")));
    run(&mut flow, 0.3);
    // The flat front has left.
    let inside = Ledger::count(&flow.particles.phase[..flow.particles.fluids]);
    assert_eq!(inside, [0, 200]);
    assert_eq!(missing(&flow), [0, 0]);
}

#[test]
fn a_resumed_flow_with_open_sides_takes_the_same_steps() {
    let text = channel(&format!("{PLUG}{OTHER_FLUID}"));
    let (mut whole, mut first) = (flow(&text), flow(&text));
    run(&mut first, 0.03);
    run(&mut whole, 0.03);
    let mut second = flow(&text);
    meniscus::sph::state::load(&mut second, &meniscus::sph::state::save(&first)).unwrap();
    for flow in [&mut whole, &mut second] {
        run(flow, 0.06);
    }
    assert_eq!(whole.particles, second.particles);
    assert_eq!(whole.open.ledger, second.open.ledger);
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
    assert_eq!(Ledger::count(&flow.particles.phase[..flow.particles.fluids])[0], 40);
    run(&mut flow, 0.15);
    assert_eq!(Ledger::count(&flow.particles.phase[..flow.particles.fluids]), [0, 200]);
    assert_eq!(missing(&flow), [0, 0]);
    let mean = flow.particles.velocity[..200].iter().map(|v| v.x).sum::<f64>() / 200.0;
    assert!((mean / 0.01 - 1.0).abs() < 1e-6, "{mean}");
}
