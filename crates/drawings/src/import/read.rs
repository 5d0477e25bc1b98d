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
#[cfg(feature = "wkt")]
use crate::import::wkt;
use crate::import::{dxf, esri, list, network};
use meniscus_core::input::file;

/// Reads the bytes of a file; `path` is the location of accompanying files.
pub(crate) fn read(bytes: &[u8], path: &Path, format: Format, options: &Options) -> Result<Drawing, Vec<Refusal>> {
    match format {
        Format::List => list::read(text(bytes)?, options),
        Format::Network => network::read(text(bytes)?, path),
        #[cfg(feature = "wkt")]
        Format::Wkt => wkt::read(text(bytes)?),
        #[cfg(feature = "geojson")]
        Format::GeoJson => geojson::read(text(bytes)?),
        Format::Shapefile => {
            // A projection that is not text is damaged; its reader reports that.
            let projection = file::read(&path.with_extension("prj"), file::LARGEST_TEXT).ok();
            esri::read(bytes, projection.map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).as_deref())
        }
        // Read by the case reader, which keeps source locations in TOML.
        Format::Toml => Err(one("a TOML shape file", "a drawing")),
        #[cfg(feature = "svg")]
        Format::Svg => svg::read(text(bytes)?, options.layers.as_deref()),
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

/// The UTF-8 text of a file, without byte order mark.
pub(crate) fn text(bytes: &[u8]) -> Result<&str, Vec<Refusal>> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text.trim_start_matches('\u{feff}')),
        Err(_) => {
            let location = file::not_text(bytes).unwrap_or_default();
            Err(vec![Refusal::new(
                location,
                "invalid UTF-8",
                "text in UTF-8: save the file as such; is it the right file?",
            )])
        }
    }
}
