//! Tables as CSV files: numbers with as many digits as are needed to read back the same value, empty fields for missing values.

use std::path::Path;

use super::atomic::{self, FileError};
use super::series::number;
use meniscus_core::table::{Cells, Table};

/// Writes `NAME.csv` in `folder`.
pub fn write(folder: &Path, table: &Table) -> Result<(), FileError> {
    write_at(&folder.join(format!("{}.csv", table.name)), table)
}

/// Writes the table as this file.
pub fn write_at(path: &Path, table: &Table) -> Result<(), FileError> {
    atomic::write(path, &text(table).map_err(FileError::format(path))?)
}

fn text(table: &Table) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(table.columns.iter().map(|column| column.name))?;
    let rows = table.columns.iter().map(|column| column.cells.len()).max().unwrap_or(0);
    for row in 0..rows {
        writer.write_record(table.columns.iter().map(|column| field(&column.cells, row)))?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}

fn field(cells: &Cells, row: usize) -> String {
    let text = match cells {
        // Adding zero turns minus zero into zero.
        Cells::Numbers(values) => values.get(row).map(|&value| number(value + 0.0)),
        Cells::Counts(values) => values.get(row).map(ToString::to_string),
        Cells::Indices(values) => values.get(row).copied().flatten().map(|value| value.to_string()),
        Cells::Flags(values) => values.get(row).map(|&value| if value { "True" } else { "False" }.to_owned()),
        Cells::Words(values) => values.get(row).map(|&word| word.to_owned()),
    };
    text.unwrap_or_default()
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
        let text = String::from_utf8(text(&table).unwrap()).unwrap();
        assert_eq!(text, "x,label,place,word\n0.30000000000000004,True,,\"a,b\"\n,False,7,\n0,,,\n");
    }
}
