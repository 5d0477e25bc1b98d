//! A TOML file as text and tree, with the `--set` values of the command line merged in.
//!
//! Every node has its byte range. Those of `--set` values lie after the end of the file's text, so that one number tells whether a node came from the file or
//! from the command line.

use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{InputError, Mistake};
use super::overrides::{Override, Overrides};

/// Largest number of syntax errors reported.
const MOST_MISTAKES: usize = 50;

/// A parsed file.
#[derive(Debug, Clone)]
pub struct Document {
    /// The name of the file in messages.
    pub(super) name: String,
    text: Arc<str>,
    overrides: Overrides,
    renamed: &'static [Renamed],
}

/// A key of the previous version that is still read.
#[derive(Debug)]
pub struct Renamed {
    /// The table that contains it, from the root.
    pub table: &'static [&'static str],
    /// Its previous name.
    pub before: &'static str,
    /// Its present name.
    pub now: &'static str,
}

impl Document {
    /// Parses `text`; `name` is the name of the file in messages.
    ///
    /// # Errors
    /// All syntax errors of the text, and the overrides that cannot be merged in.
    pub fn parse(name: &str, text: &str, overrides: &Overrides) -> Result<Self, InputError> {
        let document =
            Self { name: name.to_owned(), text: Arc::from(text), overrides: overrides.clone(), renamed: &[] };
        let (_, mistakes) = document.parse_tree();
        if mistakes.is_empty() { Ok(document) } else { Err(InputError { mistakes }) }
    }

    /// The tree, with the overrides merged in.
    pub(super) fn tree(&self) -> Spanned<DeTable<'_>> {
        let mut root = self.parse_tree().0;
        self.renamed.iter().for_each(|renamed| {
            renamed.apply(root.get_mut());
        });
        root
    }

    /// The same document with keys of the previous version, read under their present names.
    pub fn with_renamed(self, renamed: &'static [Renamed]) -> Self {
        Self { renamed, ..self }
    }

    /// A sentence for each key that has its previous name.
    pub fn notes_on_renamed(&self) -> Vec<String> {
        let mut root = self.parse_tree().0;
        let is_old = |renamed: &&Renamed| renamed.apply(root.get_mut());
        self.renamed.iter().filter(is_old).map(Renamed::note).collect()
    }

    fn parse_tree(&self) -> (Spanned<DeTable<'_>>, Vec<Mistake>) {
        let (mut root, errors) = DeTable::parse_recoverable(&self.text);
        let mut mistakes = self.syntax_mistakes(&errors);
        if !mistakes.is_empty() {
            return (root, mistakes);
        }
        for (base, entry) in self.bases() {
            if let Err(problem) = entry.put_into(&mut root, base) {
                mistakes.push(self.mistake(base..base + entry.text.len(), problem));
            }
        }
        (root, mistakes)
    }

    /// The first mistake of each line, up to an open bracket: whatever follows one is a consequence of it.
    fn syntax_mistakes(&self, errors: &[toml::de::Error]) -> Vec<Mistake> {
        let mut mistakes: Vec<Mistake> = Vec::new();
        let mut last: Option<usize> = None;
        for error in errors {
            let message = error.message();
            let start = error.span().unwrap_or_default().start;
            // A line can have a hundred thousand mistakes: only the text between one and the next is inspected.
            let is_same_line = |last: usize| {
                let between = self.text.as_bytes().get(last.min(start)..last.max(start));
                between.is_some_and(|between| !between.contains(&b'\n'))
            };
            let in_brackets =
                ["array", "inline table", "key-value pairs", "unclosed"].iter().any(|word| message.contains(word));
            let help = match message {
                _ if in_brackets => "is a bracket left open here or above?",
                _ if message.contains("must be quoted") => {
                    "texts need quotes; numbers have no unit and a decimal point"
                }
                _ => "",
            };
            if !last.is_some_and(is_same_line) {
                let span = error.span().unwrap_or_default();
                mistakes.push(self.mistake(span, (message.to_owned(), help.to_owned())));
            }
            last = Some(start);
            if in_brackets || mistakes.len() >= MOST_MISTAKES {
                break;
            }
        }
        mistakes
    }

    /// The overrides, each with its first byte after the file's text.
    fn bases(&self) -> impl Iterator<Item = (usize, &Override)> {
        self.overrides.entries.iter().scan(self.text.len() + 1, |next, entry| {
            let base = *next;
            *next += entry.text.len() + 1;
            Some((base, entry))
        })
    }

    /// A mistake at a byte range of the file or of an override.
    pub(super) fn mistake(&self, range: Range<usize>, problem: (String, String)) -> Mistake {
        match self.bases().filter(|(base, _)| *base <= range.start).last() {
            Some((base, entry)) => {
                let range = range.start - base..range.end.saturating_sub(base);
                Mistake::in_text(&format!("--set {}", entry.text), &Arc::from(entry.text.as_str()), range, problem)
            }
            None => Mistake::in_text(&self.name, &self.text, range, problem),
        }
    }
}

impl Renamed {
    /// Renames the key to its present name, if it has its previous one and no other key has the present one.
    fn apply(&self, root: &mut DeTable) -> bool {
        let mut table = root;
        for key in self.table {
            let Some(DeValue::Table(inner)) = table.get_mut(*key).map(Spanned::get_mut) else { return false };
            table = inner;
        }
        let span = table.get_key_value(self.before).map(|(key, _)| key.span());
        let Some(span) = span.filter(|_| !table.contains_key(self.now)) else { return false };
        let Some(value) = table.remove(self.before) else { return false };
        table.insert(Spanned::new(span, self.now.into()), value);
        true
    }

    fn note(&self) -> String {
        let table = self.table.join(".");
        format!(
            "`{table}.{}` is now called `{table}.{}`; the next version will not accept the old name",
            self.before, self.now
        )
    }
}

#[cfg(test)]
mod tests {
    use super::super::{path, tree::span_at};
    use super::*;

    fn place_of(text: &str, path: &str) -> String {
        let document = Document::parse("f", text, &Overrides::default()).unwrap();
        text[span_at(document.tree().get_ref(), &path::parse(path).unwrap())].to_owned()
    }

    #[test]
    fn a_value_is_found_by_its_path_in_every_way_of_writing_it() {
        let text = "[a.b]\nc = 1\n[[d]]\ne = {f = 2.0}\n[[d]]\ng.h.i = [3, 4]\n";
        assert_eq!(place_of(text, "a.b.c"), "1");
        assert_eq!(place_of(text, "d[0].e.f"), "2.0");
        assert_eq!(place_of(text, "d[1].g.h.i[1]"), "4");
    }

    #[test]
    fn an_absent_key_has_the_place_of_the_table_around_it() {
        let text = "x = 1\n[a.b]\nc = 1\n[[d]]\ne = {f = 2.0}\n[[d]]\n";
        assert_eq!(place_of(text, "a.b.zzz"), "[a.b]");
        assert_eq!(place_of(text, "d[0].e.zzz"), "{f = 2.0}");
        assert_eq!(place_of(text, "d[1].zzz"), "[[d]]");
        assert_eq!(place_of(text, "zzz"), "");
    }

    const RENAMED: [Renamed; 1] = [Renamed { table: &["a", "b"], before: "old", now: "new" }];

    #[test]
    fn a_key_of_the_version_before_is_read_under_its_present_name_and_told() {
        let parsed = |text| Document::parse("f", text, &Overrides::default()).unwrap().with_renamed(&RENAMED);
        let text = "[a.b]\nold = 1\n";
        let document = parsed(text);
        assert_eq!(&text[span_at(document.tree().get_ref(), &path::parse("a.b.new").unwrap())], "1");
        let notes = document.notes_on_renamed();
        assert!(notes.len() == 1 && notes[0].contains("`a.b.old` is now called `a.b.new`"), "{notes:?}");
        // With both names present, the old one is a mistake, like any unknown key.
        for text in ["[a.b]\nnew = 1\n", "[a.b]\nold = 1\nnew = 2\n", "[a]\nb = 1\n", ""] {
            assert_eq!(parsed(text).notes_on_renamed(), Vec::<String>::new(), "{text}");
        }
    }
}
