//! Reads the files of this module back, for movies: points, cells and named arrays on the points.
//!
//! vtkio 0.7.0-rc2 reads none of the compressed ones. The layout is that in [`document`](super::document).

use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use roxmltree::{Document, Node};

use super::Compression;
use super::document::{BLOCK, HEADER};
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::{Cloud, Field, Lines};

/// Why a file cannot be read, with a remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}; it is damaged or not a file of meniscus: run the case again")]
pub struct ReadError(String);

fn refuse<T>(what: impl Into<String>) -> Result<T, ReadError> {
    Err(ReadError(what.into()))
}

/// Points with those of the arrays `wanted` that the file has: numbers and integers.
///
/// # Errors
/// [`ReadError`].
pub fn points(bytes: &[u8], wanted: &[&'static str]) -> Result<Cloud<'static>, ReadError> {
    let text = text(bytes)?;
    let (document, compression) = opened(text)?;
    let points = coordinates(&document, compression)?;
    let mut fields = Vec::new();
    for &name in wanted {
        let Some(array) = named(&document, "PointData", name) else { continue };
        let data = bytes_of(array, compression)?;
        let field = match array.attribute("type") {
            Some("Float64") => Field::scalar(name, "", numbers(&data, f64::from_le_bytes)),
            Some("Int64") => Field::integer(name, numbers(&data, i64::from_le_bytes)),
            other => return refuse(format!("the array {name} has the type {}", other.unwrap_or("none"))),
        };
        if data.len() != points.len() * size_of::<f64>() {
            return refuse(format!("the array {name} has not one number per point"));
        }
        fields.push(field);
    }
    Ok(Cloud { points: points.into(), fields })
}

/// Polylines, joined from their segments.
///
/// # Errors
/// [`ReadError`].
pub fn lines(bytes: &[u8]) -> Result<Lines<'static>, ReadError> {
    let text = text(bytes)?;
    let (document, compression) = opened(text)?;
    let points = coordinates(&document, compression)?;
    let Some(array) = named(&document, "Cells", "connectivity") else { return refuse("it has no cells") };
    let ends: Vec<i64> = numbers(&bytes_of(array, compression)?, i64::from_le_bytes).collect();
    let mut lines: Vec<Vec<u32>> = Vec::new();
    for segment in ends.chunks(2) {
        let index = |end: &i64| u32::try_from(*end).ok().filter(|&index| (index as usize) < points.len());
        let [Some(from), Some(to)] = [segment.first(), segment.last()].map(|end| end.and_then(index)) else {
            return refuse("a segment has a point that does not exist");
        };
        match lines.last_mut() {
            Some(line) if line.last() == Some(&from) => line.push(to),
            _ => lines.push(vec![from, to]),
        }
    }
    Ok(Lines { points: points.into(), lines, fields: Vec::new() })
}

fn text(bytes: &[u8]) -> Result<&str, ReadError> {
    str::from_utf8(bytes).or_else(|_| refuse("it is not text"))
}

/// The document and the compression of its arrays.
fn opened(text: &str) -> Result<(Document<'_>, Compression), ReadError> {
    let document = Document::parse(text).or_else(|error| refuse(format!("it is not XML: {error}")))?;
    let compression = match document.root_element().attribute("compressor") {
        None => Compression::None,
        Some("vtkZLibDataCompressor") => Compression::Zlib,
        Some("vtkLZ4DataCompressor") => Compression::Lz4,
        Some(other) => return refuse(format!("its arrays are compressed by {other}")),
    };
    Ok((document, compression))
}

/// The array of this name below an element.
fn named<'a, 'input>(document: &'a Document<'input>, element: &str, name: &str) -> Option<Node<'a, 'input>> {
    let parent = document.descendants().find(|node| node.has_tag_name(element))?;
    parent.children().find(|node| node.has_tag_name("DataArray") && node.attribute("Name") == Some(name))
}

fn coordinates(document: &Document<'_>, compression: Compression) -> Result<Vec<Vec2>, ReadError> {
    let Some(array) = named(document, "Points", "Points") else { return refuse("it has no points") };
    let values: Vec<f64> = numbers(&bytes_of(array, compression)?, f64::from_le_bytes).collect();
    Ok(values.chunks_exact(3).map(|x| Vec2::new(x[0], x[1])).collect())
}

fn numbers<T>(bytes: &[u8], number: fn([u8; 8]) -> T) -> impl Iterator<Item = T> {
    bytes.as_chunks().0.iter().map(move |&bytes| number(bytes))
}

/// The bytes of an array.
fn bytes_of(array: Node<'_, '_>, compression: Compression) -> Result<Vec<u8>, ReadError> {
    let name = array.attribute("Name").unwrap_or_default();
    let text = array.text().unwrap_or_default().trim();
    // Only empty arrays are written as text.
    if text.is_empty() {
        return Ok(Vec::new());
    }
    let bytes = if compression == Compression::None { sized(text) } else { unpacked(text, compression) };
    bytes.ok_or(()).or_else(|()| refuse(format!("the array {name} is not complete")))
}

/// Bytes after their count.
fn sized(text: &str) -> Option<Vec<u8>> {
    let bytes = STANDARD.decode(text).ok()?;
    let (count, content) = bytes.split_first_chunk()?;
    (u64::from_le_bytes(*count) == content.len() as u64).then(|| content.to_vec())
}

/// The content of compressed blocks.
fn unpacked(text: &str, compression: Compression) -> Option<Vec<u8>> {
    /// Numbers before the sizes of the blocks: their count, the size of each and of a shorter last one.
    const FIRST: usize = 3;
    let encoded = |bytes: usize| bytes.div_ceil(3) * 4;
    let first = STANDARD.decode(text.get(..encoded(FIRST * HEADER))?).ok()?;
    let first: Vec<usize> = numbers(&first, u64::from_le_bytes).map(|number| number as usize).collect();
    let [blocks, size, last] = first[..] else { return None };
    // No more than there is text for.
    if size != BLOCK || last >= BLOCK || blocks > text.len() {
        return None;
    }
    let (header, packed) = text.split_at_checked(encoded((FIRST + blocks) * HEADER))?;
    let sizes = STANDARD.decode(header).ok()?;
    let mut packed = &STANDARD.decode(packed).ok()?[..];
    let mut content = Vec::new();
    for (block, packed_size) in numbers(&sizes, u64::from_le_bytes).skip(FIRST).enumerate() {
        let (this, rest) = packed.split_at_checked(usize::try_from(packed_size).ok()?)?;
        let expected = if block + 1 == blocks && last > 0 { last } else { BLOCK };
        let before = content.len();
        match compression {
            Compression::Lz4 => content.extend(lz4_flex::block::decompress(this, expected).ok()?),
            _ => drop(ZlibDecoder::new(this).take(BLOCK as u64 + 1).read_to_end(&mut content).ok()?),
        }
        if content.len() - before != expected {
            return None;
        }
        packed = rest;
    }
    packed.is_empty().then_some(content)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk;
    use meniscus_core::snapshot::Values;

    const ALL: [Compression; 3] = [Compression::None, Compression::Zlib, Compression::Lz4];

    fn cloud(count: usize) -> Cloud<'static> {
        let points = (0..count).map(|i| Vec2::new((i as f64).sqrt(), -(i as f64) / 7.0)).collect::<Vec<_>>();
        let fields = vec![
            Field::vector("velocity", "m/s", vec![Vec2::new(1.0, 2.0); count]),
            Field::scalar("volume", "m2", (0..count).map(|i| i as f64 / 3.0)),
            Field::integer("phase", (0..count as i64).map(|i| i % 3 - 1)),
        ];
        Cloud { points: points.into(), fields }
    }

    #[test]
    fn points_and_their_arrays_come_back_to_the_bit() {
        // Blocks are full at 4096 numbers of an array.
        for (count, compression) in [0, 1, 4095, 4096, 4097, 12288].into_iter().flat_map(|n| ALL.map(|c| (n, c))) {
            let given = cloud(count);
            let file = vtk::points(&given, compression).unwrap();
            let found = points(&file, &["phase", "absent", "volume"]).unwrap();
            assert_eq!(found.points, given.points, "{count} {compression:?}");
            let [Values::Integer(phase), Values::Scalar(volume)] = [&found.fields[0].values, &found.fields[1].values]
            else {
                panic!("{:?}", found.fields)
            };
            let [_, Values::Scalar(given_volume), Values::Integer(given_phase)] =
                [&given.fields[0].values, &given.fields[1].values, &given.fields[2].values]
            else {
                panic!()
            };
            assert_eq!((phase, volume, found.fields.len()), (given_phase, given_volume, 2));
        }
    }

    #[test]
    fn polylines_come_back_as_such() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [5.0, 5.0], [6.0, 5.0]].map(Vec2::from);
        let lines_given = vec![vec![0, 1, 2, 0], vec![3, 4]];
        let given = Lines { points: corners.to_vec().into(), lines: lines_given.clone(), fields: Vec::new() };
        for compression in ALL {
            let found = lines(&vtk::lines(&given, compression).unwrap()).unwrap();
            assert_eq!((&found.points[..], &found.lines), (&corners[..], &lines_given));
            assert!(lines(&vtk::lines(&Lines::default(), compression).unwrap()).unwrap().lines.is_empty());
        }
    }

    #[test]
    fn damage_anywhere_is_an_error_or_harmless_and_never_a_panic() {
        for compression in ALL {
            let file = vtk::points(&cloud(700), compression).unwrap();
            for cut in (0..file.len()).step_by(97) {
                assert!(points(&file[..cut], &["phase"]).is_err(), "cut at {cut}");
            }
            for at in (0..file.len()).step_by(61) {
                let mut changed = file.clone();
                changed[at] = if changed[at] == b'A' { b'/' } else { b'A' };
                let _ = (points(&changed, &["phase", "volume"]), lines(&changed));
            }
        }
        let gzipped = br#"<VTKFile compressor="vtkLZMADataCompressor"/>"#;
        assert!(points(gzipped, &[]).unwrap_err().to_string().contains("vtkLZMADataCompressor"));
        assert!(lines(b"hello").unwrap_err().to_string().contains("run the case again"));
    }
}
