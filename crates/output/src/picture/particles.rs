//! The particles by phase, the solids, the interface, a scale bar, title and time.
//!
//! Gray is solid: the fluids are drawn over it as dots that just touch. The core of particles `below-resolution` has its own color. All fields other than
//! `phase` are left to ParaView.

use super::canvas::{Canvas, Picture, PictureError, Rgb};
use super::contact::to_walls;
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

/// The section that is drawn and what the legend names.
#[derive(Debug, Clone)]
pub(super) struct ParticleScene {
    bounds: Bounds,
    /// The distance between neighboring particles in m.
    spacing: f64,
    /// Whether there is each of [`FLUIDS`].
    fluids: [bool; FLUIDS.len()],
    has_solid: bool,
    has_unresolved: bool,
    has_interface: bool,
}

impl ParticleScene {
    pub(super) fn of(snapshot: &Snapshot<'_>, frame: Option<&Frame>) -> Result<Self, PictureError> {
        let points = &snapshot.particles.points;
        let finite = |x: &&Vec2| x.iter().all(|c| c.is_finite());
        let tight = Bounds::around(points.iter().filter(finite).copied()).ok_or(PictureError::Empty)?;
        let spacing = particle_spacing(snapshot, &tight);
        let mut bounds = tight.grown(0.5 * spacing);
        // What leaves a periodic side comes back at the other one.
        for axis in (0..2).filter(|&axis| frame.is_some_and(|frame| frame.periodic[axis])) {
            [bounds.min[axis], bounds.max[axis]] = frame.map_or([0.0; 2], |frame| frame.bounds.map(|end| end[axis]));
        }
        let has = |number| (0..points.len()).any(|a| phase_of(snapshot, a) == Some(number));
        Ok(Self {
            bounds,
            spacing,
            fluids: FLUIDS.each_ref().map(|phase| has(phase.number)),
            has_solid: has(SOLID_PHASE),
            has_unresolved: unresolved(snapshot).next().is_some(),
            has_interface: snapshot.interface.as_ref().is_some_and(|interface| !interface.lines.is_empty()),
        })
    }

    pub(super) fn with(self, other: &Self) -> Self {
        let mut fluids = self.fluids;
        fluids.iter_mut().zip(other.fluids).for_each(|(has, other)| *has |= other);
        Self {
            bounds: self.bounds.united(&other.bounds),
            spacing: self.spacing,
            fluids,
            has_solid: self.has_solid || other.has_solid,
            has_unresolved: self.has_unresolved || other.has_unresolved,
            has_interface: self.has_interface || other.has_interface,
        }
    }

    /// Names and colors of what is drawn.
    fn legend(&self) -> Vec<(&'static str, Rgb)> {
        let fluids = FLUIDS.iter().zip(self.fluids).map(|(phase, is)| (is, phase.name, phase.color));
        let others = [
            (self.has_solid, "solid", SOLID),
            (self.has_unresolved, "not resolved", UNRESOLVED),
            (self.has_interface, "interface", INTERFACE),
        ];
        fluids.chain(others).filter(|(is, ..)| *is).map(|(_, name, color)| (name, color)).collect()
    }
}

/// Number of solids in the field `phase`.
const SOLID_PHASE: i64 = 2;

/// Draws a snapshot and the outline of its solids.
pub(super) fn particle_picture(
    scene: &ParticleScene,
    snapshot: &Snapshot<'_>,
    outline: &Lines<'_>,
    title: &str,
    frame: Option<&Frame>,
) -> Result<Picture, PictureError> {
    let (bounds, spacing) = (scene.bounds, scene.spacing);
    let view = View::new(bounds, frame);
    let height = (HEAD + view.size[1] + FOOT).ceil() as u32;
    let mut canvas = Canvas::new(WIDTH, height)?;
    canvas.rectangle(view.corner, view.size, SOLID);
    let periods = periods(frame);
    let is_near = |x: &Vec2| distance_outside(&bounds, *x) < spacing;
    let images = |x: Vec2| periods.iter().map(move |period| x + period).filter(is_near).collect::<Vec<_>>();
    fluids(&mut canvas, &view, snapshot, spacing, images);
    strokes(&mut canvas, &view, outline, 2.5, OUTLINE, &[Vec2::zeros()]);
    if let Some(interface) = &snapshot.interface {
        strokes(&mut canvas, &view, &ending_at_walls(interface, outline, spacing), 3.5, INTERFACE, &periods);
    }
    view.frame(&mut canvas);
    // A geometry has no time.
    let is_geometry = (0..snapshot.particles.points.len()).any(|a| phase_of(snapshot, a) == Some(PORE));
    heading(&mut canvas, title, &if is_geometry { String::new() } else { time_text(snapshot.time) });
    let [bar, _] = scale_bar(&mut canvas, view.scale, bounds.size().x.max(0.5 * bounds.size().y), view.bottom() + 30.0);
    let end = WIDTH as f32 - RIM;
    canvas.legend(&scene.legend(), [end, view.bottom() + 38.0], end - bar, TEXT_SIZE);
    Ok(canvas.picture())
}

/// Distance in m from a rectangle along the axis on which it is larger; 0 inside.
fn distance_outside(bounds: &Bounds, x: Vec2) -> f64 {
    (bounds.min - x).sup(&(x - bounds.max)).max().max(0.0)
}

/// The interface with its ends on the walls.
fn ending_at_walls(interface: &Lines<'_>, outline: &Lines<'_>, spacing: f64) -> Lines<'static> {
    let (mut points, mut lines) = (Vec::new(), Vec::new());
    for line in &interface.lines {
        let vertices = line.iter().filter_map(|&i| interface.points.get(i as usize).copied()).collect::<Vec<_>>();
        let first = points.len() as u32;
        points.extend(to_walls(&vertices, outline, spacing));
        lines.push((first..points.len() as u32).collect());
    }
    Lines { points: points.into(), lines, fields: Vec::new() }
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

/// The particles as dots, at all of their `images` in the section.
fn fluids(canvas: &mut Canvas, view: &View, snapshot: &Snapshot<'_>, spacing: f64, images: impl Fn(Vec2) -> Vec<Vec2>) {
    let radius = (spacing * view.scale) as f32;
    for (cover, is_core) in [(COVER * radius, false), (CORE * radius, true)] {
        if is_core && cover < SMALLEST_CORE {
            continue;
        }
        for phase in &FLUIDS {
            let centers = snapshot.particles.points.iter().enumerate();
            let centers = centers.filter(|(a, _)| phase_of(snapshot, *a) == Some(phase.number));
            let centers = centers.flat_map(|(_, &x)| images(x)).map(|x| view.pixel(x));
            canvas.circles(centers, cover.max(1.0), if is_core { phase.core } else { phase.color });
        }
    }
    let core = (CORE * radius).max(SMALLEST_CORE);
    canvas.circles(unresolved(snapshot).flat_map(&images).map(|x| view.pixel(x)), core, UNRESOLVED);
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

    fn draw(snapshot: &Snapshot<'_>, frame: Option<&Frame>) -> Result<Picture, PictureError> {
        particle_picture(&ParticleScene::of(snapshot, frame)?, snapshot, &Lines::default(), "", frame)
    }

    #[test]
    fn a_picture_shows_both_fluids_and_is_1200_pixels_wide() {
        let drawn = draw(&disc_in_a_box(), None).unwrap();
        assert_eq!(drawn.size[0], WIDTH);
        for color in [FLUIDS[0].color, FLUIDS[1].color, SOLID] {
            let count = drawn.count(color);
            assert!(count > 10_000, "{count} pixels of {color:?}");
        }
    }

    #[test]
    fn what_lies_beyond_an_open_side_is_white_with_arrows() {
        let open = [Some(Through::In), Some(Through::Out), None, None];
        let frame = Frame { bounds: [[1.0e-4, 0.0], [3.0e-4, 3.0e-4]], open, periodic: [false; 2] };
        let drawn = draw(&disc_in_a_box(), Some(&frame)).unwrap();
        let of = |x: usize| drawn.colors[(HEAD as usize + 40) * WIDTH as usize + x];
        let view = View::new(Bounds { min: Vec2::zeros(), max: Vec2::new(4.0e-4, 3.0e-4) }, Some(&frame));
        let at = |x: f64| view.pixel(Vec2::new(x, 1.0e-4))[0] as usize;
        assert_eq!([of(at(0.99e-4)), of(at(3.02e-4))], [[255; 3]; 2]);
        assert_ne!(of(at(2.5e-4)), [255; 3]);
        let arrows = drawn.count(OUTLINE);
        assert!(arrows > 500, "{arrows}");
    }

    #[test]
    fn fluid_fills_a_periodic_domain_up_to_its_sides_and_the_legend_names_no_solid() {
        let points: Vec<Vec2> =
            (0..40 * 30).map(|i| Vec2::new(f64::from(i % 40) + 0.9, f64::from(i / 40) + 0.7) * 1.0e-5).collect();
        let fields = vec![Field { name: "phase", unit: "", values: Values::Integer(vec![1; points.len()].into()) }];
        let snapshot = Snapshot { particles: Cloud { points: points.into(), fields }, ..disc_in_a_box() };
        let frame = Frame { bounds: [[0.0, 0.0], [4.0e-4, 3.0e-4]], open: [None; 4], periodic: [true; 2] };
        // Some pixels of letters have the gray of solids, too.
        let gray = draw(&snapshot, Some(&frame)).unwrap().count(SOLID);
        assert!(gray < 100, "{gray}");
        assert_eq!(ParticleScene::of(&snapshot, Some(&frame)).unwrap().legend(), [("non-wetting", FLUIDS[1].color)]);
    }

    #[test]
    fn nothing_to_draw_is_an_error_and_one_particle_is_not() {
        let mut snapshot = Snapshot { time: 0.0, step: 0, particles: Cloud::default(), grid: None, interface: None };
        assert!(matches!(draw(&snapshot, None), Err(PictureError::Empty)));
        snapshot.particles.points = vec![Vec2::zeros()].into();
        let scene = ParticleScene::of(&snapshot, None).unwrap();
        particle_picture(&scene, &snapshot, &Lines::default(), &"A very long title ".repeat(20), None).unwrap();
    }
}
