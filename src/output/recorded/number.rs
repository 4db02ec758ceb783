//! Numbers that are null where they are not finite.

use serde::{Deserialize, Deserializer};

/// A number, infinite, or none.
pub(super) fn value(x: Option<f64>, singular: bool) -> f64 {
    x.unwrap_or(if singular { f64::INFINITY } else { f64::NAN })
}

/// A number, or none.
pub(super) fn plain(x: Option<f64>) -> f64 {
    value(x, false)
}

/// A number that must be there, null for none.
pub(super) fn or_none<'de, D: Deserializer<'de>>(number: D) -> Result<f64, D::Error> {
    Option::deserialize(number).map(plain)
}
