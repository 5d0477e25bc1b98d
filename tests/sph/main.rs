//! Direct simulation: equations, steps, walls, open sides, and whole runs against exact solutions.

#[path = "../support/mod.rs"]
mod support;

mod analysis;
mod contact_angles;
mod counted_work;
mod depth;
mod error_bars;
mod fitted_interface;
mod fitted_walls;
mod open_sides;
mod poisson;
mod relative_permeability;
mod steady_flows;
mod step;
mod stream;
mod terms;
mod validation;
mod viscosity;
mod walls;
