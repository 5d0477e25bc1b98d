//! Polygons in well-known text: `POLYGON`, `MULTIPOLYGON` and `GEOMETRYCOLLECTION` of these, coordinates in m.
//!
//! Rings repeat their first point at the end, as the standard wants. It does not fix their direction: rings are turned here.
//! A file may hold several geometries one after the other. Separate polygons may overlap: they are united.

use std::str::FromStr;

use wkt::Wkt;

use crate::geometry::shape_lines::{LineProblem, Notes, around};
use crate::geometry::spec::{GeometrySpec, Polygon, ShapeSpec};
use crate::geometry::validate::ring_area;

const EXPECTED: &str =
    "POLYGON, MULTIPOLYGON or GEOMETRYCOLLECTION of polygons, such as `POLYGON ((0 0, 1 0, 0 1, 0 0))`";

/// Reads well-known text.
pub(crate) fn parse(text: &str) -> Result<GeometrySpec, Vec<LineProblem>> {
    let (mut polygons, mut notes) = (Vec::new(), Notes::default());
    let (mut chunk, mut first, mut depth) = (String::new(), 1, 0_i64);
    for (line, row) in (1..).zip(text.lines().map(str::trim)) {
        if notes.take_comment(line, row) {
            continue;
        }
        if row.is_empty() {
            continue;
        }
        if chunk.is_empty() {
            first = line;
        }
        chunk.push_str(row);
        chunk.push(' ');
        depth += row.chars().map(|c| i64::from(c == '(') - i64::from(c == ')')).sum::<i64>();
        // A geometry ends where its parentheses close; a bare keyword goes on on the next line.
        if depth <= 0 && chunk.contains('(') {
            read(&chunk, first, &mut polygons, &mut notes);
            chunk.clear();
            depth = 0;
        }
    }
    if !chunk.is_empty() {
        read(&chunk, first, &mut polygons, &mut notes);
    }
    let around = around(polygons.iter().flat_map(|polygon| &polygon.outer).map(|&[x, y]| [x, y, x, y]));
    notes.finish(polygons.into_iter().map(ShapeSpec::Polygon).collect(), around, ("no polygon at all", EXPECTED))
}

fn read(chunk: &str, line: usize, polygons: &mut Vec<Polygon>, notes: &mut Notes) {
    let mut refuse = |expected: String| notes.refuse(line, chunk.trim(), expected);
    match Wkt::<f64>::from_str(chunk) {
        Err(reason) => refuse(format!("{EXPECTED} ({reason})")),
        Ok(geometry) => collect(&geometry, polygons, &mut refuse),
    }
}

fn collect(geometry: &Wkt<f64>, polygons: &mut Vec<Polygon>, refuse: &mut impl FnMut(String)) {
    let mut take = |polygon: &wkt::types::Polygon<f64>| match convert(polygon) {
        Ok(Some(polygon)) => polygons.push(polygon),
        Ok(None) => {}
        Err(expected) => refuse(expected),
    };
    match geometry {
        Wkt::Polygon(polygon) => take(polygon),
        Wkt::MultiPolygon(many) => many.polygons().iter().for_each(take),
        Wkt::GeometryCollection(many) => many.geometries().iter().for_each(|one| collect(one, polygons, refuse)),
        _ => refuse(EXPECTED.to_owned()),
    }
}

/// The polygon with open, turned rings; nothing for an empty one.
fn convert(polygon: &wkt::types::Polygon<f64>) -> Result<Option<Polygon>, String> {
    let mut rings = Vec::new();
    for (k, ring) in polygon.rings().iter().enumerate() {
        let mut points: Vec<[f64; 2]> = ring.coords().iter().map(|c| [c.x, c.y]).collect();
        if points.len() < 4 || points.first() != points.last() {
            let [x, y] = points.first().copied().unwrap_or_default();
            return Err(format!(
                "a closed ring of three points or more: ring {k} must end in its first point ({x:e} {y:e})"
            ));
        }
        points.pop();
        if (ring_area(&points) > 0.0) != (k == 0) {
            points.reverse();
        }
        rings.push(points);
    }
    let mut rings = rings.into_iter();
    Ok(rings.next().map(|outer| Polygon { outer, holes: rings.collect(), position: [0.0; 2], rotation_deg: 0.0 }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_are_opened_and_turned() {
        let spec = parse("POLYGON ((0 0, 0 4, 4 4, 4 0, 0 0), (1 1, 2 1, 2 2, 1 2, 1 1))").unwrap();
        let ShapeSpec::Polygon(polygon) = &spec.shapes[0] else { panic!("no polygon") };
        assert_eq!(polygon.outer.len(), 4);
        assert!(ring_area(&polygon.outer) > 0.0 && ring_area(&polygon.holes[0]) < 0.0);
        assert!(ShapeSpec::Polygon(polygon.clone()).problems("shapes[0]").is_empty());
    }

    #[test]
    fn collections_over_several_lines_and_a_domain_are_read() {
        let text = "# domain -1 -1 9 9\nGEOMETRYCOLLECTION (\n POLYGON ((0 0, 1 0, 0 1, 0 0)),\n\
                    MULTIPOLYGON (((3 3, 4 3, 3 4, 3 3)), ((6 6, 7 6, 6 7, 6 6))))\nPOLYGON ((0 5, 1 5, 0 6, 0 5))\n";
        let spec = parse(text).unwrap();
        assert_eq!(spec.shapes.len(), 4);
        assert_eq!(spec.max, [9.0, 9.0]);
    }

    #[test]
    fn open_rings_and_points_are_refused_with_their_line() {
        let bad = parse("POLYGON ((0 0, 1 0, 0 1))\nPOINT (1 2)\n").unwrap_err();
        assert_eq!(bad.iter().map(|b| b.line).collect::<Vec<_>>(), [1, 2]);
    }
}
