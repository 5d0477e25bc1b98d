//! Lengths, viewports and the page of an SVG drawing: its unit and the position of its corners.

use std::str::FromStr;

use roxmltree::Node;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, Transform, ViewBox};

use crate::import::affine::Affine;
use crate::import::drawing::Unit;
use meniscus_core::math::{Bounds, Vec2};

/// An inch in m.
const INCH: f64 = 0.0254;
/// CSS: 96 px are an inch.
const PIXEL: f64 = INCH / 96.0;

/// Reference of relative lengths: the size of the nearest viewport in its user units, if known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Viewport {
    /// Width and height.
    pub(crate) size: Option<Vec2>,
}

/// The reference direction of a percentage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Along {
    /// The width of the viewport.
    X,
    /// The height of the viewport.
    Y,
    /// The root mean square of both.
    Diagonal,
}

/// The name of a unit of length and its length in m; `None` for relative ones.
fn unit_of(unit: LengthUnit) -> Option<(&'static str, f64)> {
    match unit {
        LengthUnit::Mm => Some(("mm", 1e-3)),
        LengthUnit::Cm => Some(("cm", 1e-2)),
        LengthUnit::In => Some(("in", INCH)),
        LengthUnit::Pt => Some(("pt", INCH / 72.0)),
        LengthUnit::Pc => Some(("pc", INCH / 6.0)),
        LengthUnit::Px => Some(("px", PIXEL)),
        LengthUnit::None | LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => None,
    }
}

impl Viewport {
    /// The length of an attribute in user units; `None` if it is absent. On a mistake, what was found.
    pub(crate) fn length(&self, node: Node, name: &str, along: Along) -> Result<Option<f64>, String> {
        let Some(text) = node.attribute(name).filter(|text| !text.trim().is_empty() && text.trim() != "auto") else {
            return Ok(None);
        };
        self.value(text.trim(), along).map(Some).ok_or_else(|| format!("{name}=\"{text}\""))
    }

    /// A length in user units; `None` if unknown.
    pub(crate) fn value(&self, text: &str, along: Along) -> Option<f64> {
        let Length { number, unit } = Length::from_str(text).ok()?;
        let value = match (unit, unit_of(unit)) {
            (LengthUnit::None, _) => number,
            (LengthUnit::Percent, _) => {
                let size = self.size?;
                let whole = match along {
                    Along::X => size.x,
                    Along::Y => size.y,
                    Along::Diagonal => (0.5 * size.norm_squared()).sqrt(),
                };
                0.01 * number * whole
            }
            (_, unit) => number * (unit?.1 / PIXEL),
        };
        value.is_finite().then_some(value)
    }
}

/// The text of an attribute `transform` as a map.
pub(crate) fn transform(text: &str) -> Result<Affine, String> {
    let found = || shortened(text);
    let Transform { a, b, c, d, e, f } = Transform::from_str(text).map_err(|_| found())?;
    if [a, b, c, d, e, f].iter().any(|number| !number.is_finite()) {
        return Err(found());
    }
    Ok(Affine::from_columns(Vec2::new(a, b), Vec2::new(c, d), Vec2::new(e, f)))
}

/// At most the first 60 characters, for messages.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        Some((at, _)) => format!("{} ...", &text[..at]),
        None => text.to_owned(),
    }
}

/// The view box of an element; `None` if it has none.
pub(crate) fn view_box(node: Node) -> Result<Option<ViewBox>, String> {
    let Some(text) = node.attribute("viewBox") else { return Ok(None) };
    let found = || format!("viewBox=\"{}\"", shortened(text));
    let view_box = ViewBox::from_str(text).map_err(|_| found())?;
    let ViewBox { x, y, w, h } = view_box;
    if [x, y, w, h].iter().all(|number| number.is_finite()) && w > 0.0 && h > 0.0 {
        Ok(Some(view_box))
    } else {
        Err(found())
    }
}

/// The map from a view box to a viewport of the given size at the origin, by `preserveAspectRatio`.
pub(crate) fn fit(node: Node, view_box: ViewBox, size: Vec2) -> Result<Affine, String> {
    let ratio = match node.attribute("preserveAspectRatio") {
        Some(text) => AspectRatio::from_str(text).map_err(|_| format!("preserveAspectRatio=\"{text}\""))?,
        None => AspectRatio::default(),
    };
    let (x, y) = (size.x / view_box.w, size.y / view_box.h);
    let (x, y) = match (ratio.align, ratio.slice) {
        (Align::None, _) => (x, y),
        (_, false) => (x.min(y), x.min(y)),
        (_, true) => (x.max(y), x.max(y)),
    };
    let rest = Vec2::new(size.x - view_box.w * x, size.y - view_box.h * y);
    let share = match ratio.align {
        Align::None | Align::XMinYMin => [0.0, 0.0],
        Align::XMidYMin => [0.5, 0.0],
        Align::XMaxYMin => [1.0, 0.0],
        Align::XMinYMid => [0.0, 0.5],
        Align::XMidYMid => [0.5, 0.5],
        Align::XMaxYMid => [1.0, 0.5],
        Align::XMinYMax => [0.0, 1.0],
        Align::XMidYMax => [0.5, 1.0],
        Align::XMaxYMax => [1.0, 1.0],
    };
    let corner = Vec2::new(rest.x * share[0], rest.y * share[1]);
    let to_origin = Affine::translation(-Vec2::new(view_box.x, view_box.y));
    Ok(Affine::translation(corner).after(&Affine::scaling(x, y)).after(&to_origin))
}

/// The page: conversion of the coordinates of the outermost element to those of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Page {
    /// From user units of the outermost element, y down, to the drawing, y up.
    pub(crate) map: Affine,
    /// Reference of lengths in the outermost element.
    pub(crate) viewport: Viewport,
    /// The unit of the drawing.
    pub(crate) unit: Option<Unit>,
    /// The page, its lower left corner at the origin.
    pub(crate) frame: Option<Bounds>,
}

impl Page {
    /// The page of the outermost element.
    pub(crate) fn of(root: Node) -> Result<Self, String> {
        let view_box = view_box(root)?;
        let [width, height] = [side(root, "width")?, side(root, "height")?];
        // The unit is that of the width, else of the height.
        let named = width.and_then(|side| unit_of(side.unit)).or_else(|| height.and_then(|side| unit_of(side.unit)));
        let in_unit = |side: Option<Length>| {
            let side = side?;
            match (unit_of(side.unit), named) {
                (Some((own, _)), Some((name, _))) if own == name => Some(side.number),
                (Some((_, own)), Some((_, meters))) => Some(side.number * (own / meters)),
                // A bare number combined with a length with a unit is in px.
                (None, Some((_, meters))) => Some(side.number * (PIXEL / meters)),
                (_, None) => Some(side.number),
            }
        };
        let (width, height) = (in_unit(width), in_unit(height));
        let unit = named.map(|(name, meters)| Unit { name: name.to_owned(), meters });
        // Without a view box a user unit is a px.
        let pixel = named.map_or(1.0, |(_, meters)| PIXEL / meters);
        let (size, map) = match view_box {
            Some(view_box) => {
                let ratio = view_box.h / view_box.w;
                let size = match (width, height, named) {
                    // Without a unit the numbers of the view box are those of the drawing.
                    (_, _, None) | (None, None, _) => Vec2::new(view_box.w, view_box.h),
                    (Some(width), Some(height), _) => Vec2::new(width, height),
                    (Some(width), None, _) => Vec2::new(width, width * ratio),
                    (None, Some(height), _) => Vec2::new(height / ratio, height),
                };
                (Some(size), fit(root, view_box, size)?)
            }
            None => (width.zip(height).map(|(width, height)| Vec2::new(width, height)), Affine::scaling(pixel, pixel)),
        };
        let flip = Affine { shift: Vec2::new(0.0, size.map_or(0.0, |size| size.y)), ..Affine::scaling(1.0, -1.0) };
        let inner = view_box.map(|view_box| Vec2::new(view_box.w, view_box.h));
        Ok(Self {
            map: flip.after(&map),
            viewport: Viewport { size: inner.or(size.map(|size| size / pixel)) },
            unit,
            frame: size.map(|size| Bounds { min: Vec2::zeros(), max: size }),
        })
    }
}

/// Width or height of the outermost element; `None` if it is absent or a percentage of the window.
fn side(root: Node, name: &str) -> Result<Option<Length>, String> {
    let Some(text) = root.attribute(name).filter(|text| !matches!(text.trim(), "" | "auto")) else { return Ok(None) };
    let found = || format!("{name}=\"{}\"", shortened(text));
    let length = Length::from_str(text.trim()).map_err(|_| found())?;
    match length.unit {
        LengthUnit::Percent => Ok(None),
        LengthUnit::Em | LengthUnit::Ex => Err(found()),
        _ if length.number > 0.0 && length.number.is_finite() => Ok(Some(length)),
        _ => Err(found()),
    }
}
