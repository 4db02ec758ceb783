//! The reasons why a run cannot have an output folder.

use super::OutputError;
use std::path::PathBuf;

/// Why a run cannot claim an output folder.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// A user's file or folder would be replaced.
    #[error("{} {reason}, and this run would replace it: choose another folder with -o, or move it away", path.display())]
    Foreign {
        /// The file or folder.
        path: PathBuf,
        /// Why it is a user's, in words.
        reason: &'static str,
    },
    /// A path of percoat's own is a link, a pipe, or a folder in the place of a file (or the reverse).
    #[error("{} is {found}, where percoat keeps {expected} of its own: move it away, or choose another folder with -o", path.display())]
    WrongKind {
        /// The path.
        path: PathBuf,
        /// The kind of what stands there, in words.
        found: &'static str,
        /// The kind that percoat needs, in words.
        expected: &'static str,
    },
    /// Another run writes into the folder.
    #[error("another run ({owner}) is writing into {}: wait for it, or choose another folder with -o", folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// Process of the other run, from its lock.
        owner: String,
    },
    /// The folder cannot be read or written.
    #[error(transparent)]
    Output(#[from] OutputError),
}
