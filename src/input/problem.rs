//! One mistake of a user's file, named by key path; the reader of the file finds its line.

/// Something wrong with a value that a user wrote.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Key path such as `shapes[2].disc.radius`; empty for the file as a whole.
    pub path: String,
    /// What was expected and what was found, lower case.
    pub message: String,
    /// A way out; empty where the message says it all.
    pub help: String,
}
