//! The commands that leave a result in an output folder.

use serde::{Deserialize, Serialize};

/// A command that writes a result into an output folder. Each replaces only its own files, and the report that shows them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Writer {
    /// `percoat solve`.
    Solve,
    /// `percoat check`.
    Check,
    /// `percoat compare`.
    Compare,
    /// `percoat limit`.
    Limit,
    /// `percoat identify`.
    Identify,
    /// `percoat life`.
    Life,
    /// `percoat validate`.
    Validate,
    /// `percoat sweep`, and `percoat merge`.
    Sweep,
    /// `percoat report`.
    Report,
}

impl Writer {
    /// All commands.
    pub const ALL: [Self; 9] = [
        Self::Solve,
        Self::Check,
        Self::Compare,
        Self::Limit,
        Self::Identify,
        Self::Life,
        Self::Validate,
        Self::Sweep,
        Self::Report,
    ];

    /// Whether a new result outdates what a command has written: the report of an earlier result.
    pub(super) fn outdates(self, by: Self) -> bool {
        by == Self::Report && [Self::Solve, Self::Limit, Self::Life, Self::Sweep].contains(&self)
    }
}
