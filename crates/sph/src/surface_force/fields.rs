//! Fields of the interface, with the surface force in one of two forms.

use crate::images::Field;
use crate::surface_force::jump::Jump;
use meniscus_core::math::Vec2;

/// Color, normal, curvature and force of the interface.
#[derive(Debug, Clone, Default)]
pub struct InterfaceFields {
    /// Smoothed color; on walls 0 where no fluid is near.
    pub color: Field<f64>,
    /// n_a in 1/m.
    pub normal: Field<Vec2>,
    /// κ_a in 1/m of all particles, 0 where undefined.
    pub curvature: Vec<f64>,
    /// Slip length in m of the wall next to each fluid particle, which differs near contact lines.
    pub slip_length: Vec<f64>,
    /// The surface force.
    pub force: SurfaceForce,
}

/// The force of the interface and of its contact lines; lists over fluid particles.
#[derive(Debug, Clone, Default)]
pub enum SurfaceForce {
    /// No interfacial tension.
    #[default]
    None,
    /// Volume forces in a band.
    Continuum {
        /// Surface force in N/m³.
        surface: Vec<Vec2>,
        /// Contact line force in N/m³.
        line: Vec<Vec2>,
    },
    /// A jump of the pressure.
    Jump {
        /// Sides and curvatures that determine the jump of each pair.
        jump: Jump,
        /// Moment of the sums of the pressure gradient of each particle.
        moment: Vec<f64>,
        /// Receding and advancing angle in rad of the wall next to each particle, NaN where none is in reach.
        wall_hysteresis: Vec<[f64; 2]>,
        /// Whether a contact line is at an edge or bend of its wall.
        has_pinned_line: bool,
    },
}

impl SurfaceForce {
    /// The volume force on a fluid particle in N/m³.
    #[inline]
    pub(crate) fn on(&self, a: usize) -> Vec2 {
        if let Self::Continuum { surface, line } = self { surface[a] + line[a] } else { Vec2::zeros() }
    }

    /// The jump, `None` for other forms.
    pub(crate) fn jump(&self) -> Option<&Jump> {
        if let Self::Jump { jump, .. } = self { Some(jump) } else { None }
    }
}
