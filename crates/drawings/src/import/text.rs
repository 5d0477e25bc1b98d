//! Common parts of text formats: words, comments, the domain, and lines that cannot be read.
//!
//! Comment lines begin with `#`; `# domain xmin ymin xmax ymax` (in the unit of the file) sets the domain.

use crate::import::drawing::Refusal;
use meniscus_core::input::file;
use meniscus_core::math::{Bounds, Vec2};

/// Content of a text file besides the shapes.
#[derive(Debug, Default)]
pub(crate) struct Lines {
    /// The box of a `# domain` comment.
    pub(crate) domain: Option<Bounds>,
    /// Lines that cannot be read.
    pub(crate) bad: Vec<Refusal>,
}

impl Lines {
    /// Parses a comment, which may set the domain; false if the line is not a comment.
    pub(crate) fn take_comment(&mut self, line: usize, text: &str) -> bool {
        let Some(comment) = text.strip_prefix('#') else { return false };
        let mut words = words(comment.trim_start_matches('#'));
        if words.next().is_some_and(|word| word.trim_end_matches(':').eq_ignore_ascii_case("domain")) {
            let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
            match numbers.ok().and_then(|n| <[f64; 4]>::try_from(n).ok()) {
                Some([x0, y0, x1, y1]) => {
                    self.domain = Some(Bounds { min: Vec2::new(x0, y0), max: Vec2::new(x1, y1) });
                }
                None => self.refuse(line, text, "`# domain xmin ymin xmax ymax`".to_owned()),
            }
        }
        true
    }

    /// Records a line that cannot be read.
    pub(crate) fn refuse(&mut self, line: usize, text: &str, expected: String) {
        self.bad.push(Refusal { location: at_line(line), found: quoted(text), expected });
    }
}

/// The source location of a line.
pub(crate) fn at_line(line: usize) -> String {
    format!("line {line}")
}

/// The words of a line, separated by spaces, tabs, commas or semicolons.
pub(crate) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|word| !word.is_empty())
}

/// A text between back quotes, shortened for a message.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 60;
    if text.chars().count() <= LONGEST {
        format!("`{text}`")
    } else {
        format!("`{}...`", text.chars().take(LONGEST).collect::<String>())
    }
}

/// The UTF-8 text of a file, without byte order mark.
pub(crate) fn utf8(bytes: &[u8]) -> Result<&str, Vec<Refusal>> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text.trim_start_matches('\u{feff}')),
        Err(_) => {
            let location = file::not_text(bytes).unwrap_or_default();
            Err(vec![Refusal::new(
                location,
                "invalid UTF-8",
                "text in UTF-8: save the file as such; is it the right file?",
            )])
        }
    }
}
