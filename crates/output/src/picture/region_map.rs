//! A map of the plane: areas colored along a bar or by class, with walls, lines, scale bar and legend.

use super::canvas::{Canvas, Picture, PictureError, Rgb};
use super::style::{INTERFACE, OUTLINE, RIM, SOLID, TEXT_SIZE, WIDTH};
use super::view::{View, heading, scale_bar};
use crate::shade::color_at;
use crate::ticks::{short, ticks};
use meniscus_core::diagram::{RegionMap, Tone, colors};
use meniscus_core::math::{Bounds, Vec2};

/// Space below the drawing in pixels: color bar with its numbers, scale bar and legend.
const FOOT: f32 = 190.0;
/// Height of the color bar in pixels.
const BAR: f32 = 26.0;

/// The smallest visible width of a strip in pixels.
const THINNEST: f32 = 2.0;
/// The color of throats.
const THROAT: Rgb = colors::MARK;

/// What the maps of one part of a run have in common, so that only their contents differ: the color bar and the legend.
#[derive(Debug, Clone)]
pub struct MapScene {
    /// Ends of the bar; `None` while nothing has a value beyond the first one.
    range: Option<[f64; 2]>,
    /// Whether there are areas of each class.
    classes: Vec<bool>,
    /// Whether there are strips, menisci and throats.
    lines: [bool; 3],
}

impl MapScene {
    /// That of one map.
    pub fn of(map: &RegionMap) -> Self {
        let has = |tone: Tone| map.areas.iter().any(|area| area.tone == tone);
        let has_values = map.areas.iter().any(|area| matches!(area.tone, Tone::Value(value) if value > map.range[0]));
        Self {
            range: has_values.then_some(map.range),
            classes: (0..map.classes.len()).map(|class| has(Tone::Class(class))).collect(),
            lines: [!map.strips.2.is_empty(), !map.menisci.1.is_empty(), !map.throats.1.is_empty()],
        }
    }

    /// That of the maps of both.
    #[must_use]
    pub fn with(mut self, other: &Self) -> Self {
        let both = [self.range, other.range].into_iter().flatten();
        self.range = both.reduce(|[low, high], [other_low, other_high]| [low.min(other_low), high.max(other_high)]);
        self.classes.iter_mut().zip(&other.classes).for_each(|(has, other)| *has |= other);
        self.lines.iter_mut().zip(other.lines).for_each(|(has, other)| *has |= other);
        self
    }

    /// Names and colors of what is drawn. Films of the color of a class are named with it.
    fn legend(&self, map: &RegionMap) -> Vec<(String, Rgb)> {
        let [has_strips, has_menisci, has_throats] = self.lines;
        let classes = map.classes.iter().zip(&self.classes).filter(|(_, has)| **has).map(|(class, _)| *class);
        let (strips, strip_color, _) = map.strips;
        let joined = |(name, color): (&str, Rgb)| match has_strips && color == strip_color {
            true => (format!("{name} and {strips}"), color),
            false => (name.to_owned(), color),
        };
        let are_alone = has_strips && classes.clone().all(|(_, color)| color != strip_color);
        let others = [
            (true, "solid", SOLID),
            (are_alone, strips, strip_color),
            (has_menisci, map.menisci.0, INTERFACE),
            (has_throats, map.throats.0, THROAT),
        ];
        let others = others.into_iter().filter(|(has, ..)| *has).map(|(_, name, color)| (name.to_owned(), color));
        classes.map(joined).chain(others).collect()
    }

    /// Draws a map.
    ///
    /// # Errors
    /// [`PictureError`] if there is nothing to draw.
    pub fn draw(&self, map: &RegionMap, title: &str) -> Result<Picture, PictureError> {
        let [min, max] = map.frame.bounds.map(Vec2::from);
        let view = View::new(Bounds { min, max }, Some(&map.frame));
        if !(view.scale.is_finite() && view.scale > 0.0) || map.areas.is_empty() {
            return Err(PictureError::Empty);
        }
        let bottom = view.bottom();
        let mut canvas = Canvas::new(WIDTH, (bottom + FOOT).ceil() as u32)?;
        canvas.rectangle(view.corner, view.size, SOLID);
        let range = self.range.unwrap_or(map.range);
        areas(&mut canvas, &view, map, range);
        lines(&mut canvas, &view, map);
        view.frame(&mut canvas);
        heading(&mut canvas, title, &map.note);
        color_bar(&mut canvas, map, range, bottom + 24.0);
        let size = view.size.map(|pixels| f64::from(pixels) / view.scale);
        let [_, text] = scale_bar(&mut canvas, view.scale, size[0].max(0.5 * size[1]), bottom + 130.0);
        let end = WIDTH as f32 - RIM;
        canvas.legend(&self.legend(map), [end, bottom + 168.0], end - text, TEXT_SIZE);
        Ok(canvas.picture())
    }
}

/// Draws a map.
///
/// # Errors
/// [`PictureError`] if there is nothing to draw.
pub fn region_map_picture(region_map: &RegionMap, title: &str) -> Result<Picture, PictureError> {
    MapScene::of(region_map).draw(region_map, title)
}

/// A line or a boundary in pixels.
fn pixels<'a>(view: &'a View, line: &'a [[f64; 2]]) -> impl Iterator<Item = [f32; 2]> + 'a {
    line.iter().map(|&x| view.pixel(x.into()))
}

fn areas(canvas: &mut Canvas, view: &View, map: &RegionMap, [low, high]: [f64; 2]) {
    for area in &map.areas {
        let color = match area.tone {
            Tone::Value(value) => color_at(map.bar, (value - low) / (high - low)),
            Tone::Class(class) => map.classes.get(class).map_or(SOLID, |(_, color)| *color),
        };
        canvas.polygon(map.boundary(area).map(|x| view.pixel(x)), color);
    }
}

fn lines(canvas: &mut Canvas, view: &View, map: &RegionMap) {
    // Thousands of grains require thin lines.
    const FEW: usize = 500;
    let thin = if map.walls.len() < FEW { 1.0 } else { 0.4 };
    let (_, color, strips) = &map.strips;
    if !strips.is_empty() {
        canvas.within(map.areas.iter().map(|area| map.boundary(area).map(|x| view.pixel(x))));
    }
    for (line, width) in strips {
        let width = ((width * view.scale) as f32).max(THINNEST);
        canvas.polyline(pixels(view, line), width, *color);
    }
    canvas.everywhere();
    map.walls.iter().for_each(|wall| canvas.polyline(pixels(view, wall), 1.5 * thin, OUTLINE));
    map.throats.1.iter().for_each(|throat| canvas.dashes(pixels(view, throat), 2.0 * thin, THROAT));
    map.menisci.1.iter().for_each(|line| canvas.polyline(pixels(view, line), 3.0 * thin, INTERFACE));
}

fn color_bar(canvas: &mut Canvas, region_map: &RegionMap, [low, high]: [f64; 2], top: f32) {
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
    for value in ticks(&(low..high), false) {
        let (text, at) = (short(value), from + ((value - low) / (high - low)) as f32 * length);
        let wide = canvas.text_width(&text, TEXT_SIZE);
        canvas.rectangle([at.round() - 1.0, top + BAR], [2.0, 5.0], OUTLINE);
        canvas.text(&text, [(at - 0.5 * wide).min(RIM + width - wide), top + BAR + 28.0], TEXT_SIZE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::diagram::{Area, Frame};
    use meniscus_core::snapshot::{Outlined, Outlines};
    use std::sync::Arc;

    struct Square;

    impl Outlined for Square {
        fn outline(&self, _: usize) -> Vec<Vec2> {
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(Vec2::from).to_vec()
        }
    }

    fn region_map() -> RegionMap {
        let square = |x: f64, tone| Area { cell: 0, shift: Vec2::new(x, 0.0), tone };
        RegionMap {
            part: 0,
            note: "a note".into(),
            label: "share",
            range: [0.0, 2.0],
            classes: vec![("trapped", [204, 121, 167])],
            bar: colors::SIZES,
            frame: Frame { bounds: [[0.0, 0.0], [4.0, 1.0]], open: [None; 4], periodic: [false; 2] },
            areas: vec![square(0.0, Tone::Value(2.0)), square(1.0, Tone::Class(0)), square(2.0, Tone::Value(0.0))],
            outlines: Outlines(Arc::new(Square)),
            walls: vec![vec![[3.0, 0.0], [3.0, 1.0]]],
            menisci: ("menisci", vec![vec![[1.0, 0.0], [1.0, 1.0]]]),
            throats: ("throats", vec![vec![[2.0, 0.0], [2.0, 1.0]]]),
            strips: ("films", colors::WETTING, Vec::new()),
        }
    }

    #[test]
    fn areas_fill_their_share_of_the_drawing_in_their_colors() {
        let drawn = region_map_picture(&region_map(), "Squares").unwrap();
        let square = f64::from(WIDTH as f32 - 2.0 * RIM).powi(2) / 16.0;
        for color in [colors::SIZES[0], colors::SIZES[colors::SIZES.len() - 1], [204, 121, 167], SOLID] {
            let count = drawn.count(color) as f64;
            // Lines cover a few columns of each square, the legend adds a dot.
            assert!((count / square - 1.0).abs() < 0.03, "{color:?}: {}", count / square);
        }
    }

    #[test]
    fn films_stay_within_areas_and_are_named_with_their_phase() {
        let strips = |color| ("films", color, vec![(vec![[1.5, 0.5], [3.5, 0.5]], 0.5)]);
        let map = RegionMap { strips: strips([1, 2, 3]), ..region_map() };
        let square = f64::from(WIDTH as f32 - 2.0 * RIM).powi(2) / 16.0;
        let count = region_map_picture(&map, "").unwrap().count([1, 2, 3]) as f64;
        // From the middle of the second square to the end of the third one, with a round beginning and a dot of the legend.
        assert!((count / square - 0.85).abs() < 0.03, "{}", count / square);
        let names =
            |map: &RegionMap| MapScene::of(map).legend(map).into_iter().map(|(name, _)| name).collect::<Vec<_>>();
        assert_eq!(names(&map), ["trapped", "solid", "films", "menisci", "throats"]);
        let alike = RegionMap { strips: strips([204, 121, 167]), ..region_map() };
        assert_eq!(names(&alike), ["trapped and films", "solid", "menisci", "throats"]);
    }

    #[test]
    fn the_bar_and_the_legend_of_a_movie_are_those_of_all_of_it() {
        let end = region_map();
        let mut begin = RegionMap { range: [0.0, 1.0], ..region_map() };
        begin.areas.retain(|area| area.tone == Tone::Value(0.0));
        let scene = MapScene::of(&begin).with(&MapScene::of(&end));
        assert_eq!((scene.range, scene.legend(&begin)), (Some([0.0, 2.0]), MapScene::of(&end).legend(&end)));
    }

    #[test]
    fn nothing_to_draw_is_an_error() {
        let nothing = RegionMap { areas: Vec::new(), ..region_map() };
        assert!(matches!(region_map_picture(&nothing, ""), Err(PictureError::Empty)));
    }
}
