//! Fields derived from the positions: of the fluids, of their interface and of the walls.
//!
//! All are functions of configuration and state alone, so that a resumed run computes the same bits.

use crate::bulk::BulkFields;
use crate::surface_force::InterfaceFields;
use crate::walls::WallFields;

/// All fields. A [`Field`](crate::images::Field) covers particles and images, a list the particles that its comment names.
#[derive(Debug, Clone, Default)]
pub struct Fields {
    /// Of the fluids.
    pub bulk: BulkFields,
    /// Of their interface.
    pub interface: InterfaceFields,
    /// Of the walls.
    pub walls: WallFields,
}
