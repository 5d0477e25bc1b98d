//! TOML with places: every mistake of a file at once, each with its line.

pub mod problem;
