//! The commands that leave a result in an output folder.

use super::layout::OWN;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

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

/// All commands, each with its staging folder: visible for long runs, which can be resumed, within `.percoat` for others.
const STAGING: [(Writer, &str); 10] = [
    (Writer::Solve, "unfinished"),
    (Writer::Check, ".percoat/check"),
    (Writer::Compare, ".percoat/compare"),
    (Writer::Limit, ".percoat/limit"),
    (Writer::Identify, ".percoat/identify"),
    (Writer::Life, "unfinished-life"),
    (Writer::Validate, ".percoat/validate"),
    (Writer::Sweep, "unfinished-sweep"),
    (Writer::Merge, ".percoat/merge"),
    (Writer::Report, ".percoat/report"),
];

impl Writer {
    /// All commands.
    pub(super) fn all() -> [Self; STAGING.len()] {
        STAGING.map(|(writer, _)| writer)
    }

    /// The staging folder in an output folder.
    pub(super) fn staging(self, folder: &Path) -> PathBuf {
        folder.join(self.place())
    }

    fn place(self) -> &'static str {
        STAGING.iter().find(|(writer, _)| *writer == self).expect("every command has one").1
    }

    /// The command under which its files are listed: the joined parts of a sweep replace a sweep, and the reverse.
    pub(super) fn listed(self) -> Self {
        if self == Self::Merge { Self::Sweep } else { self }
    }

    /// Whether a later run goes on with what a killed one has finished, or keeps it; of the others nothing is worth keeping.
    pub(super) fn is_resumable(self) -> bool {
        !self.place().starts_with(OWN)
    }

    /// Whether a new result outdates what a command has written: the report of an earlier result.
    pub(super) fn outdates(self, by: Self) -> bool {
        by == Self::Report && ![Self::Check, Self::Validate, Self::Report].contains(&self.listed())
    }
}
