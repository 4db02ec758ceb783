//! The verdict on a criterion: with the utilisation u ± e it **fails** where u − e ≥ 1 and **holds** where u + e < 1; between it is
//! **undecided** by the error of the grid.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Whether a criterion fails, by its utilisation and the estimated error of it. Where no error is known, the value decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The utilisation and its error stay below 1.
    Holds,
    /// The utilisation less its error reaches 1.
    Fails,
    /// Neither, or no number.
    Undecided,
}

impl Verdict {
    /// Verdict from the `least` utilisation u − e and the `most` one u + e.
    pub fn of(least: f64, most: f64) -> Self {
        if least >= 1.0 {
            Self::Fails
        } else if most < 1.0 {
            Self::Holds
        } else {
            Self::Undecided
        }
    }

    /// Name in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::Undecided => "undecided",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
