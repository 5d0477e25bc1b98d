//! `meniscus list`: the models by the names of their tables, the fluids and the tensions of their pairs, each with its source.

use super::output::{readable, say};
use meniscus_case::preset::{PAIRS, Preset, State};
use meniscus_core::input::tables::Words;
use meniscus_wetting::laws;

/// Table of a case file, its model, its reference; before and after the wetting models.
const MODELS: [[&str; 3]; 7] = [
    ["[sph]", "Direct simulation by incompressible SPH", "Huber et al. 2013"],
    ["[thin-film]", "Droplets on a flat wall", "Pang and O Naraigh 2022"],
    ["[network]", "Quasi-static displacement in a pore network", "Cieplak and Robbins 1988, 1990; docs/numerics"],
    ["[network.wetting.young]", "Static angle; also tadmor, hysteresis, patches", "Young 1805"],
    ["network.events = \"burst\"", "Invasion percolation", "Wilkinson and Willemsen 1983"],
    [
        "[sph.surface-force.pressure-jump]",
        "Pressure jump across a sharp interface (default)",
        "Fedkiw et al. 1999; Kang et al. 2000; docs/numerics",
    ],
    ["[sph.surface-force.csf]", "Continuum surface force", "Huber et al. 2013, Eq. 20; Brackbill et al. 1992"],
];
const DETAILS: [[&str; 3]; 6] = [
    ["[[sph.wetting.patches]]", "Angles of shapes, sides and stripes", ""],
    [
        "sph.numerics.viscous-term = \"stress\"",
        "Viscous term with the transposed gradient (default)",
        "Morris et al. 1997; docs/numerics",
    ],
    ["sph.numerics.viscous-term = \"szewc\"", "Viscous term", "Huber et al. 2013, Eq. 16; Szewc et al. 2012"],
    ["sph.numerics.viscous-term = \"morris\"", "Viscous term, harmonic mean", "Morris et al. 1997"],
    ["sph.sides: periodic, wall, symmetry", "Sides of the domain", ""],
    ["sph.sides: image", "No-slip wall by image particles", "Huber et al. 2013, Eqs. 32-34"],
];

/// Prints all of them.
pub(crate) fn list() {
    MODELS.iter().for_each(row);
    for law in laws() {
        let (what, source) = law.what_and_source();
        row(&[&format!("[sph.wetting.{}]", law.key), what, source]);
    }
    DETAILS.iter().for_each(row);
    say("");
    row(&["preset", "Known at, density in kg/m3, viscosity in mPa s", "Source"]);
    for preset in Preset::all() {
        row(&[&format!("\"{}\"", preset.word()), &known(preset), preset.source()]);
    }
    say("");
    row(&["Tension of", "Known at", "Source"]);
    PAIRS.iter().for_each(|pair| row(&[pair.fluids, pair.range, pair.source]));
}

/// The states in which a fluid is known, and its density and viscosity in the first of them, a solution with a tenth of its mass as solute.
fn known(preset: Preset) -> String {
    let [low, high] = preset.temperatures();
    let mut range = if low == high { format!("{low} C") } else { format!("{low} to {high} C") };
    if let Some([low, high]) = preset.pressures() {
        range += &format!(", {} to {} MPa", low / 1e6, high / 1e6);
    }
    let mass_fraction = preset.solute().map(|_| 0.1);
    let pascal = preset.pressures().map(|_| 1.0e7);
    // A temperature of reservoirs.
    let celsius = pascal.map(|_| 50.0);
    let state = State { celsius, pascal, mass_fraction };
    preset.at(&state).map_or(range.clone(), |found| {
        let at = pascal.map_or("", |_| ", 10 MPa");
        let solute = mass_fraction.map_or("", |_| ", a tenth solute");
        let celsius = preset.temperature(&state);
        format!(
            "{range}; {} and {} at {celsius} C{at}{solute}",
            readable(found.density),
            readable(1e3 * found.viscosity)
        )
    })
}

fn row([table, what, reference]: &[&str; 3]) {
    say(format_args!("{table:<38} {what:<58} {reference}").to_string().trim_end());
}
