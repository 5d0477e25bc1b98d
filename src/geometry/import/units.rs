//! Units of length by name, and the unit of a drawing: that of the user, else that of the file, else the key is asked for.

use crate::geometry::import::drawing::Unit;
use crate::geometry::import::format::Format;
use crate::geometry::import::options::Options;
use crate::input::problem::Problem;

/// Names of units with their length in m; the first name of a length is the one shown. The inch is exactly 25.4 mm, and a CSS pixel
/// 1/96 of it; the foot is the international one.
const UNITS: [(&str, f64); 17] = [
    ("m", 1.0),
    ("cm", 1.0e-2),
    ("mm", 1.0e-3),
    ("um", 1.0e-6),
    ("µm", 1.0e-6),
    ("μm", 1.0e-6),
    ("nm", 1.0e-9),
    ("km", 1.0e3),
    ("in", 0.0254),
    ("inch", 0.0254),
    ("ft", 0.3048),
    ("foot", 0.3048),
    ("mil", 2.54e-5),
    ("pt", 0.0254 / 72.0),
    ("pc", 0.0254 / 6.0),
    ("px", 0.0254 / 96.0),
    ("us-ft", 1200.0 / 3937.0),
];

/// The unit of this name.
pub(crate) fn by_name(name: &str) -> Option<Unit> {
    let name = name.trim();
    UNITS.iter().find(|unit| unit.0 == name).map(|&(name, meters)| Unit { name: name.into(), meters })
}

/// What to write in place of an unknown name.
pub(crate) fn way_out() -> String {
    "use m, cm, mm, um, nm, in, mil, ft, pt or px, or `scale`, the length of the drawing unit in m".into()
}

/// Length of the drawing unit in m, and a note on where it comes from.
///
/// # Errors
/// The key that is missing.
pub(crate) fn scale(options: &Options, of_file: Option<&Unit>, format: Format) -> Result<(f64, String), Problem> {
    if let Some(size) = options.pixel_size.filter(|_| format == Format::Mask) {
        return Ok((size, format!("1 pixel = {size:e} m (pixel-size)")));
    }
    let instead = |meters: f64| match of_file {
        // Names of one length differ, and lengths by rounding.
        Some(unit) if (unit.meters / meters - 1.0).abs() > 1e-9 => format!(", not {} as the file says", unit.name),
        _ => String::new(),
    };
    if let Some(scale) = options.scale {
        return Ok((scale, format!("1 drawing unit = {scale:e} m (scale){}", instead(scale))));
    }
    if let Some(unit) = options.unit.as_deref().and_then(by_name) {
        return Ok((unit.meters, format!("drawing unit {} (unit){}", unit.name, instead(unit.meters))));
    }
    if let Some(unit) = of_file {
        return Ok((unit.meters, format!("drawing unit {} ({:e} m), as the file says", unit.name, unit.meters)));
    }
    if format.is_in_meters() {
        return Ok((1.0, "drawing unit m".into()));
    }
    let message = format!("the unit of the drawing is not known: {} does not say it", format.name());
    Err(Problem::new("unit", message, "add `unit = \"mm\"`, say, or `scale`, the length of the drawing unit in m"))
}
