//! A thin film: its profile, filled, over the wall. A film is so flat that heights are exaggerated; the picture states the factor.

use super::canvas::{Canvas, Picture, PictureError};
use super::style::{FLUIDS, HEAD, INTERFACE, OUTLINE, RIM, SOLID, TEXT_SIZE, WIDTH, length_text, time_text};
use super::view::{heading, scale_bar};
use meniscus_core::math::Vec2;
use meniscus_core::snapshot::Snapshot;

/// Height of the drawing in pixels, and the fraction of it that the film fills.
const TALL: f32 = 380.0;
const FILLED: f64 = 0.9;
/// Thickness of the wall, and space below it, in pixels.
const WALL: f32 = 24.0;
const FOOT: f32 = 90.0;

/// Whether a snapshot is that of a film.
pub(super) fn is_film(snapshot: &Snapshot<'_>) -> bool {
    snapshot.particles.fields.iter().any(|field| field.name == "film-height")
}

/// The section that is drawn.
#[derive(Debug, Clone)]
pub(super) struct FilmScene {
    /// Position of its left and right end in m.
    ends: [f64; 2],
    /// Largest height in m.
    highest: f64,
}

/// The line of a snapshot.
fn profile<'a>(snapshot: &'a Snapshot<'_>) -> &'a [Vec2] {
    snapshot.interface.as_ref().map_or(&[], |lines| &lines.points)
}

impl FilmScene {
    pub(super) fn of(snapshot: &Snapshot<'_>) -> Result<Self, PictureError> {
        let profile = profile(snapshot);
        let (Some(first), Some(last)) = (profile.first(), profile.last()) else { return Err(PictureError::Empty) };
        Ok(Self { ends: [first.x, last.x], highest: profile.iter().map(|point| point.y).fold(0.0, f64::max) })
    }

    pub(super) fn with(self, other: &Self) -> Self {
        let ends = [self.ends[0].min(other.ends[0]), self.ends[1].max(other.ends[1])];
        Self { ends, highest: self.highest.max(other.highest) }
    }
}

/// Draws the profile of a film, given by the line of its snapshot.
pub(super) fn film_picture(scene: &FilmScene, snapshot: &Snapshot<'_>, title: &str) -> Result<Picture, PictureError> {
    let profile = profile(snapshot);
    let [left, right] = scene.ends;
    let room = f64::from(WIDTH as f32 - 2.0 * RIM);
    let across = room / (right - left);
    let up = FILLED * f64::from(TALL) / scene.highest;
    if profile.is_empty() || !(across.is_finite() && up.is_finite()) {
        return Err(PictureError::Empty);
    }
    let (first, last) = (profile[0].x, profile[profile.len() - 1].x);
    let floor = HEAD + TALL;
    let pixel = |x: &Vec2| [RIM + (across * (x.x - left)) as f32, floor - (up * x.y) as f32];
    let mut canvas = Canvas::new(WIDTH, (floor + WALL + FOOT).ceil() as u32)?;
    let mut next = 0;
    for column in 0..room as u32 {
        let x = left + (f64::from(column) + 0.5) / across;
        if x < first || x > last {
            continue;
        }
        while next + 2 < profile.len() && profile[next + 1].x < x {
            next += 1;
        }
        let (a, b) = (profile[next], profile[(next + 1).min(profile.len() - 1)]);
        let fraction = if b.x > a.x { (x - a.x) / (b.x - a.x) } else { 0.0 };
        let tall = (up * (a.y + fraction * (b.y - a.y))).max(0.0) as f32;
        canvas.rectangle([RIM + column as f32, floor - tall], [1.0, tall], FLUIDS[0].color);
    }
    canvas.rectangle([RIM, floor], [room as f32, WALL], SOLID);
    canvas.polyline([[RIM, floor], [RIM + room as f32, floor]].into_iter(), 1.5, OUTLINE);
    canvas.polyline(profile.iter().map(pixel), 3.0, INTERFACE);
    let time = time_text(snapshot.time);
    heading(&mut canvas, title, &time);
    let entries = [("wetting", FLUIDS[0].color), ("solid", SOLID), ("interface", INTERFACE)];
    let room = WIDTH as f32 - 2.0 * RIM - canvas.text_width(&time, TEXT_SIZE);
    canvas.legend(&entries, [WIDTH as f32 - RIM, 82.0], room, TEXT_SIZE);
    let below = floor + WALL + 30.0;
    scale_bar(&mut canvas, across, right - left, below);
    let highest = profile.iter().map(|point| point.y).fold(0.0, f64::max);
    let note = format!("highest {}, drawn {:.0} times as high as wide", length_text(rounded(highest)), up / across);
    let anchor = [WIDTH as f32 - RIM - canvas.text_width(&note, TEXT_SIZE), below + 38.0];
    canvas.text(&note, anchor, TEXT_SIZE);
    Ok(canvas.picture())
}

/// Rounded to three digits.
fn rounded(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor() - 2.0);
    (value / power).round() * power
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::math::Vec2;
    use meniscus_core::snapshot::{Cloud, Field, Lines, Values};

    #[test]
    fn a_film_is_filled_below_its_profile() {
        let points: Vec<Vec2> =
            (-50..=50).map(|i| Vec2::new(f64::from(i), 0.01 * (1.0 - (f64::from(i) / 50.0).powi(2)))).collect();
        let fields = vec![Field { name: "film-height", unit: "m", values: Values::Scalar(vec![0.0; 101].into()) }];
        let mut snapshot = Snapshot {
            time: 1.0,
            step: 1,
            particles: Cloud { points: points.clone().into(), fields },
            grid: None,
            interface: Some(Lines { points: points.into(), ..Lines::default() }),
        };
        assert!(is_film(&snapshot));
        let scene = FilmScene::of(&snapshot).unwrap();
        let count = film_picture(&scene, &snapshot, "A film").unwrap().count(FLUIDS[0].color);
        // Two thirds of the bounding box of a parabola, minus its stroke.
        let fraction = count as f64 / (FILLED * f64::from(TALL) * f64::from(WIDTH as f32 - 2.0 * RIM));
        assert!((fraction - 2.0 / 3.0).abs() < 0.02, "{fraction}");
        // In a movie in which it was twice as high and wide before, it fills a quarter of that.
        let wide = FilmScene { ends: [-100.0, 100.0], highest: 0.02 };
        let less = film_picture(&scene.with(&wide), &snapshot, "A film").unwrap().count(FLUIDS[0].color);
        assert!((less as f64 / count as f64 - 0.25).abs() < 0.02, "{less}");
        snapshot.interface = None;
        assert!(matches!(FilmScene::of(&snapshot), Err(PictureError::Empty)));
    }
}
