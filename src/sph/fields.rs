//! What follows from the positions: fields of the fluids, of their interface and of the walls.
//!
//! Everything here is a function of setting and state alone, so that a resumed run finds the same bits.

use crate::sph::bulk::BulkFields;
use crate::sph::surface_force::InterfaceFields;
use crate::sph::walls::WallFields;

/// All fields. A [`Field`](crate::sph::images::Field) is over particles and images, a list over the particles that its comment names.
#[derive(Debug, Clone, Default)]
pub struct Fields {
    /// Of the fluids.
    pub bulk: BulkFields,
    /// Of their interface.
    pub interface: InterfaceFields,
    /// Of the walls.
    pub walls: WallFields,
}
