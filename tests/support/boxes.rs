//! Boxes of 1 mm with at most 300 particles, walls included: their pressure is solved directly, so that two runs of the same problem
//! in other words differ by rounding only.

use meniscus_sph::flow::Flow;

/// Particles along a side of the box of 1 mm.
const SPACING: &str = "1.0e-4";

/// A case in a box of 1 mm; `rest` holds the tables that differ.
pub fn case(rest: &str) -> String {
    format!(
        "format = 1\ntitle = \"A box\"\n[geometry]\nmin = [-5.0e-4, -5.0e-4]\nmax = [5.0e-4, 5.0e-4]\n[time]\nend = 1.0\n\
         [sph]\nspacing = {SPACING}\n{rest}"
    )
}

/// Both forms of the surface force.
pub const SURFACE_FORCES: [&str; 2] = ["csf", "pressure-jump"];

/// Steps of equal length (s), so that flows in different motion take the same ones.
pub fn steps(flow: &mut Flow, count: usize, dt: f64) {
    for _ in 0..count {
        let until = flow.state.time + dt;
        flow.step(until).unwrap();
        assert_eq!(flow.state.time, until, "the step must be short enough to be taken whole");
    }
}

/// The largest speed in m/s.
pub fn fastest(flow: &Flow) -> f64 {
    flow.state.particles.velocity.iter().map(|v| v.norm()).fold(0.0, f64::max)
}
