//! That each mistake of a refused input names its file and a place in it.

use std::path::Path;

use meniscus_core::input::{InputError, Mistake};

/// Places in a shape file that have no number.
const WITHOUT_NUMBER: [&str; 11] = [
    // Nothing in the file is a shape, or its JSON is no GeoJSON.
    "file",
    // One line beside a shapefile.
    "file .prj",
    // A GeoJSON file of one geometry, and members of the file beside its features.
    "geometry",
    "member `unit`",
    "member `domain`",
    // Pixels are compressed: their decoders tell no byte.
    "the image",
    // All shapes together leave no pore; the domain of a file or around its shapes.
    "shapes",
    "min",
    "max",
    // All style sheets of an SVG file are one.
    "style sheet",
    // A DXF file that is cut off.
    "end of the file",
];

/// What is wrong with the options that a drawing is read with, and not in the file.
const OF_OPTIONS: [&str; 4] = [
    "the unit of the drawing is not known",
    "there is no unit `",
    "`unit` does not apply to",
    "no shape reaches into the domain",
];

/// A mistake that does not name a file of `folder` and a place in it, if there is one, or none at all.
pub fn without_place(error: &InputError, folder: &Path) -> Option<String> {
    if error.mistakes.is_empty() {
        return Some("refused without a mistake".to_owned());
    }
    let bad = error.mistakes.iter().enumerate().find(|(number, mistake)| {
        // The last one may stand for all that are not told.
        let is_remainder = *number > 0 && mistake.message.ends_with("more mistakes");
        !names_a_file(mistake, folder) || !(is_remainder || has_place(mistake))
    });
    bad.map(|(_, mistake)| format!("refused without file and place: {}: {}", mistake.name, mistake.message))
}

/// Whether it names a file of the folder, or a value of the command line.
fn names_a_file(mistake: &Mistake, folder: &Path) -> bool {
    mistake.name.starts_with("--set ") || Path::new(&mistake.name).starts_with(folder)
}

/// Whether it has a line and a column, or tells its place in words: a line, byte, record, feature, pixel or entity.
fn has_place(mistake: &Mistake) -> bool {
    if mistake.location.is_some() {
        return true;
    }
    let message = mistake.message.as_str();
    // A question about an outline names it behind these words.
    let of_question = message.strip_prefix("the drawing can be read in two ways: ");
    if let Some(rest) = message.strip_prefix(&format!("{}, ", mistake.name)).or(of_question) {
        // `line 12, disc: the shape lies...`
        let place = rest.split([',', ':']).next().unwrap_or_default();
        // `LWPOLYLINE 2F`, whose handle may be without digits.
        let kind = place.split(' ').next().unwrap_or_default();
        let is_entity = !kind.is_empty() && kind.bytes().all(|byte| byte.is_ascii_uppercase() || byte == b'_');
        return is_entity || place.bytes().any(|byte| byte.is_ascii_digit()) || WITHOUT_NUMBER.contains(&place);
    }
    message.contains(" is not text in UTF-8 from line ") || OF_OPTIONS.iter().any(|start| message.starts_with(start))
}
