//! Kind of the contact of a case in a result, by its keys.

use percoat_core::kind::ContactKind;
use percoat_core::lattice::Surroundings;
use serde_json::Value;

/// Kind of the contact of a case in the JSON of a result, which may be one that cannot be read any more.
pub fn kind_of(case: &Value) -> ContactKind {
    let surroundings = match case["lattice"]["kind"].as_str() {
        Some("isolated") => Surroundings::FreeSpace,
        _ => Surroundings::Periodic,
    };
    ContactKind { surroundings, is_given: !case["load"]["pressure"].is_null() }
}
