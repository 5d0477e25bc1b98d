//! Thin films: numerics, models against their laws, cases.

mod cases;
mod diffsol;
mod models;
mod numerics;
mod oracle;
mod range;
mod rest;
mod support;
