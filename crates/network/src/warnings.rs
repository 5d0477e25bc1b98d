//! Warnings on the results of a network: cases that its formulas do not cover, and missing connections.

use super::flow::{LEAST_SOLID, drive};
use super::model::Configuration;
use meniscus_case::{SIDES, Side};
use meniscus_geometry::interface::depth::implausible;

/// The names of both permeabilities.
const PERMEABILITIES: [&str; 2] = ["permeability-x-m2", "permeability-y-m2"];

/// All warnings on a network.
pub(crate) fn warnings(config: &Configuration) -> Vec<String> {
    let names: Vec<&str> =
        (0..2).filter(|&axis| drive(config, axis).is_some()).map(|axis| PERMEABILITIES[axis]).collect();
    let loose = || loose(config).filter(|_| !names.is_empty()).map(|note| format!("{}: {note}", names.join(", ")));
    disconnected(config).or_else(loose).into_iter().chain(odd_depth(config)).collect()
}

/// Limits of the permeability along an axis, if there is one.
pub(crate) fn notes_on_permeability(config: &Configuration, axis: usize) -> Vec<String> {
    if drive(config, axis).is_none() {
        return Vec::new();
    }
    loose(config).into_iter().chain(open_beside(config, axis)).collect()
}

fn loose(config: &Configuration) -> Option<String> {
    let solid = 1.0 - config.porosity;
    (solid < LEAST_SOLID).then(|| {
        format!(
            "the solid fraction is {solid:.2}; below {LEAST_SOLID} walls may be far apart, and Stokes flow may differ by up to 30 %"
        )
    })
}

/// Flow along an open side has a wall on one side only, so that no throat represents it.
fn open_beside(config: &Configuration, axis: usize) -> Option<String> {
    let beside = [2 * (1 - axis), 2 * (1 - axis) + 1];
    let open: Vec<&str> = beside
        .into_iter()
        .filter(|&side| !matches!(config.sides[side], Side::Wall | Side::Periodic))
        .filter(|&side| config.network.openings.iter().any(|opening| opening.side == side))
        .map(|side| SIDES[side])
        .collect();
    (!open.is_empty()).then(|| {
        format!(
            "nothing flows along the open side{} {}: this is the permeability of the box as cut, not that of the solids; for that, make the sides \
             periodic or walls",
            if open.len() == 1 { "" } else { "s" },
            open.join(" and ")
        )
    })
}

/// A depth far below or above the widths of all throats.
fn odd_depth(config: &Configuration) -> Option<String> {
    let widths = || config.network.throats.iter().map(|throat| throat.width);
    implausible(config.network.depth?, widths().reduce(f64::min)?, widths().reduce(f64::max)?)
}

/// Missing connection from the inlet to the outlet.
fn disconnected(config: &Configuration) -> Option<String> {
    let [inlet, outlet] = config.ends();
    let (inlet, outlet, network) = (inlet?, outlet?, &config.network);
    let mut beside = vec![Vec::new(); network.regions.len()];
    for [one, other] in network.throats.iter().map(|throat| throat.regions) {
        beside[one].push(other);
        beside[other].push(one);
    }
    let mut reached = vec![false; network.regions.len()];
    let ends = config.at_outlet();
    let at_inlet = config.at_inlet();
    let mut open: Vec<usize> = (0..at_inlet.len()).filter(|&region| at_inlet[region]).collect();
    while let Some(region) = open.pop() {
        if !std::mem::replace(&mut reached[region], true) {
            open.extend(&beside[region]);
        }
    }
    ends.iter().zip(&reached).all(|(is_end, reached)| !(is_end & reached)).then(|| {
        format!(
            "no path through the pores leads from the inlet ({inlet}) to the outlet ({outlet}): the solids close all of them, so that nothing is displaced \
             to the outlet; choose other sides, or look at the picture for the shapes that touch"
        )
    })
}
