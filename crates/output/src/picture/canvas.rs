//! A canvas in pixels: filled circles, polylines, rectangles (`tiny-skia`) and text (`ab_glyph`, DejaVu Sans built in).

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont};
use meniscus_core::diagram::colors;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Mask, Paint, PathBuilder, Pixmap, PremultipliedColorU8, Rect, Stroke,
    StrokeDash, Transform,
};

/// A picture that cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// Nothing to draw.
    #[error("there is nothing to draw")]
    Empty,
    /// A canvas of that size cannot be made.
    #[error("a picture of {width} x {height} pixels cannot be made")]
    Size {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// The built-in font is damaged.
    #[error("the built-in font cannot be read")]
    Font,
    /// The PNG encoder failed.
    #[error("the picture cannot be encoded: {0}")]
    Encode(String),
}

/// Space in pixels for the dot of a legend entry, from its center on, and before it.
const DOT: f32 = 22.0;
const GAP: f32 = 40.0;

/// A color as red, green, blue.
pub(crate) type Rgb = [u8; 3];

/// A canvas. Lengths in pixels, y downwards.
pub(crate) struct Canvas {
    pixels: Pixmap,
    /// Where lines are drawn; `None`: everywhere.
    mask: Option<Mask>,
    font: FontRef<'static>,
}

fn paint(color: Rgb) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(color[0], color[1], color[2], u8::MAX);
    paint.anti_alias = true;
    paint
}

fn path(vertices: impl Iterator<Item = [f32; 2]>) -> PathBuilder {
    let mut builder = PathBuilder::new();
    for [x, y] in vertices {
        if builder.is_empty() { builder.move_to(x, y) } else { builder.line_to(x, y) }
    }
    builder
}

impl Canvas {
    /// A white canvas.
    pub(crate) fn new(width: u32, height: u32) -> Result<Self, PictureError> {
        let mut pixels = Pixmap::new(width, height).ok_or(PictureError::Size { width, height })?;
        pixels.fill(Color::WHITE);
        let font = FontRef::try_from_slice(dejavu::sans::regular()).map_err(|_| PictureError::Font)?;
        Ok(Self { pixels, mask: None, font })
    }

    /// A filled rectangle, from its upper left corner.
    pub(crate) fn rectangle(&mut self, corner: [f32; 2], size: [f32; 2], color: Rgb) {
        if let Some(rect) = Rect::from_xywh(corner[0], corner[1], size[0], size[1]) {
            self.pixels.fill_rect(rect, &paint(color), Transform::identity(), None);
        }
    }

    /// Filled circles of one color and radius.
    pub(crate) fn circles(&mut self, centers: impl Iterator<Item = [f32; 2]>, radius: f32, color: Rgb) {
        for [x, y] in centers {
            if let Some(circle) = PathBuilder::from_circle(x, y, radius) {
                self.pixels.fill_path(&circle, &paint(color), FillRule::Winding, Transform::identity(), None);
            }
        }
    }

    /// A filled polygon.
    pub(crate) fn polygon(&mut self, vertices: impl Iterator<Item = [f32; 2]>, color: Rgb) {
        let mut builder = path(vertices);
        builder.close();
        if let Some(path) = builder.finish() {
            self.pixels.fill_path(&path, &paint(color), FillRule::Winding, Transform::identity(), None);
        }
    }

    /// From now on, lines are drawn inside these polygons only.
    pub(crate) fn within<P: Iterator<Item = [f32; 2]>>(&mut self, polygons: impl Iterator<Item = P>) {
        let mut mask = Mask::new(self.pixels.width(), self.pixels.height());
        for polygon in polygons {
            let mut builder = path(polygon);
            builder.close();
            if let (Some(mask), Some(path)) = (&mut mask, builder.finish()) {
                mask.fill_path(&path, FillRule::Winding, true, Transform::identity());
            }
        }
        self.mask = mask;
    }

    /// From now on, lines are drawn everywhere.
    pub(crate) fn everywhere(&mut self) {
        self.mask = None;
    }

    /// Whitens everything outside of a rectangle with the given upper left corner.
    pub(crate) fn wipe_outside(&mut self, [x, y]: [f32; 2], [width, tall]: [f32; 2]) {
        const WHITE: Rgb = [255, 255, 255];
        let (all, height) = (self.pixels.width() as f32, self.pixels.height() as f32);
        self.rectangle([0.0, 0.0], [all, y], WHITE);
        self.rectangle([0.0, y + tall], [all, height - y - tall], WHITE);
        self.rectangle([0.0, 0.0], [x, height], WHITE);
        self.rectangle([x + width, 0.0], [all - x - width, height], WHITE);
    }

    /// A polyline with round joins.
    pub(crate) fn polyline(&mut self, vertices: impl Iterator<Item = [f32; 2]>, width: f32, color: Rgb) {
        let (line_cap, line_join) = (LineCap::Round, LineJoin::Round);
        self.stroke(vertices, &Stroke { width, line_cap, line_join, ..Stroke::default() }, color);
    }

    /// A dashed polyline.
    pub(crate) fn dashes(&mut self, vertices: impl Iterator<Item = [f32; 2]>, width: f32, color: Rgb) {
        let dash = StrokeDash::new(vec![3.0 * width, 2.0 * width], 0.0);
        self.stroke(vertices, &Stroke { width, dash, ..Stroke::default() }, color);
    }

    fn stroke(&mut self, vertices: impl Iterator<Item = [f32; 2]>, stroke: &Stroke, color: Rgb) {
        if let Some(path) = path(vertices).finish() {
            self.pixels.stroke_path(&path, &paint(color), stroke, Transform::identity(), self.mask.as_ref());
        }
    }

    /// Legend entries with a dot of their color each, from right to left; the last one ends at `end`. They are smaller if they would need more than the `room`.
    pub(crate) fn legend(&mut self, entries: &[(impl AsRef<str>, Rgb)], end: [f32; 2], room: f32, size: f32) {
        let [mut x, y] = end;
        let wide: f32 = entries.iter().map(|(name, _)| self.text_width(name.as_ref(), size) + DOT + GAP).sum();
        let shrunk = (room / wide).min(1.0);
        let size = shrunk * size;
        for (name, color) in entries.iter().rev() {
            let name = name.as_ref();
            x -= self.text_width(name, size);
            self.text(name, [x, y], size);
            x -= shrunk * DOT;
            self.circles([[x, y - shrunk * 8.0]].into_iter(), shrunk * 11.0, colors::WALL);
            self.circles([[x, y - shrunk * 8.0]].into_iter(), shrunk * 10.0, *color);
            x -= shrunk * GAP;
        }
    }

    /// The width of a text of the given height in pixels.
    pub(crate) fn text_width(&self, text: &str, size: f32) -> f32 {
        let font = self.font.as_scaled(PxScale::from(size));
        text.chars().map(|c| font.h_advance(font.glyph_id(c))).sum()
    }

    /// A line of text; `anchor` is the left end of its baseline.
    pub(crate) fn text(&mut self, text: &str, anchor: [f32; 2], size: f32) {
        let mut x = anchor[0];
        let scale = PxScale::from(size);
        for character in text.chars() {
            let id = self.font.glyph_id(character);
            let glyph = id.with_scale_and_position(scale, ab_glyph::point(x, anchor[1]));
            self.glyph(glyph);
            x += self.font.as_scaled(scale).h_advance(id);
        }
    }

    /// The longest prefix of `text` that fits into `width` pixels, with an ellipsis if it was cut.
    pub(crate) fn fitted(&self, text: &str, size: f32, width: f32) -> String {
        /// No picture has room for more characters; a title can have any number.
        const MOST_LETTERS: usize = 500;
        let mut shorter: String = text.chars().take(MOST_LETTERS).collect();
        if shorter.len() == text.len() && self.text_width(text, size) <= width {
            return shorter;
        }
        while shorter.pop().is_some() {
            let candidate = format!("{}…", shorter.trim_end());
            if self.text_width(&candidate, size) <= width {
                return candidate;
            }
        }
        shorter
    }

    fn glyph(&mut self, glyph: Glyph) {
        let Some(outline) = self.font.outline_glyph(glyph) else { return };
        let corner = outline.px_bounds().min;
        let (width, height) = (self.pixels.width(), self.pixels.height());
        let pixels = self.pixels.pixels_mut();
        outline.draw(|x, y, coverage| {
            let (column, row) = (corner.x + x as f32, corner.y + y as f32);
            if column < 0.0 || row < 0.0 || column >= width as f32 || row >= height as f32 {
                return;
            }
            if let Some(pixel) = pixels.get_mut(row as usize * width as usize + column as usize) {
                let darken = |value: u8| (f32::from(value) * (1.0 - coverage.clamp(0.0, 1.0))).round() as u8;
                let [red, green, blue] = [pixel.red(), pixel.green(), pixel.blue()].map(darken);
                *pixel = PremultipliedColorU8::from_rgba(red, green, blue, pixel.alpha()).unwrap_or(*pixel);
            }
        });
    }

    /// The canvas as a picture.
    pub(crate) fn picture(&self) -> Picture {
        // Opaque everywhere, so three channels suffice.
        let colors = self.pixels.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect();
        Picture { size: [self.pixels.width(), self.pixels.height()], colors }
    }
}

/// A picture in pixels.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width and height.
    pub(crate) size: [u32; 2],
    /// Row by row.
    pub(crate) colors: Vec<Rgb>,
}

impl Picture {
    /// The picture as a PNG file.
    ///
    /// # Errors
    /// [`PictureError::Encode`].
    pub fn png(&self) -> Result<Vec<u8>, PictureError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.size[0], self.size[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::Fast);
        encoder.set_filter(png::Filter::Adaptive);
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(self.colors.as_flattened()));
        written.map_err(|error| PictureError::Encode(error.to_string()))?;
        Ok(bytes)
    }

    /// Number of pixels of a color.
    #[cfg(test)]
    pub(crate) fn count(&self, color: Rgb) -> usize {
        self.colors.iter().filter(|found| **found == color).count()
    }
}
