//! The fluids of the subdomains, and floor and lid of their chip: conversion of curvatures into pressures, and their lines in a case.

use std::fmt::Write;

use meniscus_case::Fluid;
use meniscus_geometry::interface::depth::Depth;
use meniscus_network::cycles::FluidPhase as Phase;

/// Density in kg/m³ if the network gives none: at rest no pressure depends on it.
pub(crate) const DENSITY: f64 = 1000.0;
/// Viscosity over √(density · tension · width) if the network gives none: menisci come to rest without long oscillations.
pub(crate) const OHNESORGE: f64 = 0.1;
/// Tolerance in degrees of equal angles.
const SAME_ANGLE: f64 = 1e-9;

/// Floor and lid of the subdomains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chip {
    /// Contact angles of floor and lid through the wetting phase in rad.
    pub plates: [f64; 2],
    /// Their effect on the curvature of menisci.
    pub depth: Depth,
}

/// The fluids of the subdomains, and their chip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fluids {
    /// The wetting and the non-wetting phase, if those of the network are requested and known.
    pub given: [Option<Fluid>; 2],
    /// Interfacial tension in N/m.
    pub tension: f64,
    /// The invading phase.
    pub invading: Phase,
    /// Floor and lid; `None` in the plane.
    pub chip: Option<Chip>,
}

impl Fluids {
    /// The wetting and the non-wetting phase for a throat of a width (m).
    pub(crate) fn of(&self, width: f64) -> [Fluid; 2] {
        let other = self.given[0].or(self.given[1]);
        let default = Fluid { density: DENSITY, viscosity: OHNESORGE * (DENSITY * self.tension * width).sqrt() };
        self.given.map(|given| given.or(other).unwrap_or(default))
    }

    /// Capillary pressure in Pa, invading less defending phase, at a curvature in the plane in 1/m, of the same sign convention.
    pub(crate) fn pressure(&self, curvature: f64) -> f64 {
        let turned = |curvature| self.invading.towards_wetting(curvature);
        self.tension * self.chip.map_or(curvature, |chip| turned(chip.depth.curvature(turned(curvature))))
    }

    /// The curvature in the plane in 1/m at a pressure in Pa.
    pub(crate) fn in_plane(&self, pressure: f64) -> f64 {
        let (turned, curvature) = (|curvature| self.invading.towards_wetting(curvature), pressure / self.tension);
        self.chip.map_or(curvature, |chip| turned(chip.depth.plane(turned(curvature))))
    }

    /// Distance between floor and lid in m; 1 in the plane, where rates are per meter of depth.
    pub(crate) fn thickness(&self) -> f64 {
        self.chip.map_or(1.0, |chip| chip.depth.distance())
    }

    /// Relaxation time in s of a meniscus by the friction of floor and lid, over a length (m) in a throat of a width (m); 0 in the plane.
    pub(crate) fn friction_time(&self, length: f64, width: f64) -> f64 {
        let viscosity = self.of(width).iter().map(|fluid| fluid.viscosity).fold(0.0, f64::max);
        self.chip.map_or(0.0, |_| 12.0 * viscosity * length * width * width / (self.thickness().powi(2) * self.tension))
    }

    /// The tables of the wetting model, and of floor and lid if their angles differ; `angle` through the defending phase in rad.
    pub(crate) fn wetting(&self, angle: f64) -> String {
        let walls = self.wetting_angle(angle);
        let mut text =
            format!("[sph.wetting.young]\ncontact-angle-deg = {walls:e} # degrees through the wetting phase\n\n");
        for (plate, angle) in self.chip.iter().flat_map(|chip| ["floor", "lid"].into_iter().zip(chip.plates)) {
            let angle = angle.to_degrees();
            if (angle - walls).abs() > SAME_ANGLE {
                // Writing to a string cannot fail.
                let _ = write!(text, "[[sph.wetting.patches]]\nplate = \"{plate}\"\ncontact-angle-deg = {angle:e}\n\n");
            }
        }
        text
    }

    /// Contact angle through the wetting phase in degrees from that through the defending phase in rad.
    fn wetting_angle(&self, angle: f64) -> f64 {
        match self.invading {
            Phase::NonWetting => angle.to_degrees(),
            Phase::Wetting => (std::f64::consts::PI - angle).to_degrees(),
        }
    }
}
