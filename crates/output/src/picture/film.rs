//! A thin film: its profile, filled, over the wall. A film is so flat that heights are exaggerated; the picture states the factor.

use super::canvas::{Canvas, PictureError};
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

/// Draws the profile of a film, given by the line of its snapshot.
pub(super) fn film_picture(snapshot: &Snapshot<'_>, title: &str) -> Result<Vec<u8>, PictureError> {
    let profile: &[Vec2] = snapshot.interface.as_ref().map_or(&[], |lines| &lines.points);
    let (Some(first), Some(last)) = (profile.first(), profile.last()) else { return Err(PictureError::Empty) };
    let highest = profile.iter().map(|point| point.y).fold(0.0, f64::max);
    let room = f64::from(WIDTH as f32 - 2.0 * RIM);
    let across = room / (last.x - first.x);
    let up = FILLED * f64::from(TALL) / highest;
    if !(across.is_finite() && up.is_finite()) {
        return Err(PictureError::Empty);
    }
    let floor = HEAD + TALL;
    let pixel = |x: &Vec2| [RIM + (across * (x.x - first.x)) as f32, floor - (up * x.y) as f32];
    let mut canvas = Canvas::new(WIDTH, (floor + WALL + FOOT).ceil() as u32)?;
    let mut next = 0;
    for column in 0..room as u32 {
        let x = first.x + (f64::from(column) + 0.5) / across;
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
    heading(&mut canvas, title, &time_text(snapshot.time));
    let entries = [("wetting", FLUIDS[0].color), ("solid", SOLID), ("interface", INTERFACE)];
    canvas.legend(&entries, [WIDTH as f32 - RIM, 82.0], TEXT_SIZE);
    let below = floor + WALL + 30.0;
    scale_bar(&mut canvas, across, last.x - first.x, below);
    let note = format!("highest {}, drawn {:.0} times as high as wide", length_text(rounded(highest)), up / across);
    let anchor = [WIDTH as f32 - RIM - canvas.text_width(&note, TEXT_SIZE), below + 38.0];
    canvas.text(&note, anchor, TEXT_SIZE);
    canvas.png()
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
        let png = film_picture(&snapshot, "A film").unwrap();
        let pixels = tiny_skia::Pixmap::decode_png(&png).unwrap();
        let count = pixels.pixels().iter().filter(|p| [p.red(), p.green(), p.blue()] == FLUIDS[0].color).count();
        // Two thirds of the bounding box of a parabola, minus its stroke.
        let fraction = count as f64 / (FILLED * f64::from(TALL) * f64::from(WIDTH as f32 - 2.0 * RIM));
        assert!((fraction - 2.0 / 3.0).abs() < 0.02, "{fraction}");
        snapshot.interface = None;
        assert!(matches!(film_picture(&snapshot, ""), Err(PictureError::Empty)));
    }
}
