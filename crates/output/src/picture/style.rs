//! Common to all pictures: sizes, colors, and readable lengths and times.

use super::canvas::Rgb;
use meniscus_core::diagram::colors;

/// Width of the picture in pixels.
pub(super) const WIDTH: u32 = 1200;
/// White margin in pixels.
pub(super) const RIM: f32 = 30.0;
/// Space above the drawing for title and time, in pixels.
pub(super) const HEAD: f32 = 100.0;
/// Font sizes in pixels.
pub(super) const TITLE_SIZE: f32 = 32.0;
pub(super) const TEXT_SIZE: f32 = 24.0;
/// Largest width of the scale bar relative to that of the drawing.
pub(super) const BAR_SHARE: f64 = 0.25;

pub(super) const SOLID: Rgb = colors::SOLID;
pub(super) const OUTLINE: Rgb = colors::WALL;
pub(super) const INTERFACE: Rgb = colors::MENISCUS;
pub(super) const UNRESOLVED: Rgb = colors::MARK;
pub(super) const BLACK: Rgb = [0, 0, 0];

/// A phase of the drawing: number in the field `phase`, name, color, color of the inner dot.
pub(super) struct Phase {
    pub(super) number: i64,
    pub(super) name: &'static str,
    pub(super) color: Rgb,
    pub(super) core: Rgb,
}

/// Number of the phase of a pore without fluid, in the picture of a geometry.
pub const PORE: i64 = 3;

/// Phases in the pore.
pub(super) const FLUIDS: [Phase; 3] = [
    Phase { number: 0, name: "wetting", color: colors::WETTING, core: shade(colors::WETTING) },
    Phase { number: 1, name: "non-wetting", color: colors::NON_WETTING, core: shade(colors::NON_WETTING) },
    Phase { number: PORE, name: "pore", color: colors::PORE, core: colors::PORE },
];

/// A slightly darker color.
const fn shade(color: Rgb) -> Rgb {
    let mut shaded = color;
    let mut k = 0;
    while k < shaded.len() {
        shaded[k] = (color[k] as u16 * 85 / 100) as u8;
        k += 1;
    }
    shaded
}

/// The largest of 1, 2, 5 times a power of ten that is at most `length`, in m.
pub fn round_length(length: f64) -> f64 {
    let power = 10_f64.powf(length.log10().floor());
    [5.0, 2.0].into_iter().map(|digit| digit * power).find(|&candidate| candidate <= length).unwrap_or(power)
}

/// A value with at most six digits and a suitable SI prefix.
fn with_prefix(value: f64, unit: &str) -> String {
    const PREFIXES: [(f64, &str); 4] = [(1.0, ""), (1.0e-3, "m"), (1.0e-6, "µ"), (1.0e-9, "n")];
    // A relative tolerance, so that a rounded 1 mm does not become 1000 µm.
    let fits = |factor: f64| value.abs() >= factor * (1.0 - 1.0e-4);
    let (factor, prefix) = PREFIXES.into_iter().find(|(factor, _)| fits(*factor)).unwrap_or((1.0, ""));
    let digits = format!("{:.5}", value / factor);
    format!("{} {prefix}{unit}", digits.trim_end_matches('0').trim_end_matches('.'))
}

pub fn length_text(length: f64) -> String {
    with_prefix(length, "m")
}

pub(super) fn time_text(time: f64) -> String {
    format!("t = {}", with_prefix(time, "s"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_times_read_as_people_write_them() {
        assert_eq!(length_text(round_length(3.7e-4)), "200 µm");
        assert_eq!(length_text(round_length(1.0e-3)), "1 mm");
        assert_eq!(time_text(0.02), "t = 20 ms");
        assert_eq!(time_text(0.0), "t = 0 s");
    }
}
