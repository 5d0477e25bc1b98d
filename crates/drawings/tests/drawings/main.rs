//! Drawings: one pack and one drawing of grains as other programs write them, with the same porosity by every route; masks; drawings written and read again;
//! damaged ones. The files are described in `README.md` beside this file.

mod chips;
mod contents;
mod damage;
mod files;
mod formats;
mod import;
mod invariance;
mod kinds;
mod masks;
mod networks;
mod noise;
mod round_trip;
mod shape_files;
#[path = "../../../geometry/tests/geometry/shapes.rs"]
#[allow(dead_code, reason = "the tests of the geometry use the rest")]
mod shapes;
mod survival;
mod unions;
mod written;
