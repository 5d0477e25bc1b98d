//! Polygons in well-known text: `POLYGON`, `MULTIPOLYGON` and `GEOMETRYCOLLECTION` of these.
//!
//! A file may contain several geometries in sequence, also on one line, with or without a comma or semicolon in between. Separate polygons may overlap: they
//! are united. Points and lines are counted but not used.

use std::str::FromStr;

use wkt::Wkt;

use crate::import::drawing::{Drawing, Nesting, Refusal};
use crate::import::text::{Lines, at_line};

const EXPECTED: &str =
    "POLYGON, MULTIPOLYGON or GEOMETRYCOLLECTION of polygons, such as `POLYGON ((0 0, 1 0, 0 1, 0 0))`";

/// Maximum depth of parentheses of a geometry, including nested collections.
const DEEPEST: i64 = 32;

/// Reads well-known text.
pub(crate) fn read(text: &str) -> Result<Drawing, Vec<Refusal>> {
    let mut lines = Lines::default();
    let mut drawing = Drawing { is_in_meters: true, nesting: Nesting::FirstIsOuter, ..Drawing::default() };
    let mut open = Chunk::default();
    for (line, row) in (1..).zip(text.lines().map(str::trim)) {
        if lines.take_comment(line, row) {
            continue;
        }
        let row = row.split('#').next().unwrap_or_default();
        let bad_number = not_finite(row);
        if let Some(word) = bad_number {
            lines.refuse(line, word, "finite numbers as coordinates".to_owned());
        }
        for c in row.chars().chain([' ']) {
            if open.push(c, line, bad_number.is_none()) {
                std::mem::take(&mut open).end(&mut drawing, &mut lines);
            }
        }
    }
    open.end(&mut drawing, &mut lines);
    if lines.bad.is_empty() && drawing.entities.is_empty() {
        lines.bad.push(Refusal { location: at_line(1), found: "no polygon at all".into(), expected: EXPECTED.into() });
    }
    drawing.frame = lines.domain;
    if lines.bad.is_empty() { Ok(drawing) } else { Err(lines.bad) }
}

/// The first number of a row that is not finite and looks like a word, such as `nan`.
fn not_finite(row: &str) -> Option<&str> {
    let mut words = row.split(|c: char| c.is_whitespace() || "(),".contains(c));
    words.find(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()) && word.parse::<f64>().is_ok())
}

/// A partially read geometry.
#[derive(Default)]
struct Chunk {
    text: String,
    /// The line of its start.
    line: usize,
    depth: i64,
    deepest: i64,
    has_bad_number: bool,
}

impl Chunk {
    /// Adds one more character; true if it completes the geometry: at its closing parenthesis, after `EMPTY`, and at a comma or semicolon between geometries.
    fn push(&mut self, c: char, line: usize, is_finite: bool) -> bool {
        let is_between = self.depth == 0 && (c.is_whitespace() || ",;".contains(c));
        if is_between && self.text.is_empty() {
            return false;
        }
        if self.text.is_empty() {
            self.line = line;
        }
        let ends_empty = is_between && {
            let word = self.text.split_whitespace().next_back();
            word.is_some_and(|word| word.eq_ignore_ascii_case("empty"))
        };
        if ends_empty || (is_between && !c.is_whitespace()) {
            return true;
        }
        self.text.push(c);
        self.has_bad_number |= !is_finite;
        self.depth += i64::from(c == '(') - i64::from(c == ')');
        self.deepest = self.deepest.max(self.depth);
        c == ')' && self.depth <= 0
    }

    fn end(self, drawing: &mut Drawing, lines: &mut Lines) {
        if !self.text.trim().is_empty() && !self.has_bad_number {
            take(&self.text, self.line, self.deepest, drawing, lines);
        }
    }
}

fn take(chunk: &str, line: usize, depth: i64, drawing: &mut Drawing, lines: &mut Lines) {
    if depth > DEEPEST {
        lines.refuse(line, chunk.trim(), format!("parentheses at most {DEEPEST} deep, not {depth}"));
        return;
    }
    match Wkt::<f64>::from_str(chunk) {
        Err(reason) => lines.refuse(line, chunk.trim(), format!("{EXPECTED} ({reason})")),
        Ok(geometry) => collect(&geometry, line, drawing, lines),
    }
}

fn collect(geometry: &Wkt<f64>, line: usize, drawing: &mut Drawing, lines: &mut Lines) {
    match geometry {
        Wkt::Polygon(polygon) => add(polygon, line, drawing, lines),
        Wkt::MultiPolygon(many) => many.polygons().iter().for_each(|polygon| add(polygon, line, drawing, lines)),
        Wkt::GeometryCollection(many) => {
            many.geometries().iter().for_each(|one| collect(one, line, drawing, lines));
        }
        Wkt::Point(_) => drawing.count("points", 1),
        Wkt::MultiPoint(many) => drawing.count("points", many.points().len()),
        Wkt::LineString(_) => drawing.count("lines", 1),
        Wkt::MultiLineString(many) => drawing.count("lines", many.line_strings().len()),
    }
}

fn add(polygon: &wkt::types::Polygon<f64>, line: usize, drawing: &mut Drawing, lines: &mut Lines) {
    let points = |ring: &wkt::types::LineString<f64>| Some(ring.coords().iter().map(|c| [c.x, c.y]).collect());
    lines.bad.extend(drawing.add_polygon(polygon.rings().iter().map(points).collect(), &at_line(line)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn collections_over_several_lines_and_a_domain_are_read() {
        let text = "# domain -1 -1 9 9\nPOLYGON EMPTY\nGEOMETRYCOLLECTION (\n POLYGON ((0 0, 1 0, 0 1, 0 0)), POINT (1 2),\n\
                    MULTIPOLYGON (((3 3, 4 3, 3 4, 3 3)), ((6 6, 7 6, 6 7, 6 6))))\nPOLYGON ((0 5, 1 5, 0 6, 0 5))\n";
        let drawing = read(text).unwrap();
        assert_eq!(drawing.entities.len(), 4);
        assert_eq!(drawing.entities[3].location, "line 6");
        assert_eq!(drawing.frame.unwrap().max.x, 9.0);
        assert_eq!(drawing.unused["points"], 1);
    }

    #[test]
    fn every_geometry_of_a_line_is_read_or_refused_whatever_stands_between() {
        let (a, b) = ("POLYGON ((0 0, 1 0, 0 1, 0 0))", "POLYGON((3 3, 4 3, 3 4, 3 3))");
        for between in
            [" ", "", ";", " ; ", ",", ", ", "\n", "\t", ";\n", " POINT (1 2) ", " POLYGON EMPTY; ", " # note\n"]
        {
            let drawing = read(&format!("{a}{between}{b};")).unwrap();
            assert_eq!(drawing.entities.len(), 2, "{between:?}");
        }
        for bad in [
            "MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0))), ((3 3, 4 3, 3 4, 3 3)))",
            "POLYGON ((0 0, 1 0, 0 1, 0 0)) and more",
        ] {
            assert_eq!(read(bad).unwrap_err()[0].location, "line 1", "{bad}");
        }
    }

    #[test]
    fn open_rings_and_files_without_polygons_are_refused_with_their_line() {
        let bad = read("\nPOLYGON ((0 0, 1 0, 0 1))\nPOLYGON ((0 0, 1 0, nan 1, 0 0))\nPOLYGON 3\n").unwrap_err();
        assert_eq!(bad.iter().map(|b| b.location.as_str()).collect::<Vec<_>>(), ["line 2", "line 3", "line 4"]);
        assert!(bad[0].expected.contains("first point"), "{}", bad[0]);
        assert_eq!((bad[1].found.as_str(), bad[1].expected.as_str()), ("`nan`", "finite numbers as coordinates"));
        assert_eq!(read("POINT (1 2)").unwrap_err()[0].found, "no polygon at all");
    }

    #[test]
    fn nested_collections_do_not_exhaust_the_stack() {
        let text = format!("{}POINT (1 2){}", "GEOMETRYCOLLECTION (".repeat(100_000), ")".repeat(100_000));
        assert!(read(&text).unwrap_err()[0].expected.contains("32 deep"));
    }
}
