//! The tables of a network: that of OpenPNM with all columns side by side, or `pores.csv` with `throats.csv` beside it.

use std::collections::HashMap;
use std::path::Path;

use crate::import::drawing::Refusal;
use crate::import::network::columns::{Columns, Label, OPENPNM, PAIR, label};
use crate::import::network::model::{Network, Pore, Throat};
use crate::import::network::table::Table;
use crate::import::text::utf8;
use meniscus_core::input::file;
use meniscus_core::math::Vec2;

/// Spread of the coordinates along the axis across the plane, over the size of the network.
const FLAT: f64 = 1e-9;
/// In the names of the two files of a pair.
const NAMES: [&str; 2] = ["pores", "throats"];

/// The network of a text, with every mistake in it.
pub(super) fn network(text: &str, path: &Path) -> Result<Network, Vec<Refusal>> {
    let table = Table::of(text, None).map_err(one)?;
    if table.names().any(|name| name.starts_with(OPENPNM.labels) || name.starts_with("throat.")) {
        return of_tables(&table, &table, &OPENPNM);
    }
    let is_of_throats = table.first_of(&PAIR.ends).is_some() || table.first_of(PAIR.size).is_none();
    let (name, text) = beside(path, usize::from(is_of_throats)).map_err(one)?;
    let other = Table::of(&text, Some(&name)).map_err(one)?;
    let [pores, throats] = if is_of_throats { [&other, &table] } else { [&table, &other] };
    of_tables(pores, throats, &PAIR)
}

fn one(refusal: Refusal) -> Vec<Refusal> {
    vec![refusal]
}

/// The name and the text of the other file of a pair, of which the one at `path` is that of pores (0) or throats (1).
fn beside(path: &Path, which: usize) -> Result<(String, String), Refusal> {
    let own = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let Some(at) = own.rfind(NAMES[which]) else {
        let found = format!("a table of {} by the name of {own}", NAMES[which]);
        return Err(Refusal::new("file", found, "the names pores.csv and throats.csv, or both with the same prefix"));
    };
    let name = format!("{}{}{}", &own[..at], NAMES[1 - which], &own[at + NAMES[which].len()..]);
    let refusal = |found: String| {
        Refusal::new(
            "file",
            found,
            format!("a table of {} in the same folder, by the name of {name}", NAMES[1 - which]),
        )
    };
    let bytes = file::read(&path.with_file_name(&name), file::LARGEST).map_err(|error| {
        let is_absent = error.kind() == std::io::ErrorKind::NotFound;
        refusal(if is_absent { format!("no {name}") } else { format!("{name}, which cannot be read ({error})") })
    })?;
    let text = utf8(&bytes).map_err(|_| refusal(format!("{name}, which is not text in UTF-8")))?;
    Ok((name.clone(), text.to_owned()))
}

fn of_tables(pores: &Table, throats: &Table, columns: &Columns) -> Result<Network, Vec<Refusal>> {
    let mut bad = Vec::new();
    let read = pores_of(pores, columns, &mut bad);
    let (all, plane, numbers) = read.unwrap_or_default();
    let throats = throats_of(throats, columns, plane, &numbers, &mut bad);
    if !bad.is_empty() {
        return Err(bad);
    }
    let numbers = (0..throats.len()).collect();
    Ok(Network { pores: all, throats, numbers, loops: 0 })
}

/// The value, or `None` with its refusal kept.
fn kept<T>(value: Result<T, Refusal>, bad: &mut Vec<Refusal>) -> Option<T> {
    value.map_err(|refusal| bad.push(refusal)).ok()
}

/// Number of rows up to the last one with a cell in these columns: in one table the shorter side ends with empty cells.
fn filled_rows(table: &Table, columns: &[usize]) -> usize {
    let is_filled = |row: &usize| columns.iter().any(|&column| !table.cell(*row, column).is_empty());
    (0..table.rows()).rev().find(is_filled).map_or(0, |last| last + 1)
}

/// Pores, the axes of their plane, and the index of each number of a pore.
type Pores = (Vec<Pore>, [usize; 2], HashMap<usize, usize>);

fn pores_of(table: &Table, columns: &Columns, bad: &mut Vec<Refusal>) -> Option<Pores> {
    let mut required = |names: &[&str], what: &str| kept(table.required(names, what, columns.remedy), bad);
    let x = required(&columns.center[..1], "the coordinates of each pore in m");
    let y = required(&columns.center[1..2], "the coordinates of each pore in m");
    let size = required(columns.size, "the inscribed size of each pore in m");
    let (x, y, size) = (x?, y?, size?);
    let axes: Vec<usize> = [x, y].into_iter().chain(table.first_of(&columns.center[2..])).collect();
    let count = filled_rows(table, &axes);
    let mut centers = Vec::with_capacity(count);
    for row in 0..count {
        let mut center = [0.0; 3];
        for (coordinate, &column) in center.iter_mut().zip(&axes) {
            *coordinate = kept(table.number(row, column, "a coordinate in m"), bad).unwrap_or_default();
        }
        centers.push(center);
    }
    if count == 0 {
        bad.push(Refusal::new(table.line(0), "no pore at all", "a row for each pore"));
    }
    let plane = kept(plane(table, &centers), bad)?;
    let labels: Vec<(usize, Label)> = table
        .names()
        .enumerate()
        .filter_map(|(column, name)| Some((column, label(name.strip_prefix(columns.labels)?, plane)?)))
        .collect();
    let mut pores = Vec::with_capacity(count);
    for (row, center) in centers.iter().enumerate() {
        let center = Vec2::new(center[plane[0]], center[plane[1]]);
        let mut pore = Pore {
            center,
            radius: 0.0,
            at_side: [false; 4],
            at_end: [false; 2],
            is_opening: false,
            location: table.line(row),
        };
        for &(_, label) in labels.iter().filter(|(column, _)| table.is_set(row, *column)) {
            match label {
                Label::Side(side) => pore.at_side[side] = true,
                Label::End(end) => pore.at_end[end] = true,
                Label::Boundary => pore.is_opening = true,
            }
        }
        // A boundary pore has no size of its own.
        let size = if pore.is_opening {
            Ok(table.number(row, size, "").map_or(0.0, |size| size.max(0.0)))
        } else {
            table.positive(row, size, "a size in m, above 0")
        };
        pore.radius = columns.radius_of_size * kept(size, bad).unwrap_or_default();
        pores.push(pore);
    }
    let number = columns.number.and_then(|name| table.first_of(&[name]));
    Some((pores, plane, numbers(table, number, count, bad)))
}

/// The index of each number of a pore.
fn numbers(table: &Table, column: Option<usize>, count: usize, bad: &mut Vec<Refusal>) -> HashMap<usize, usize> {
    let mut found = HashMap::with_capacity(count);
    for row in 0..count {
        let Some(column) = column else {
            found.insert(row, row);
            continue;
        };
        match table.index(row, column) {
            Some(number) if !found.contains_key(&number) => {
                found.insert(number, row);
            }
            _ => bad.push(table.refusal(row, column, "a number for each pore, a whole one from 0 and each once")),
        }
    }
    found
}

/// The two axes along which pores lie.
fn plane(table: &Table, centers: &[[f64; 3]]) -> Result<[usize; 2], Refusal> {
    let spread = |axis: usize| {
        let all = || centers.iter().map(|center| center[axis]);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    let spreads = [0, 1, 2].map(spread);
    let size = spreads.iter().copied().fold(0.0, f64::max);
    let is_flat = |axis: usize| !(spreads[axis] > FLAT * size);
    match [(2, [0, 1]), (1, [0, 2]), (0, [1, 2])].into_iter().find(|&(across, _)| is_flat(across)) {
        Some((_, plane)) => Ok(plane),
        None => {
            let expected = "a plane network, with one coordinate the same for all pores: the solvers are plane; of a network in space take a layer";
            Err(Refusal::new(table.line(0), "pores that lie in no plane x-y, x-z or y-z", expected))
        }
    }
}

fn throats_of(
    table: &Table,
    columns: &Columns,
    plane: [usize; 2],
    numbers: &HashMap<usize, usize>,
    bad: &mut Vec<Refusal>,
) -> Vec<Throat> {
    let mut required = |names: &[&str], what: &str| kept(table.required(names, what, columns.remedy), bad);
    let ends = columns.ends.map(|name| required(&[name], "the pores of each throat by number, from 0"));
    let width = required(columns.width, "the width of each throat in m");
    let ([Some(first), Some(second)], Some(width)) = (ends, width) else { return Vec::new() };
    let middle: Option<Vec<usize>> = plane.iter().map(|&axis| table.first_of(&[columns.middle[axis]])).collect();
    let length = table.first_of(columns.length);
    let most = numbers.keys().max().copied().unwrap_or_default();
    let mut throats = Vec::new();
    for row in 0..filled_rows(table, &[first, second]) {
        let mut pore = |column: usize| {
            let found = table.index(row, column).and_then(|number| numbers.get(&number).copied());
            // Without any pore the mistake is reported elsewhere.
            if found.is_none() && !numbers.is_empty() {
                bad.push(table.refusal(row, column, format!("the number of a pore, a whole one from 0 to {most}")));
            }
            found
        };
        let pores = [pore(first), pore(second)];
        let width = kept(table.positive(row, width, "a width in m, above 0"), bad);
        let is_given = |&column: &usize| !table.cell(row, column).is_empty();
        let middle = middle.as_deref().filter(|columns| columns.iter().all(is_given)).and_then(|columns| {
            let at = |k: usize, bad: &mut Vec<Refusal>| kept(table.number(row, columns[k], "a coordinate in m"), bad);
            Some(Vec2::new(at(0, bad)?, at(1, bad)?))
        });
        let length = length.and_then(|column| table.number(row, column, "").ok());
        if let ([Some(a), Some(b)], Some(width)) = (pores, width) {
            throats.push(Throat { pores: [a, b], width, middle, length, location: table.line(row) });
        }
    }
    throats
}
