//! The boundaries of pore regions: along a wall to the next chord, across it, along the wall there, until the loop closes.
//!
//! Each stretch of wall between two chord ends belongs to one region, and each chord to two. From the end of a wall at an open side the loop
//! follows the side to the start of the next wall. Loops are traced on base pieces with cumulative shifts, so periodic domains need no images.

use crate::extract::sides::{Perimeter, SidePart};
use meniscus_core::math::{Vec2, perpendicular};
use meniscus_geometry::critical::opposite::Opposite;
use meniscus_geometry::critical::shift::{Shift, minus, plus};
use meniscus_geometry::critical::walls::{Contact, Walls};
use meniscus_geometry::curve::cross;

/// One step around a region, positions shifted by whole periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Step {
    /// Along a piece of wall between two parameters; the second may exceed 1 on a circle.
    Wall { wall: usize, shift: Shift, from: f64, to: f64 },
    /// Across a chord, from its contact number `end` to the other one.
    Chord { throat: usize, end: usize, shift: Shift },
    /// Along an open side.
    Side { part: SidePart, shift: Shift },
}

/// The boundary of a region, pore on the right.
#[derive(Debug, Clone, Default)]
pub(super) struct Loop {
    /// Its steps in order.
    pub(crate) steps: Vec<Step>,
    /// The shift between its end and its start; zero except for loops around a periodic domain.
    pub(crate) winding: Shift,
}

/// A chord end on a wall.
#[derive(Debug, Clone, Copy)]
struct ChordEnd {
    throat: usize,
    end: usize,
    contact: Contact,
    /// Angle in rad of the chord in the fan of a vertex.
    angle: f64,
}

/// All loops, with their positions on walls.
pub(super) struct Loops {
    /// The loops.
    pub(crate) loops: Vec<Loop>,
    ends: Vec<Vec<ChordEnd>>,
    /// For each chord end of a wall: the loop that arrives there, with the shift of the wall.
    arriving: Vec<Vec<(usize, Shift)>>,
    /// For each wall: the loop that passes its end.
    leaving: Vec<(usize, Shift)>,
}

const NONE: usize = usize::MAX;

impl Loops {
    /// The loops of all regions. Chords are those of `saddles`.
    pub(crate) fn trace(walls: &Walls, saddles: &[Opposite], perimeter: &Perimeter) -> Self {
        let mut ends: Vec<Vec<ChordEnd>> = vec![Vec::new(); walls.walls.len()];
        for (throat, saddle) in saddles.iter().enumerate() {
            for end in 0..2 {
                let contact = saddle.contacts[end];
                let direction = saddle.contacts[1 - end].point - contact.point;
                ends[contact.wall].push(ChordEnd {
                    throat,
                    end,
                    contact,
                    angle: fan_angle(walls, &contact, direction),
                });
            }
        }
        for list in &mut ends {
            list.sort_by(|a, b| a.contact.u.total_cmp(&b.contact.u).then(a.angle.total_cmp(&b.angle)));
        }
        let mut location = vec![[(NONE, NONE); 2]; saddles.len()];
        for (wall, list) in ends.iter().enumerate() {
            for (k, end) in list.iter().enumerate() {
                location[end.throat][end.end] = (wall, k);
            }
        }
        let arriving = ends.iter().map(|list| vec![(NONE, [0, 0]); list.len()]).collect();
        let mut all = Self { loops: Vec::new(), ends, arriving, leaving: vec![(NONE, [0, 0]); walls.walls.len()] };
        for wall in 0..walls.walls.len() {
            for k in 0..all.ends[wall].len() {
                if all.arriving[wall][k].0 == NONE {
                    all.run(walls, saddles, perimeter, &location, (wall, Some(k)));
                }
            }
        }
        for wall in 0..walls.walls.len() {
            let is_circle_with_ends = walls.walls[wall].curve.is_closed() && !all.ends[wall].is_empty();
            if all.leaving[wall].0 == NONE && !is_circle_with_ends {
                all.run(walls, saddles, perimeter, &location, (wall, None));
            }
        }
        for run in &perimeter.uncut {
            all.add_uncut(walls, run);
        }
        all
    }

    /// Adds a closed run along sides without walls to the loop of the nearest wall.
    fn add_uncut(&mut self, walls: &Walls, run: &[SidePart]) {
        let Some(x) = run.first().map(|part| part.from) else { return };
        let Some((distance, contact)) = walls.nearest(x) else { return };
        // The segment to the nearest wall point crosses no chord, as chords are such segments too.
        let v = x - contact.point;
        let is_wall = distance <= walls.tolerance;
        if is_wall || !walls.is_visible(&contact, v) {
            return;
        }
        let Some((number, shift, _)) = self.at(walls, &contact, -v) else { return };
        let ring = &mut self.loops[number];
        ring.steps.extend(run.iter().map(|&part| Step::Side { part, shift }));
        let passed: Vec2 = run.iter().map(|part| part.to - part.from).sum();
        let size = walls.domain.size();
        ring.winding = plus(ring.winding, [0, 1].map(|i| (passed[i] / size[i]).round() as i32));
    }

    /// Traces the loop that arrives at a chord end, or passes the end of a wall.
    fn run(
        &mut self,
        walls: &Walls,
        saddles: &[Opposite],
        perimeter: &Perimeter,
        location: &[[(usize, usize); 2]],
        first: (usize, Option<usize>),
    ) {
        let number = self.loops.len();
        let mut steps = Vec::new();
        // Current position: wall, parameter, image, and number of the next chord end there.
        let (mut wall, mut shift) = (first.0, [0, 0]);
        let mut next = first.1;
        let mut is_first = true;
        let winding = loop {
            if (wall, next) == first && !is_first {
                break shift;
            }
            let u = match next {
                Some(k) => {
                    self.arriving[wall][k] = (number, shift);
                    let here = self.ends[wall][k];
                    let by = minus(shift, here.contact.shift);
                    steps.push(Step::Chord { throat: here.throat, end: here.end, shift: by });
                    let there = saddles[here.throat].contacts[1 - here.end];
                    let (other, k) = location[here.throat][1 - here.end];
                    (wall, shift) = (other, plus(by, there.shift));
                    next = self.after(walls, wall, Some(k));
                    there.u
                }
                None => {
                    self.leaving[wall] = (number, shift);
                    let link = walls.walls[wall].next;
                    if let Some(link) = link {
                        (wall, shift) = (link.wall, plus(shift, link.shift));
                    } else if walls.walls[wall].curve.is_closed() {
                        // A circle without chords.
                    } else {
                        let Some(path) = perimeter.path(wall) else { break [0, 0] };
                        steps.extend(path.parts.iter().map(|&part| Step::Side { part, shift }));
                        (wall, shift) = (path.wall, plus(shift, path.shift));
                    }
                    next = self.after(walls, wall, None);
                    0.0
                }
            };
            is_first = false;
            self.go(walls, wall, shift, u, next, &mut steps);
        };
        self.loops.push(Loop { steps, winding });
    }

    /// The chord end on a wall after number `k`, or the first one; `None` if the end of the wall comes first.
    fn after(&self, walls: &Walls, wall: usize, k: Option<usize>) -> Option<usize> {
        let next = k.map_or(0, |k| k + 1);
        if next < self.ends[wall].len() {
            Some(next)
        } else {
            (walls.walls[wall].curve.is_closed() && !self.ends[wall].is_empty()).then_some(0)
        }
    }

    /// Adds the stretch from `u` to the next chord end or the end of the wall.
    fn go(&self, walls: &Walls, wall: usize, shift: Shift, u: f64, next: Option<usize>, steps: &mut Vec<Step>) {
        let mut to = next.map_or(1.0, |k| self.ends[wall][k].contact.u);
        if walls.walls[wall].curve.is_closed() && to <= u && next.is_some() {
            to += 1.0;
        }
        if to > u {
            steps.push(Step::Wall { wall, shift, from: u, to });
        }
    }

    /// The loop through a wall point visible from a position along `direction`, the additional shift of the point in the frame of the loop, and
    /// the distance in m to chord ends.
    pub(crate) fn at(&self, walls: &Walls, contact: &Contact, direction: Vec2) -> Option<(usize, Shift, f64)> {
        let angle = fan_angle(walls, contact, -direction);
        let list = &self.ends[contact.wall];
        let k = list.partition_point(|end| (end.contact.u, end.angle) < (contact.u, angle));
        let is_closed = walls.walls[contact.wall].curve.is_closed();
        let (number, shift) = match k {
            _ if k < list.len() => self.arriving[contact.wall][k],
            _ if is_closed && !list.is_empty() => self.arriving[contact.wall][0],
            _ => self.leaving[contact.wall],
        };
        let base = contact.point - walls.offset(contact.shift);
        let margin = list
            .iter()
            .skip(k.saturating_sub(1))
            .take(2)
            .map(|end| {
                let apart = (end.contact.point - walls.offset(end.contact.shift) - base).norm();
                apart + direction.norm() * if end.contact.u == contact.u { (end.angle - angle).abs() } else { 0.0 }
            })
            .fold(f64::INFINITY, f64::min);
        (number != NONE).then_some((number, minus(shift, contact.shift), margin))
    }
}

/// The angle in rad, counter-clockwise, from the start of the fan of a vertex to a direction out of it; 0 within a piece.
fn fan_angle(walls: &Walls, contact: &Contact, direction: Vec2) -> f64 {
    let Some([arriving, _]) = walls.tangents(contact) else { return 0.0 };
    let begins = -perpendicular(arriving);
    cross(begins, direction).atan2(begins.dot(&direction))
}
