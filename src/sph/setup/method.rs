//! The constants of the method, and the wetting models.

use crate::case::checked::{self, Sph, WettingModel};
use crate::sph::boundary::no_slip::NoSlip;
use crate::sph::fill::Lattice;
use crate::sph::kernel::WendlandC2;
use crate::sph::method::{Fluid, Method, ViscousStep, ViscousTerm};
use crate::sph::poisson::Tolerance;
use crate::sph::surface_force::SurfaceForce;
use crate::sph::wetting::contact_line::LineDelta;
use crate::sph::wetting::{
    CoxVoinov, Hysteresis, Jiang, Kistler, LineFriction, MolecularKinetic, TadmorAngle, Wetting, YoungForce,
};

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
        wetting: sph.wetting_model.map(wetting),
        patches: sph.wetting_patches.iter().map(|patch| wetting(patch.model)).collect(),
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

fn wetting(model: WettingModel) -> Wetting {
    match model {
        WettingModel::Young { contact_angle } => Wetting::Young(YoungForce { contact_angle }),
        WettingModel::Tadmor { advancing, receding } => Wetting::Tadmor(TadmorAngle { advancing, receding }),
        WettingModel::LineFriction { contact_angle, friction } => {
            Wetting::LineFriction(LineFriction { contact_angle, friction })
        }
        WettingModel::MolecularKinetic { contact_angle, frequency, jump_length, temperature } => {
            Wetting::MolecularKinetic(MolecularKinetic { contact_angle, frequency, jump_length, temperature })
        }
        WettingModel::CoxVoinov { contact_angle, slip_length } => {
            Wetting::CoxVoinov(CoxVoinov { contact_angle, slip_length })
        }
        WettingModel::Kistler { contact_angle } => Wetting::Kistler(Kistler { contact_angle }),
        WettingModel::Jiang { contact_angle } => Wetting::Jiang(Jiang { contact_angle }),
        WettingModel::Hysteresis { advancing, receding } => Wetting::Hysteresis(Hysteresis { advancing, receding }),
    }
}
