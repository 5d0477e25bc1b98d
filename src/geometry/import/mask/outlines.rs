//! From contour lines to discs and areas: the area that each line must hold, its smooth form, and which hole lies in which grain.
//!
//! The area of a ring of pixels is that of the polygon through the middles between solid and pore pixels plus an eighth for each turn
//! to the left less one for each to the right (so half a pixel more for every ring); partly covered pixels beside the line then add
//! what they hold, or take what they lack.

use rayon::prelude::*;

use super::arcs::{self, Vertex};
use super::circle::{self, Noise};
use super::contour::{Crossing, Grid, Line};
use super::pixels::Solid;
use super::smooth::{moved_out, resampled, smoothed, tangents};
use crate::geometry::curve::cross;
use crate::geometry::import::drawing::{Entity, FillRule, Outline, Ring};
use crate::math::Vec2;

/// Grains and holes of less than this many pixels are specks: a disc of two pixels radius has 12.6.
pub(super) const SPECK: f64 = 12.0;

/// Distance of points along a line before it is smoothed, in pixels: below that of crossings, .8 in the mean.
const SPACING: f64 = 0.7;

/// Lengths over which noise is averaged, each √2 times the one before, in points.
const REACHES: i32 = 16;

/// A line as arcs with the area that it holds.
struct Wall {
    vertices: Vec<Vertex>,
    /// Above 0 around a grain, below 0 around a hole; of closed lines only.
    area: f64,
    /// Center of the disc that it is.
    center: Option<Vec2>,
}

/// The grains of an image, and the number of specks left out.
pub(super) fn outlines(solid: &Solid) -> (Vec<Entity>, usize) {
    let grid = Grid { solid };
    let lines = grid.lines();
    let visits = visits(&grid, &lines);
    let walls: Vec<Option<Wall>> = lines.par_iter().map(|line| wall(&grid, line, &visits)).collect();
    let dropped = walls.iter().filter(|wall| wall.is_none()).count();
    let owner = owners(&grid, &lines);
    // The open lines come first; `owners` names the first line of each grain that leaves the image.
    let mut rings: Vec<Vec<Ring>> = vec![Vec::new(); lines.len() + 1];
    for (first, ring) in across_edges(&grid, &lines, &walls) {
        rings[first].push(ring);
    }
    for (index, wall) in walls.iter().enumerate().filter(|(index, _)| lines[*index].is_closed) {
        let Some(wall) = wall else { continue };
        if wall.area > 0.0 {
            rings[index].insert(0, wall.ring());
        } else if let Some(owner) = owner[index] {
            rings[owner].push(wall.ring());
        }
    }
    let mut entities = Vec::new();
    for (index, rings) in rings.into_iter().enumerate().filter(|(_, rings)| !rings.is_empty()) {
        let wall = walls.get(index).and_then(Option::as_ref);
        let disc = wall.filter(|wall| rings.len() == 1 && lines[index].is_closed && wall.center.is_some());
        let outline = match disc.and_then(|wall| Some((wall.center?, wall.radius()))) {
            Some((center, radius)) => Outline::Disc { center, radius },
            None => Outline::Area { rings, rule: FillRule::EvenOdd },
        };
        let place = lines.get(index).and_then(|line| line.crossings.first()).map_or_else(
            || "the edge of the image".to_owned(),
            |&at| {
                let p = grid.center(at.solid as usize);
                format!("pixel ({}, {})", p.x.floor(), solid.height as f64 - 1.0 - p.y.floor())
            },
        );
        entities.push(Entity { outline, place });
    }
    (entities, dropped)
}

/// How often the lines pass each pixel: one that several lines pass is shared among them.
fn visits(grid: &Grid<'_>, lines: &[Line]) -> Vec<u8> {
    let mut visits = vec![0_u8; grid.solid.share.len()];
    for &at in lines.iter().flat_map(|line| &line.crossings) {
        for node in cell(grid, at) {
            visits[node] = visits[node].saturating_add(1);
        }
    }
    visits
}

/// The pixels at the corners of the cell that a line enters.
fn cell(grid: &Grid<'_>, at: Crossing) -> impl Iterator<Item = usize> {
    let beside = [at.solid as usize, grid.pore(at)];
    beside.into_iter().chain(grid.ahead(at).into_iter().flatten())
}

/// ½ ∮ (x dy − y dx) of the line of points, closed by a straight edge.
fn polygon_area(points: &[Vec2]) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    points.windows(2).map(|w| 0.5 * cross(w[0] - origin, w[1] - origin)).sum()
}

/// A line, smoothed; none where it is a speck.
fn wall(grid: &Grid<'_>, line: &Line, visits: &[u8]) -> Option<Wall> {
    let points: Vec<Vec2> = line.crossings.iter().map(|&at| grid.point(at)).collect();
    let middles: Vec<Vec2> = line.crossings.iter().map(|&at| grid.middle(at)).collect();
    // Partly covered pixels beside the line, and whether there are any.
    let (mut partly, mut is_gray) = (0.0, false);
    for node in line.crossings.iter().flat_map(|&at| cell(grid, at)) {
        let share = grid.share(node);
        let amount = if grid.is_solid(node) { share - 1.0 } else { share };
        partly += amount / f64::from(visits[node]);
        is_gray |= amount.abs() > 1e-3;
    }
    let pixels = line.turns as f64 / 8.0 + partly;
    let noise = if is_gray { circle::GRAY } else { circle::BINARY };
    if line.is_closed {
        let area = polygon_area(&middles) + pixels;
        if area.abs() < SPECK {
            return None;
        }
        let center = circle::center(&points, area.abs(), noise);
        if let Some(center) = center {
            return Some(Wall { vertices: circle_vertices(center, area), area, center: Some(center) });
        }
        let mut vertices = smooth_arcs(&points, true, noise, |line| area - polygon_area(line));
        set_area(&mut vertices, area);
        Some(Wall { vertices, area, center: None })
    } else {
        // Between the line and that through the middles, closed along the edges of the image.
        let lack = |line: &[Vec2]| {
            pixels - polygon_area(&line.iter().chain(middles.iter().rev()).copied().collect::<Vec<_>>())
        };
        Some(Wall { vertices: smooth_arcs(&points, false, noise, lack), area: 0.0, center: None })
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

/// The smoothest line within the noise, as arcs, moved out so that it lacks no area; `lack` tells what a line lacks, in px².
fn smooth_arcs(points: &[Vec2], is_closed: bool, noise: Noise, lack: impl Fn(&[Vec2]) -> f64) -> Vec<Vertex> {
    let even = resampled(points, is_closed, SPACING);
    let length: f64 = even.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let candidate = |step: i32| {
        let smooth = smoothed(&even, is_closed, 2.0_f64.powf(0.5 * f64::from(step)));
        let along = tangents(&smooth, is_closed);
        let moved = moved_out(&smooth, &along, lack(&smooth) / length);
        (moved, along)
    };
    let is_within = |(moved, along): &(Vec<Vec2>, Vec<Vec2>)| {
        let rests = moved.iter().zip(along).zip(&even).map(|((q, t), p)| cross(*t, p - q));
        let (most, squares) = rests.fold((0.0_f64, 0.0), |(most, squares), r| (most.max(r.abs()), squares + r * r));
        most <= noise.most && squares <= noise.rms * noise.rms * even.len() as f64
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
    arcs::arcs((&best.0, &best.1), is_closed, noise.rms)
}

/// Moves a closed chain out until it holds the area.
fn set_area(vertices: &mut [Vertex], area: f64) {
    // One step meets the area but for a circle of the step's radius; the second meets that.
    for _ in 0..3 {
        let length = arcs::length(vertices, true);
        if length > 0.0 {
            let by = (area - arcs::area(vertices, true)) / length;
            arcs::move_out(vertices, by);
        }
    }
}

impl Wall {
    fn ring(&self) -> Ring {
        arcs::ring(&self.vertices)
    }

    fn radius(&self) -> f64 {
        (self.area.abs() / std::f64::consts::PI).sqrt()
    }
}

/// For each hole the line of the grain that it lies in: seen from its first pixel to the left, the next line is the grain's, or that
/// of another hole of the same grain that begins before (Suzuki, Abe 1985). Index `lines.len()` is the edge of the image.
fn owners(grid: &Grid<'_>, lines: &[Line]) -> Vec<Option<usize>> {
    let is_hole = |k: usize| lines[k].is_closed && lines[k].turns < 0;
    if !(0..lines.len()).any(is_hole) {
        return vec![None; lines.len()];
    }
    // All crossings that go down, with their line.
    let mut down: Vec<(u32, usize)> = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        down.extend(line.crossings.iter().filter(|at| at.heading == 2).map(|at| (at.solid, index)));
    }
    down.sort_unstable();
    let group = edge_groups(grid, lines);
    let mut owner = vec![None; lines.len()];
    for k in (0..lines.len()).filter(|&k| is_hole(k)) {
        let Some(start) = lines[k].crossings.first() else { continue };
        let row = start.solid as usize / grid.solid.width * grid.solid.width;
        let place = down.partition_point(|&(node, _)| node <= start.solid);
        owner[k] = match down[..place].last().filter(|(node, _)| *node as usize >= row) {
            None => Some(lines.len()),
            Some(&(_, other)) if is_hole(other) => owner[other],
            Some(&(_, other)) if lines[other].is_closed => Some(other),
            Some(&(_, other)) => Some(group[other]),
        };
        // What reaches the left edge of the image belongs to the grain that leaves it there.
        if owner[k] == Some(lines.len()) {
            owner[k] = Some(edge_owner(grid, lines, &group, row));
        }
    }
    owner
}

/// Where a place on the edge of the image lies: the way counter-clockwise from the lower left corner.
fn way(grid: &Grid<'_>, p: Vec2) -> f64 {
    let (w, h) = (grid.solid.width as f64 - 1.0, grid.solid.height as f64 - 1.0);
    let (x, y) = (p.x - 0.5, p.y - 0.5);
    if y <= 0.0 {
        x
    } else if x >= w {
        w + y
    } else if y >= h {
        w + h + (w - x)
    } else {
        2.0 * w + h + (h - y)
    }
}

fn ends(grid: &Grid<'_>, lines: &[Line]) -> Vec<(f64, usize)> {
    let start = |(k, line): (usize, &Line)| {
        let first = line.crossings.first().filter(|_| !line.is_closed)?;
        Some((way(grid, grid.middle(*first)), k))
    };
    let mut starts: Vec<(f64, usize)> = lines.iter().enumerate().filter_map(start).collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    starts
}

/// The open line that follows each open line around the edge of the image: the solid lies between.
fn followers(grid: &Grid<'_>, lines: &[Line]) -> Vec<Option<usize>> {
    let starts = ends(grid, lines);
    let next = |line: &Line| {
        let last = line.crossings.last().filter(|_| !line.is_closed)?;
        let at = way(grid, grid.middle(*last));
        let place = starts.partition_point(|start| start.0 <= at);
        starts.get(place).or(starts.first()).map(|start| start.1)
    };
    lines.iter().map(next).collect()
}

/// For each open line the first of the open lines around the same grain.
fn edge_groups(grid: &Grid<'_>, lines: &[Line]) -> Vec<usize> {
    let next = followers(grid, lines);
    let mut group: Vec<usize> = vec![usize::MAX; lines.len()];
    for first in 0..lines.len() {
        let mut at = first;
        while !lines[at].is_closed && group[at] == usize::MAX {
            group[at] = first;
            at = next[at].unwrap_or(first);
        }
    }
    group
}

/// The group of the grain that holds the first pixel of a row; `lines.len()` where no line leaves the image.
fn edge_owner(grid: &Grid<'_>, lines: &[Line], group: &[usize], row: usize) -> usize {
    let starts = ends(grid, lines);
    let at = way(grid, grid.center(row));
    let place = starts.partition_point(|start| start.0 < at);
    starts.get(place).or(starts.first()).map_or(lines.len(), |start| group[start.1])
}

/// Rings of the grains that leave the image, closed outside of it, each with the index of its first line.
fn across_edges(grid: &Grid<'_>, lines: &[Line], walls: &[Option<Wall>]) -> Vec<(usize, Ring)> {
    let (w, h) = (grid.solid.width as f64, grid.solid.height as f64);
    // Far enough for every distance that is asked for within the image.
    let beyond = w.max(h);
    let corners = [
        Vec2::new(-beyond, -beyond),
        Vec2::new(w + beyond, -beyond),
        Vec2::new(w + beyond, h + beyond),
        Vec2::new(-beyond, h + beyond),
    ];
    let ways = [0.0, w - 1.0, w + h - 2.0, 2.0 * w + h - 3.0];
    let total = 2.0 * (w + h) - 4.0;
    let straight = |p: Vec2| [p.x, p.y, 0.0];
    if lines.iter().all(|line| line.is_closed) {
        return if grid.is_solid(0) {
            vec![(lines.len(), Ring { vertices: corners.map(straight).to_vec() })]
        } else {
            Vec::new()
        };
    }
    let next = followers(grid, lines);
    let mut done = vec![false; lines.len()];
    let mut rings = Vec::new();
    for first in (0..lines.len()).filter(|&k| !lines[k].is_closed) {
        let (mut ring, mut at) = (Ring::default(), first);
        while !done[at] {
            done[at] = true;
            let (Some(start), Some(end)) = (lines[at].crossings.first(), lines[at].crossings.last()) else { break };
            let Some(wall) = &walls[at] else { break };
            let (Some(head), Some(tail)) = (wall.vertices.first(), wall.vertices.last()) else { break };
            // Out of the image straight on, from where the wall reaches its edge.
            let (inwards, outwards) = (heading(*start), heading(*end));
            let from = at_edge(head.point, -head.tangent, -inwards, [w, h]);
            let to = at_edge(tail.point, tail.tangent, outwards, [w, h]);
            ring.vertices.extend([straight(from - inwards * beyond), straight(from)]);
            ring.vertices.extend(wall.vertices.iter().map(|v| [v.point.x, v.point.y, v.bulge]));
            ring.vertices.extend([straight(to), straight(to + outwards * beyond)]);
            let follower = next[at].unwrap_or(at);
            let leave = way(grid, grid.middle(*end));
            let enter = lines[follower].crossings.first().map_or(leave, |c| way(grid, grid.middle(*c)));
            let span = (enter - leave).rem_euclid(total);
            let mut passed: Vec<(f64, usize)> =
                (0..4).map(|k| ((ways[k] - leave).rem_euclid(total), k)).filter(|(far, _)| *far < span).collect();
            passed.sort_by(|a, b| a.0.total_cmp(&b.0));
            ring.vertices.extend(passed.into_iter().map(|(_, k)| straight(corners[k])));
            at = follower;
        }
        if ring.vertices.len() > 2 {
            rings.push((first, ring));
        }
    }
    rings
}

fn heading(at: Crossing) -> Vec2 {
    [Vec2::y(), -Vec2::x(), -Vec2::y(), Vec2::x()][at.heading as usize]
}

/// Where a wall that ends near the edge of the image reaches it: along its tangent, or straight out where that runs along the edge.
fn at_edge(p: Vec2, tangent: Vec2, out: Vec2, [w, h]: [f64; 2]) -> Vec2 {
    let edge = if out.x + out.y > 0.0 { Vec2::new(w, h) } else { Vec2::zeros() };
    let rest = (edge - p).dot(&out);
    // Steeper than 60 degrees to the edge's normal, the wall would run along the edge for long.
    let along = tangent.dot(&out);
    let q = if along >= 0.5 { p + tangent * (rest / along) } else { p + out * rest };
    Vec2::new(q.x.clamp(0.0, w), q.y.clamp(0.0, h))
}
