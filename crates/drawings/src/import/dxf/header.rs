//! The sections of a DXF file: unit, layers, blocks and entities.

use std::collections::BTreeMap;

use super::group::Group;
use crate::import::drawing::{Refusal, Unit};
use meniscus_core::math::Vec2;

/// An entity as stored in the file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Record<'a> {
    /// The groups after its kind.
    pub(crate) groups: &'a [Group<'a>],
    /// The group with its kind.
    pub(crate) head: &'a Group<'a>,
}

impl Record<'_> {
    /// Its kind: `LINE`, `CIRCLE`.
    pub(crate) fn kind(&self) -> String {
        self.head.text().into_owned()
    }

    /// `LWPOLYLINE 2F`, by its handle, else by its line.
    pub(crate) fn location(&self) -> String {
        match self.groups.iter().find(|group| group.code == 5) {
            Some(handle) => format!("{} {}", self.kind(), handle.text()),
            None => format!("{} at line {}", self.kind(), self.head.position),
        }
    }

    /// The layer; `0` by default.
    pub(crate) fn layer(&self) -> String {
        self.groups
            .iter()
            .find(|group| group.code == 8)
            .map_or_else(|| "0".to_owned(), |group| group.text().into_owned())
    }
}

/// The visibility of a layer.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Layer {
    /// Frozen: entities of blocks inserted on it are hidden too.
    pub is_frozen: bool,
    pub is_off: bool,
}

/// Named entities.
#[derive(Debug, Default)]
pub(crate) struct Block<'a> {
    /// The base point, which an insertion maps to its position.
    pub(crate) base: Vec2,
    /// Its entities.
    pub(crate) records: Vec<Record<'a>>,
}

/// A DXF file in parts.
#[derive(Debug, Default)]
pub(crate) struct File<'a> {
    /// The unit given in the header.
    pub(crate) unit: Option<Unit>,
    /// Layers by name.
    pub(crate) layers: BTreeMap<String, Layer>,
    /// Blocks by name, case-insensitive.
    pub(crate) blocks: BTreeMap<String, Block<'a>>,
    /// The entities outside of blocks.
    pub(crate) records: Vec<Record<'a>>,
}

impl<'a> File<'a> {
    /// The parts of a file.
    pub(crate) fn of(groups: &'a [Group<'a>]) -> Result<Self, Refusal> {
        let mut file = Self::default();
        let mut rest = groups;
        if !groups.first().is_some_and(|group| group.begins("SECTION")) {
            return Err(Refusal::new("line 2", "something else", "`SECTION` behind group code 0 (a DXF file)"));
        }
        while let Some((group, after)) = rest.split_first() {
            if group.begins("EOF") {
                break;
            }
            if !group.begins("SECTION") {
                rest = after;
                continue;
            }
            let Some(end) = after.iter().position(|group| group.begins("ENDSEC")) else {
                return Err(Refusal::new(
                    "end of the file",
                    "a section without an end",
                    "a complete file: this one is truncated",
                ));
            };
            let (section, after) = after.split_at(end);
            rest = after;
            let Some((name, content)) = section.split_first() else { continue };
            match name.text().as_ref() {
                "HEADER" => file.unit = unit(content)?,
                "TABLES" => file.layers = layers(content)?,
                "BLOCKS" => file.blocks = blocks(content)?,
                "ENTITIES" => file.records = records(content),
                _ => {}
            }
        }
        Ok(file)
    }
}

/// Groups split at those of code 0.
fn records<'a>(groups: &'a [Group<'a>]) -> Vec<Record<'a>> {
    let heads: Vec<usize> = (0..groups.len()).filter(|&i| groups[i].code == 0).collect();
    let ends = heads.iter().skip(1).copied().chain([groups.len()]);
    heads.iter().zip(ends).map(|(&head, end)| Record { head: &groups[head], groups: &groups[head + 1..end] }).collect()
}

fn layers(groups: &[Group]) -> Result<BTreeMap<String, Layer>, Refusal> {
    let mut layers = BTreeMap::new();
    for record in records(groups).into_iter().filter(|record| record.head.begins("LAYER")) {
        let (mut name, mut layer) = (None, Layer::default());
        for group in record.groups {
            match group.code {
                2 => name = Some(group.text().into_owned()),
                // A negative color: off.
                62 => layer.is_off = group.whole()? < 0,
                70 => layer.is_frozen = group.whole()? & 1 != 0,
                _ => {}
            }
        }
        if let Some(name) = name {
            layers.insert(name, layer);
        }
    }
    Ok(layers)
}

fn blocks<'a>(groups: &'a [Group<'a>]) -> Result<BTreeMap<String, Block<'a>>, Refusal> {
    let mut blocks = BTreeMap::new();
    let mut current: Option<(String, Block)> = None;
    for record in records(groups) {
        if record.head.begins("BLOCK") {
            let (mut name, mut base) = (String::new(), Vec2::zeros());
            for group in record.groups {
                match group.code {
                    2 => name = group.text().to_uppercase(),
                    10 => base.x = group.real()?,
                    20 => base.y = group.real()?,
                    _ => {}
                }
            }
            current = Some((name, Block { base, records: Vec::new() }));
        } else if record.head.begins("ENDBLK") {
            blocks.extend(current.take());
        } else if let Some((_, block)) = &mut current {
            block.records.push(record);
        }
    }
    Ok(blocks)
}

/// The unit of `$INSUNITS`; files of release 12 have none.
fn unit(groups: &[Group]) -> Result<Option<Unit>, Refusal> {
    let at = groups.iter().position(|group| group.code == 9 && group.text() == "$INSUNITS");
    let Some(group) = at.and_then(|at| groups.get(at + 1)) else { return Ok(None) };
    let (name, meters) = match group.whole()? {
        1 => ("in", 0.0254),
        2 => ("ft", 0.3048),
        3 => ("mi", 1609.344),
        4 => ("mm", 1e-3),
        5 => ("cm", 1e-2),
        6 => ("m", 1.0),
        7 => ("km", 1e3),
        8 => ("uin", 0.0254e-6),
        9 => ("mil", 0.0254e-3),
        10 => ("yd", 0.9144),
        11 => ("angstrom", 1e-10),
        12 => ("nm", 1e-9),
        13 => ("um", 1e-6),
        14 => ("dm", 0.1),
        15 => ("dam", 10.0),
        16 => ("hm", 100.0),
        17 => ("Gm", 1e9),
        21 => ("US survey ft", 1200.0 / 3937.0),
        22 => ("US survey in", 100.0 / 3937.0),
        23 => ("US survey yd", 3600.0 / 3937.0),
        24 => ("US survey mi", 5280.0 * 1200.0 / 3937.0),
        _ => return Ok(None),
    };
    Ok(Some(Unit { name: name.to_owned(), meters }))
}
