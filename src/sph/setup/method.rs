//! The constants of the method.

use crate::case::{LineDelta, Sph, SurfaceForce};
use crate::sph::boundary::no_slip::NoSlip;
use crate::sph::fill::Lattice;
use crate::sph::kernel::WendlandC2;
use crate::sph::method::Method;
use crate::sph::poisson::Tolerance;

/// Most iterations of a pressure solve; a healthy one takes about ten.
const ITERATIONS: usize = 300;

pub(super) fn method(sph: &Sph, lattice: &Lattice) -> Method {
    let kernel = lattice.consistent(WendlandC2::new(sph.smoothing_ratio * sph.spacing));
    let numerics = &sph.numerics;
    Method {
        kernel,
        spacing: sph.spacing,
        volume: lattice.volume(),
        wetting_fluid: sph.wetting,
        other_fluid: sph.non_wetting.unwrap_or(sph.wetting),
        tension: sph.tension,
        surface_force: sph.surface_force.unwrap_or(SurfaceForce::Csf { line_delta: LineDelta::Normalized }),
        wetting: sph.wetting_model,
        patches: sph.wetting_patches.iter().map(|patch| patch.model).collect(),
        gravity: sph.gravity,
        no_slip: NoSlip {
            spacing: sph.spacing,
            largest_stretch: numerics.wall_stretch,
            slip_length: sph.walls.slip_length,
            line_slip_length: sph.walls.line_slip_length,
        },
        numerics: *numerics,
        tolerance: Tolerance { residual: numerics.pressure_tolerance, iterations: ITERATIONS },
    }
}
