//! The legend beside a drawing: names in as many columns as they need, none cut or over another, and the bar of a scale of colors.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axes::DrawingError;
use super::cells::hatching;
use super::shade::Scale;
use super::ticks::{short, ticks};

/// Top and lower margin in pixels.
const TOP: i32 = 48;
const BOTTOM: i32 = 20;
/// Size of letters and height of a line in pixels: for a single column, and for several.
const LARGE: (i32, i32) = (14, 20);
const SMALL: (i32, i32) = (12, 16);
/// Width of a letter over its size, an estimate that is seldom too small.
const LETTER: f64 = 0.6;
/// Longest line of letters; longer names are broken between words.
const LONGEST: usize = 36;
/// Width of a sign with the space to its name, and the space after a column, in pixels.
const SIGN: i32 = 26;
const AFTER: i32 = 14;
/// Width of the bar, with the space to its numbers, in pixels.
const BAR: i32 = 24;
/// Most lines of names below a bar; others are beside it.
const BELOW: usize = 6;
/// Most columns of names; for more of them the legend is higher than the drawing, by steps in pixels.
const COLUMNS: usize = 3;
const HIGHER: i32 = 40;

/// What stands before a name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sign {
    /// Nothing, above all names: what they give.
    Heading,
    /// A line.
    Line(RGBColor),
    /// A hatched cell.
    Hatched,
    /// A ring.
    Ring,
}

/// A scale of colors and what it shows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bar {
    /// The quantity with its unit.
    pub(super) label: String,
    /// The scale.
    pub(super) scale: Scale,
}

/// An entry in its place.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    sign: Sign,
    lines: Vec<String>,
    /// Left edge and middle of the first line in pixels.
    at: (i32, i32),
}

/// A legend, laid out.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Legend {
    entries: Vec<Entry>,
    letters: (i32, i32),
    /// The bar with its top and bottom in pixels, and the lines of its label.
    bar: Option<(Bar, [i32; 2], Vec<String>)>,
    /// Its width and height in pixels; 0 wide if there is none.
    pub(super) size: (u32, u32),
}

/// The estimated width of a text in pixels.
pub(super) fn text_width(text: &str, size: i32) -> i32 {
    (LETTER * f64::from(size) * text.chars().count() as f64).ceil() as i32
}

/// A text in lines of at most so many letters, broken between words.
pub(super) fn wrapped(text: &str, longest: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= longest => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

impl Legend {
    /// The legend of a drawing of a height in pixels.
    pub(super) fn new(names: &[(String, Sign)], bar: Option<Bar>, height: u32) -> Self {
        let height = height as i32;
        let names: Vec<(Vec<String>, Sign)> =
            names.iter().map(|(name, sign)| (wrapped(name, LONGEST), *sign)).collect();
        let count: usize = names.iter().map(|(lines, _)| lines.len()).sum();
        let below = bar.is_some() && count <= BELOW;
        let rows = |line: i32| ((height - TOP - BOTTOM) / line) as usize;
        let letters = if count <= rows(LARGE.1) { LARGE } else { SMALL };
        let bar = bar.map(|bar| {
            let label = wrapped(&bar.label, LONGEST);
            let top = TOP + LARGE.1 * label.len() as i32;
            let foot = if below { LARGE.1 * (count as i32 + 1) } else { LARGE.1 };
            (bar, [top, height - BOTTOM - foot], label)
        });
        let width_of_bar = bar.as_ref().map_or(0, |(bar, _, label)| {
            let numbers = ticks(&bar.scale.range, bar.scale.logarithmic).into_iter().map(short);
            let numbers = numbers.map(|number| BAR + 8 + text_width(&number, LARGE.0)).max().unwrap_or(0);
            numbers.max(widest(label, LARGE.0)) + AFTER
        });
        let first = match &bar {
            Some((_, [_, end], _)) if below => (0, end + 3 * LARGE.1 / 2),
            _ => (width_of_bar, TOP),
        };
        let mut bottom = height - BOTTOM;
        let mut columns = in_columns(&names, first, letters, bottom);
        while columns.count > COLUMNS {
            bottom += HIGHER;
            columns = in_columns(&names, first, letters, bottom);
        }
        let width = columns.right.max(width_of_bar).max(0) as u32;
        Self { entries: columns.entries, letters, bar, size: (width, (bottom + BOTTOM).max(0) as u32) }
    }

    /// Draws it.
    pub(super) fn draw<'a>(&self, area: &DrawingArea<SVGBackend<'a>, Shift>) -> Result<(), DrawingError<'a>> {
        let (size, line) = self.letters;
        let left = |size: i32| ("sans-serif", size).into_text_style(area).pos(Pos::new(HPos::Left, VPos::Center));
        for entry in &self.entries {
            let Entry { sign, lines, at: (x, y) } = entry;
            match sign {
                Sign::Heading => {}
                Sign::Line(color) => area.draw(&PathElement::new([(*x, *y), (x + 18, *y)], color.stroke_width(2)))?,
                Sign::Ring => area.draw(&Circle::new((x + 9, *y), 4, BLACK.stroke_width(1)))?,
                Sign::Hatched => draw_hatched(area, [(*x, y - 7), (x + 18, y + 7)])?,
            }
            for (number, text) in lines.iter().enumerate() {
                area.draw(&Text::new(text.as_str(), (x + entry.indent(), y + line * number as i32), left(size)))?;
            }
        }
        let Some((Bar { scale, .. }, [top, bottom], label)) = &self.bar else { return Ok(()) };
        for (number, text) in label.iter().enumerate() {
            let y = top - LARGE.1 * (label.len() - number) as i32 + LARGE.1 / 4;
            area.draw(&Text::new(text.as_str(), (0, y), left(LARGE.0)))?;
        }
        let y = |fraction: f64| bottom - (fraction * f64::from(bottom - top)).round() as i32;
        for step in 0..Scale::STEPS {
            let [from, to] = [step, step + 1].map(|step| y(step as f64 / Scale::STEPS as f64));
            area.draw(&Rectangle::new([(0, to), (BAR, from)], scale.color_of_step(step).filled()))?;
        }
        area.draw(&Rectangle::new([(0, *top), (BAR, *bottom)], BLACK.stroke_width(1)))?;
        for tick in ticks(&scale.range, scale.logarithmic) {
            let y = y(scale.fraction(tick));
            area.draw(&PathElement::new([(BAR, y), (BAR + 4, y)], BLACK.stroke_width(1)))?;
            area.draw(&Text::new(short(tick), (BAR + 8, y), left(LARGE.0)))?;
        }
        Ok(())
    }
}

fn widest(lines: &[String], size: i32) -> i32 {
    lines.iter().map(|line| text_width(line, size)).max().unwrap_or(0)
}

/// Entries in columns, their number, and the right edge of the last one.
struct Columns {
    entries: Vec<Entry>,
    count: usize,
    right: i32,
}

/// Entries in columns from a first place down to `bottom`.
fn in_columns(
    names: &[(Vec<String>, Sign)],
    (left, top): (i32, i32),
    (size, line): (i32, i32),
    bottom: i32,
) -> Columns {
    let (mut at, mut columns) = ((left, top), Columns { entries: Vec::new(), count: 1, right: left });
    for (lines, sign) in names {
        let height = line * lines.len() as i32;
        if at.1 + height > bottom && at.1 > top {
            at = (columns.right, top);
            columns.count += 1;
        }
        let entry = Entry { sign: *sign, lines: lines.clone(), at };
        columns.right = columns.right.max(at.0 + entry.indent() + widest(lines, size) + AFTER);
        columns.entries.push(entry);
        at.1 += height;
    }
    columns
}

impl Entry {
    /// Distance of its letters from its left edge in pixels.
    fn indent(&self) -> i32 {
        if self.sign == Sign::Heading { 0 } else { SIGN }
    }
}

/// A hatched rectangle of pixels.
pub(super) fn draw_hatched<'a>(
    area: &DrawingArea<SVGBackend<'a>, Shift>,
    corners: [(i32, i32); 2],
) -> Result<(), DrawingError<'a>> {
    const GRAY: RGBColor = RGBColor(150, 150, 150);
    for line in hatching(corners) {
        area.draw(&PathElement::new(line, GRAY.stroke_width(1)))?;
    }
    area.draw(&Rectangle::new(corners, GRAY.stroke_width(1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::diagram::Axis;

    #[test]
    fn from_1_to_60_names_all_fit_and_none_lies_on_another() {
        let name = |k: usize| match k % 3 {
            0 => format!("contact angle = {k} degrees"),
            1 => format!("contact angle = {k} degrees, tension = 0.03 N/m, films = rings"),
            _ => format!("{}-{k}", "a-name-of-a-case-without-any-space-in-it"),
        };
        for count in 1..=60 {
            let names: Vec<(String, Sign)> = (0..count).map(|k| (name(k), Sign::Line(BLACK))).collect();
            let legend = Legend::new(&names, None, 480);
            let ((size, line), (width, height)) = (legend.letters, legend.size);
            let boxes: Vec<[i32; 4]> = legend
                .entries
                .iter()
                .map(|entry| {
                    let (x, y) = (entry.at.0, entry.at.1 - line / 2);
                    [x, y, x + entry.indent() + widest(&entry.lines, size), y + line * entry.lines.len() as i32]
                })
                .collect();
            assert_eq!(boxes.len(), count);
            let lefts: std::collections::BTreeSet<i32> = boxes.iter().map(|corners| corners[0]).collect();
            assert!(lefts.len() <= COLUMNS);
            let whole = |k: usize| legend.entries[k].lines.join(" ") == name(k);
            assert!((0..count).all(whole));
            assert!(
                boxes.iter().all(|b| b[0] >= 0 && b[1] >= 0 && b[2] <= width as i32 && b[3] <= height as i32),
                "{boxes:?}"
            );
            let apart = |a: &[i32; 4], b: &[i32; 4]| a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1];
            for (k, one) in boxes.iter().enumerate() {
                assert!(boxes[..k].iter().all(|other| apart(one, other)), "{count} names: {boxes:?}");
            }
        }
        assert_eq!(Legend::new(&[], None, 480).size, (0, 480));
        let heading = Legend::new(&[("angle".to_owned(), Sign::Heading), ("60".to_owned(), Sign::Ring)], None, 480);
        assert_eq!(heading.entries.iter().map(Entry::indent).collect::<Vec<_>>(), [0, SIGN]);
    }

    #[test]
    fn names_are_below_a_bar_and_within_the_drawing() {
        let scale = Scale::of(&Axis::linear(""), &[0.0, 12000.0], false).unwrap();
        let bar = Some(Bar { label: "capillary pressure at breakthrough of the first phase (Pa)".into(), scale });
        let names = [("no value".to_owned(), Sign::Hatched), ("not at rest".to_owned(), Sign::Ring)];
        let legend = Legend::new(&names, bar, 480);
        let (_, [top, bottom], label) = legend.bar.as_ref().unwrap();
        assert_eq!(label.len(), 2);
        assert!(*top >= 80 && legend.entries[0].at.1 > bottom + 10 && legend.entries[1].at.1 < 470, "{legend:?}");
        assert!(widest(label, LARGE.0) <= legend.size.0 as i32);
    }
}
