//! DXF of AutoCAD 2000 in mm (`$INSUNITS` 4): discs as CIRCLE, all others as closed LWPOLYLINE with bulges, holes as separate rings. A rectangle on the layer
//! `domain` is the domain. Overlapping shapes are united: nested outlines are holes when read.

use super::sheet::{Sheet, rings_of};
use crate::import::combine::Solid;
use crate::import::drawing::{FillRule, Outline, Ring};
use crate::import::frame::DOMAIN;
use crate::import::nest::regions;
use meniscus_core::math::Bounds;
use meniscus_geometry::tree::Tree;

/// Lengths below this fraction of the domain count as zero at intersections.
const TOLERANCE: f64 = 1e-9;
/// Millimeters per meter.
const MM: f64 = 1e3;

/// Tables without which AutoCAD refuses a file: all names that entities refer to, and the blocks of model and paper space.
const TABLES: &str = "\
    0 SECTION; 2 TABLES; \
    0 TABLE; 2 VPORT; 5 1; 330 0; 100 AcDbSymbolTable; 70 0; 0 ENDTAB; \
    0 TABLE; 2 LTYPE; 5 2; 330 0; 100 AcDbSymbolTable; 70 3; \
    0 LTYPE; 5 10; 330 2; 100 AcDbSymbolTableRecord; 100 AcDbLinetypeTableRecord; 2 ByBlock; 70 0; 3 ; 72 65; 73 0; 40 0; \
    0 LTYPE; 5 11; 330 2; 100 AcDbSymbolTableRecord; 100 AcDbLinetypeTableRecord; 2 ByLayer; 70 0; 3 ; 72 65; 73 0; 40 0; \
    0 LTYPE; 5 12; 330 2; 100 AcDbSymbolTableRecord; 100 AcDbLinetypeTableRecord; 2 Continuous; 70 0; 3 ; 72 65; 73 0; 40 0; \
    0 ENDTAB; \
    0 TABLE; 2 LAYER; 5 3; 330 0; 100 AcDbSymbolTable; 70 2; \
    0 LAYER; 5 13; 330 3; 100 AcDbSymbolTableRecord; 100 AcDbLayerTableRecord; 2 0; 70 0; 62 7; 6 Continuous; \
    0 LAYER; 5 14; 330 3; 100 AcDbSymbolTableRecord; 100 AcDbLayerTableRecord; 2 domain; 70 0; 62 7; 6 Continuous; \
    0 ENDTAB; \
    0 TABLE; 2 STYLE; 5 4; 330 0; 100 AcDbSymbolTable; 70 1; \
    0 STYLE; 5 15; 330 4; 100 AcDbSymbolTableRecord; 100 AcDbTextStyleTableRecord; 2 Standard; 70 0; 40 0; 41 1; 50 0; 71 0; 42 1; 3 txt; 4 ; \
    0 ENDTAB; \
    0 TABLE; 2 VIEW; 5 5; 330 0; 100 AcDbSymbolTable; 70 0; 0 ENDTAB; \
    0 TABLE; 2 UCS; 5 6; 330 0; 100 AcDbSymbolTable; 70 0; 0 ENDTAB; \
    0 TABLE; 2 APPID; 5 7; 330 0; 100 AcDbSymbolTable; 70 1; \
    0 APPID; 5 16; 330 7; 100 AcDbSymbolTableRecord; 100 AcDbRegAppTableRecord; 2 ACAD; 70 0; 0 ENDTAB; \
    0 TABLE; 2 DIMSTYLE; 5 8; 330 0; 100 AcDbSymbolTable; 70 1; 100 AcDbDimStyleTable; \
    0 DIMSTYLE; 105 17; 330 8; 100 AcDbSymbolTableRecord; 100 AcDbDimStyleTableRecord; 2 Standard; 70 0; 0 ENDTAB; \
    0 TABLE; 2 BLOCK_RECORD; 5 9; 330 0; 100 AcDbSymbolTable; 70 2; \
    0 BLOCK_RECORD; 5 18; 330 9; 100 AcDbSymbolTableRecord; 100 AcDbBlockTableRecord; 2 *Model_Space; \
    0 BLOCK_RECORD; 5 19; 330 9; 100 AcDbSymbolTableRecord; 100 AcDbBlockTableRecord; 2 *Paper_Space; 0 ENDTAB; 0 ENDSEC; \
    0 SECTION; 2 BLOCKS; \
    0 BLOCK; 5 1A; 330 18; 100 AcDbEntity; 8 0; 100 AcDbBlockBegin; 2 *Model_Space; 70 0; 10 0; 20 0; 30 0; 3 *Model_Space; 1 ; \
    0 ENDBLK; 5 1B; 330 18; 100 AcDbEntity; 8 0; 100 AcDbBlockEnd; \
    0 BLOCK; 5 1C; 330 19; 100 AcDbEntity; 8 0; 100 AcDbBlockBegin; 2 *Paper_Space; 70 0; 10 0; 20 0; 30 0; 3 *Paper_Space; 1 ; \
    0 ENDBLK; 5 1D; 330 19; 100 AcDbEntity; 8 0; 100 AcDbBlockEnd; 0 ENDSEC; \
    0 SECTION; 2 ENTITIES";
/// After the entities: the dictionary of named objects.
const OBJECTS: &str = "0 ENDSEC; 0 SECTION; 2 OBJECTS; \
    0 DICTIONARY; 5 1E; 330 0; 100 AcDbDictionary; 281 1; 3 ACAD_GROUP; 350 1F; \
    0 DICTIONARY; 5 1F; 330 1E; 100 AcDbDictionary; 281 1; 0 ENDSEC; 0 EOF";
/// Handle of the first entity; those of tables and blocks are below.
const FIRST_HANDLE: usize = 0x20;

pub(super) fn dxf(sheet: &Sheet) -> String {
    let (min, max) = (sheet.frame.min, sheet.frame.max);
    let sides = [[min.x, min.y], [max.x, min.y], [max.x, max.y], [min.x, max.y]];
    let rectangle = Ring { vertices: sides.map(|[x, y]| [x, y, 0.0]).to_vec() };
    let mut entities = vec![polyline(&rectangle, DOMAIN)];
    for outline in &apart(sheet) {
        match outline {
            Outline::Disc { center, radius } => entities.push(format!(
                "CIRCLE; 8 0; 100 AcDbCircle; 10 {}; 20 {}; 30 0; 40 {}",
                center.x * MM,
                center.y * MM,
                radius * MM
            )),
            Outline::Area { rings, .. } => entities.extend(rings.iter().map(|ring| polyline(ring, "0"))),
        }
    }
    let mut text = groups(&format!(
        "0 SECTION; 2 HEADER; 9 $ACADVER; 1 AC1015; 9 $HANDSEED; 5 {:X}; 9 $INSUNITS; 70 4; \
         9 $EXTMIN; 10 {}; 20 {}; 30 0; 9 $EXTMAX; 10 {}; 20 {}; 30 0; 0 ENDSEC",
        FIRST_HANDLE + entities.len(),
        min.x * MM,
        min.y * MM,
        max.x * MM,
        max.y * MM
    ));
    text += &groups(TABLES);
    for (handle, entity) in (FIRST_HANDLE..).zip(&entities) {
        // Kind, handle and owner come first.
        let (kind, rest) = entity.split_once("; ").unwrap_or((entity, ""));
        text += &groups(&format!("0 {kind}; 5 {handle:X}; 330 18; 100 AcDbEntity; {rest}"));
    }
    text + &groups(OBJECTS)
}

/// Groups in short notation, `0 LINE; 8 walls`, as lines of codes and values.
fn groups(short: &str) -> String {
    let group = |group: &str| group.split_once(' ').map(|(code, value)| format!("{code:>3}\r\n{value}\r\n"));
    short.split("; ").filter_map(group).collect()
}

/// The outlines; those with overlapping boxes are united.
fn apart(sheet: &Sheet) -> Vec<Outline> {
    let tolerance = TOLERANCE * sheet.frame.size().max();
    let solids: Vec<Vec<Solid>> = sheet
        .outlines
        .iter()
        .map(|outline| regions(&rings_of(outline), FillRule::EvenOdd).iter().filter_map(Solid::of).collect())
        .collect();
    let bounds = |all: &Vec<Solid>| all.iter().map(Solid::bounds).reduce(|a, b| a.united(&b));
    let boxes: Vec<Option<Bounds>> = solids.iter().map(bounds).collect();
    let tree = Tree::over(boxes.iter().flatten().copied());
    let alone = |k: usize| boxes[k].is_none_or(|own| tree.near(own).count() < 2);
    let (alone, together): (Vec<usize>, Vec<usize>) = (0..solids.len()).partition(|&k| alone(k));
    let mut found: Vec<Outline> = alone.iter().map(|&k| sheet.outlines[k].clone()).collect();
    let mut parts = Vec::new();
    for (k, own) in solids.into_iter().enumerate() {
        if together.binary_search(&k).is_ok() {
            parts.extend(own);
        }
    }
    match Solid::united(&parts, tolerance) {
        Some(united) => found.extend(united.into_iter().map(|(outer, holes)| {
            let rings = std::iter::once(outer).chain(holes).collect();
            Outline::Area { rings, rule: FillRule::EvenOdd }
        })),
        None => found.extend(together.iter().map(|&k| sheet.outlines[k].clone())),
    }
    found
}

/// A closed polyline in short notation.
fn polyline(ring: &Ring, layer: &str) -> String {
    let count = ring.vertices.len();
    let vertex = |&[x, y, bulge]: &[f64; 3]| format!("; 10 {}; 20 {}; 42 {bulge}", x * MM, y * MM);
    let vertices: String = ring.vertices.iter().map(vertex).collect();
    format!("LWPOLYLINE; 8 {layer}; 100 AcDbPolyline; 90 {count}; 70 1{vertices}")
}
