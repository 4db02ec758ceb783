//! A result that cannot be read back.

use serde::de::DeserializeOwned;
use serde_json::Value;

/// Why a result cannot be read back: what is missing or of another kind.
#[derive(Debug, thiserror::Error)]
#[error("{what}: {reason}")]
pub struct Unreadable {
    pub(super) what: String,
    pub(super) reason: String,
}

/// What a value says, called so where it does not.
pub(super) fn read<T: DeserializeOwned>(what: &str, value: &Value) -> Result<T, Unreadable> {
    T::deserialize(value).map_err(|error| Unreadable { what: what.to_owned(), reason: error.to_string() })
}
