//! Mistakes with their locations, all those of a case at once, as a colored report or as plain text.

use std::sync::Arc;

use miette::{Diagnostic, SourceSpan};

use super::excerpt::{Excerpt, shortened};

/// Most characters of a message: what it quotes of a file can be of any length.
const LONGEST: usize = 1000;

/// One mistake and its location.
#[derive(Debug, Clone, thiserror::Error, Diagnostic)]
#[error("{message}")]
pub struct Mistake {
    /// What was expected and what was found.
    pub message: String,
    /// The file, or the `--set KEY=VALUE`.
    pub name: String,
    /// Line and column, from 1; absent for a file as a whole.
    pub location: Option<(usize, usize)>,
    #[help]
    help: Option<String>,
    #[source_code]
    excerpt: Option<Excerpt>,
    #[label("here")]
    span: Option<SourceSpan>,
}

impl Mistake {
    /// A mistake of a file as a whole, such as one that cannot be read.
    pub fn of_file(name: &str, message: String, help: &str) -> Self {
        Self {
            message: shortened(&message, LONGEST),
            name: name.to_owned(),
            location: None,
            help: (!help.is_empty()).then(|| shortened(help, LONGEST)),
            excerpt: None,
            span: None,
        }
    }

    /// A mistake at the bytes `start..end` of `text`; the ends are moved to the nearest character boundaries.
    pub(super) fn in_text(
        name: &str,
        text: &Arc<str>,
        range: std::ops::Range<usize>,
        problem: (String, String),
    ) -> Self {
        let start = floor_boundary(text, range.start);
        let end = floor_boundary(text, range.end).max(start);
        let before = &text[..start];
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |rest| rest.chars().count()) + 1;
        let (excerpt, span) = Excerpt::new(name, text, start..end, (line - 1, column - 1));
        Self {
            location: Some((line, column)),
            excerpt: Some(excerpt),
            span: Some((span.start, span.len()).into()),
            ..Self::of_file(name, problem.0, &problem.1)
        }
    }

    /// The remedy, empty if the message is sufficient.
    pub fn help_text(&self) -> &str {
        self.help.as_deref().unwrap_or_default()
    }

    /// `file.toml:12:5: message`, and a second line with the help.
    fn render(&self) -> String {
        let location = self.location.map_or(String::new(), |(line, column)| format!(":{line}:{column}"));
        let help = self.help.as_ref().map_or(String::new(), |help| format!("  help: {help}\n"));
        format!("{}{location}: {}\n{help}", shortened(&self.name, LONGEST), self.message)
    }
}

/// All mistakes of a case and of the files it names.
#[derive(Debug, Clone, thiserror::Error, Diagnostic)]
#[error("{}", summary(.mistakes))]
pub struct InputError {
    /// The mistakes, by file and location.
    #[related]
    pub mistakes: Vec<Mistake>,
}

impl InputError {
    /// The mistakes as plain text without colors, sorted by location.
    pub fn render(&self) -> String {
        self.mistakes.iter().map(Mistake::render).collect()
    }
}

impl From<Mistake> for InputError {
    fn from(mistake: Mistake) -> Self {
        Self { mistakes: vec![mistake] }
    }
}

fn summary(mistakes: &[Mistake]) -> String {
    match mistakes {
        [one] => format!("a mistake in {}", shortened(&one.name, LONGEST)),
        _ => format!("{} mistakes", mistakes.len()),
    }
}

/// The last character boundary at or before `index`.
fn floor_boundary(text: &str, index: usize) -> usize {
    (0..=index.min(text.len())).rev().find(|i| text.is_char_boundary(*i)).unwrap_or(0)
}
