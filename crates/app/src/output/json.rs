//! Records written as JSON and read back; errors name the key.

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Why a result cannot be read back: a key that is missing, unknown or of another kind.
#[derive(Debug, thiserror::Error)]
#[error("{place}: {reason}")]
pub struct Unreadable {
    /// Path of the key, such as `steps[0].levels[1]`.
    pub(super) place: String,
    /// The fault of the key.
    pub(super) reason: String,
}

/// Reads a record from a JSON value.
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
