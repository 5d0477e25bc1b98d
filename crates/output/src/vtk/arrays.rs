//! The text of a VTK XML file: its elements, and arrays of numbers in base 64, compressed block by block.
//!
//! Layout of a compressed array: number of blocks, their size, size of the last one if it is shorter (else 0), compressed size of each, all as 64 bits; then,
//! in a separate base 64 string, the blocks. Without compression: the number of bytes as 64 bits, and the bytes, in one string. Empty arrays are a space, since
//! readers fail on a header without data and meshio expects some text. Source: VTK File Formats, chapter on XML formats, Kitware.

use std::io::{self, Write};

use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use flate2::write::ZlibEncoder;

use super::Compression;

/// Bytes of a block before compression, as in VTK itself.
pub(super) const BLOCK: usize = 32768;
/// Bytes of a number of a header.
pub(super) const HEADER: usize = size_of::<u64>();

/// A number of an array.
pub(super) trait Number: Copy {
    /// Its type in VTK.
    const TYPE: &str;
    /// Adds its bytes, little endian.
    fn add(self, bytes: &mut Vec<u8>);
}

impl Number for f64 {
    const TYPE: &str = "Float64";
    fn add(self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}

impl Number for i64 {
    const TYPE: &str = "Int64";
    fn add(self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}

impl Number for u8 {
    const TYPE: &str = "UInt8";
    fn add(self, bytes: &mut Vec<u8>) {
        bytes.push(self);
    }
}

/// A file in the course of being written.
pub(super) struct Arrays<'a> {
    to: &'a mut dyn Write,
    compression: Compression,
    /// The state of zlib is large, so all blocks share one.
    zlib: ZlibEncoder<Vec<u8>>,
}

impl<'a> Arrays<'a> {
    /// A file without content so far.
    pub(super) fn new(to: &'a mut dyn Write, compression: Compression) -> Self {
        Self { to, compression, zlib: ZlibEncoder::new(Vec::new(), flate2::Compression::fast()) }
    }

    /// Writes the beginning of a file of so many points and cells.
    pub(super) fn begin(&mut self, points: usize, cells: usize) -> io::Result<()> {
        let compressor = match self.compression {
            Compression::None => "",
            Compression::Zlib => " compressor=\"vtkZLibDataCompressor\"",
            Compression::Lz4 => " compressor=\"vtkLZ4DataCompressor\"",
        };
        write!(
            self.to,
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"{compressor}>\
             <UnstructuredGrid><Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">"
        )
    }

    /// Writes the end of the file.
    pub(super) fn end(self) -> io::Result<()> {
        write!(self.to, "</Piece></UnstructuredGrid></VTKFile>")
    }

    /// Writes an element that holds an array, or several, for each item.
    pub(super) fn group<T>(
        &mut self,
        name: &str,
        items: &[T],
        each: impl Fn(&mut Self, &T) -> io::Result<()>,
    ) -> io::Result<()> {
        if items.is_empty() {
            return write!(self.to, "<{name}/>");
        }
        write!(self.to, "<{name}>")?;
        items.iter().try_for_each(|item| each(self, item))?;
        write!(self.to, "</{name}>")
    }

    /// Writes an array of this name, with so many components.
    pub(super) fn array<T: Number>(
        &mut self,
        name: &str,
        components: usize,
        values: impl Iterator<Item = T>,
    ) -> io::Result<()> {
        write!(self.to, "<DataArray type=\"{}\" Name=\"{name}\"", T::TYPE)?;
        if components > 1 {
            write!(self.to, " NumberOfComponents=\"{components}\"")?;
        }
        let mut values = values.peekable();
        if values.peek().is_none() {
            return write!(self.to, " format=\"ascii\"> </DataArray>");
        }
        write!(self.to, " format=\"binary\">")?;
        if self.compression == Compression::None { self.plain(values) } else { self.packed(values) }?;
        write!(self.to, "</DataArray>")
    }

    fn plain<T: Number>(&mut self, values: impl Iterator<Item = T>) -> io::Result<()> {
        let mut bytes = vec![0; HEADER];
        values.for_each(|value| value.add(&mut bytes));
        let length = (bytes.len() - HEADER) as u64;
        bytes[..HEADER].copy_from_slice(&length.to_le_bytes());
        self.base_64(&[bytes.into()])
    }

    fn packed<T: Number>(&mut self, values: impl Iterator<Item = T>) -> io::Result<()> {
        let (mut block, mut packed) = (Vec::with_capacity(BLOCK), Vec::new());
        for value in values {
            if block.len() == BLOCK {
                packed.push(self.packed_block(&block)?);
                block.clear();
            }
            value.add(&mut block);
        }
        packed.push(self.packed_block(&block)?);
        let sizes = packed.iter().map(|block| block.len());
        let header = [packed.len(), BLOCK, block.len() % BLOCK].into_iter().chain(sizes);
        let header: Vec<u8> = header.flat_map(|number| (number as u64).to_le_bytes()).collect();
        self.base_64(&[header.into()])?;
        self.base_64(&packed)
    }

    /// A compressed block.
    fn packed_block(&mut self, block: &[u8]) -> io::Result<Box<[u8]>> {
        if self.compression == Compression::Lz4 {
            return Ok(lz4_flex::block::compress(block).into());
        }
        self.zlib.write_all(block)?;
        Ok(self.zlib.reset(Vec::with_capacity(BLOCK))?.into())
    }

    /// Writes all parts as one string.
    fn base_64(&mut self, parts: &[Box<[u8]>]) -> io::Result<()> {
        let mut encoder = EncoderWriter::new(&mut *self.to, &STANDARD);
        parts.iter().try_for_each(|part| encoder.write_all(part))?;
        encoder.finish().map(|_| ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use base64::Engine;

    #[test]
    fn blocks_and_their_sizes_are_those_of_the_format() {
        for (length, blocks, last) in [(1, 1, 1), (BLOCK, 1, 0), (BLOCK + 1, 2, 1), (2 * BLOCK, 2, 0)] {
            let mut text = Vec::new();
            Arrays::new(&mut text, Compression::Zlib).packed(std::iter::repeat_n(7_u8, length)).unwrap();
            let head = STANDARD.decode(&text[..32]).unwrap();
            let number = |at: usize| u64::from_le_bytes(head[8 * at..8 * (at + 1)].try_into().unwrap());
            assert_eq!([number(0), number(1), number(2)], [blocks, BLOCK as u64, last]);
        }
    }
}
