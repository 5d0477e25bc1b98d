//! Import options of a drawing, shared by the commands that read one.

use clap::Args;

use meniscus_drawings::import::{Frame, Nested, Options};

/// How a drawing is read: the keys of `[geometry]` besides `file`.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "How a drawing is read")]
pub(crate) struct ImportArguments {
    /// Unit of the drawing: m, cm, mm, um, nm, in, mil, ft, pt or px
    #[arg(long, value_name = "UNIT")]
    pub(crate) unit: Option<String>,
    /// Length of the drawing unit in m, instead of --unit
    #[arg(long, value_name = "M")]
    pub(crate) scale: Option<f64>,
    /// Corners of the domain in m: shapes outside of it are ignored
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = numbers::<f64, 4>, allow_hyphen_values = true)]
    pub(crate) window: Option<[f64; 4]>,
    /// Layers to read; all if not given
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub(crate) layers: Option<Vec<String>>,
    /// Gap below which the ends of lines in a DXF drawing are joined, in units of the drawing
    #[arg(long, value_name = "LENGTH")]
    pub(crate) join_within: Option<f64>,
    /// Gray value that separates solid and pore of a mask, from 0 (black) to 1 (white)
    #[arg(long, value_name = "GRAY")]
    pub(crate) threshold: Option<f64>,
    /// Side of a pixel of a mask in m
    #[arg(long, value_name = "M")]
    pub(crate) pixel_size: Option<f64>,
    /// The shapes are the pore, and all else is solid
    #[arg(long)]
    pub(crate) invert: bool,
    /// Keep polygons whose vertices lie on a circle
    #[arg(long)]
    pub(crate) no_circles: bool,
    /// Vertices with a turning angle below this many degrees become arcs; 20 if not given, 0 for none
    #[arg(long, value_name = "DEG")]
    pub(crate) smooth_below_deg: Option<f64>,
    /// Columns of x, y and radius in a list of discs, the first one being 0
    #[arg(long, value_name = "X,Y,R", value_parser = numbers::<usize, 3>)]
    pub(crate) columns: Option<[usize; 3]>,
    /// The character between the columns of a list of discs
    #[arg(long, value_name = "CHAR")]
    pub(crate) separator: Option<char>,
    /// The third column of a list of discs is the diameter
    #[arg(long)]
    pub(crate) diameters: bool,
    /// The outline without fill around all others: a frame with the pore inside, or the rim of a solid plate
    #[arg(long, value_name = "pore|solid", value_parser = frame)]
    pub(crate) frame: Option<Frame>,
    /// Shapes of another color on larger ones, or outlines in others on layers of GDS
    #[arg(long, value_name = "pore|solid", value_parser = nested)]
    pub(crate) nested: Option<Nested>,
}

impl ImportArguments {
    /// The same as options of the reader.
    pub(crate) fn options(&self) -> Options {
        Options {
            unit: self.unit.clone(),
            scale: self.scale,
            window: self.window.map(|[x0, y0, x1, y1]| [[x0, y0], [x1, y1]]),
            layers: self.layers.clone(),
            join_within: self.join_within,
            threshold: self.threshold,
            pixel_size: self.pixel_size,
            invert: self.invert.then_some(true),
            recognize_circles: self.no_circles.then_some(false),
            smooth_below_deg: self.smooth_below_deg,
            columns: self.columns,
            separator: self.separator,
            diameters: self.diameters.then_some(true),
            frame: self.frame,
            nested: self.nested,
        }
    }
}

fn frame(text: &str) -> Result<Frame, String> {
    match text {
        "pore" => Ok(Frame::Pore),
        "solid" => Ok(Frame::Solid),
        _ => Err("expected pore or solid".to_owned()),
    }
}

fn nested(text: &str) -> Result<Nested, String> {
    match text {
        "pore" => Ok(Nested::Pore),
        "solid" => Ok(Nested::Solid),
        _ => Err("expected pore or solid".to_owned()),
    }
}

/// `N` numbers separated by commas.
fn numbers<T: std::str::FromStr, const N: usize>(text: &str) -> Result<[T; N], String> {
    let found: Result<Vec<T>, _> = text.split(',').map(|word| word.trim().parse()).collect();
    let expected = || format!("expected {N} numbers separated by commas");
    found.map_err(|_| expected())?.try_into().map_err(|_| expected())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_separated_by_commas_and_counted() {
        assert_eq!(numbers::<f64, 4>("-1e-3, 0,2,3.5"), Ok([-1e-3, 0.0, 2.0, 3.5]));
        assert!(numbers::<usize, 3>("0,1").is_err() && numbers::<usize, 3>("0,1,x").is_err());
    }
}
