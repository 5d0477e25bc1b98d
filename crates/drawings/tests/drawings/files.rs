//! The files and what their readers need.

use std::path::{Path, PathBuf};

use meniscus_drawings::import::Options;

/// The box of the pack in m.
pub const PACK: [[f64; 2]; 2] = [[0.0, 0.0], [14e-3, 9e-3]];
pub fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../drawings/tests/drawings").join(name)
}

pub fn unit(name: &str) -> Options {
    Options { unit: Some(name.into()), ..Options::default() }
}

pub fn in_box(options: Options, window: [[f64; 2]; 2]) -> Options {
    Options { window: Some(window), ..options }
}

/// How a file describes the discs of the pack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// To the digits of the file.
    Exact,
    /// By polygons on the circles, or cubic curves.
    Sampled,
    /// By the share of solid in each pixel.
    Gray,
    /// By black and white pixels.
    Binary,
}

/// Columns x, y and diameter in mm.
pub fn columns() -> Options {
    let scale = Some(1e-3);
    in_box(
        Options { scale, columns: Some([2, 3, 1]), separator: Some(';'), diameters: Some(true), ..Options::default() },
        PACK,
    )
}

/// Files of the pack with what their readers need, how they describe discs, and what the notes must say of the unit.
pub fn packs() -> Vec<(&'static str, Options, Kind, &'static str)> {
    let plain = Options::default;
    let mask = || Options { pixel_size: Some(2e-5), ..Options::default() };
    vec![
        ("pack.xyr", in_box(plain(), PACK), Kind::Exact, "drawing unit m"),
        ("pack.wkt", in_box(unit("mm"), PACK), Kind::Sampled, "drawing unit mm (unit)"),
        ("pack.geojson", in_box(unit("um"), PACK), Kind::Sampled, "drawing unit um (unit)"),
        ("pack.shp", in_box(plain(), PACK), Kind::Sampled, "as the file says"),
        ("pack-r12.dxf", in_box(unit("mm"), PACK), Kind::Exact, "drawing unit mm (unit)"),
        ("pack-r2000-inch.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit in"),
        ("pack-r2010.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit mm"),
        ("pack-r2018-binary.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit m "),
        ("pack-arcs.dxf", in_box(unit("mm"), PACK), Kind::Exact, "drawing unit mm (unit)"),
        ("pack-bulges.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit mm"),
        ("pack-blocks.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit um"),
        ("pack-splines.dxf", in_box(plain(), PACK), Kind::Exact, "drawing unit cm"),
        ("pack-inkscape.svg", plain(), Kind::Exact, "as the file says"),
        ("pack-matplotlib.svg", plain(), Kind::Sampled, "as the file says"),
        ("pack-collection.svg", plain(), Kind::Sampled, "as the file says"),
        ("pack-matplotlib.png", mask(), Kind::Gray, "1 pixel = 2e-5 m (pixel-size)"),
        ("pack-grey.png", mask(), Kind::Gray, "1 pixel = 2e-5 m (pixel-size)"),
        ("pack-16bit.png", mask(), Kind::Gray, "1 pixel = 2e-5 m (pixel-size)"),
        ("pack-1bit.tif", mask(), Kind::Binary, "1 pixel = 2e-5 m (pixel-size)"),
    ]
}
