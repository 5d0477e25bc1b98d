//! What follows from the positions: fields of the fluids, of their interface and of the walls.
//!
//! Everything here is a function of setting and state alone, so that a resumed run finds the same bits.

use crate::sph::bulk::BulkFields;
use crate::sph::neighborhood::Neighborhood;
use crate::sph::setting::Setting;
use crate::sph::state::FlowState;
use crate::sph::surface_force::{InterfaceFields, interface_fields};
use crate::sph::view::View;
use crate::sph::walls::WallFields;
use crate::sph::wetting::lines::Line;

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

impl Fields {
    /// Finds all fields but those of the walls anew. Returns the contact lines now.
    pub(crate) fn update(&mut self, setting: &Setting, state: &FlowState, around: &Neighborhood) -> Vec<Line> {
        let flow = View { setting, state, neighborhood: around, fields: &() };
        self.bulk = BulkFields::of(&flow);
        let lines;
        (self.interface, lines) = interface_fields(&flow.with(&self.bulk));
        lines
    }
}
