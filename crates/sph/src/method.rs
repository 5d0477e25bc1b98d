//! The constants of a run: fluids, forces and parameters of the discretization.

use crate::boundary::no_slip::NoSlip;
use crate::kernel::WendlandC2;
use crate::particles::Phase;
use crate::poisson::Tolerance;
use meniscus_case::{Fluid, Numerics, SurfaceForce};
use meniscus_core::math::Vec2;
use meniscus_geometry::interface::depth::Depth;
use meniscus_wetting::Wetting;

/// Density ratio above which the symmetric pressure gradient (Eq. 15) fails.
const LARGEST_SYMMETRIC_RATIO: f64 = 5.0;

/// Density ratio above which the unweighted continuum force makes the light particles too fast.
const LARGEST_WEIGHTED_RATIO: f64 = 20.0;

/// The density-error correction has its full rate if the fastest particle moves this far, over dx, in the time of the correction.
const FULL_CORRECTION_MOVE: f64 = 0.005;

/// Forms of the pressure gradient, see `terms::pressure_gradient`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PressureGradient {
    /// [Huber2013, Eq. 15].
    Symmetric,
    /// Hu & Adams 2006.
    Weighted,
    /// Differences, consistent with Eq. (30).
    Difference,
}

/// Constants of a run.
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
    /// Form of the surface force.
    pub surface_force: SurfaceForce,
    /// Wetting model.
    pub wetting: Option<Wetting>,
    /// Wetting models of parts of the walls that differ.
    pub patches: Vec<Wetting>,
    /// Body force per mass in m/s².
    pub gravity: Vec2,
    /// No-slip or slip condition on walls.
    pub no_slip: NoSlip,
    /// Floor and lid; `None` in the plane.
    pub plates: Option<Plates>,
    /// Discretization options and tolerances.
    pub numerics: Numerics,
    /// Pressure solve.
    pub tolerance: Tolerance,
}

/// Effect of floor and lid on a flow averaged over its depth b (Gondret and Rabaud 1997).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plates {
    /// Factor α of the velocity profile over the depth, on inertia and on the in-plane viscous stress.
    pub profile: f64,
    /// 12/b² in 1/m²: the friction per volume is this times viscosity and velocity.
    pub friction: f64,
    /// Depth, for the curvature of the interface across it.
    pub depth: Depth,
}

impl Method {
    /// The factor α on inertia and on the in-plane viscous stress, 1 without floor and lid.
    pub(crate) fn profile(&self) -> f64 {
        self.plates.map_or(1.0, |plates| plates.profile)
    }

    /// The fluid of a phase; walls count as wetting.
    pub fn fluid(&self, phase: Phase) -> &Fluid {
        if phase == Phase::NonWetting { &self.other_fluid } else { &self.wetting_fluid }
    }

    /// ρ̄ = (ρ_w + ρ_n)/2 in kg/m³.
    pub fn mean_density(&self) -> f64 {
        0.5 * (self.wetting_fluid.density + self.other_fluid.density)
    }

    /// The larger viscosity in Pa s.
    pub(crate) fn largest_viscosity(&self) -> f64 {
        self.wetting_fluid.viscosity.max(self.other_fluid.viscosity)
    }

    /// Larger over smaller density.
    pub(crate) fn density_ratio(&self) -> f64 {
        let (a, b) = (self.wetting_fluid.density, self.other_fluid.density);
        (a / b).max(b / a)
    }

    /// The form of the pressure gradient.
    ///
    /// With the continuum surface force of the paper, its form at small density ratios; differences with the pressure jump, without
    /// tension, and at large density ratios, where the other forms fail.
    pub(crate) fn pressure_gradient(&self) -> PressureGradient {
        let ratio = self.density_ratio();
        let has_jump = matches!(self.surface_force, SurfaceForce::PressureJump { .. });
        if self.tension == 0.0 || has_jump || ratio > LARGEST_WEIGHTED_RATIO {
            PressureGradient::Difference
        } else if ratio > LARGEST_SYMMETRIC_RATIO {
            PressureGradient::Weighted
        } else {
            PressureGradient::Symmetric
        }
    }

    /// Weight of the continuum forces at a particle of density `rho` (kg/m³): 1 as in the paper, ρ/ρ̄ at large ratios.
    ///
    /// With ρ/ρ̄ light particles are not accelerated excessively, but a concave interface then becomes unstable as in Rayleigh-Taylor
    /// flow, the heavy fluid being pulled towards the light one, and they mix: four discs at ratio 10 shed particles.
    pub(crate) fn force_weight(&self, rho: f64) -> f64 {
        if self.pressure_gradient() == PressureGradient::Difference { rho / self.mean_density() } else { 1.0 }
    }

    /// The rate in 1/s at which the pressure corrects the density error: γ/τ min(1, v τ/(.005 dx)) with the time τ of the correction
    /// ([`Method::density_correction_time`]). `fastest` is the largest speed in m/s relative to the mean velocity of all.
    ///
    /// Density errors arise from motion: in a fluid nearly at rest the correction itself would move the particles. They grow with time,
    /// not with the number of steps: a light gas, whose viscosity requires short steps, must not be corrected as strongly in each of them.
    pub fn density_correction_rate(&self, fastest: f64) -> f64 {
        let tau = self.density_correction_time(fastest);
        self.numerics.density_error_correction / tau * (fastest * tau / (FULL_CORRECTION_MOVE * self.spacing)).min(1.0)
    }

    /// The background pressure p_0 in Pa for a fluid whose largest speed is `speed` (m/s).
    pub(crate) fn background_pressure_at(&self, speed: f64) -> f64 {
        let scale = if self.tension > 0.0 { self.tension / self.kernel.h } else { self.mean_density() * speed * speed };
        self.numerics.background_pressure * scale
    }

    /// ∇κ = (ρ_w − ρ_n) g/σ in 1/m² of an interface at rest, κ positive where the wetting phase is convex (Young and Laplace).
    pub fn curvature_gradient(&self) -> Vec2 {
        (self.wetting_fluid.density - self.other_fluid.density) / self.tension * self.gravity
    }

    /// The speed of capillary waves of the length h, sqrt(σ/(ρ̄ h)), in m/s.
    pub(crate) fn capillary_speed(&self) -> f64 {
        (self.tension / (self.mean_density() * self.kernel.h)).sqrt()
    }
}
