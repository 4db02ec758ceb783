//! Records as JSON, and read back with the place of what is not as this version writes it.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Why a result cannot be read back: what is missing, or of another kind, or unknown.
#[derive(Debug, thiserror::Error)]
#[error("{place}: {reason}")]
pub struct Unreadable {
    /// Where in the file, such as `steps[0].levels[1]`.
    pub(super) place: String,
    /// What is the matter there.
    pub(super) reason: String,
}

/// The record that a value holds.
pub(super) fn read_back<T: DeserializeOwned>(value: &Value) -> Result<T, Unreadable> {
    serde_path_to_error::deserialize(value).map_err(|error| Unreadable {
        place: match error.path().iter().next() {
            Some(_) => format!("`{}`", error.path()),
            None => "the file".to_owned(),
        },
        reason: error.into_inner().to_string(),
    })
}

/// A record as indented JSON.
pub(super) fn indented(record: &impl Serialize) -> String {
    serde_json::to_string_pretty(record).expect("a record is numbers and texts under names") + "\n"
}
