//! The constants of a run: fluids, forces and parameters of the discretization.

use crate::math::Vec2;
use crate::sph::boundary::no_slip::NoSlip;
use crate::sph::kernel::WendlandC2;
use crate::sph::particles::Phase;
use crate::sph::poisson::Tolerance;
use crate::sph::wetting::Wetting;

/// Above this ratio of densities Eq. (15) fails and the difference form of the pressure gradient is used.
const LARGEST_SYMMETRIC_RATIO: f64 = 5.0;

/// A Newtonian fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fluid {
    /// Density in kg/m³.
    pub density: f64,
    /// Dynamic viscosity in Pa s.
    pub viscosity: f64,
}

/// Forms of the viscous term.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ViscousTerm {
    /// Szewc et al. 2012 [Huber2013, Eq. 16].
    Szewc,
    /// Morris et al. 1997.
    Morris,
}

/// All that does not change during a run.
#[derive(Debug, Clone)]
pub struct Method {
    /// Smoothing kernel.
    pub kernel: WendlandC2,
    /// Initial spacing dx in m.
    pub spacing: f64,
    /// V_0 in m²: volume of a particle on the perfect lattice.
    pub volume: f64,
    /// The wetting phase.
    pub wetting_fluid: Fluid,
    /// The other phase; the same as the wetting one in single-phase flow.
    pub other_fluid: Fluid,
    /// Interfacial tension in N/m, 0 in single-phase flow.
    pub tension: f64,
    /// Wetting model.
    pub wetting: Option<Wetting>,
    /// Body force per mass in m/s².
    pub gravity: Vec2,
    /// Wall velocities.
    pub no_slip: NoSlip,
    /// Viscous term.
    pub viscous_term: ViscousTerm,
    /// Share γ of the density error that the pressure takes back per step.
    pub drift_source: f64,
    /// Background pressure in units of σ/h, or of ρ v² without tension.
    pub background_pressure: f64,
    /// Particle shifting A in δr = −A h v_max Δt ∇C; 0: none.
    pub shifting: f64,
    /// Pressure solve.
    pub tolerance: Tolerance,
    /// Factor on the limits of the time step.
    pub time_step_factor: f64,
}

impl Method {
    /// The fluid of a phase; walls count as wetting.
    #[must_use]
    pub fn fluid(&self, phase: Phase) -> &Fluid {
        if phase == Phase::NonWetting { &self.other_fluid } else { &self.wetting_fluid }
    }

    /// ρ̄ = (ρ_w + ρ_n)/2 in kg/m³.
    #[must_use]
    pub fn mean_density(&self) -> f64 {
        0.5 * (self.wetting_fluid.density + self.other_fluid.density)
    }

    /// Larger over smaller density.
    #[must_use]
    pub fn density_ratio(&self) -> f64 {
        let (a, b) = (self.wetting_fluid.density, self.other_fluid.density);
        (a / b).max(b / a)
    }

    /// Whether the momentum-keeping pressure gradient of Eq. (15) is used, with its background pressure: with surface
    /// tension at small density ratios. Else the difference form.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        self.tension > 0.0 && self.density_ratio() <= LARGEST_SYMMETRIC_RATIO
    }

    /// ζ = 0.01 h in m [Huber2013, Eq. 16].
    #[must_use]
    pub fn zeta(&self) -> f64 {
        0.01 * self.kernel.h
    }
}
