//! The input of a call, and the checked case made from it.

use std::path::Path;

use meniscus::run::source::{self, Refusal, Source};
use meniscus_case::NetworkOptions;
use meniscus_core::input::Problem;
use meniscus_drawings::import::Options;
use serde_json::Value;

use crate::refused::{DICT, Refused};

/// A case or a drawing.
#[derive(pyo3::FromPyObject)]
pub(crate) struct Given {
    /// `built-in`, `file`, `dict`, `drawing` or `shapes`.
    #[pyo3(item)]
    kind: String,
    /// A path, or a dict as JSON.
    #[pyo3(item)]
    value: String,
    /// Overrides by key, as JSON.
    #[pyo3(item)]
    set: String,
    /// Import options of a drawing, as JSON.
    #[pyo3(item)]
    import: String,
    /// Options of the displacement in its network, as JSON.
    #[pyo3(item)]
    options: String,
}

impl Given {
    /// The checked case.
    pub(crate) fn source(&self) -> Result<Source, Refused> {
        let set = self.overrides()?;
        let path = Path::new(&self.value);
        match self.kind.as_str() {
            "dict" => {
                let text = toml_of(&self.value)?;
                source::load_case_text(DICT, &text, &set).map_err(|error| Refused::Dict(error, text))
            }
            "file" => Ok(source::load_case(Some(path), &set)?),
            "drawing" => Ok(source::load_network(path, &self.import()?, &self.network()?)?),
            "shapes" => {
                let text = toml_of(&self.value)?;
                let found = source::load_network_text(DICT, &text, &self.import()?, &self.network()?);
                found.map_err(|refusal| match refusal {
                    Refusal::Input(error) => Refused::Dict(error, text),
                    other => other.into(),
                })
            }
            _ => Ok(source::load_case(None, &set)?),
        }
    }

    /// The overrides as on the command line.
    fn overrides(&self) -> Result<Vec<String>, Refused> {
        Ok(table(&self.set)?.into_iter().map(|(key, value)| format!("{key}={value}")).collect())
    }

    fn import(&self) -> Result<Options, Refused> {
        read(&self.import)
    }

    fn network(&self) -> Result<NetworkOptions, Refused> {
        read(&self.options)
    }
}

/// Parameters from a dict as JSON; the error names each that is invalid.
fn read<T: serde::de::DeserializeOwned>(json: &str) -> Result<T, Refused> {
    let given: serde_json::Map<String, Value> = serde_json::from_str(json).map_err(|error| refused("", &error))?;
    // A keyword of Python is a key with underscores.
    let named = |key: &str| key.replace('_', "-");
    let alone = |(key, value): (&String, &Value)| {
        let one = Value::Object([(named(key), value.clone())].into_iter().collect());
        serde_json::from_value::<T>(one).err().map(|error| problem(key, &error))
    };
    let problems: Vec<Problem> = given.iter().filter_map(alone).collect();
    if !problems.is_empty() {
        return Err(Refusal::Options(problems).into());
    }
    let given = given.into_iter().map(|(key, value)| (named(&key), value)).collect();
    serde_json::from_value(Value::Object(given)).map_err(|error| refused("", &error))
}

/// A table from a dict as JSON.
fn table(json: &str) -> Result<toml::Table, Refused> {
    serde_json::from_str(json).map_err(|error| refused("", &error))
}

/// A dict as TOML text, in which mistakes can be located.
fn toml_of(json: &str) -> Result<String, Refused> {
    toml::to_string(&table(json)?).map_err(|error| refused("", &error))
}

fn refused(key: &str, error: &dyn std::fmt::Display) -> Refused {
    Refusal::Options(vec![problem(key, error)]).into()
}

fn problem(key: &str, error: &dyn std::fmt::Display) -> Problem {
    // A position in the JSON means nothing to the author of Python code.
    let text = error.to_string();
    let message = text.split(" at line ").next().unwrap_or_default().to_owned();
    Problem::new(key, message, "")
}
