//! The lines around a mistake, cut to fit on a screen: a line of a file can be of any length.

use std::ops::Range;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

/// Characters of a line that are shown before and after the start of the mistake.
const BEFORE: usize = 60;
const AFTER: usize = 100;

/// Most characters quoted of a word of the file, so that the rest of the message stays readable.
pub(super) const LONGEST_WORD: usize = 200;

/// Marks an omission.
const CUT: &str = "...";

/// The line of a mistake with the lines before and after it.
#[derive(Debug, Clone)]
pub(super) struct Excerpt {
    name: String,
    text: String,
    /// Number of the first line, from 0.
    first_line: usize,
    /// Line and column of the mistake, from 0.
    location: (usize, usize),
}

impl Excerpt {
    /// The lines around the bytes `range` of `text`, which begin and end at character boundaries, and the range of these bytes in the excerpt.
    pub(crate) fn new(name: &str, text: &str, range: Range<usize>, location: (usize, usize)) -> (Self, Range<usize>) {
        let begin = text[..range.start].rfind('\n').map_or(0, |end| end + 1);
        let end = text[range.start..].find('\n').map_or(text.len(), |length| range.start + length);
        let lines_before = text[..begin].strip_suffix('\n').map(|before| before.rsplit('\n').next().unwrap_or(before));
        let line_after = text[end..].strip_prefix('\n').and_then(|after| after.split('\n').next());
        let mut shown = String::new();
        if let Some(line) = lines_before {
            shown.push_str(&shortened(line, BEFORE + AFTER));
            shown.push('\n');
        }
        let from = back(&text[begin..range.start], BEFORE) + begin;
        let to = forward(&text[range.start..end], AFTER) + range.start;
        if from > begin {
            shown.push_str(CUT);
        }
        let start = shown.len() + range.start - from;
        shown.push_str(text[from..to].trim_end_matches('\r'));
        let until = shown.len();
        if to < end {
            shown.push_str(CUT);
        }
        if let Some(line) = line_after {
            shown.push('\n');
            shown.push_str(&shortened(line, BEFORE + AFTER));
        }
        let first_line = location.0 - usize::from(lines_before.is_some());
        let start = start.min(until);
        let span = start..(start + range.len()).min(until);
        (Self { name: shortened(name, BEFORE + AFTER), text: shown, first_line, location }, span)
    }
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let bytes = self.text.as_bytes();
        let (range, (line, column)) = if lines_before + lines_after > 0 {
            (0..bytes.len(), (self.first_line, 0))
        } else {
            (span.offset()..span.offset() + span.len(), self.location)
        };
        let data = bytes.get(range.clone()).ok_or(MietteError::OutOfBounds)?;
        let span = (range.start, range.len()).into();
        let count = self.text.lines().count();
        Ok(Box::new(MietteSpanContents::new_named(self.name.clone(), data, span, line, column, count)))
    }
}

/// The text, or its first `most` characters if it is longer.
pub(super) fn shortened(text: &str, most: usize) -> String {
    let end = forward(text, most);
    if end < text.len() { format!("{}{CUT}", &text[..end]) } else { text.to_owned() }
}

/// Byte index of the end of the first `count` characters of a text.
fn forward(text: &str, count: usize) -> usize {
    text.char_indices().nth(count).map_or(text.len(), |(index, _)| index)
}

/// Byte index of the start of the last `count` characters of a text.
fn back(text: &str, count: usize) -> usize {
    if count == 0 { text.len() } else { text.char_indices().rev().nth(count - 1).map_or(0, |(index, _)| index) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn excerpt(text: &str, found: &str) -> (String, String) {
        let start = text.find(found).unwrap();
        let (excerpt, span) = Excerpt::new("f", text, start..start + found.len(), (1, 0));
        (excerpt.text.clone(), excerpt.text[span].to_owned())
    }

    #[test]
    fn short_lines_are_shown_whole_with_those_around_them() {
        assert_eq!(excerpt("a = 1\nb = 2\nc = 3\nd = 4", "2"), ("a = 1\nb = 2\nc = 3".to_owned(), "2".to_owned()));
    }

    #[test]
    fn of_a_long_line_the_part_around_the_mistake_is_shown() {
        let (text, found) = excerpt(&format!("x\n{}é!{}\ny", "a".repeat(70_000), "b".repeat(70_000)), "é!");
        assert!(text.len() < 200, "{text}");
        assert_eq!(found, "é!");
        assert!(text.starts_with("x\n...aaa") && text.ends_with("bbb...\ny"), "{text}");
    }

    #[test]
    fn of_a_long_mistake_the_begin_is_shown() {
        let (text, found) = excerpt(&format!("k = \"{}\"", "é".repeat(40_000)), &"é".repeat(40_000));
        assert!(text.len() < 300 && found.chars().count() == AFTER, "{text}");
    }
}
