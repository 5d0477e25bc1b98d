//! The tables of keys in the reference come from the JSON schemas, and so from the comments on the types of `crates/case/src`,
//! `crates/wetting/src` and `src/study`.
//!
//! A page holds blocks `<!-- keys: PATH -->` to `<!-- end of keys -->` with the keys of the table at PATH, those of tables within it
//! included, unless they have a block of their own. The first block, of the whole file, has no path: every key is on the page.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

use crate::generated::{self, compare, filled};
use crate::page::{files, root, text};

/// A schema with its reference followed, and the name of the type that it refers to.
pub fn followed<'s>(schema: &'s Value, whole: &'s Value) -> (Option<&'s str>, &'s Value) {
    let one = schema["anyOf"].as_array().and_then(|any| any.iter().find(|one| one["type"] != "null"));
    let inner = one.unwrap_or(schema);
    let name = inner["$ref"].as_str().and_then(|reference| reference.strip_prefix("#/$defs/"));
    (name, name.map_or(inner, |name| &whole["$defs"][name]))
}

/// A page with tables of keys.
struct Keys<'s> {
    schema: &'s Value,
    /// The source of the types, which has the order of the keys.
    source: String,
    /// The source of the options of drawings.
    options: String,
    /// Paths of the blocks of the page.
    blocks: BTreeSet<String>,
    /// Where each table, or long list of words, is described first, by the name of its type.
    described: BTreeMap<String, String>,
}

impl Keys<'_> {
    /// The name of the type that a value or the items of an array have, and its schema.
    fn followed<'v>(&'v self, value: &'v Value) -> (Option<&'v str>, &'v Value) {
        match followed(value, self.schema) {
            (None, inner) if inner["items"].is_object() => self.followed(&inner["items"]),
            found => found,
        }
    }

    /// The keys of a table in the order of their declaration.
    fn keys<'v>(&self, name: &str, table: &'v Value) -> Vec<(&'v str, &'v Value)> {
        let declaration = self.source.split_once(&format!("struct {name} ")).map_or("", |(_, rest)| rest);
        // Options of drawings follow the other keys, and the names of groups of measures follow their table.
        let own = declaration.split("}\n").next().unwrap_or_default();
        let declaration = [own, &self.options, declaration].concat();
        let place = |key: &str| {
            let field = if key == "where" { "only".to_owned() } else { key.replace('-', "_") };
            let written = [format!("pub {field}:"), format!("\n            {field}: ")];
            let first = written.iter().filter_map(|field| declaration.find(field)).min();
            first.unwrap_or_else(|| panic!("{name} has no field for {key}"))
        };
        let keys = table["properties"].as_object().into_iter().flatten();
        let mut keys: Vec<_> = keys.map(|(key, value)| (key.as_str(), value)).collect();
        keys.sort_by_key(|(key, _)| place(key));
        keys
    }

    /// The rows of the keys of a table. Keys in a row that differ in their names only share a row.
    fn rows(&mut self, (name, table): (&str, &Value), at: &str) -> Vec<[String; 4]> {
        self.described.insert(name.to_owned(), at.to_owned());
        let required = table["required"].as_array().cloned().unwrap_or_default();
        let mut rows = Vec::new();
        let keys = self.keys(name, table);
        for group in keys.chunk_by(|(_, a), (_, b)| a == b && a["description"].is_string()) {
            let (key, value) = group[0];
            let path = if at.is_empty() { key.to_owned() } else { format!("{at}.{key}") };
            if self.blocks.contains(&path) {
                continue;
            }
            let names = group[1..].iter().map(|(key, _)| format!(", `{key}`")).collect::<String>();
            let (default, meaning) = told(value);
            let default = default.unwrap_or(if required.contains(&key.into()) { "required" } else { "" }.to_owned());
            let (kind, inner) = self.followed(value);
            let before = kind.and_then(|kind| self.described.get(kind));
            let range = before.map_or_else(|| self.range(value), |before| format!("as `{before}`"));
            rows.push([format!("`{path}`{names}"), range, default, meaning]);
            let Some(kind) = kind.filter(|_| before.is_none()) else { continue };
            let (kind, inner) = (kind.to_owned(), inner.clone());
            if inner["properties"].as_object().is_some_and(|keys| !keys.is_empty()) {
                rows.extend(self.rows((&kind, &inner), &path));
            } else if inner["oneOf"].as_array().is_some_and(|words| words.len() > 4) && kind != "ShapeSpec" {
                self.described.insert(kind, path);
            }
        }
        rows
    }

    /// The values that a key can have.
    fn range(&self, value: &Value) -> String {
        let (kind, inner) = self.followed(value);
        match kind {
            Some("Preset") => return "a [preset](presets.md)".to_owned(),
            Some("ShapeSpec") => return "array of [shapes](shape-files.md#shapes)".to_owned(),
            Some(_) if inner["oneOf"].as_array().is_some_and(|all| all[0]["const"].is_string()) => {
                let words = inner["oneOf"].as_array().into_iter().flatten().filter_map(|one| one["const"].as_str());
                return words.map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ");
            }
            Some(_) if value["type"] == "array" || value["type"][0] == "array" => return "array of tables".to_owned(),
            Some("Empty") => return "empty table".to_owned(),
            Some(_) => return "table".to_owned(),
            None => {}
        }
        let short =
            |number: f64| if (1e-3..1e6).contains(&number) { format!("{number}") } else { format!("{number:e}") };
        let number = |key: &str| {
            value[key].as_f64().map(|number| if number <= 0.0 { format!("{number}") } else { short(number) })
        };
        let limits = ["minimum", "exclusiveMinimum", "maximum", "exclusiveMaximum"].map(number);
        let kind = value["type"].as_str().or(value["type"][0].as_str()).unwrap_or("any");
        match (kind, limits) {
            ("number" | "integer", [Some(low), None, Some(high), None]) => format!("{low} to {high}"),
            ("number", [Some(low), None, None, None]) => format!("at least {low}"),
            ("number", [None, Some(low), None, None]) => format!("above {low}"),
            ("number", [None, Some(low), None, Some(high)]) => format!("above {low}, below {high}"),
            ("integer", _) => "whole number".to_owned(),
            ("boolean", _) => "boolean".to_owned(),
            ("string", _) => if value["maxLength"] == 1 { "character" } else { "text" }.to_owned(),
            ("array", _) => match (value["maxItems"].as_u64(), &value["items"]["type"]) {
                (Some(count), inner) if inner == "array" => format!("{count} points"),
                (Some(count), _) => format!("{count} numbers"),
                (None, inner) if inner == "string" => "array of text".to_owned(),
                (None, _) => "array".to_owned(),
            },
            ("object", _) => "table".to_owned(),
            ("any", _) => "number or text".to_owned(),
            (kind, _) => kind.to_owned(),
        }
    }

    /// The table at a path.
    fn at(&self, path: &str) -> (String, Value) {
        let whole = (self.schema["title"].as_str().unwrap_or_default().to_owned(), self.schema.clone());
        path.split('.').filter(|step| !step.is_empty()).fold(whole, |(_, table), step| {
            let (name, inner) = self.followed(&table["properties"][step]);
            (name.unwrap_or_else(|| panic!("there is no table {path}")).to_owned(), inner.clone())
        })
    }
}

/// The default and the meaning of a key: its comment ends with the default in parentheses, if it has one.
fn told(value: &Value) -> (Option<String>, String) {
    let comment = value["description"].as_str().unwrap_or_default().replace('\n', " ");
    let comment = comment.trim_end_matches('.');
    let place = [" (default", " (required"].iter().find_map(|begin| comment.rfind(begin));
    let Some((meaning, default)) = place.map(|place| comment.split_at(place)) else {
        return (None, comment.to_owned());
    };
    let default = default.trim_start_matches(" (").strip_suffix(')').unwrap_or_else(|| panic!("{comment}"));
    let default = default.strip_prefix("default").map_or(default, |rest| rest.trim_start_matches([':', ' ']));
    (Some(default.to_owned()), meaning.trim_end_matches('.').to_owned())
}

/// A table of keys; of empty tables, which a page of their own describes, the names alone.
fn table(rows: &[[String; 4]]) -> String {
    if rows.iter().all(|[_, value, ..]| value == "empty table") {
        return rows.iter().map(|[key, ..]| key.as_str()).collect::<Vec<_>>().join(", ") + ".\n";
    }
    generated::table(["key", "value", "default", "meaning"], rows)
}

/// A page with its tables as the schema has them.
fn written(page: &str, schema: &Value, folders: &[&str]) -> String {
    let files = folders.iter().flat_map(|folder| files(&root().join(folder), &["rs"]));
    let source = files.map(|file| std::fs::read_to_string(file).unwrap());
    let path = |rest: &str| rest.split("-->").next().unwrap_or_default().trim().to_owned();
    let blocks: BTreeSet<String> = page.split("<!-- keys:").skip(1).map(path).collect();
    assert!(blocks.contains(""), "the page has no block for the whole file");
    let options = text("crates/drawings/src/import/options.rs");
    let mut keys = Keys { schema, source: source.collect(), options, blocks, described: BTreeMap::new() };
    filled(page, "keys", |path| {
        let (name, table) = keys.at(path);
        self::table(&keys.rows((&name, &table), path))
    })
}

#[test]
fn the_tables_of_keys_are_those_of_the_schemas() {
    let pages = [
        ("docs/reference/case-file.md", meniscus_case::schema(), &["crates/case/src", "crates/wetting/src"][..]),
        ("docs/reference/study-file.md", meniscus::study::schema(), &["src/study"]),
    ];
    for (path, schema, folders) in pages {
        compare(path, &written(&text(path), &schema, folders));
    }
}
