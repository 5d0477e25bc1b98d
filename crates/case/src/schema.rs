//! For editors and new users: the JSON schema of a case file and a commented starter case.

use serde_json::{Map, Value, json};

use super::case_file::RawCase;
use super::load::load_from;
use super::read_geometry::Origin;
use meniscus_core::input::{InputError, Overrides};
use meniscus_wetting::laws;

/// Tables with exactly one of several tables or keys, each an alternative: the type, and the keys that are not alternatives.
const EXACTLY_ONE: [(&str, &[&str]); 4] =
    [("RawFilmEquation", &[]), ("RawSurfaceForce", &[]), ("RawVelocity", &[]), ("RawWetting", &["patches"])];

/// The same for tables that may be empty: then the program chooses.
const AT_MOST_ONE: [&str; 2] = ["RawFilmMethod", "RawFilmWetting"];

/// The models of a case, exactly one of them.
const MODELS: [&str; 3] = ["sph", "thin-film", "network"];

/// The JSON schema of a case file: every key with its unit in its description, the ranges of numbers, and a branch for each of several exclusive models.
pub fn schema() -> Value {
    let mut schema = schemars::schema_for!(RawCase).to_value();
    without_null(&mut schema);
    schema["properties"]["format"]["const"] = json!(1);
    let models = branches(&schema["properties"], &MODELS);
    schema["oneOf"] = models;
    for law in laws() {
        schema["$defs"]["RawWetting"]["properties"][&law.key]["description"] = json!(law.about);
    }
    for (table, others) in EXACTLY_ONE {
        let keys = schema["$defs"][table]["properties"].as_object().into_iter().flat_map(Map::keys);
        let keys: Vec<&str> = keys.map(String::as_str).filter(|key| !others.contains(key)).collect();
        let alternatives = branches(&schema["$defs"][table]["properties"], &keys);
        schema["$defs"][table]["oneOf"] = alternatives;
    }
    for table in AT_MOST_ONE {
        let keys = schema["$defs"][table]["properties"].as_object().into_iter().flat_map(Map::keys);
        let keys: Vec<&str> = keys.map(String::as_str).collect();
        let mut alternatives = branches(&schema["$defs"][table]["properties"], &keys);
        if let Some(all) = alternatives.as_array_mut() {
            all.push(json!({ "title": "default", "description": "The program chooses.", "maxProperties": 0 }));
        }
        schema["$defs"][table]["oneOf"] = alternatives;
    }
    schema
}

/// A branch for each key: its name, its description, and that it is present.
fn branches(properties: &Value, keys: &[&str]) -> Value {
    let branch = |key: &&str| json!({ "title": key, "description": properties[key]["description"], "required": [key] });
    keys.iter().map(branch).collect()
}

/// TOML has no null: a key is present or absent.
fn without_null(schema: &mut Value) {
    match schema {
        Value::Array(all) => all.iter_mut().for_each(without_null),
        Value::Object(keys) => {
            if let Some(Value::Array(types)) = keys.get_mut("type") {
                types.retain(|one| one != "null");
                if let [one] = &types[..] {
                    let one = one.clone();
                    keys.insert("type".into(), one);
                }
            }
            if let Some(Value::Array(any)) = keys.get_mut("anyOf") {
                any.retain(|one| one["type"] != "null");
                if let [Value::Object(one)] = &any[..] {
                    let one = one.clone();
                    keys.remove("anyOf");
                    keys.extend(one);
                }
            }
            // The unit is in the description; `double` and the like are of no use to an editor.
            if keys.get("format").is_some_and(Value::is_string) {
                keys.remove("format");
            }
            keys.values_mut().for_each(without_null);
        }
        _ => {}
    }
}

/// A case file with a comment on every key.
pub fn starter_case() -> &'static str {
    include_str!("starter.toml")
}

/// The same for a chip with a depth in m.
///
/// # Errors
/// Why such a depth is invalid.
pub fn starter_of_chip(depth: f64) -> Result<String, InputError> {
    /// The text after the geometry, with the line between both.
    const NEXT: &str = "\n[sph]";
    let key = format!("depth = {depth:?} # m, from the floor to the lid\n{NEXT}");
    let text = starter_case().replacen(NEXT, &key, 1);
    load_from(&Origin::Given("the starter case", &text), &Overrides::default(), None).map(|_| text)
}
