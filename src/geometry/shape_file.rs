//! Shape files of other tools: disc lists (`.xyr`, `.txt`, `.csv`) and well-known text (`.wkt`).
//!
//! Comment lines begin with `#`; `# domain xmin ymin xmax ymax` (m) sets the domain, else it is the box around the shapes with
//! a margin, so that fluid can pass between the shapes and the sides.
//! Our own TOML shape files are read by the case module, which knows places in TOML.

use std::path::{Path, PathBuf};

use crate::geometry::disc_list;
use crate::geometry::spec::{GeometrySpec, ShapeSpec, SolidSide};
use crate::geometry::well_known_text;
use crate::input::problem::Problem;

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

/// Why a shape file was refused.
#[derive(Debug, thiserror::Error)]
pub enum ShapeFileError {
    /// The file cannot be opened or is not text.
    #[error("cannot read the shape file {}: {source}", path.display())]
    Read {
        /// Absolute path.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The name's ending is not one of ours.
    #[error("the shape file {} ends in none of .xyr, .txt, .csv (discs), .wkt (polygons), .toml (shapes)", path.display())]
    Ending {
        /// Absolute path.
        path: PathBuf,
    },
    /// A TOML file came here by mistake: the case module reads those.
    #[error("{} is a TOML shape file, which the case reader has to read", path.display())]
    Toml {
        /// Absolute path.
        path: PathBuf,
    },
    /// Some lines cannot be read: all of them.
    #[error("{}: {} bad line(s)\n{}", path.display(), lines.len(), join(lines))]
    Lines {
        /// Absolute path.
        path: PathBuf,
        /// The lines in order.
        lines: Vec<LineProblem>,
    },
    /// Every line reads well, but the shapes make no sense.
    #[error("{}: {} problem(s)\n{}", path.display(), problems.len(), join(problems))]
    Shapes {
        /// Absolute path.
        path: PathBuf,
        /// The problems, with the shapes numbered as in the file.
        problems: Vec<Problem>,
    },
}

fn join<T: ToString>(items: &[T]) -> String {
    items.iter().map(|item| format!("  {}", item.to_string())).collect::<Vec<_>>().join("\n")
}

/// Reads a shape file, chosen by its ending; shapes are solid, and the result has no problems.
///
/// # Errors
/// See [`ShapeFileError`]; all bad lines are named at once.
pub fn load(path: &Path) -> Result<GeometrySpec, ShapeFileError> {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    let parse = match ending.as_str() {
        "xyr" | "txt" | "csv" => disc_list::parse,
        "wkt" => well_known_text::parse,
        "toml" => return Err(ShapeFileError::Toml { path }),
        _ => return Err(ShapeFileError::Ending { path }),
    };
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(source) => return Err(ShapeFileError::Read { path, source }),
    };
    let spec = match parse(text.trim_start_matches('\u{feff}')) {
        Ok(spec) => spec,
        Err(lines) => return Err(ShapeFileError::Lines { path, lines }),
    };
    let problems = spec.problems();
    if problems.is_empty() { Ok(spec) } else { Err(ShapeFileError::Shapes { path, problems }) }
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
