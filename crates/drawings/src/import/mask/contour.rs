//! Marching squares on the pixel centers: lines where the solid fraction equals one half, solid on the left.
//!
//! A line is closed, or it starts and ends on the outermost pixel centers. A saddle cell is solid in the middle if the mean of its corners is one half or
//! more, so that lines never cross themselves or each other.

use super::pixels::Solid;
use meniscus_core::math::Vec2;

/// Up, left, down, right: each rotated by a quarter turn to the left from the previous one.
const STEPS: [[isize; 2]; 4] = [[0, 1], [-1, 0], [0, -1], [1, 0]];

/// A point where a line passes between two pixel centers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Crossing {
    /// Index of the solid pixel, on the left.
    pub(crate) solid: u32,
    /// Direction of travel, an index of `STEPS`.
    pub(crate) heading: u8,
}

/// A line of crossings.
pub(super) struct Line {
    pub(crate) crossings: Vec<Crossing>,
    pub(crate) is_closed: bool,
    /// Left turns minus right turns, by cells.
    pub(crate) turns: i64,
}

/// The pixels as a grid of nodes.
pub(super) struct Grid<'a> {
    pub(crate) solid: &'a Solid,
}

impl Grid<'_> {
    pub(crate) fn share(&self, node: usize) -> f64 {
        f64::from(self.solid.share[node])
    }

    pub(crate) fn is_solid(&self, node: usize) -> bool {
        self.solid.share[node] >= 0.5
    }

    /// The center of a pixel.
    pub(crate) fn center(&self, node: usize) -> Vec2 {
        Vec2::new((node % self.solid.width) as f64 + 0.5, (node / self.solid.width) as f64 + 0.5)
    }

    fn moved(&self, node: usize, [dx, dy]: [isize; 2]) -> Option<usize> {
        let x = (node % self.solid.width).checked_add_signed(dx).filter(|&x| x < self.solid.width)?;
        let y = (node / self.solid.width).checked_add_signed(dy).filter(|&y| y < self.solid.height)?;
        Some(y * self.solid.width + x)
    }

    /// The pore pixel of a crossing, on the right.
    pub(crate) fn pore(&self, at: Crossing) -> usize {
        let [dx, dy] = STEPS[at.heading as usize];
        self.moved(at.solid as usize, [dy, -dx]).unwrap_or(at.solid as usize)
    }

    /// The two pixels ahead: beyond the solid one and beyond the pore one; `None` at the edge of the image.
    pub(crate) fn ahead(&self, at: Crossing) -> Option<[usize; 2]> {
        let step = STEPS[at.heading as usize];
        Some([self.moved(at.solid as usize, step)?, self.moved(self.pore(at), step)?])
    }

    /// Position of the line.
    pub(crate) fn point(&self, at: Crossing) -> Vec2 {
        self.point_within(at, 0.0)
    }

    /// The same, but away from the pixel centers, where lines may touch.
    pub(crate) fn apart(&self, at: Crossing) -> Vec2 {
        const CLEAR: f64 = 0.05;
        self.point_within(at, CLEAR)
    }

    fn point_within(&self, at: Crossing, clear: f64) -> Vec2 {
        let (a, b) = (at.solid as usize, self.pore(at));
        let t = (self.share(a) - 0.5) / (self.share(a) - self.share(b));
        self.center(a).lerp(&self.center(b), t.clamp(clear, 1.0 - clear))
    }

    /// The middle between the two pixels.
    pub(crate) fn middle(&self, at: Crossing) -> Vec2 {
        0.5 * (self.center(at.solid as usize) + self.center(self.pore(at)))
    }

    /// The next crossing and the turn to the left towards it, in quarter turns; `None` at the edge of the image.
    fn next(&self, at: Crossing) -> Option<(Crossing, i64)> {
        let [left, right] = self.ahead(at)?;
        let pore = self.pore(at);
        let turn = match (self.is_solid(left), self.is_solid(right)) {
            (true, false) => 0,
            (true, true) => -1,
            (false, false) => 1,
            (false, true) => {
                let sum = self.share(at.solid as usize) + self.share(pore) + self.share(left) + self.share(right);
                if sum >= 2.0 { -1 } else { 1 }
            }
        };
        let heading = (i64::from(at.heading) + turn).rem_euclid(4) as u8;
        let solid = match turn {
            0 => left,
            1 => at.solid as usize,
            _ => right,
        };
        Some((Crossing { solid: solid as u32, heading }, turn))
    }

    fn trace(&self, start: Crossing, visited: &mut [u64]) -> Line {
        let mut line = Line { crossings: Vec::new(), is_closed: false, turns: 0 };
        let mut at = start;
        loop {
            if at.heading == 0 {
                visited[at.solid as usize / 64] |= 1 << (at.solid % 64);
            }
            line.crossings.push(at);
            let Some((next, turn)) = self.next(at) else { return line };
            line.turns += turn;
            at = next;
            if at == start {
                line.is_closed = true;
                return line;
            }
        }
    }

    /// All lines: the open ones counter-clockwise by their start along the edge of the image, then the closed ones by their first pixel.
    pub(crate) fn lines(&self) -> Vec<Line> {
        let (width, height) = (self.solid.width, self.solid.height);
        let mut visited = vec![0_u64; (width * height).div_ceil(64)];
        let mut lines = Vec::new();
        // Upwards from the bottom row, leftwards from the right column, downwards from the top row, rightwards from the left column.
        let bottom = (0..width - 1).map(|i| (i, 0_u8));
        let right = (0..height - 1).map(|j| (j * width + width - 1, 1));
        let top = (1..width).rev().map(|i| ((height - 1) * width + i, 2));
        let left = (1..height).rev().map(|j| (j * width, 3));
        for (solid, heading) in bottom.chain(right).chain(top).chain(left) {
            let start = Crossing { solid: solid as u32, heading };
            if self.is_solid(solid) && !self.is_solid(self.pore(start)) {
                lines.push(self.trace(start, &mut visited));
            }
        }
        for node in (0..width * height).filter(|node| node % width + 1 < width) {
            if self.is_solid(node) && !self.is_solid(node + 1) && visited[node / 64] >> (node % 64) & 1 == 0 {
                lines.push(self.trace(Crossing { solid: node as u32, heading: 0 }, &mut visited));
            }
        }
        lines
    }
}
