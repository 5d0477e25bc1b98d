//! `meniscus geometry --write`: the shapes as drawings for other programs.

use super::arguments::WriteArguments;
use super::exit::{BAD_INPUT, BUG, Failure, USAGE};
use super::output::say;
use crate::geometry::Geometry;
use crate::geometry::export::{self, Format};
use crate::geometry::spec::GeometrySpec;
use crate::io::{atomic, vtk};

/// Writes each drawing that was asked for; names are checked before anything is written.
pub fn write_shapes(arguments: &WriteArguments, spec: &GeometrySpec) -> Result<(), Failure> {
    let is_vtk = |path: &std::path::Path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("vtp"));
    let formats: Vec<Option<Format>> = arguments
        .write
        .iter()
        .map(|path| if is_vtk(path) { Ok(None) } else { Format::of(path).map(Some) })
        .collect::<Result<_, _>>()
        .map_err(|error| Failure::new(USAGE, &error))?;
    for (path, format) in arguments.write.iter().zip(formats) {
        let bytes = match format {
            Some(format) => {
                export::write(spec, format, arguments.mask_pixel).map_err(|error| Failure::new(USAGE, &error))?
            }
            None => {
                let geometry = Geometry::new(spec).map_err(|error| Failure::new(BAD_INPUT, &error))?;
                vtk::lines(&geometry.outline(), 0.0, vtk::Compression::default())
                    .map_err(|error| Failure::new(BUG, &error))?
            }
        };
        atomic::write(path, &bytes).map_err(|error| Failure::new(USAGE, &error))?;
        say(format_args!("wrote {}", path.display()));
    }
    Ok(())
}
