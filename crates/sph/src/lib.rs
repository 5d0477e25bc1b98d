//! Incompressible SPH for two fluids with partial wetting, after Huber et al. 2013.
//!
//! [`flow::Flow`] consists of `config`, `state`, `neighborhood` and `fields`. `projection` defines the order of operations in a step, `terms`
//! has the discretized equations.
#![warn(unreachable_pub)]

pub(crate) mod boundary;
pub(crate) mod bulk;
mod cells;
mod components;
pub(crate) mod configuration;
pub mod conjugate_gradients;
pub mod domain;
pub mod equivalent_forces;
pub(crate) mod fields;
pub mod fill;
pub mod flow;
pub(crate) mod frozen;
pub mod images;
pub mod kernel;
pub mod measures;
pub mod method;
pub mod neighborhood;
pub mod observe;
pub mod open;
mod output;
pub(crate) mod packing;
pub mod pairs;
mod parallel;
pub mod particles;
pub mod poisson;
pub(crate) mod projection;
pub mod setup;
pub mod solver;
pub(crate) mod stages;
pub(crate) mod state;
pub(crate) mod surface_force;
pub mod terms;
pub(crate) mod time_step;
pub mod unresolved;
pub(crate) mod view;
pub(crate) mod walls;
pub(crate) mod warnings;
pub mod wetting;
