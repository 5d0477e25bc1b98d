//! From contour lines to discs and areas: the area enclosed by each line, its smooth form, and the assignment of holes to grains.
//!
//! The area of a ring of pixels is that of the polygon through the midpoints between solid and pore pixels plus an eighth for each turn to the left minus one
//! for each to the right (half a pixel for every ring); partly covered pixels along the line then add or subtract their fraction.

use rayon::prelude::*;

use super::contour::{Crossing, Grid, Line};
use super::pixels::Solid;
use super::wall::{At, Wall, visits};
use crate::import::drawing::{Entity, FillRule, Outline, Paint, Ring};
use meniscus_core::math::Vec2;
use meniscus_geometry::body::bulged_ring;
use meniscus_geometry::curve::Curve;
use meniscus_geometry::rings::{RingFault, faults, meetings};

/// Initial radius in pixels around an intersection of walls within which crossings are rough; it doubles in each round.
const ROUGH: f64 = 2.0;
/// Number of rounds in which rough regions grow before whole lines are rough.
const ROUNDS: i32 = 6;

/// Result of evaluating the lines of an image.
pub(super) struct Outlines {
    /// The grains.
    pub(crate) entities: Vec<Entity>,
    /// Number of specks, which are ignored.
    pub(crate) specks: usize,
    /// Number of points where smooth walls would intersect, so that the contour is kept there.
    pub(crate) rough: usize,
}

/// The rings of a grain, outer one first, with the lines of each.
struct Grain {
    first: usize,
    rings: Vec<(Ring, Vec<usize>)>,
}

/// The grains of an image.
pub(super) fn outlines(solid: &Solid) -> Outlines {
    let grid = Grid { solid };
    let lines = grid.lines();
    let visits = visits(&grid, &lines);
    let owner = owners(&grid, &lines);
    // Treatment of each line at its crossings; if the list is empty all are smooth.
    let mut rough: Vec<Vec<At>> = vec![Vec::new(); lines.len()];
    let wall = |k: usize, rough: &[Vec<At>]| Wall::of(&grid, &lines[k], &visits, &rough[k]);
    let mut walls: Vec<Option<Wall>> = (0..lines.len()).into_par_iter().map(|k| wall(k, &rough)).collect();
    let mut found = grains(&grid, &lines, &walls, &owner);
    let mut intersections = 0;
    for round in 0..=ROUNDS {
        let faulty: Vec<(Vec<Vec2>, Vec<usize>)> = found.par_iter().filter_map(faulty_points).collect();
        intersections = intersections.max(faulty.iter().map(|(at, _)| at.len().max(1)).sum());
        let mut changed: Vec<usize> = Vec::new();
        for (at, of) in faulty {
            for k in of {
                let near = |p: Vec2| {
                    at.is_empty() || round == ROUNDS || at.iter().any(|q| (p - q).norm() < ROUGH * 2.0_f64.powi(round))
                };
                let marked: Vec<bool> = lines[k].crossings.iter().map(|&at| near(grid.point(at))).collect();
                if marked.contains(&true) {
                    rough[k].resize(marked.len(), At::Smooth);
                    for known in rough[k].iter_mut().zip(marked).filter(|(_, is_near)| *is_near).map(|(known, _)| known)
                    {
                        *known = if *known == At::Smooth && round < ROUNDS { At::Kept } else { At::Fixed };
                    }
                    changed.push(k);
                }
            }
        }
        if changed.is_empty() {
            break;
        }
        let remade: Vec<(usize, Option<Wall>)> = changed.into_par_iter().map(|k| (k, wall(k, &rough))).collect();
        remade.into_iter().for_each(|(k, wall)| walls[k] = wall);
        found = grains(&grid, &lines, &walls, &owner);
    }
    let specks = walls.iter().filter(|wall| wall.is_none()).count();
    let entities = found.into_iter().map(|grain| entity(&grid, &lines, &walls, grain)).collect();
    Outlines { entities, specks, rough: intersections }
}

/// Invalid intersections of the rings of a grain, and their lines; `None` if the rings are valid. No intersection: a hole outside its ring.
fn faulty_points(grain: &Grain) -> Option<(Vec<Vec2>, Vec<usize>)> {
    let curves: Vec<Vec<Curve>> = grain.rings.iter().map(|(ring, _)| bulged_ring(&ring.vertices).collect()).collect();
    let found = faults(&curves);
    if found.is_empty() {
        return None;
    }
    let whole: Vec<usize> = found
        .iter()
        .flat_map(|fault| match fault {
            RingFault::SelfIntersection { ring, .. } => vec![*ring],
            RingFault::NotContained { hole, .. } => vec![0, *hole],
            RingFault::OnALine { rings, .. } | RingFault::OnAnArea { rings, .. } => rings.to_vec(),
        })
        .collect();
    let mut lines: Vec<usize> = whole.iter().flat_map(|&ring| grain.rings[ring].1.iter().copied()).collect();
    lines.sort_unstable();
    lines.dedup();
    Some((meetings(&curves), lines))
}

/// The grains of the walls, in the order of their first lines.
fn grains(grid: &Grid<'_>, lines: &[Line], walls: &[Option<Wall>], owner: &[Option<usize>]) -> Vec<Grain> {
    // The open lines come first; `owners` names the first line of each grain that leaves the image.
    let mut rings: Vec<Vec<(Ring, Vec<usize>)>> = vec![Vec::new(); lines.len() + 1];
    for (first, ring, of) in across_edges(grid, lines, walls) {
        rings[first].push((ring, of));
    }
    for (index, wall) in walls.iter().enumerate().filter(|(index, _)| lines[*index].is_closed) {
        let Some(wall) = wall else { continue };
        if wall.area > 0.0 {
            rings[index].insert(0, (wall.ring(), vec![index]));
        } else if let Some(owner) = owner[index] {
            rings[owner].push((wall.ring(), vec![index]));
        }
    }
    let all = rings.into_iter().enumerate().filter(|(_, rings)| !rings.is_empty());
    all.map(|(first, rings)| Grain { first, rings }).collect()
}

fn entity(grid: &Grid<'_>, lines: &[Line], walls: &[Option<Wall>], Grain { first, rings }: Grain) -> Entity {
    let wall = walls.get(first).and_then(Option::as_ref);
    let disc = wall.filter(|wall| rings.len() == 1 && lines[first].is_closed && wall.center.is_some());
    let outline = match disc.and_then(|wall| Some((wall.center?, wall.radius()))) {
        Some((center, radius)) => Outline::Disc { center, radius },
        None => Outline::Area { rings: rings.into_iter().map(|(ring, _)| ring).collect(), rule: FillRule::EvenOdd },
    };
    let location = lines.get(first).and_then(|line| line.crossings.first()).map_or_else(
        || "the edge of the image".to_owned(),
        |&at| {
            let p = grid.center(at.solid as usize);
            format!("pixel ({}, {})", p.x.floor(), grid.solid.height as f64 - 1.0 - p.y.floor())
        },
    );
    Entity { outline, paint: Paint::Filled, location }
}

/// The line of the grain that contains each hole: to the left of its first pixel, the next line is that of the grain, or of another hole of the same grain
/// with an earlier start (Suzuki, Abe 1985). Index `lines.len()` is the edge of the image.
fn owners(grid: &Grid<'_>, lines: &[Line]) -> Vec<Option<usize>> {
    let is_hole = |k: usize| lines[k].is_closed && lines[k].turns < 0;
    if !(0..lines.len()).any(is_hole) {
        return vec![None; lines.len()];
    }
    // All downward crossings, with their line.
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
        let after = down.partition_point(|&(node, _)| node <= start.solid);
        owner[k] = match down[..after].last().filter(|(node, _)| *node as usize >= row) {
            None => Some(lines.len()),
            Some(&(_, other)) if is_hole(other) => owner[other],
            Some(&(_, other)) if lines[other].is_closed => Some(other),
            Some(&(_, other)) => Some(group[other]),
        };
        // If the left edge of the image is reached, the grain is the one that leaves the image there.
        if owner[k] == Some(lines.len()) {
            owner[k] = Some(edge_owner(grid, lines, &group, row));
        }
    }
    owner
}

/// Position of a point on the edge of the image: arc length counter-clockwise from the lower left corner.
fn edge_position(grid: &Grid<'_>, p: Vec2) -> f64 {
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
        Some((edge_position(grid, grid.middle(*first)), k))
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
        let at = edge_position(grid, grid.middle(*last));
        let after = starts.partition_point(|start| start.0 <= at);
        starts.get(after).or(starts.first()).map(|start| start.1)
    };
    lines.iter().map(next).collect()
}

/// For each open line the first one around the same grain.
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

/// The group of the grain that contains the first pixel of a row; `lines.len()` if no line leaves the image.
fn edge_owner(grid: &Grid<'_>, lines: &[Line], group: &[usize], row: usize) -> usize {
    let starts = ends(grid, lines);
    let at = edge_position(grid, grid.center(row));
    let location = starts.partition_point(|start| start.0 < at);
    starts.get(location).or(starts.first()).map_or(lines.len(), |start| group[start.1])
}

/// Rings of the grains that leave the image, closed outside it, each with the index of its first line and all its lines.
fn across_edges(grid: &Grid<'_>, lines: &[Line], walls: &[Option<Wall>]) -> Vec<(usize, Ring, Vec<usize>)> {
    let (w, h) = (grid.solid.width as f64, grid.solid.height as f64);
    // Beyond all distances queried within the image.
    let beyond = w.max(h);
    let corners = [
        Vec2::new(-beyond, -beyond),
        Vec2::new(w + beyond, -beyond),
        Vec2::new(w + beyond, h + beyond),
        Vec2::new(-beyond, h + beyond),
    ];
    let corner_positions = [0.0, w - 1.0, w + h - 2.0, 2.0 * w + h - 3.0];
    let total = 2.0 * (w + h) - 4.0;
    let straight = |p: Vec2| [p.x, p.y, 0.0];
    if lines.iter().all(|line| line.is_closed) {
        return if grid.is_solid(0) {
            vec![(lines.len(), Ring { vertices: corners.map(straight).to_vec() }, Vec::new())]
        } else {
            Vec::new()
        };
    }
    let next = followers(grid, lines);
    let mut done = vec![false; lines.len()];
    let mut rings = Vec::new();
    for first in (0..lines.len()).filter(|&k| !lines[k].is_closed) {
        let (mut ring, mut at, mut of) = (Ring::default(), first, Vec::new());
        while !done[at] {
            done[at] = true;
            of.push(at);
            let (Some(start), Some(end)) = (lines[at].crossings.first(), lines[at].crossings.last()) else { break };
            let Some(wall) = &walls[at] else { break };
            let (Some(head), Some(tail)) = (wall.vertices.first(), wall.vertices.last()) else { break };
            // Straight outwards from the point where the wall reaches the edge of the image.
            let (inwards, outwards) = (heading(*start), heading(*end));
            let from = at_edge(head.point, -head.tangent, -inwards, [w, h]);
            let to = at_edge(tail.point, tail.tangent, outwards, [w, h]);
            ring.vertices.extend([straight(from - inwards * beyond), straight(from)]);
            ring.vertices.extend(wall.ring().vertices);
            ring.vertices.extend([straight(to), straight(to + outwards * beyond)]);
            let follower = next[at].unwrap_or(at);
            let leave = edge_position(grid, grid.middle(*end));
            let enter = lines[follower].crossings.first().map_or(leave, |c| edge_position(grid, grid.middle(*c)));
            let span = (enter - leave).rem_euclid(total);
            let mut passed: Vec<(f64, usize)> = (0..4)
                .map(|k| ((corner_positions[k] - leave).rem_euclid(total), k))
                .filter(|(far, _)| *far < span)
                .collect();
            passed.sort_by(|a, b| a.0.total_cmp(&b.0));
            ring.vertices.extend(passed.into_iter().map(|(_, k)| straight(corners[k])));
            at = follower;
        }
        if ring.vertices.len() > 2 {
            rings.push((first, ring, of));
        }
    }
    rings
}

fn heading(at: Crossing) -> Vec2 {
    [Vec2::y(), -Vec2::x(), -Vec2::y(), Vec2::x()][at.heading as usize]
}

/// Where a wall that ends near the edge of the image reaches it: along its tangent, or straight outwards if that is nearly parallel.
fn at_edge(p: Vec2, tangent: Vec2, out: Vec2, [w, h]: [f64; 2]) -> Vec2 {
    let edge = if out.x + out.y > 0.0 { Vec2::new(w, h) } else { Vec2::zeros() };
    let rest = (edge - p).dot(&out);
    // Beyond 60 degrees from the edge's normal, the wall would run along the edge over a long distance.
    let along = tangent.dot(&out);
    let q = if along >= 0.5 { p + tangent * (rest / along) } else { p + out * rest };
    Vec2::new(q.x.clamp(0.0, w), q.y.clamp(0.0, h))
}
