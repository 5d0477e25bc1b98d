//! Tables and texts as data: results of a solver at its end, written elsewhere.

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Numbers; NaN if absent.
    Numbers(Vec<f64>),
    /// Integers.
    Counts(Vec<usize>),
    /// Indices that may be absent.
    Places(Vec<Option<usize>>),
    /// Yes or no, written `True` and `False`.
    Flags(Vec<bool>),
    /// Words.
    Words(Vec<&'static str>),
}

impl Cells {
    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Counts(values) => values.len(),
            Self::Places(values) => values.len(),
            Self::Flags(values) => values.len(),
            Self::Words(values) => values.len(),
        }
    }
}

/// A column with its header.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Header, with the unit at its end.
    pub name: &'static str,
    /// Values.
    pub cells: Cells,
}

/// Columns side by side; shorter ones are padded with empty fields.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Its file is `NAME.csv`.
    pub name: &'static str,
    /// Columns.
    pub columns: Vec<Column>,
}

/// A text file.
#[derive(Debug, Clone, PartialEq)]
pub struct Document {
    /// Name of the file.
    pub name: &'static str,
    /// Its content.
    pub text: String,
}
