//! What several tests need. Each test program uses its own part.
#![allow(dead_code, unused_imports, reason = "each test program uses its own part")]

pub mod boxes;
pub mod browser;
pub mod cloud;
pub mod dice;
pub mod files;
pub mod flow;
pub mod packs;
pub mod program;
pub mod python;
