//! `meniscus list`: the models by the names of their tables, with references.

use super::output::say;

/// Table of a case file, what it does, where it comes from.
const MODELS: [[&str; 3]; 21] = [
    ["[sph]", "direct simulation by incompressible SPH", "Huber et al. 2013"],
    ["[thin-film]", "droplets on a flat wall", "Pang and O Naraigh 2022"],
    ["[network]", "quasi-static displacement in a pore network", "Cieplak and Robbins 1988, 1990; docs/numerics"],
    ["[network.wetting.young]", "static angle; also tadmor, hysteresis, patches", "Young 1805"],
    ["network.events = \"burst\"", "invasion percolation", "Wilkinson and Willemsen 1983"],
    [
        "[sph.surface-force.pressure-jump]",
        "pressure jump across a sharp interface (default)",
        "Fedkiw et al. 1999; Kang et al. 2000; docs/numerics",
    ],
    ["[sph.surface-force.csf]", "continuum surface force", "Huber et al. 2013, Eq. 20; Brackbill et al. 1992"],
    ["[sph.wetting.young]", "unbalanced Young force at the contact line", "Huber et al. 2013, Eqs. 7 and 23"],
    ["[sph.wetting.tadmor]", "static angle from advancing and receding one", "Tadmor 2004"],
    ["[sph.wetting.hysteresis]", "a line that holds between two angles", "Dussan 1979; docs/numerics"],
    ["[sph.wetting.line-friction]", "friction of the line", "Brochard-Wyart and de Gennes 1992"],
    ["[sph.wetting.molecular-kinetic]", "molecular kinetic theory of the line", "Blake and Haynes 1969"],
    ["[sph.wetting.cox-voinov]", "viscous bending below the fit", "Voinov 1976; Cox 1986"],
    ["[sph.wetting.kistler]", "dynamic angle, Hoffman's data", "Kistler 1993"],
    ["[sph.wetting.jiang]", "dynamic angle, Hoffman's data", "Jiang et al. 1979"],
    ["[[sph.wetting.patches]]", "angles of shapes, sides and stripes", ""],
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
