//! Thin films: numerics, models against their laws, cases.

#[path = "../support/mod.rs"]
mod support;

mod cases;
mod diffsol;
mod models;
mod numerics;
mod oracle;
mod range;
mod rest;
