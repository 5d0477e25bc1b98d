//! Case files: what the user wrote, checked, with every mistake named at its place.

pub mod checked;
