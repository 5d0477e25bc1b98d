//! What the lines of shape files of other tools have in common: words, comments, the domain, and lines that cannot be read.
//!
//! Comment lines begin with `#`; `# domain xmin ymin xmax ymax` (m) sets the domain, else it is the box around the shapes with
//! a margin, so that fluid can pass between the shapes and the sides.

use crate::geometry::spec::{GeometrySpec, ShapeSpec, SolidSide};

/// Margin around the shapes where the file names no domain, over the longer side of the box around them.
const MARGIN: f64 = 0.1;

/// A line that cannot be read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LineProblem {
    /// Line number, from 1.
    pub line: usize,
    /// The text found there.
    pub text: String,
    /// What was expected.
    pub expected: String,
}

impl std::fmt::Display for LineProblem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}: found `{}`, expected {}", self.line, self.text, self.expected)
    }
}

/// What stands beside the shapes in a file of another tool.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    /// xmin, ymin, xmax, ymax in m of a `# domain` comment.
    pub domain: Option<[f64; 4]>,
    /// Lines that cannot be read.
    pub bad: Vec<LineProblem>,
}

impl Notes {
    /// Takes in a comment, which may set the domain; false where the line is none.
    pub fn take_comment(&mut self, line: usize, text: &str) -> bool {
        let Some(comment) = text.strip_prefix('#') else { return false };
        let mut words = words(comment.trim_start_matches('#'));
        if words.next().is_some_and(|word| word.trim_end_matches(':').eq_ignore_ascii_case("domain")) {
            let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
            match numbers.ok().and_then(|n| <[f64; 4]>::try_from(n).ok()) {
                Some(domain) => self.domain = Some(domain),
                None => self.refuse(line, text, "`# domain xmin ymin xmax ymax` in m".to_owned()),
            }
        }
        true
    }

    /// Notes a line that cannot be read.
    pub fn refuse(&mut self, line: usize, text: &str, expected: String) {
        self.bad.push(LineProblem { line, text: shortened(text), expected });
    }

    /// The file with these shapes, which lie in the box `around` (xmin, ymin, xmax, ymax in m).
    pub fn finish(
        mut self,
        shapes: Vec<ShapeSpec>,
        around: [f64; 4],
        (nothing, expected): (&str, &str),
    ) -> Result<GeometrySpec, Vec<LineProblem>> {
        if self.bad.is_empty() && shapes.is_empty() {
            self.refuse(1, nothing, expected.to_owned());
        }
        if !self.bad.is_empty() {
            return Err(self.bad);
        }
        let [x0, y0, x1, y1] = self.domain.unwrap_or_else(|| {
            let [x0, y0, x1, y1] = around;
            let margin = MARGIN * (x1 - x0).max(y1 - y0);
            [x0 - margin, y0 - margin, x1 + margin, y1 + margin]
        });
        Ok(GeometrySpec { min: [x0, y0], max: [x1, y1], solid: SolidSide::Inside, shapes })
    }
}

/// The smallest box around some boxes, each as xmin, ymin, xmax, ymax in m.
pub(crate) fn around(boxes: impl Iterator<Item = [f64; 4]>) -> [f64; 4] {
    let none = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    boxes.fold(none, |a, b| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])])
}

/// The words of a line, separated by spaces, tabs, commas or semicolons.
pub(crate) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c.is_whitespace() || c == ',' || c == ';').filter(|word| !word.is_empty())
}

/// The text of a line, shortened for a message.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    if text.chars().count() <= LONGEST {
        text.to_owned()
    } else {
        text.chars().take(LONGEST).chain("...".chars()).collect()
    }
}
