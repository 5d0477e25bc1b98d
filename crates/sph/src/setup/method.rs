//! The constants of the method.

use std::f64::consts::FRAC_PI_2;

use crate::boundary::no_slip::NoSlip;
use crate::fill::Lattice;
use crate::kernel::WendlandC2;
use crate::method::{Method, Plates};
use crate::poisson::Tolerance;
use meniscus_case::{LineDelta, Sph, SurfaceForce, on_plates};
use meniscus_geometry::Geometry;
use meniscus_geometry::interface::depth::{Depth, profile_factor};
use meniscus_geometry::throats::throats;
use meniscus_wetting::Wetting;

/// Maximum number of iterations of a pressure solve; a typical one takes about ten.
const ITERATIONS: usize = 300;

pub(super) fn method(sph: &Sph, geometry: &Geometry, lattice: &Lattice) -> Method {
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
        plates: sph.depth.map(|depth| plates(sph, geometry, lattice, depth)),
        numerics: *numerics,
        tolerance: Tolerance { residual: numerics.pressure_tolerance, iterations: ITERATIONS },
    }
}

/// The median of the throat widths (m), given in ascending order.
pub(super) fn median_width(widths: &[f64]) -> Option<f64> {
    widths.get(widths.len() / 2).copied()
}

/// Floor and lid at the distance `depth` (m). The profile factor is that of a duct as wide as the median throat, or as the largest circle in the
/// pore if there is none; floor and lid keep the static angles also at moving contact lines.
fn plates(sph: &Sph, geometry: &Geometry, lattice: &Lattice, depth: f64) -> Plates {
    let all: Vec<f64> = throats(geometry).iter().map(|throat| throat.width).collect();
    let largest = || lattice.inside().map(|x| 2.0 * geometry.signed_distance(x)).fold(0.0, f64::max);
    let width = median_width(&all).unwrap_or_else(largest);
    let at_rest = match &sph.wetting_model {
        Some(model) => {
            Depth::new(depth, model.static_angle(), on_plates(model, &sph.wetting_patches, Wetting::static_angle))
        }
        None => Depth::new(depth, FRAC_PI_2, [FRAC_PI_2; 2]),
    };
    let profile = sph.profile_factor.unwrap_or_else(|| profile_factor(width / depth));
    Plates { profile, friction: 12.0 / (depth * depth), depth: at_rest }
}
