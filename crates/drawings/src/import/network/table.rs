//! A table of named columns, with the place of each cell for messages.

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::import::drawing::Refusal;
use crate::import::limits;
use crate::import::text::quoted;
use meniscus_core::math::Vec2;

/// Separators of columns.
const SEPARATORS: [char; 3] = [',', ';', '\t'];

/// A table, read from text.
pub(super) struct Table {
    /// Before each location: empty, or the name of the other file of a pair.
    file: String,
    header_line: u64,
    names: Vec<String>,
    rows: Vec<StringRecord>,
}

/// The names of the columns of a text, of which the first line that is neither empty nor a comment is the header.
pub(super) fn header(text: &str) -> Option<Vec<String>> {
    let line = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#'))?;
    let mut record = StringRecord::new();
    reader(line).read_record(&mut record).ok()?;
    Some(record.iter().map(str::to_owned).collect())
}

fn reader(text: &str) -> csv::Reader<&[u8]> {
    let line = text.lines().find(|line| !line.starts_with('#') && line.contains(SEPARATORS)).unwrap_or_default();
    let separator = line.chars().find(|c| SEPARATORS.contains(c)).unwrap_or(',');
    ReaderBuilder::new()
        .delimiter(separator as u8)
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(text.as_bytes())
}

impl Table {
    /// The table of a text; `file` names it in messages if it is not the one that was asked for.
    pub(super) fn of(text: &str, file: Option<&str>) -> Result<Self, Refusal> {
        let file = file.map_or(String::new(), |file| format!("{file}, "));
        let mut records = reader(text).into_records();
        let refusal = |error: csv::Error| Refusal::new(file.clone() + "file", error.to_string(), "a table");
        let header = records.next().transpose().map_err(refusal)?.unwrap_or_default();
        let rows = records.collect::<Result<_, _>>().map_err(refusal)?;
        let names = header.iter().map(str::to_owned).collect();
        Ok(Self { file, header_line: line_of(&header), names, rows })
    }

    /// The names of its columns.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    /// Number of rows.
    pub(super) fn rows(&self) -> usize {
        self.rows.len()
    }

    /// The first of these columns that is there.
    pub(super) fn first_of(&self, names: &[&str]) -> Option<usize> {
        names.iter().find_map(|name| self.names().position(|known| known == *name))
    }

    /// The first of these columns, or the refusal of the header.
    pub(super) fn required(&self, names: &[&str], what: &str, remedy: &str) -> Result<usize, Refusal> {
        self.first_of(names).ok_or_else(|| {
            let named: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
            let found = format!("no column {}", named.join(" or "));
            Refusal::new(format!("{}line {}", self.file, self.header_line), found, format!("{what}; {remedy}"))
        })
    }

    /// The text of a cell; empty beyond the end of its line.
    pub(super) fn cell(&self, row: usize, column: usize) -> &str {
        self.rows.get(row).and_then(|cells| cells.get(column)).unwrap_or_default()
    }

    /// The place of a row.
    pub(super) fn line(&self, row: usize) -> String {
        format!("{}line {}", self.file, self.rows.get(row).map_or(self.header_line, line_of))
    }

    /// The refusal of a cell.
    pub(super) fn refusal(&self, row: usize, column: usize, expected: impl Into<String>) -> Refusal {
        let name = self.names.get(column).map_or("", String::as_str);
        let text = self.cell(row, column);
        let found = if text.is_empty() { "an empty cell".to_owned() } else { quoted(text) };
        Refusal::new(format!("{}, column {name}", self.line(row)), found, expected)
    }

    /// The number in a cell, in range.
    pub(super) fn number(&self, row: usize, column: usize, what: &str) -> Result<f64, Refusal> {
        let number = self.cell(row, column).parse().ok().filter(|&number| limits::is_in_range(Vec2::new(number, 0.0)));
        number.ok_or_else(|| self.refusal(row, column, what))
    }

    /// The number above 0 in a cell.
    pub(super) fn positive(&self, row: usize, column: usize, what: &str) -> Result<f64, Refusal> {
        let number = self.number(row, column, what)?;
        if number > 0.0 { Ok(number) } else { Err(self.refusal(row, column, what)) }
    }

    /// The whole number in a cell, which pandas writes as 3.0 in columns with gaps.
    pub(super) fn index(&self, row: usize, column: usize) -> Option<usize> {
        let number: f64 = self.cell(row, column).parse().ok()?;
        (number >= 0.0 && number.fract() == 0.0 && number < 2f64.powi(53)).then_some(number as usize)
    }

    /// Whether a label is set.
    pub(super) fn is_set(&self, row: usize, column: usize) -> bool {
        matches!(self.cell(row, column), "True" | "true" | "TRUE" | "1" | "1.0")
    }
}

fn line_of(record: &StringRecord) -> u64 {
    record.position().map_or(1, csv::Position::line)
}
