//! Damaged copies of all files are read or refused: no panic, no hang, and shapes that make sense where there are any.

use cpu_time::ThreadTime;
use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

use crate::contents::*;
use crate::damage::{damage, damaged};
use crate::files::*;

/// Most shapes that a file may expand to beside one for each of its bytes.
const MOST_SHAPES: usize = 500_000;

/// Damaged copies of a file of crates/drawings/tests/drawings are read or refused, each in less than a second of this thread.
fn survives_damage(name: &str, options: &Options) {
    let whole = std::fs::read(file(name)).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    let mut runner = TestRunner::new(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(512) });
    let outcome = runner.run(&damage(), |damages| {
        let bytes = damaged(&whole, &damages);
        std::fs::write(&path, &bytes).unwrap();
        let clock = ThreadTime::now();
        let found = load(&path, options);
        let seconds = clock.elapsed().as_secs_f64();
        prop_assert!(seconds < 1.0, "{seconds} s");
        if let Ok(found) = found {
            prop_assert!(found.spec.problems().is_empty());
            let shapes = found.spec.shapes.len();
            prop_assert!(shapes <= MOST_SHAPES + bytes.len(), "{shapes} shapes of {} bytes", bytes.len());
        }
        Ok(())
    });
    if let Err(error) = outcome {
        panic!("{name}: {error}");
    }
}

macro_rules! survive {
    ($($test:ident: $file:literal, $options:expr;)*) => {
        $(#[test]
        fn $test() {
            survives_damage($file, &$options);
        })*
    };
}

survive! {
    damaged_lists_are_read_or_refused: "pack.xyr", Options::default();
    damaged_columns_are_read_or_refused: "pack-columns.csv", columns();
    damaged_networks_are_read_or_refused: "network-openpnm.csv", Options::default();
    damaged_well_known_text_is_read_or_refused: "grains.wkt", unit("mm");
    damaged_geojson_is_read_or_refused: "grains.geojson", unit("mm");
    damaged_shapefiles_are_read_or_refused: "grains.shp", unit("mm");
    damaged_svg_is_read_or_refused: "pack-inkscape.svg", Options::default();
    damaged_svg_of_grains_is_read_or_refused: "grains.svg", in_box(Options::default(), GRAINS);
    damaged_dxf_is_read_or_refused: "grains.dxf", unit("mm");
    damaged_dxf_with_blocks_is_read_or_refused: "pack-blocks.dxf", unit("mm");
    damaged_dxf_with_splines_is_read_or_refused: "grains-splines.dxf", unit("mm");
    damaged_binary_dxf_is_read_or_refused: "pack-r2018-binary.dxf", unit("mm");
    damaged_png_masks_are_read_or_refused: "pack-grey.png", Options { pixel_size: Some(2e-5), ..Options::default() };
    damaged_tiff_masks_are_read_or_refused: "pack-1bit.tif", Options { pixel_size: Some(2e-5), ..Options::default() };
}
