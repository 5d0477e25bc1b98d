//! The formats of shape files, by file extension.

use std::path::Path;

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

    /// The file extensions of all formats.
    pub(crate) fn endings() -> String {
        FORMATS.iter().flat_map(|known| known.2).map(|ending| format!(".{ending}")).collect::<Vec<_>>().join(", ")
    }

    /// The name of the format in messages.
    pub(crate) fn name(self) -> &'static str {
        FORMATS.iter().find(|known| known.0 == self).map_or("", |known| known.1)
    }
}
