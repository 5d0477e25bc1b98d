//! The formats of shape files, told by the ending of the name.

use std::path::Path;

/// A format of shape files of other programs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    /// Our own shape files, which the case reader reads.
    Toml,
    /// Lists of discs.
    List,
    /// Well-known text.
    Wkt,
    /// GeoJSON.
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

/// The endings with their formats.
const ENDINGS: [(&str, Format); 14] = [
    ("toml", Format::Toml),
    ("xyr", Format::List),
    ("discs", Format::List),
    ("txt", Format::List),
    ("csv", Format::List),
    ("wkt", Format::Wkt),
    ("geojson", Format::GeoJson),
    ("json", Format::GeoJson),
    ("shp", Format::Shapefile),
    ("svg", Format::Svg),
    ("dxf", Format::Dxf),
    ("png", Format::Mask),
    ("tif", Format::Mask),
    ("tiff", Format::Mask),
];

impl Format {
    /// The format that the ending of a file's name says.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        ENDINGS.iter().find(|known| known.0 == ending).map(|known| known.1)
    }

    /// How messages call a file of this format.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Toml => "a TOML shape file",
            Self::List => "a list of discs",
            Self::Wkt => "well-known text",
            Self::GeoJson => "GeoJSON",
            Self::Shapefile => "a shapefile without .prj",
            Self::Svg => "this SVG",
            Self::Dxf => "this DXF",
            Self::Mask => "a mask",
        }
    }

    /// Whether lengths are in m where nobody says otherwise.
    pub(crate) fn is_in_meters(self) -> bool {
        matches!(self, Self::Toml | Self::List | Self::Wkt)
    }

    /// Whether rings within rings are holes though each is an entity of its own: a format without fills.
    pub(crate) fn nests_entities(self) -> bool {
        self == Self::Dxf
    }

    /// Whether the rings of a shape are outer ones or holes by what contains what, so that they must not cross.
    pub(crate) fn nests_rings(self) -> bool {
        self == Self::Shapefile
    }

    /// Whether the first ring of a polygon is its outer one, and all others are its holes.
    pub(crate) fn begins_with_outer_ring(self) -> bool {
        matches!(self, Self::Wkt | Self::GeoJson)
    }

    /// Whether outlines may cross, so that a fill rule says what they cover; elsewhere such rings are mistakes.
    pub(crate) fn has_fill_rules(self) -> bool {
        self == Self::Svg
    }

    /// Whether curves come as many short straight edges.
    pub(crate) fn samples_curves(self) -> bool {
        matches!(self, Self::Wkt | Self::GeoJson | Self::Shapefile | Self::Svg | Self::Dxf)
    }

    /// Whether shapes outside of the page are left out: a page is what is seen, a domain is what was meant.
    pub(crate) fn has_page(self) -> bool {
        self == Self::Svg
    }
}
