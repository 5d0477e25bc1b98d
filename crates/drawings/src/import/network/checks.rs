//! What a network needs to have a drawing: throats between pores that are there, once each and no wider than these.

use std::collections::HashMap;

use crate::import::drawing::Refusal;
use crate::import::network::model::{Network, Throat};

/// Rounding of a width over that of its pore.
const SAME: f64 = 1e-9;
/// How much wider than its widest throat a pore is drawn at least, over the width: as wide ones, their outlines would touch in a tangent.
const WIDER: f64 = 1e-3;
/// Distance of two middles of throats over their width, above which they are two places.
const APART: f64 = 1e-6;
/// A throat that is shorter than this part of the distance of its pores leads to an image of one of them.
const WRAPPED: f64 = 0.9;

/// The network without throats from a pore to itself, its boundary pores known, and no pore only as wide as a throat.
///
/// # Errors
/// All throats and pores that cannot be drawn.
pub(super) fn checked(mut network: Network) -> Result<Network, Vec<Refusal>> {
    let all = std::mem::take(&mut network.throats);
    let (kept, loops): (Vec<_>, Vec<_>) = all.into_iter().enumerate().partition(|(_, it)| it.pores[0] != it.pores[1]);
    (network.numbers, network.throats) = kept.into_iter().unzip();
    network.loops = loops.len();
    let mut bad = boundary_pores(&mut network);
    let wrong = |throat: &Throat| wide(&network, throat).or_else(|| wrapped(&network, throat));
    bad.extend(network.throats.iter().filter_map(wrong));
    bad.extend(doubled(&network));
    if !bad.is_empty() {
        return Err(bad);
    }
    for index in 0..network.throats.len() {
        let throat = &network.throats[index];
        if !network.is_opening(throat) {
            let least = 0.5 * throat.width * (1.0 + WIDER);
            for pore in throat.pores {
                network.pores[pore].radius = network.pores[pore].radius.max(least);
            }
        }
    }
    Ok(network)
}

/// Marks the boundary pores that are openings, with one throat to a pore within; others are pores like all others.
fn boundary_pores(network: &mut Network) -> Vec<Refusal> {
    let mut behind = vec![Vec::new(); network.pores.len()];
    for throat in &network.throats {
        let [a, b] = throat.pores;
        behind[a].push(b);
        behind[b].push(a);
    }
    let labeled: Vec<bool> = network.pores.iter().map(|pore| pore.is_opening).collect();
    let mut bad = Vec::new();
    for (pore, behind) in network.pores.iter_mut().zip(&behind) {
        pore.is_opening &= matches!(behind[..], [one] if !labeled[one]);
        if !pore.is_opening && !(pore.radius > 0.0) {
            let found = format!("a boundary pore without size, with {} throats", behind.len());
            let expected = "a size above 0, or one throat to a pore within: then it is the opening of that pore";
            bad.push(Refusal::new(pore.location.clone(), found, expected));
        }
    }
    bad
}

fn wide(network: &Network, throat: &Throat) -> Option<Refusal> {
    if network.is_opening(throat) {
        return None;
    }
    let diameter = |pore: usize| 2.0 * network.pores[pore].radius;
    let pore = throat.pores.into_iter().find(|&pore| throat.width > diameter(pore) * (1.0 + SAME))?;
    let found = format!(
        "a throat of the width {:e} m at a pore of the diameter {:e} m ({})",
        throat.width,
        diameter(pore),
        network.pores[pore].location
    );
    let expected = "throats no wider than their pores: it would be a pore; narrow it, or enlarge the pore";
    Some(Refusal::new(throat.location.clone(), found, expected))
}

/// Throats across a periodic side, and those between pores at one place.
fn wrapped(network: &Network, throat: &Throat) -> Option<Refusal> {
    let [a, b] = network.ends(throat);
    let distance = (b - a).norm();
    let [one, other] = throat.pores.map(|pore| &network.pores[pore].location);
    if !(distance > 0.0) {
        let found = format!("a throat between pores at one place ({one} and {other})");
        return Some(Refusal::new(throat.location.clone(), found, "pores at different places, or one pore"));
    }
    let length = throat.length.filter(|&length| length < WRAPPED * distance)?;
    let found = format!("a throat of the length {length:e} m between pores at the distance {distance:e} m");
    let expected = "a network without periodic sides, where the drawing ends: leave out throats across them, or draw its period several times";
    Some(Refusal::new(throat.location.clone(), found, expected))
}

/// Throats between two pores that have another one at the same place.
fn doubled(network: &Network) -> Vec<Refusal> {
    let mut of_pair: HashMap<[usize; 2], Vec<&Throat>> = HashMap::new();
    let mut bad = Vec::new();
    for throat in &network.throats {
        let [a, b] = throat.pores;
        let others = of_pair.entry([a.min(b), a.max(b)]).or_default();
        let is_same = |other: &&&Throat| match throat.middle.zip(other.middle) {
            Some((one, another)) => !((one - another).norm() > APART * throat.width),
            None => true,
        };
        if let Some(other) = others.iter().find(is_same) {
            let found = format!("a second throat between the pores of {}", other.location);
            let expected = "one throat between two pores, or the coordinates of the middle of each";
            bad.push(Refusal::new(throat.location.clone(), found, expected));
        }
        others.push(throat);
    }
    bad
}
