//! Tables of the documentation that are made from the source: a page holds blocks `<!-- KIND: ... -->` to `<!-- end of KIND -->`.
//! `MENISCUS_BLESS=1 cargo test --release --test docs` writes them.

use crate::page::{root, text};

/// A page with its blocks of a kind filled; `fill` gets what the opening comment says after the kind.
pub fn filled(page: &str, kind: &str, mut fill: impl FnMut(&str) -> String) -> String {
    let (begin, end) = (format!("<!-- {kind}"), format!("<!-- end of {kind} -->"));
    let mut parts = page.split(&begin);
    let mut all = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (head, body) = part.split_once("-->").unwrap_or_else(|| panic!("a comment has no end:\n{part}"));
        let (_, rest) = body.split_once(&end).unwrap_or_else(|| panic!("a block has no {end}:\n{part}"));
        let table = fill(head.trim_start_matches(':').trim());
        all += &format!("{begin}{head}-->\n\n{table}\n{end}{rest}");
    }
    all
}

/// Compares a page with what it should be, or writes it.
pub fn compare(path: &str, expected: &str) {
    if std::env::var_os("MENISCUS_BLESS").is_some() {
        return std::fs::write(root().join(path), expected).unwrap();
    }
    let page = text(path);
    let stale = page.lines().zip(expected.lines()).find(|(line, expected)| line != expected);
    assert!(page == expected, "{path} is stale, MENISCUS_BLESS=1 cargo test --test docs writes it: {stale:?}");
}

/// A Markdown table.
pub fn table<const N: usize>(head: [&str; N], rows: &[[String; N]]) -> String {
    let line = |cells: &[String; N]| {
        let cells = cells.iter().map(|cell| if cell.is_empty() { " ".to_owned() } else { format!(" {cell} ") });
        format!("|{}|\n", cells.collect::<Vec<_>>().join("|"))
    };
    let rows = rows.iter().map(line).collect::<String>();
    format!("{}|{}\n{rows}", line(&head.map(str::to_owned)), "---|".repeat(N))
}

/// Names as code, separated by commas.
pub fn as_code(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The first sentence of a comment, without links to items and without its period.
pub fn first_sentence(comment: &str) -> String {
    let is_end = |at: &usize| comment[at + 2..].starts_with(|c: char| !c.is_ascii_digit());
    let end = comment.match_indices(". ").map(|(at, _)| at).find(is_end);
    let sentence = end.map_or(comment, |end| &comment[..end]);
    sentence.replace("[`", "`").replace("`]", "`").replace('|', "\\|").trim().trim_end_matches('.').to_owned()
}
