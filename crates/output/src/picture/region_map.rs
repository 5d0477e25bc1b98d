//! A map of the plane: areas colored along a bar or by class, with walls, lines, scale bar and legend.

use super::canvas::{Canvas, PictureError, Rgb};
use super::style::{INTERFACE, OUTLINE, RIM, SOLID, TEXT_SIZE, WIDTH};
use super::view::{View, heading, scale_bar};
use crate::shade::color_at;
use crate::ticks::short;
use meniscus_core::diagram::{RegionMap, Tone, colors};
use meniscus_core::math::{Bounds, Vec2};

/// Space below the drawing in pixels: color bar with its numbers, scale bar and legend.
const FOOT: f32 = 190.0;
/// Height of the color bar in pixels.
const BAR: f32 = 26.0;

/// The color of strips, which are films of the wetting phase, and the smallest visible width in pixels.
const STRIP: Rgb = colors::WETTING;
const THINNEST: f32 = 2.0;
/// The color of throats.
const THROAT: Rgb = colors::MARK;

/// Draws a map as a PNG file.
pub fn region_map_picture(region_map: &RegionMap, title: &str) -> Result<Vec<u8>, PictureError> {
    let [min, max] = region_map.frame.bounds.map(Vec2::from);
    let view = View::new(Bounds { min, max }, Some(&region_map.frame));
    if !(view.scale.is_finite() && view.scale > 0.0) || region_map.areas.is_empty() {
        return Err(PictureError::Empty);
    }
    let bottom = view.bottom();
    let mut canvas = Canvas::new(WIDTH, (bottom + FOOT).ceil() as u32)?;
    canvas.rectangle(view.corner, view.size, SOLID);
    let [low, high] = region_map.range;
    for area in &region_map.areas {
        let color = match area.tone {
            Tone::Value(value) => color_at(region_map.bar, (value - low) / (high - low)),
            Tone::Class(class) => region_map.classes.get(class).map_or(SOLID, |(_, color)| *color),
        };
        canvas.polygon(area.boundary.iter().map(|&x| view.pixel(x.into())), color);
    }
    // Thousands of grains require thin lines.
    const FEW: usize = 500;
    let thin = if region_map.walls.len() < FEW { 1.0 } else { 0.4 };
    for (line, width) in &region_map.strips.1 {
        let width = ((width * view.scale) as f32).max(THINNEST);
        canvas.polyline(line.iter().map(|&x| view.pixel(x.into())), width, STRIP);
    }
    for wall in &region_map.walls {
        canvas.polyline(wall.iter().map(|&x| view.pixel(x.into())), 1.5 * thin, OUTLINE);
    }
    for throat in &region_map.throats.1 {
        canvas.dashes(throat.iter().map(|&x| view.pixel(x.into())), 2.0 * thin, THROAT);
    }
    for line in &region_map.menisci.1 {
        canvas.polyline(line.iter().map(|&x| view.pixel(x.into())), 3.0 * thin, INTERFACE);
    }
    view.frame(&mut canvas);
    heading(&mut canvas, title, &region_map.note);
    color_bar(&mut canvas, region_map, bottom + 24.0);
    let size = view.size.map(|pixels| f64::from(pixels) / view.scale);
    scale_bar(&mut canvas, view.scale, size[0].max(0.5 * size[1]), bottom + 130.0);
    legend(&mut canvas, region_map, bottom + 168.0);
    canvas.png()
}

fn color_bar(canvas: &mut Canvas, region_map: &RegionMap, top: f32) {
    /// Numbers below the bar.
    const NUMBERS: u32 = 5;
    let width = WIDTH as f32 - 2.0 * RIM;
    let label = format!("{}:", region_map.label);
    // Whole pixels: otherwise the background would show between columns.
    let from = (RIM + canvas.text_width(&label, TEXT_SIZE) + 20.0).round();
    canvas.text(&label, [RIM, top + 22.0], TEXT_SIZE);
    let length = RIM + width - from;
    for column in 0..length as u32 {
        let fraction = f64::from(column) / f64::from(length);
        canvas.rectangle([from + column as f32, top], [1.0, BAR], color_at(region_map.bar, fraction));
    }
    let [low, high] = region_map.range;
    for number in 0..NUMBERS {
        let fraction = f64::from(number) / f64::from(NUMBERS - 1);
        let value = low + fraction * (high - low);
        let text = short(format!("{value:.2e}").parse().unwrap_or(value));
        let wide = canvas.text_width(&text, TEXT_SIZE);
        let x = (from + fraction as f32 * length - 0.5 * wide).min(RIM + width - wide);
        canvas.text(&text, [x, top + BAR + 28.0], TEXT_SIZE);
    }
}

/// The legend, from the right.
fn legend(canvas: &mut Canvas, region_map: &RegionMap, y: f32) {
    let is_there = |class: usize| region_map.areas.iter().any(|area| area.tone == Tone::Class(class));
    let classes = region_map.classes.iter().enumerate().filter(|(class, _)| is_there(*class)).map(|(_, entry)| *entry);
    let menisci = Some((region_map.menisci.0, INTERFACE)).filter(|_| !region_map.menisci.1.is_empty());
    let throats = Some((region_map.throats.0, THROAT)).filter(|_| !region_map.throats.1.is_empty());
    let strips = Some((region_map.strips.0, STRIP)).filter(|_| !region_map.strips.1.is_empty());
    let entries: Vec<(&str, Rgb)> =
        classes.chain([("solid", SOLID)]).chain(strips).chain(menisci).chain(throats).collect();
    canvas.legend(&entries, [WIDTH as f32 - RIM, y], TEXT_SIZE);
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::diagram::{Area, Frame};

    fn region_map() -> RegionMap {
        let square = |x: f64, tone| Area { boundary: vec![[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]], tone };
        RegionMap {
            name: "test",
            note: "a note".into(),
            label: "share",
            range: [0.0, 2.0],
            classes: vec![("trapped", [204, 121, 167])],
            bar: colors::SIZES,
            frame: Frame { bounds: [[0.0, 0.0], [4.0, 1.0]], open: [None; 4], periodic: [false; 2] },
            areas: vec![square(0.0, Tone::Value(2.0)), square(1.0, Tone::Class(0)), square(2.0, Tone::Value(0.0))],
            walls: vec![vec![[3.0, 0.0], [3.0, 1.0]]],
            menisci: ("menisci", vec![vec![[1.0, 0.0], [1.0, 1.0]]]),
            throats: ("throats", vec![vec![[2.0, 0.0], [2.0, 1.0]]]),
            strips: ("films", Vec::new()),
        }
    }

    #[test]
    fn areas_fill_their_share_of_the_drawing_in_their_colors() {
        let png = region_map_picture(&region_map(), "Squares").unwrap();
        let pixels = tiny_skia::Pixmap::decode_png(&png).unwrap();
        let square = f64::from(WIDTH as f32 - 2.0 * RIM).powi(2) / 16.0;
        for color in [colors::SIZES[0], colors::SIZES[colors::SIZES.len() - 1], [204, 121, 167], SOLID] {
            let count = pixels.pixels().iter().filter(|p| [p.red(), p.green(), p.blue()] == color).count() as f64;
            // Lines cover a few columns of each square, the legend adds a dot.
            assert!((count / square - 1.0).abs() < 0.03, "{color:?}: {}", count / square);
        }
    }

    #[test]
    fn nothing_to_draw_is_an_error() {
        let nothing = RegionMap { areas: Vec::new(), ..region_map() };
        assert!(matches!(region_map_picture(&nothing, ""), Err(PictureError::Empty)));
    }
}
