//! Tables of an input file, each key declared once: name, type, allowed values, and description.
//!
//! A table in [`tables!`] generates the type that is read, in which every key is optional, so that one mistake does not hide another; the check of each key
//! alone; and ranges and required keys of the schema. [`checked_tables!`] generates a second type, in which every key is present, and the conversions between
//! them. Rules between keys are functions next to the tables.

use std::collections::BTreeMap;
use std::path::PathBuf;

use schemars::Schema;
use serde_json::{Map, Value as Json, json};

use super::checker::Checker;
use super::range::Range;

/// The allowed values of a key beyond its type.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// A noun phrase with article and unit: `a slip length in m`.
    pub what: &'static str,
    /// Allowed range of a number.
    pub range: Option<Range>,
    /// An example line for a file. A key with one and no default is required.
    pub example: Option<&'static str>,
    /// Its value if the file does not give it.
    pub default: Option<f64>,
    /// A remedy if it is wrong.
    pub help: &'static str,
}

impl Key {
    /// Any value of its type, or none.
    pub const ANY: Self = Self { what: "", range: None, example: None, default: None, help: "" };

    /// Any value of its type, as in `example`.
    pub const fn required(example: &'static str) -> Self {
        Self { example: Some(example), ..Self::ANY }
    }

    /// A number in a range; `what` names it with its unit.
    pub const fn number(what: &'static str, range: Range) -> Self {
        Self { what, range: Some(range), ..Self::ANY }
    }

    /// A number above 0.
    pub const fn positive(what: &'static str) -> Self {
        Self::number(what, Range::Above(0.0))
    }

    /// A number of at least 0.
    pub const fn not_negative(what: &'static str) -> Self {
        Self::number(what, Range::AtLeast(0.0))
    }

    /// A number from one to another, both included.
    pub const fn within(what: &'static str, low: f64, high: f64) -> Self {
        Self::number(what, Range::Within(low, high))
    }

    /// The same key with an example line, so that it is required unless it has a default.
    pub const fn example(self, example: &'static str) -> Self {
        Self { example: Some(example), ..self }
    }

    /// The same key with a default.
    pub const fn default(self, default: f64) -> Self {
        Self { default: Some(default), ..self }
    }

    /// The same key with a remedy.
    pub const fn help(self, help: &'static str) -> Self {
        Self { help, ..self }
    }

    /// What is wrong with a number, if anything is.
    pub(crate) fn misfit(&self, value: f64) -> Option<String> {
        let range = self.range.filter(|range| !range.contains(value))?;
        Some(format!("expected {} {range}, found {value:?}", self.what))
    }

    /// Whether it is required.
    pub fn is_required(&self) -> bool {
        self.example.is_some() && self.default.is_none()
    }

    /// The value of a field in the table at the key path `at`, if it is present and allowed.
    pub fn checked<V: Value>(&self, checker: &mut Checker, at: &str, field: &str, value: Option<V>) -> Option<V> {
        let path = join(at, &name(field));
        let value = match self.example.filter(|_| self.is_required()) {
            Some(example) => checker.require(&path, value, example),
            None => value,
        };
        value?.checked(self, checker, &path)
    }
}

/// The name of a key, from that of its field.
pub fn name(field: &str) -> String {
    field.replace('_', "-")
}

/// The path of a key in the table at `at`, which is empty for the whole file.
pub fn join(at: &str, key: &str) -> String {
    if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") }
}

/// A type that a key can have.
pub trait Value: Sized {
    /// The value if `key` allows it; else a problem at `path`. A table keeps its valid keys.
    fn checked(self, _key: &Key, _checker: &mut Checker, _path: &str) -> Option<Self> {
        Some(self)
    }
}

impl Value for f64 {
    fn checked(self, key: &Key, checker: &mut Checker, path: &str) -> Option<Self> {
        let misfit = key.misfit(self);
        if let Some(message) = &misfit {
            checker.refuse(path, message, key.help);
        }
        misfit.is_none().then_some(self)
    }
}

impl Value for u32 {
    fn checked(self, key: &Key, checker: &mut Checker, path: &str) -> Option<Self> {
        f64::from(self).checked(key, checker, path).map(|_| self)
    }
}

impl<T: Value> Value for Vec<T> {
    fn checked(self, key: &Key, checker: &mut Checker, path: &str) -> Option<Self> {
        let one = |(index, value): (usize, T)| value.checked(key, checker, &format!("{path}[{index}]"));
        Some(self.into_iter().enumerate().filter_map(one).collect())
    }
}

impl Value for bool {}
impl Value for char {}
impl Value for usize {}
impl Value for String {}
impl Value for PathBuf {}
impl Value for toml::Value {}
impl<T> Value for BTreeMap<String, T> {}
impl<T, const N: usize> Value for [T; N] {}

/// A table without keys: its name is sufficient.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Empty {}

impl Value for Empty {}

/// Adds the allowed values and the required keys to the schema of a table.
pub fn describe(schema: &mut Schema, keys: &[(&str, Key)]) {
    if let Some(properties) = schema.get_mut("properties").and_then(Json::as_object_mut) {
        for (field, key) in keys {
            describe_number(properties, &name(field), key);
        }
    }
    let required = keys.iter().filter(|(_, key)| key.is_required()).map(|(field, _)| json!(name(field)));
    let required: Vec<Json> = required.collect();
    if !required.is_empty() {
        schema.insert("required".to_owned(), required.into());
    }
}

fn describe_number(properties: &mut Map<String, Json>, name: &str, key: &Key) {
    let (Some(property), Some(range)) = (properties.get_mut(name), key.range) else { return };
    // For several numbers, the range applies to each.
    let number = if property["items"].is_object() { &mut property["items"] } else { property };
    range.keywords().into_iter().for_each(|(keyword, limit)| number[keyword] = limit);
}

/// Declares tables: `pub field: type`, followed by `=> key` if not every value of its type is allowed or if it is required.
#[macro_export]
macro_rules! tables {
    (@key) => { $crate::input::tables::Key::ANY };
    (@key $key:expr) => { $key };
    ($(
        $(#[$outer:meta])*
        $vis:vis struct $name:ident { $($(#[$inner:meta])* pub $field:ident: $kind:ty $(=> $key:expr)?,)* }
    )*) => {$(
        $(#[$outer])*
        #[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(rename_all = "kebab-case", deny_unknown_fields, default)]
        #[schemars(transform = $name::describe)]
        $vis struct $name {
            $($(#[$inner])*
            #[serde(skip_serializing_if = "Option::is_none")]
            $vis $field: Option<$kind>,)*
        }

        impl $name {
            /// Its fields and their allowed values.
            $vis const KEYS: &'static [(&'static str, $crate::input::tables::Key)] =
                &[$((stringify!($field), $crate::tables!(@key $($key)?)),)*];

            fn describe(schema: &mut schemars::Schema) {
                $crate::input::tables::describe(schema, Self::KEYS);
            }

            /// The table at the key path `at` with those of its keys that have allowed values.
            $vis fn in_range(self, checker: &mut $crate::input::Checker, at: &str) -> Self {
                Self {
                    $($field: $crate::tables!(@key $($key)?)
                        .checked(checker, at, stringify!($field), self.$field),)*
                }
            }
        }

        impl $crate::input::tables::Value for $name {
            fn checked(
                self,
                _: &$crate::input::tables::Key,
                checker: &mut $crate::input::Checker,
                at: &str,
            ) -> Option<Self> {
                Some(self.in_range(checker, at))
            }
        }
    )*};
}
pub use crate::tables;

/// Declares tables of numbers and words like [`tables!`], each with the type in which every key is present, after `for`.
#[macro_export]
macro_rules! checked_tables {
    ($(
        $(#[$outer:meta])*
        $vis:vis struct $name:ident for $checked:ident {
            $($(#[$inner:meta])* pub $field:ident: $kind:ty $(=> $key:expr)?,)*
        }
    )*) => {$(
        $crate::tables! {
            $(#[$outer])*
            $vis struct $name { $($(#[$inner])* pub $field: $kind $(=> $key)?,)* }
        }

        $(#[$outer])*
        #[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
        $vis struct $checked {
            $($(#[$inner])* $vis $field: $kind,)*
        }

        impl $name {
            /// The table with missing keys taken from `default`.
            #[allow(dead_code, reason = "a table needs this or `complete`")]
            $vis fn or(self, default: $checked) -> $checked {
                $checked { $($field: self.$field.unwrap_or(default.$field),)* }
            }

            /// The same in place: the table then has all keys.
            #[allow(dead_code, reason = "a table needs this or `complete`")]
            $vis fn filled(table: &mut Option<Self>, default: $checked) -> $checked {
                let checked = table.take().unwrap_or_default().or(default);
                *table = Some(checked.into());
                checked
            }

            /// The table, if nothing is missing.
            #[allow(dead_code, reason = "a table needs this or `or`")]
            $vis fn complete(self) -> Option<$checked> {
                Some($checked { $($field: self.$field?,)* })
            }
        }

        impl From<$checked> for $name {
            fn from(table: $checked) -> Self {
                Self { $($field: Some(table.$field),)* }
            }
        }
    )*};
}
pub use crate::checked_tables;

/// The words that a key allows.
pub trait Words: Copy + serde::Serialize + 'static {
    /// All of them with their meaning.
    const ALL: &'static [(Self, &'static str)];

    /// The word as written.
    fn word(self) -> String {
        serde_json::to_value(self).ok().and_then(|word| word.as_str().map(str::to_owned)).unwrap_or_default()
    }
}

/// Declares enums whose variants are the words that a key allows, in kebab case or as given by `= "word"`.
#[macro_export]
macro_rules! words {
    ($($(#[$outer:meta])* $vis:vis enum $name:ident { $($(#[doc = $doc:literal])+ $word:ident $(= $written:literal)?,)* })*) => {$(
        $(#[$outer])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(rename_all = "kebab-case")]
        $vis enum $name { $($(#[doc = $doc])+ $(#[serde(rename = $written)])? $word,)* }

        impl $crate::input::tables::Value for $name {}

        impl $crate::input::tables::Words for $name {
            const ALL: &'static [(Self, &'static str)] = &[$((Self::$word, concat!($($doc),+)),)*];
        }
    )*};
}
pub use crate::words;
