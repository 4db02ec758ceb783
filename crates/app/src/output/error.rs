//! Files and folders that cannot be written.

use std::io;
use std::path::{Path, PathBuf};

/// A path that could not be written, and the error of the system.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct OutputError {
    path: PathBuf,
    source: io::Error,
}

impl OutputError {
    /// An error of the system at a path.
    pub fn new(path: &Path, source: io::Error) -> Self {
        Self { path: path.to_owned(), source }
    }
}

/// Adds the path to an error of the system.
pub(crate) trait AtPath<T> {
    fn at(self, path: &Path) -> Result<T, OutputError>;
}

impl<T> AtPath<T> for io::Result<T> {
    fn at(self, path: &Path) -> Result<T, OutputError> {
        self.map_err(|error| OutputError::new(path, error))
    }
}
