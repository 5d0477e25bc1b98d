//! Colors of numbers, along a bar of colors.

use plotters::style::RGBColor;

use meniscus_core::diagram::{Axis, Color, colors};

/// The color at a fraction of the bar.
pub(crate) fn color_at(bar: &[Color], fraction: f64) -> Color {
    let position = fraction.clamp(0.0, 1.0) * (bar.len() - 1) as f64;
    let below = (position.floor() as usize).min(bar.len() - 2);
    let remainder = position - below as f64;
    let mix = |i: usize| {
        let (a, b) = (f64::from(bar[below][i]), f64::from(bar[below + 1][i]));
        (a + remainder * (b - a)).round() as u8
    };
    [mix(0), mix(1), mix(2)]
}

/// The color at a fraction from low, light, to high, dark; lighter ones would not be seen as lines on white.
pub(crate) fn line_shade(fraction: f64) -> RGBColor {
    const LIGHTEST: f64 = 0.12;
    shade(LIGHTEST + (1.0 - LIGHTEST) * fraction)
}

fn shade(fraction: f64) -> RGBColor {
    let [red, green, blue] = color_at(colors::SIZES, fraction);
    RGBColor(red, green, blue)
}

/// A scale of colors, for cells or for lines.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    /// Smallest and largest value.
    pub(crate) range: std::ops::Range<f64>,
    /// Whether equal ratios are equal differences of color.
    pub(crate) logarithmic: bool,
    /// Whether it is for lines.
    pub(crate) of_lines: bool,
}

impl Scale {
    /// Steps of color of cells: too many to be seen as steps, and few enough to keep files small.
    pub(crate) const STEPS: usize = 24;

    /// The scale of these values of a quantity; `None` if it can show none of them.
    pub(crate) fn of(quantity: &Axis, values: &[f64], of_lines: bool) -> Option<Self> {
        let shown: Vec<f64> = values.iter().copied().filter(|value| quantity.shows(*value)).collect();
        let low = shown.iter().copied().reduce(f64::min)?;
        let high = shown.iter().copied().reduce(f64::max)?;
        let range = if high - low > ROUNDING * high.abs().max(low.abs()) { low..high } else { around(low) };
        Some(Self { range, logarithmic: quantity.logarithmic, of_lines })
    }

    /// The position of a value from 0 at the low end to 1.
    pub(crate) fn fraction(&self, value: f64) -> f64 {
        let on = |value: f64| if self.logarithmic { value.ln() } else { value };
        (on(value) - on(self.range.start)) / (on(self.range.end) - on(self.range.start))
    }

    /// The step of a fraction.
    pub(crate) fn step(fraction: f64) -> usize {
        ((fraction * Self::STEPS as f64) as usize).min(Self::STEPS - 1)
    }

    /// The color of a step.
    pub(crate) fn color_of_step(&self, step: usize) -> RGBColor {
        let middle = (step as f64 + 0.5) / Self::STEPS as f64;
        if self.of_lines { line_shade(middle) } else { shade(middle) }
    }

    /// The color of a value; of lines not in steps, so that each has its own.
    pub(crate) fn color(&self, value: f64) -> RGBColor {
        let fraction = self.fraction(value);
        if self.of_lines { line_shade(fraction) } else { self.color_of_step(Self::step(fraction)) }
    }
}

/// Fraction of a value below which differences are rounding errors.
const ROUNDING: f64 = 1.0e-9;

/// The range around a single value.
fn around(value: f64) -> std::ops::Range<f64> {
    let half = if value == 0.0 { 1.0 } else { 0.5 * value.abs() };
    value - half..value + half
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_covers_negative_values_and_leaves_out_what_it_cannot_show() {
        let linear = Scale::of(&Axis::linear("p"), &[-3.0, f64::NAN, 1.0], false).unwrap();
        assert_eq!((linear.range.clone(), linear.fraction(-1.0)), (-3.0..1.0, 0.5));
        assert_eq!(linear.color(1.0), linear.color_of_step(Scale::STEPS - 1));
        assert_ne!(linear.color(-3.0), linear.color(1.0));
        let logarithmic = Scale::of(&Axis::logarithmic("t"), &[-1.0, 0.0, 1.0, 100.0], false).unwrap();
        assert_eq!((logarithmic.range.clone(), logarithmic.fraction(10.0)), (1.0..100.0, 0.5));
        assert_eq!(Scale::of(&Axis::linear("p"), &[4.0, 4.0], false).unwrap().range, 2.0..6.0);
        assert_eq!(Scale::of(&Axis::logarithmic("p"), &[-4.0, f64::NAN], false), None);
    }
}
