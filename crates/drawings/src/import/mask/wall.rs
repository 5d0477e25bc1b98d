//! One contour line as a wall of arcs that preserves the area of its pixels: the smoothest line within the noise, and the contour itself at rough points.

use super::arcs::{self, Vertex};
use super::circle::{self, Noise};
use super::contour::{Crossing, Grid, Line};
use super::smooth::{Samples, moved_out, resampled, smoothed, tangents};
use super::symmetry::starts;
use crate::import::drawing::Ring;
use meniscus_core::math::Vec2;
use meniscus_geometry::curve::cross;

/// Minimum area of grains and holes in pixels; smaller ones are specks. A disc of two pixels radius has 12.6.
pub(super) const SPECK: f64 = 12.0;

/// Distance of points along a line before smoothing, in pixels: below the mean distance of crossings, .8.
const SPACING: f64 = 0.7;

/// Number of averaging lengths that are tried, each √2 times the previous one, in points.
const REACHES: i32 = 16;

/// Maximum displacement of the smooth parts of a line with rough points to meet its area, in pixels.
const FARTHEST: f64 = 0.25;

/// Treatment of the line at a crossing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum At {
    /// It is smoothed.
    Smooth,
    /// The contour is kept and displaced with the line to meet the area.
    Kept,
    /// The contour is kept in place.
    Fixed,
}

/// A line as arcs with its enclosed area.
pub(super) struct Wall {
    pub(crate) vertices: Vec<Vertex>,
    /// Positive around a grain, negative around a hole; for closed lines only.
    pub(crate) area: f64,
    /// Center of the disc, if it is one.
    pub(crate) center: Option<Vec2>,
}

/// Number of times that lines pass each pixel: a pixel passed several times is shared among the lines.
pub(super) fn visits(grid: &Grid<'_>, lines: &[Line]) -> Vec<u8> {
    let mut visits = vec![0_u8; grid.solid.share.len()];
    for &at in lines.iter().flat_map(|line| &line.crossings) {
        for node in cell(grid, at) {
            visits[node] = visits[node].saturating_add(1);
        }
    }
    visits
}

/// The pixels at the corners of the cell that a line enters, if it does not end there.
fn cell(grid: &Grid<'_>, at: Crossing) -> impl Iterator<Item = usize> {
    let beside = [at.solid as usize, grid.pore(at)];
    grid.ahead(at).into_iter().flat_map(move |ahead| beside.into_iter().chain(ahead))
}

/// ½ ∮ (x dy − y dx) of the polyline, closed by a straight edge.
fn polygon_area(points: &[Vec2]) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    points.windows(2).map(|w| 0.5 * cross(w[0] - origin, w[1] - origin)).sum()
}

impl Wall {
    /// The wall of a line whose crossings are marked in `rough`, all of them smooth if that is empty; `None` for a speck.
    pub(crate) fn of(grid: &Grid<'_>, line: &Line, visits: &[u8], rough: &[At]) -> Option<Self> {
        let points: Vec<Vec2> = line.crossings.iter().map(|&at| grid.point(at)).collect();
        let middles: Vec<Vec2> = line.crossings.iter().map(|&at| grid.middle(at)).collect();
        // Sum over partly covered pixels along the line, and whether there are any.
        let (mut partly, mut is_gray) = (0.0, false);
        for node in line.crossings.iter().flat_map(|&at| cell(grid, at)) {
            let share = grid.share(node);
            let amount = if grid.is_solid(node) { share - 1.0 } else { share };
            partly += amount / f64::from(visits[node]);
            is_gray |= amount.abs() > 1e-3;
        }
        let pixels = line.turns as f64 / 8.0 + partly;
        let noise = if is_gray { circle::GRAY } else { circle::BINARY };
        if !line.is_closed {
            // Between the line and the polygon through the midpoints, closed along the edges of the image.
            let lack = |line: &[Vec2]| {
                pixels - polygon_area(&line.iter().chain(middles.iter().rev()).copied().collect::<Vec<_>>())
            };
            let smooth = smooth(resampled(&points, None, SPACING), noise, lack);
            return Some(Self {
                vertices: vertices(grid, line, &points, &smooth, rough, noise),
                area: 0.0,
                center: None,
            });
        }
        let area = polygon_area(&middles) + pixels;
        if area.abs() < SPECK {
            return None;
        }
        let center = circle::center(&points, area.abs(), noise).filter(|_| rough.is_empty());
        if let Some(center) = center {
            return Some(Self { vertices: circle_vertices(center, area), area, center: Some(center) });
        }
        let samples = resampled(&points, Some(&starts(grid, line)), SPACING);
        let smooth = smooth(samples, noise, |line| area - polygon_area(line));
        let mut vertices = vertices(grid, line, &points, &smooth, rough, noise);
        set_area(&mut vertices, area, if rough.is_empty() { f64::INFINITY } else { FARTHEST });
        Some(Self { vertices, area, center: None })
    }

    pub(crate) fn ring(&self) -> Ring {
        Ring { vertices: self.vertices.iter().map(|v| [v.point.x, v.point.y, v.bulge]).collect() }
    }

    pub(crate) fn radius(&self) -> f64 {
        (self.area.abs() / std::f64::consts::PI).sqrt()
    }
}

/// A circle as two arcs, counter-clockwise around a grain.
fn circle_vertices(center: Vec2, area: f64) -> Vec<Vertex> {
    let radius = (area.abs() / std::f64::consts::PI).sqrt();
    let turn = area.signum();
    [1.0, -1.0]
        .map(|side| Vertex {
            point: center + Vec2::new(side * radius, 0.0),
            bulge: turn,
            tangent: Vec2::new(0.0, side * turn),
        })
        .to_vec()
}

/// A smooth line: its points, in place of those of the contour, and their tangents.
struct Smooth {
    samples: Samples,
    tangents: Vec<Vec2>,
}

/// The smoothest line within the noise, displaced outwards to the right area; `lack` is the missing area of a line, in px².
fn smooth(even: Samples, noise: Noise, lack: impl Fn(&[Vec2]) -> f64) -> Smooth {
    let closing = even.points.first().filter(|_| even.is_closed);
    let around = even.points.iter().zip(even.points.iter().skip(1).chain(closing));
    let length: f64 = around.map(|(p, q)| (q - p).norm()).sum();
    let candidate = |step: i32| {
        let smooth = smoothed(&even.points, even.is_closed, 2.0_f64.powf(0.5 * f64::from(step)));
        let along = tangents(&smooth, even.is_closed);
        let moved = moved_out(&smooth, &along, lack(&smooth) / length);
        (moved, along)
    };
    let is_within = |(moved, along): &(Vec<Vec2>, Vec<Vec2>)| {
        let rests = moved.iter().zip(along).zip(&even.points).map(|((q, t), p)| cross(*t, p - q));
        let (most, squares) = rests.fold((0.0_f64, 0.0), |(most, squares), r| (most.max(r.abs()), squares + r * r));
        most <= noise.most && squares <= noise.rms * noise.rms * even.points.len() as f64
    };
    let (mut good, mut bad) = (0, REACHES);
    let mut best = candidate(good);
    while bad - good > 1 {
        let middle = (good + bad) / 2;
        let tried = candidate(middle);
        if is_within(&tried) {
            (good, best) = (middle, tried);
        } else {
            bad = middle;
        }
    }
    let (points, tangents) = best;
    Smooth { samples: Samples { points, ..even }, tangents }
}

/// The smooth line as arcs; at rough crossings, the contour through them as straight edges.
fn vertices(grid: &Grid<'_>, line: &Line, points: &[Vec2], smooth: &Smooth, rough: &[At], noise: Noise) -> Vec<Vertex> {
    let Smooth { samples, tangents } = smooth;
    if rough.is_empty() {
        return arcs::arcs(&samples.points, tangents, &samples.parts, line.is_closed, noise.rms);
    }
    // Arc length of each crossing along the contour, and of the end.
    let mut far = vec![0.0];
    for k in 0..points.len() {
        far.push(far[k] + (points[(k + 1) % points.len()] - points[k]).norm());
    }
    // A point at a crossing is as rough as the crossing, one between two as either.
    let is_rough = |s: f64| {
        let at = [-1e-9, 1e-9].map(|by| far.partition_point(|&far| far < s + by));
        let beside = if at[0] < at[1] { at[0]..at[1] } else { at[0].saturating_sub(1)..at[0] + 1 };
        beside.into_iter().any(|k| rough[k % rough.len()] > At::Smooth)
    };
    // Smooth points, replaced by crossings at rough points, in order.
    let mut nodes: Vec<(f64, Option<usize>, usize)> = Vec::new();
    let along = samples.along.iter().enumerate();
    nodes.extend(along.map(|(k, &s)| (s, Some(k), 0)).filter(|(s, ..)| !is_rough(*s)));
    nodes.extend((0..rough.len()).filter(|&k| rough[k] > At::Smooth).map(|k| (far[k], None, k)));
    nodes.sort_by(|a, b| a.0.total_cmp(&b.0));
    if line.is_closed {
        let first = nodes.iter().position(|node| node.1.is_none()).unwrap_or(0);
        nodes.rotate_left(first);
    }
    let mut found = Vec::new();
    for run in nodes.chunk_by(|a, b| a.1.is_some() == b.1.is_some()) {
        let smooth_run: Vec<usize> = run.iter().filter_map(|node| node.1).collect();
        if smooth_run.is_empty() {
            let n = rough.len();
            let apart = |k: usize| grid.apart(line.crossings[k % n]);
            // A vertex without a tangent stays in node; lines leave the image at right angles.
            let along = |k: usize| match rough[k] {
                At::Kept if line.is_closed => (apart(k + 1) - apart(k + n - 1)).try_normalize(0.0),
                _ => None,
            };
            let corner =
                |k: usize| Vertex { point: apart(k), bulge: 0.0, tangent: along(k).unwrap_or_else(Vec2::zeros) };
            found.extend(run.iter().map(|node| corner(node.2)));
        } else {
            let pick = |from: &[Vec2]| smooth_run.iter().map(|&k| from[k]).collect::<Vec<_>>();
            let last = smooth_run.len() - 1;
            found.extend(arcs::arcs(&pick(&samples.points), &pick(tangents), &[0, last], false, noise.rms));
        }
    }
    found
}

/// Displaces a closed chain outwards to the given area, by at most `farthest`.
fn set_area(vertices: &mut [Vertex], area: f64, farthest: f64) {
    // After one step the area error is that of a circle with the step as radius; the second step corrects it.
    for _ in 0..3 {
        let length = arcs::movable_length(vertices);
        if length > 0.0 {
            let by = (area - arcs::area(vertices, true)) / length;
            arcs::move_out(vertices, by.clamp(-farthest, farthest));
        }
    }
}
