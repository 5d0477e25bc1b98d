//! From the entities of a DXF file to filled shapes: blocks expanded, layers selected, lines joined.

use std::collections::BTreeMap;

use super::chain::chains;
use super::entity::{self, CLOSING_GAP, Content, Insert};
use super::gaps::{Gap, gaps};
use super::header::{File, Layer, Record};
use crate::import::affine::Affine;
use crate::import::closing::{Closed, close};
use crate::import::contour::Piece;
use crate::import::drawing::{Drawing, Entity, FillRule, Nesting, Outline, Paint, Refusal};
use crate::import::limits::Budget;
use meniscus_core::math::{Bounds, Vec2};

/// Maximum nesting depth of blocks.
const DEEPEST: usize = 64;
/// Number of groups of an entity per item of the budget.
const GROUPS_PER_ITEM: usize = 32;
/// Number of messages after which reading stops.
const MOST_REFUSALS: usize = 20;

/// The drawing of a file.
pub(crate) fn drawing(
    file: &File,
    bytes: usize,
    layers: Option<&[String]>,
    join_within: f64,
) -> Result<Drawing, Vec<Refusal>> {
    let mut reader = Reader {
        file,
        layers,
        join_within,
        wide: 0,
        budget: Budget::of_file(bytes),
        inserting: Vec::new(),
        drawing: Drawing { unit: file.unit.clone(), nesting: Nesting::OfAll, ..Drawing::default() },
        open: BTreeMap::new(),
        refusals: Vec::new(),
        is_over: false,
    };
    for name in file.layers.keys() {
        reader.drawing.layers.insert(name.clone(), 0);
    }
    reader.records(&file.records, &Affine::identity(), None);
    reader.check_layers();
    reader.join();
    if reader.refusals.is_empty() { Ok(reader.drawing) } else { Err(reader.refusals) }
}

struct Reader<'a> {
    file: &'a File<'a>,
    layers: Option<&'a [String]>,
    /// Distance within which ends of lines are joined, in units of the drawing.
    join_within: f64,
    /// Number of polylines with a width.
    wide: usize,
    budget: Budget,
    /// The blocks being inserted, to detect recursive insertions.
    inserting: Vec<String>,
    drawing: Drawing,
    /// Pieces with free ends and their source locations, by layer.
    open: BTreeMap<String, Vec<(Piece, String)>>,
    refusals: Vec<Refusal>,
    /// Whether reading has stopped.
    is_over: bool,
}

impl Reader<'_> {
    fn refuse(&mut self, refusal: Refusal) {
        self.refusals.push(refusal);
        self.is_over |= self.refusals.len() >= MOST_REFUSALS;
    }

    /// Takes from the budget; false, with a message, if it is exhausted.
    fn spend(&mut self, items: usize, location: impl Fn() -> String) -> bool {
        let has_room = self.budget.spend(items);
        if !has_room && !self.is_over {
            let found = format!("blocks that unfold into more than {} entities and vertices", self.budget.total);
            self.refuse(Refusal::new(location(), found, "a drawing with fewer copies of copies (INSERT)"));
            self.is_over = true;
        }
        has_room
    }

    /// Reads entities; `around` is the layer of the enclosing insertion.
    fn records(&mut self, records: &[Record], map: &Affine, around: Option<&str>) {
        let mut at = 0;
        while at < records.len() && !self.is_over {
            let record = &records[at];
            // Long entities without vertices, such as long texts, cost only time.
            if !self.spend(1 + record.groups.len() / GROUPS_PER_ITEM, || record.location()) {
                return;
            }
            match entity::read(&records[at..]) {
                Ok((content, taken)) => {
                    at += taken;
                    self.content(content, record, map, around);
                }
                Err(refusal) => {
                    at += 1;
                    let location = if refusal.location == record.location() {
                        refusal.location
                    } else {
                        format!("{}, {}", refusal.location, record.location())
                    };
                    self.refuse(Refusal { location, ..refusal });
                }
            }
        }
    }

    fn content(&mut self, content: Content, record: &Record, map: &Affine, around: Option<&str>) {
        let flag = |code: i32| {
            let group = record.groups.iter().find(|group| group.code == code);
            group.and_then(|group| group.whole().ok()).is_some_and(|value| value != 0)
        };
        // Entities of a block on layer 0 are on the layer of the insertion.
        let own = record.layer();
        let layer = if own == "0" { around.unwrap_or("0") } else { &own };
        let state = self.file.layers.get(layer).copied().unwrap_or_default();
        if flag(67) {
            return self.drawing.count("entities in paper space", 1);
        }
        if flag(60) {
            return self.drawing.count("invisible entities", 1);
        }
        match content {
            Content::Unused(kind) => self.drawing.count(&kind, 1),
            // A frozen insertion hides its entities on other layers too, one that is off does not.
            Content::Insert(_) if state.is_frozen && self.layers.is_none() => {
                self.drawing.count("entities on layers that are off or frozen", 1)
            }
            Content::Insert(insert) => self.insert(&insert, record, map, layer),
            Content::Contour { .. } | Content::Wide(_) => {
                *self.drawing.layers.entry(layer.to_owned()).or_default() += 1;
                let is_chosen = self.layers.map(|layers| layers.iter().any(|name| name == layer));
                match (is_chosen, state) {
                    (Some(false), _) => self.drawing.count("entities on other layers", 1),
                    (None, Layer { is_frozen: true, .. } | Layer { is_off: true, .. }) => {
                        self.drawing.count("entities on layers that are off or frozen", 1)
                    }
                    _ => self.outlines(content, record, map, layer),
                }
            }
        }
    }

    fn outlines(&mut self, content: Content, record: &Record, map: &Affine, layer: &str) {
        match content {
            Content::Contour { pieces, is_closed } => self.contour(pieces, is_closed, record, map, layer),
            Content::Wide(outlines) => {
                self.wide += 1;
                outlines.into_iter().for_each(|pieces| self.contour(pieces, true, record, map, layer));
            }
            Content::Insert(_) | Content::Unused(_) => {}
        }
    }

    fn contour(&mut self, pieces: Vec<Piece>, is_closed: bool, record: &Record, map: &Affine, layer: &str) {
        let pieces: Vec<Piece> = pieces.iter().map(|piece| piece.mapped(map)).collect();
        if !self.spend(pieces.len(), || record.location()) {
            return;
        }
        if !pieces.iter().all(Piece::is_in_range) {
            let expected = "coordinates below 1e38 in the unit of the drawing";
            return self.refuse(Refusal::new(record.location(), "a coordinate out of range", expected));
        }
        if is_closed {
            let size = extent(&pieces);
            self.closed(&pieces, CLOSING_GAP * size, record.location(), layer);
        } else {
            let open = self.open.entry(layer.to_owned()).or_default();
            let location = record.location();
            open.extend(pieces.into_iter().map(|piece| (piece, location.clone())));
        }
    }

    fn closed(&mut self, pieces: &[Piece], gap: f64, location: String, layer: &str) {
        let outline = match close(pieces, gap) {
            Closed::Circle { center, radius, .. } => Outline::Disc { center, radius },
            Closed::Ring(ring) => {
                if !self.spend(ring.vertices.len(), || location.clone()) {
                    return;
                }
                Outline::Area { rings: vec![ring], rule: FillRule::EvenOdd }
            }
            Closed::Empty => return self.drawing.count("outlines without area", 1),
        };
        let paint = Paint::Unfilled { layer: layer.to_owned() };
        self.drawing.entities.push(Entity { outline, paint, location });
    }

    fn insert(&mut self, insert: &Insert, record: &Record, map: &Affine, layer: &str) {
        let file = self.file;
        let Some(block) = file.blocks.get(&insert.block) else {
            let found = format!("the block `{}`, which is not in the file", insert.block);
            return self.refuse(Refusal::new(
                record.location(),
                found,
                "the name of a block; bind external references first",
            ));
        };
        if self.inserting.contains(&insert.block) || self.inserting.len() >= DEEPEST {
            let found = format!("the block `{}` within itself, or within {DEEPEST} others", insert.block);
            return self.refuse(Refusal::new(record.location(), found, "blocks that do not contain themselves"));
        }
        self.inserting.push(insert.block.clone());
        let [columns, rows] = insert.number;
        'copies: for row in 0..rows {
            for column in 0..columns {
                if self.is_over || !self.spend(1, || record.location()) {
                    break 'copies;
                }
                let step = insert.steps[0] * column as f64 + insert.steps[1] * row as f64;
                let copy = Affine::translation(step).after(&insert.map).after(&Affine::translation(-block.base));
                self.records(&block.records, &map.after(&copy), Some(layer));
            }
        }
        self.inserting.pop();
    }

    fn check_layers(&mut self) {
        let known: Vec<String> = self.drawing.layers.keys().map(|name| format!("`{name}`")).collect();
        for layer in self.layers.unwrap_or_default() {
            if !self.drawing.layers.contains_key(layer) {
                let found = format!("`{layer}`, which is not in the file");
                self.refusals.push(Refusal::new("layers", found, format!("one of {}", known.join(", "))));
            }
        }
    }

    /// Joins lines and arcs of each layer.
    fn join(&mut self) {
        let mut branches = 0;
        for (layer, open) in std::mem::take(&mut self.open) {
            let pieces: Vec<Piece> = open.iter().map(|(piece, _)| piece.clone()).collect();
            let size = extent(&pieces);
            let gap = self.join_within.max(CLOSING_GAP * size);
            let chains = chains(&pieces, gap);
            self.report_gaps(&chains.free, &open, size);
            for (first, ring) in chains.rings {
                self.closed(&ring, gap, open[first].1.clone(), &layer);
            }
            let unused = [("open lines", chains.open), ("lines drawn twice", chains.doubled)];
            unused
                .iter()
                .filter(|(_, number)| *number > 0)
                .for_each(|(kind, number)| self.drawing.count(kind, *number));
            branches += chains.branches;
        }
        if branches > 0 {
            self.drawing.notes.push(format!(
                "At {branches} points more than two lines meet; rings there follow the order of the file and may differ from those intended."
            ));
        }
        if self.wide > 0 {
            self.drawing.notes.push(format!(
                "{} polylines have a width: they are solid out to the outer edge of it, closed ones inside too.",
                self.wide
            ));
        }
    }

    /// Reports the small gaps between free ends of lines.
    fn report_gaps(&mut self, free: &[(Vec2, usize)], open: &[(Piece, String)], size: f64) {
        let ends: Vec<Vec2> = free.iter().map(|(end, _)| *end).collect();
        let gaps = gaps(&ends, size);
        let Some(Gap { width, ends: [a, b] }) = gaps.first().copied() else { return };
        let location = |end: usize| &open[free[end].1].1;
        let at = ends[a];
        let between = if location(a) == location(b) {
            format!("between the ends of {}", location(a))
        } else {
            format!("between {} and {}", location(a), location(b))
        };
        self.drawing.notes.push(format!(
            "Lines remain open at {} gaps of up to {width:.3e} drawing units, the widest {between} at ({}, {}): join-within = {:.1e} closes them.",
            gaps.len(),
            at.x,
            at.y,
            1.1 * width
        ));
    }
}

/// The diagonal of the bounding box of ends and midpoints of pieces.
fn extent(pieces: &[Piece]) -> f64 {
    let points = pieces.iter().flat_map(|piece| piece.ends().into_iter().chain([piece.middle()]));
    Bounds::around(points).map_or(0.0, |bounds| bounds.size().norm())
}
