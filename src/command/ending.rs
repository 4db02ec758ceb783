//! How a command ends: the exit codes are 0 done, 1 a validation failed, 2 refused, 3 not converged, 4 input or output
//! failed; 130 interrupted.

use super::terminal::{self, tell};
use percoat_app::output::{FolderError, OutputError};
use percoat_app::sweep::StudyError;
use percoat_app::task::Refused;
use percoat_case::case::{CaseError, NoCase};
use percoat_common::plain;
use percoat_core::run::RunError;
use std::convert::Infallible;
use std::fmt;
use std::path::PathBuf;

/// How a command without an error ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// All of it is done.
    Done,
    /// A study of the validation fails.
    #[cfg(feature = "validate")]
    Failed,
    /// Something did not converge; everything computed is written and marked.
    NotConverged,
}

impl Ending {
    /// The ending of a command that has computed everything, by whether all of it converged.
    pub fn of(converged: bool) -> Self {
        if converged { Self::Done } else { Self::NotConverged }
    }

    /// Exit code of the process.
    pub fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            #[cfg(feature = "validate")]
            Self::Failed => 1,
            Self::NotConverged => 3,
        }
    }
}

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The case is refused.
    #[error("{}", .0.render(terminal::coloured()).trim_end())]
    Case(#[from] CaseError),
    /// The command line, or the work that it describes, is refused.
    #[error("{0}")]
    Refused(String),
    /// A file cannot be read.
    #[error("cannot read {}: {error}", plain::path(path))]
    Input { path: PathBuf, error: std::io::Error },
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Threads cannot be started.
    #[error(
        "cannot start {count} threads: {error}; allow this process more threads and memory (ulimit -u, ulimit -v), or give --threads 1"
    )]
    Threads { count: usize, error: String },
    /// Standard output cannot be written.
    #[error("cannot write standard output: {0}")]
    Print(#[from] std::io::Error),
}

impl From<NoCase> for Failure {
    fn from(none: NoCase) -> Self {
        match none {
            NoCase::Unreadable { path, error } => Self::Input { path, error },
            refused => Self::refused(refused),
        }
    }
}

impl From<FolderError> for Failure {
    fn from(error: FolderError) -> Self {
        match error {
            FolderError::Output(error) => Self::Output(error),
            refused => Self::refused(refused),
        }
    }
}

impl<E: std::error::Error + Into<Failure> + 'static> From<RunError<E>> for Failure {
    fn from(error: RunError<E>) -> Self {
        match error {
            // The recorder's error has the reason, the error of the run does not.
            RunError::Recorder(error) => error.into(),
            refused => Self::refused(refused),
        }
    }
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        Self::refused(refused)
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Case(error) => Self::Case(error),
            StudyError::Refused(why) => Self::Refused(why),
        }
    }
}

impl From<Infallible> for Failure {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}

impl Failure {
    /// The command or its case is refused (exit code 2), with the reason as plain text.
    pub fn refused(reason: impl fmt::Display) -> Self {
        Self::Refused(reason.to_string())
    }

    /// Prints the reason on standard error.
    pub fn tell(&self) {
        match self {
            // Control sequences of a case's text are removed where it is rendered; the colours are percoat's.
            Self::Case(_) => terminal::print_line(&self.to_string()),
            _ => tell!("error: {}", plain::line(&self.to_string())),
        }
    }

    /// Exit code of the process.
    pub fn code(&self) -> u8 {
        match self {
            Self::Case(_) | Self::Refused(_) => 2,
            Self::Input { .. } | Self::Output(_) | Self::Threads { .. } | Self::Print(_) => 4,
        }
    }
}
