//! Samples of uncertain values: runs of networks within this process, and statistics of the results of any model.
//!
//! [`plan`] checks all cases of networks, [`engine`] runs them, and [`store`] saves the finished ones. For the samples of any model, [`statistics`] computes
//! quantiles, Sobol indices and their convergence; [`bands`] draws curves and maps of networks.

pub(crate) mod bands;
pub(crate) mod engine;
pub(crate) mod plan;
pub(crate) mod statistics;
pub(crate) mod store;
