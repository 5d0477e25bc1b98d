//! Translates serde's error messages into the terms of the user's file, with a remedy.

use super::excerpt::{LONGEST_WORD, shortened};
use super::suggest::nearest;

/// A translated serde message.
#[derive(Debug, Default)]
pub(super) struct Explained {
    /// What was expected and what was found.
    pub(crate) message: String,
    /// A remedy.
    pub(crate) help: String,
    /// The known key that was probably meant.
    pub(crate) meant: Option<String>,
    /// The missing key, if the message is about one.
    pub(crate) missing: Option<String>,
    /// Whether the message is about a table without its only key.
    pub(crate) empty_choice: bool,
    /// Whether a name was expected, alone or as the key of a table.
    pub(crate) wants_name: bool,
}

/// Explains a serde or TOML message.
pub(super) fn explain(serde: &str) -> Explained {
    let names = quoted(serde);
    let mut explained = Explained::default();
    if serde.starts_with("unknown field") || serde.starts_with("unknown variant") {
        let (word, known) = names.split_first().map_or(("", &[][..]), |(word, known)| (*word, known));
        let kind = if serde.starts_with("unknown field") { "key" } else { "name" };
        explained.message = format!("unknown {kind} `{}`", shortened(word, LONGEST_WORD));
        explained.meant = nearest(word, known.iter().copied()).map(str::to_owned);
        explained.help = known_help(explained.meant.as_deref(), known, kind);
    } else if serde.starts_with("missing field") {
        explained.missing = names.first().map(|name| (*name).to_owned());
        explained.message = format!("missing key `{}`", names.first().unwrap_or(&""));
        explained.help = "add it to this table".to_owned();
    } else if serde.starts_with("wanted exactly 1 element") {
        explained.empty_choice = serde.contains("0 elements");
        let found = if explained.empty_choice { "none" } else { "several" };
        explained.message = format!("expected a table with exactly one key, found {found}");
        explained.help =
            "the key is the name of the choice, as in `{ disc = { center = [0.0, 0.0], radius = 1.0e-3 } }`; \
                          write one table per shape"
                .to_owned();
    } else if serde.contains("unit variant, expected newtype variant") {
        explained.message = "expected a table, found only a name".to_owned();
        explained.help =
            "a name is followed by its values, as in `{ disc = { center = [0.0, 0.0], radius = 1.0e-3 } }`".to_owned();
    } else if serde == "wanted string or table" {
        explained.wants_name = true;
    } else if let Some((found, expected)) = mismatch(serde) {
        explained.message = format!("expected {}, found {}", expected_words(expected), shortened(&found, LONGEST_WORD));
    } else if serde.contains("overflowed") {
        explained.message = "the number is too large".to_owned();
    } else {
        explained.message = lower_first(serde);
    }
    explained
}

/// `did you mean ..? known keys: ..`.
pub(super) fn known_help(meant: Option<&str>, known: &[&str], kind: &str) -> String {
    let list = known.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
    let list = if list.is_empty() { format!("no {kind}s are known here") } else { format!("known {kind}s: {list}") };
    meant.map_or(list.clone(), |meant| format!("did you mean `{meant}`? {list}"))
}

/// Found and expected of `invalid type: string "a", expected f64` and its like.
fn mismatch(serde: &str) -> Option<(String, &str)> {
    let rest = ["invalid type: ", "invalid value: ", "invalid length "].iter().find_map(|p| serde.strip_prefix(p))?;
    let (found, expected) = rest.rsplit_once(", expected ")?;
    let found = match found.split_once(' ') {
        None if serde.starts_with("invalid length") => match found {
            "1" => "1 value".to_owned(),
            count => format!("{count} values"),
        },
        None if found == "map" => "a table".to_owned(),
        None if found == "sequence" => "an array".to_owned(),
        Some(("floating", number)) => number.replace("point ", "the number ").replace('`', ""),
        Some(("integer", number)) => format!("the number {}", number.replace('`', "")),
        Some((kind, value)) => format!("the {kind} {value}").replace('`', ""),
        None => found.to_owned(),
    };
    Some((found, expected))
}

fn expected_words(expected: &str) -> String {
    match expected {
        "f64" => "a number".to_owned(),
        "a sequence" => "an array".to_owned(),
        "u32" | "u64" | "i64" | "usize" => "a whole number".to_owned(),
        "path string" | "a string" => "a text in quotes".to_owned(),
        "an array of length 2" | "array of length 2" => "two values".to_owned(),
        other if other.starts_with("struct ") || other == "a map" => "a table".to_owned(),
        other => other.to_owned(),
    }
}

/// The words between backquotes.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}
