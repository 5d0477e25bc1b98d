//! Menisci between a floor and a lid: the contribution of the depth of a chip to the curvature.
//!
//! Floor and lid at the distance b with the angles θ_f and θ_l add (cos θ_f + cos θ_l)/b to the curvature of every meniscus. Where a wall and a plate have
//! contact angles that sum to less than 90 degrees, the wetting phase stays in the corner, and the curvature follows from the energy balance of an advancing
//! meniscus in a duct ([`Depth::curvature`]).

use std::f64::consts::{FRAC_PI_2, PI};

use meniscus_core::math::halved;

/// A uniform depth with the contact angles of walls, floor and lid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Depth {
    /// Distance between floor and lid in m.
    depth: f64,
    /// Sum of the cosines at floor and lid over their distance, in 1/m.
    transverse: f64,
    /// Contribution T of the corner films to the balance of a duct, over its depth and twice the cosine of its walls, in 1/m; 0 without films.
    corners: f64,
    /// Fraction of the in-plane curvature that acts on an interface which meets floor and lid only.
    share: f64,
    /// The smaller angle of floor and lid in rad.
    wettest: f64,
}

/// Depths of more than this many throat widths, or of less than one over this, cause a warning.
const MOST: f64 = 1e3;

impl Depth {
    /// A depth in m with the contact angles in rad of walls, floor and lid through the wetting phase.
    pub fn new(depth: f64, wall: f64, plates: [f64; 2]) -> Self {
        let corners: f64 = plates.iter().map(|&plate| 2.0 * corner_area(wall, plate)).sum();
        let corners = if corners > 0.0 { corners / (2.0 * wall.cos() * depth) } else { 0.0 };
        let transverse = plates.iter().map(|plate| plate.cos()).sum::<f64>() / depth;
        let wettest = plates[0].min(plates[1]);
        Self { depth, transverse, corners, share: share(plates), wettest }
    }

    /// Distance between floor and lid in m.
    pub fn distance(&self) -> f64 {
        self.depth
    }

    /// The smaller angle of floor and lid in rad.
    pub fn wettest(&self) -> f64 {
        self.wettest
    }

    /// Thickness over depth of each of the films that a receding meniscus leaves on floor and lid at a capillary number of the wetting phase
    /// \[Bretherton1961\]: 1.34 Ca^(2/3) of half the depth; `None` where the contact angle permits a receding line, 9 Ca ln(x/l) < θ³ (Cox 1986; Voinov 1976).
    pub fn film_left(&self, capillary_number: f64) -> Option<f64> {
        /// Logarithm of the ratio of a depth to a molecular length.
        const LOGARITHM: f64 = 9.0;
        let leaves = 9.0 * capillary_number * LOGARITHM > self.wettest.powi(3);
        (leaves && capillary_number > 0.0).then(|| 0.67 * capillary_number.powf(2.0 / 3.0))
    }

    /// Whether the corner films are those of another depth with the same distance between floor and lid.
    pub fn has_films_of(&self, other: &Self) -> bool {
        /// Angles are given in degrees.
        const SAME: f64 = 1e-9;
        (self.corners - other.corners).abs() <= SAME * self.corners.abs().max(other.corners.abs())
    }

    /// (p_n - p_w)/σ in 1/m of a meniscus between walls whose in-plane curvature is `plane` (1/m), above 0 where it bulges into the wetting phase
    /// \[MayerStowe1965; Princen1969; Princen1970\].
    ///
    /// Without films the sum of both curvatures. With films that of the duct whose plane meniscus has this curvature, w = 2 cos θ/κ, by the balance of Mayer,
    /// Stowe and Princen: with perimeter and area of the cross-section, A p² - (Σ l cos θ) p + T = 0, where T is the contribution of the corner films. A
    /// meniscus of negative in-plane curvature has no films. The result increases with `plane`, so that a uniform depth preserves the order of events.
    pub fn curvature(&self, plane: f64) -> f64 {
        let both = plane + self.transverse;
        if plane <= 0.0 || self.corners == 0.0 {
            return both;
        }
        0.5 * (both + (both * both - 4.0 * self.corners * plane).max(0.0).sqrt())
    }

    /// (p_n - p_w)/σ in 1/m of an interface that meets floor and lid only: that of a flat drop or bubble \[ParkHomsy1984\].
    ///
    /// Over the depth the interface is an arc, whose tilted parts have a smaller in-plane curvature, κ times the cosine of the tilt: at 0 degrees π/4 of it
    /// acts. This holds for flat drops; as the in-plane curvature exceeds 1/b, all of it acts.
    pub fn curvature_of_drop(&self, plane: f64) -> f64 {
        let flat = 1.0 / (1.0 + (plane * self.depth).powi(4));
        plane + self.transverse - (1.0 - self.share) * flat * plane
    }

    /// The in-plane curvature of a meniscus for which (p_n - p_w)/σ is `curvature` (1/m).
    pub fn plane(&self, curvature: f64) -> f64 {
        if curvature <= self.transverse || self.corners == 0.0 {
            return curvature - self.transverse;
        }
        curvature * (curvature - self.transverse) / (curvature - self.corners)
    }
}

/// The warning about a depth at which all throats are slits between floor and lid, or between their walls; all in m.
pub fn implausible(depth: f64, narrowest: f64, widest: f64) -> Option<String> {
    let advice = "is it in m? An etched or molded chip has 20e-6 to 400e-6";
    match () {
        () if depth > MOST * widest => Some(format!(
            "the depth of {depth:e} m is more than {MOST} times the widest throat, {widest:.3e} m, so that it has no effect; {advice}"
        )),
        () if depth * MOST < narrowest => Some(format!(
            "the depth of {depth:e} m is less than the narrowest throat, {narrowest:.3e} m, over {MOST}, so that floor and lid alone determine pressures and flows; {advice}"
        )),
        () => None,
    }
}

/// The depth-averaged flow of a duct of the width `ratio` b with the factor `profile`, relative to that of the series, minus 1.
pub fn duct_error(ratio: f64, profile: f64) -> f64 {
    let z = ratio * (3.0 / profile).sqrt();
    (1.0 - z.tanh() / z) / duct_factor(ratio) - 1.0
}

/// The mean cosine of the tilt of a circular arc between plates that it meets at these angles (rad):
/// (π - θ_f - θ_l + sin θ_f cos θ_f + sin θ_l cos θ_l)/(2 (cos θ_f + cos θ_l)).
fn share([floor, lid]: [f64; 2]) -> f64 {
    /// Below this the arc is straight.
    const STRAIGHT: f64 = 1e-6;
    let cosines = floor.cos() + lid.cos();
    if cosines.abs() < STRAIGHT {
        return floor.sin();
    }
    (PI - floor - lid + floor.sin() * floor.cos() + lid.sin() * lid.cos()) / (2.0 * cosines)
}

/// Cross-section of the film in a right-angled corner between surfaces with two contact angles (rad), over the squared radius of its surface; 0 if there is
/// no film. For equal angles cos θ (cos θ - sin θ) - (π/4 - θ). It is also the term of the film in the balance of a duct: the wetted lengths l cos θ minus
/// the arc and the cross-section, over the radius.
pub fn corner_area(one: f64, other: f64) -> f64 {
    let arc = FRAC_PI_2 - one - other;
    if arc <= 0.0 {
        return 0.0;
    }
    let ((sin1, cos1), (sin2, cos2)) = (one.sin_cos(), other.sin_cos());
    cos1 * cos2 - 0.5 * (sin1 * cos1 + sin2 * cos2 + arc)
}

/// Flow through a duct of the width `ratio` b relative to that between two plates at the distance b: with Q = F b³ w/(12 μ) dp/dx, F = 1 - 192/(π⁵ x) Σ
/// tanh(n π x/2)/n⁵ over odd n (White, Viscous Fluid Flow, section 3-3.3); x² for a narrow duct.
pub fn duct_factor(ratio: f64) -> f64 {
    /// Σ 1/n⁵ over odd n, 31/32 ζ(5).
    const ALL: f64 = 1.004_523_762_795_139_6;
    /// Terms of the remainder, which decays as e^(-n π).
    const TERMS: [f64; 6] = [1.0, 3.0, 5.0, 7.0, 9.0, 11.0];
    if ratio < 1.0 {
        // The same duct, rotated.
        return ratio * ratio * duct_factor(1.0 / ratio);
    }
    let rest: f64 = TERMS.iter().map(|n| 2.0 / (((n * PI * ratio).exp() + 1.0) * n.powi(5))).sum();
    1.0 - 192.0 / (PI.powi(5) * ratio) * (ALL - rest)
}

/// The factor α on inertia and on the in-plane viscous stress with which the depth-averaged flow through a duct of the width `ratio` b equals that of the
/// series: 1 - tanh z/z = F with z² = 3 x²/α. It varies from 1 for a deep duct to 1.19 for a wide one, where a parabolic profile gives 6/5.
pub fn profile_factor(ratio: f64) -> f64 {
    /// A double has a 53-bit significand.
    const HALVINGS: u32 = 53;
    /// Outside this range the difference between both flows is rounding.
    const RATIOS: [f64; 2] = [1e-3, 1e3];
    let ratio = ratio.clamp(RATIOS[0], RATIOS[1]);
    let exact = duct_factor(ratio);
    let is_below = |alpha: f64| {
        let z = ratio * (3.0 / alpha).sqrt();
        1.0 - z.tanh() / z > exact
    };
    halved([1.0, 1.5], HALVINGS, is_below)[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    const B: f64 = 50e-6;

    fn with_one_angle(deg: f64) -> Depth {
        Depth::new(B, f64::to_radians(deg), [f64::to_radians(deg); 2])
    }

    #[test]
    fn ducts_carry_the_flow_of_their_series() {
        let known = [
            (0.25, 0.052652),
            (0.5, 0.171511),
            (1.0, 0.421731),
            (2.0, 0.686045),
            (3.0, 0.789951),
            (5.0, 0.873950),
            (10.0, 0.936975),
            (20.0, 0.968488),
        ];
        for (ratio, factor) in known {
            assert!((duct_factor(ratio) - factor).abs() < 6e-7, "{ratio}: {}", duct_factor(ratio));
        }
        // A deep duct is plane: F = x² (1 - .63 x + ...).
        assert!((duct_factor(1e-3) / 1e-6 - 1.0).abs() < 7e-4);
        assert!((duct_factor(1.0 - 1e-9) - duct_factor(1.0 + 1e-9)).abs() < 1e-8);
    }

    #[test]
    fn the_profile_factor_gives_a_duct_its_flow() {
        for ratio in [0.25, 0.5, 1.0, 2.0, 5.0, 20.0] {
            let (alpha, exact) = (profile_factor(ratio), duct_factor(ratio));
            let z = ratio * (3.0 / alpha).sqrt();
            assert!(
                ((1.0 - z.tanh() / z) / exact - 1.0).abs() < 1e-9 && (1.0..1.2).contains(&alpha),
                "{ratio}: {alpha}"
            );
        }
        assert!((profile_factor(1e-2) - 1.0).abs() < 0.01 && (profile_factor(1e4) - 1.19).abs() < 0.005);
    }

    /// [MayerStowe1965; Princen1969; Princen1970]
    #[test]
    fn ducts_are_entered_at_the_pressure_of_mayer_stowe_and_princen() {
        let known = [
            (1.0, 0.0, 3.772454),
            (1.0, 20.0, 3.620335),
            (1.0, 30.0, 3.399159),
            (1.0, 40.0, 3.054811),
            (1.0, 45.0, 2.828427),
            (1.0, 60.0, 2.0),
            (2.0, 0.0, 2.849369),
            (2.0, 30.0, 2.554874),
            (2.0, 60.0, 1.5),
        ];
        for (ratio, deg, entry) in known {
            let plane = 2.0 * f64::to_radians(deg).cos() / (ratio * B);
            let found = with_one_angle(deg).curvature(plane) * B;
            assert!((found - entry).abs() < 6e-7, "{ratio} {deg}: {found}");
        }
    }

    /// [ParkHomsy1984]
    #[test]
    fn a_flat_bubble_has_the_pressure_of_the_exact_surface_of_revolution() {
        // Integrated numerically: angle, radius of the contact line over the depth, and p b/sigma.
        let known = [
            (30.0, 2.0, 2.120400),
            (30.0, 5.0, 1.896311),
            (30.0, 10.0, 1.815805),
            (60.0, 2.0, 1.457683),
            (60.0, 5.0, 1.187928),
            (60.0, 10.0, 1.094804),
        ];
        for (deg, radius, pressure) in known {
            // The mean over the depth lies outside the contact line by the area of the arc's segment over b.
            let (half, arc) = (f64::to_radians(90.0 - deg), 0.5 / f64::to_radians(deg).cos());
            let mean = radius + arc * arc * (half - half.sin() * half.cos());
            let found = with_one_angle(deg).curvature_of_drop(1.0 / (mean * B)) * B;
            assert!((found / pressure - 1.0).abs() < 2e-3, "{deg} {radius}: {found}");
        }
        assert!((share([0.0; 2]) - 0.25 * PI).abs() < 1e-15 && (share([FRAC_PI_2; 2]) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_plane_comes_back_as_the_depth_grows_and_at_the_angle_without_films() {
        for deg in [0.0, 30.0, 44.999_999, 45.0, 60.0, 120.0, 180.0] {
            let angle = f64::to_radians(deg);
            let deep = Depth::new(1.0, angle, [angle; 2]);
            for plane in [-1e5, 1e5] {
                assert!((deep.curvature(plane) / plane - 1.0).abs() < 5e-5, "{deg}");
            }
            let chip = with_one_angle(deg);
            for plane in [-1e5, -1.0, 1.0, 1e3, 1e5] {
                assert!((chip.plane(chip.curvature(plane)) / plane - 1.0).abs() < 1e-9, "{deg} {plane}");
                let step = 1e-4 * plane;
                let slope = (chip.curvature(plane + step) - chip.curvature(plane - step)) / (2.0 * step);
                assert!(slope > 0.0, "{deg} {plane}");
            }
        }
    }

    /// [Bretherton1961]
    #[test]
    fn menisci_leave_films_where_no_angle_holds_their_lines() {
        let film = |deg: f64, number: f64| with_one_angle(deg).film_left(number);
        assert!(film(0.0, 0.0).is_none() && film(30.0, 1e-3).is_none() && film(60.0, 1e-2).is_none());
        // 1.34 Ca^(2/3) of half the depth.
        assert!((film(0.0, 1e-3).unwrap() - 0.0067).abs() < 1e-12 && film(10.0, 1e-3).is_some());
        assert!(Depth::new(B, 1.5, [0.0, 1.5]).film_left(1e-4).is_some());
    }

    #[test]
    fn films_of_unequal_corners_end_where_both_angles_sum_to_a_right_one() {
        let angle = |deg: f64| deg.to_radians();
        assert!(corner_area(angle(30.0), angle(59.9)) < 1e-5 && corner_area(angle(30.0), angle(60.1)) == 0.0);
        let (one, other) = (corner_area(angle(10.0), angle(40.0)), corner_area(angle(40.0), angle(10.0)));
        assert!((one - other).abs() < 1e-15);
        let (sin, cos) = angle(20.0).sin_cos();
        assert!((corner_area(angle(20.0), angle(20.0)) - (cos * (cos - sin) - angle(25.0))).abs() < 1e-15);
    }
}
