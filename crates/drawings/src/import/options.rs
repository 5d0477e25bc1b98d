//! User options for a drawing: unit, window, layers, reading of masks and lists. All keys are optional.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::import::drawing::{Drawing, Unit};
use crate::import::format::Format;
use crate::import::units;
use meniscus_core::input::problem::Problem;
use meniscus_core::input::tables::{Key, Value};
use meniscus_core::input::{Checker, Range};

/// Vertices with smaller angles than this, in degrees, belong to a smooth curve.
pub(crate) const SMOOTH_BELOW_DEG: f64 = 20.0;

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

/// Declares a table that has, after its own keys, the options of a drawing, and its conversion to [`Options`].
#[macro_export]
macro_rules! with_drawing_options {
    (@options { $(#[$outer:meta])* $vis:vis struct $name:ident { $($own:tt)* } }
        $($(#[$doc:meta])* $field:ident: $kind:ty $(=> $key:expr)?,)*
    ) => {
        meniscus_core::tables! {
            $(#[$outer])*
            $vis struct $name { $($own)* $($(#[$doc])* pub $field: $kind $(=> $key)?,)* }
        }

        impl From<&$name> for Options {
            fn from(table: &$name) -> Self {
                Self { $($field: table.$field.clone(),)* }
            }
        }
    };
    ($($table:tt)*) => {
        $crate::with_drawing_options! {
            @options { $($table)* }
            /// Unit of the drawing: m, cm, mm, um, nm, in, mil, ft, pt or px (default: that of the file).
            unit: String,
            /// Drawing unit in m, instead of `unit`.
            scale: f64 => Key::positive("a length in m"),
            /// Lower left and upper right corner in m of the part that becomes the domain (default: all).
            window: [[f64; 2]; 2],
            /// Layers of an SVG or DXF drawing (default: all).
            layers: Vec<String>,
            /// Gap below which the ends of lines in a DXF drawing are joined, in units of the drawing (default: 1e-6 of its size).
            join_within: f64 => Key::positive("a length in units of the drawing")
                .help("leave it out to join ends that meet within 1e-6 of the drawing"),
            /// Gray value between solid (0, black) and pore (1, white) of a mask (default: that of the image).
            threshold: f64 => Key::number("a gray value", Range::Between(0.0, 1.0)).help("0.5 is the middle"),
            /// Side of a mask pixel in m (required for a mask).
            pixel_size: f64 => Key::positive("a length in m"),
            /// Exchanges solid and pore of the file (default false).
            invert: bool,
            /// Reads polygons with vertices on a circle as discs (default true).
            recognize_circles: bool,
            /// Polygon corners with a turning angle below this many degrees become arcs; 0: none (default 20.0).
            smooth_below_deg: f64 => Key::within("an angle in degrees", 0.0, 90.0).help("0: none"),
            /// Columns of x, y and radius in a disc list, from 0 (default `[0, 1, 2]`).
            columns: [usize; 3],
            /// Separator of a disc list (default: any usual one).
            separator: char,
            /// The third column of a disc list is the diameter; required if its header names them (default false).
            diameters: bool,
            /// Whether the outline without fill around all others is the frame of the chip, with pore inside, or the rim of a solid plate (default: by layers and nesting).
            frame: Frame,
            /// Whether shapes of another color on larger ones, and outlines in others (on layers named as KLayout names those of GDS), are pore or solid; required there.
            nested: Nested,
        }
    };
}

with_drawing_options! {
    /// How a drawing is read: keys of `[geometry]`, options of the command line.
    pub struct Options {}
}

impl Options {
    /// The given options, by key.
    pub fn given(&self) -> toml::Table {
        // Numbers, texts and lists of them can be written as TOML.
        toml::Table::try_from(self).unwrap_or_default()
    }

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
    pub fn problems(&self, format: Format) -> Vec<Problem> {
        let mut found = self.problems_of_values();
        let given = self.given();
        let mut misplaced = |key: &str, belongs: &[Format], of: &str| {
            if given.contains_key(key) && !belongs.contains(&format) {
                let help = format!("leave `{key}` out: it belongs to {of}");
                found.push(Problem::new(key, format!("`{key}` does not apply to {}", format.name()), help));
            }
        };
        misplaced("layers", &[Format::Svg, Format::Dxf], "SVG and DXF drawings");
        misplaced("join-within", &[Format::Dxf], "DXF drawings");
        misplaced("threshold", &[Format::Mask], "masks (PNG, TIFF)");
        misplaced("pixel-size", &[Format::Mask], "masks (PNG, TIFF)");
        misplaced("columns", &[Format::List], "lists of discs");
        misplaced("diameters", &[Format::List], "lists of discs");
        misplaced("separator", &[Format::List], "lists of discs");
        misplaced("frame", &[Format::Svg, Format::Dxf], "SVG and DXF drawings");
        misplaced("nested", &[Format::Svg, Format::Dxf], "SVG and DXF drawings");
        let drawn = [Format::Wkt, Format::GeoJson, Format::Shapefile, Format::Svg, Format::Dxf, Format::Mask];
        misplaced("recognize-circles", &drawn, "drawings with polygons");
        misplaced("smooth-below-deg", &drawn, "drawings with polygons");
        if format == Format::Toml {
            for key in ["unit", "scale"].into_iter().filter(|key| given.contains_key(*key)) {
                let message = format!("`{key}` does not apply to a TOML shape file");
                found.push(Problem::new(key, message, "shape files in TOML are in m"));
            }
        }
        if format == Format::Mask {
            if let Some(key) = ["unit", "scale"].into_iter().find(|key| given.contains_key(*key)) {
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
        let mut checker = Checker::default();
        self.clone().in_range(&mut checker, "");
        let mut found = checker.problems;
        let mut refuse = |key: &str, message: String, help: &str| found.push(Problem::new(key, message, help));
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
