//! Films of the wetting phase in the corners between the walls of a chip and its floor and lid.
//!
//! Where a wall and a plate meet at angles that sum to less than 90 degrees, the wetting phase stays in the corner behind an arc of the radius
//! r = σ/(p_n - p_w) that meets both at their angles. A film that is that thin compared with the bends of its wall is straight along it. As the
//! capillary pressure falls, films grow until they meet in the narrowest gap; from there on no film rests.
//!
//! Left out: the curvature of a film along its wall, contact lines that hysteresis pins.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{DMatrix, DVector};

use super::depth::corner_area;

/// A film in a right corner between a wall and a plate, at a radius of its surface of 1: areas go with the square of the radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Contact angles in rad of the wall and of the plate.
    angles: [f64; 2],
    /// Cross-section.
    area: f64,
    /// How far it reaches along the wall and along the plate.
    arms: [f64; 2],
}

impl Corner {
    /// The film between a wall and a plate with these contact angles in rad through the wetting phase; none where they sum to 90 degrees or more.
    pub fn new(wall: f64, plate: f64) -> Option<Self> {
        let area = corner_area(wall, plate);
        let arms = [plate.cos() - wall.sin(), wall.cos() - plate.sin()];
        (area > 0.0).then_some(Self { angles: [wall, plate], area, arms })
    }

    /// The flow along the film is g r⁴/μ times the pressure gradient, r the radius of its surface: g for a surface without shear stress.
    ///
    /// The velocity u with ∇²u = -1 is 0 on both walls and has no slope across the arc. With the angle φ from the plate and the distance ρ from the
    /// corner, u = -(ρ sin φ)²/2 - ρ² (ln ρ sin 2φ + φ cos 2φ)/π + Σ a_n ρ^(2n) sin 2nφ satisfies all but the last condition, which the a_n meet best at
    /// points of the arc; the flow is the integral of u in closed form along ρ. Ransohoff and Radke (1988) have the same problem, by finite elements.
    pub fn conductance(&self) -> f64 {
        /// Terms of the series and points of the arc. The flow with twice as many differs by less than 1e-6 of it for equal angles, by 1e-4 in a corner
        /// of 5 and 80 degrees.
        const TERMS: usize = 24;
        const POINTS: usize = 8 * TERMS;
        let size = self.arms[0].max(self.arms[1]);
        let center = self.angles.map(|angle| angle.cos() / size);
        let radius = 1.0 / size;
        // From the contact on the plate to that on the wall, seen from the center of the arc.
        let from = (-center[1]).atan2(self.arms[1] / size - center[0]);
        let to = (self.arms[0] / size - center[1]).atan2(-center[0]);
        let turn = (to - from).rem_euclid(std::f64::consts::TAU) - std::f64::consts::TAU;
        let mut matrix = DMatrix::zeros(POINTS, TERMS);
        let mut missing = DVector::zeros(POINTS);
        for point in 0..POINTS {
            // Closer together near both contacts.
            let share = 0.5 * (1.0 - (std::f64::consts::PI * (point as f64 + 0.5) / POINTS as f64).cos());
            let (ny, nx) = (from + share * turn).sin_cos();
            let (x, y) = (center[0] + radius * nx, center[1] + radius * ny);
            let (rho, phi) = (x.hypot(y), y.atan2(x));
            for term in 0..TERMS {
                let power = (2 * term + 1) as f64;
                let (sin, cos) = (power * phi).sin_cos();
                matrix[(point, term)] = rho.powf(power) * (nx * sin + ny * cos);
            }
            // The gradient of Im z² ln z has the parts Im and Re of 2 z ln z + z.
            let (re, im) = (2.0 * (x * rho.ln() - y * phi) + x, 2.0 * (x * phi + y * rho.ln()) + y);
            missing[point] = (nx * im + ny * re) / std::f64::consts::PI + ny * y;
        }
        /// Singular values below this share of the largest say nothing.
        const ROUNDING: f64 = 1e-13;
        let Ok(slopes) = matrix.svd(true, true).solve(&missing, ROUNDING) else { return f64::NAN };
        let a: Vec<f64> = slopes.iter().enumerate().map(|(term, slope)| slope / (2 * term + 2) as f64).collect();
        size.powi(4) * self.flow(&a, center, radius)
    }

    /// The integral of the velocity over a cross-section of the scaled film, by the midpoint rule in the angle.
    fn flow(&self, a: &[f64], center: [f64; 2], radius: f64) -> f64 {
        const ANGLES: usize = 2000;
        let step = FRAC_PI_2 / ANGLES as f64;
        let at = |index: usize| {
            let phi = (index as f64 + 0.5) * step;
            let (sin, cos) = phi.sin_cos();
            let along = center[0] * cos + center[1] * sin;
            let inner = center[0] * center[0] + center[1] * center[1] - radius * radius;
            // Of both crossings of the circle the one nearer to the corner, without cancellation.
            let rho = inner / (along + (along * along - inner).max(0.0).sqrt());
            let fourth = rho.powi(4);
            let (sin2, cos2) = (2.0 * phi).sin_cos();
            let logarithm = sin2 * fourth * (0.25 * rho.ln() - 0.0625) + 0.25 * phi * cos2 * fourth;
            let series = a.iter().enumerate().map(|(term, a)| {
                let power = (2 * term + 2) as f64;
                a * rho.powf(power + 2.0) / (power + 2.0) * (power * phi).sin()
            });
            series.sum::<f64>() - 0.125 * sin * sin * fourth - logarithm / std::f64::consts::PI
        };
        step * (0..ANGLES).map(at).sum::<f64>()
    }
}

/// The films along one wall: one at the floor, one at the lid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallFilms {
    corners: [Option<Corner>; 2],
}

impl WallFilms {
    /// The films along a wall between a floor and a lid with these contact angles in rad through the wetting phase.
    pub fn new(wall: f64, plates: [f64; 2]) -> Self {
        Self { corners: plates.map(|plate| Corner::new(wall, plate)) }
    }

    /// Whether there is any.
    pub fn exist(&self) -> bool {
        self.corners.iter().any(Option::is_some)
    }

    /// Cross-section of both at a radius of 1.
    pub fn area(&self) -> f64 {
        self.sum(|corner| corner.area)
    }

    /// How far both reach along the wall at a radius of 1.
    pub fn along_wall(&self) -> f64 {
        self.sum(|corner| corner.arms[0])
    }

    /// How far they reach along the floor and along the lid at a radius of 1.
    pub fn along_plates(&self) -> [f64; 2] {
        self.corners.map(|corner| corner.map_or(0.0, |corner| corner.arms[1]))
    }

    fn sum(&self, of: impl Fn(&Corner) -> f64) -> f64 {
        self.corners.iter().flatten().map(of).sum()
    }
}

/// (p_n - p_w)/σ in 1/m at which films meet in a throat of some width between two walls, floor and lid at the distance `depth` (m): on a wall, on the
/// floor or on the lid, whichever comes first as the pressure falls. For equal angles 2 (cos θ - sin θ) over the smaller of width and depth; 0 where there is no film.
pub fn meeting(width: f64, depth: f64, walls: [&WallFilms; 2]) -> f64 {
    let on_walls = walls.map(|wall| wall.along_wall() / depth);
    let [one, other] = walls.map(WallFilms::along_plates);
    let on_plates = [0, 1].map(|plate| (one[plate] + other[plate]) / width);
    on_walls.into_iter().chain(on_plates).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interface::depth::duct_factor;

    fn corner(wall: f64, plate: f64) -> Corner {
        Corner::new(wall.to_radians(), plate.to_radians()).unwrap()
    }

    #[test]
    fn films_conduct_as_converged_finite_elements_say() {
        for (deg, exact) in [(0.0, 2.349e-3), (10.0, 1.880e-3), (20.0, 9.027e-4), (30.0, 1.901e-4), (40.0, 3.46e-6)] {
            let found = corner(deg, deg).conductance();
            // Three digits are given for the last one.
            let given = if deg == 40.0 { 2e-3 } else { 4e-4 };
            assert!((found / exact - 1.0).abs() < given, "{deg}: {found:e} {exact:e}");
        }
    }

    #[test]
    fn a_mirrored_corner_conducts_the_same_and_one_with_a_straight_arc_as_half_a_duct() {
        for (one, other) in [(10.0, 50.0), (0.0, 30.0), (5.0, 80.0)] {
            let [a, b] = [corner(one, other), corner(other, one)].map(|corner| corner.conductance());
            assert!((a / b - 1.0).abs() < 1e-4, "{one} {other}: {a:e} {b:e}");
        }
        // Near 45 degrees the arc is straight, and the film half of a square duct, cut along its diagonal.
        let corner = corner(44.99, 44.99);
        let share = corner.conductance() / corner.arms[0].powi(4);
        assert!((share * 24.0 / duct_factor(1.0) - 1.0).abs() < 4e-4, "{share}");
    }

    #[test]
    fn films_of_equal_angles_meet_in_the_narrower_gap() {
        for deg in [0.0_f64, 20.0, 44.0] {
            let (sin, cos) = deg.to_radians().sin_cos();
            let walls = WallFilms::new(deg.to_radians(), [deg.to_radians(); 2]);
            for (width, depth) in [(1e-5, 5e-5), (5e-5, 5e-5), (2e-4, 5e-5)] {
                let exact = 2.0 * (cos - sin) / f64::min(width, depth);
                assert!((meeting(width, depth, [&walls; 2]) / exact - 1.0).abs() < 1e-12);
            }
        }
        assert_eq!(meeting(1e-5, 1e-5, [&WallFilms::new(0.8, [0.8; 2]); 2]), 0.0);
    }

    #[test]
    fn arcs_of_unequal_angles_end_where_their_arms_do() {
        let corner = corner(20.0, 55.0);
        // From the contact on the wall to that on the plate by the chord, the segment of the arc and the triangle.
        let [wall, plate] = corner.arms;
        let arc = FRAC_PI_2 - (20.0_f64 + 55.0).to_radians();
        let chord = wall.hypot(plate);
        assert!((chord - 2.0 * (0.5 * arc).sin()).abs() < 1e-12);
        assert!((corner.area - (0.5 * wall * plate - 0.5 * (arc - arc.sin()))).abs() < 1e-12);
    }
}
