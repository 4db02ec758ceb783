//! The task of a sweep.

use serde::{Deserialize, Serialize};

/// The task for every combination.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Task {
    /// Solve the load steps.
    Solve,
    /// Search for the limit loads.
    Limit,
}

impl Task {
    /// Code in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Solve => "solve",
            Self::Limit => "limit",
        }
    }
}
