//! The frame of a chip: an upright rectangle without fill around most of the other shapes. Its inside is the pore.
//!
//! A rectangle on the layer of outlines without fill that it encloses may as well be a plate with holes, as outlines that are not filled
//! nest: it stays, and a note names it.

use std::collections::BTreeMap;

use crate::geometry::import::drawing::{Entity, Outline, Ring};
use crate::geometry::import::notes::Notes;
use crate::math::{Bounds, Vec2};

/// A frame encloses so many shapes at least.
const FEWEST: usize = 3;

/// Takes the frame out of the outlines, with a note; its box is the domain where the file names none.
pub(crate) fn taken_out(
    outlines: &mut Vec<Entity>,
    unfilled: &BTreeMap<String, String>,
    notes: &mut Notes,
) -> Option<Bounds> {
    let boxes: Vec<Bounds> = outlines.iter().map(bounds).collect();
    let is_candidate = |i: &usize| unfilled.contains_key(&outlines[*i].place) && is_rectangle(&outlines[*i].outline);
    let largest =
        (0..outlines.len()).filter(is_candidate).max_by(|a, b| boxes[*a].area().total_cmp(&boxes[*b].area()))?;
    let inside: Vec<usize> =
        (0..outlines.len()).filter(|&i| i != largest && is_in(&boxes[largest], &boxes[i])).collect();
    let others = outlines.len() - 1;
    if inside.len() < FEWEST || 2 * inside.len() <= others {
        return None;
    }
    let place = outlines[largest].place.clone();
    let layer = unfilled.get(&place);
    let told = format!("{place}, a rectangle without fill, encloses {} of the {others} other outlines", inside.len());
    if inside.iter().any(|&i| unfilled.get(&outlines[i].place) == layer) {
        notes.add(format!(
            "{told} on its own layer: it is read as solid, with them as holes. If it is the frame of the chip, put it on a layer of its own."
        ));
        return None;
    }
    notes.add(format!(
        "{told}: it is read as the frame of the chip, whose inside is the pore. If it is solid, give it a fill."
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

/// Whether an outline fills its upright box.
fn is_rectangle(outline: &Outline) -> bool {
    let Outline::Area { rings, .. } = outline else { return false };
    let [ring] = &rings[..] else { return false };
    ring.is_straight() && ring.area().abs() >= (1.0 - 1e-9) * ring.bounds().area()
}
