//! Groups, the elements of every DXF file: a code and a value, as two lines of text or in binary.

use std::borrow::Cow;

use crate::import::drawing::Refusal;

/// Signature of a binary file.
const BINARY: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// A code and its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Group<'a> {
    /// The code, which determines the meaning of the value.
    pub(crate) code: i32,
    pub(crate) value: Value<'a>,
    /// Line of the value in a text file, byte offset of the group in a binary one.
    pub(crate) position: usize,
}

/// A value as stored in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Value<'a> {
    /// A line of a text file, or a string of a binary one.
    Text(&'a [u8]),
    /// A binary real.
    Real(f64),
    /// A binary integer.
    Whole(i64),
}

impl<'a> Group<'a> {
    /// The value as text, trimmed. Bytes that are not UTF-8 are decoded as Latin-1, as in old files.
    pub(crate) fn text(&self) -> Cow<'a, str> {
        match self.value {
            Value::Text(bytes) => match std::str::from_utf8(bytes) {
                Ok(text) => Cow::Borrowed(text.trim()),
                Err(_) => Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect::<String>().trim().to_owned()),
            },
            Value::Real(number) => Cow::Owned(number.to_string()),
            Value::Whole(number) => Cow::Owned(number.to_string()),
        }
    }

    /// Whether this is the start of something: a section, an entity, a table.
    pub(crate) fn begins(&self, name: &str) -> bool {
        self.code == 0 && self.text() == name
    }

    /// The value as a finite real.
    pub(crate) fn real(&self) -> Result<f64, Refusal> {
        let number = match self.value {
            Value::Real(number) => Some(number),
            Value::Whole(number) => Some(number as f64),
            Value::Text(_) => self.text().parse().ok(),
        };
        number.filter(|number| number.is_finite()).ok_or_else(|| self.refusal("a finite number"))
    }

    /// The value as an integer.
    pub(crate) fn whole(&self) -> Result<i64, Refusal> {
        match self.value {
            Value::Whole(number) => Ok(number),
            _ => self.text().parse().map_err(|_| self.refusal("a whole number")),
        }
    }

    fn refusal(&self, expected: &str) -> Refusal {
        let text: String = self.text().chars().take(40).collect();
        let unit = if matches!(self.value, Value::Text(_)) { "line" } else { "byte" };
        Refusal::new(format!("{unit} {}", self.position), format!("`{text}` behind group code {}", self.code), expected)
    }
}

/// All groups of a file except comments.
pub(crate) fn groups(bytes: &[u8]) -> Result<Vec<Group<'_>>, Refusal> {
    match bytes.strip_prefix(BINARY) {
        Some(rest) => binary(rest),
        None => text(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)),
    }
}

fn text(bytes: &[u8]) -> Result<Vec<Group<'_>>, Refusal> {
    const COMMENT: i32 = 999;
    let mut lines = bytes.split(|&byte| byte == b'\n').map(<[u8]>::trim_ascii).enumerate();
    let mut groups = Vec::new();
    while let Some((at, line)) = lines.next() {
        let code = std::str::from_utf8(line).ok().and_then(|line| line.parse::<i32>().ok());
        let Some(code) = code else {
            // Blank lines at the end are not a group.
            if line.is_empty() && lines.by_ref().all(|(_, rest)| rest.is_empty()) {
                break;
            }
            let shown: String = line.iter().take(40).map(|&byte| char::from(byte)).collect();
            return Err(Refusal::new(
                format!("line {}", at + 1),
                format!("`{shown}`"),
                "a group code (DXF, text or binary)",
            ));
        };
        let Some((at, value)) = lines.next() else {
            return Err(Refusal::new(format!("line {}", at + 1), "the end of the file", "the value of a group"));
        };
        if code != COMMENT {
            groups.push(Group { code, value: Value::Text(value), position: at + 1 });
        }
    }
    Ok(groups)
}

fn binary(bytes: &[u8]) -> Result<Vec<Group<'_>>, Refusal> {
    // Before release 13 a code took one byte: the first group is 0, `SECTION`.
    let is_old = bytes.len() > 1 && bytes[1] != 0;
    let mut reader = Reader { bytes, at: 0 };
    let mut groups = Vec::new();
    while reader.at < bytes.len() {
        let at = reader.at;
        let group = reader.group(is_old).ok_or_else(|| {
            let location = format!("byte {}", BINARY.len() + at);
            Refusal::new(location, "a truncated group or an unknown code", "a complete binary DXF file")
        })?;
        groups.push(Group { position: BINARY.len() + at, ..group });
        if group.begins("EOF") {
            break;
        }
    }
    Ok(groups)
}

/// Reads a binary file from the front; `None` if it ends too early.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let taken = self.bytes.get(self.at..self.at.checked_add(length)?)?;
        self.at += length;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    fn group(&mut self, is_old: bool) -> Option<Group<'a>> {
        /// In old files, the marker for a two-byte code.
        const LONG_CODE: u8 = 255;
        let first = if is_old { self.array::<1>()?[0] } else { LONG_CODE };
        let code = if first == LONG_CODE { i32::from(u16::from_le_bytes(self.array()?)) } else { i32::from(first) };
        let value = match code {
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Value::Real(f64::from_le_bytes(self.array()?)),
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
                Value::Whole(i16::from_le_bytes(self.array()?).into())
            }
            90..=99 | 420..=429 | 440..=459 | 1071 => Value::Whole(i32::from_le_bytes(self.array()?).into()),
            160..=169 => Value::Whole(i64::from_le_bytes(self.array()?)),
            290..=299 => Value::Whole(self.array::<1>()?[0].into()),
            310..=319 | 1004 => {
                let length = self.array::<1>()?[0];
                Value::Text(self.take(length.into())?)
            }
            0..=9 | 100..=109 | 300..=309 | 320..=369 | 390..=399 | 410..=419 | 430..=439 | 470..=481 | 999..=1009 => {
                let length = self.bytes.get(self.at..)?.iter().position(|&byte| byte == 0)?;
                let text = self.take(length)?;
                self.at += 1;
                Value::Text(text)
            }
            _ => return None,
        };
        Some(Group { code, value, position: 0 })
    }
}
