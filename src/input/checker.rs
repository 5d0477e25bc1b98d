//! The tool of all checks of an input file: values pass through, and what is wrong with them is collected.

use super::problem::Problem;
use super::range::Range;

/// The format of case and shape files that this program reads.
const FORMAT: u32 = 1;

/// Collects problems while values pass through.
#[derive(Debug, Default)]
pub struct Checker {
    /// What was wrong so far.
    pub problems: Vec<Problem>,
}

impl Checker {
    /// Notes a problem at the key path `path`, with a way out.
    pub fn refuse(&mut self, path: impl Into<String>, message: impl Into<String>, help: impl Into<String>) {
        self.problems.push(Problem { path: path.into(), message: message.into(), help: help.into() });
    }

    /// The value, or a problem where it is missing.
    pub fn require<T>(&mut self, path: &str, value: Option<T>, example: &str) -> Option<T> {
        if value.is_none() {
            let (table, key) = path.rsplit_once('.').unwrap_or(("", path));
            let place = if table.is_empty() { String::new() } else { format!(" in [{table}]") };
            self.refuse(path, format!("missing key `{key}`{place}"), format!("add {example}"));
        }
        value
    }

    /// The value where it lies in a range; `what` names it with its unit.
    pub fn in_range(&mut self, path: &str, value: Option<f64>, range: Range, what: &str) -> Option<f64> {
        let value = value?;
        if range.contains(value) {
            return Some(value);
        }
        self.refuse(path, format!("expected {what} {range}, found {value:?}"), "");
        None
    }

    /// The value where it is above zero; `what` names it with its unit.
    pub fn positive(&mut self, path: &str, value: Option<f64>, what: &str) -> Option<f64> {
        self.in_range(path, value, Range::Above(0.0), what)
    }

    /// The value where it is there and above zero; `what` names it with its unit.
    pub fn require_positive(&mut self, path: &str, value: Option<f64>, example: &str, what: &str) -> Option<f64> {
        let value = self.require(path, value, example);
        self.positive(path, value, what)
    }

    /// The value where it lies in a closed range; `what` names it with its unit.
    pub fn within(&mut self, path: &str, value: Option<f64>, range: (f64, f64), what: &str) -> Option<f64> {
        self.in_range(path, value, Range::Within(range.0, range.1), what)
    }

    /// Refuses a file of another format.
    pub fn format(&mut self, found: Option<u32>) {
        if let Some(found) = self.require("format", found, "format = 1")
            && found != FORMAT
        {
            self.refuse(
                "format",
                format!("expected format {FORMAT}, found {found}"),
                "this version reads format 1; a newer format needs a newer version",
            );
        }
    }
}
