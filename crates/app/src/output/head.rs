//! What every file of results begins with: version, title, the whole case, and units.

use percoat_case::case::Case;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Declares a file of results, whose first keys are those of a [`Head`]. (They are fields of the file itself: a key that is flattened out of
/// another record is not named where it is at fault.)
macro_rules! with_head {
    ($(#[$attribute:meta])* pub struct $name:ident { $($fields:tt)* }) => {
        $(#[$attribute])*
        pub struct $name {
            /// The version that wrote it.
            pub percoat: String,
            /// Title of the case.
            pub title: String,
            /// The whole case, with its defaults.
            pub case: serde_json::Value,
            /// Names of the units of all numbers.
            #[serde(default)]
            pub units: $crate::output::UnitNames,
            $($fields)*
        }
    };
}
pub(super) use with_head;

/// The first values of a file of results.
pub(super) struct Head {
    pub(super) percoat: String,
    pub(super) title: String,
    pub(super) case: Value,
    pub(super) units: UnitNames,
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
