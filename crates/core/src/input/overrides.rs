//! `--set KEY=VALUE`: values merged into a file's tree before it is read.

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::error::{InputError, Mistake};
use super::excerpt::{LONGEST_WORD, shortened};
use super::path::{self, Step};
use super::tree::Container;

/// The overrides of a command line, in their order; a later one wins.
#[derive(Debug, Clone, Default)]
pub struct Overrides {
    pub(super) entries: Vec<Override>,
}

/// One `KEY=VALUE`.
#[derive(Debug, Clone)]
pub(super) struct Override {
    /// As given.
    pub(crate) text: String,
    steps: Vec<Step>,
    key_length: usize,
    /// The value as a line of TOML, if it is TOML.
    line: Option<String>,
}

impl Overrides {
    /// Reads `KEY=VALUE` texts. A value that is not TOML is taken as text, so that `sph.sides.left=periodic` needs no quotes.
    ///
    /// # Errors
    /// All texts without a key, with a malformed key, or with a value that begins like a table, array or quoted text but is not a valid one.
    pub fn parse<S: AsRef<str>>(texts: &[S]) -> Result<Self, InputError> {
        let (mut entries, mut mistakes) = (Vec::new(), Vec::new());
        for text in texts {
            match Override::parse(text.as_ref()) {
                Ok(entry) => entries.push(entry),
                Err((message, help)) => {
                    mistakes.push(Mistake::of_file(&format!("--set {}", text.as_ref()), message, help));
                }
            }
        }
        if mistakes.is_empty() { Ok(Self { entries }) } else { Err(InputError { mistakes }) }
    }
}

impl Overrides {
    /// Key path and value of each as given, the last one of a key alone.
    pub fn changes(&self) -> Vec<(String, &str)> {
        let last = |index: usize| !self.entries[index + 1..].iter().any(|one| one.steps == self.entries[index].steps);
        let all = self.entries.iter().enumerate().filter(|(index, _)| last(*index));
        all.map(|(_, one)| (path::write(&one.steps), one.text[one.key_length + 1..].trim())).collect()
    }
}

impl Override {
    fn parse(text: &str) -> Result<Self, (String, &'static str)> {
        let Some((key, value)) = text.split_once('=') else {
            return Err(("expected KEY=VALUE, found no `=`".to_owned(), "as in --set sph.spacing=1e-5"));
        };
        let steps = path::parse(key.trim()).filter(|steps| !steps.is_empty()).ok_or((
            format!("`{}` is not a key path", shortened(key, LONGEST_WORD)),
            "names separated by dots, with array indices in brackets, as in geometry.shapes[0].disc.radius",
        ))?;
        let line = toml_line(value).map_err(|message| (message, "write the value as in the file, in TOML"))?;
        Ok(Self { text: text.to_owned(), steps, key_length: key.len(), line })
    }

    /// Merges the value into the tree; `base` is the first byte of this override's text.
    pub(super) fn put_into<'t>(&'t self, root: &mut Spanned<DeTable<'t>>, base: usize) -> Result<(), (String, String)> {
        let key_span = base..base + self.key_length;
        let value = self.value(base + self.key_length + 1);
        let Some((last, parents)) = self.steps.split_last() else { return Ok(()) };
        let mut here = Container::Table(root.get_mut());
        for (depth, step) in parents.iter().enumerate() {
            let node = match (step, here) {
                (Step::Key(key), Container::Table(table)) => {
                    let empty = || Spanned::new(key_span.clone(), DeValue::Table(DeTable::new()));
                    table.entry(Spanned::new(key_span.clone(), key.clone().into())).or_insert_with(empty)
                }
                (Step::Index(index), Container::Array(array)) => element(array, *index, &parents[..depth])?,
                (step, _) => return Err(wrong_step(&parents[..depth], step)),
            };
            here = Container::of(node.get_mut());
        }
        match (last, here) {
            (Step::Key(key), Container::Table(table)) => {
                // The map would keep the old key and with it the old location.
                table.remove(key.as_str());
                table.insert(Spanned::new(key_span, key.clone().into()), value);
            }
            (Step::Index(index), Container::Array(array)) => *element(array, *index, parents)? = value,
            (step, _) => return Err(wrong_step(parents, step)),
        }
        Ok(())
    }

    /// The value, its bytes counted from `base`.
    fn value(&self, base: usize) -> Spanned<DeValue<'_>> {
        if let Some(line) = &self.line
            && let Ok(table) = DeTable::parse(line)
            && let Some((_, mut value)) = table.into_inner().into_iter().next()
        {
            move_spans(&mut value, &|byte| (byte + base).saturating_sub(BEFORE.len()));
            return value;
        }
        let text = &self.text[self.key_length + 1..];
        Spanned::new(base..base + text.len(), DeValue::String(text.trim().into()))
    }
}

fn wrong_step(steps: &[Step], step: &Step) -> (String, String) {
    let what = match step {
        Step::Key(_) => "a table",
        Step::Index(_) => "an array",
    };
    (format!("`{}` is not {what} in the file", path::write(steps)), "check the key against the file".to_owned())
}

/// The element of the array at the path `steps`.
fn element<'a, 't>(
    array: &'a mut DeArray<'t>,
    index: usize,
    steps: &[Step],
) -> Result<&'a mut Spanned<DeValue<'t>>, (String, String)> {
    let count = array.len();
    let message = || format!("`{}` has {count} elements, there is no [{index}]", path::write(steps));
    array.get_mut(index).ok_or_else(|| (message(), "the first element is [0]".to_owned()))
}

/// Prefix of the value in the line that is parsed.
const BEFORE: &str = "v=";

/// The value as a line of TOML; `None` if it is text without quotes.
fn toml_line(text: &str) -> Result<Option<String>, String> {
    let line = format!("{BEFORE}{text}");
    match DeTable::parse(&line) {
        Ok(table) if table.get_ref().len() == 1 => Ok(Some(line)),
        Ok(_) => Err("expected one value".to_owned()),
        Err(error) if text.trim_start().starts_with(['[', '{', '"', '\'']) => Err(error.message().to_owned()),
        Err(_) if text.trim().is_empty() => Err("expected a value after `=`".to_owned()),
        Err(_) => Ok(None),
    }
}

fn move_spans(node: &mut Spanned<DeValue<'_>>, change: &impl Fn(usize) -> usize) {
    match node.get_mut() {
        DeValue::Table(table) => {
            for (key, mut value) in std::mem::take(table) {
                move_spans(&mut value, change);
                let span = change(key.span().start)..change(key.span().end);
                table.insert(Spanned::new(span, key.into_inner()), value);
            }
        }
        DeValue::Array(array) => array.iter_mut().for_each(|value| move_spans(value, change)),
        _ => {}
    }
    let span = change(node.span().start)..change(node.span().end);
    let value = std::mem::replace(node.get_mut(), DeValue::Boolean(false));
    *node = Spanned::new(span, value);
}

#[cfg(test)]
mod tests {
    use super::super::document::Document;
    use super::*;

    fn set(text: &str, values: &[&str]) -> Result<toml::Table, String> {
        let overrides = Overrides::parse(values).map_err(|error| error.render())?;
        let document = Document::parse("f", text, &overrides).map_err(|error| error.render())?;
        Ok(document.read::<toml::Table>().value)
    }

    #[test]
    fn values_replace_those_of_the_file_and_missing_tables_are_made() {
        let values = ["a=2", "b.c.d=periodic", "e[1].f=[1.5, 2.5]", "g={ h = 1 }", "b.c.i=\"x y\"", "a=3"];
        let table = set("a = 1\n[[e]]\n[[e]]\n", &values).unwrap();
        let wanted: toml::Table =
            "a = 3\nb.c = { d = 'periodic', i = 'x y' }\ng.h = 1\ne = [{}, { f = [1.5, 2.5] }]".parse().unwrap();
        assert_eq!(table, wanted);
    }

    #[test]
    fn what_cannot_be_set_is_refused_at_its_own_place() {
        for (value, message) in [
            ("a", "expected KEY=VALUE, found no `=`"),
            ("=1", "`` is not a key path"),
            ("a..b=1", "`a..b` is not a key path"),
            ("a=", "expected a value after `=`"),
            ("a=[1", "unclosed array"),
            ("a.b=1", "`a` is not a table in the file"),
            ("e[2].f=1", "`e` has 1 elements, there is no [2]"),
            ("e[0][1]=1", "`e[0]` is not an array in the file"),
        ] {
            let text = set("a = 1\n[[e]]\n", &[value]).unwrap_err();
            assert!(text.starts_with(&format!("--set {value}")) && text.contains(message), "{text}");
        }
    }

    #[test]
    fn a_very_deep_key_is_refused_and_does_not_exhaust_the_stack() {
        let key = format!("{}x=1", "a.".repeat(100_000));
        assert!(set("", &[&key]).unwrap_err().contains("is not a key path"));
    }
}
