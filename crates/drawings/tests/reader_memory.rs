//! What readers of drawings allocate: at most 100 times the size of the file, or 64 MB where the file is small. This program has one test and one
//! thread, so that its allocator counts the reader alone.

#[path = "drawings/damage.rs"]
mod damage;
#[path = "drawings/files.rs"]
mod files;

use std::path::Path;

use meniscus_drawings::import::Options;
use meniscus_drawings::load;
use peak_alloc::PeakAlloc;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::TestRunner;

use files::*;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// Bytes allocated at the same time while a file is read, over what was there before, and whether it was refused.
fn peak(path: &Path, options: &Options) -> (usize, bool) {
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let is_refused = load(path, options).is_err();
    (MEMORY.peak_usage().saturating_sub(before), is_refused)
}

/// Damages one after the other, the same ones each time.
struct Damages(TestRunner);

impl Damages {
    fn new() -> Self {
        Self(TestRunner::deterministic())
    }

    fn of(&mut self, bytes: &[u8]) -> Vec<u8> {
        damage::damaged(bytes, &damage::damage().new_tree(&mut self.0).unwrap().current())
    }
}

fn allowed(bytes: usize) -> usize {
    (100 * bytes).max(64 << 20)
}

/// Small files that ask for a lot.
fn bombs() -> Vec<(&'static str, Vec<u8>)> {
    let copies = |depth: usize| {
        let group =
            |k: usize| format!(r##"<g id="g{k}">{}</g>"##, format!(r##"<use href="#g{}"/>"##, k - 1).repeat(10));
        let groups: String = (1..=depth).map(group).collect();
        format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm"><g id="g0"><circle r="1"/></g>{groups}</svg>"##
        )
    };
    let entities = {
        let entity = |k: usize| format!("<!ENTITY e{k} \"{}\">", format!("&e{};", k - 1).repeat(10));
        let all: String = (1..=9).map(entity).collect();
        format!(
            "<!DOCTYPE svg [<!ENTITY e0 \"xxxxxxxxxx\">{all}]><svg xmlns=\"http://www.w3.org/2000/svg\"><text>&e9;</text></svg>"
        )
    };
    let blocks = {
        let insert = |k: usize| format!("0\nINSERT\n8\n0\n2\nb{k}\n10\n0\n20\n0\n70\n1000\n71\n1000\n44\n1\n45\n1\n");
        let block = |k: usize, body: String| format!("0\nBLOCK\n8\n0\n2\nb{k}\n10\n0\n20\n0\n{body}0\nENDBLK\n8\n0\n");
        let circle = "0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n0.1\n".to_owned();
        format!(
            "0\nSECTION\n2\nBLOCKS\n{}{}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n",
            block(0, circle),
            block(1, insert(0)),
            insert(1)
        )
    };
    let shapefile = {
        let mut bytes = std::fs::read(file("grains.shp")).unwrap();
        // The number of points of the first record: header of the file, header of the record, type, box, number of parts.
        let at = 100 + 8 + 4 + 32 + 4;
        bytes[at..at + 4].copy_from_slice(&1_000_000_000_i32.to_le_bytes());
        bytes
    };
    let white = |side: u32, format: image::ImageFormat| {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::GrayImage::from_pixel(side, side, image::Luma([255])).write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    };
    vec![
        ("copies.svg", copies(9).into_bytes()),
        ("entities.svg", entities.into_bytes()),
        ("nested.svg", "<g>".repeat(200_000).into_bytes()),
        ("blocks.dxf", blocks.into_bytes()),
        ("points.shp", shapefile),
        ("nested.geojson", "[".repeat(500_000).into_bytes()),
        ("nested.wkt", format!("GEOMETRYCOLLECTION({}", "GEOMETRYCOLLECTION(".repeat(30_000)).into_bytes()),
        ("numbers.xyr", "1e999 -1e999 1e999\n".repeat(20_000).into_bytes()),
        // Beyond the limit of pixels, below which an image takes what its pixels take.
        ("white.png", white(9_000, image::ImageFormat::Png)),
    ]
}

#[test]
fn readers_allocate_at_most_a_hundred_times_the_file() {
    let plain = Options::default;
    let mut cases: Vec<(&str, Options)> = packs().into_iter().map(|(name, options, ..)| (name, options)).collect();
    cases.extend([
        ("pack-columns.csv", columns()),
        ("grains.wkt", unit("mm")),
        ("grains.geojson", unit("mm")),
        ("grains.shp", unit("mm")),
        ("grains.svg", plain()),
        ("grains.dxf", unit("mm")),
        ("grains-splines.dxf", unit("mm")),
    ]);
    let mut largest: (f64, String) = (0.0, String::new());
    let mut hold = |name: &str, peak: usize, size: usize| {
        let share = peak as f64 / size as f64;
        println!("{name}: {share:.0} times {size} bytes, {:.1} MB", peak as f64 / 1e6);
        if size > 100_000 && share > largest.0 {
            largest = (share, name.to_owned());
        }
        assert!(peak <= allowed(size), "{name}: {peak} bytes for a file of {size}");
    };
    for (name, options) in &cases {
        let size = std::fs::metadata(file(name)).unwrap().len() as usize;
        hold(name, peak(&file(name), options).0, size);
    }
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in bombs() {
        let path = folder.path().join(name);
        std::fs::write(&path, &bytes).unwrap();
        let pixel_size = name.ends_with("png").then_some(1e-5);
        let options = if pixel_size.is_some() { Options { pixel_size, ..plain() } } else { unit("mm") };
        let (peak, is_refused) = peak(&path, &options);
        hold(name, peak, bytes.len());
        assert!(is_refused, "{name} was read");
    }
    // Damaged copies, fewer than where they are looked at one format a test.
    let mut random = Damages::new();
    for (name, options) in &cases {
        let whole = std::fs::read(file(name)).unwrap();
        let path = folder.path().join(name);
        let mut most = 0;
        for _ in 0..24 {
            let bytes = random.of(&whole);
            std::fs::write(&path, &bytes).unwrap();
            let found = peak(&path, options).0;
            assert!(found <= allowed(bytes.len()), "{name}: {found} bytes for a damaged file of {}", bytes.len());
            most = most.max(found);
        }
        println!("{name}, damaged: at most {:.1} MB", most as f64 / 1e6);
    }
    println!("largest share: {:.0} of {}", largest.0, largest.1);
}
