//! From one SVG shape to a filled area: its visible part, its rings or its circle, and notes on it.

use roxmltree::Node;

use super::{Context, Walk};
use crate::import::closing::{Closed, close};
use crate::import::drawing::{Entity, FillRule, Outline, Paint, Ring};
use crate::import::svg::shape;
use crate::import::svg::style::Fill;
use meniscus_core::math::Vec2;

impl<'a, 'input> Walk<'a, 'input> {
    /// Adds a shape to the drawing, or counts it as unused by the reason.
    pub(super) fn shape(&mut self, node: Node<'a, 'input>, context: &Context<'a>) {
        let style = context.style;
        if !style.is_visible || (style.fill == Fill::None && !style.has_stroke) {
            return self.count("hidden elements");
        }
        if let Some(layer) = context.layer {
            *self.drawing.layers.entry(layer.to_owned()).or_default() += 1;
        }
        if !context.is_chosen {
            return self.count("elements on other layers");
        }
        let subpaths = match shape::contours(node, context.viewport) {
            Ok(subpaths) => subpaths,
            Err(found) => {
                return self.refuse(
                    node,
                    found,
                    "numbers in SVG syntax, lengths with a unit or none, sizes of 0 or more",
                );
            }
        };
        let mut rings = Vec::new();
        let mut circles = Vec::new();
        for subpath in subpaths {
            let pieces: Vec<_> = subpath.pieces.iter().map(|piece| piece.mapped(&context.map)).collect();
            if !pieces.iter().all(|piece| piece.is_in_range()) {
                return self.refuse(node, "a coordinate out of range", "coordinates below 1e38 after all transforms");
            }
            // An open outline that is only stroked encloses nothing; a fill closes it.
            if style.fill == Fill::None && !subpath.is_closed {
                self.count("open lines");
                continue;
            }
            if !self.budget.spend(pieces.len()) {
                return self.refuse_size(node);
            }
            let closed = close(&pieces, 0.0);
            let vertices = if let Closed::Ring(ring) = &closed { ring.vertices.len() } else { 1 };
            if !self.budget.spend(vertices) {
                return self.refuse_size(node);
            }
            match closed {
                Closed::Circle { center, radius, is_clockwise } => {
                    circles.push((center, radius));
                    rings.push(full_circle(center, radius, is_clockwise));
                }
                Closed::Ring(ring) => rings.push(ring),
                Closed::Empty if !subpath.is_closed => {
                    self.count("open lines");
                    continue;
                }
                Closed::Empty => {
                    self.count("shapes without area");
                    continue;
                }
            }
            self.tally.not_closed += usize::from(!subpath.is_closed);
        }
        let rule = if style.fill == Fill::None { FillRule::NonZero } else { style.rule };
        let outline = match (&circles[..], rings.len()) {
            (_, 0) => return,
            (&[(center, radius)], 1) => Outline::Disc { center, radius },
            _ => Outline::Area { rings, rule },
        };
        self.tally.strokes += usize::from(style.fill != Fill::None && style.has_stroke);
        let paint = match style.fill {
            Fill::None => Paint::Unfilled { layer: context.layer.unwrap_or_default().to_owned() },
            Fill::White => Paint::White,
            Fill::Color(_) => Paint::Filled,
        };
        self.colors.push(style.fill);
        self.drawing.entities.push(Entity { outline, paint, location: self.lines.location(node) });
    }
}

/// A circle as a ring of two half circles, for areas of several rings.
fn full_circle(center: Vec2, radius: f64, is_clockwise: bool) -> Ring {
    let bulge = if is_clockwise { -1.0 } else { 1.0 };
    Ring { vertices: vec![[center.x + radius, center.y, bulge], [center.x - radius, center.y, bulge]] }
}
