//! A VTK XML file from parts of vtkio: its arrays, enumerations and writer; missing or faulty parts are implemented here.
//!
//! Implemented here and not taken from vtkio 0.7.0-rc2:
//! - [`Document`], [`Piece`] and [`Arrays`]: its own types omit `NumberOfPoints` and `NumberOfCells` if they are 0, which VTK requires, and points and cells
//!   are private: only its model fills them, with unsigned integers, which meshio converts to floating-point numbers.
//! - [`Compression::encode`]: it declares one block too many if an array fills its last block, which no reader accepts, and its zlib takes 25 times as long,
//!   since it is fed number by number.
//! - Empty arrays, which it writes as a header without data: readers of compressed files fail on that.
//!
//! It writes no field data: the time of a file is in the `.pvd`.
//!
//! Layout of a compressed array: number of blocks, their size, size of the last one if it is shorter (else 0), compressed size of each, all as 64 bits; then,
//! in a separate base 64 string, the blocks. Source: VTK File Formats, chapter on XML formats, Kitware.

use std::io::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::write::ZlibEncoder;
use serde::Serialize;
use vtkio::IOBuffer;
use vtkio::model::{ByteOrder, Version};
use vtkio::xml::{
    AttributeData, Compressor, Data, DataArray, DataArrayFormat, DataSetType, EncodingInfo, ScalarType, se,
};

use super::{Compression, VtkError};

/// Bytes of a block before compression, as in VTK itself.
pub(super) const BLOCK: usize = 32768;

/// Binary form of numbers: little endian, after their byte count, which has this size.
const PLAIN: EncodingInfo = EncodingInfo {
    byte_order: ByteOrder::LittleEndian,
    header_type: ScalarType::UInt64,
    compressor: Compressor::None,
    compression_level: 0,
};
pub(super) const HEADER: usize = size_of::<u64>();

/// The file.
#[derive(Serialize)]
#[serde(rename = "VTKFile")]
struct Document {
    #[serde(rename = "@type")]
    kind: DataSetType,
    #[serde(rename = "@version")]
    version: Version,
    #[serde(rename = "@byte_order")]
    byte_order: ByteOrder,
    #[serde(rename = "@header_type")]
    header_type: ScalarType,
    #[serde(rename = "@compressor", skip_serializing_if = "Compressor::is_none")]
    compressor: Compressor,
    #[serde(rename = "UnstructuredGrid")]
    grid: Grid,
}

#[derive(Serialize)]
#[serde(rename_all = "PascalCase")]
struct Grid {
    piece: Piece,
}

/// The content of a file.
#[derive(Serialize)]
#[serde(rename_all = "PascalCase")]
pub(super) struct Piece {
    #[serde(rename = "@NumberOfPoints")]
    pub(super) number_of_points: usize,
    #[serde(rename = "@NumberOfCells")]
    pub(super) number_of_cells: usize,
    pub(super) point_data: AttributeData,
    pub(super) cell_data: AttributeData,
    pub(super) points: Arrays,
    pub(super) cells: Arrays,
}

#[derive(Serialize)]
pub(super) struct Arrays {
    #[serde(rename = "DataArray")]
    pub(super) arrays: Vec<DataArray>,
}

impl Piece {
    /// The file with this piece, with compressed arrays.
    pub(super) fn into_file(self, compression: Compression) -> Result<Vec<u8>, VtkError> {
        let document = Document {
            kind: DataSetType::UnstructuredGrid,
            version: Version::new_xml(1, 0),
            byte_order: PLAIN.byte_order,
            header_type: PLAIN.header_type,
            compressor: compression.compressor(),
            grid: Grid { piece: self },
        };
        se::to_string(&document).map(String::into_bytes).map_err(|error| VtkError::Write(error.to_string()))
    }
}

impl Compression {
    fn compressor(self) -> Compressor {
        match self {
            Self::None => Compressor::None,
            Self::Zlib => Compressor::ZLib,
            Self::Lz4 => Compressor::LZ4,
        }
    }

    /// A named array with `num_comp` components.
    pub(super) fn array(self, name: &str, num_comp: u32, values: IOBuffer) -> Result<DataArray, VtkError> {
        let scalar_type = values.scalar_type().into();
        let (format, text) = if values.is_empty() {
            // A space, because meshio expects some text.
            (DataArrayFormat::Ascii, " ".to_owned())
        } else {
            let text = values.into_bytes_with_size_encoded(PLAIN, |bytes, text| self.encode(bytes, text));
            (DataArrayFormat::Binary, text.map_err(|error| VtkError::Write(error.to_string()))?)
        };
        let data = vec![Data::Data(text)];
        Ok(DataArray { scalar_type, name: name.to_owned(), num_comp, format, data, ..DataArray::default() })
    }

    /// The text of bytes that are preceded by their count.
    fn encode(self, sized: &[u8], text: &mut String) {
        let bytes = &sized[HEADER..];
        let packed = match self {
            Self::None => return STANDARD.encode_string(sized, text),
            Self::Zlib => deflated(bytes),
            Self::Lz4 => bytes.chunks(BLOCK).map(lz4_flex::block::compress).collect(),
        };
        let sizes = packed.iter().map(Vec::len);
        let header = [packed.len(), BLOCK, bytes.len() % BLOCK].into_iter().chain(sizes);
        STANDARD.encode_string(header.flat_map(|number| (number as u64).to_le_bytes()).collect::<Vec<_>>(), text);
        STANDARD.encode_string(packed.concat(), text);
    }
}

/// The blocks by zlib. Its state is large, so all blocks share one.
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
            let array = Compression::Zlib.array("a", 1, vec![7_u8; length].into()).unwrap();
            let [Data::Data(text)] = &array.data[..] else { panic!("{array:?}") };
            let head = STANDARD.decode(&text[..32]).unwrap();
            let number = |at: usize| u64::from_le_bytes(head[8 * at..8 * (at + 1)].try_into().unwrap());
            assert_eq!([number(0), number(1), number(2)], [blocks, BLOCK as u64, last]);
        }
    }
}
