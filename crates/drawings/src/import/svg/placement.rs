//! The transform of an SVG element, from the attribute or from CSS, about its origin.
//!
//! Source: CSS Transforms Module Level 1, W3C 2019. SVG elements are transformed about the origin of their coordinates unless `transform-origin` says
//! otherwise; percentages are those of the nearest viewport. Not supported are transforms in space, the properties of level 2 and fill or stroke boxes.

use std::str::FromStr;

use roxmltree::Node;
use svgtypes::{Angle, AngleUnit};

use super::page::{self, Along, Viewport, shortened};
use super::shape::SHAPES;
use super::style::{REFUSED, Source, StyleSheet};
use crate::import::affine::Affine;
use meniscus_core::math::Vec2;

/// The first ones move any element; the others apply to shapes only.
const OF_ALL: usize = 4;

/// What was found and what was expected instead.
pub(crate) type Mistake = (String, &'static str);

const MAPS: &str =
    "matrix, translate, scale, rotate, skewX or skewY in the plane, with lengths in px or another absolute unit";
const BOX: &str = "`transform-box: view-box`, or a transform about a point written in numbers";

/// The map from the coordinates of an element to those of its parent.
pub(crate) fn map(node: Node, sheet: &StyleSheet, viewport: Viewport) -> Result<Affine, Mistake> {
    let (mut transform, mut origin, mut own_box) = (None, None, None);
    let mut refused = None;
    let is_shape = SHAPES.contains(&node.tag_name().name());
    sheet.for_each(node, |source, name, value| match name {
        "transform" => transform = Some((source, value.to_owned())),
        "transform-origin" => origin = Some(value.to_owned()),
        "transform-box" => own_box = Some(value.to_owned()),
        _ if source == Source::Css && !matches!(value, "none" | "auto") => {
            let index = REFUSED.iter().position(|refused| *refused == name);
            if index.is_some_and(|index| is_shape || index < OF_ALL) {
                refused = Some(format!("`{name}: {}` in its style", shortened(value)));
            }
        }
        _ => {}
    });
    if let Some(found) = refused {
        return Err((found, "sizes and positions as attributes of the element, and `transform`"));
    }
    let Some((source, text)) = transform else { return Ok(Affine::identity()) };
    let own = match source {
        Source::Attribute => page::transform(&text).map_err(|found| (format!("transform=\"{found}\""), MAPS))?,
        Source::Css => css(&text, viewport).ok_or_else(|| (format!("`transform: {}`", shortened(&text)), MAPS))?,
    };
    if own == Affine::identity() {
        return Ok(own);
    }
    if let Some(own_box) = own_box.filter(|name| name != "view-box") {
        return Err((format!("a transform with `transform-box: {}`", shortened(&own_box)), BOX));
    }
    let Some(text) = origin else { return Ok(own) };
    let origin = point(&text, viewport).ok_or_else(|| {
        let found = format!("`transform-origin: {}`", shortened(&text));
        (found, "two lengths, such as `5px 5px`, or shares of a viewport of known size")
    })?;
    Ok(Affine::translation(origin).after(&own).after(&Affine::translation(-origin)))
}

/// The maps of a CSS `transform`, the last one first; `None` if one is not understood.
fn css(text: &str, viewport: Viewport) -> Option<Affine> {
    let mut all = Affine::identity();
    let mut rest = text.trim();
    if matches!(rest, "none" | "initial" | "unset") {
        return Some(all);
    }
    while !rest.is_empty() {
        let (name, after) = rest.split_once('(')?;
        let (arguments, after) = after.split_once(')')?;
        let arguments: Vec<&str> =
            arguments.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty()).collect();
        all = all.after(&function(&name.trim().to_ascii_lowercase(), &arguments, viewport)?);
        rest = after.trim_start().trim_start_matches(',').trim_start();
    }
    Some(all)
}

fn function(name: &str, arguments: &[&str], viewport: Viewport) -> Option<Affine> {
    let length = |k: usize, along| viewport.value(arguments.get(k).copied()?, along);
    let length_or_0 = |k: usize, along| if k < arguments.len() { length(k, along) } else { Some(0.0) };
    let tangent = |k: usize| {
        let slope = arguments.get(k).map_or(Some(0.0), |text| angle(text))?.to_radians().tan();
        slope.is_finite().then_some(slope)
    };
    let skew = |x: f64, y: f64| Affine::from_columns(Vec2::new(1.0, y), Vec2::new(x, 1.0), Vec2::zeros());
    let most = match name {
        "matrix" => 6,
        "translate" | "scale" | "skew" => 2,
        _ => 1,
    };
    if arguments.is_empty() || arguments.len() > most {
        return None;
    }
    let factor = |k: usize| number(arguments.get(k).copied()?);
    Some(match name {
        "translate" => Affine::translation(Vec2::new(length(0, Along::X)?, length_or_0(1, Along::Y)?)),
        "translatex" => Affine::translation(Vec2::new(length(0, Along::X)?, 0.0)),
        "translatey" => Affine::translation(Vec2::new(0.0, length(0, Along::Y)?)),
        "scale" => Affine::scaling(factor(0)?, if arguments.len() > 1 { factor(1)? } else { factor(0)? }),
        "scalex" => Affine::scaling(factor(0)?, 1.0),
        "scaley" => Affine::scaling(1.0, factor(0)?),
        "rotate" | "rotatez" => Affine::rotation_deg(angle(arguments[0])?),
        "skew" => skew(tangent(0)?, tangent(1)?),
        "skewx" => skew(tangent(0)?, 0.0),
        "skewy" => skew(0.0, tangent(0)?),
        "matrix" => {
            let column = |k: usize| Some(Vec2::new(factor(k)?, factor(k + 1)?));
            Affine::from_columns(column(0)?, column(2)?, column(4)?)
        }
        _ => return None,
    })
}

/// A number or a percentage.
fn angle(text: &str) -> Option<f64> {
    let Angle { number, unit } = Angle::from_str(text).ok()?;
    let degrees = match unit {
        AngleUnit::Degrees => number,
        AngleUnit::Gradians => 0.9 * number,
        AngleUnit::Radians => number.to_degrees(),
        AngleUnit::Turns => 360.0 * number,
    };
    degrees.is_finite().then_some(degrees)
}

/// A number, or a share in percent.
fn number(text: &str) -> Option<f64> {
    let value = match text.strip_suffix('%') {
        Some(percent) => 0.01 * percent.parse::<f64>().ok()?,
        None => text.parse().ok()?,
    };
    value.is_finite().then_some(value)
}

/// The point of a `transform-origin`.
fn point(text: &str, viewport: Viewport) -> Option<Vec2> {
    let words: Vec<&str> =
        text.split(|c: char| c == ',' || c.is_whitespace()).filter(|word| !word.is_empty()).collect();
    let (x, y) = match words[..] {
        [y @ ("top" | "bottom")] => ("center", y),
        [x] => (x, "center"),
        [y @ ("top" | "bottom"), x] | [y @ "center", x @ ("left" | "right")] => (x, y),
        // The third length is out of the plane.
        [x, y] | [x, y, _] => (x, y),
        _ => return None,
    };
    let value = |word, along| match word {
        "left" | "top" => Some(0.0),
        "center" => viewport.value("50%", along),
        "right" | "bottom" => viewport.value("100%", along),
        length => viewport.value(length, along),
    };
    Some(Vec2::new(value(x, Along::X)?, value(y, Along::Y)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn css_transforms_are_those_of_the_attribute() {
        let viewport = Viewport { size: Some(Vec2::new(20.0, 10.0)) };
        for (found, expected) in [
            ("translate(5px, 2px) rotate(90deg)", "translate(5 2) rotate(90)"),
            ("translate(25%,20%)", "translate(5 2)"),
            ("translateX(1in)", "translate(96)"),
            ("scale(2) skewX(0.125turn)", "scale(2) skewX(45)"),
            ("scale(200%, 50%)", "scale(2 .5)"),
            ("matrix(1, 2, 3, 4, 5, 6)", "matrix(1 2 3 4 5 6)"),
            ("rotate(100grad) translatey(3)", "rotate(90) translate(0 3)"),
            ("none", ""),
        ] {
            let (found, expected) = (css(found, viewport).unwrap(), page::transform(expected).unwrap());
            assert!((found.linear - expected.linear).norm() + (found.shift - expected.shift).norm() < 1e-12);
        }
        let open = Viewport { size: None };
        for text in
            ["rotateX(40deg)", "translate3d(1px,2px,3px)", "translate(1em)", "scale(2", "translate()", "scale(1,2,3)"]
        {
            assert_eq!(css(text, viewport), None, "{text}");
        }
        assert_eq!(css("translate(50%)", open), None);
    }

    #[test]
    fn origins_are_lengths_shares_or_words() {
        let viewport = Viewport { size: Some(Vec2::new(20.0, 10.0)) };
        for (text, expected) in [
            ("5px 5px", [5.0, 5.0]),
            ("50% 50% 0", [10.0, 5.0]),
            ("center", [10.0, 5.0]),
            ("bottom right", [20.0, 10.0]),
            ("left 3", [0.0, 3.0]),
        ] {
            assert_eq!(point(text, viewport), Some(expected.into()), "{text}");
        }
        assert_eq!(point("50%", Viewport { size: None }), None);
    }
}
