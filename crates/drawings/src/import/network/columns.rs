//! Names of the columns of a network, and of labels.

/// The columns that are read. Of several names the first one that is there counts.
#[derive(Debug)]
pub(super) struct Columns {
    /// Coordinates of a pore.
    pub(super) center: [&'static str; 3],
    /// Its inscribed size.
    pub(super) size: &'static [&'static str],
    /// Radius of the pore over its size.
    pub(super) radius_of_size: f64,
    /// Number of the pore; without it pores are numbered by row, from 0.
    pub(super) number: Option<&'static str>,
    /// Start of the names of labels of pores.
    pub(super) labels: &'static str,
    /// Numbers of the pores of a throat.
    pub(super) ends: [&'static str; 2],
    /// Its width.
    pub(super) width: &'static [&'static str],
    /// Coordinates of its middle.
    pub(super) middle: [&'static str; 3],
    /// Its length from pore center to pore center.
    pub(super) length: &'static [&'static str],
    /// How a missing column is added.
    pub(super) remedy: &'static str,
}

/// `openpnm.io.network_to_csv`; the middle is that of PoreSpy.
pub(super) const OPENPNM: Columns = Columns {
    center: ["pore.coords[0]", "pore.coords[1]", "pore.coords[2]"],
    size: &["pore.inscribed_diameter", "pore.diameter"],
    radius_of_size: 0.5,
    number: None,
    labels: "pore.",
    ends: ["throat.conns[0]", "throat.conns[1]"],
    width: &["throat.inscribed_diameter", "throat.diameter"],
    middle: ["throat.global_peak[0]", "throat.global_peak[1]", "throat.global_peak[2]"],
    length: &["throat.total_length", "throat.spacing"],
    remedy: "set it in the network and write that with `openpnm.io.network_to_csv`",
};

/// `pores.csv` and `throats.csv`.
pub(super) const PAIR: Columns = Columns {
    center: ["x_m", "y_m", "z_m"],
    size: &["inscribed_radius_m"],
    radius_of_size: 1.0,
    number: Some("pore"),
    labels: "",
    ends: ["pore_1", "pore_2"],
    width: &["width_m"],
    middle: ["x_m", "y_m", "z_m"],
    length: &["length_m"],
    remedy: "name the columns so, lengths in m",
};

/// Whether a column is one of a network and of no list of discs.
pub(super) fn is_of_network(name: &str) -> bool {
    let is_of_pair = PAIR.size.contains(&name) || PAIR.ends.contains(&name) || PAIR.width.contains(&name);
    name.starts_with("pore.") || name.starts_with("throat.") || is_of_pair
}

/// What a label of a pore says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Label {
    /// It lies at a side: 0 left, 1 right, 2 bottom, 3 top.
    Side(usize),
    /// It is an inlet (0) or an outlet (1).
    End(usize),
    /// It is a boundary pore.
    Boundary,
}

/// Labels of sides: both of each axis.
const SIDES: [[&[&str]; 2]; 3] = [
    [&["left", "xmin"], &["right", "xmax"]],
    [&["front", "ymin"], &["back", "ymax"]],
    [&["bottom", "zmin"], &["top", "zmax"]],
];

/// The label of a name without its start, in a plane of these two axes; `None` if it says nothing on openings.
///
/// In the plane of x and y the words `bottom` and `top` are free for sides of y.
pub(super) fn label(name: &str, plane: [usize; 2]) -> Option<Label> {
    match name {
        "boundary" => return Some(Label::Boundary),
        "inlet" | "inlets" => return Some(Label::End(0)),
        "outlet" | "outlets" => return Some(Label::End(1)),
        _ => {}
    }
    let name = name.strip_suffix("_boundary").unwrap_or(name);
    if plane == [0, 1] && matches!(name, "bottom" | "top") {
        return Some(Label::Side(2 + usize::from(name == "top")));
    }
    plane.iter().enumerate().find_map(|(at, &axis)| {
        let end = SIDES[axis].iter().position(|names| names.contains(&name))?;
        Some(Label::Side(2 * at + end))
    })
}
