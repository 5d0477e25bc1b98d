//! Lists of discs: `x y r` per line, separated by spaces, tabs, commas or semicolons. A header names columns and unit, and permits other orders and longer
//! lines.
//!
//! `columns` selects x, y and radius in longer lines, and `separator` sets a single separating character, so that empty columns and names with spaces keep
//! their positions. With `diameters` the third number is a diameter; a header that names a diameter requires it.

use crate::import::drawing::{Drawing, Outline, Refusal};
use crate::import::header::{Header, cells};
use crate::import::options::Options;
use crate::import::text::{Lines, at_line, words};
use meniscus_core::math::Vec2;

const EXPECTED: &str = "three numbers `x y r`, the radius above 0, separated by spaces, tabs, commas or semicolons";

/// Reads the text of a list of discs.
pub(crate) fn read(text: &str, options: &Options) -> Result<Drawing, Vec<Refusal>> {
    let (mut drawing, mut lines) = (Drawing { is_in_meters: true, ..Drawing::default() }, Lines::default());
    let mut header: Option<Header> = None;
    let mut may_be_header = true;
    for (line, row) in (1..).zip(text.lines()) {
        if lines.take_comment(line, row.trim()) {
            if let Some(found) = Header::of_comment(row.trim(), options).filter(|_| may_be_header) {
                header = taken(found, line, row, options, &mut lines);
            }
            continue;
        }
        let data = row.split('#').next().unwrap_or_default();
        if words(data).next().is_none() {
            continue;
        }
        let names = cells(data.trim(), options.separator);
        let is_header =
            may_be_header && names.iter().all(|name| name.parse::<f64>().is_err()) && !has_number(data, options);
        may_be_header = false;
        if is_header {
            header = taken(Header::of(&names, options), line, row, options, &mut lines);
            continue;
        }
        let numbers = words(data).filter(|word| word.parse::<f64>().is_ok()).count();
        let is_split = options.columns.is_none() && options.separator.is_none();
        if let Some(header) = header.as_ref().filter(|header| is_split && numbers > header.names) {
            lines.refuse(line, row.trim(), more_than_named(numbers, header.names));
            continue;
        }
        let columns = Columns::of(data, options, header.as_ref());
        match columns.disc(options.diameters.unwrap_or(false)) {
            Some(outline) => drawing.add(outline, at_line(line)),
            None => lines.refuse(line, row.trim(), expected(options)),
        }
    }
    if lines.bad.is_empty() && drawing.entities.is_empty() {
        lines.bad.push(Refusal { location: at_line(1), found: "no disc at all".into(), expected: EXPECTED.into() });
    }
    drawing.unit = header.and_then(|header| header.unit);
    drawing.frame = lines.domain;
    if lines.bad.is_empty() { Ok(drawing) } else { Err(lines.bad) }
}

/// Whether the columns of x, y and radius, or any column of other lines, are numbers.
fn has_number(data: &str, options: &Options) -> bool {
    let all: Vec<&str> = match options.separator {
        Some(separator) => data.split(separator).map(str::trim).collect(),
        None => words(data).collect(),
    };
    let is_number = |word: &&str| word.parse::<f64>().is_ok();
    match options.columns {
        Some(columns) => columns.iter().filter_map(|&column| all.get(column)).any(is_number),
        None => all.iter().any(is_number),
    }
}

/// A sufficient header; else `None`, with the line refused.
fn taken(
    header: Result<Header, String>,
    line: usize,
    row: &str,
    options: &Options,
    lines: &mut Lines,
) -> Option<Header> {
    let expected = match header {
        Ok(header) if header.is_diameter && options.diameters.is_none() => {
            "`diameters = true` where the third column holds diameters, `diameters = false` where it holds radii"
                .to_owned()
        }
        Ok(header) => return Some(header),
        Err(expected) => expected,
    };
    lines.refuse(line, row.trim(), expected);
    None
}

/// The columns of a line for x, y and radius; `None` if the line has more than three and none are selected.
struct Columns<'t>(Option<[&'t str; 3]>);

impl<'t> Columns<'t> {
    fn of(data: &'t str, options: &Options, header: Option<&Header>) -> Self {
        let all: Vec<&str> = match options.separator {
            Some(separator) => data.split(separator).map(str::trim).collect(),
            None => words(data).collect(),
        };
        match options.columns.or(header.map(|header| header.columns)) {
            Some([x, y, r]) => Self(all.get(x).zip(all.get(y)).zip(all.get(r)).map(|((x, y), r)| [*x, *y, *r])),
            None => Self(all.try_into().ok()),
        }
    }

    fn disc(&self, is_diameter: bool) -> Option<Outline> {
        let numbers: Vec<f64> = self.0?.iter().map(|word| word.parse()).collect::<Result<_, _>>().ok()?;
        let [x, y, size] = numbers.try_into().ok()?;
        let radius = if is_diameter { 0.5 * size } else { size };
        let is_good = [x, y, radius].iter().all(|v: &f64| v.is_finite()) && radius > 0.0;
        is_good.then_some(Outline::Disc { center: Vec2::new(x, y), radius })
    }
}

fn more_than_named(numbers: usize, names: usize) -> String {
    format!(
        "{names} numbers, one for each name of the header, not {numbers}: a point as decimal sign, and a name for a column of row numbers; or `columns` for the columns of x, y and r"
    )
}

fn expected(options: &Options) -> String {
    match options.columns {
        Some([x, y, r]) => format!("numbers x, y and r > 0 in the columns {x}, {y} and {r}, the first one being 0"),
        None => format!("{EXPECTED}; of longer lines `columns` picks three"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Drawing, Vec<Refusal>> {
        read(text, &Options::default())
    }

    #[test]
    fn all_separators_a_header_and_comments_are_read() {
        let drawing = parse("x,y,r\n# a comment\n0 0 1 # first\n3,0,1\n\t0;3;\t1\n").unwrap();
        assert_eq!(drawing.entities.len(), 3);
        assert_eq!(drawing.entities[0].location, "line 3");
    }

    #[test]
    fn diameters_are_halved_and_a_header_that_names_them_asks() {
        let text = "x,y,Diameter\n0,0,2\n";
        let radius = |diameters: bool| {
            let drawing = read(text, &Options { diameters: Some(diameters), ..Options::default() }).unwrap();
            let Outline::Disc { radius, .. } = drawing.entities[0].outline else { panic!("no disc") };
            radius
        };
        assert_eq!((radius(true), radius(false)), (1.0, 2.0));
        let bad = parse(text).unwrap_err();
        assert_eq!(bad[0].location, "line 1");
        assert!(bad[0].expected.contains("diameters = true"), "{}", bad[0]);
    }

    #[test]
    fn a_domain_comment_sets_the_domain() {
        let frame = parse("# domain -5 -6 7 8\n0 0 1\n").unwrap().frame.unwrap();
        assert_eq!((frame.min, frame.max), (Vec2::new(-5.0, -6.0), Vec2::new(7.0, 8.0)));
    }

    #[test]
    fn all_bad_lines_are_named_at_once_with_their_text() {
        let bad = parse("0 0 1\n1 2\n1 2 -3\n1 2 x\nnan 0 1\n").unwrap_err();
        assert_eq!(bad.iter().map(|b| &b.location[..]).collect::<Vec<_>>(), ["line 2", "line 3", "line 4", "line 5"]);
        assert_eq!(bad[2].found, "`1 2 x`");
    }

    #[test]
    fn columns_are_picked_from_longer_lines_with_a_separator_of_their_own() {
        let options = Options { columns: Some([3, 1, 2]), separator: Some('|'), ..Options::default() };
        let drawing = read("name|y|r|x\npost a|2|0.5|1\n|4|0.25|3\n", &options).unwrap();
        let outlines: Vec<_> = drawing.entities.into_iter().map(|entity| entity.outline).collect();
        let disc = |x, y, radius| Outline::Disc { center: Vec2::new(x, y), radius };
        assert_eq!(outlines, [disc(1.0, 2.0, 0.5), disc(3.0, 4.0, 0.25)]);
        let bad = read("a|b|1|2\n", &Options { columns: Some([0, 2, 9]), ..options }).unwrap_err();
        assert!(bad[0].expected.contains("columns 0, 2 and 9"), "{}", bad[0]);
    }
}
