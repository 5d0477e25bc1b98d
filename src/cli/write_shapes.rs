//! `meniscus geometry --write`: the shapes as drawings for other programs.

use super::arguments::WriteArguments;
use super::exit::{BAD_INPUT, BUG, Failure, USAGE};
use super::output::say;
use super::source::Shapes;
use meniscus_drawings::export::{self, Beside, Format};
use meniscus_geometry::Geometry;
use meniscus_output::{atomic, vtk};

/// The formats of the requested drawings; `None` for the outline as VTK.
pub(crate) fn formats(arguments: &WriteArguments) -> Result<Vec<Option<Format>>, Failure> {
    let is_vtk = |path: &std::path::Path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("vtu"));
    let format = |path: &std::path::PathBuf| if is_vtk(path) { Ok(None) } else { Format::of(path).map(Some) };
    arguments.write.iter().map(format).collect::<Result<_, _>>().map_err(Failure::with(USAGE))
}

/// Writes each requested drawing in its format.
pub(crate) fn write_shapes(
    arguments: &WriteArguments,
    formats: Vec<Option<Format>>,
    shapes: &Shapes,
) -> Result<(), Failure> {
    let beside = Beside { pixel: arguments.mask_pixel, depth: shapes.depth };
    for (path, format) in arguments.write.iter().zip(formats) {
        let bytes = match format {
            Some(format) => export::write(&shapes.spec, format, beside).map_err(Failure::with(USAGE))?,
            None => {
                let geometry = Geometry::new(&shapes.spec).map_err(Failure::with(BAD_INPUT))?;
                vtk::lines(&geometry.outline(), vtk::Compression::default()).map_err(Failure::with(BUG))?
            }
        };
        atomic::write(path, &bytes).map_err(Failure::with(USAGE))?;
        say(format_args!("wrote {}", path.display()));
    }
    Ok(())
}
