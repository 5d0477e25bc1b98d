//! What editors and new users start from: the JSON schema of a case file and a commented starter case.

use super::raw::RawCase;

/// The JSON schema of a case file, with every key's unit in its description.
#[must_use]
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(RawCase).to_value()
}

/// A case file with a comment on every key.
#[must_use]
pub fn starter_case() -> &'static str {
    include_str!("starter.toml")
}
