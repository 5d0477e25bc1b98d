//! The header of a list of discs: the columns of x, y and the size, and their unit, by the names of the columns.
//!
//! A name is that of a quantity with an optional unit: `x`, `x_um`, `x [um]`, `x (um)`, `x/um`. A header may also be a comment, such as `# x y r in mm`.

use crate::import::drawing::Unit;
use crate::import::options::Options;
use crate::import::units;

/// Names of the three quantities; the size is a radius or a diameter.
const NAMES: [&[&str]; 4] = [
    &["x", "cx", "xc", "x_c", "x0", "x_center", "x_centre", "xcenter", "center_x", "centre_x", "pos_x", "position_x"],
    &["y", "cy", "yc", "y_c", "y0", "y_center", "y_centre", "ycenter", "center_y", "centre_y", "pos_y", "position_y"],
    &["r", "rad", "radius", "radii"],
    &["d", "diam", "dia", "diameter", "diameters"],
];
/// Names of units besides those of keys.
const UNITS: [(&str, &str); 8] = [
    ("micron", "um"),
    ("microns", "um"),
    ("micrometer", "um"),
    ("micrometre", "um"),
    ("millimeter", "mm"),
    ("millimetre", "mm"),
    ("meter", "m"),
    ("metre", "m"),
];
const DIAMETER: usize = 3;

/// The content of a header.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Header {
    /// The columns of x, y and the size, from 0.
    pub(crate) columns: [usize; 3],
    /// The common unit of all three, if any.
    pub(crate) unit: Option<Unit>,
    /// Whether the size is named as a diameter.
    pub(crate) is_diameter: bool,
    /// Number of names.
    pub(crate) names: usize,
}

/// A column name: the index of its quantity in `NAMES`, and the text of its unit.
struct Column<'t> {
    quantity: Option<usize>,
    unit: Option<&'t str>,
}

impl Header {
    /// The header of these cells.
    ///
    /// # Errors
    /// What was expected instead.
    pub(crate) fn of(cells: &[&str], options: &Options) -> Result<Self, String> {
        let all: Vec<Column> = cells.iter().map(|cell| Column::of(cell)).collect();
        let columns = match options.columns {
            Some(columns) => columns,
            None => by_name(&all)?,
        };
        let picked: Vec<&Column> = columns.iter().filter_map(|&column| all.get(column)).collect();
        let is_diameter = picked.last().is_some_and(|column| column.quantity == Some(DIAMETER));
        let is_given = options.unit.is_some() || options.scale.is_some();
        let names: Vec<Option<&str>> = picked.iter().map(|column| column.unit).collect();
        let unit = match unit_of(&names) {
            Err(_) if is_given => None,
            unit => unit?,
        };
        Ok(Self { columns, unit, is_diameter, names: cells.len() })
    }

    /// The header given by a comment that starts with the names of x, y and a size in any order; a unit may follow.
    pub(crate) fn of_comment(comment: &str, options: &Options) -> Option<Result<Self, String>> {
        let text = comment.trim_start_matches('#').trim();
        let cells = cells(text, options.separator);
        let named = cells.iter().take_while(|cell| Column::of(cell).quantity.is_some()).count();
        by_name(&cells[..named].iter().map(|cell| Column::of(cell)).collect::<Vec<_>>()).ok()?;
        let mut header = match Self::of(&cells[..named], options) {
            Ok(header) => header,
            refused => return Some(refused),
        };
        let mut rest =
            cells[named..].iter().flat_map(|cell| cell.split(|c: char| c.is_whitespace() || "()[],;".contains(c)));
        if header.unit.is_none() && rest.any(|word| matches!(word, "in" | "unit" | "units" | "unit:" | "units:")) {
            header.unit = rest.find(|word| !word.is_empty()).and_then(unit_by_name);
        }
        Some(Ok(header))
    }
}

/// The cells of a header, separated by the given character, else by commas, semicolons and tabs, else by spaces.
pub(crate) fn cells(text: &str, separator: Option<char>) -> Vec<&str> {
    let is_mark = |c: char| separator.map_or(matches!(c, ',' | ';' | '\t'), |separator| c == separator);
    if text.contains(is_mark) {
        return text.trim_end_matches(is_mark).split(is_mark).map(str::trim).collect();
    }
    // A unit in brackets belongs to the name before it.
    let mut found: Vec<&str> = Vec::new();
    let mut from = 0;
    // Of consecutive spaces the first one decides.
    let gaps = text.match_indices(char::is_whitespace).filter(|(at, _)| !text[..*at].ends_with(char::is_whitespace));
    for (at, _) in gaps.chain([(text.len(), "")]) {
        let rest = text[at..].trim_start();
        if !rest.starts_with(['(', '[']) || text[from..at].trim().is_empty() {
            found.extend(Some(text[from..at].trim()).filter(|cell| !cell.is_empty()));
            from = at;
        }
    }
    found
}

impl<'t> Column<'t> {
    fn of(cell: &'t str) -> Self {
        let cell = cell.trim().trim_matches(['"', '\'']).trim();
        let quantity = |name: &str| {
            let name = name.trim().to_lowercase().replace(['-', ' ', '.'], "_");
            NAMES.iter().position(|names| names.contains(&name.as_str()))
        };
        if let Some(found) = quantity(cell) {
            return Self { quantity: Some(found), unit: None };
        }
        let split = cell.find(['(', '[']).or_else(|| cell.rfind(['_', '/', ' ', '-', '.']));
        let Some((name, rest)) = split.and_then(|at| cell.split_at_checked(at)) else {
            return Self { quantity: None, unit: None };
        };
        let unit = rest.trim_matches(|c: char| "()[]_/-. ".contains(c));
        Self { quantity: quantity(name), unit: Some(unit) }
    }
}

fn by_name(columns: &[Column]) -> Result<[usize; 3], String> {
    let find = |wanted: &[usize]| {
        let mut found = (0..columns.len()).filter(|&i| columns[i].quantity.is_some_and(|q| wanted.contains(&q)));
        found.next().filter(|_| found.next().is_none())
    };
    let all = find(&[0]).zip(find(&[1])).zip(find(&[2, DIAMETER]));
    all.map(|((x, y), size)| [x, y, size]).ok_or_else(|| {
        "columns named x, y and r, each once and with its unit or none, such as `x_um, y_um, r_um`; of other names \
         `columns` picks three, such as 0,1,2"
            .to_owned()
    })
}

fn unit_by_name(name: &str) -> Option<Unit> {
    let name = UNITS.iter().find(|known| known.0 == name).map_or(name, |known| known.1);
    // A pixel of an image differs from that of a page.
    units::by_name(name).filter(|_| name != "px")
}

/// The one unit of three columns.
fn unit_of(names: &[Option<&str>]) -> Result<Option<Unit>, String> {
    if names.iter().all(Option::is_none) {
        return Ok(None);
    }
    let found: Vec<Option<Unit>> = names.iter().map(|name| name.and_then(unit_by_name)).collect();
    match &found[..] {
        [Some(first), rest @ ..] if rest.iter().all(|unit| unit.as_ref() == Some(first)) => Ok(Some(first.clone())),
        _ => Err(format!("one unit of length behind all three names, or the key `unit`: {}", units::known_units())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(text: &str) -> Result<Header, String> {
        Header::of(&cells(text, None), &Options::default())
    }

    #[test]
    fn columns_and_units_are_told_by_name_in_any_order_and_spelling() {
        for (text, columns, meters) in [
            ("x,y,r", [0, 1, 2], None),
            ("r,x,y", [1, 2, 0], None),
            ("id;Radius;X;name;Y", [2, 4, 1], None),
            ("x_um,y_um,r_um", [0, 1, 2], Some(1e-6)),
            ("y [mm]\tx [mm]\tradius [mm]", [1, 0, 2], Some(1e-3)),
            ("x (µm) y (µm) r (µm)", [0, 1, 2], Some(1e-6)),
            ("\"center-x/nm\", \"center-y/nm\", \"radius/nm\"", [0, 1, 2], Some(1e-9)),
        ] {
            let found = header(text).unwrap_or_else(|expected| panic!("{text}: {expected}"));
            assert_eq!((found.columns, found.unit.map(|unit| unit.meters)), (columns, meters), "{text}");
        }
    }

    #[test]
    fn names_that_do_not_say_which_is_which_are_refused() {
        for text in
            ["a,b,c", "x,y,z", "x,x,r", "x,y,r,d", "x_um,y_um,r_mm", "x_um,y_um,r", "x_px,y_px,r_px", "row,col,r"]
        {
            assert!(header(text).is_err(), "{text}");
        }
        let given = Options { scale: Some(2.0), ..Options::default() };
        assert_eq!(Header::of(&["x_px", "y_px", "r_px"], &given).unwrap().unit, None);
    }

    #[test]
    fn a_comment_may_be_the_header() {
        let of = |text: &str| Header::of_comment(text, &Options::default());
        assert_eq!(of("# r x y in mm").unwrap().unwrap().columns, [1, 2, 0]);
        assert_eq!(of("# x y r in mm").unwrap().unwrap().unit.unwrap().meters, 1e-3);
        assert_eq!(of("# x_um, y_um, r_um").unwrap().unwrap().unit.unwrap().meters, 1e-6);
        assert!(of("# x y r in mm and nm").unwrap().is_ok() && of("# x_um y_mm r_um").unwrap().is_err());
        assert!(of("# a pack of 60 discs").is_none() && of("# x and y of the box").is_none());
    }
}
