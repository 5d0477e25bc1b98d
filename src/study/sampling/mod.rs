//! Uncertain values: distributions, and samples of them by a low-discrepancy sequence.
//!
//! [`inputs`] reads the axes that have a [`distribution`](distribution::Distribution) and their correlations; [`design`] draws the samples, which become one
//! axis with a row per run.

mod design;
mod distribution;
mod inputs;

pub(super) use inputs::{SampledAxis, sampled};
