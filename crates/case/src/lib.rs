//! Case files: read and checked, with every mistake located.
//!
//! [`load`] goes from a path to a [`Loaded`] case: TOML -> tables, in which every key is optional, so that one mistake does not hide another -> checks -> a
//! [`Case`], which has every value in SI units and in range. Each file has a table, its checked type, and the rules between its keys, which also set defaults
//! in the table, so that the tables are the resolved case; the allowed values of a single key are declared with the key ([`tables`](meniscus_core::input::tables)).
#![warn(unreachable_pub)]

mod case_file;
mod depth;
mod facts;
pub mod film;
mod fluid;
mod initial;
mod key_units;
mod kind;
mod load;
mod magnitude;
mod measure_groups;
pub mod measures;
pub mod network;
mod network_options;
pub(crate) mod numerics;
mod open;
mod output;
mod permeability;
pub mod preset;
mod quick;
mod rate;
mod read_geometry;
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
mod title;
mod wetting;

pub use case_file::{Case, Model};
pub use depth::implausible_depth;
pub use facts::{Facts, check_against};
pub use fluid::{Fluid, FluidPhase, RawFluid, RawInterface, RawPhases};
pub use initial::InitialVelocity;
pub use key_units::unit_of_key;
pub use kind::{is_case, other_than_a_study};
pub use load::load_from;
pub use load::{Loaded, load, load_default};
pub use measure_groups::{MeasureSet, Offer};
pub use network_options::NetworkOptions;
pub use numerics::{Numerics, ViscousStep, ViscousTerm};
pub use open::{Drive, PressureSteps, Profile};
pub use output::{Compression, Expectation, Output};
pub use quick::quick;
pub use read_geometry::load_shapes;
pub use read_geometry::{KeptGeometry, Origin, load_shapes_text, read};
pub use schema::starter_of_chip;
pub use schema::{schema, starter_case};
pub use side::{SIDES, Side, SideName, Sides};
pub use sph::Sph;
pub use steady::{FEWEST_ROWS, SteadyStop};
pub use surface_force::{LineDelta, SurfaceForce};
pub use wetting::{PatchedWall, WettingPatch, on_plates};
