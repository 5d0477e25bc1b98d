//! Collects the problems of an input file: values pass through, and whatever is wrong with them is recorded.

use super::path;
use super::problem::Problem;

/// Format version of case and shape files that this program reads.
const FORMAT: u32 = 1;

/// Collects problems while values pass through.
#[derive(Debug, Default)]
pub struct Checker {
    /// The problems so far.
    pub problems: Vec<Problem>,
    /// What a reader should know of values that are right.
    pub notes: Vec<String>,
}

impl Checker {
    /// Records a problem at the key path `path`, with a remedy.
    pub fn refuse(&mut self, path: impl Into<String>, message: impl Into<String>, help: impl Into<String>) {
        self.problems.push(Problem::new(path, message, help));
    }

    /// Records what a reader should know of a value that is right.
    pub fn note(&mut self, note: String) {
        self.notes.push(note);
    }

    /// Whether there is a problem at the key path `path` or within it.
    pub fn is_refused(&self, path: &str) -> bool {
        self.problems.iter().any(|problem| path::is_within(&problem.path, path))
    }

    /// Whether the key at the path `path` is present: it has a value, or a problem with the one that is written.
    pub fn is_given<T>(&self, path: &str, value: Option<&T>) -> bool {
        value.is_some() || self.is_refused(path)
    }

    /// The value; a problem if it is missing and nothing else is wrong with it.
    pub fn require<T>(&mut self, path: &str, value: Option<T>, example: &str) -> Option<T> {
        if value.is_none() && !self.is_refused(path) {
            let (table, key) = path.rsplit_once('.').unwrap_or(("", path));
            let location = if table.is_empty() { String::new() } else { format!(" in [{table}]") };
            self.refuse(path, format!("missing key `{key}`{location}"), format!("add {example}"));
        }
        value
    }

    /// Refuses a file of another format version.
    pub fn format(&mut self, found: Option<u32>) {
        if let Some(found) = found.filter(|found| *found != FORMAT) {
            self.refuse(
                "format",
                format!("expected format {FORMAT}, found {found}"),
                "this version reads format 1; a newer format needs a newer version",
            );
        }
    }
}
