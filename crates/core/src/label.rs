//! Names of keys and measures as words with their unit, for axes, legends and heads of tables.

use std::fmt;

/// Ends of names and units of reports, each as printed.
const UNITS: [(&str, &str); 14] = [
    ("deg", "degrees"),
    ("c", "°C"),
    ("m", "m"),
    ("m2", "m²"),
    ("m3", "m³"),
    ("um", "µm"),
    ("s", "s"),
    ("s2", "s²"),
    ("kg", "kg"),
    ("N", "N"),
    ("J", "J"),
    ("Pa", "Pa"),
    ("K", "K"),
    ("Hz", "Hz"),
];

/// Words that are not written in lower case.
const SPELLED: [(&str, &str); 12] = [
    ("bond", "Bond"),
    ("courant", "Courant"),
    ("cox", "Cox"),
    ("cpu", "CPU"),
    ("jurin", "Jurin"),
    ("l2", "L2"),
    ("laplace", "Laplace"),
    ("poiseuille", "Poiseuille"),
    ("rms", "RMS"),
    ("voinov", "Voinov"),
    ("young", "Young"),
    ("non wetting", "non-wetting"),
];

/// The words of a quantity and its unit.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Label {
    /// Its name: `contact angle`.
    pub words: String,
    /// Its unit as printed, `degrees`; empty for a dimensionless number.
    pub unit: String,
}

impl Label {
    /// The words of a name such as `contact-angle-deg`, which ends in its unit unless it is dimensionless; `unit` is that of a report, if known.
    pub fn of(name: &str, unit: Option<&str>) -> Self {
        let parts: Vec<&str> = name.split(['-', '_']).filter(|part| !part.is_empty()).collect();
        let (count, end) = unit_at_end(&parts);
        let unit = unit.filter(|unit| !unit.is_empty()).map(printed);
        Self { words: words(&parts[..count]), unit: unit.unwrap_or(end) }
    }

    /// A value of the quantity with its unit: `60 degrees`.
    pub fn valued(&self, value: &str) -> String {
        if self.unit.is_empty() { value.to_owned() } else { format!("{value} {}", self.unit) }
    }

    /// The same quantity in other words.
    pub fn in_words(&self, words: String) -> Self {
        Self { words, unit: self.unit.clone() }
    }
}

/// The words with the unit in parentheses, as along an axis.
impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)?;
        if self.unit.is_empty() { Ok(()) } else { write!(f, " ({})", self.unit) }
    }
}

fn unit(part: &str) -> Option<&'static str> {
    UNITS.iter().find(|(end, _)| *end == part).map(|(_, unit)| *unit)
}

/// A unit of a report as printed: `m²/s` for `m2/s`.
fn printed(text: &str) -> String {
    let over = |text: &str| text.split(' ').map(|one| unit(one).unwrap_or(one)).collect::<Vec<_>>().join(" ");
    text.split('/').map(over).collect::<Vec<_>>().join("/")
}

/// Number of the parts before the unit at the end of a name, and this unit; a name is more than its unit.
fn unit_at_end(parts: &[&str]) -> (usize, String) {
    let last = |before: usize| parts.len().checked_sub(before).filter(|k| *k > 0).and_then(|k| parts.get(k)).copied();
    let all = (parts.len(), String::new());
    let Some(below) = last(1).and_then(unit) else { return all };
    match (last(2), last(3).and_then(unit)) {
        (Some("per"), Some(above)) => (parts.len() - 3, format!("{above}/{below}")),
        (Some("per"), None) => (parts.len() - 2, format!("1/{below}")),
        (Some("Pa"), _) if below == "s" => (parts.len() - 2, "Pa s".to_owned()),
        _ => (parts.len() - 1, below.to_owned()),
    }
}

fn words(parts: &[&str]) -> String {
    let spelled = |part: &str| SPELLED.iter().find(|(name, _)| *name == part).map(|(_, word)| *word);
    let text = parts.iter().map(|part| spelled(part).unwrap_or(part)).collect::<Vec<_>>().join(" ");
    SPELLED.iter().filter(|(name, _)| name.contains(' ')).fold(text, |text, (name, word)| text.replace(name, word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_becomes_words_with_the_unit_at_its_end() {
        for (name, label) in [
            ("contact-angle-deg", "contact angle (degrees)"),
            ("capillary-pressure-Pa", "capillary pressure (Pa)"),
            ("inflow-m2-per-s", "inflow (m²/s)"),
            ("interface-curvature-per-m", "interface curvature (1/m)"),
            ("hysteresis-work-J-per-m3", "hysteresis work (J/m³)"),
            ("wall-time-s", "wall time (s)"),
            ("laplace-jump-ratio", "Laplace jump ratio"),
            ("velocity-l2-error", "velocity L2 error"),
            ("relative-permeability-non-wetting", "relative permeability non-wetting"),
            ("film_thickness-um", "film thickness (µm)"),
            ("u-min", "u min"),
            ("m", "m"),
            ("per-m", "per (m)"),
        ] {
            assert_eq!(Label::of(name, None).to_string(), label);
        }
    }

    #[test]
    fn the_unit_of_a_report_is_printed_and_not_told_twice() {
        assert_eq!(Label::of("advancing-angle-deg", Some("deg")).to_string(), "advancing angle (degrees)");
        assert_eq!(Label::of("decay-rate", Some("1/s")).to_string(), "decay rate (1/s)");
        assert_eq!(Label::of("max-rise-velocity", Some("m/s")).to_string(), "max rise velocity (m/s)");
        assert_eq!(Label::of("injected", Some("pore volumes")).to_string(), "injected (pore volumes)");
        assert_eq!(Label::of("saturation", Some("")).to_string(), "saturation");
        assert_eq!(Label::of("angle", Some("degrees")).valued("60"), "60 degrees");
        assert_eq!(Label::of("saturation", None).valued("0.5"), "0.5");
    }
}
