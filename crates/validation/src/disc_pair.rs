//! Two equal discs among the solids, and exact solutions for bridges and menisci between them without gravity.

use std::f64::consts::{FRAC_PI_2, PI};

use meniscus_geometry::analysis::roots::bisect;
use meniscus_sph::measures::{DiscOf, Subject};

/// Two equal discs with a gap and their contact angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscPair {
    /// Radius of the discs in m.
    pub radius: f64,
    /// Half of the gap width in m.
    pub half_gap: f64,
    /// Contact angle in rad.
    pub angle: f64,
}

impl DiscPair {
    /// Half of the distance in m between the contact points at the polar angle `b` (rad), measured outward from the line of centers.
    fn half_chord(&self, b: f64) -> f64 {
        self.half_gap + self.radius * (1.0 - b.cos())
    }

    /// Curvature in 1/m of the meniscus with contact points at `b` (rad): (p_n - p_w)/σ.
    pub fn curvature(&self, b: f64) -> f64 {
        (self.angle + b).cos() / self.half_chord(b)
    }

    /// Area in m² between the discs from the line of centers to the contact points, on both sides of the middle line of the gap.
    fn strip(&self, b: f64) -> f64 {
        2.0 * (self.radius + self.half_gap) * self.radius * b.sin() - self.radius.powi(2) * (b + b.sin() * b.cos())
    }

    /// Signed area in m² between the chord of the contact points and the meniscus, positive if the meniscus bulges inward.
    fn segment(&self, b: f64) -> f64 {
        let half = FRAC_PI_2 - (self.angle + b);
        let chord = self.half_chord(b);
        // (a - sin a cos a)/sin² a, regular for a straight meniscus.
        let shape =
            if half.abs() < 1e-4 { 2.0 * half / 3.0 } else { (half - half.sin() * half.cos()) / half.sin().powi(2) };
        chord * chord * shape
    }

    /// Area in m² of the liquid between four such discs at (+-(R+d), +-(R+d)) with contact points at `b` (rad).
    pub(crate) fn area_between_four(&self, b: f64) -> f64 {
        4.0 * (self.radius + self.half_gap).powi(2) - PI * self.radius.powi(2) + 4.0 * (self.strip(b) - self.segment(b))
    }

    /// The liquid of `area` (m²) between four discs; `None` outside the range that the discs can hold.
    ///
    /// Sought outward of the largest curvature, where the state is stable at fixed area.
    pub(crate) fn liquid_between_four(&self, area: f64) -> Option<FourDiscs> {
        let inner = self.angle_of_largest_curvature();
        let outer = FRAC_PI_2.min(PI - self.angle) - 1e-6;
        let contact = bisect(|b| self.area_between_four(b) - area, inner, outer)?;
        Some(FourDiscs { contact, curvature: self.curvature(contact) })
    }

    /// Polar angle of the contact point in rad at which the curvature is largest: d(curvature)/db = 0.
    fn angle_of_largest_curvature(&self) -> f64 {
        let slope =
            |b: f64| -(self.angle + b).sin() * self.half_chord(b) - (self.angle + b).cos() * self.radius * b.sin();
        bisect(slope, -self.angle - 1e-9, 1e-9).unwrap_or(-self.angle)
    }

    /// The bridge of `area` (m²) between two such discs; `None` if there is none.
    pub(crate) fn bridge(&self, area: f64) -> Option<Bridge> {
        let covered = |b: f64| 2.0 * (self.strip(b) - self.segment(b));
        // The first root outward of the state with touching menisci is the bridge; if the area there is larger already, there is none.
        let outer = FRAC_PI_2.min(PI - self.angle) - 1e-6;
        let filling = bisect(|b| covered(b) - area, 0.0, outer)?;
        let curvature = self.curvature(filling);
        let half = FRAC_PI_2 - (self.angle + filling);
        // Sagitta of the arc: r (1 - cos a) = half chord times tan(a/2).
        let half_neck = self.radius * filling.sin() - self.half_chord(filling) * (0.5 * half).tan();
        Some(Bridge { filling, curvature, half_neck, force: 2.0 + 2.0 * curvature * half_neck })
    }
}

/// Liquid between four discs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FourDiscs {
    /// Polar angle of the contact point in rad, outward from the line of centers.
    pub(crate) contact: f64,
    /// Curvature of the menisci in 1/m: (p_n - p_w)/σ.
    pub(crate) curvature: f64,
}

/// A bridge between two discs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bridge {
    /// Filling angle in rad.
    pub(crate) filling: f64,
    /// (p_n - p_w)/σ in 1/m.
    pub(crate) curvature: f64,
    /// Half of the neck width in m.
    pub(crate) half_neck: f64,
    /// Attractive force between the discs per depth over the interfacial tension (dimensionless).
    pub(crate) force: f64,
}

/// The first disc and its nearest neighbor as a pair with the contact angle of the case; `None` if their radii differ or no wetting model applies.
pub(crate) fn disc_pair(s: &Subject) -> Option<DiscPair> {
    let [a, rest @ ..] = s.discs else { return None };
    let distance = |b: &&DiscOf| (b.center - a.center).norm();
    let b = rest.iter().min_by(|b, c| distance(b).total_cmp(&distance(c)))?;
    let half_gap = 0.5 * distance(&b) - a.radius;
    let angle = s.flow.config.method.wetting?.static_angle();
    ((a.radius - b.radius).abs() < 1e-9 * a.radius).then_some(DiscPair { radius: a.radius, half_gap, angle })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(half_gap: f64, degrees: f64) -> DiscPair {
        DiscPair { radius: 1.0, half_gap, angle: degrees.to_radians() }
    }

    #[test]
    fn liquid_between_four_discs_has_the_printed_curvature_and_area() {
        for (half_gap, curvatures, areas) in [
            (0.5, [1.6810, 1.5321, 1.2477, 0.8924], [4.2874, 5.2104, 6.0314, 6.8258]),
            (0.25, [3.2657, 3.0642, 2.4239, 1.6113], [2.5237, 2.9464, 3.3226, 3.7072]),
        ] {
            let discs = pair(half_gap, 40.0);
            for (k, degrees) in [-10.0, 0.0, 10.0, 20.0_f64].into_iter().enumerate() {
                let b = degrees.to_radians();
                assert!((discs.curvature(b) - curvatures[k]).abs() < 0.6e-4, "{half_gap} {degrees}");
                assert!((discs.area_between_four(b) - areas[k]).abs() < 0.6e-4, "{half_gap} {degrees}");
            }
        }
    }

    #[test]
    fn the_contact_point_follows_from_the_area() {
        let discs = pair(0.5, 40.0);
        for degrees in [-10.0, 5.0, 20.0, 49.9, 55.0_f64] {
            let found = discs.liquid_between_four(discs.area_between_four(degrees.to_radians())).expect("a state");
            assert!((found.contact.to_degrees() - degrees).abs() < 1e-6, "{degrees}: {found:?}");
        }
        assert!(discs.liquid_between_four(0.1).is_none());
        assert!((discs.angle_of_largest_curvature().to_degrees() + 15.0).abs() < 2.0);
    }

    #[test]
    fn bridges_are_as_printed() {
        for (degrees, area, filling, curvature, force, neck) in [
            (0.0, 0.2, 30.304, 3.64850, 4.69109, 0.36879),
            (40.0, 0.2, 25.138, 2.15932, 3.64917, 0.38187),
            (40.0, 0.5, 43.955, 0.27705, 2.37347, 0.67402),
            (60.0, 0.5, 41.178, -0.55812, 1.22713, 0.69238),
        ] {
            let found = pair(0.1, degrees).bridge(area).expect("a bridge");
            assert!((found.filling.to_degrees() - filling).abs() < 6e-4, "{degrees} {area}: {found:?}");
            assert!((found.curvature - curvature).abs() < 1e-5, "{degrees} {area}: {found:?}");
            assert!((found.force - force).abs() < 1e-5, "{degrees} {area}: {found:?}");
            assert!((found.half_neck - neck).abs() < 1e-5, "{degrees} {area}: {found:?}");
        }
    }
}
