//! Arrays of numbers as they stand in a VTK XML file: little endian, cut into blocks, compressed, in base 64.
//!
//! Layout of a compressed array: number of blocks, their size, size of the last one where it is shorter (else 0), compressed
//! size of each, all as 64 bits; then, in a base 64 of their own, the blocks. Without compression: number of bytes, then the
//! bytes. Source: VTK File Formats, chapter on XML formats, Kitware.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::write::ZlibEncoder;

use crate::math::Vec2;

/// Bytes of a block before compression, as VTK itself has them.
const BLOCK: usize = 32768;

/// How arrays are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Compression {
    /// Not at all.
    None,
    /// By zlib at its fastest level.
    #[default]
    Zlib,
    /// By LZ4.
    Lz4,
}

impl Compression {
    /// The attribute of the file that names it, with a space before.
    pub(super) fn attribute(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Zlib => " compressor=\"vtkZLibDataCompressor\"",
            Self::Lz4 => " compressor=\"vtkLZ4DataCompressor\"",
        }
    }

    /// Numbers, one per point.
    pub(super) fn scalars(self, name: &str, values: &[f64]) -> String {
        self.array("Float64", name, 1, &little_endian(values.iter().map(|value| value.to_le_bytes())))
    }

    /// Vectors of the plane with a third component of 0.
    pub(super) fn vectors(self, name: &str, values: &[Vec2]) -> String {
        let numbers = values.iter().flat_map(|v| [v.x, v.y, 0.0]);
        self.array("Float64", name, 3, &little_endian(numbers.map(f64::to_le_bytes)))
    }

    /// Whole numbers.
    pub(super) fn integers(self, name: &str, values: &[i64]) -> String {
        self.array("Int64", name, 1, &little_endian(values.iter().map(|value| value.to_le_bytes())))
    }

    /// `values` as small whole numbers.
    pub(super) fn bytes(self, name: &str, values: &[u8]) -> String {
        self.array("UInt8", name, 1, values)
    }

    fn array(self, kind: &str, name: &str, components: usize, bytes: &[u8]) -> String {
        // No reader wants a header where there is nothing behind it.
        let format = if bytes.is_empty() { "ascii" } else { "binary" };
        // Said of one component, meshio would make a table of one column of it.
        let components = if components > 1 { format!(" NumberOfComponents=\"{components}\"") } else { String::new() };
        let mut text = format!("<DataArray type=\"{kind}\" Name=\"{name}\"{components} format=\"{format}\">");
        if !bytes.is_empty() {
            self.encode(bytes, &mut text);
        }
        text + "</DataArray>"
    }

    fn encode(self, bytes: &[u8], text: &mut String) {
        let packed = match self {
            Self::None => {
                let length = (bytes.len() as u64).to_le_bytes();
                return STANDARD.encode_string([&length, bytes].concat(), text);
            }
            Self::Zlib => deflated(bytes),
            Self::Lz4 => bytes.chunks(BLOCK).map(lz4_flex::block::compress).collect(),
        };
        let sizes = packed.iter().map(Vec::len);
        let header = [packed.len(), BLOCK, bytes.len() % BLOCK].into_iter().chain(sizes);
        STANDARD.encode_string(little_endian(header.map(|number| (number as u64).to_le_bytes())), text);
        STANDARD.encode_string(packed.concat(), text);
    }
}

fn little_endian<const N: usize>(numbers: impl Iterator<Item = [u8; N]>) -> Vec<u8> {
    numbers.flatten().collect()
}

/// The blocks by zlib. Its state is large, so that all blocks share one.
fn deflated(bytes: &[u8]) -> Vec<Vec<u8>> {
    let mut encoder = ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
    let packed = bytes.chunks(BLOCK).map(|block| {
        // Neither can fail: all goes to memory.
        encoder.write_all(block).and_then(|()| encoder.reset(Vec::new())).unwrap_or_default()
    });
    packed.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_and_their_sizes_are_those_of_the_format() {
        for (length, blocks, last) in [(1, 1, 1), (BLOCK, 1, 0), (BLOCK + 1, 2, 1), (2 * BLOCK, 2, 0)] {
            let mut text = String::new();
            Compression::Zlib.encode(&vec![7; length], &mut text);
            let head = STANDARD.decode(&text[..32]).unwrap();
            let number = |at: usize| u64::from_le_bytes(head[8 * at..8 * (at + 1)].try_into().unwrap());
            assert_eq!([number(0), number(1), number(2)], [blocks, BLOCK as u64, last]);
        }
    }
}
