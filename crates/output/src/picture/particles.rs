//! The particles by phase, the solids, the interface, a scale bar, title and time.
//!
//! Gray is solid: the fluids are drawn over it as dots that just touch. The core of particles `below-resolution` has its own color. All fields other than
//! `phase` are left to ParaView.

use super::canvas::{Canvas, PictureError, Rgb};
use super::style::{FLUIDS, HEAD, INTERFACE, OUTLINE, PORE, RIM, SOLID, TEXT_SIZE, UNRESOLVED, WIDTH, time_text};
use super::view::{View, heading, scale_bar};
use meniscus_core::diagram::Frame;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_core::snapshot::{Lines, Snapshot, Values};

/// Space below the drawing for scale bar and legend, in pixels.
const FOOT: f32 = 90.0;
/// Radius of a dot relative to the particle spacing: half the diagonal of a square, so that dots on a lattice leave no gap.
const COVER: f32 = 0.71;
/// Radius of the inner dot, which marks the particle position.
const CORE: f32 = 0.38;
/// Below this radius in pixels, inner dots are not drawn.
const SMALLEST_CORE: f32 = 1.5;

/// Draws a snapshot and the outline of its solids as a PNG file.
pub(super) fn particle_picture(
    snapshot: &Snapshot<'_>,
    outline: &Lines<'_>,
    title: &str,
    frame: Option<&Frame>,
) -> Result<Vec<u8>, PictureError> {
    let points = &snapshot.particles.points;
    let finite = |x: &&Vec2| x.iter().all(|c| c.is_finite());
    let tight = Bounds::around(points.iter().filter(finite).copied()).ok_or(PictureError::Empty)?;
    let spacing = particle_spacing(snapshot, &tight);
    let bounds = tight.grown(0.5 * spacing);
    let view = View::new(bounds, frame);
    let height = (HEAD + view.size[1] + FOOT).ceil() as u32;
    let mut canvas = Canvas::new(WIDTH, height)?;
    canvas.rectangle(view.corner, view.size, SOLID);
    fluids(&mut canvas, &view, snapshot, spacing);
    strokes(&mut canvas, &view, outline, 2.5, OUTLINE, &[Vec2::zeros()]);
    if let Some(interface) = &snapshot.interface {
        strokes(&mut canvas, &view, interface, 3.5, INTERFACE, &periods(frame));
    }
    view.frame(&mut canvas);
    // A geometry has no time.
    let is_geometry = (0..points.len()).any(|a| phase_of(snapshot, a) == Some(PORE));
    heading(&mut canvas, title, &if is_geometry { String::new() } else { time_text(snapshot.time) });
    scale_bar(&mut canvas, view.scale, bounds.size().x.max(0.5 * bounds.size().y), view.bottom() + 30.0);
    legend(&mut canvas, &view, snapshot);
    canvas.png()
}

/// The distance between neighboring particles in m: from the mean of the field `volume`, else from the area they fill.
fn particle_spacing(snapshot: &Snapshot<'_>, tight: &Bounds) -> f64 {
    let count = snapshot.particles.points.len() as f64;
    let volume = snapshot.particles.fields.iter().find(|field| field.name == "volume").map(|field| &field.values);
    let mean = match volume {
        Some(Values::Scalar(volumes)) => volumes.iter().filter(|v| v.is_finite()).sum::<f64>() / count,
        _ => tight.area() / count,
    };
    // Particles in a row have no area, a single one has no extent: then any spacing will do.
    [mean.sqrt(), tight.size().max() / count].into_iter().find(|&spacing| spacing > 0.0).unwrap_or(1.0)
}

/// An integer field of the particles.
fn integers<'a>(snapshot: &'a Snapshot<'_>, name: &str) -> Option<&'a [i64]> {
    match snapshot.particles.fields.iter().find(|field| field.name == name).map(|field| &field.values) {
        Some(Values::Integer(values)) => Some(values),
        _ => None,
    }
}

/// The phase of particle `a`; particles without phases are drawn as the first one.
fn phase_of(snapshot: &Snapshot<'_>, a: usize) -> Option<i64> {
    integers(snapshot, "phase").map_or(Some(FLUIDS[0].number), |phases| phases.get(a).copied())
}

/// The particles where their phase is not resolved by the spacing.
fn unresolved<'a>(snapshot: &'a Snapshot<'_>) -> impl Iterator<Item = Vec2> + 'a {
    let marks = integers(snapshot, "below-resolution").unwrap_or(&[]);
    marks.iter().zip(snapshot.particles.points.iter()).filter(|(mark, _)| **mark != 0).map(|(_, x)| *x)
}

fn fluids(canvas: &mut Canvas, view: &View, snapshot: &Snapshot<'_>, spacing: f64) {
    let radius = (spacing * view.scale) as f32;
    for (cover, is_core) in [(COVER * radius, false), (CORE * radius, true)] {
        if is_core && cover < SMALLEST_CORE {
            continue;
        }
        for phase in &FLUIDS {
            let centers = snapshot.particles.points.iter().enumerate();
            let centers =
                centers.filter(|(a, _)| phase_of(snapshot, *a) == Some(phase.number)).map(|(_, &x)| view.pixel(x));
            canvas.circles(centers, cover.max(1.0), if is_core { phase.core } else { phase.color });
        }
    }
    let core = (CORE * radius).max(SMALLEST_CORE);
    canvas.circles(unresolved(snapshot).map(|x| view.pixel(x)), core, UNRESOLVED);
}

/// Lines, translated by each of `shifts` in m.
fn strokes(canvas: &mut Canvas, view: &View, lines: &Lines<'_>, width: f32, color: Rgb, shifts: &[Vec2]) {
    for line in &lines.lines {
        let points = || line.iter().filter_map(|&i| lines.points.get(i as usize));
        shifts.iter().for_each(|shift| canvas.polyline(points().map(|&x| view.pixel(x + shift)), width, color));
    }
}

/// Translations from a point in the domain to itself and to its periodic images, in m.
fn periods(frame: Option<&Frame>) -> Vec<Vec2> {
    let Some(frame) = frame else { return vec![Vec2::zeros()] };
    let [along_x, along_y] = [0, 1].map(|axis| {
        let period = frame.bounds[1][axis] - frame.bounds[0][axis];
        if frame.periodic[axis] { vec![-period, 0.0, period] } else { vec![0.0] }
    });
    along_x.iter().flat_map(|&x| along_y.iter().map(move |&y| Vec2::new(x, y))).collect()
}

/// The legend, from the right.
fn legend(canvas: &mut Canvas, view: &View, snapshot: &Snapshot<'_>) {
    let y = view.bottom() + 38.0;
    let present = |number| (0..snapshot.particles.points.len()).any(|a| phase_of(snapshot, a) == Some(number));
    let interface = snapshot.interface.as_ref().map(|_| ("interface", INTERFACE));
    let thin = unresolved(snapshot).next().map(|_| ("not resolved", UNRESOLVED));
    let fluids = FLUIDS.iter().filter(|phase| present(phase.number)).map(|phase| (phase.name, phase.color));
    let entries: Vec<_> = fluids.chain([("solid", SOLID)]).chain(thin).chain(interface).collect();
    canvas.legend(&entries, [WIDTH as f32 - RIM, y], TEXT_SIZE);
}

#[cfg(test)]
mod tests {
    use super::*;
    use meniscus_core::diagram::Through;
    use meniscus_core::snapshot::{Cloud, Field};

    fn disc_in_a_box() -> Snapshot<'static> {
        let points: Vec<Vec2> =
            (0..40 * 30).map(|i| Vec2::new(f64::from(i % 40) + 0.5, f64::from(i / 40) + 0.5) * 1.0e-5).collect();
        let phase = |x: &Vec2| match x {
            x if x.y < 4.0e-5 => 2,
            x if (x - Vec2::new(2.0e-4, 1.5e-4)).norm() < 9.0e-5 => 0,
            _ => 1,
        };
        let phases = points.iter().map(phase).collect();
        let fields = vec![Field { name: "phase", unit: "", values: Values::Integer(phases) }];
        let particles = Cloud { points: points.into(), fields };
        Snapshot { time: 2.5e-3, step: 10, particles, grid: None, interface: None }
    }

    fn colors(pixels: &tiny_skia::Pixmap) -> Vec<Rgb> {
        pixels.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect()
    }

    #[test]
    fn a_picture_shows_both_fluids_and_is_1200_pixels_wide() {
        let png = particle_picture(&disc_in_a_box(), &Lines::default(), "A disc of liquid on a floor", None).unwrap();
        let pixels = tiny_skia::Pixmap::decode_png(&png).unwrap();
        assert_eq!(pixels.width(), WIDTH);
        for color in [FLUIDS[0].color, FLUIDS[1].color, SOLID] {
            let count = colors(&pixels).into_iter().filter(|found| *found == color).count();
            assert!(count > 10_000, "{count} pixels of {color:?}");
        }
    }

    #[test]
    fn what_lies_beyond_an_open_side_is_white_with_arrows() {
        let open = [Some(Through::In), Some(Through::Out), None, None];
        let frame = Frame { bounds: [[1.0e-4, 0.0], [3.0e-4, 3.0e-4]], open, periodic: [false; 2] };
        let png = particle_picture(&disc_in_a_box(), &Lines::default(), "", Some(&frame)).unwrap();
        let pixels = tiny_skia::Pixmap::decode_png(&png).unwrap();
        let colors = colors(&pixels);
        let of = |x: usize| colors[(HEAD as usize + 40) * pixels.width() as usize + x];
        let view = View::new(Bounds { min: Vec2::zeros(), max: Vec2::new(4.0e-4, 3.0e-4) }, Some(&frame));
        let at = |x: f64| view.pixel(Vec2::new(x, 1.0e-4))[0] as usize;
        assert_eq!([of(at(0.99e-4)), of(at(3.02e-4))], [[255; 3]; 2]);
        assert_ne!(of(at(2.5e-4)), [255; 3]);
        let arrows = colors.iter().filter(|color| **color == OUTLINE).count();
        assert!(arrows > 500, "{arrows}");
    }

    #[test]
    fn nothing_to_draw_is_an_error_and_one_particle_is_not() {
        let mut snapshot = Snapshot { time: 0.0, step: 0, particles: Cloud::default(), grid: None, interface: None };
        assert!(matches!(particle_picture(&snapshot, &Lines::default(), "", None), Err(PictureError::Empty)));
        snapshot.particles.points = vec![Vec2::zeros()].into();
        particle_picture(&snapshot, &Lines::default(), &"A very long title ".repeat(20), None).unwrap();
    }
}
