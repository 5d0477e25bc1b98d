//! Samples of uncertain values: runs of networks within this process, and statistics of the results of any model.
//!
//! [`plan`] checks all cases of networks, [`engine`] runs them, and [`store`] keeps what is done. [`statistics`] tells of the samples of any model
//! quantiles, Sobol indices and how both settle; [`bands`] draws curves and maps of networks.

pub(crate) mod bands;
pub(crate) mod engine;
pub(crate) mod plan;
pub(crate) mod statistics;
pub(crate) mod store;
