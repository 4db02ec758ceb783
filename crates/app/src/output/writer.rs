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
    /// `percoat sweep`.
    Sweep,
    /// `percoat merge`, whose files are listed as those of a sweep.
    #[serde(skip)]
    Merge,
    /// `percoat report`.
    Report,
}

impl Writer {
    /// All commands.
    pub const ALL: [Self; 10] = [
        Self::Solve,
        Self::Check,
        Self::Compare,
        Self::Limit,
        Self::Identify,
        Self::Life,
        Self::Validate,
        Self::Sweep,
        Self::Merge,
        Self::Report,
    ];

    /// The command under which its files are listed: the joined parts of a sweep replace a sweep, and the reverse.
    pub(super) fn listed(self) -> Self {
        if self == Self::Merge { Self::Sweep } else { self }
    }

    /// Whether a later run goes on with what a killed one has finished, or keeps it; of the others nothing is worth keeping.
    pub(super) fn is_resumable(self) -> bool {
        [Self::Solve, Self::Sweep, Self::Life].contains(&self)
    }

    /// Whether a new result outdates what a command has written: the report of an earlier result.
    pub(super) fn outdates(self, by: Self) -> bool {
        by == Self::Report && [Self::Solve, Self::Limit, Self::Life, Self::Sweep].contains(&self.listed())
    }
}
