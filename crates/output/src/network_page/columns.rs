//! Columns of numbers as base64 of their little-endian bytes, in the smallest type that holds them.

use std::collections::BTreeMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use meniscus_core::table::{Cells, Table};
use serde::Serialize;

/// A column: its type and its values.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Packed {
    /// `u8`, `u16`, `i16`, `i32` or `f32`.
    #[serde(rename = "type")]
    kind: &'static str,
    base64: String,
    /// The words that the numbers stand for, if they do.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    words: Vec<&'static str>,
}

/// The columns of a table by name.
pub(super) type Columns = BTreeMap<&'static str, Packed>;

impl Packed {
    fn new(kind: &'static str, bytes: Vec<u8>) -> Self {
        Self { kind, base64: STANDARD.encode(bytes), words: Vec::new() }
    }

    /// Numbers with seven digits; NaN stays NaN.
    pub(super) fn numbers(values: impl Iterator<Item = f64>) -> Self {
        Self::new("f32", values.flat_map(|value| (value as f32).to_le_bytes()).collect())
    }

    /// Signed numbers of 16 bits.
    pub(super) fn short(values: impl Iterator<Item = i16>) -> Self {
        Self::new("i16", values.flat_map(i16::to_le_bytes).collect())
    }

    /// Counts.
    pub(super) fn counts(values: impl IntoIterator<Item = usize>) -> Self {
        let values: Vec<usize> = values.into_iter().collect();
        match values.iter().max() {
            Some(&most) if most > usize::from(u16::MAX) => {
                Self::new("i32", values.iter().flat_map(|&value| (value as i32).to_le_bytes()).collect())
            }
            Some(&most) if most > usize::from(u8::MAX) => {
                Self::new("u16", values.iter().flat_map(|&value| (value as u16).to_le_bytes()).collect())
            }
            _ => Self::new("u8", values.iter().map(|&value| value as u8).collect()),
        }
    }

    /// Indices that may be absent, plus one; 0 for none.
    pub(super) fn indices(values: impl IntoIterator<Item = Option<usize>>) -> Self {
        Self::counts(values.into_iter().map(|value| value.map_or(0, |index| index + 1)))
    }

    fn words(values: &[&'static str]) -> Self {
        let mut words: Vec<&'static str> = Vec::new();
        let mut number = |word: &'static str| {
            words.iter().position(|known| *known == word).unwrap_or_else(|| {
                words.push(word);
                words.len() - 1
            })
        };
        let numbers: Vec<usize> = values.iter().map(|word| number(word)).collect();
        Self { words, ..Self::counts(numbers) }
    }

    fn of(cells: &Cells) -> Self {
        match cells {
            Cells::Numbers(values) => Self::numbers(values.iter().copied()),
            Cells::Counts(values) => Self::counts(values.iter().copied()),
            Cells::Indices(values) => Self::indices(values.iter().copied()),
            Cells::Flags(values) => Self::counts(values.iter().map(|&flag| usize::from(flag))),
            Cells::Words(values) => Self::words(values),
        }
    }
}

/// The columns of a table.
pub(super) fn columns(table: &Table) -> Columns {
    table.columns.iter().map(|column| (column.name, Packed::of(&column.cells))).collect()
}
