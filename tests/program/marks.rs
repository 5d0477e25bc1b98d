//! What ties the numbers of a page to its commands: blocks of output, and marks behind numbers.
//!
//! | on the page | meaning |
//! |---|---|
//! | `<!-- output: 1e-5 -->` above a block `text` | each line was printed by a command of the block `sh` before; numbers agree within this share, `...` stands for any words |
//! | `0.27<!-- chip: relative-permeability-non-wetting -->` | this measure of `out/chip`, rounded as on the page |
//! | `1.5<!-- chip: width-m × 1e3 -->` | the measure times a factor |
//! | `0.34<!-- angles/table.csv: residual-saturation process=drainage angle=40 -->` | a column in the last such row of a table |
//! | `23.6<!-- results/drainage.csv: breakthrough-time-s velocity=0.033 spacing=8e-6 × 1e3 -->` | the same in a stored result |
//! | `<!-- long -->` above a block `sh` | it runs too long to be tested |

/// What a page has in blocks of code, in order.
#[derive(Debug, PartialEq)]
pub enum Block {
    /// A file, named in its first line, that the reader saves.
    File(String, String),
    /// Command lines, and whether they run long.
    Commands(Vec<String>, bool),
    /// Lines of output and their tolerance.
    Output(Vec<String>, f64),
}

/// A number in a sentence or a table, and where it comes from.
#[derive(Debug, PartialEq)]
pub struct Mark {
    /// The number as it stands on the page.
    pub told: String,
    /// The folder in `out`.
    pub folder: String,
    /// The table in it; else the report.
    pub table: Option<String>,
    /// The measure or column.
    pub quantity: String,
    /// Columns and their values in the row.
    pub row: Vec<(String, String)>,
    /// What the quantity is multiplied by.
    pub factor: f64,
}

/// Blocks and marks of a page.
pub fn read(text: &str) -> Result<(Vec<Block>, Vec<Mark>), String> {
    let (mut blocks, mut marks, mut comment) = (Vec::new(), Vec::new(), "");
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let lines: Vec<String> = lines.by_ref().take_while(|line| *line != "```").map(str::to_owned).collect();
            blocks.extend(block(language, lines, comment)?);
            comment = "";
        } else if !comment.is_empty() && !line.is_empty() {
            return Err(format!("<!-- {comment} --> stands above no block"));
        } else if let Some(found) = line.strip_prefix("<!-- ").and_then(|rest| rest.strip_suffix(" -->")) {
            comment = if found == "long" || found.starts_with("output:") { found } else { "" };
        } else {
            marks.extend(marks_of(line)?);
        }
    }
    Ok((blocks, marks))
}

fn block(language: &str, lines: Vec<String>, comment: &str) -> Result<Option<Block>, String> {
    let tolerance = comment.strip_prefix("output:").map(str::trim);
    let file = lines.first().and_then(|line| line.strip_prefix("# ")).and_then(name_of_file);
    match (language, tolerance, file) {
        ("text", Some(tolerance), _) => {
            let number = tolerance.parse().map_err(|_| format!("<!-- {comment} --> has no tolerance"))?;
            Ok(Some(Block::Output(lines, number)))
        }
        (_, Some(_), _) => Err(format!("<!-- {comment} --> stands above a block {language}")),
        ("sh", None, _) => Ok(Some(Block::Commands(lines, comment == "long"))),
        ("toml", None, Some(name)) => Ok(Some(Block::File(name, lines.join("\n")))),
        _ => Ok(None),
    }
}

/// The first name of a file in a comment.
fn name_of_file(comment: &str) -> Option<String> {
    let mut words = comment.split_whitespace().map(|word| word.trim_end_matches([':', '.', ',']));
    words.find(|word| word.ends_with(".toml")).map(str::to_owned)
}

fn marks_of(line: &str) -> Result<Vec<Mark>, String> {
    let mut marks = Vec::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once("<!-- ") {
        // Within code a comment is shown.
        if line[..line.len() - after.len()].matches('`').count() % 2 == 1 {
            rest = after;
            continue;
        }
        let wrong = |what: &str| format!("{what} in: {line}");
        let (content, behind) = after.split_once(" -->").ok_or_else(|| wrong("a comment is not closed"))?;
        rest = behind;
        let is_number = |c: char| c.is_ascii_digit() || ".e+-−".contains(c);
        let told = before.rsplit(|c| !is_number(c)).next().unwrap_or_default();
        if !told.ends_with(|c: char| c.is_ascii_digit()) {
            return Err(wrong("a mark stands behind no number"));
        }
        marks.push(mark(told, content).ok_or_else(|| wrong("a mark is not FOLDER: QUANTITY"))?);
    }
    Ok(marks)
}

fn mark(told: &str, content: &str) -> Option<Mark> {
    let (place, rest) = content.split_once(": ")?;
    let (folder, table) = match place.split_once('/') {
        Some((folder, table)) => (folder, Some(table.to_owned())),
        None => (place, None),
    };
    let (rest, factor) = match rest.split_once(" × ") {
        Some((rest, factor)) => (rest, factor.parse().ok()?),
        None => (rest, 1.0),
    };
    let mut words = rest.split_whitespace();
    let quantity = words.next()?.to_owned();
    let pair = |word: &str| word.split_once('=').map(|(key, value)| (key.to_owned(), value.to_owned()));
    let row: Vec<_> = words.map(pair).collect::<Option<_>>()?;
    (table.is_some() || row.is_empty()).then(|| Mark {
        told: told.replace('−', "-"),
        folder: folder.to_owned(),
        table,
        quantity,
        row,
        factor,
    })
}

/// Whether a number, rounded to the digits of `told`, is the one that is told.
pub fn rounds_to(found: f64, told: &str) -> bool {
    let (digits, exponent) = told.split_once('e').unwrap_or((told, "0"));
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let (Ok(number), Ok(exponent)) = (told.parse::<f64>(), exponent.parse::<i32>()) else { return false };
    (found - number).abs() <= 0.5001 * 10f64.powi(exponent - i32::try_from(decimals).unwrap())
}

/// Whether a printed line is the one on a page: the same words, and numbers within a share of them.
pub fn same_line(told: &str, printed: &str, tolerance: f64) -> bool {
    same(&pieces(told), &pieces(printed), tolerance)
}

fn same(told: &[Piece], printed: &[Piece], tolerance: f64) -> bool {
    match (told.split_first(), printed.split_first()) {
        (None, None) => true,
        (Some((Piece::Anything, rest)), _) => (0..=printed.len()).any(|from| same(rest, &printed[from..], tolerance)),
        (Some((a, told)), Some((b, printed))) => a.is(b, tolerance) && same(told, printed, tolerance),
        _ => false,
    }
}

#[derive(Debug, PartialEq)]
enum Piece {
    Word(String),
    Number(f64),
    Anything,
}

impl Piece {
    fn is(&self, other: &Self, tolerance: f64) -> bool {
        match (self, other) {
            (Piece::Number(a), Piece::Number(b)) => (a - b).abs() <= tolerance * b.abs(),
            _ => self == other,
        }
    }
}

/// Words and numbers of a line. Digits that follow a letter belong to its word.
fn pieces(line: &str) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for word in line.split_whitespace() {
        let mut rest = word;
        while !rest.is_empty() {
            let text = rest.strip_prefix("...").map(|_| Piece::Anything);
            let (piece, length) = match (text, number(rest)) {
                (Some(anything), _) => (anything, 3),
                (None, Some((number, length))) => (Piece::Number(number), length),
                (None, None) => {
                    let end = end_of_word(rest);
                    (Piece::Word(rest[..end].to_owned()), end)
                }
            };
            pieces.push(piece);
            rest = &rest[length..];
        }
    }
    pieces
}

/// Where a number or three points begin, or the end.
fn end_of_word(word: &str) -> usize {
    let mut last = ' ';
    for (place, next) in word.char_indices() {
        let begins = next.is_ascii_digit() && !last.is_alphanumeric() && !"_.".contains(last);
        if place > 0 && (begins || word[place..].starts_with("...")) {
            // A sign behind a letter is a hyphen.
            let signed = place > 1 && "+-".contains(last);
            let hyphen = word[..place - usize::from(signed)].ends_with(char::is_alphanumeric);
            return if signed && !hyphen { place - 1 } else { place };
        }
        last = next;
    }
    word.len()
}

/// A number at the beginning of a text, and its length.
fn number(text: &str) -> Option<(f64, usize)> {
    let digits = |from: usize| from + text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let begin = usize::from(text.starts_with(['+', '-']));
    let mut end = digits(begin);
    if end == begin {
        return None;
    }
    if text[end..].starts_with('.') && digits(end + 1) > end + 1 {
        end = digits(end + 1);
    }
    if text[end..].starts_with('e') {
        let sign = end + 1 + usize::from(text[end + 1..].starts_with(['+', '-']));
        if digits(sign) > sign {
            end = digits(sign);
        }
    }
    Some((text[..end].parse().ok()?, end))
}

#[test]
fn a_line_with_another_number_or_word_is_not_what_was_printed() {
    let printed = "  breakthrough-pressure-Pa           302.1 Pa";
    for (told, tolerance, same) in [
        ("breakthrough-pressure-Pa 302.1 Pa", 1e-5, true),
        ("breakthrough-pressure-Pa 302.2 Pa", 1e-5, false),
        ("breakthrough-pressure-Pa 302.2 Pa", 1e-3, true),
        ("breakthrough-pressure-Pa 302.1 kPa", 1e-3, false),
        ("breakthrough-pressure-Pa 302.1", 1e-3, false),
        ("breakthrough-pressure-Pa -302.1 Pa", 1e-3, false),
        ("... 302.1 Pa", 1e-5, true),
        ("breakthrough-pressure-Pa ...", 1e-5, true),
        ("breakthrough-pressure-Pa ... Pa", 1e-5, true),
        ("... 303.1 Pa", 1e-5, false),
    ] {
        assert_eq!(same_line(told, printed, tolerance), same, "{told} within {tolerance}");
    }
    for (told, printed, same) in [
        ("throat-1-width-m 1.501e-4 m", "throat-1-width-m  1.501e-4 m", true),
        ("throat-1-width-m 1.501e-4 m", "throat-2-width-m  1.501e-4 m", false),
        ("throat-1-width-m 1.501e-4 m", "throat-1-width-m  1.501e-5 m", false),
        ("a.gif: 38 frames, 0.3 MB, in ... s", "a.gif: 38 frames, 0.3 MB, in 2.4 s", true),
        ("a.gif: 38 frames, 0.3 MB, in ... s", "a.gif: 39 frames, 0.3 MB, in 2.4 s", false),
        ("m2 (-67.94)", "m2 (-67.94)", true),
        ("m2 (-67.94)", "m3 (-67.94)", false),
        ("m2 (-67.94)", "m2 (67.94)", false),
    ] {
        assert_eq!(same_line(told, printed, 1e-5), same, "{told} and {printed}");
    }
}

#[test]
fn a_number_of_a_sentence_is_the_measure_rounded() {
    for (told, found, same) in [
        ("0.27", 0.2741, true),
        ("0.28", 0.2741, false),
        ("0.26", 0.2741, false),
        ("302", 302.1, true),
        ("303", 302.1, false),
        ("4.7e-3", 4.741e-3, true),
        ("4.8e-3", 4.741e-3, false),
        ("4.7e-4", 4.741e-3, false),
        ("-67.9", -67.94, true),
        ("67.9", -67.94, false),
    ] {
        assert_eq!(rounds_to(found, told), same, "{found} as {told}");
    }
}

#[test]
fn blocks_and_marks_of_a_page_are_found() {
    let page = "Fills 0.34<!-- angles/table.csv: share process=drainage angle=40 --> of it, −5.4<!-- a: width-m × 1e3 --> mm.\n\n\
        ```toml\n# x.toml: a case\ny = 1\n```\n\n<!-- long -->\n```sh\nrun 1\n```\n\n```sh\nrun 2\n```\n\n\
        <!-- output: 1e-5 -->\n```text\nwidth 5\n```\n\n<!-- results: other -->\n";
    let (blocks, marks) = read(page).unwrap();
    let wanted = [
        Block::File("x.toml".into(), "# x.toml: a case\ny = 1".into()),
        Block::Commands(vec!["run 1".into()], true),
        Block::Commands(vec!["run 2".into()], false),
        Block::Output(vec!["width 5".into()], 1e-5),
    ];
    assert_eq!(blocks, wanted);
    assert_eq!([&marks[0].told, &marks[1].told], ["0.34", "-5.4"]);
    assert_eq!([&marks[0].folder, &marks[1].folder], ["angles", "a"]);
    assert_eq!([&marks[0].quantity, &marks[1].quantity], ["share", "width-m"]);
    assert_eq!([marks[0].row.len(), marks[1].row.len()], [2, 0]);
    assert_eq!([marks[0].factor, marks[1].factor], [1.0, 1e3]);
    assert_eq!(read("As in `5<!-- a: width-m -->`.").unwrap().1, []);
    for wrong in [
        "about<!-- a: width-m -->",
        "5<!-- a width-m -->",
        "5<!-- a: width-m process=drainage -->",
        "5<!-- a: width-m × ten -->",
        "5<!-- a: width-m",
        "<!-- output: 1e-5 -->\n\nNo block.",
        "<!-- output: few -->\n```text\n```",
        "<!-- output: 1e-5 -->\n```sh\n```",
    ] {
        assert!(read(wrong).is_err(), "{wrong}");
    }
}
