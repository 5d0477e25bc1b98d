//! Tables and texts as data: the final output of a solver, written by other modules.

use std::io::{self, Write};

/// The values of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Numbers; NaN for missing values.
    Numbers(Vec<f64>),
    /// Integers.
    Counts(Vec<usize>),
    /// Integers that may be absent.
    Indices(Vec<Option<usize>>),
    /// Booleans, written `True` and `False`.
    Flags(Vec<bool>),
    /// Strings.
    Words(Vec<&'static str>),
}

impl Cells {
    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Numbers(values) => values.len(),
            Self::Counts(values) => values.len(),
            Self::Indices(values) => values.len(),
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

/// Columns side by side; below the end of a shorter column fields are empty.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Its file is `NAME.csv`.
    pub name: &'static str,
    /// Columns.
    pub columns: Vec<Column>,
}

/// Writes a text.
type Written<'a> = Box<dyn Fn(&mut dyn Write) -> io::Result<()> + Send + Sync + 'a>;

/// A text file, made when it is written.
pub struct Document<'a> {
    /// Name of the file.
    pub name: &'static str,
    content: Written<'a>,
}

impl<'a> Document<'a> {
    /// A file with the text that `content` writes.
    pub fn new(name: &'static str, content: impl Fn(&mut dyn Write) -> io::Result<()> + Send + Sync + 'a) -> Self {
        Self { name, content: Box::new(content) }
    }

    /// Writes its text.
    ///
    /// # Errors
    /// Those of the target.
    pub fn write(&self, to: &mut dyn Write) -> io::Result<()> {
        (self.content)(to)
    }

    /// Its text.
    pub fn text(&self) -> String {
        let mut bytes = Vec::new();
        // Writing to memory cannot fail.
        self.write(&mut bytes).unwrap_or_default();
        String::from_utf8_lossy(&bytes).into_owned()
    }
}
