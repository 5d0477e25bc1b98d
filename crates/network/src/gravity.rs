//! Gravity in the plane of a network: the capillary pressure between two phases at rest over height.

use meniscus_case::FluidPhase;
use meniscus_core::math::Vec2;
use meniscus_geometry::interface::depth::Depth;
use meniscus_geometry::interface::head::Head;

/// Two phases at rest under gravity: p_n - p_w = p₀ + (ρ_n - ρ_w) **g**·(**x** - **x**₀) \[Wilkinson1984\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gravity {
    /// Gradient of (p_n - p_w)/σ in 1/m²: (ρ_n - ρ_w) **g**/σ.
    pub gradient: Vec2,
    /// **x**₀ in m, where the applied pressure is given.
    pub reference: Vec2,
    /// The invading phase.
    pub invading: FluidPhase,
    /// Floor and lid with the contact angles for this phase; `None` in the plane.
    pub depth: Option<Depth>,
}

impl Gravity {
    /// (p_n - p_w)/σ at a point less than that at the reference, in 1/m.
    pub fn curvature(&self, at: Vec2) -> f64 {
        self.gradient.dot(&(at - self.reference))
    }

    /// Whether gravity delays the invading phase on its way along `axis`, `forwards` or backwards: then fronts are flat, otherwise they finger. `None` if
    /// gravity acts across the flow.
    pub fn stabilizes(&self, axis: usize, forwards: bool) -> Option<bool> {
        let head = Head { curvature: self.gradient[axis], ..self.head(self.reference) }.signed();
        (head != 0.0).then_some((head < 0.0) == forwards)
    }

    /// The head at a point.
    pub fn head(&self, at: Vec2) -> Head {
        Head {
            curvature: self.curvature(at),
            is_towards_non_wetting: self.invading == FluidPhase::Wetting,
            depth: self.depth,
        }
    }
}
