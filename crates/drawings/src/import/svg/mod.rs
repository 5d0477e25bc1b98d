//! SVG drawings: basic shapes and paths with their nested transforms, as filled areas in the unit of the page, y up.
//!
//! Source: Scalable Vector Graphics 1.1, 2nd ed., W3C 2011, chapters 5 to 11 and appendix F.6. The lower left corner of the page becomes the origin. Circles
//! stay exact under all maps that preserve circles. Ignored: text, images, filters, clips and masks (mentioned in notes) and the width of strokes. White
//! shapes are pore if others are not white.

mod lines;
mod page;
mod path;
mod placement;
mod shape;
mod style;
mod walk;

use roxmltree::{Document, ParsingOptions};

use self::lines::Lines;
use super::drawing::{Drawing, Refusal};

/// Maximum size of expanded entities over the size of the file.
const LARGEST_ENTITIES: usize = 10;

/// Reads a drawing. With `layers`, only groups of these names, and groups inside them.
pub(crate) fn read(text: &str, layers: Option<&[String]>) -> Result<Drawing, Vec<Refusal>> {
    check_entities(text).map_err(|refusal| vec![refusal])?;
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let location = format!("line {}", error.pos().row);
        vec![Refusal::new(location, error.to_string(), "an SVG document (well-formed XML)")]
    })?;
    let lines = Lines::of(text);
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let found = format!("the element `{}`", root.tag_name().name());
        return Err(vec![Refusal::new(lines.location(root), found, "`svg` as the outermost element")]);
    }
    walk::drawing(&document, &lines, text.len(), layers)
}

/// Refuses files whose entities expand to far more text than the file has.
fn check_entities(text: &str) -> Result<(), Refusal> {
    if !text.contains("<!ENTITY") {
        return Ok(());
    }
    let Some((declared, rest)) = text.split_once("<!DOCTYPE").and_then(|(_, rest)| rest.split_once("]>")) else {
        return Ok(());
    };
    let refusal = |found: &str| Refusal::new("DOCTYPE", found, "entities written out: save the drawing as plain SVG");
    // Nested entities are not needed by any drawing program, and grow exponentially with their depth.
    let is_nested = declared.split("<!ENTITY").skip(1).any(|entity| entity.contains('&') && !entity.contains("&#"));
    if is_nested {
        return Err(refusal("nested entities"));
    }
    let longest = declared.split("<!ENTITY").map(str::len).max().unwrap_or(0);
    let references = rest.matches('&').count();
    if references.saturating_mul(longest) > LARGEST_ENTITIES * text.len() {
        return Err(refusal("entities that expand to more than ten times the text of the file"));
    }
    Ok(())
}

#[cfg(test)]
mod tests;
