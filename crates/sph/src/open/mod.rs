//! Open sides: fluid enters and leaves at a given velocity or a given pressure.
//!
//! Beyond an open side is a *buffer*: particles that count as fluid in every sum, and whose velocity (at inlets) or pressure (elsewhere) is given. A buffer
//! particle that crosses inwards becomes fluid, and a new one is created at the far end of its row; fluid that crosses outwards becomes buffer, and is removed
//! beyond the far end (method: Tafuni et al. 2018; for the pressure equation Hirschler et al. 2016).

mod boundary_fluxes;
mod buffer;
mod extrapolate;
mod pressure;
mod profile;
mod side;
mod through;

pub use boundary_fluxes::BoundaryFluxes;
pub(crate) use buffer::{Around, exchange, fill, note_passed};
pub(crate) use extrapolate::InteriorPoints;
pub(crate) use pressure::Prescribed;
pub(crate) use profile::{Opening, Profile, Shape, openings};
pub use side::{DEPTH, Drive, OpenSide, Ramp, Staircase};
pub(crate) use through::{GivenFlow, Moved};

/// The sides through which fluid enters or leaves.
#[derive(Debug, Clone, Default)]
pub struct Open {
    /// Inlets and outlets.
    pub sides: Vec<OpenSide>,
    /// Periodic sides with a given flow rate.
    pub through: Vec<OpenSide>,
}
