//! Wetting models and the volume form of the contact line's force.
//!
//! The seam stands where the paper puts it (section 3.2): a model gives the driving force per length of line, and
//! `contact_line` spreads it over the particles. A new model is one file, one variant and one match arm.

pub mod contact_line;
mod young;

pub use young::YoungForce;

/// What a wetting model sees of the contact line at a particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineState {
    /// cos α of the present angle between interface and wall, through the wetting phase.
    pub cos_alpha: f64,
    /// Interfacial tension σ_wn in N/m.
    pub tension: f64,
}

/// The wetting models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wetting {
    /// The unbalanced Young force [Huber2013, Eq. 7].
    Young(YoungForce),
}

impl Wetting {
    /// Driving force f_wns along ν_ns (along the wall, from the wetting to the other phase) in N/m.
    #[must_use]
    pub fn driving_force(&self, line: &LineState) -> f64 {
        match self {
            Self::Young(model) => model.driving_force(line),
        }
    }

    /// The static contact angle in rad that the user asked for.
    #[must_use]
    pub fn static_angle(&self) -> f64 {
        match self {
            Self::Young(model) => model.contact_angle,
        }
    }
}
