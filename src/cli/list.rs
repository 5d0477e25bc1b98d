//! `meniscus list`: the models by the names of their tables, with references.

use super::output::say;

/// Table of a case file, what it does, where it comes from.
const MODELS: [[&str; 3]; 9] = [
    ["[sph]", "direct simulation by incompressible SPH", "Huber et al. 2013"],
    [
        "[sph.surface-force.pressure-jump]",
        "pressure jump across a sharp interface (default)",
        "Fedkiw et al. 1999; Kang et al. 2000; docs/numerics",
    ],
    ["[sph.surface-force.csf]", "continuum surface force", "Huber et al. 2013, Eq. 20; Brackbill et al. 1992"],
    ["[sph.wetting.young]", "unbalanced Young force at the contact line", "Huber et al. 2013, Eqs. 7 and 23"],
    [
        "sph.numerics.viscous-term = \"stress\"",
        "viscous term with the transposed gradient (default)",
        "Morris et al. 1997; docs/numerics",
    ],
    ["sph.numerics.viscous-term = \"szewc\"", "viscous term", "Huber et al. 2013, Eq. 16; Szewc et al. 2012"],
    ["sph.numerics.viscous-term = \"morris\"", "viscous term, harmonic mean", "Morris et al. 1997"],
    ["sph.sides: periodic, wall, symmetry", "sides of the domain", ""],
    ["sph.sides: image", "no-slip wall by image particles", "Huber et al. 2013, Eqs. 32-34"],
];

/// Prints the models.
pub fn list() {
    for [table, what, reference] in MODELS {
        say(format_args!("{table:<38} {what:<44} {reference}").to_string().trim_end());
    }
}
