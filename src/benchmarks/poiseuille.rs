//! Error of the velocity against plane Poiseuille flow (A1 of the benchmarks), with its start-up, and the slip length found.

use nalgebra::{Matrix2, Vector2};

use crate::analysis::laws::flow::Poiseuille;
use crate::solver::Measure;
use crate::sph::measures::{Group, Subject, measure};
use crate::sph::open::{Drive, OpenSide};

/// Measures of its table `[sph.measure.poiseuille]`.
pub const GROUP: Group = Group::of(measures);

/// The force per volume in N/m³ that drives the flow, and whether it does so from time zero on.
fn force(s: &Subject) -> (f64, bool) {
    let (flow, size) = (s.flow, s.flow.setting.domain.bounds.size());
    let fluid = flow.setting.method.wetting_fluid;
    let weight = fluid.density * flow.setting.method.gravity.x;
    let inlets = flow.setting.open.sides.iter().chain(&flow.setting.open.through);
    for side in inlets {
        if let Drive::Velocity(profile) = &side.drive {
            return (12.0 * fluid.viscosity * profile.mean * side.inwards() / size.y.powi(2), false);
        }
    }
    let pressure = |number| {
        let side = flow.setting.open.sides.iter().find(|side| side.number == number);
        side.and_then(OpenSide::given_pressure).unwrap_or(0.0)
    };
    (weight + (pressure(0) - pressure(1)) / size.x, true)
}

fn measures(s: &Subject) -> Vec<Measure> {
    let (flow, bounds) = (s.flow, s.flow.setting.domain.bounds);
    let fluid = flow.setting.method.wetting_fluid;
    let (force, starts_up) = force(s);
    let height = bounds.size().y;
    let law = Poiseuille {
        force,
        viscosity: fluid.viscosity,
        density: fluid.density,
        height,
        slip_length: flow.setting.method.no_slip.slip_length,
    };
    let (mut error, mut size) = (0.0, 0.0);
    // Least squares of u = a y (H − y) + c.
    let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for (x, v) in
        flow.state.particles.position.iter().zip(&flow.state.particles.velocity).take(flow.state.particles.fluids)
    {
        let y = x.y - bounds.min.y;
        let exact = if starts_up { law.at(y, flow.state.time) } else { law.steady(y) };
        error += (v.x - exact).powi(2) + v.y.powi(2);
        size += exact * exact;
        let row = Vector2::new(y * (height - y), 1.0);
        matrix += row * row.transpose();
        right += v.x * row;
    }
    let slip = matrix.cholesky().map_or(f64::NAN, |matrix| {
        let found = matrix.solve(&right);
        found[1] / (found[0] * height)
    });
    let method = "L2 norm over particles of the velocity less the start-up series at the end, over that of the series; with a given flow less \
                  the steady parabola";
    let method_of_slip = "b of the parabola a (y (H - y) + H b) fitted to the velocities at the end; of a steady flow";
    vec![
        measure("velocity-l2-error", (error / size).sqrt(), "", None, method),
        measure("slip-length-m", slip, "m", None, method_of_slip),
    ]
}
