//! Case files: read and checked, with every mistake located.
//!
//! [`load`] goes from a path to a [`Loaded`] case: TOML -> tables, in which every key is optional, so that one mistake does not hide another -> checks -> a
//! [`Case`], which has every value in SI units and in range. Each file has a table, its checked type, and the rules between its keys, which also set defaults
//! in the table, so that the tables are the resolved case; the allowed values of a single key are declared with the key ([`tables`](crate::input::tables)).

mod case_file;
mod depth;
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
mod network_options;
pub(crate) mod numerics;
mod open;
mod output;
mod permeability;
pub mod preset;
mod quick;
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
mod wetting;

pub use case_file::{Case, Model};
pub(crate) use depth::implausible_depth;
pub use facts::{Facts, check_against};
pub use fluid::{Fluid, FluidPhase, RawFluid, RawInterface, RawPhases};
pub(crate) use initial::InitialVelocity;
pub(crate) use kind::{is_case, other_than_a_study};
pub(crate) use load::load_from;
pub use load::{Loaded, load, load_default};
pub use measure_groups::{MeasureSet, Offer};
pub use network_options::NetworkOptions;
pub use numerics::{Numerics, ViscousStep, ViscousTerm};
pub(crate) use open::{Drive, PressureSteps, Profile};
pub(crate) use output::{Compression, Expectation, Output};
pub(crate) use quick::quick;
pub use read_geometry::load_shapes;
pub(crate) use read_geometry::{KeptGeometry, Origin, load_shapes_text, read};
pub(crate) use schema::starter_of_chip;
pub use schema::{schema, starter_case};
pub(crate) use side::{SIDES, Side, SideName, Sides};
pub(crate) use sph::Sph;
pub(crate) use steady::{FEWEST_ROWS, SteadyStop};
pub use surface_force::{LineDelta, SurfaceForce};
pub(crate) use wetting::{PatchedWall, WettingPatch, on_plates};
