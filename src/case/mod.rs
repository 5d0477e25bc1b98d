//! Case files: what the user wrote, checked, with every mistake named at its place.
//!
//! [`load`] goes from a path to a [`Loaded`] case: TOML -> tables, in which every key is optional, so that one mistake does not hide another
//! -> checks -> a [`Case`], which holds every value in SI units and in range. A file has a table, what it becomes, the rules between its keys, and the
//! way back; what each key may hold by itself stands beside the key ([`tables`](crate::input::tables)).

mod case_file;
mod facts;
pub mod film;
mod fluid;
mod initial;
mod kind;
mod load;
mod magnitude;
mod measure_groups;
pub mod measures;
pub mod network;
mod numerics;
mod open;
mod output;
mod permeability;
pub mod preset;
mod quick;
mod records;
mod relative_permeability;
mod schema;
mod shapes;
mod side;
mod sides;
mod sph;
mod start;
mod steady;
mod surface_force;
mod wetting;

pub use case_file::{Case, Model};
pub use facts::{Facts, check_against};
pub use fluid::{Fluid, FluidPhase, RawFluid, RawInterface, RawPhases};
pub use initial::{Initial, InitialVelocity};
pub use kind::is_case;
pub(crate) use kind::other_than_a_study;
pub(crate) use load::read;
pub use load::{Loaded, load, load_default, load_shapes, load_started};
pub use measure_groups::{MeasureSet, Offer};
pub use numerics::{Numerics, ViscousStep, ViscousTerm};
pub use open::{Drive, Open, PressureSteps, Profile};
pub use output::{Compression, Expectation, Output};
pub use quick::quick;
pub use schema::{schema, starter_case};
pub use side::{SIDES, Side, SideName, Sides};
pub use sides::Walls;
pub use sph::Sph;
pub use steady::{FEWEST_ROWS, SteadyStop};
pub use surface_force::{LineDelta, SurfaceForce};
pub use wetting::{PatchedWall, RawWetting, Stripes, WettingPatch};
