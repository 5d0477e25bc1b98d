//! The frame of a chip: an upright rectangle without fill around most of the other shapes. Its inside is the pore. It must enclose at least one filled shape,
//! or several outlines without fill. A rectangle on the layer `domain` is the domain.
//!
//! A rectangle on the same layer as the unfilled outlines inside it may also be a plate with holes, by the nesting of unfilled outlines: it is kept, and a
//! note names it.

use crate::geometry::import::drawing::{Entity, Outline, Paint, Ring};
use crate::geometry::import::notes::Notes;
use crate::math::{Bounds, Vec2};

/// The layer of the rectangle that defines the domain.
pub(crate) const DOMAIN: &str = "domain";
/// Minimum number of unfilled outlines that a frame encloses, unless it encloses a filled one.
const FEWEST: usize = 3;

/// Removes the frame from the outlines, with a note; its box is the domain unless the file names one.
pub(crate) fn taken_out(outlines: &mut Vec<Entity>, notes: &mut Notes) -> Option<Bounds> {
    let boxes: Vec<Bounds> = outlines.iter().map(bounds).collect();
    let is_domain = |one: &Entity| {
        let is_named = matches!(&one.paint, Paint::Unfilled { layer } if layer.eq_ignore_ascii_case(DOMAIN));
        is_named && is_rectangle(&one.outline)
    };
    if let Some(domain) = outlines.iter().position(is_domain) {
        outlines.remove(domain);
        return Some(boxes[domain]);
    }
    let is_candidate =
        |i: &usize| matches!(outlines[*i].paint, Paint::Unfilled { .. }) && is_rectangle(&outlines[*i].outline);
    let largest =
        (0..outlines.len()).filter(is_candidate).max_by(|a, b| boxes[*a].area().total_cmp(&boxes[*b].area()))?;
    let inside: Vec<usize> =
        (0..outlines.len()).filter(|&i| i != largest && is_in(&boxes[largest], &boxes[i])).collect();
    let others = outlines.len() - 1;
    let is_filled = |i: usize| outlines[i].paint == Paint::Filled;
    let fewest = if inside.iter().any(|&i| is_filled(i)) { 1 } else { FEWEST };
    // Inside a filled shape it is a hole.
    let is_hole = (0..outlines.len()).any(|i| i != largest && is_filled(i) && is_in(&boxes[i], &boxes[largest]));
    if inside.len() < fewest || 2 * inside.len() <= others || is_hole {
        return None;
    }
    let (location, paint) = (outlines[largest].location.clone(), &outlines[largest].paint);
    let found =
        format!("{location}, a rectangle without fill, encloses {} of the {others} other outlines", inside.len());
    if inside.iter().any(|&i| outlines[i].paint == *paint) {
        notes.add(format!(
            "{found} on its own layer: it is read as solid, with them as holes. If it is the frame of the chip, put it on a layer of its own."
        ));
        return None;
    }
    notes.add(format!(
        "{found}: it is read as the frame of the chip, whose inside is the pore. If it is solid, give it a fill."
    ));
    outlines.remove(largest);
    Some(boxes[largest])
}

fn bounds(entity: &Entity) -> Bounds {
    match &entity.outline {
        Outline::Disc { center, radius } => Bounds { min: *center, max: *center }.grown(*radius),
        Outline::Area { rings, .. } => {
            let all = rings.iter().map(Ring::bounds).reduce(|a, b| a.united(&b));
            all.unwrap_or(Bounds { min: Vec2::zeros(), max: Vec2::zeros() })
        }
    }
}

fn is_in(outer: &Bounds, inner: &Bounds) -> bool {
    outer.contains(inner.min) && outer.contains(inner.max)
}

/// Whether an outline fills its bounding box.
fn is_rectangle(outline: &Outline) -> bool {
    let Outline::Area { rings, .. } = outline else { return false };
    let [ring] = &rings[..] else { return false };
    ring.is_straight() && ring.area().abs() >= (1.0 - 1e-9) * ring.bounds().area()
}
