//! The formats of shape files, by file extension.

use std::path::Path;

use crate::import::network;
use crate::import::options::Options;

/// A format of shape files of other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Our own shape files, read by the case reader.
    Toml,
    /// Lists of discs.
    List,
    /// Tables of pores and throats.
    Network,
    /// Well-known text.
    Wkt,
    GeoJson,
    /// ESRI shapefile.
    Shapefile,
    /// Scalable vector graphics.
    Svg,
    /// Drawing exchange format.
    Dxf,
    /// Image of solid and pore.
    Mask,
}

/// Most bytes that are searched for the header of a table.
const LONGEST_HEADER: usize = 1 << 20;

/// Each format: its name in messages, and its file extensions.
const FORMATS: &[(Format, &str, &[&str])] = &[
    (Format::Toml, "a TOML shape file", &["toml"]),
    (Format::List, "a list of discs", &["xyr", "discs", "txt", "csv"]),
    // Told from a list of discs by its header.
    (Format::Network, "a network", &[]),
    (Format::Wkt, "well-known text", &["wkt"]),
    (Format::GeoJson, "GeoJSON", &["geojson", "json"]),
    (Format::Shapefile, "a shapefile without .prj", &["shp"]),
    (Format::Svg, "this SVG", &["svg"]),
    (Format::Dxf, "this DXF", &["dxf"]),
    (Format::Mask, "a mask", &["png", "tif", "tiff"]),
];

impl Format {
    /// The format of a file, by its extension.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        FORMATS.iter().find(|known| known.2.contains(&ending.as_str())).map(|known| known.0)
    }

    /// The format of a file of this format by its extension, by its content: the header of a table tells a network from a list of discs.
    pub(crate) fn of_content(self, bytes: &[u8], options: &Options) -> Self {
        let is_list = options.columns.is_some() || options.separator.is_some() || options.diameters.is_some();
        let is_network = || {
            let start = &bytes[..bytes.len().min(LONGEST_HEADER)];
            network::is_one(String::from_utf8_lossy(start).trim_start_matches('\u{feff}'))
        };
        if self == Self::List && !is_list && is_network() { Self::Network } else { self }
    }

    /// The file extensions of all formats.
    pub(crate) fn endings() -> String {
        FORMATS.iter().flat_map(|known| known.2).map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ")
    }

    /// The name of the format in messages.
    pub(crate) fn name(self) -> &'static str {
        FORMATS.iter().find(|known| known.0 == self).map_or("", |known| known.1)
    }
}
