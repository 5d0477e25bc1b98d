//! The packages, or the files and folders of one of them, as a picture: each lies above all that it uses, an arrow leads to what it uses and nothing else
//! on the way uses for it.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Each module with those that it imports.
pub type Imports = BTreeMap<String, BTreeSet<String>>;

/// Height of a box and of the rows that boxes stand in, gap between boxes of a row, width of a letter and of what is beside a name, in px.
const BOX: f64 = 32.0;
const ROW: f64 = 76.0;
const GAP: f64 = 24.0;
const LETTER: f64 = 8.0;
const RIM: f64 = 16.0;

/// Packages between which the data passes and those around them, by their colors.
const COLORS: [(&str, &[&str]); 4] = [
    ("#cfe3f5", &["geometry", "drawings", "wetting", "case"]),
    ("#f7d9b8", &["sph", "film", "network", "validation"]),
    ("#d5ecd0", &["meniscus"]),
    ("#e8e8e8", &["core", "output"]),
];

/// The modules that `module` leads to, itself left out.
fn reached(imports: &Imports, module: &str) -> BTreeSet<String> {
    let (mut found, mut open) = (BTreeSet::new(), vec![module.to_owned()]);
    while let Some(next) = open.pop() {
        open.extend(imports[&next].iter().filter(|import| found.insert((*import).clone())).cloned());
    }
    found
}

/// The rows of the picture from below: no module of a row imports one of its row or above.
///
/// # Panics
/// Where modules import each other in a circle.
fn rows(imports: &Imports) -> Vec<Vec<String>> {
    let mut left: BTreeSet<&String> = imports.keys().collect();
    let mut rows = Vec::new();
    while !left.is_empty() {
        let is_next = |module: &&&String| imports[**module].iter().all(|import| !left.contains(import));
        let row: Vec<&String> = left.iter().filter(is_next).copied().collect();
        assert!(!row.is_empty(), "these modules are in a circle: {left:?}");
        left.retain(|module| !row.contains(module));
        rows.push(row.into_iter().cloned().collect());
    }
    rows
}

/// The picture as SVG, in the colors of the packages or in one.
pub fn svg(imports: &Imports, is_whole: bool) -> String {
    let mut rows = rows(imports);
    rows.reverse();
    let longest = imports.keys().map(String::len).max().unwrap_or(0) as f64;
    let wide = LETTER * longest + RIM;
    let column = wide + GAP;
    let widest = rows.iter().map(Vec::len).max().unwrap_or(0) as f64;
    let [width, height] = [widest * column, rows.len() as f64 * ROW];
    let is_direct =
        |from: &str, to: &str| !imports[from].iter().any(|by| by != to && reached(imports, by).contains(to));
    let arrows: Vec<(&String, &String)> = imports
        .iter()
        .flat_map(|(from, all)| all.iter().filter(move |to| is_direct(from, to)).map(move |to| (from, to)))
        .collect();
    // Each box stands below the middle of those that lead to it, as far as the order in its row allows.
    let mut place = BTreeMap::<String, [f64; 2]>::new();
    for (number, row) in rows.iter_mut().enumerate() {
        let wanted = |module: &String| {
            let above: Vec<f64> =
                arrows.iter().filter(|arrow| arrow.1 == module).map(|arrow| place[arrow.0][0]).collect();
            if above.is_empty() { width / 2.0 } else { above.iter().sum::<f64>() / above.len() as f64 }
        };
        let mut ordered: Vec<(f64, String)> = row.iter().map(|module| (wanted(module), module.clone())).collect();
        ordered.sort_by(|a, b| a.partial_cmp(b).expect("places are numbers"));
        let first = (width - (row.len() - 1) as f64 * column) / 2.0;
        for (i, (_, module)) in ordered.into_iter().enumerate() {
            place.insert(module, [first + i as f64 * column, (number as f64 + 0.5) * ROW]);
        }
    }
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"14\" text-anchor=\"middle\">\n\
         <defs><marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto\">\
         <path d=\"M0 0 8 4 0 8z\" fill=\"#777\"/></marker></defs>\n"
    );
    // Writing to a string cannot fail.
    for (from, to) in &arrows {
        let ([x0, y0], [x1, y1]) = (place[*from], place[*to]);
        let (begin, end) = (y0 + BOX / 2.0, y1 - BOX / 2.0);
        let bend = (end - begin) / 2.0;
        let _ = writeln!(
            svg,
            "<path d=\"M{x0} {begin}C{x0} {} {x1} {} {x1} {end}\" fill=\"none\" stroke=\"#777\" marker-end=\"url(#tip)\"/>",
            begin + bend,
            end - bend
        );
    }
    for (module, [x, y]) in &place {
        let is_in = |(_, modules): &&(&str, &[&str])| is_whole && modules.contains(&module.as_str());
        let color = COLORS.iter().find(is_in).map_or("#f4f4f4", |it| it.0);
        let _ = writeln!(
            svg,
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"5\" fill=\"{color}\" stroke=\"#555\"/><text x=\"{x}\" y=\"{}\">{module}</text>",
            x - wide / 2.0,
            y - BOX / 2.0,
            wide,
            BOX,
            y + 5.0
        );
    }
    svg + "</svg>\n"
}
