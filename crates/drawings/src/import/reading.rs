//! What a drawing is, where its fills, layers and nesting leave two readings: the options choose, or the user is asked, with both readings.

use std::collections::BTreeMap;

use crate::import::build::{Imported, Refused, Sheet, completed, prepared};
use crate::import::drawing::{Drawing, Entity, Nesting, Paint, Refusal, Ring};
use crate::import::format::Format;
use crate::import::frame::{self, Ambiguous, Framed};
use crate::import::nest::containing;
use crate::import::notes::Notes;
use crate::import::options::{Frame, Nested, Options};
use meniscus_core::input::problem::Problem;
use meniscus_core::math::{Bounds, Vec2};
use meniscus_geometry::solid::Geometry;

/// The shapes of a drawing in m.
pub(crate) fn build(drawing: Drawing, format: Format, options: &Options) -> Result<Imported, Refused> {
    let (outlines, sheet, notes, refusals) = prepared(drawing, format, options)?;
    decided(outlines, &sheet, options, notes, refusals)
}

/// Whether all layers have names that KLayout gives those of GDS: `L1D0`, layer and datatype.
fn is_of_gds(layers: &BTreeMap<String, usize>) -> bool {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let is_one = |name: &String| {
        let numbers = name.strip_prefix('L').and_then(|rest| rest.split_once('D'));
        numbers.is_some_and(|(layer, datatype)| is_number(layer) && is_number(datatype))
    };
    !layers.is_empty() && layers.keys().all(is_one)
}

/// The shapes of the outlines as the drawing says, or the options where it leaves that open.
fn decided(
    mut outlines: Vec<Entity>,
    sheet: &Sheet,
    options: &Options,
    mut notes: Notes,
    refusals: Vec<Refusal>,
) -> Result<Imported, Refused> {
    let ask = |what: &str, key: &str, choices: [Choice<'_>; 2], (all, notes): (&[Entity], &Notes)| {
        Err(Refused::Keys(vec![question(what, key, choices, all, sheet, notes)]))
    };
    let overlaid = outlines.iter().filter(|one| one.paint == Paint::Overlaid).count();
    if overlaid > 0 || (sheet.nesting == Nesting::OfAll && is_of_gds(&sheet.layers) && has_nested(&outlines)) {
        let Some(nested) = options.nested else {
            let with = |nested| Options { nested: Some(nested), ..options.clone() };
            let what = match overlaid {
                0 => "outlines lie in others, on layers named as those of GDS".to_owned(),
                number => format!("shapes ({number}) are painted on larger ones of another color"),
            };
            let choices = [
                ("pore", with(Nested::Pore), "they are channels or holes"),
                ("solid", with(Nested::Solid), "they are solid, united with the larger ones"),
            ];
            return ask(&what, "nested", choices, (&outlines, &notes));
        };
        let paint = if nested == Nested::Pore { Paint::White } else { Paint::Filled };
        outlines.iter_mut().filter(|one| one.paint == Paint::Overlaid).for_each(|one| one.paint = paint.clone());
    }
    if sheet.nesting == Nesting::OfAll && options.nested == Some(Nested::Solid) {
        return completed(outlines, (Framed::default(), Nesting::Alternate), sheet, options, notes, refusals);
    }
    match frame::taken_out(&mut outlines, options, &mut notes) {
        Ok(framed) => {
            let nesting = if framed.is_plate { Nesting::OfAll } else { sheet.nesting };
            completed(outlines, (framed, nesting), sheet, options, notes, refusals)
        }
        Err(Ambiguous(what)) => {
            let with = |frame| Options { frame: Some(frame), ..options.clone() };
            let choices = [
                (
                    "pore",
                    with(Frame::Pore),
                    "it is the frame of the chip or the wall of the pore, and the others are grains",
                ),
                ("solid", with(Frame::Solid), "it is the rim of a plate, and the others are holes"),
            ];
            ask(&what, "frame", choices, (&outlines, &notes))
        }
    }
}

/// Whether an outline lies in another one.
fn has_nested(outlines: &[Entity]) -> bool {
    let rings: Vec<Ring> = outlines.iter().map(|one| frame::first_ring(&one.outline)).collect();
    containing(&rings).iter().any(|around| !around.is_empty())
}

/// A value of a key, the options with it, and the reading that it means.
type Choice<'a> = (&'a str, Options, &'a str);

/// The question which of two readings is meant, with both.
fn question(what: &str, key: &str, choices: [Choice<'_>; 2], all: &[Entity], sheet: &Sheet, notes: &Notes) -> Problem {
    let mut message = format!("the drawing can be read in two ways: {what}");
    let values = [choices[0].0, choices[1].0];
    for (value, options, text) in choices {
        message += &format!("\n\n{key} = \"{value}\": {text}");
        match decided(all.to_vec(), sheet, &options, notes.clone(), Vec::new()) {
            Ok(Imported { spec, .. }) => {
                let geometry = Geometry::unchecked(&spec);
                let (porosity, solids) = (geometry.porosity().value, spec.shapes.len());
                message += &format!("; porosity {porosity:.4}, {solids} solids\n{}", sketch(&geometry));
            }
            Err(Refused::Keys(_)) => message += "; another question follows",
            Err(_) => message += "; it cannot be read so",
        }
    }
    let [one, other] = values.map(|value| format!("`{key} = \"{value}\"` (--{key} {value})"));
    Problem::new(key, message, format!("add {one}, or {other}"))
}

/// A geometry in characters, solid as `#`.
fn sketch(geometry: &Geometry) -> String {
    /// Columns; a character is twice as high as wide.
    const COLUMNS: usize = 48;
    const MOST_ROWS: usize = 24;
    let Bounds { min, max } = geometry.bounds();
    let size = max - min;
    let rows = ((0.5 * COLUMNS as f64 * size.y / size.x).round() as usize).clamp(1, MOST_ROWS);
    let at = |i: usize, count: usize| (i as f64 + 0.5) / count as f64;
    let row = |j: usize| -> String {
        let mark = |i: usize| {
            let x = min + size.component_mul(&Vec2::new(at(i, COLUMNS), at(rows - 1 - j, rows)));
            if geometry.is_solid(x) { '#' } else { '.' }
        };
        (0..COLUMNS).map(mark).collect()
    };
    (0..rows).map(row).collect::<Vec<_>>().join("\n")
}
