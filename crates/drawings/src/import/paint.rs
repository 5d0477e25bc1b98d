//! Shapes in painting order: white ones, and unfilled outlines on larger filled shapes, are pore where they cover those below.

use crate::import::combine::{Solid, TOLERANCE, area};
use crate::import::drawing::{Entity, Paint, Refusal};
use crate::import::fill::without_slits;
use crate::import::nest::Region;
use crate::import::notes::Notes;
use meniscus_core::math::Bounds;
use meniscus_geometry::tree::Tree;

/// Relative tolerance of areas: nothing was covered.
const SAME: f64 = 1e-12;

/// The area filled by one shape of the file.
pub(crate) struct Painted {
    pub(crate) regions: Vec<Region>,
    /// Its fill.
    pub(crate) paint: Paint,
    /// Its source location.
    pub(crate) location: String,
}

/// The remaining solid, each region with the source location of its shape.
pub(crate) fn solids(mut all: Vec<Painted>, notes: &mut Notes, refusals: &mut Vec<Refusal>) -> Vec<(Region, String)> {
    let is_mixed = all.iter().any(|one| one.paint == Paint::Filled);
    if is_mixed && all.iter().any(|one| one.paint != Paint::Filled) {
        cut(&mut all, notes, refusals);
    }
    let each = all.into_iter().filter(|one| one.paint != Paint::White);
    each.flat_map(|one| one.regions.into_iter().map(move |region| (region, one.location.clone()))).collect()
}

/// Marks filled shapes whose color is another one than that of the largest shape below them, in which they lie. `colors` has the fill of each.
pub(crate) fn mark_overlaid<C: PartialEq>(entities: &mut [Entity], colors: &[C]) {
    let boxes: Vec<Bounds> = entities.iter().map(Entity::bounds).collect();
    let tree = Tree::over(boxes.iter().copied());
    let is_filled = |i: usize| entities[i].paint == Paint::Filled;
    let is_overlaid = |k: &usize| {
        let below = tree.near(boxes[*k]).filter(|&i| i < *k && is_filled(i) && is_in(&boxes[i], &boxes[*k]));
        let largest = below.max_by(|&a, &b| boxes[a].area().total_cmp(&boxes[b].area()));
        is_filled(*k) && largest.is_some_and(|i| colors[i] != colors[*k])
    };
    let marked: Vec<usize> = (0..entities.len()).filter(is_overlaid).collect();
    marked.into_iter().for_each(|k| entities[k].paint = Paint::Overlaid);
}

fn bounds(one: &Painted) -> Bounds {
    let all = one.regions.iter().map(|(outer, _)| outer.bounds()).reduce(|a, b| a.united(&b));
    all.unwrap_or(Bounds { min: Default::default(), max: Default::default() })
}

fn cut(all: &mut [Painted], notes: &mut Notes, refusals: &mut Vec<Refusal>) {
    for one in all.iter_mut() {
        one.regions = std::mem::take(&mut one.regions).into_iter().flat_map(without_slits).collect();
    }
    let boxes: Vec<Bounds> = all.iter().map(bounds).collect();
    let areas: Vec<f64> = all.iter().map(|one| area(&one.regions)).collect();
    let tree = Tree::over(boxes.iter().copied());
    let size = boxes.iter().copied().reduce(|a, b| a.united(&b)).map_or(0.0, |all| all.size().max());
    let (mut white, mut holes, mut frames, mut shapes) = (0, 0, 0, 0);
    for k in 0..all.len() {
        let is_white = match all[k].paint {
            Paint::Filled | Paint::Overlaid => continue,
            Paint::White => true,
            Paint::Unfilled { .. } => false,
        };
        let cutters: Vec<Solid> = all[k].regions.iter().filter_map(Solid::of).collect();
        let below = tree.near_in_order(boxes[k]).into_iter().filter(|&i| {
            i < k && all[i].paint == Paint::Filled && (is_white || areas[i] > areas[k]) && !all[i].regions.is_empty()
        });
        let mut covers = 0;
        for i in below.collect::<Vec<_>>() {
            match without(&all[i].regions, &cutters, TOLERANCE * size) {
                Ok(None) => {}
                Ok(Some(left)) => {
                    all[i].regions = left;
                    covers += 1;
                }
                Err(()) => {
                    let found = format!("an outline that touches that of {} in a point", all[i].location);
                    let expected = "outlines that cross or keep apart: move one of them a little";
                    refusals.push(Refusal::new(all[k].location.clone(), found, expected));
                }
            }
        }
        let encloses =
            |i: usize| i != k && all[i].paint == Paint::Filled && areas[i] < areas[k] && is_in(&boxes[k], &boxes[i]);
        match (is_white, covers > 0) {
            (true, _) => white += 1,
            (false, true) => {
                holes += 1;
                all[k].paint = Paint::White;
            }
            (false, false) if tree.near(boxes[k]).any(encloses) => {
                frames += 1;
                all[k].paint = Paint::White;
            }
            (false, false) => shapes += 1,
        }
    }
    for (number, text) in [
        (white, "white shapes are pore where they cover what is painted before them"),
        (holes, "outlines without fill on larger filled shapes are pore"),
        (frames, "outlines without fill around filled shapes are not solid"),
        (shapes, "closed outlines without fill are taken for shapes"),
    ] {
        if number > 0 {
            notes.add(format!("{number} {text}."));
        }
    }
}

fn is_in(outer: &Bounds, inner: &Bounds) -> bool {
    outer.contains(inner.min) && outer.contains(inner.max)
}

/// The regions minus the cutters; `None` if these cover nothing, an error if it cannot be determined.
fn without(regions: &[Region], cutters: &[Solid], tolerance: f64) -> Result<Option<Vec<Region>>, ()> {
    let before = area(regions);
    let mut left = Vec::new();
    for region in regions {
        let solid = Solid::of(region).ok_or(())?;
        if cutters.iter().any(|cutter| cutter.bounds().overlaps(&solid.bounds())) {
            left.extend(solid.without(cutters, tolerance).ok_or(())?);
        } else {
            left.push(region.clone());
        }
    }
    Ok((area(&left) < before * (1.0 - SAME)).then_some(left))
}
