//! Tables of measures, of columns and of keys of the report come from the comments above their names in the source.
//!
//! A block `<!-- names: FILE ITEM ... -->` lists the names in a `const`, a function, a structure or a group of measures of FILE: the
//! first string of each line, with the comment directly above it. Names without a comment share the row above.

use crate::generated::{as_code, compare, filled, table};
use crate::page::text;

/// Names with their meaning, and the group that they belong to.
struct Row {
    names: Vec<String>,
    group: String,
    meaning: String,
}

/// The name that a line of an item holds.
fn name_in(line: &str) -> Option<String> {
    let of_field = line.strip_prefix("pub ").filter(|rest| !rest.starts_with("const "));
    if let Some((field, _)) = of_field.and_then(|rest| rest.split_once(':')) {
        return (!line.ends_with('[') && !line.contains('[')).then(|| field.replace('_', "-"));
    }
    let literal = line.split('"').nth(1).filter(|_| !line.starts_with("Table {") && !line.starts_with("name:"))?;
    let is_name = !literal.is_empty() && literal.chars().all(|c| c.is_ascii_alphanumeric() || "_-".contains(c));
    is_name.then(|| literal.to_owned())
}

/// The lines of an item and of the comment above it: a `const`, `fn`, `struct`, a group of measures, or a call of a macro.
fn lines_of<'s>(source: &'s str, item: &str) -> Vec<&'s str> {
    let lines: Vec<&str> = source.lines().collect();
    let begins = |line: &str| {
        let line = line.trim_start();
        let line =
            ["pub(crate) ", "pub(super) ", "pub "].iter().find_map(|word| line.strip_prefix(word)).unwrap_or(line);
        let declarations = [format!("const {item}:"), format!("fn {item}("), format!("struct {item} {{")];
        declarations.iter().any(|begin| line.starts_with(begin))
            || line.starts_with(&format!("{item}: ["))
            || line == format!("{item} {{")
    };
    let first = lines.iter().position(|line| begins(line)).unwrap_or_else(|| panic!("there is no {item}"));
    let line = lines[first];
    if line.ends_with(';') || line.ends_with("],") {
        let comment =
            lines[..first].iter().rposition(|line| !line.trim_start().starts_with("//")).map_or(0, |at| at + 1);
        return lines[comment..=first].to_vec();
    }
    let indentation = line.len() - line.trim_start().len();
    let closes = |line: &str| {
        let (before, rest) = line.split_at_checked(indentation).unwrap_or((line, ""));
        before.trim().is_empty() && rest.starts_with(['}', ']'])
    };
    let length = lines[first + 1..].iter().position(|line| closes(line)).unwrap_or_else(|| panic!("{item} has no end"));
    lines[first + 1..=first + length].to_vec()
}

/// The rows of an item.
fn rows(source: &str, item: &str) -> Vec<Row> {
    let (mut rows, mut group) = (Vec::<Row>::new(), item.to_owned());
    let (mut comment, mut is_open, mut is_whole) = (String::new(), false, false);
    for line in lines_of(source, item).into_iter().map(str::trim) {
        if let Some(text) = line.strip_prefix("//") {
            let text = text.trim_start_matches('/').trim();
            if !is_open {
                (comment, is_open, is_whole) = (String::new(), true, false);
            }
            is_whole |= text.is_empty();
            if !is_whole {
                comment += &format!("{}{text}", if comment.is_empty() { "" } else { " " });
            }
            continue;
        }
        is_open = false;
        if let Some((name, _)) = line.strip_prefix("pub ").and_then(|rest| rest.split_once(": [")) {
            group = name.to_owned();
            comment.clear();
        }
        let Some(name) = name_in(line) else { continue };
        let meaning = std::mem::take(&mut comment);
        match rows.last_mut().filter(|_| meaning.is_empty()) {
            Some(row) => row.names.push(name),
            None if meaning.is_empty() => panic!("{name} of {item} has no comment above it that says its meaning"),
            None => rows.push(Row {
                names: vec![name],
                group: group.replace('_', "-"),
                meaning: meaning.trim_end_matches('.').to_owned(),
            }),
        }
    }
    assert!(!rows.is_empty(), "{item} has no names");
    rows
}

/// The table of a block.
fn table_of(block: &str, first: &str, others: &[String]) -> String {
    let mut words = block.split_whitespace().filter(|word| *word != "struct");
    let source = text(words.next().unwrap_or_default());
    let items: Vec<&str> = words.collect();
    let all = || items.iter().flat_map(|item| rows(&source, item));
    if items != ["groups!"] {
        let rows: Vec<_> = all().map(|row| [as_code(&row.names), row.meaning]).collect();
        return table([first, "meaning"], &rows);
    }
    let has_block =
        |row: &Row| others.iter().any(|block| block.split_whitespace().any(|item| item.replace('_', "-") == row.group));
    let rows = all().filter(|row| !has_block(row)).map(|row| [as_code(&row.names), as_code(&[row.group]), row.meaning]);
    table([first, "group", "meaning"], &rows.collect::<Vec<_>>())
}

#[test]
fn the_tables_of_names_are_those_of_the_source() {
    for (path, first) in [("docs/reference/measures.md", "measure"), ("docs/reference/output.md", "column")] {
        let page = text(path);
        let mut blocks = Vec::new();
        filled(&page, "names", |block| {
            blocks.push(block.to_owned());
            String::new()
        });
        let of = |block: &str| table_of(block, if block.contains(" struct ") { "key" } else { first }, &blocks);
        compare(path, &filled(&page, "names", of));
    }
}
