//! The constants of the method.

use crate::case::checked::{self, Sph};
use crate::sph::boundary::no_slip::NoSlip;
use crate::sph::fill::Lattice;
use crate::sph::kernel::WendlandC2;
use crate::sph::method::{Fluid, Method, ViscousStep, ViscousTerm};
use crate::sph::poisson::Tolerance;
use crate::sph::surface_force::SurfaceForce;
use crate::sph::wetting::contact_line::LineDelta;

/// Most iterations of a pressure solve; a healthy one takes about ten.
const ITERATIONS: usize = 300;

pub(super) fn method(sph: &Sph, lattice: &Lattice) -> Method {
    let kernel = lattice.consistent(WendlandC2::new(sph.smoothing_ratio * sph.spacing));
    let fluid = |f: &checked::Fluid| Fluid { density: f.density, viscosity: f.viscosity };
    let wetting_fluid = fluid(&sph.wetting);
    let numerics = &sph.numerics;
    Method {
        kernel,
        spacing: sph.spacing,
        volume: lattice.volume(),
        wetting_fluid,
        other_fluid: sph.non_wetting.as_ref().map_or(wetting_fluid, fluid),
        tension: sph.tension,
        surface_force: match sph.surface_force {
            Some(checked::SurfaceForce::PressureJump { curvature }) => SurfaceForce::PressureJump { curvature },
            Some(checked::SurfaceForce::Csf { line_delta: checked::LineDelta::Local }) => {
                SurfaceForce::Csf(LineDelta::Local)
            }
            Some(checked::SurfaceForce::Csf { .. }) | None => SurfaceForce::Csf(LineDelta::Normalized),
        },
        wetting: sph.wetting_model,
        patches: sph.wetting_patches.iter().map(|patch| patch.model).collect(),
        gravity: sph.gravity,
        no_slip: NoSlip {
            spacing: sph.spacing,
            largest_stretch: numerics.wall_stretch,
            slip_length: sph.walls.slip_length,
            line_slip_length: sph.walls.line_slip_length,
        },
        viscous_term: match numerics.viscous_term {
            checked::ViscousTerm::Szewc => ViscousTerm::Szewc,
            checked::ViscousTerm::Morris => ViscousTerm::Morris,
            checked::ViscousTerm::Stress => ViscousTerm::Stress,
        },
        viscous_step: match numerics.viscous_step {
            checked::ViscousStep::Implicit => ViscousStep::Implicit,
            checked::ViscousStep::Explicit => ViscousStep::Explicit,
        },
        density_error_correction: numerics.density_error_correction,
        density_error_shifting: numerics.density_error_shifting,
        background_pressure: numerics.background_pressure,
        shifting: numerics.shifting,
        anti_clustering: numerics.anti_clustering,
        tolerance: Tolerance { residual: numerics.pressure_tolerance, iterations: ITERATIONS },
        time_step_factor: numerics.time_step_factor,
    }
}
