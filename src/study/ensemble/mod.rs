//! What becomes of the samples of uncertain values: networks are run within this process, and of any model it is told how sure the results are.
//!
//! [`plan`] checks all cases of networks, [`engine`] runs them, and [`store`] keeps what is done. [`statistics`] tells of the samples of any model
//! quantiles, Sobol indices and how both settle; [`bands`] draws curves and maps of networks.

pub(crate) mod bands;
pub(crate) mod engine;
pub(crate) mod plan;
pub(crate) mod statistics;
pub(crate) mod store;
