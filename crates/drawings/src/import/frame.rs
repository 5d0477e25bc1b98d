//! What the outlines around the others are: the frame of a chip, the wall of a chamber, or the rim of a plate with holes.
//!
//! Outlines without fill that enclose more than half of all others are *around* them. The inside of the innermost one is the pore if it is the only one with
//! another layer than what it encloses, has a layer named as frames are, or encloses filled shapes; if it lies in another one; or if the user says so. If it
//! is convex, as a border is, it is no wall, and its box is the domain. Otherwise, or within another outline, it is the wall of the pore: all outside of it
//! is solid. On one layer with what it encloses, it may as well be a plate with holes: the user is asked.

use crate::import::combine::{Solid, TOLERANCE};
use crate::import::drawing::{Entity, Outline, Paint, Ring};
use crate::import::nest::{Region, circle, containing};
use crate::import::notes::Notes;
use crate::import::options::{Frame, Options};
use meniscus_core::math::{Bounds, Vec2};

/// The layer of the rectangle that defines the domain.
pub(crate) const DOMAIN: &str = "domain";
/// Names of layers of frames, as parts of words in small letters.
const NAMES: [&str; 5] = ["frame", "border", "boundary", "wafer", "die"];
/// Minimum number of outlines around which an outline without fill may be a frame, unless its layer says so or it encloses a filled one.
const FEWEST: usize = 2;
/// A convex outline of more than this share of the area of the one around it is the inner line of a double border.
const DOUBLE: f64 = 0.8;

/// What remains of a drawing without its frame.
#[derive(Default)]
pub(crate) struct Framed {
    /// The box of the frame or of the chamber.
    pub(crate) domain: Option<Bounds>,
    /// The wall of the chamber, and its source location.
    pub(crate) chamber: Option<(Ring, String)>,
    /// Whether an outline around the others is the rim of a plate, so that they are its holes whatever the format.
    pub(crate) is_plate: bool,
}

/// Two readings are possible: what is ambiguous.
pub(crate) struct Ambiguous(pub(crate) String);

/// Removes outlines around the others, unless they are the rim of a plate; notes describe the reading.
///
/// # Errors
/// [`Ambiguous`] if the option [`Frame`] has to choose.
pub(crate) fn taken_out(outlines: &mut Vec<Entity>, options: &Options, notes: &mut Notes) -> Result<Framed, Ambiguous> {
    let is_domain = |one: &Entity| {
        let is_named = matches!(&one.paint, Paint::Unfilled { layer } if layer.eq_ignore_ascii_case(DOMAIN));
        is_named && is_rectangle(&one.outline)
    };
    if let Some(domain) = outlines.iter().position(is_domain) {
        let domain = outlines.remove(domain).bounds();
        return Ok(Framed { domain: Some(domain), ..Framed::default() });
    }
    let Some(found) = Around::of(outlines) else { return Ok(Framed::default()) };
    let Some(is_pore) = found.is_pore(outlines, options)? else { return Ok(Framed::default()) };
    let innermost = *found.chain.last().unwrap_or(&0);
    let location = outlines[innermost].location.clone();
    let what = found.text(outlines);
    if !is_pore {
        notes.add(format!("{what}: it is read as the rim of a plate, with them as holes (frame = \"solid\")."));
        return Ok(Framed { is_plate: true, ..Framed::default() });
    }
    let ring = found.ring;
    let domain = ring.bounds();
    let is_wall = found.is_wall;
    if is_wall {
        notes.add(format!("{what}: it is read as the wall of the pore, and all outside of it as solid."));
    } else {
        notes.add(format!("{what}: it is read as the frame of the chip, whose inside is the pore. If it is solid, give it a fill, or frame = \"solid\"."));
    }
    let mut index = 0;
    let before = outlines.len();
    outlines.retain(|one| {
        let is_kept = !found.chain.contains(&index)
            && !found.united.contains(&index)
            && (!is_wall || overlaps(&one.bounds(), &domain));
        index += 1;
        is_kept
    });
    let solid = before - found.chain.len() - found.united.len() - outlines.len();
    if solid > 0 {
        notes.add(format!("{solid} outlines beside the chamber lie in the solid."));
    }
    Ok(Framed { domain: Some(domain), chamber: is_wall.then_some((ring, location)), is_plate: false })
}

/// The solid of a box around a chamber; `None` if it cannot be determined.
pub(crate) fn around_chamber(chamber: &Ring, domain: Bounds) -> Option<Vec<Region>> {
    let Bounds { min, max } = domain;
    let corners = [[min.x, min.y, 0.0], [max.x, min.y, 0.0], [max.x, max.y, 0.0], [min.x, max.y, 0.0]];
    let all = Solid::of_ring(&Ring { vertices: corners.to_vec() })?;
    all.without(&[Solid::of_ring(chamber)?], TOLERANCE * domain.size().max())
}

/// The outlines around the others.
struct Around {
    /// Their indices, from the outermost one.
    chain: Vec<usize>,
    /// The innermost one, united with outlines on its layer that cross it, as channels do; and their indices.
    ring: Ring,
    united: Vec<usize>,
    /// The outlines inside it, and the number of all others.
    inside: Vec<usize>,
    others: usize,
    /// Whether the innermost one is the wall of a chamber, not a border.
    is_wall: bool,
}

impl Around {
    fn of(outlines: &[Entity]) -> Option<Self> {
        let rings: Vec<Ring> = outlines.iter().map(|one| first_ring(&one.outline)).collect();
        let areas: Vec<f64> = rings.iter().map(|ring| ring.area().abs()).collect();
        let around = containing(&rings);
        let mut inside = vec![Vec::new(); outlines.len()];
        for (i, all) in around.iter().enumerate() {
            all.iter().for_each(|&j| inside[j].push(i));
        }
        let is_filled = |i: usize| outlines[i].paint == Paint::Filled;
        let is_candidate = |i: usize| {
            let is_single = match &outlines[i].outline {
                Outline::Disc { .. } => true,
                Outline::Area { rings, .. } => rings.len() == 1,
            };
            let own = &outlines[i].paint;
            let fewest = if inside[i].iter().any(|&j| is_filled(j)) || is_named(own) { 1 } else { FEWEST };
            // Inside a filled shape it is a hole.
            let is_hole = around[i].iter().any(|&j| is_filled(j));
            let is_around = inside[i].len() >= fewest && 2 * inside[i].len() > outlines.len() - 1;
            matches!(own, Paint::Unfilled { .. }) && is_single && is_around && !is_hole
        };
        let mut chain: Vec<usize> = (0..outlines.len()).filter(|&i| is_candidate(i)).collect();
        chain.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]));
        let (&outermost, &innermost) = chain.first().zip(chain.last())?;
        let inside = std::mem::take(&mut inside[innermost]);
        let crossing: Vec<usize> = (0..outlines.len())
            .filter(|&i| {
                let is_apart = chain.contains(&i) || inside.contains(&i);
                !is_apart
                    && outlines[i].paint == outlines[innermost].paint
                    && overlaps(&rings[i].bounds(), &rings[innermost].bounds())
            })
            .collect();
        let (ring, united) = match united(&rings[innermost], crossing.iter().map(|&i| &rings[i])) {
            Some(ring) if !crossing.is_empty() => (ring, crossing),
            _ => (rings[innermost].clone(), Vec::new()),
        };
        let are_convex = is_convex(&ring) && chain.iter().all(|&i| is_convex(&rings[i]));
        let is_border = are_convex && areas[innermost] >= DOUBLE * areas[outermost];
        Some(Self { chain, ring, united, inside, others: outlines.len() - 1, is_wall: !is_border })
    }

    /// Whether the inside of the innermost outline is the pore; `None` if it is left to the fills of the shapes.
    fn is_pore(&self, outlines: &[Entity], options: &Options) -> Result<Option<bool>, Ambiguous> {
        let innermost = *self.chain.last().unwrap_or(&0);
        let paint = &outlines[innermost].paint;
        let has_filled = self.inside.iter().any(|&i| outlines[i].paint == Paint::Filled);
        if has_filled {
            // Fills tell grains from other outlines, which are left out where they lie around filled shapes.
            let is_frame = !self.is_wall && is_rectangle(&outlines[innermost].outline);
            return Ok(is_frame.then_some(true));
        }
        if let Some(frame) = options.frame {
            return Ok(Some(frame == Frame::Pore));
        }
        let shares_layer = self.inside.iter().any(|&i| outlines[i].paint == *paint);
        if !shares_layer || is_named(paint) || self.chain.len() > 1 && self.is_wall {
            return Ok(Some(true));
        }
        Err(Ambiguous(self.text(outlines) + " on its own layer"))
    }

    fn text(&self, outlines: &[Entity]) -> String {
        let innermost = &outlines[*self.chain.last().unwrap_or(&0)];
        let layer = match &innermost.paint {
            Paint::Unfilled { layer } if !layer.is_empty() => format!(" on layer {layer}"),
            _ => String::new(),
        };
        let kind = if is_rectangle(&innermost.outline) { "a rectangle" } else { "an outline" };
        let (location, inside, others) = (&innermost.location, self.inside.len(), self.others);
        format!("{location}, {kind} without fill{layer}, encloses {inside} of the {others} other outlines")
    }
}

/// The outer ring of an outline united with others; `None` if it has holes then, or cannot be determined.
fn united<'a>(ring: &'a Ring, others: impl Iterator<Item = &'a Ring>) -> Option<Ring> {
    let parts: Vec<Solid> = std::iter::once(ring).chain(others).filter_map(Solid::of_ring).collect();
    let size = ring.bounds().size().max();
    let all = Solid::united(&parts, TOLERANCE * size)?;
    let (outer, holes) = all.into_iter().max_by(|a, b| a.0.area().abs().total_cmp(&b.0.area().abs()))?;
    holes.is_empty().then_some(outer)
}

fn is_named(paint: &Paint) -> bool {
    let Paint::Unfilled { layer } = paint else { return false };
    let layer = layer.to_lowercase();
    let mut words = layer.split(|c: char| !c.is_alphanumeric());
    words.any(|word| NAMES.iter().any(|name| word == *name || name.len() > 4 && word.contains(name)))
}

/// The first ring of an outline; a disc as two half circles.
pub(crate) fn first_ring(outline: &Outline) -> Ring {
    match outline {
        Outline::Disc { center, radius } => circle(*center, *radius),
        Outline::Area { rings, .. } => rings.first().cloned().unwrap_or_default(),
    }
}

fn overlaps(a: &Bounds, b: &Bounds) -> bool {
    (0..2).all(|i| a.min[i] < b.max[i] && b.min[i] < a.max[i])
}

/// Whether a ring turns one way only, arcs included, within rounding.
fn is_convex(ring: &Ring) -> bool {
    let n = ring.vertices.len();
    let sign = ring.area().signum();
    let point = |k: usize| Vec2::new(ring.vertices[k % n][0], ring.vertices[k % n][1]);
    let turns = (0..n).all(|k| {
        let (before, after) = (point(k + 1) - point(k), point(k + 2) - point(k + 1));
        sign * before.perp(&after) >= -1e-6 * before.norm() * after.norm()
    });
    turns && ring.vertices.iter().all(|vertex| sign * vertex[2] >= 0.0)
}

/// Whether an outline fills its bounding box.
fn is_rectangle(outline: &Outline) -> bool {
    let Outline::Area { rings, .. } = outline else { return false };
    let [ring] = &rings[..] else { return false };
    ring.is_straight() && ring.area().abs() >= (1.0 - 1e-9) * ring.bounds().area()
}
