//! Sums over particles: areas, saturation, capillary pressure, Laplace pressure jump, density error.
//!
//! Colors are sharp here: above 0.5 is the wetting phase. The caller leaves out solid particles.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::cells::Cells;
use crate::interface::lengths::WETTING_COLOR;
use crate::interface::polyline::Polyline;
use crate::interface::wall::WallPoint;
use meniscus_core::math::{Vec2, nearest_image};

/// Areas of the phases (volumes per depth).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PhaseAreas {
    /// Area of the wetting phase in m².
    pub wetting: f64,
    /// Area of the non-wetting phase in m².
    pub non_wetting: f64,
}

impl PhaseAreas {
    /// Sums `volumes` (m²) by `colors`.
    pub fn new(volumes: &[f64], colors: &[f64]) -> Self {
        let sum = |wetting: bool| {
            volumes.iter().zip(colors).filter(|(_, c)| (**c > WETTING_COLOR) == wetting).map(|(v, _)| v).sum()
        };
        Self { wetting: sum(true), non_wetting: sum(false) }
    }

    /// Wetting saturation: the fraction of the fluid's area.
    pub fn saturation(&self) -> f64 {
        self.wetting / (self.wetting + self.non_wetting)
    }

    /// Relative change of the wetting and the non-wetting area since `start`; NaN for a phase that was absent.
    pub fn drift_since(&self, start: &Self) -> [f64; 2] {
        [self.wetting / start.wetting - 1.0, self.non_wetting / start.non_wetting - 1.0]
    }
}

/// Fluid particles whose pressure is measured.
#[derive(Debug, Clone, Copy)]
pub struct PressureSamples<'a> {
    /// Positions in m.
    pub points: &'a [Vec2],
    /// Pressures in Pa.
    pub pressures: &'a [f64],
    pub colors: &'a [f64],
    /// Smoothing length h in m.
    pub smoothing_length: f64,
    /// Period in m along each axis, if it has one.
    pub period: [Option<f64>; 2],
}

/// Mean pressure of the non-wetting phase minus that of the wetting phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CapillaryPressure {
    /// p_n - p_w in Pa; NaN if a phase has no particle away from the interface.
    pub value: f64,
    /// Standard error of the difference in Pa, particles taken as independent.
    pub standard_error: f64,
    /// Particles of the wetting and the non-wetting phase that were used.
    pub counts: [usize; 2],
    /// Whether particles near walls could be left out, too.
    pub away_from_walls: bool,
}

/// Discretization error of a capillary pressure, relative to the pressure by the curvature κ in the plane and to (hκ)². Calibrated:
/// docs/numerics/error-bars.md.
pub(crate) const PRESSURE_RESOLUTION: f64 = 0.05;

/// The same for a phase that hardly touches its walls, above an angle of [`FLAT_CONTACT`]: smoothing across the thin gap along the wall adds to that across the
/// interface.
pub(crate) const PRESSURE_RESOLUTION_FLAT_CONTACT: f64 = 0.14;

/// Contact angle in degrees above which the gap along the wall is too thin for the smoothing.
pub(crate) const FLAT_CONTACT: f64 = 160.0;

/// Relative error due to the lattice that remains at any spacing.
pub(crate) const PRESSURE_FLOOR: f64 = 5e-4;

/// Relative error of the part by the curvature in the plane that remains where interfaces meet walls.
pub(crate) const PRESSURE_FLOOR_AT_WALLS: f64 = 1.5e-3;

impl CapillaryPressure {
    /// Standard uncertainty in Pa: the scatter of the particles, and the effect of the smoothing length `h` (m) at the `tension` (N/m) on the part
    /// `in_plane` (Pa) of the pressure that the curvature in the plane makes; `angle` is that in degrees at which interfaces meet walls, through the phase
    /// with the larger one, `None` if they meet none.
    pub fn uncertainty(&self, in_plane: f64, angle: Option<f64>, tension: f64, h: f64) -> f64 {
        let [factor, floor] = match angle {
            None => [PRESSURE_RESOLUTION, 0.0],
            Some(angle) if angle > FLAT_CONTACT => [PRESSURE_RESOLUTION_FLAT_CONTACT, PRESSURE_FLOOR_AT_WALLS],
            Some(_) => [PRESSURE_RESOLUTION, PRESSURE_FLOOR_AT_WALLS],
        };
        let of_lattice = PRESSURE_FLOOR * self.value;
        self.standard_error.hypot(of_lattice).hypot(error_by([factor, floor], in_plane, tension, h))
    }
}

/// The discretization error in Pa of a capillary `pressure` (Pa).
pub fn resolution_error(pressure: f64, tension: f64, h: f64) -> f64 {
    error_by([PRESSURE_RESOLUTION, PRESSURE_FLOOR], pressure, tension, h)
}

fn error_by([factor, floor]: [f64; 2], pressure: f64, tension: f64, h: f64) -> f64 {
    pressure * (factor * (h * pressure / tension).powi(2)).hypot(floor)
}

/// Width of the band left out along the interface, in smoothing lengths.
const FROM_INTERFACE: f64 = 3.0;
/// Width of the band left out along walls, in smoothing lengths, if enough particles remain.
const FROM_WALLS: f64 = 2.0;
/// Particles per phase below which the wall band is used as well: the standard error of the mean is then a fifth of the scatter.
const ENOUGH: usize = 25;

/// Capillary pressure from particles farther than 3h from `contours`, and than 2h from walls where that leaves enough.
pub fn capillary_pressure(
    samples: &PressureSamples,
    contours: &[Polyline],
    wall: &(dyn Fn(Vec2) -> WallPoint + Sync),
) -> CapillaryPressure {
    let h = samples.smoothing_length;
    let vertices: Vec<Vec2> = contours.iter().flat_map(|line| line.points.iter().copied()).collect();
    let cells = Cells::new(&vertices, FROM_INTERFACE * h, samples.period);
    let far: Vec<bool> = samples
        .points
        .par_iter()
        .map(|&x| {
            // Vertices are closer than a spacing, so their distance approximates that of the line.
            let mut near = false;
            cells.for_each_near(x, FROM_INTERFACE * h, |_, _| near = true);
            !near
        })
        .collect();
    let off_wall: Vec<bool> =
        samples.points.par_iter().zip(&far).map(|(&x, &far)| far && wall(x).distance > FROM_WALLS * h).collect();
    let strict = difference_of_means(samples, &off_wall, true);
    if strict.counts.iter().all(|&count| count >= ENOUGH) { strict } else { difference_of_means(samples, &far, false) }
}

fn difference_of_means(samples: &PressureSamples, used: &[bool], away_from_walls: bool) -> CapillaryPressure {
    let of_phase = |wetting: bool| {
        let chosen = (0..samples.points.len()).filter(|&i| used[i] && (samples.colors[i] > WETTING_COLOR) == wetting);
        MeanValue::of(chosen.map(|i| samples.pressures[i]))
    };
    let (wetting, non_wetting) = (of_phase(true), of_phase(false));
    CapillaryPressure {
        value: non_wetting.mean - wetting.mean,
        standard_error: wetting.error.hypot(non_wetting.error),
        counts: [wetting.count, non_wetting.count],
        away_from_walls,
    }
}

/// A mean with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanValue {
    /// Arithmetic mean; NaN if there are no values.
    pub mean: f64,
    /// Standard error for independent values, 0 for fewer than two.
    pub error: f64,
    /// Number of values.
    pub(crate) count: usize,
}

impl MeanValue {
    /// Mean and standard error of `values`.
    pub(crate) fn of(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let error = if count > 1 { (squares / (count as f64 * (count as f64 - 1.0))).sqrt() } else { 0.0 };
        Self { mean, error, count }
    }
}

/// Laplace pressure jump of a free drop in Pa with its standard error: mean p over r < R - 3h minus mean p over r > R + 3h.
pub fn laplace_jump(samples: &PressureSamples, center: Vec2, radius: f64) -> MeanValue {
    let band = FROM_INTERFACE * samples.smoothing_length;
    let mean = |inside: &dyn Fn(f64) -> bool| {
        let distance = |x: Vec2| nearest_image(x - center, samples.period).norm();
        let chosen = samples.points.iter().zip(samples.pressures).filter(|(x, _)| inside(distance(**x)));
        MeanValue::of(chosen.map(|(_, p)| *p))
    };
    let (inner, outer) = (mean(&|r| r < radius - band), mean(&|r| r > radius + band));
    MeanValue { mean: inner.mean - outer.mean, error: inner.error.hypot(outer.error), count: inner.count + outer.count }
}

/// RMS and largest relative deviation of particle volumes from `reference` (m²): the density error.
pub fn density_error(volumes: &[f64], reference: f64) -> [f64; 2] {
    let off = |v: &f64| reference / v - 1.0;
    let squares: f64 = volumes.iter().map(|v| off(v).powi(2)).sum();
    let largest = volumes.iter().map(|v| off(v).abs()).fold(0.0, f64::max);
    [(squares / volumes.len() as f64).sqrt(), largest]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::lattice::Lattice;

    fn circle(center: Vec2, radius: f64, count: usize) -> Polyline {
        let at = |i: usize| 2.0 * std::f64::consts::PI * i as f64 / count as f64;
        let points = (0..count).map(|i| center + radius * Vec2::new(at(i).cos(), at(i).sin())).collect();
        Polyline { points, closed: true }
    }

    fn samples<'a>(points: &'a [Vec2], pressures: &'a [f64], colors: &'a [f64], h: f64) -> PressureSamples<'a> {
        PressureSamples { points, pressures, colors, smoothing_length: h, period: [None, None] }
    }

    #[test]
    fn areas_sum_to_the_fluid_and_drift_is_relative() {
        let areas = PhaseAreas::new(&[1.0, 2.0, 3.0], &[1.0, 0.0, 0.0]);
        assert_eq!(areas, PhaseAreas { wetting: 1.0, non_wetting: 5.0 });
        assert!((areas.saturation() - 1.0 / 6.0).abs() < 1e-15);
        let later = PhaseAreas { wetting: 1.01, non_wetting: 4.99 };
        assert!((later.drift_since(&areas)[0] - 0.01).abs() < 1e-12);
    }

    #[test]
    fn the_pressure_of_a_drop_is_measured_away_from_its_interface_and_the_walls() {
        let (radius, h) = (0.5, 0.03);
        let points = Lattice::open(Vec2::repeat(-1.0), Vec2::repeat(0.02), [101, 101]).nodes();
        let colors: Vec<f64> = points.iter().map(|p| f64::from(p.norm() < radius)).collect();
        // A jump of 8 Pa with wrong values in the bands at the interface and at the floor, which must not count.
        let pressure = |p: &Vec2| {
            let spoiled = (p.norm() - radius).abs() < 2.9 * h || p.y < -1.0 + 1.9 * h;
            if spoiled { 100.0 } else { 8.0 * f64::from(p.norm() < radius) + 3.0 }
        };
        let pressures: Vec<f64> = points.iter().map(pressure).collect();
        let samples = samples(&points, &pressures, &colors, h);
        let wall = |x: Vec2| WallPoint { distance: x.y + 1.0, normal: Vec2::y() };
        let found = capillary_pressure(&samples, &[circle(Vec2::zeros(), radius, 200)], &wall);
        assert!(found.away_from_walls && (found.value + 8.0).abs() < 1e-9, "{found:?}");
        assert!(found.standard_error < 1e-9);
    }

    #[test]
    fn a_phase_without_particles_away_from_the_interface_has_no_pressure() {
        let points = [Vec2::zeros()];
        let samples = samples(&points, &[1.0], &[1.0], 0.1);
        let wall = |_| WallPoint { distance: 1.0, normal: Vec2::y() };
        let found = capillary_pressure(&samples, &[], &wall);
        assert!(found.value.is_nan() && !found.away_from_walls);
    }

    #[test]
    fn the_laplace_jump_leaves_out_a_band_of_six_smoothing_lengths() {
        let points = Lattice::open(Vec2::repeat(-1.0), Vec2::repeat(0.02), [101, 101]).nodes();
        let pressures: Vec<f64> = points.iter().map(|p| if p.norm() < 0.5 { 2.0 } else { 0.0 }).collect();
        let samples = samples(&points, &pressures, &pressures, 0.03);
        assert!((laplace_jump(&samples, Vec2::zeros(), 0.52).mean - 2.0).abs() < 1e-12);
    }

    /// [Huber2013, Eq. 17; HuAdams2006]
    #[test]
    fn density_error_is_that_of_the_inverse_volume() {
        let [rms, largest] = density_error(&[1.0, 1.0 / 1.1], 1.0);
        assert!((largest - 0.1).abs() < 1e-12 && (rms - 0.1 / 2.0_f64.sqrt()).abs() < 1e-12);
    }
}
