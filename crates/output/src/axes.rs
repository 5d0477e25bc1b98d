//! Parts of diagrams: colors, ranges, round tick values, the legend (`plotters`).

use plotters::coord::ranged1d::{AsRangedCoord, ValueFormatter};
use plotters::prelude::*;

/// Width of a legend beside a drawing in pixels.
pub(super) const LEGEND: u32 = 270;
/// Height of a line of the legend in pixels.
const LEGEND_LINE: i32 = 20;
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

/// A numerical axis, linear or logarithmic.
pub(super) trait NumberAxis: AsRangedCoord<Value = f64, CoordDescType: ValueFormatter<f64>> {}

impl<A: AsRangedCoord<Value = f64, CoordDescType: ValueFormatter<f64>>> NumberAxis for A {}

/// The color of a line by its index.
pub(super) fn color_of(number: usize) -> RGBColor {
    COLORS[number % COLORS.len()]
}

/// The range of some values with a margin.
pub(super) fn range(values: impl Iterator<Item = f64> + Clone, logarithmic: bool) -> std::ops::Range<f64> {
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

/// Round tick values in a range of a logarithmic axis: powers of ten if there are enough of them, else more.
pub(super) fn logarithmic_ticks(range: &std::ops::Range<f64>) -> Vec<f64> {
    /// Fewest tick values that show a scale.
    const FEWEST: usize = 3;
    const STEPS: [&[f64]; 3] = [&[1.0], &[1.0, 2.0, 5.0], &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]];
    let exponents = range.start.log10().floor() as i32..=range.end.log10().floor() as i32;
    let ticks = |steps: &[f64]| -> Vec<f64> {
        // A product with a power of ten would have spurious trailing digits.
        let tick = |step: &f64, exponent: i32| format!("{step}e{exponent}").parse().unwrap_or(f64::NAN);
        let all = exponents.clone().flat_map(|e| steps.iter().map(move |step| tick(step, e)));
        all.filter(|tick| range.contains(tick)).collect()
    };
    let mut candidates = STEPS.iter().map(|steps| ticks(steps));
    candidates.find(|ticks| ticks.len() >= FEWEST).unwrap_or_else(|| ticks(STEPS[2]))
}

/// Why drawing failed.
pub(super) type DrawingError<'a> = DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>;

/// Draws the legend beside the drawing, where it covers nothing.
pub(super) fn draw_legend<'a>(
    area: &DrawingArea<SVGBackend<'a>, plotters::coord::Shift>,
    names: &[(String, RGBColor)],
) -> Result<(), DrawingError<'a>> {
    for (number, (name, color)) in names.iter().enumerate() {
        let y = 60 + LEGEND_LINE * number as i32;
        area.draw(&PathElement::new([(0, y), (18, y)], color.stroke_width(2)))?;
        area.draw(&Text::new(name.as_str(), (26, y - 6), ("sans-serif", 14)))?;
    }
    Ok(())
}

/// A tick label: only significant digits.
pub(super) fn short(value: f64) -> String {
    /// Outside of this range, an exponent is shorter than zeros.
    const FIXED: std::ops::Range<f64> = 1.0e-3..1.0e5;
    /// Rounds off the rounding errors of ticks.
    const DIGITS: usize = 6;
    let rounded: f64 = format!("{value:.DIGITS$e}").parse().unwrap_or(value);
    if rounded == 0.0 || FIXED.contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithmic_axes_have_round_numbers() {
        assert_eq!(logarithmic_ticks(&(0.5e-3..2.0)), [1.0e-3, 1.0e-2, 0.1, 1.0]);
        assert_eq!(logarithmic_ticks(&(0.3..1.4)), [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]);
    }

    #[test]
    fn a_single_point_has_room_around_it() {
        for logarithmic in [false, true] {
            let range = range([2.0].into_iter(), logarithmic);
            assert!(range.start < 1.5 && range.end > 2.5, "{range:?}");
        }
    }
}
