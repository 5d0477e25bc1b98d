//! Tables and texts as data: what a solver has to say at its end, written by others.

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Numbers; NaN where there is none.
    Numbers(Vec<f64>),
    /// Whole numbers.
    Counts(Vec<usize>),
    /// Whole numbers that may be absent.
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

/// Columns side by side; where one is shorter, its fields are empty below.
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
    /// What stands in it.
    pub text: String,
}
