//! Whole runs of the direct simulation against exact solutions.

#[path = "../support/mod.rs"]
mod support;

mod contact_angles;
mod own_spacing;
mod relative_permeability;
mod validation;
