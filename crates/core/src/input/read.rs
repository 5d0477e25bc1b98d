//! Deserializing a document by serde, continuing after each mistake.
//!
//! Serde stops at the first mistake. So the node at fault is removed from the tree and the rest is read again; types have optional fields, and their checkers
//! report what is missing. Consequences of a removal (a table that now lacks a key) are not reported.

use std::ops::Range;

use serde::Serialize;
use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::document::Document;
use super::error::{InputError, Mistake};
use super::explain::{Explained, explain};
use super::path::{self, Step};
use super::problem::Problem;
use super::tree::{Container, container, find, node, span_at, value_at, visit};

/// Number of mistakes after which reading stops; a file with more of them is not a case file.
const MOST_MISTAKES: usize = 50;

/// The byte range of a placeholder for a missing value; no text is as long.
const NOWHERE: Range<usize> = usize::MAX - 1..usize::MAX;

/// Deepest nesting of number arrays that a key may have: a polygon's holes.
const DEEPEST_ARRAY: usize = 3;

/// A deserialized document, with the mistakes so far.
#[derive(Debug)]
pub struct Reading<'d, T> {
    /// The value; whatever was wrong is absent from it.
    pub value: T,
    document: &'d Document,
    mistakes: Vec<(Range<usize>, Mistake)>,
    removed: Removed,
    /// Whether the file was read to its end.
    complete: bool,
}

/// What has been removed from the tree.
#[derive(Debug, Default)]
struct Removed {
    /// Key paths in the file, and the keys that were probably meant by them.
    paths: Vec<String>,
    /// Array and index in the file of each removed array element.
    elements: Vec<(Vec<Step>, usize)>,
}

impl Document {
    /// Reads the document as a `T`.
    pub fn read<T: DeserializeOwned + Serialize + Default>(&self) -> Reading<'_, T> {
        let mut reader = Reader {
            document: self,
            root: self.tree(),
            mistakes: Vec::new(),
            removed: Removed::default(),
            filled: Vec::new(),
            complete: true,
        };
        reader.refuse_non_finite();
        let value = reader.read();
        reader.refuse_long_arrays(&value);
        Reading { value, document: self, mistakes: reader.mistakes, removed: reader.removed, complete: reader.complete }
    }
}

impl<T> Reading<'_, T> {
    /// All mistakes by location: those of reading, and `problems` unless they follow from those or from one another.
    pub fn refuse(self, problems: Vec<Problem>) -> Vec<Mistake> {
        let mut mistakes = self.mistakes;
        let tree = self.document.tree();
        let mut more = 0;
        let (causes, follow): (Vec<_>, Vec<_>) = problems.into_iter().partition(|problem| problem.cause.is_none());
        let is_cause = |cause: &str| {
            let mut paths = causes.iter().map(|one| &one.path).chain(&self.removed.paths);
            paths.any(|path| path::is_within(path, cause) || path::is_within(cause, path))
        };
        let own: Vec<Problem> = follow.into_iter().filter(|one| !one.cause.is_some_and(is_cause)).collect();
        // Whatever was not read is not missing.
        for problem in causes.into_iter().chain(own).filter(|_| self.complete) {
            let steps = path::parse(&problem.path).unwrap_or_default();
            let steps = self.removed.in_file(&steps);
            if self.removed.explains(&path::write(&steps)) {
                continue;
            }
            if mistakes.len() >= MOST_MISTAKES {
                more += 1;
                continue;
            }
            let range = span_at(tree.get_ref(), &steps);
            let mistake = self.document.mistake(range.clone(), (problem.message, problem.help));
            mistakes.push((range, mistake));
        }
        mistakes.sort_by_key(|(range, _)| range.start);
        let mut mistakes: Vec<Mistake> = mistakes.into_iter().map(|(_, mistake)| mistake).collect();
        mistakes.dedup_by(|a, b| a.location == b.location && a.name == b.name && a.message == b.message);
        if more > 0 || !self.complete {
            mistakes.truncate(MOST_MISTAKES);
            let more = if more > 0 {
                format!("there are {more} more mistakes")
            } else {
                "there may be more mistakes".to_owned()
            };
            mistakes.push(Mistake::of_file(&self.document.name, more, ""));
        }
        mistakes
    }
}

impl Document {
    /// The error that reports `problems` at their locations, if there are any.
    ///
    /// # Errors
    /// [`InputError`] with all problems.
    pub fn refuse(&self, problems: Vec<Problem>) -> Result<(), InputError> {
        let reading =
            Reading { value: (), document: self, mistakes: Vec::new(), removed: Removed::default(), complete: true };
        let mistakes = reading.refuse(problems);
        if mistakes.is_empty() { Ok(()) } else { Err(InputError { mistakes }) }
    }
}

impl Removed {
    /// A path of the current tree as a path of the file.
    fn in_file(&self, steps: &[Step]) -> Vec<Step> {
        let mut path: Vec<Step> = Vec::with_capacity(steps.len());
        for step in steps {
            let step = match step {
                Step::Index(index) => {
                    let mut gone: Vec<usize> =
                        self.elements.iter().filter(|(array, _)| *array == path).map(|(_, index)| *index).collect();
                    gone.sort_unstable();
                    Step::Index(gone.iter().fold(*index, |index, gone| if *gone <= index { index + 1 } else { index }))
                }
                key => key.clone(),
            };
            path.push(step);
        }
        path
    }

    /// Whether a problem at `path` may be a consequence of a removal: of it, of something around it or of a part of it.
    fn explains(&self, path: &str) -> bool {
        self.paths.iter().any(|removed| {
            let parent = removed.rfind(['.', '[']).map(|end| &removed[..end]);
            path::is_within(path, removed) || parent == Some(path)
        })
    }

    fn has(&self, table: &[Step], key: &str) -> bool {
        let mut steps = table.to_vec();
        steps.push(Step::Key(key.to_owned()));
        self.paths.contains(&path::write(&steps))
    }

    fn has_below(&self, table: &[Step]) -> bool {
        let table = path::write(table);
        self.paths.iter().any(|path| path::is_within(path, &table))
    }
}

struct Reader<'d> {
    document: &'d Document,
    root: Spanned<DeTable<'d>>,
    mistakes: Vec<(Range<usize>, Mistake)>,
    removed: Removed,
    /// The byte ranges of tables that lack keys and have placeholders for them.
    filled: Vec<Range<usize>>,
    complete: bool,
}

impl<'d> Reader<'d> {
    fn read<T: DeserializeOwned + Default>(&mut self) -> T {
        while self.mistakes.len() < MOST_MISTAKES {
            let error = match self.try_read::<T>() {
                Ok(value) if self.filled.is_empty() => return value,
                Ok(_) => {
                    self.remove_filled();
                    continue;
                }
                Err(error) => error,
            };
            let span = error.span().unwrap_or_default();
            let steps = find(self.root.get_ref(), &span);
            let explained = self.explain_at::<T>(&error, &steps);
            let missing = explained.missing.clone();
            if !self.record(explained, span, &steps) {
                self.remove(steps);
            } else if missing.is_none_or(|key| !self.fill::<T>(&steps, &key)) && !self.remove(steps) {
                break;
            }
        }
        self.complete = false;
        T::default()
    }

    fn try_read<T: DeserializeOwned>(&self) -> Result<T, toml::de::Error> {
        T::deserialize(toml::Deserializer::from(self.root.clone()))
    }

    fn explain_at<T: DeserializeOwned>(&self, error: &toml::de::Error, steps: &[Step]) -> Explained {
        let mut explained = explain(error.message());
        match node(self.root.get_ref(), steps).map(Spanned::get_ref) {
            Some(DeValue::Datetime(_)) => {
                explained.message = explained.message.replace("found a table", "found a date")
            }
            Some(value) if explained.wants_name => {
                explained.message =
                    format!("expected a name in quotes or a table, found {}", with_article(value.type_str()));
                explained.help = self.names_at::<T>(steps).unwrap_or_default();
            }
            _ => {}
        }
        explained
    }

    /// The names that a value may be: those that serde lists where it finds an unknown one.
    fn names_at<T: DeserializeOwned>(&self, steps: &[Step]) -> Option<String> {
        let (last, parent) = steps.split_last()?;
        let mut root = self.root.clone();
        let unknown = Spanned::new(NOWHERE, DeValue::String("".into()));
        match (container(root.get_mut(), parent), last) {
            (Container::Table(table), Step::Key(key)) => *table.get_mut(key.as_str())? = unknown,
            (Container::Array(array), Step::Index(index)) => *array.get_mut(*index)? = unknown,
            _ => return None,
        }
        let error = T::deserialize(toml::Deserializer::from(root)).err()?;
        (error.span() == Some(NOWHERE)).then(|| explain(error.message()).help)
    }

    /// Records a serde error, unless it follows from an earlier removal; returns whether it did.
    fn record(&mut self, explained: Explained, span: Range<usize>, steps: &[Step]) -> bool {
        let here = self.removed.in_file(steps);
        let follows = explained.missing.as_ref().is_some_and(|key| self.removed.has(&here, key))
            || (explained.empty_choice && self.removed.has_below(&here));
        if let Some(meant) = explained.meant {
            let mut meant_path = here;
            meant_path.pop();
            meant_path.push(Step::Key(meant));
            self.removed.paths.push(path::write(&meant_path));
        }
        if !follows {
            self.push(span, (explained.message, explained.help));
        }
        !follows
    }

    /// Puts a placeholder into a table for a missing key, so that the next missing key is reported, too.
    fn fill<T: DeserializeOwned>(&mut self, steps: &[Step], key: &str) -> bool {
        let span = node(self.root.get_ref(), steps).map(Spanned::span);
        for depth in 0..=DEEPEST_ARRAY {
            let Container::Table(table) = container(self.root.get_mut(), steps) else { return false };
            table.remove(key);
            table.insert(Spanned::new(NOWHERE, key.to_owned().into()), filling(depth));
            if self.try_read::<T>().err().and_then(|error| error.span()) != Some(NOWHERE) {
                self.filled.extend(span);
                return true;
            }
        }
        if let Container::Table(table) = container(self.root.get_mut(), steps) {
            table.remove(key);
        }
        false
    }

    /// Removes the tables that lacked keys.
    fn remove_filled(&mut self) {
        for span in std::mem::take(&mut self.filled) {
            let steps = find(self.root.get_ref(), &span);
            if !steps.is_empty() {
                self.remove(steps);
            }
        }
    }

    fn push(&mut self, span: Range<usize>, problem: (String, String)) {
        let mistake = self.document.mistake(span.clone(), problem);
        self.mistakes.push((span, mistake));
    }

    /// Removes the node at `steps`, with the array of plain values around it; false if nothing is left to remove.
    fn remove(&mut self, mut steps: Vec<Step>) -> bool {
        while let Some(Step::Index(_)) = steps.last() {
            let parent = &steps[..steps.len() - 1];
            if let Some(DeValue::Array(array)) = node(self.root.get_ref(), parent).map(Spanned::get_ref)
                && array.iter().any(|value| value.get_ref().is_table())
            {
                break;
            }
            steps.pop();
        }
        let in_file = self.removed.in_file(&steps);
        let Some((last, parents)) = steps.split_last() else { return false };
        let gone = match (last, container(self.root.get_mut(), parents)) {
            (Step::Key(key), Container::Table(table)) => table.remove(key.as_str()).is_some(),
            (Step::Index(index), Container::Array(array)) if *index < array.len() => {
                *array = std::mem::replace(array, DeArray::new())
                    .into_iter()
                    .enumerate()
                    .filter(|(i, _)| i != index)
                    .map(|(_, v)| v)
                    .collect();
                if let Some((Step::Index(index), array)) = in_file.split_last() {
                    self.removed.elements.push((array.to_vec(), *index));
                }
                true
            }
            _ => false,
        };
        self.removed.paths.push(path::write(&in_file));
        gone
    }

    fn refuse_non_finite(&mut self) {
        let mut found = Vec::new();
        visit(self.root.get_ref(), &mut |steps, value| {
            if let DeValue::Float(number) = value.get_ref()
                && number.as_str().parse::<f64>().is_ok_and(|number| !number.is_finite())
            {
                found.push((steps.to_vec(), value.span(), number.as_str().to_owned()));
            }
        });
        for (steps, span, number) in found {
            self.push(span, (format!("expected a finite number, found {number}"), String::new()));
            self.remove(steps);
        }
    }

    /// Refuses arrays with more values than the type took.
    fn refuse_long_arrays<T: Serialize>(&mut self, value: &T) {
        let Ok(taken) = toml::Value::try_from(value) else { return };
        let mut found = Vec::new();
        visit(self.root.get_ref(), &mut |steps, value| {
            if let DeValue::Array(array) = value.get_ref()
                && let Some(toml::Value::Array(taken)) = value_at(&taken, steps)
                && taken.len() < array.len()
            {
                found.push((value.span(), taken.len(), array.len()));
            }
        });
        for (span, expected, given) in found {
            self.push(span, (format!("expected {expected} values, found {given}"), String::new()));
        }
    }
}

/// A placeholder: a number, or points nested in `depth` arrays.
fn filling(depth: usize) -> Spanned<DeValue<'static>> {
    /// A polygon takes three points, and a pair drops the third.
    const LENGTH: usize = 3;
    let value = match depth.checked_sub(1) {
        None => DeValue::parse("1.0").map_or(DeValue::Boolean(true), Spanned::into_inner),
        Some(depth) => DeValue::Array((0..LENGTH).map(|_| filling(depth)).collect()),
    };
    Spanned::new(NOWHERE, value)
}

fn with_article(noun: &str) -> String {
    let article = if noun.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" };
    format!("{article} {noun}")
}
