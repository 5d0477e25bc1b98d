//! A pore network as a drawing of its pore space, ball and stick: each pore is a disc of its inscribed diameter, each throat a channel of constant width.
//!
//! `tables` reads the two forms of a network, the table of OpenPNM and a pair of tables, into a `model::Network`; `checks` refuses what has no
//! drawing; `channels` has the outlines of throats, `openings` joins labeled pores to the sides, `overlaps` tells what the drawing joins besides.

mod channels;
mod checks;
mod columns;
mod model;
mod openings;
mod overlaps;
mod table;
mod tables;

use std::path::Path;

use crate::import::drawing::{Drawing, Entity, Refusal};
use crate::import::options::Options;
use channels::Channel;
use meniscus_core::math::Bounds;
use model::Network;
use openings::Openings;

/// Whether a text is the table of a network, by a name of its header.
pub(crate) fn is_one(text: &str) -> bool {
    table::header(text).is_some_and(|names| names.iter().any(|name| columns::is_of_network(name)))
}

/// The options with which the shapes of a network are built: they are exact, and what is drawn is the pore.
pub(crate) fn options(given: &Options) -> Options {
    let invert = Some(!given.is_inverted());
    Options { invert, smooth_below_deg: Some(0.0), recognize_circles: Some(false), ..given.clone() }
}

/// Reads the text of a table; `path` is that of its file, beside which the other table of a pair lies.
pub(crate) fn read(text: &str, path: &Path) -> Result<Drawing, Vec<Refusal>> {
    let network = checks::checked(tables::network(text, path)?)?;
    let mut drawing = Drawing { is_in_meters: true, ..Drawing::default() };
    let throats = channels_of_throats(&network);
    for (index, channel) in &throats {
        drawing.add(channel.outline(), network.throats[*index].location.clone());
    }
    let discs = network.pores.iter().filter(|pore| !pore.is_opening);
    let discs = discs.map(|pore| Bounds { min: pore.center, max: pore.center }.grown(pore.radius));
    let Some(around) = drawing.entities.iter().map(Entity::bounds).chain(discs).reduce(|a, b| a.united(&b)) else {
        return Err(vec![Refusal::new("file", "boundary pores alone", "pores, each with a size")]);
    };
    let openings = Openings::of(&network, around);
    let pores = openings.pores(&network);
    drawing.notes = vec![format!(
        "network: {} pores as discs, {} throats and {} openings as channels",
        pores.len(),
        throats.len(),
        openings.all.len()
    )];
    for (index, outline) in pores {
        drawing.add(outline, network.pores[index].location.clone());
    }
    for opening in openings.apart() {
        drawing.add(opening.channel.outline(), network.pores[opening.labeled].location.clone());
    }
    drawing.frame = Some(openings.domain);
    drawing.notes.extend(openings.notes());
    drawing.notes.extend(overlaps::note(&network, &throats, &openings));
    if network.loops > 0 {
        drawing.count("throats from a pore to itself", network.loops);
    }
    Ok(drawing)
}

/// The channels of throats between two pores, each with the index of its throat.
fn channels_of_throats(network: &Network) -> Vec<(usize, Channel)> {
    let between = |&index: &usize| !network.is_opening(&network.throats[index]);
    let all = (0..network.throats.len()).filter(between);
    all.map(|index| (index, channels::of_throat(network, &network.throats[index]))).collect()
}
