//! Incompressible SPH for two fluids with partial wetting, after Huber et al. 2013.
//!
//! [`flow::Flow`] is the whole, by its parts: `setting`, `state`, `neighborhood`, `fields`. `projection` decides the order of a step, `terms`
//! holds the equations.

pub mod boundary;
mod cells;
mod components;
pub mod conjugate_gradients;
pub mod domain;
pub mod fields;
pub mod fill;
pub mod flow;
pub mod frozen;
pub mod images;
pub mod kernel;
pub mod measures;
pub mod method;
mod motion;
pub mod neighborhood;
pub mod observe;
pub mod open;
mod output;
pub mod packing;
pub mod pairs;
pub mod particles;
pub mod poisson;
pub mod projection;
pub mod setting;
pub mod setup;
pub mod solver;
pub mod stages;
pub mod state;
pub mod surface_force;
pub mod terms;
pub mod time_step;
pub mod unresolved;
pub mod warnings;
pub mod wetting;
