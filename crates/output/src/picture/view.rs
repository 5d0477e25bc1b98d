//! The surroundings of the drawing of a picture: title, border and scale bar.

use super::canvas::Canvas;
use super::style::{BAR_SHARE, BLACK, HEAD, OUTLINE, RIM, TEXT_SIZE, TITLE_SIZE, WIDTH, length_text, round_length};
use meniscus_core::diagram::{Frame, Through};
use meniscus_core::math::{Bounds, Vec2};

/// Largest height of the drawing in pixels: a tall pore must still fit on a screen.
const TALLEST: f32 = 1400.0;

/// Space for arrows outside an open side, relative to the longer side of the drawing.
const BEYOND: f64 = 0.035;
/// Arrows along an open side.
const ARROWS: u32 = 3;

/// Transformation from meters to pixels.
pub(super) struct View {
    min: Vec2,
    /// Pixels per meter.
    pub(super) scale: f64,
    /// Upper left corner of the drawing.
    pub(super) corner: [f32; 2],
    /// Width and height of the drawing.
    pub(super) size: [f32; 2],
    /// Upper left and lower right corner of the part inside the open sides.
    inner: [[f32; 2]; 2],
    open: [Option<Through>; 4],
}

impl View {
    /// The view of a drawing, with space for arrows outside its open sides.
    pub(super) fn new(drawing: Bounds, frame: Option<&Frame>) -> Self {
        let open = frame.map_or([None; 4], |frame| frame.open);
        let domain = frame.map_or(drawing, |frame| Bounds { min: frame.bounds[0].into(), max: frame.bounds[1].into() });
        let is_open = |side: usize| open[side].is_some();
        let (mut bounds, mut inner, room) = (drawing, drawing, BEYOND * drawing.size().max());
        for axis in 0..2 {
            if is_open(2 * axis) {
                inner.min[axis] = domain.min[axis];
                bounds.min[axis] = domain.min[axis] - room;
            }
            if is_open(2 * axis + 1) {
                inner.max[axis] = domain.max[axis];
                bounds.max[axis] = domain.max[axis] + room;
            }
        }
        let mut view = Self { open, ..Self::of(bounds) };
        view.inner = [Vec2::new(inner.min.x, inner.max.y), Vec2::new(inner.max.x, inner.min.y)].map(|x| view.pixel(x));
        view
    }

    fn of(bounds: Bounds) -> Self {
        let room = f64::from(WIDTH as f32 - 2.0 * RIM);
        let scale = (room / bounds.size().x).min(f64::from(TALLEST) / bounds.size().y);
        let size = [(scale * bounds.size().x) as f32, (scale * bounds.size().y) as f32];
        let corner = [0.5 * (WIDTH as f32 - size[0]), HEAD];
        Self { min: bounds.min, scale, corner, size, inner: [corner; 2], open: [None; 4] }
    }

    pub(super) fn pixel(&self, x: Vec2) -> [f32; 2] {
        let from = (x - self.min) * self.scale;
        [self.corner[0] + from.x as f32, self.corner[1] + self.size[1] - from.y as f32]
    }

    /// The lower edge of the drawing.
    pub(super) fn bottom(&self) -> f32 {
        self.corner[1] + self.size[1]
    }

    /// Clears whatever extends over the border, and draws the border, with arrows at open sides.
    pub(super) fn frame(&self, canvas: &mut Canvas) {
        let [[left, top], [right, bottom]] = self.inner;
        canvas.wipe_outside([left, top], [right - left, bottom - top]);
        let edges = [
            [[left, bottom], [left, top]],
            [[right, bottom], [right, top]],
            [[left, bottom], [right, bottom]],
            [[left, top], [right, top]],
        ];
        let outward = [[-1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
        for ((edge, through), outward) in edges.into_iter().zip(self.open).zip(outward) {
            match through {
                None => canvas.polyline(edge.into_iter(), 1.5, OUTLINE),
                Some(through) => self.arrows(canvas, edge, outward, through),
            }
        }
    }

    /// Arrows outside an open side, inwards or outwards.
    fn arrows(&self, canvas: &mut Canvas, [from, to]: [[f32; 2]; 2], outward: [f32; 2], through: Through) {
        let room = (BEYOND * f64::from(self.size[0].max(self.size[1]))) as f32;
        let (near, far) = (0.15 * room, 0.85 * room);
        let [tail, tip] = if through == Through::In { [far, near] } else { [near, far] };
        let head = if through == Through::In { 0.35 * room } else { -0.35 * room };
        for k in 1..=ARROWS {
            let fraction = k as f32 / (ARROWS + 1) as f32;
            let base = [0, 1].map(|axis| from[axis] + fraction * (to[axis] - from[axis]));
            let at = |out: f32, aside: f32| {
                [base[0] + out * outward[0] + aside * outward[1], base[1] + out * outward[1] + aside * outward[0]]
            };
            canvas.polyline([at(tail, 0.0), at(tip + 0.7 * head, 0.0)].into_iter(), 3.0, OUTLINE);
            canvas
                .polygon([at(tip, 0.0), at(tip + head, 0.5 * head), at(tip + head, -0.5 * head)].into_iter(), OUTLINE);
        }
    }
}

/// Writes the title and the note below it.
pub(super) fn heading(canvas: &mut Canvas, title: &str, note: &str) {
    let title = canvas.fitted(title, TITLE_SIZE, WIDTH as f32 - 2.0 * RIM);
    canvas.text(&title, [RIM, 44.0], TITLE_SIZE);
    canvas.text(note, [RIM, 82.0], TEXT_SIZE);
}

/// Draws a scale bar of a round length below a drawing of this width in m; returns the ends of the bar and of its text in pixels.
pub(super) fn scale_bar(canvas: &mut Canvas, scale: f64, width: f64, y: f32) -> [f32; 2] {
    let length = round_length(BAR_SHARE * width);
    let (text, pixels) = (length_text(length), (length * scale) as f32);
    canvas.rectangle([RIM, y - 4.0], [pixels, 8.0], BLACK);
    canvas.text(&text, [RIM, y + 38.0], TEXT_SIZE);
    [RIM + pixels, RIM + canvas.text_width(&text, TEXT_SIZE)]
}
