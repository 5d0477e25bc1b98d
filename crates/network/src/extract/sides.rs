//! Open sides: the boundary of a region along them, from the end of one wall to the start of the next.
//!
//! The sides are traversed clockwise, domain on the right: up the left one, along the top one, down the right one, back along the bottom.

use meniscus_core::math::Vec2;
use meniscus_geometry::critical::shift::Shift;
use meniscus_geometry::critical::walls::Walls;

/// A straight part of one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SidePart {
    /// Left, right, bottom, top: 0 to 3.
    pub(crate) side: usize,
    /// Start in m.
    pub(crate) from: Vec2,
    /// End in m.
    pub(crate) to: Vec2,
}

/// From the end of a wall along sides to the start of the next one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SidePath {
    /// Straight parts, none empty.
    pub(crate) parts: Vec<SidePart>,
    /// The next wall.
    pub(crate) wall: usize,
    /// Its image.
    pub(crate) shift: Shift,
}

/// All paths along the sides.
pub(super) struct Perimeter {
    paths: Vec<Option<SidePath>>,
    /// Closed runs along sides without walls.
    pub(crate) uncut: Vec<Vec<SidePart>>,
}

/// Sides in clockwise order with their number: left up, top, right down, bottom back.
const CLOCKWISE: [usize; 4] = [0, 3, 1, 2];

/// A wall cut by a run of sides.
#[derive(Clone, Copy)]
struct Cut {
    position: f64,
    is_start: bool,
    wall: usize,
}

impl Perimeter {
    /// The paths from all walls that end at sides.
    ///
    /// # Errors
    /// The wall ends in m that do not lie on a side, or where the next wall does not start.
    pub(crate) fn new(walls: &Walls) -> Result<Self, Vec<Vec2>> {
        let mut all = Self { paths: vec![None; walls.walls.len()], uncut: Vec::new() };
        let mut broken = Vec::new();
        let mut seen = vec![[false; 2]; walls.walls.len()];
        for run in runs(walls) {
            let cuts = run.cuts(walls, &mut seen);
            if cuts.is_empty() {
                all.uncut.push(run.between(walls, 0.0, run.length));
            }
            for (k, cut) in cuts.iter().enumerate().filter(|(_, cut)| !cut.is_start) {
                let next = cuts[(k + 1) % cuts.len()];
                if !next.is_start {
                    broken.push(walls.walls[cut.wall].curve.point(1.0));
                    continue;
                }
                let until = if k + 1 < cuts.len() { next.position } else { next.position + run.length };
                let parts = run.between(walls, cut.position, until);
                // A run around a periodic domain leads to an image of the next wall.
                let reached = run.point(cut.position) + parts.iter().map(|part| part.to - part.from).sum::<Vec2>();
                let start = walls.walls[cut.wall].curve.point(1.0);
                let from = start - run.point(cut.position);
                let to = reached + from - walls.walls[next.wall].curve.point(0.0);
                let shift = [0, 1].map(|i| (to[i] / walls.domain.size()[i]).round() as i32);
                let parts = parts.into_iter().map(|p| SidePart { from: p.from + from, to: p.to + from, ..p }).collect();
                all.paths[cut.wall] = Some(SidePath { parts, wall: next.wall, shift });
            }
        }
        for (wall, seen) in walls.walls.iter().zip(&seen).filter(|(wall, _)| !wall.curve.is_closed()) {
            if wall.before.is_none() && !seen[0] {
                broken.push(wall.curve.point(0.0));
            }
            if wall.next.is_none() && !seen[1] {
                broken.push(wall.curve.point(1.0));
            }
        }
        if broken.is_empty() { Ok(all) } else { Err(broken) }
    }

    /// The path from the end of a wall.
    pub(crate) fn path(&self, wall: usize) -> Option<&SidePath> {
        self.paths[wall].as_ref()
    }
}

/// Consecutive sides of a closed run.
struct Run {
    sides: Vec<usize>,
    corners: Vec<Vec2>,
    length: f64,
    tolerance: f64,
}

fn runs(walls: &Walls) -> Vec<Run> {
    let (min, max) = (walls.domain.min, walls.domain.max);
    let corner = |side: usize| match side {
        0 => [min, Vec2::new(min.x, max.y)],
        3 => [Vec2::new(min.x, max.y), max],
        1 => [max, Vec2::new(max.x, min.y)],
        _ => [Vec2::new(max.x, min.y), min],
    };
    let run = |sides: &[usize]| {
        let mut corners: Vec<Vec2> = sides.iter().map(|&side| corner(side)[0]).collect();
        corners.extend(sides.last().map(|&side| corner(side)[1]));
        let length = corners.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
        Run { sides: sides.to_vec(), corners, length, tolerance: 20.0 * walls.tolerance }
    };
    match walls.periodic {
        [false, false] => vec![run(&CLOCKWISE)],
        [true, false] => vec![run(&[3]), run(&[2])],
        [false, true] => vec![run(&[0]), run(&[1])],
        [true, true] => Vec::new(),
    }
}

impl Run {
    /// The arc length in m of a point on the run.
    fn position(&self, x: Vec2) -> Option<f64> {
        let mut passed = 0.0;
        for pair in self.corners.windows(2) {
            let along = pair[1] - pair[0];
            let length = along.norm();
            let position = (x - pair[0]).dot(&along) / length;
            let apart = (x - pair[0] - along * (position / length)).norm();
            if apart <= self.tolerance && position >= -self.tolerance && position <= length + self.tolerance {
                let position = passed + position;
                // The end of the run is its start.
                return Some(if position > self.length - self.tolerance {
                    (position - self.length).max(0.0)
                } else {
                    position.max(0.0)
                });
            }
            passed += length;
        }
        None
    }

    /// The point at an arc length, which may exceed the total length by one turn.
    fn point(&self, position: f64) -> Vec2 {
        let mut left = position;
        for pair in self.corners.windows(2) {
            let length = (pair[1] - pair[0]).norm();
            if left <= length {
                return pair[0] + (pair[1] - pair[0]) * (left / length);
            }
            left -= length;
        }
        self.corners[self.corners.len() - 1]
    }

    fn cuts(&self, walls: &Walls, seen: &mut [[bool; 2]]) -> Vec<Cut> {
        let mut cuts = Vec::new();
        for (k, wall) in walls.walls.iter().enumerate().filter(|(_, wall)| !wall.curve.is_closed()) {
            for (is_start, u, link) in [(true, 0.0, wall.before), (false, 1.0, wall.next)] {
                let found = self.position(walls.wrapped(wall.curve.point(u)).0);
                if let (None, Some(position)) = (link, found) {
                    seen[k][usize::from(!is_start)] = true;
                    cuts.push(Cut { position, is_start, wall: k });
                }
            }
        }
        // If a wall ends at the start of another one, the side between them is empty.
        cuts.sort_by(|a, b| a.position.total_cmp(&b.position).then(a.is_start.cmp(&b.is_start)));
        for k in 1..cuts.len() {
            let is_same = cuts[k].position - cuts[k - 1].position <= self.tolerance;
            if is_same && cuts[k - 1].is_start && !cuts[k].is_start {
                cuts.swap(k - 1, k);
            }
        }
        cuts
    }

    /// The parts of sides between two arc lengths; the second may exceed the total length.
    fn between(&self, walls: &Walls, from: f64, to: f64) -> Vec<SidePart> {
        let mut parts = Vec::new();
        let mut passed = 0.0;
        for turn in 0..2 {
            for (pair, &side) in self.corners.windows(2).zip(&self.sides) {
                let along = pair[1] - pair[0];
                let length = along.norm();
                let (low, high) = ((from - passed).max(0.0), (to - passed).min(length));
                if high - low > walls.tolerance {
                    // On a closed side the second turn is a periodic image.
                    let image = if self.sides.len() == 1 && turn == 1 { along } else { Vec2::zeros() };
                    let at = |s: f64| pair[0] + along * (s / length) + image;
                    parts.push(SidePart { side, from: at(low), to: at(high) });
                }
                passed += length;
            }
        }
        parts
    }
}
