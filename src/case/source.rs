//! Where a case comes from.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Text of a case and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// Name shown in errors, such as the path of the file.
    pub name: String,
    /// The TOML.
    pub text: String,
    /// Folder to which a surface's file is relative.
    pub folder: PathBuf,
}

impl Source {
    /// The case file at `path`.
    ///
    /// # Errors
    /// When the file cannot be read or is not UTF-8.
    pub fn file(path: &Path) -> io::Result<Self> {
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Ok(Self { name: path.display().to_string(), text: fs::read_to_string(path)?, folder })
    }
}
