//! Drawings for other programs: the solid of a geometry as SVG, DXF, well-known text, GeoJSON, a list of discs, a TOML shape file or a PNG mask, selected by
//! the file extension.
//!
//! Discs stay circles and arcs stay arcs in formats that support them. In the others (well-known text, GeoJSON) vertices lie on the arc, with chords within
//! 5e-4 of its radius. Shapes are written completely, also if they cross the sides of the domain; infinite ones are cut half a domain outside it. If the
//! shapes are the pore, the solid within the domain is written.

mod dxf;
mod error;
#[cfg(feature = "masks")]
mod mask;
pub(crate) mod sheet;
mod svg;
mod text;

use std::path::Path;

use meniscus_geometry::spec::{GeometrySpec, ShapeSpec};

pub use error::ExportError;
pub(crate) use sheet::Sheet;

/// A file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// SVG in mm.
    Svg,
    /// DXF of AutoCAD 2000 in mm.
    Dxf,
    /// Well-known text in m.
    Wkt,
    /// GeoJSON in m, with the unit as a member of its own.
    GeoJson,
    /// Discs as `x y r` in m.
    Discs,
    /// A TOML shape file.
    Toml,
    /// A PNG mask: solid black, pore white, partly covered pixels gray.
    Png,
}

/// File extensions and their formats.
const ENDINGS: [(&str, Format); 9] = [
    ("svg", Format::Svg),
    ("dxf", Format::Dxf),
    ("wkt", Format::Wkt),
    ("geojson", Format::GeoJson),
    ("json", Format::GeoJson),
    ("xyr", Format::Discs),
    ("discs", Format::Discs),
    ("toml", Format::Toml),
    ("png", Format::Png),
];

impl Format {
    /// The format of a file name.
    pub fn of(path: &Path) -> Result<Self, ExportError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        let found = ENDINGS.iter().find(|(known, _)| *known == ending);
        found.map(|&(_, format)| format).ok_or(ExportError::Ending { ending })
    }
}

/// Default number of pixels along the longer side of a mask.
const MASK_PIXELS: f64 = 2048.0;

/// Data of particular formats besides the shapes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Beside {
    /// Side of a pixel of a mask in m.
    pub pixel: Option<f64>,
    /// Distance between floor and lid in m, which a TOML shape file can hold.
    pub depth: Option<f64>,
}

/// The bytes of a drawing of a specification without problems.
pub fn write(spec: &GeometrySpec, format: Format, beside: Beside) -> Result<Vec<u8>, ExportError> {
    let spec = &plain(spec)?;
    Ok(match format {
        Format::Toml => text::toml(spec, beside.depth)?.into_bytes(),
        Format::Svg => svg::svg(&Sheet::of(spec)).into_bytes(),
        Format::Dxf => dxf::dxf(&Sheet::of(spec)).into_bytes(),
        Format::Wkt => text::well_known_text(&Sheet::of(spec)).into_bytes(),
        Format::GeoJson => text::geojson(&Sheet::of(spec))?.into_bytes(),
        Format::Discs => text::discs(&Sheet::of(spec))?.into_bytes(),
        #[cfg(not(feature = "masks"))]
        Format::Png => return Err(ExportError::Library("this build of the library writes no masks".to_owned())),
        #[cfg(feature = "masks")]
        Format::Png => {
            let sheet = Sheet::of(spec);
            mask::png(&sheet, beside.pixel.unwrap_or(sheet.frame.size().max() / MASK_PIXELS))?
        }
    })
}

/// The specification with generators expanded.
fn plain(spec: &GeometrySpec) -> Result<GeometrySpec, ExportError> {
    let mut shapes = Vec::new();
    for shape in &spec.shapes {
        shapes.extend(ShapeSpec::expanded(shape).map_err(|error| ExportError::Library(error.to_string()))?);
    }
    Ok(GeometrySpec { shapes, ..spec.clone() })
}
