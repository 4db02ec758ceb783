//! What a sweep does with its combinations.

use serde::{Deserialize, Serialize};

/// What is done with every combination.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Its load steps are solved.
    Solve,
    /// Its limit loads are looked for.
    Limit,
}

impl Task {
    /// Its code in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solve => "solve",
            Self::Limit => "limit",
        }
    }
}
