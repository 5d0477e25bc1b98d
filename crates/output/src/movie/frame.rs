//! Frames as runs of colors, and as what differs from one to the next.

/// A color as red, green, blue.
pub(super) type Rgb = [u8; 3];

/// Pixels of one color, row by row, and their number.
pub(super) type Run = (Rgb, u32);

/// The index of no color: what was there before stays.
pub(super) const CLEAR: u8 = 255;

/// A frame as it is written.
pub(super) struct Difference {
    /// Left, top, width and height of the rectangle that changes.
    pub(super) corner: [u32; 2],
    pub(super) size: [u32; 2],
    /// Indices of its colors, [`CLEAR`] where nothing changes.
    pub(super) indices: Vec<u8>,
    /// How long the frame is shown, in units of the duration of a picture.
    pub(super) shown: u32,
}

/// What differs from the frame before.
pub(super) fn difference([width, height]: [u32; 2], before: Option<&[u8]>, now: &[u8], shown: u32) -> Difference {
    let Some(before) = before else {
        return Difference { corner: [0, 0], size: [width, height], indices: now.to_vec(), shown };
    };
    let wide = width as usize;
    let mut ends = [[wide, 0], [height as usize, 0]];
    for (at, _) in before.iter().zip(now).enumerate().filter(|(_, (before, now))| before != now) {
        for (end, position) in ends.iter_mut().zip([at % wide, at / wide]) {
            *end = [end[0].min(position), end[1].max(position + 1)];
        }
    }
    // Colors that differ in the picture may be one in the palette: then one pixel is written again.
    let [[left, right], [top, bottom]] = if ends[0][0] < ends[0][1] { ends } else { [[0, 1], [0, 1]] };
    let pixels = (top..bottom).flat_map(|row| (left..right).map(move |column| row * wide + column));
    let indices = pixels.map(|at| if before[at] == now[at] { CLEAR } else { now[at] }).collect();
    Difference {
        corner: [left as u32, top as u32],
        size: [(right - left) as u32, (bottom - top) as u32],
        indices,
        shown,
    }
}
