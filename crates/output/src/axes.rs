//! Parts of diagrams: colors and ranges (`plotters`).

use std::ops::Range;

use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::prelude::*;

use super::shade::line_shade;

/// Margin on either side of the data, as a fraction of the range.
const RIM: f64 = 0.06;
/// Colors distinguishable in color-blind vision and gray prints (Okabe and Ito 2008).
const COLORS: [RGBColor; 10] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(90, 90, 90),
    RGBColor(150, 75, 0),
    RGBColor(128, 128, 0),
    RGBColor(0, 0, 0),
];

/// A linear or logarithmic axis with its ticks.
#[derive(Debug, Clone)]
pub(super) struct NumberAxis {
    /// From its first to its last value.
    pub(super) range: Range<f64>,
    /// Whether equal ratios are equally long.
    pub(super) logarithmic: bool,
    /// The ticks.
    pub(super) ticks: Vec<f64>,
}

impl Ranged for NumberAxis {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let on = |value: f64| if self.logarithmic { value.ln() } else { value };
        let [start, end] = [self.range.start, self.range.end].map(on);
        let fraction = (on(*value) - start) / (end - start);
        limit.0 + (fraction * f64::from(limit.1 - limit.0)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

/// The color of a line by its index among `count` lines: from light to dark where distinguishable colors would repeat.
pub(super) fn color_of(number: usize, count: usize) -> RGBColor {
    if count > COLORS.len() { line_shade(number as f64 / (count - 1) as f64) } else { COLORS[number % COLORS.len()] }
}

/// The range of some values with a margin.
pub(super) fn range(values: impl Iterator<Item = f64> + Clone, logarithmic: bool) -> Range<f64> {
    /// Half the range around a single value, relative to it.
    const AROUND_ONE: f64 = 0.5;
    let to = |value: f64| if logarithmic { value.ln() } else { value };
    let from = |value: f64| if logarithmic { value.exp() } else { value };
    let values = values.filter(|value| !logarithmic || *value > 0.0);
    let low = to(values.clone().fold(f64::INFINITY, f64::min));
    let high = to(values.fold(f64::NEG_INFINITY, f64::max));
    let size = high - low;
    let rim = if size > 0.0 { RIM * size } else { (AROUND_ONE * low.abs()).max(AROUND_ONE) };
    from(low - rim)..from(high + rim)
}

/// Why drawing failed.
pub(super) type DrawingError<'a> = DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_single_point_has_room_around_it() {
        for logarithmic in [false, true] {
            let range = range([2.0].into_iter(), logarithmic);
            assert!(range.start < 1.5 && range.end > 2.5, "{range:?}");
        }
    }

    #[test]
    fn lines_of_one_diagram_have_different_colors() {
        for count in [1, 10, 11, 60] {
            let colors: Vec<RGBColor> = (0..count).map(|number| color_of(number, count)).collect();
            assert!((0..count).all(|k| !colors[..k].contains(&colors[k])), "{count}");
        }
    }
}
