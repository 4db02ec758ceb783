//! What every file of results begins with: version, title, the whole case, and units.

use percoat_case::case::Case;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// The first keys of a file of results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Head {
    /// The version that wrote it.
    pub percoat: String,
    /// Title of the case.
    pub title: String,
    /// The whole case, with its defaults.
    pub case: Value,
    /// Names of the units of all numbers.
    #[serde(default)]
    pub units: UnitNames,
}

/// Names of units, `None` where they have none.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct UnitNames {
    /// Name of the unit of lengths.
    pub length: Option<String>,
    /// Name of the unit of pressures.
    pub pressure: Option<String>,
}

impl Head {
    /// The head of a result of this version for a case.
    pub(super) fn of(case: &Case) -> Self {
        let units = case.units();
        Self {
            percoat: env!("CARGO_PKG_VERSION").to_owned(),
            title: case.title.clone(),
            case: json!(case),
            units: UnitNames { length: units.length().name(), pressure: units.pressure().name() },
        }
    }
}
