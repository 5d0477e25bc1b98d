//! What a call is given, and the checked case of it.

use std::path::Path;

use meniscus::case::NetworkOptions;
use meniscus::geometry::import::Options;
use meniscus::input::Problem;
use meniscus::run::source::{self, Refusal, Source};

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
    /// Changes of keys, by key, as JSON.
    #[pyo3(item)]
    set: String,
    /// How a drawing is read, as JSON.
    #[pyo3(item)]
    import: String,
    /// What is displaced in its network, as JSON.
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

    /// The changes as the command line takes them.
    fn overrides(&self) -> Result<Vec<String>, Refused> {
        let table: toml::Table = read(&self.set, "set")?;
        Ok(table.into_iter().map(|(key, value)| format!("{key}={value}")).collect())
    }

    fn import(&self) -> Result<Options, Refused> {
        read(&self.import, "")
    }

    fn network(&self) -> Result<NetworkOptions, Refused> {
        read(&self.options, "")
    }
}

/// A value of JSON; `place` is the parameter that it stands for.
fn read<T: serde::de::DeserializeOwned>(json: &str, place: &str) -> Result<T, Refused> {
    serde_json::from_str(json).map_err(|error| {
        // The place in the JSON tells nothing to who wrote Python.
        let text = error.to_string();
        let text = text.split(" at line ").next().unwrap_or_default();
        let problem = Problem { path: place.to_owned(), message: text.to_owned(), help: String::new() };
        Refused::Case(Refusal::Options(vec![problem]))
    })
}

/// A dict as a text in TOML, in which mistakes have their places.
fn toml_of(json: &str) -> Result<String, Refused> {
    let table: toml::Table = read(json, "")?;
    toml::to_string(&table).map_err(|error| {
        let problem = Problem { path: String::new(), message: error.to_string(), help: String::new() };
        Refused::Case(Refusal::Options(vec![problem]))
    })
}
