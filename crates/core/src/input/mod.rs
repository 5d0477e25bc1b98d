//! TOML with source locations: every mistake of a file at once, each with its line.
//!
//! A [`Document`] is a file's text and tree. [`Document::read`] deserializes it by serde and continues after a mistake; the checkers of a type name
//! [`Problem`]s by key path, and [`Reading::refuse`](read::Reading::refuse) locates them. [`Overrides`] are the `--set KEY=VALUE` of the command line.

mod checker;
mod document;
mod error;
mod excerpt;
mod explain;
pub mod file;
mod overrides;
mod path;
pub mod problem;
mod range;
mod read;
mod suggest;
pub mod tables;
mod tree;

pub use checker::Checker;
pub use document::{Document, Renamed};
pub use error::{InputError, Mistake};
pub use overrides::Overrides;
pub use problem::Problem;
pub use range::Range;
pub use suggest::nearest;
