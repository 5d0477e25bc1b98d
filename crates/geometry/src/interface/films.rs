//! Films of the wetting phase in the corners between the walls of a chip and its floor and lid.
//!
//! Where a wall and a plate have contact angles that sum to less than 90 degrees, the wetting phase stays in the corner behind an arc of the radius r =
//! σ/(p_n - p_w) that meets both at their contact angles. A film thin compared with the radius of curvature of its wall is straight along it. As the
//! capillary pressure falls, films swell until they meet in the narrowest gap; below that pressure no film is stable.
//!
//! Not included: the curvature of a film along its wall, and contact lines pinned by hysteresis.

use super::depth::corner_area;

/// A film in a right-angled corner between a wall and a plate, for a unit radius of its surface \[Princen1969; Princen1970\]: areas scale with the square of
/// the radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Cross-section.
    area: f64,
    /// Wetted lengths on the wall and on the plate.
    arms: [f64; 2],
}

impl Corner {
    /// The film between a wall and a plate with these contact angles in rad through the wetting phase; `None` if they sum to 90 degrees or more.
    pub fn new(wall: f64, plate: f64) -> Option<Self> {
        let area = corner_area(wall, plate);
        let arms = [plate.cos() - wall.sin(), wall.cos() - plate.sin()];
        (area > 0.0).then_some(Self { area, arms })
    }
}

/// The films along one wall: one at the floor, one at the lid \[Princen1969; Princen1970\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallFilms {
    corners: [Option<Corner>; 2],
}

impl WallFilms {
    /// The films along a wall between a floor and a lid with these contact angles in rad through the wetting phase.
    pub fn new(wall: f64, plates: [f64; 2]) -> Self {
        Self { corners: plates.map(|plate| Corner::new(wall, plate)) }
    }

    /// Whether there is any film.
    pub fn exist(&self) -> bool {
        self.corners.iter().any(Option::is_some)
    }

    /// Cross-section of both at unit radius.
    pub fn area(&self) -> f64 {
        self.sum(|corner| corner.area)
    }

    /// Wetted lengths of both on the wall at unit radius.
    pub fn along_wall(&self) -> f64 {
        self.sum(|corner| corner.arms[0])
    }

    /// Wetted lengths on floor and lid at unit radius.
    pub fn along_plates(&self) -> [f64; 2] {
        self.corners.map(|corner| corner.map_or(0.0, |corner| corner.arms[1]))
    }

    fn sum(&self, of: impl Fn(&Corner) -> f64) -> f64 {
        self.corners.iter().flatten().map(of).sum()
    }
}

/// (p_n - p_w)/σ in 1/m at which films meet in a throat of some width between two walls, with floor and lid at the distance `depth` (m)
/// \[LenormandZarconeSarr1983\]: on a wall, on the floor or on the lid, whichever comes first as the pressure falls. For equal angles 2 (cos θ - sin θ) over
/// the smaller of width and depth; 0 if there is no film.
pub fn meeting(width: f64, depth: f64, walls: [&WallFilms; 2]) -> f64 {
    let on_walls = walls.map(|wall| wall.along_wall() / depth);
    let [one, other] = walls.map(WallFilms::along_plates);
    let on_plates = [0, 1].map(|plate| (one[plate] + other[plate]) / width);
    on_walls.into_iter().chain(on_plates).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::*;

    fn corner(wall: f64, plate: f64) -> Corner {
        Corner::new(wall.to_radians(), plate.to_radians()).unwrap()
    }

    /// [LenormandZarconeSarr1983]
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

    /// [Princen1969; Princen1970]
    #[test]
    fn arcs_of_unequal_angles_end_where_their_arms_do() {
        let corner = corner(20.0, 55.0);
        // Between the contacts on wall and plate: the triangle under the chord minus the segment of the arc.
        let [wall, plate] = corner.arms;
        let arc = FRAC_PI_2 - (20.0_f64 + 55.0).to_radians();
        let chord = wall.hypot(plate);
        assert!((chord - 2.0 * (0.5 * arc).sin()).abs() < 1e-12);
        assert!((corner.area - (0.5 * wall * plate - 0.5 * (arc - arc.sin()))).abs() < 1e-12);
    }
}
