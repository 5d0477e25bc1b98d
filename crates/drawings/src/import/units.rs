//! Units of length by name.

use crate::import::drawing::Unit;

/// Names of units with their length in m; the first name of a length is the one displayed. The inch is exactly 25.4 mm, and a CSS pixel 1/96 of it; the foot
/// is the international one.
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

/// The remedy for an unknown name.
pub(crate) fn known_units() -> String {
    "use m, cm, mm, um, nm, in, mil, ft, pt or px, or `scale`, the length of the drawing unit in m".into()
}
