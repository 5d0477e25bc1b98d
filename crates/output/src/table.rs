//! Tables as CSV files: numbers with as many digits as are needed to read back the same value, empty fields for missing values.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use super::atomic::{self, FileError};
use super::series::add_number;
use meniscus_core::table::{Cells, Table};

/// Writes `NAME.csv` in `folder`.
pub fn write(folder: &Path, table: &Table) -> Result<(), FileError> {
    write_at(&folder.join(format!("{}.csv", table.name)), table)
}

/// Writes the table as this file.
pub fn write_at(path: &Path, table: &Table) -> Result<(), FileError> {
    atomic::write_with(path, |file| write_rows(table, file))
}

/// Writes the table row by row.
fn write_rows(table: &Table, to: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::Writer::from_writer(to);
    writer.write_record(table.columns.iter().map(|column| column.name))?;
    let rows = table.columns.iter().map(|column| column.cells.len()).max().unwrap_or(0);
    let mut field = String::new();
    for row in 0..rows {
        for column in &table.columns {
            field.clear();
            add_field(&mut field, &column.cells, row);
            writer.write_field(&field)?;
        }
        writer.write_record(None::<&[u8]>)?;
    }
    writer.flush()
}

/// Adds the text of a cell, nothing where there is none.
fn add_field(text: &mut String, cells: &Cells, row: usize) {
    // Writing to memory cannot fail.
    let mut add_index = |index: usize| write!(text, "{index}").unwrap_or_default();
    match cells {
        Cells::Counts(values) => values.get(row).copied().into_iter().for_each(add_index),
        Cells::Indices(values) => values.get(row).copied().flatten().into_iter().for_each(&mut add_index),
        // Adding zero turns minus zero into zero.
        Cells::Numbers(values) => values.get(row).into_iter().for_each(|value| add_number(text, value + 0.0)),
        Cells::Flags(values) => {
            values.get(row).into_iter().for_each(|&is| text.push_str(if is { "True" } else { "False" }))
        }
        Cells::Words(values) => values.get(row).into_iter().for_each(|word| text.push_str(word)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::table::Column;

    #[test]
    fn shorter_columns_are_filled_with_empty_fields() {
        let column = |name, cells| Column { name, cells };
        let table = Table {
            name: "pairs",
            columns: vec![
                column("x", Cells::Numbers(vec![0.1 + 0.2, f64::NAN, -0.0])),
                column("label", Cells::Flags(vec![true, false])),
                column("place", Cells::Indices(vec![None, Some(7)])),
                column("word", Cells::Words(vec!["a,b"])),
            ],
        };
        let mut text = Vec::new();
        write_rows(&table, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert_eq!(text, "x,label,place,word\n0.30000000000000004,True,,\"a,b\"\n,False,7,\n0,,,\n");
    }
}
