//! What stands around the drawing of a picture: title, edge and scale bar.

use super::canvas::Canvas;
use super::style::{BAR_SHARE, BLACK, HEAD, OUTLINE, RIM, TEXT_SIZE, TITLE_SIZE, WIDTH, length_text, round_length};
use crate::math::{Bounds, Vec2};

/// Largest height of the drawing in pixels: a tall pore must still fit on a screen.
const TALLEST: f32 = 1400.0;

/// From meters to pixels.
pub(super) struct View {
    min: Vec2,
    /// Pixels per meter.
    pub(super) scale: f64,
    /// Upper left corner of the drawing.
    pub(super) corner: [f32; 2],
    /// Width and height of the drawing.
    pub(super) size: [f32; 2],
}

impl View {
    pub(super) fn new(bounds: Bounds) -> Self {
        let room = f64::from(WIDTH as f32 - 2.0 * RIM);
        let scale = (room / bounds.size().x).min(f64::from(TALLEST) / bounds.size().y);
        let size = [(scale * bounds.size().x) as f32, (scale * bounds.size().y) as f32];
        Self { min: bounds.min, scale, corner: [0.5 * (WIDTH as f32 - size[0]), HEAD], size }
    }

    pub(super) fn place(&self, x: Vec2) -> [f32; 2] {
        let from = (x - self.min) * self.scale;
        [self.corner[0] + from.x as f32, self.corner[1] + self.size[1] - from.y as f32]
    }

    /// The lower end of the drawing.
    pub(super) fn bottom(&self) -> f32 {
        self.corner[1] + self.size[1]
    }

    /// Wipes what reached over the drawing's edge and draws the edge.
    pub(super) fn frame(&self, canvas: &mut Canvas) {
        canvas.wipe_outside(self.corner, self.size);
        let ([x, y], [width, tall]) = (self.corner, self.size);
        let corners = [[x, y], [x + width, y], [x + width, y + tall], [x, y + tall], [x, y]];
        canvas.polyline(corners.into_iter(), 1.5, OUTLINE);
    }
}

/// Writes the title and what is said below it.
pub(super) fn heading(canvas: &mut Canvas, title: &str, note: &str) {
    let title = canvas.fitted(title, TITLE_SIZE, WIDTH as f32 - 2.0 * RIM);
    canvas.text(&title, [RIM, 44.0], TITLE_SIZE);
    canvas.text(note, [RIM, 82.0], TEXT_SIZE);
}

/// Draws a bar for a round length below a drawing of this width in m.
pub(super) fn scale_bar(canvas: &mut Canvas, scale: f64, width: f64, y: f32) {
    let length = round_length(BAR_SHARE * width);
    canvas.rectangle([RIM, y - 4.0], [(length * scale) as f32, 8.0], BLACK);
    canvas.text(&length_text(length), [RIM, y + 38.0], TEXT_SIZE);
}
