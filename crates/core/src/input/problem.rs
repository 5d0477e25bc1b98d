//! A mistake in an input file: its key path, what is wrong, and a remedy. Plain data, no source text.

use std::fmt;

/// One mistake in what a user wrote.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Key path, such as `shapes[2].disc.radius`.
    pub path: String,
    /// What is wrong, with what was found and what was expected.
    pub message: String,
    /// A remedy.
    pub help: String,
    /// Key or table whose mistakes may have caused this one: it is reported only where that has none.
    pub cause: Option<&'static str>,
}

impl Problem {
    /// A problem at `path`.
    pub fn new(path: impl Into<String>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { path: path.into(), message: message.into(), help: help.into(), cause: None }
    }

    /// The same problem, which a mistake in the key or table `cause` may have caused.
    pub fn caused_by(self, cause: &'static str) -> Self {
        Self { cause: Some(cause), ..self }
    }

    /// A problem at `path` from the text of an error: its remedy follows the first semicolon.
    pub fn of_text(path: impl Into<String>, text: &str) -> Self {
        let (message, help) = text.split_once("; ").unwrap_or((text, ""));
        Self::new(path, message, help)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} ({})", self.path, self.message, self.help)
    }
}
