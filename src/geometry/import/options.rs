//! User options for a drawing: unit, window, layers, reading of masks and lists. All keys are optional.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::geometry::import::drawing::{Drawing, Unit};
use crate::geometry::import::format::Format;
use crate::geometry::import::units;
use crate::input::Range;
use crate::input::problem::Problem;
use crate::input::tables::{Key, Value};

/// Vertices with smaller angles than this, in degrees, belong to a smooth curve.
pub(crate) const SMOOTH_BELOW_DEG: f64 = 20.0;

/// Length of the drawing unit.
pub(crate) const SCALE: Key = Key::positive("a length in m");
/// Distance within which ends are joined.
pub(crate) const JOIN_WITHIN: Key = Key::positive("a length in units of the drawing")
    .help("leave it out to join ends that meet within 1e-6 of the drawing");
/// Gray value that separates solid from pore.
pub(crate) const THRESHOLD: Key = Key::number("a gray value", Range::Between(0.0, 1.0)).help("0.5 is the middle");
/// Side of a pixel.
pub(crate) const PIXEL_SIZE: Key = SCALE;
/// Angle of a smooth vertex.
pub(crate) const SMOOTH_BELOW: Key = Key::within("an angle in degrees", 0.0, 90.0).help("0: none");

/// What the outline around all others of a drawing without fills is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Frame {
    /// The frame of a chip or the wall of a chamber: its inside is the pore.
    Pore,
    /// The rim of a solid plate with holes.
    Solid,
}

impl Value for Frame {}

/// What shapes in or on larger ones are, where a drawing leaves it open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Nested {
    /// Channels or holes.
    Pore,
    /// Solid, united with the larger ones.
    Solid,
}

impl Value for Nested {}

/// Keys of `[geometry]` besides `file`, and options of the command line.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Options {
    /// Name of the drawing unit, as in `mm`.
    pub unit: Option<String>,
    /// Length of the drawing unit in m, instead of `unit`.
    pub scale: Option<f64>,
    /// Lower left and upper right corner of the domain in m.
    pub window: Option<[[f64; 2]; 2]>,
    /// Layers to read; all by default.
    pub layers: Option<Vec<String>>,
    /// Gap below which the ends of lines in a DXF drawing are joined, in units of the drawing.
    pub join_within: Option<f64>,
    /// Gray value that separates solid from pore, 0 (black) to 1 (white).
    pub threshold: Option<f64>,
    /// Side of a pixel in m.
    pub pixel_size: Option<f64>,
    /// Whether the drawn shapes are the pore and all else solid.
    pub invert: Option<bool>,
    /// Whether polygons whose vertices lie on a circle become discs (default yes).
    pub recognize_circles: Option<bool>,
    /// Vertices with smaller angles than this, in degrees, are points of a smooth curve; 0: none.
    pub smooth_below_deg: Option<f64>,
    /// Columns of x, y and radius in a list, counted from 0.
    pub columns: Option<[usize; 3]>,
    /// Separator of the columns of a list.
    pub separator: Option<char>,
    /// Whether the third column of a list holds diameters (default no).
    pub diameters: Option<bool>,
    /// What the outline around all others is, where a drawing leaves it open.
    pub frame: Option<Frame>,
    /// What shapes of another color on larger ones are, and outlines in others on layers of GDS.
    pub nested: Option<Nested>,
}

impl Options {
    /// Whether the drawn shapes are the pore.
    pub(crate) fn is_inverted(&self) -> bool {
        self.invert.unwrap_or(false)
    }

    /// The largest angle of a smooth vertex in rad.
    pub(crate) fn smooth_below(&self) -> f64 {
        self.smooth_below_deg.unwrap_or(SMOOTH_BELOW_DEG).to_radians()
    }

    /// Length of the drawing unit in m, and a note on its origin: the user, else the file, else the key is required.
    ///
    /// # Errors
    /// The missing key.
    pub(crate) fn length_of_unit(&self, drawing: &Drawing, format: Format) -> Result<(f64, String), Problem> {
        if let Some(size) = self.pixel_size {
            return Ok((size, format!("1 pixel = {size:e} m (pixel-size)")));
        }
        let of_file: Option<&Unit> = drawing.unit.as_ref();
        let instead = |meters: f64| match of_file {
            // Units of the same length have different names, and lengths differ by rounding.
            Some(unit) if (unit.meters / meters - 1.0).abs() > 1e-9 => format!(", not {} as the file says", unit.name),
            _ => String::new(),
        };
        if let Some(scale) = self.scale {
            return Ok((scale, format!("1 drawing unit = {scale:e} m (scale){}", instead(scale))));
        }
        if let Some(unit) = self.unit.as_deref().and_then(units::by_name) {
            return Ok((unit.meters, format!("drawing unit {} (unit){}", unit.name, instead(unit.meters))));
        }
        if let Some(unit) = of_file {
            return Ok((unit.meters, format!("drawing unit {} ({:e} m), as the file says", unit.name, unit.meters)));
        }
        if drawing.is_in_meters {
            return Ok((1.0, "drawing unit m".into()));
        }
        let message = format!("the unit of the drawing is not known: {} does not contain it", format.name());
        Err(Problem::new("unit", message, "add `unit = \"mm\"`, say, or `scale`, the length of the drawing unit in m"))
    }

    /// All problems of the options for a file of this format; the paths are keys, such as `unit`.
    pub(crate) fn problems(&self, format: Format) -> Vec<Problem> {
        let mut found = self.problems_of_values();
        let mut misplaced = |key: &str, is_given: bool, belongs: &[Format], of: &str| {
            if is_given && !belongs.contains(&format) {
                let help = format!("leave `{key}` out: it belongs to {of}");
                found.push(Problem::new(key, format!("`{key}` does not apply to {}", format.name()), help));
            }
        };
        misplaced("layers", self.layers.is_some(), &[Format::Svg, Format::Dxf], "SVG and DXF drawings");
        misplaced("join-within", self.join_within.is_some(), &[Format::Dxf], "DXF drawings");
        misplaced("threshold", self.threshold.is_some(), &[Format::Mask], "masks (PNG, TIFF)");
        misplaced("pixel-size", self.pixel_size.is_some(), &[Format::Mask], "masks (PNG, TIFF)");
        misplaced("columns", self.columns.is_some(), &[Format::List], "lists of discs");
        misplaced("diameters", self.diameters.is_some(), &[Format::List], "lists of discs");
        misplaced("separator", self.separator.is_some(), &[Format::List], "lists of discs");
        misplaced("frame", self.frame.is_some(), &[Format::Svg, Format::Dxf], "SVG and DXF drawings");
        misplaced("nested", self.nested.is_some(), &[Format::Svg, Format::Dxf], "SVG and DXF drawings");
        let drawn = [Format::Wkt, Format::GeoJson, Format::Shapefile, Format::Svg, Format::Dxf, Format::Mask];
        misplaced("recognize-circles", self.recognize_circles.is_some(), &drawn, "drawings with polygons");
        misplaced("smooth-below-deg", self.smooth_below_deg.is_some(), &drawn, "drawings with polygons");
        if format == Format::Toml {
            for (key, is_given) in [("unit", self.unit.is_some()), ("scale", self.scale.is_some())] {
                if is_given {
                    let message = format!("`{key}` does not apply to a TOML shape file");
                    found.push(Problem::new(key, message, "shape files in TOML are in m"));
                }
            }
        }
        if format == Format::Mask {
            if let Some(key) = self.unit.as_ref().map(|_| "unit").or(self.scale.map(|_| "scale")) {
                found.push(Problem::new(key, format!("`{key}` does not apply to a mask"), "give `pixel-size` in m"));
            }
            if self.pixel_size.is_none() {
                let message = "the side of a pixel is not known: an image has no unit";
                found.push(Problem::new("pixel-size", message, "add `pixel-size = 1.0e-6` (m)"));
            }
        }
        found
    }

    fn problems_of_values(&self) -> Vec<Problem> {
        let mut found = Vec::new();
        let mut refuse = |key: &str, message: String, help: &str| found.push(Problem::new(key, message, help));
        for (key, rule, value) in [
            ("scale", SCALE, self.scale),
            ("pixel-size", PIXEL_SIZE, self.pixel_size),
            ("join-within", JOIN_WITHIN, self.join_within),
            ("threshold", THRESHOLD, self.threshold),
            ("smooth-below-deg", SMOOTH_BELOW, self.smooth_below_deg),
        ] {
            if let Some(message) = value.and_then(|value| rule.misfit(value)) {
                refuse(key, message, rule.help);
            }
        }
        if let Some(name) = &self.unit {
            if self.scale.is_some() {
                refuse("scale", "`unit` and `scale` are both given".into(), "keep one of them");
            }
            if units::by_name(name).is_none() {
                refuse("unit", format!("there is no unit `{name}`"), &units::known_units());
            }
        }
        if let Some([min, max]) = self.window {
            let is_good = (0..2).all(|i| min[i].is_finite() && max[i].is_finite() && min[i] < max[i]);
            if !is_good {
                let message = format!("expected the lower left and the upper right corner, found {min:?} and {max:?}");
                refuse("window", message, "write window = [[x0, y0], [x1, y1]] in m with x0 < x1 and y0 < y1");
            }
        }
        if let Some(columns @ [x, y, r]) = self.columns
            && (x == y || y == r || x == r)
        {
            refuse("columns", format!("expected three different columns, found {columns:?}"), "the first one is 0");
        }
        if self.layers.as_ref().is_some_and(Vec::is_empty) {
            refuse("layers", "expected names of layers, found none".into(), "leave `layers` out to read all");
        }
        found
    }
}
