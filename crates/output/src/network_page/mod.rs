//! The page on which a displacement in a network is played: one HTML file that opens from the disk without a network.
//!
//! `page.html` is its frame, `page.css` its look. Its scripts come one after the other: `data.js` unpacks the data and knows what each area holds at an event,
//! `shapes.js` has their outlines, `map.js` draws them, `curve.js` the curve, `page.js` moves both. The data are columns: base64 of little-endian numbers.

mod columns;
mod data;

use super::html::escaped;
use meniscus_core::playback::Playback;

/// Its file.
pub const NAME: &str = "network.html";

/// The most pores that it shows.
pub const MOST_PORES: usize = 200_000;

const FRAME: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPTS: [&str; 5] = [
    include_str!("data.js"),
    include_str!("shapes.js"),
    include_str!("map.js"),
    include_str!("curve.js"),
    include_str!("page.js"),
];

/// More pores than a page can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{0} pores are more than the {MOST_PORES} that a page shows")]
pub struct TooMany(pub usize);

/// The page of displacements in networks, each with its name, side by side.
///
/// # Errors
/// [`TooMany`] pores.
pub fn page(title: &str, runs: &[(&str, &Playback)]) -> Result<String, TooMany> {
    let pores = runs.iter().map(|(_, playback)| playback.pores.columns.first().map_or(0, |it| it.cells.len()));
    let most = pores.max().unwrap_or(0);
    if most > MOST_PORES {
        return Err(TooMany(most));
    }
    let data = data::json(title, runs);
    let slot = |name: &str| match name {
        "title" => escaped(title),
        "style" => STYLE.to_owned(),
        "scripts" => SCRIPTS.concat(),
        // The data must not end their element.
        "data" => data.replace('<', "\\u003c"),
        _ => String::new(),
    };
    Ok(filled(FRAME, slot))
}

/// A text with each `{{name}}` replaced.
fn filled(frame: &str, slot: impl Fn(&str) -> String) -> String {
    let mut parts = frame.split("{{");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (name, rest) = part.split_once("}}").unwrap_or((part, ""));
        text += &slot(name);
        text += rest;
    }
    text
}

#[cfg(test)]
mod tests;
