//! Data for Python: made without the interpreter's lock, as bytes that numpy can read directly.

use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyDict, PyList, PyString};

/// A value to hand over.
pub(crate) enum Data {
    /// Floats in rows of the given length.
    Floats(Vec<f64>, usize),
    /// Integers in rows of the given length.
    Integers(Vec<i64>, usize),
    /// Booleans.
    Flags(Vec<bool>),
    /// Words, one per row.
    Words(Vec<&'static str>),
    /// A text.
    Text(String),
    /// A number.
    Number(f64),
    /// Values by name.
    Group(Vec<(String, Data)>),
    /// A list.
    List(Vec<Data>),
    /// `None`.
    Absent,
}

impl Data {
    /// A group.
    pub(crate) fn group<const N: usize>(entries: [(&str, Self); N]) -> Self {
        Self::Group(entries.into_iter().map(|(name, data)| (name.to_owned(), data)).collect())
    }

    /// A text.
    pub(crate) fn text(text: &str) -> Self {
        Self::Text(text.to_owned())
    }

    /// The Python object: an array is a tuple of its type, the length of its rows and its bytes.
    pub(crate) fn into_python(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        Ok(match self {
            Self::Floats(values, columns) => array(py, "f8", columns, &values, |value| value.to_ne_bytes())?,
            Self::Integers(values, columns) => array(py, "i8", columns, &values, |value| value.to_ne_bytes())?,
            Self::Flags(values) => array(py, "?", 1, &values, |value| [u8::from(value)])?,
            Self::Words(values) => PyList::new(py, values)?.into_any(),
            Self::Text(text) => PyString::new(py, &text).into_any(),
            Self::Number(value) => value.into_pyobject(py)?.into_any(),
            Self::Group(entries) => {
                let group = PyDict::new(py);
                for (name, data) in entries {
                    group.set_item(name, data.into_python(py)?)?;
                }
                group.into_any()
            }
            Self::List(items) => {
                let list = PyList::empty(py);
                for item in items {
                    list.append(item.into_python(py)?)?;
                }
                list.into_any()
            }
            Self::Absent => py.None().into_bound(py),
        })
    }
}

fn array<'py, T: Copy, const N: usize>(
    py: Python<'py>,
    kind: &str,
    columns: usize,
    values: &[T],
    bytes_of: impl Fn(T) -> [u8; N],
) -> PyResult<Bound<'py, PyAny>> {
    let bytes = PyByteArray::new_with(py, values.len() * N, |bytes| {
        for (slot, value) in bytes.chunks_exact_mut(N).zip(values) {
            slot.copy_from_slice(&bytes_of(*value));
        }
        Ok(())
    })?;
    Ok((kind, columns, bytes).into_pyobject(py)?.into_any())
}
