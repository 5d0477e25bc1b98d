//! The unit of a key, from its description in the schema.

use std::sync::LazyLock;

use serde_json::Value;

use super::schema::schema;

/// Units in descriptions, longer ones before their beginnings.
const UNITS: [&str; 15] =
    ["kg/m³", "m³/s", "m²/s", "m/s²", "m/s", "m²", "m", "N/m", "Pa s", "Pa", "1/m", "1/s", "s", "degrees", "°C"];

/// Beginning of a key that may be in scaled units.
const SCALED: &str = "thin-film.";

/// The unit of a number at a key path such as `network.interface.tension`; `depth` is whether the chip has one, if known. `None` for a dimensionless number, an
/// unknown key, or one in scaled units.
pub fn unit_of_key(path: &str, depth: Option<bool>) -> Option<&'static str> {
    static SCHEMA: LazyLock<Value> = LazyLock::new(schema);
    let description = description(&SCHEMA, path)?;
    let mut units = units_in(&description);
    units.dedup();
    match units[..] {
        _ if path.starts_with(SCALED) && !path.ends_with("-deg") => None,
        [unit] => Some(unit),
        // Per meter of depth without a depth, and of the chip with one.
        [per_meter, of_chip] if description.contains("geometry.depth") => {
            depth.map(|has_depth| if has_depth { of_chip } else { per_meter })
        }
        _ => None,
    }
}

/// The units that a description names as `in m`, in their order.
fn units_in(description: &str) -> Vec<&'static str> {
    let begins = |text: &str, unit: &str| {
        text.strip_prefix(unit)
            .is_some_and(|rest| !rest.starts_with(|next: char| next.is_alphanumeric() || next == '/'))
    };
    let words = description.split_whitespace().collect::<Vec<_>>().join(" ");
    let after = words.split(" in ").skip(1);
    after.filter_map(|text| UNITS.into_iter().find(|unit| begins(text, unit))).collect()
}

/// The description of the key at a path.
fn description(schema: &Value, path: &str) -> Option<String> {
    let mut tables = vec![schema];
    let mut found = None;
    for part in path.split('.') {
        let (name, element) = part.split_once('[').map_or((part, false), |(name, _)| (name, true));
        let keys: Vec<&Value> = tables
            .iter()
            .flat_map(|table| alternatives(schema, table))
            .filter_map(|t| t["properties"].get(name))
            .collect();
        found = keys.iter().find_map(|key| key["description"].as_str()).map(str::to_owned);
        tables = if element {
            keys.iter().flat_map(|key| alternatives(schema, key)).map(|key| &key["items"]).collect()
        } else {
            keys
        };
    }
    found
}

/// A schema with what it refers to and all its alternatives.
fn alternatives<'s>(schema: &'s Value, table: &'s Value) -> Vec<&'s Value> {
    let target = table["$ref"].as_str().and_then(|name| schema.pointer(name.trim_start_matches('#')));
    let lists = ["oneOf", "anyOf", "allOf"].iter().filter_map(|list| table[list].as_array()).flatten();
    // A branch that only requires a key of its own table has no properties.
    let others =
        target.into_iter().chain(lists.filter(|one| one.get("required").is_none() || one.get("properties").is_some()));
    std::iter::once(table).chain(others.flat_map(|other| alternatives(schema, other))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_have_the_units_of_their_descriptions() {
        for (key, unit) in [
            ("sph.wetting.young.contact-angle-deg", Some("degrees")),
            ("network.interface.tension", Some("N/m")),
            ("sph.spacing", Some("m")),
            ("sph.gravity[1]", Some("m/s²")),
            ("sph.sides.open.left.velocity", Some("m/s")),
            ("geometry.etch-offset", Some("m")),
            ("geometry.shapes[0].disc.radius", Some("m")),
            ("time.end", Some("s")),
            ("sph.smoothing-ratio", None),
            ("thin-film.droplets[0].height", None),
            ("sph.no-such-key", None),
        ] {
            assert_eq!(unit_of_key(key, None), unit, "{key}");
        }
    }

    #[test]
    fn a_rate_is_per_meter_of_depth_or_of_the_chip() {
        let of = |depth| unit_of_key("network.dynamic.rate", depth);
        assert_eq!([of(None), of(Some(false)), of(Some(true))], [None, Some("m²/s"), Some("m³/s")]);
    }
}
