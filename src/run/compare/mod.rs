//! A network and a direct simulation of one geometry, side by side; or two networks (`networks`).
//!
//! Both are separate cases. The network proceeds from event to event, the direct simulation from record to record. At equal saturations the invaded elements
//! are compared, cell by cell on one grid; so are the pressures, the filling order of the elements, and the cost. Only the first half cycle of a network
//! counts.

mod comparison;
mod direct;
mod execute;
mod files;
mod measures;
mod network;
pub(crate) mod networks;
mod page;
mod pair;
mod picture;
mod rank;
mod side_by_side;
mod states;
mod track;

pub(crate) use self::comparison::{Comparison, Side};
pub(crate) use self::direct::RUN as DIRECT_RUN;
pub(crate) use self::execute::{ExecuteError, execute};
pub(crate) use self::files::{CURVES, PAGE, write};
pub(super) use self::network::outlet_elements;
pub(crate) use self::pair::{CompareError, Of, Pair, Task};
pub(crate) use self::side_by_side::{check, compare};
