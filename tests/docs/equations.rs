//! The table of equations comes from the citations in the source, such as `[Huber2013, Eq. 7]`: a function or type whose comment cites a
//! paper of `references.bib` has a row, in which the tests that cite the same equation are named.

use std::path::Path;

use crate::generated::{as_code, compare, filled, first_sentence, table};
use crate::page::{files, root, text};

/// A paper, and the equations or sections cited.
#[derive(PartialEq)]
struct Citation {
    key: String,
    passage: String,
}

impl Citation {
    /// The citations in brackets of a comment, and the comment without them.
    fn all(comment: &str, bibliography: &str) -> (Vec<Self>, String) {
        let mut parts = comment.split('[');
        let (mut found, mut rest) = (Vec::new(), parts.next().unwrap_or_default().to_owned());
        let is_known = |inside: &str| {
            let key = inside.split([',', ';']).next().unwrap_or_default();
            bibliography.contains(&format!("{{{key},"))
        };
        for part in parts {
            let Some((inside, after)) = part.split_once(']').filter(|(inside, _)| is_known(inside)) else {
                rest += &format!("[{part}");
                continue;
            };
            found.extend(inside.split(';').map(|text| {
                let (key, passage) = text.split_once(',').unwrap_or((text, ""));
                Self { key: key.trim().to_owned(), passage: passage.trim().to_owned() }
            }));
            rest = rest.trim_end().to_owned() + after;
        }
        (found, rest)
    }

    /// The numbers of the equations, those within a range included.
    fn numbers(&self) -> Vec<String> {
        let mut numbers = Vec::new();
        for word in self.passage.split([' ', ',']).filter(|word| word.starts_with(|c: char| c.is_ascii_digit())) {
            match word.split_once('-').map(|(first, last)| (first.parse::<usize>(), last.parse::<usize>())) {
                Some((Ok(first), Ok(last))) => numbers.extend((first..=last).map(|number| number.to_string())),
                _ => numbers.push(word.to_owned()),
            }
        }
        numbers
    }

    /// Whether both cite an equation in common, or the same passage or paper.
    fn meets(&self, other: &Self) -> bool {
        let numbers = self.numbers();
        self == other || (self.key == other.key && other.numbers().iter().any(|number| numbers.contains(number)))
    }

    /// Huber et al. 2013 first, then in the order of the papers and numbers.
    fn order(&self) -> (bool, String, u64) {
        let first = self.numbers().first().and_then(|number| number.parse::<f64>().ok()).unwrap_or(f64::from(u16::MAX));
        (self.key != "Huber2013", self.key.clone(), (first * 1e3) as u64)
    }
}

/// A function, type or test whose comment cites a paper.
struct Item {
    file: String,
    name: String,
    what: String,
    citations: Vec<Citation>,
    is_test: bool,
}

/// The type of a block of methods.
fn type_of_methods(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("impl")?;
    let rest = rest.strip_prefix('<').and_then(|rest| rest.split_once("> ")).map_or(rest, |(_, rest)| rest);
    let name = rest.split(" for ").last()?.trim_start();
    name.split(|c: char| !c.is_alphanumeric() && c != '_').next()
}

/// The name that a line declares; of a block of methods that of the type.
fn declared(line: &str) -> Option<&str> {
    let line = ["pub(crate) ", "pub(super) ", "pub "].iter().find_map(|word| line.strip_prefix(word)).unwrap_or(line);
    let line = line.strip_prefix("const fn").map_or(line, |_| &line["const ".len()..]);
    let kinds = ["fn ", "struct ", "enum ", "trait ", "type ", "const "];
    match kinds.iter().find_map(|kind| line.strip_prefix(kind)) {
        Some(rest) => rest.split(|c: char| !c.is_alphanumeric() && c != '_').next(),
        None => type_of_methods(line),
    }
}

/// The items of a file that cite a paper.
fn items(path: &Path, bibliography: &str) -> Vec<Item> {
    let source = std::fs::read_to_string(path).unwrap();
    let file = path.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
    let (mut found, mut comment, mut is_test, mut methods_of) = (Vec::new(), String::new(), false, None);
    for (line, indented) in source.lines().map(|indented| (indented.trim(), indented)) {
        if indented == "}" {
            methods_of = None;
        }
        if let Some(text) = line.strip_prefix("///") {
            comment += &format!("{}{}", if comment.is_empty() { "" } else { " " }, text.trim());
        } else if line.starts_with("#[") {
            is_test |= line == "#[test]";
        } else {
            let (citations, rest) = Citation::all(&comment.replace("\\[", "[").replace("\\]", "]"), bibliography);
            methods_of = type_of_methods(indented).or(methods_of);
            if let (false, Some(name)) = (citations.is_empty(), declared(line)) {
                let of_type = methods_of.filter(|_| line != indented).map(|of| format!("{of}::"));
                let name = of_type.unwrap_or_default() + name;
                let what = first_sentence(&rest);
                found.push(Item { file: file.clone(), name, what, citations, is_test });
            }
            (comment, is_test) = (String::new(), false);
        }
    }
    found
}

/// The table of all citations.
fn equations() -> String {
    let bibliography = text("references.bib");
    let sources = ["src", "crates", "tests"].into_iter().flat_map(|folder| files(&root().join(folder), &["rs"]));
    let all = sources.flat_map(|path| items(&path, &bibliography)).collect::<Vec<_>>();
    let (tests, mut items): (Vec<Item>, Vec<Item>) = all.into_iter().partition(|item| item.is_test);
    items.sort_by_key(|item| item.citations[0].order());
    let meet =
        |item: &Item, test: &Item| item.citations.iter().any(|one| test.citations.iter().any(|other| one.meets(other)));
    for test in &tests {
        assert!(items.iter().any(|item| meet(item, test)), "{} cites what no function cites", test.name);
    }
    let row = |item: &Item| {
        let source = item
            .citations
            .iter()
            .map(|one| if one.passage.is_empty() { one.key.clone() } else { format!("{}, {}", one.key, one.passage) });
        let tests: Vec<String> = tests.iter().filter(|test| meet(item, test)).map(|test| test.name.clone()).collect();
        let tests = if tests.is_empty() { "-".to_owned() } else { as_code(&tests) };
        [source.collect::<Vec<_>>().join("; "), format!("`{}` in `{}`", item.name, item.file), item.what.clone(), tests]
    };
    table(["source", "function", "what", "tests"], &items.iter().map(row).collect::<Vec<_>>())
}

#[test]
fn the_table_of_equations_is_that_of_the_citations() {
    let path = "docs/equations.md";
    compare(path, &filled(&text(path), "equations", |_| equations()));
}
