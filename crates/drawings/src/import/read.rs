//! The reader of each format.

use std::path::Path;

use crate::import::drawing::{Drawing, Refusal};
use crate::import::format::Format;
#[cfg(feature = "geojson")]
use crate::import::geojson;
#[cfg(feature = "masks")]
use crate::import::mask;
use crate::import::options::Options;
#[cfg(feature = "svg")]
use crate::import::svg;
use crate::import::text::utf8;
#[cfg(feature = "wkt")]
use crate::import::wkt;
use crate::import::{dxf, esri, list, network};
use meniscus_core::input::file;

/// Most bytes that are searched for the header of a table.
const LONGEST_HEADER: usize = 1 << 20;

/// The format of a file that its extension gives a format, by its content: the header of a table tells a network from a list of discs.
pub(crate) fn format_of(bytes: &[u8], by_extension: Format, options: &Options) -> Format {
    let is_list = options.columns.is_some() || options.separator.is_some() || options.diameters.is_some();
    let is_network = || {
        let start = &bytes[..bytes.len().min(LONGEST_HEADER)];
        network::is_one(String::from_utf8_lossy(start).trim_start_matches('\u{feff}'))
    };
    if by_extension == Format::List && !is_list && is_network() { Format::Network } else { by_extension }
}

/// Reads the bytes of a file; `path` is the location of accompanying files.
pub(crate) fn read(bytes: &[u8], path: &Path, format: Format, options: &Options) -> Result<Drawing, Vec<Refusal>> {
    match format {
        Format::List => list::read(utf8(bytes)?, options),
        Format::Network => network::read(utf8(bytes)?, path),
        #[cfg(feature = "wkt")]
        Format::Wkt => wkt::read(utf8(bytes)?),
        #[cfg(feature = "geojson")]
        Format::GeoJson => geojson::read(utf8(bytes)?),
        Format::Shapefile => {
            // A projection that is not text is damaged; its reader reports that.
            let projection = file::read(&path.with_extension("prj"), file::LARGEST_TEXT).ok();
            esri::read(bytes, projection.map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).as_deref())
        }
        // Read by the case reader, which keeps source locations in TOML.
        Format::Toml => Err(one("a TOML shape file", "a drawing")),
        #[cfg(feature = "svg")]
        Format::Svg => svg::read(utf8(bytes)?, options.layers.as_deref()),
        Format::Dxf => dxf::read(bytes, options.layers.as_deref(), options.join_within),
        #[cfg(feature = "masks")]
        Format::Mask => mask::read(bytes, options),
        #[cfg(not(all(feature = "geojson", feature = "masks", feature = "svg", feature = "wkt")))]
        left_out => Err(one(left_out.name(), "a format that this build of the library reads: see its features")),
    }
}

fn one(found: &str, expected: &str) -> Vec<Refusal> {
    vec![Refusal { location: "file".into(), found: found.into(), expected: expected.into() }]
}
