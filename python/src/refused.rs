//! Errors as Python exceptions: classes of `meniscus.errors`, with the messages of the program.

use meniscus::run::source::Refusal;
use meniscus::{InputError, Mistake};
use meniscus_case::NetworkOptions;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Why a call has no result.
pub(crate) enum Refused {
    /// Mistakes in the input.
    Case(Refusal),
    /// Mistakes in a dict, with its text as TOML.
    Dict(InputError, String),
    /// A folder or file that cannot be used.
    Folder(String),
    /// The solver failed before there was a result.
    Solver(String),
    /// The call was stopped on request.
    Stopped,
}

impl From<Refusal> for Refused {
    fn from(refusal: Refusal) -> Self {
        Self::Case(refusal)
    }
}

impl From<InputError> for Refused {
    fn from(error: InputError) -> Self {
        Self::Case(Refusal::Input(error))
    }
}

/// A mistake as Python shows it.
struct PythonMistake {
    file: Option<String>,
    location: Option<(usize, usize)>,
    key: Option<String>,
    message: String,
    help: String,
}

impl PythonMistake {
    /// A mistake in a file, or in a dict that was written as `text`.
    fn of(mistake: &Mistake, text: Option<&str>) -> Self {
        let (message, help) = (mistake.message.clone(), mistake.help_text().to_owned());
        let set = mistake.name.strip_prefix("--set ").and_then(|set| set.split_once('='));
        let key = set.map(|(key, _)| key.to_owned());
        let in_dict = text.filter(|_| key.is_none() && mistake.name == DICT);
        if key.is_some() || in_dict.is_some() {
            let found = in_dict.zip(mistake.location).and_then(|(text, (line, _))| key_at(text, line));
            return Self { file: None, location: None, key: key.or(found), message, help };
        }
        Self { file: Some(mistake.name.clone()), location: mistake.location, key: None, message, help }
    }

    /// As the program prints it: the location, the message, and below it the remedy.
    fn text(&self) -> String {
        let location = match (&self.file, self.location, &self.key) {
            (Some(file), Some((line, column)), _) => format!("{file}:{line}:{column}: "),
            (Some(file), None, _) => format!("{file}: "),
            (None, _, Some(key)) => format!("{key}: "),
            (None, _, None) => String::new(),
        };
        let help = if self.help.is_empty() { String::new() } else { format!("\n  help: {}", self.help) };
        format!("{location}{}{help}", self.message)
    }

    fn into_python(self, py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let dict = PyDict::new(py);
        dict.set_item("file", self.file)?;
        dict.set_item("line", self.location.map(|location| location.0))?;
        dict.set_item("column", self.location.map(|location| location.1))?;
        dict.set_item("key", self.key)?;
        dict.set_item("message", self.message)?;
        dict.set_item("help", self.help)?;
        Ok(dict)
    }
}

/// Name of a dict in messages of the library.
pub(crate) const DICT: &str = "case";

impl Refused {
    /// The exception to raise.
    pub(crate) fn into_error(self, py: Python<'_>) -> PyErr {
        let raised = match self {
            Self::Case(Refusal::Input(error)) => case_error(py, of_input(&error, None)),
            Self::Case(Refusal::Options(problems)) => {
                let shown = |problem: &meniscus_core::input::Problem| PythonMistake {
                    file: None,
                    location: None,
                    key: Some(NetworkOptions::name_of(&problem.path).replace('-', "_")).filter(|key| !key.is_empty()),
                    message: problem.message.clone(),
                    help: problem.help.clone(),
                };
                case_error(py, problems.iter().map(shown).collect())
            }
            Self::Case(Refusal::Setup(text)) => {
                let (message, help) = text.split_once("; ").unwrap_or((&text, ""));
                let (message, help) = (message.to_owned(), help.to_owned());
                case_error(py, vec![PythonMistake { file: None, location: None, key: None, message, help }])
            }
            Self::Dict(error, text) => case_error(py, of_input(&error, Some(&text))),
            Self::Folder(text) => class(py, "FolderError").and_then(|class| class.call1((text,))),
            Self::Solver(text) => class(py, "SolverError").and_then(|class| class.call1((text,))),
            Self::Stopped => return pyo3::exceptions::PyKeyboardInterrupt::new_err(()),
        };
        raised.map_or_else(|error| error, PyErr::from_value)
    }
}

fn of_input(error: &InputError, text: Option<&str>) -> Vec<PythonMistake> {
    error.mistakes.iter().map(|mistake| PythonMistake::of(mistake, text)).collect()
}

fn class<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("meniscus.errors")?.getattr(name)
}

fn case_error(py: Python<'_>, shown: Vec<PythonMistake>) -> PyResult<Bound<'_, PyAny>> {
    let text = shown.iter().map(PythonMistake::text).collect::<Vec<_>>().join("\n");
    let mistakes = shown.into_iter().map(|one| one.into_python(py)).collect::<PyResult<Vec<_>>>()?;
    class(py, "CaseError")?.call1((text, mistakes))
}

/// The key path at a line, from 1, of a text written by the TOML library: a header per table, and a key per line.
fn key_at(text: &str, line: usize) -> Option<String> {
    let before: Vec<&str> = text.lines().take(line).collect();
    let header = before.iter().rfind(|line| line.starts_with('['));
    let key = before.last().filter(|line| !line.starts_with('[')).and_then(|line| line.split_once(" = "));
    let mut path = String::new();
    let mut indexed = String::new();
    for part in header.map_or("", |line| line.trim_matches(['[', ']'])).split('.').filter(|part| !part.is_empty()) {
        let dot = if path.is_empty() { "" } else { "." };
        path = format!("{path}{dot}{part}");
        indexed = format!("{indexed}{dot}{part}");
        // An element of an array has a header of its own.
        let count = before.iter().filter(|line| **line == format!("[[{path}]]")).count();
        if let Some(last) = count.checked_sub(1) {
            indexed = format!("{indexed}[{last}]");
        }
    }
    let parts: Vec<String> =
        Some(indexed).filter(|it| !it.is_empty()).into_iter().chain(key.map(|(key, _)| key.to_owned())).collect();
    (!parts.is_empty()).then(|| parts.join("."))
}
