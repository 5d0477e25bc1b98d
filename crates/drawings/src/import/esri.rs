//! ESRI shapefiles: the polygons of the main file (`.shp`), and the unit of the `.prj` beside it; `.shx` and `.dbf` are not needed.
//!
//! Layout: ESRI Shapefile Technical Description (1998). The main file is a header of 100 bytes and records, each with its length; it is read here and not by
//! the crate `shapefile`, which allocates by the counts that a record declares and detects holes by orientation alone. Lines, points and patches are counted
//! but not used; z and m are ignored.

use crate::import::drawing::{Drawing, FillRule, Nesting, Outline, Refusal, Unit};
use crate::import::rings;

/// Bytes of the header of the file.
const HEADER: usize = 100;
/// First number of every main file.
const FILE_CODE: i32 = 9994;
/// Bytes of a polygon before its parts: type, box, number of parts, number of points.
const POLYGON_HEAD: usize = 44;

/// Reads the bytes of a main file; `projection` is the text of the `.prj` file, if any.
pub(crate) fn read(bytes: &[u8], projection: Option<&str>) -> Result<Drawing, Vec<Refusal>> {
    let refuse = |location: &str, found: String, expected: &str| {
        vec![Refusal { location: location.into(), found, expected: expected.into() }]
    };
    let unit = match projection.map(unit_of) {
        None => None,
        Some(Ok(unit)) => Some(unit),
        Some(Err(found)) => return Err(refuse("file .prj", found, PROJECTED)),
    };
    if bytes.len() < HEADER || big(bytes, 0) != Some(FILE_CODE) {
        let found = format!("{} bytes with another beginning", bytes.len());
        return Err(refuse(
            "byte 0",
            found,
            "the main file (.shp) of a shapefile: a header of 100 bytes with the code 9994",
        ));
    }
    let (mut drawing, mut bad) = (Drawing { unit, nesting: Nesting::Apart, ..Drawing::default() }, Vec::new());
    let mut at = HEADER;
    let mut number = 0_usize;
    while at < bytes.len() {
        number += 1;
        let location = format!("record {number}");
        // Lengths are counted in words of 2 bytes.
        let length = big(bytes, at + 4).and_then(|words| usize::try_from(words).ok()).map(|words| 2 * words);
        let content = length.and_then(|length| bytes.get(at + 8..(at + 8).checked_add(length)?));
        let Some(content) = content else {
            let found = match length {
                Some(length) => {
                    format!("a length of {length} bytes, of which {} are there", bytes.len().saturating_sub(at + 8))
                }
                None => "no length".into(),
            };
            bad.push(Refusal { location, found, expected: "a complete record: the file is truncated".into() });
            break;
        };
        at += 8 + content.len();
        match record(content, &mut drawing) {
            Ok(Some(outline)) => drawing.add(outline, location),
            Ok(None) => {}
            Err((found, expected)) => bad.push(Refusal { location, found, expected }),
        }
    }
    if bad.is_empty() && drawing.entities.is_empty() {
        return Err(refuse("file", format!("no polygon in {number} records"), "a shapefile of polygons"));
    }
    if bad.is_empty() { Ok(drawing) } else { Err(bad) }
}

fn record(content: &[u8], drawing: &mut Drawing) -> Result<Option<Outline>, (String, String)> {
    match little(content, 0) {
        Some(0) => drawing.count("empty records", 1),
        Some(1 | 8 | 11 | 18 | 21 | 28) => drawing.count("points", 1),
        Some(3 | 13 | 23) => drawing.count("lines", 1),
        Some(31) => drawing.count("multipatches", 1),
        Some(5 | 15 | 25) => return polygon(content).map(Some),
        found => {
            let found = found.map_or("no type".to_owned(), |kind| format!("the type {kind}"));
            return Err((found, "a polygon: type 5, 15 or 25".into()));
        }
    }
    Ok(None)
}

fn polygon(content: &[u8]) -> Result<Outline, (String, String)> {
    let counts = [36, 40].map(|at| little(content, at).and_then(|count| usize::try_from(count).ok()));
    let [Some(parts), Some(points)] = counts else {
        return Err(("no numbers of parts and points".into(), "counts of at least 0".into()));
    };
    // A part takes 4 bytes and a point 16.
    let needed = parts.saturating_mul(4).saturating_add(points.saturating_mul(16)).saturating_add(POLYGON_HEAD);
    if needed > content.len() {
        let found = format!("{parts} parts and {points} points in {} bytes", content.len());
        return Err((found, format!("{needed} bytes for these")));
    }
    let first = |part: usize| little(content, POLYGON_HEAD + 4 * part).and_then(|first| usize::try_from(first).ok());
    let mut found = Vec::new();
    for part in 0..parts {
        let end = if part + 1 < parts { first(part + 1) } else { Some(points) };
        let range = first(part).zip(end).filter(|(from, to)| from <= to && *to <= points);
        let Some((from, to)) = range else {
            return Err((
                format!("part {part} with points beyond the {points} of the record"),
                "parts in order".into(),
            ));
        };
        let base = POLYGON_HEAD + 4 * parts;
        let line: Option<Vec<[f64; 2]>> =
            (from..to).map(|i| Some([number(content, base + 16 * i)?, number(content, base + 16 * i + 8)?])).collect();
        match rings::of_closed_line(&line.unwrap_or_default()) {
            Ok(ring) => found.push(ring),
            Err((what, expected)) => return Err((format!("part {part}: {what}"), expected)),
        }
    }
    if found.is_empty() {
        return Err(("a polygon without parts".into(), "at least one ring".into()));
    }
    Ok(Outline::Area { rings: found, rule: FillRule::EvenOdd })
}

fn bytes_at<const N: usize>(bytes: &[u8], at: usize) -> Option<[u8; N]> {
    bytes.get(at..at.checked_add(N)?)?.try_into().ok()
}

fn big(bytes: &[u8], at: usize) -> Option<i32> {
    bytes_at(bytes, at).map(i32::from_be_bytes)
}

fn little(bytes: &[u8], at: usize) -> Option<i32> {
    bytes_at(bytes, at).map(i32::from_le_bytes)
}

fn number(bytes: &[u8], at: usize) -> Option<f64> {
    bytes_at(bytes, at).map(f64::from_le_bytes)
}

const PROJECTED: &str =
    "a projected system (PROJCS) with a unit of length: project the shapes, or remove the .prj and give `unit`";

/// The unit of a coordinate system in well-known text: the last `UNIT` (or `LENGTHUNIT`) of a projected or local system, since that of its geographic base,
/// an angle, comes before. Of a compound system it is that of its horizontal part.
fn unit_of(projection: &str) -> Result<Unit, String> {
    let text = horizontal(projection.trim());
    let kind: String = text.chars().take_while(|c| c.is_alphanumeric()).collect::<String>().to_ascii_uppercase();
    if matches!(kind.as_str(), "GEOGCS" | "GEOGCRS" | "GEODCRS" | "GEODETICCRS" | "GEOGRAPHICCRS") {
        return Err(format!("a geographic system in degrees, {}", name_of(text)));
    }
    let upper = text.to_ascii_uppercase();
    let at = upper.rfind("LENGTHUNIT[").map(|at| at + "LENGTHUNIT[".len());
    let last = at.or_else(|| upper.rfind("UNIT[").map(|at| at + "UNIT[".len()));
    let found = last.and_then(|at| {
        let inner = text.get(at..)?.split(']').next()?;
        let mut words = inner.split(',').map(|word| word.trim().trim_matches('"'));
        let (name, meters) = (words.next()?, words.next()?.parse::<f64>().ok()?);
        (meters.is_finite() && meters > 0.0).then(|| Unit { name: name.to_owned(), meters })
    });
    found.ok_or_else(|| format!("{} without a unit of length", name_of(text)))
}

/// The first part of a compound system, which is the horizontal one (OGC 01-009, ISO 19162); another system as it is.
fn horizontal(text: &str) -> &str {
    let is_compound = ["COMPD_CS", "COMPOUNDCRS"]
        .iter()
        .any(|kind| text.get(..kind.len()).is_some_and(|start| start.eq_ignore_ascii_case(kind)));
    if !is_compound {
        return text;
    }
    let (mut depth, mut is_quoted, mut start) = (0, false, None);
    for (at, c) in text.char_indices() {
        match c {
            '"' => is_quoted = !is_quoted,
            _ if is_quoted => {}
            '[' | '(' => depth += 1,
            ']' | ')' => depth -= 1,
            ',' if depth == 1 && start.is_some() => return text.get(start.unwrap_or(0)..at).unwrap_or(text).trim(),
            // After the name.
            ',' if depth == 1 => start = Some(at + 1),
            _ => {}
        }
    }
    start.and_then(|start| text.get(start..)).unwrap_or(text).trim()
}

/// Kind and name of a coordinate system, for messages.
fn name_of(text: &str) -> String {
    crate::import::text::quoted(text.split(',').next().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    const WGS84: &str = r#"GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]]"#;

    #[test]
    fn the_unit_is_that_of_the_projection_and_degrees_are_refused() {
        let projected = |unit: &str| {
            format!(r#"PROJCS["x",{WGS84},PROJECTION["Transverse_Mercator"],PARAMETER["a",0.0],UNIT[{unit}]]"#)
        };
        assert_eq!(unit_of(&projected(r#""Meter",1.0"#)), Ok(Unit { name: "Meter".into(), meters: 1.0 }));
        assert_eq!(unit_of(&projected(r#""Foot_US", 0.3048006096012192"#)).unwrap().meters, 0.304_800_609_601_219_2);
        assert!(unit_of(WGS84).unwrap_err().contains("degrees"));
        assert!(unit_of("LOCAL_CS[\"chip\"]").unwrap_err().contains("chip"));
        assert_eq!(unit_of("LOCAL_CS[\"chip\",UNIT[\"mm\",0.001]]").unwrap().meters, 1e-3);
        assert!(read(&[0; 200], Some(WGS84)).unwrap_err()[0].location.contains(".prj"));
    }

    #[test]
    fn a_compound_system_has_the_unit_of_its_horizontal_part() {
        let vertical = r#"VERT_CS["height",VERT_DATUM["d",2005],UNIT["metre",1],AXIS["up",UP]]"#;
        let feet = format!(r#"PROJCS["x, (ftUS)",{WGS84},PROJECTION["p"],UNIT["US survey foot",0.304800609601219]]"#);
        let of = |horizontal: &str| unit_of(&format!(r#"COMPD_CS["x, (ftUS) + height",{horizontal},{vertical}]"#));
        assert_eq!(of(&feet).unwrap().name, "US survey foot");
        assert!(of(WGS84).unwrap_err().contains("degrees"));
    }

    #[test]
    fn counts_beyond_the_bytes_are_refused_before_anything_is_allocated() {
        let mut bytes = vec![0; HEADER];
        bytes[..4].copy_from_slice(&FILE_CODE.to_be_bytes());
        let mut record = vec![0; POLYGON_HEAD];
        record[0] = 5;
        record[36..40].copy_from_slice(&1_i32.to_le_bytes());
        record[40..44].copy_from_slice(&1_000_000_000_i32.to_le_bytes());
        bytes.extend(1_i32.to_be_bytes());
        bytes.extend((record.len() as i32 / 2).to_be_bytes());
        bytes.extend(&record);
        let bad = read(&bytes, None).unwrap_err();
        assert!(bad[0].location == "record 1" && bad[0].found.contains("1000000000 points"), "{}", bad[0]);
        bytes.truncate(120);
        assert!(read(&bytes, None).unwrap_err()[0].expected.contains("truncated"));
    }
}
