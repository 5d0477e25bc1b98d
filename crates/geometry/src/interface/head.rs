//! Hydrostatic head at a meniscus: what gravity adds to the applied capillary pressure at its height.

use super::depth::Depth;

/// The head of one place, and the conversion of curvatures in the plane between there and the place where the capillary pressure is applied.
///
/// Without a depth a curvature changes by the head. Between floor and lid (p_n - p_w)/σ changes by it, and the curvature in the plane by what
/// [`Depth::plane`] makes of that. Both directions increase, so that the order of curvatures at one place is kept.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Head {
    /// (p_n - p_w)/σ here less that where the pressure is applied, in 1/m.
    pub curvature: f64,
    /// Whether curvatures are above 0 where the interface bulges into the non-wetting phase, the defending one.
    pub is_towards_non_wetting: bool,
    /// Floor and lid; `None` in the plane.
    pub depth: Option<Depth>,
}

impl Head {
    /// The same in the direction of curvatures: above 0 where gravity lets the invading phase advance.
    pub fn signed(&self) -> f64 {
        if self.is_towards_non_wetting { -self.curvature } else { self.curvature }
    }

    /// This head less that of another place.
    pub fn above(self, other: Self) -> Self {
        Self { curvature: self.curvature - other.curvature, ..self }
    }

    /// The curvature in the plane here in 1/m while `applied` acts where the pressure is applied.
    pub fn local(&self, applied: f64) -> f64 {
        self.raised(applied, self.curvature)
    }

    /// The applied curvature in the plane in 1/m at which the one here is `local`.
    pub fn applied(&self, local: f64) -> f64 {
        self.raised(local, -self.curvature)
    }

    fn raised(&self, plane: f64, by: f64) -> f64 {
        if by == 0.0 || !plane.is_finite() {
            return plane;
        }
        let sign = if self.is_towards_non_wetting { -1.0 } else { 1.0 };
        match &self.depth {
            Some(depth) => sign * depth.plane(depth.curvature(sign * plane) + by),
            None => plane + sign * by,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_and_its_inverse_cancel_in_the_plane_and_between_plates() {
        let depths = [None, Some(Depth::new(5e-5, 1.2, [1.2; 2])), Some(Depth::new(5e-5, 0.3, [0.2, 0.4]))];
        for depth in depths {
            for is_towards_non_wetting in [false, true] {
                for curvature in [-3e3, 0.0, 2e4] {
                    let head = Head { curvature, is_towards_non_wetting, depth };
                    let mut before = f64::NEG_INFINITY;
                    for plane in [-4e4, -10.0, 0.0, 10.0, 1e3, 5e4] {
                        let local = head.local(plane);
                        assert!((head.applied(local) - plane).abs() < 1e-9 * (plane.abs() + 1e4), "{head:?} {plane}");
                        assert!(local > before);
                        before = local;
                    }
                }
            }
        }
    }

    #[test]
    fn without_a_head_curvatures_keep_their_bits() {
        let head = Head { depth: Some(Depth::new(5e-5, 0.3, [0.3; 2])), ..Head::default() };
        for plane in [0.1, -1.0 / 3.0, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(head.local(plane), plane);
            assert_eq!(head.applied(plane), plane);
        }
    }
}
