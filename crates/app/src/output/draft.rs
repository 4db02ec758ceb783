//! Files that are written under a temporary name and renamed when they are complete.

use super::error::AtPath;
use super::{OutputError, disk};
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes a file under a temporary name in its folder, then renames it: it is complete or absent, also after a power cut. Its
/// name is synced later, with the folder's other names, before a log or list names it as finished.
///
/// # Errors
/// [`OutputError`] with the path; nothing is left behind.
pub fn write_file(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<fs::File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let mut file = Draft::new(path)?;
    file.write(content)?;
    file.keep()
}

/// A file under a temporary name in its folder; [`Draft::keep`] renames it, dropping removes it.
#[derive(Debug)]
pub(super) struct Draft {
    path: PathBuf,
    temporary: PathBuf,
    /// None once it is complete.
    writer: Option<BufWriter<fs::File>>,
}

impl Draft {
    /// An empty draft of a file at `path`.
    pub(super) fn new(path: &Path) -> Result<Self, OutputError> {
        /// Most temporary names that killed processes of the same number may have left.
        const TAKEN: usize = 100;
        let (name, process) = (path.file_name().unwrap_or_default().to_string_lossy(), std::process::id());
        let mut number = 1;
        loop {
            let more = if number == 1 { String::new() } else { format!(".{number}") };
            let temporary = path.with_file_name(format!(".{name}.{process}{more}.tmp"));
            match disk::create(&temporary) {
                Ok(file) => return Ok(Self { path: path.to_owned(), temporary, writer: Some(BufWriter::new(file)) }),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists && number < TAKEN => number += 1,
                Err(error) => return Err(OutputError::new(path, error)),
            }
        }
    }

    /// Appends to its content.
    pub(super) fn write(
        &mut self,
        content: impl FnOnce(&mut BufWriter<fs::File>) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        self.writer.as_mut().map_or(Ok(()), content).at(&self.path)
    }

    /// Syncs its content to the disk and renames it.
    pub(super) fn keep(mut self) -> Result<(), OutputError> {
        self.write(|writer| {
            writer.flush()?;
            disk::sync(writer.get_ref())
        })?;
        self.writer = None;
        let kept = disk::replace(&self.temporary, &self.path);
        kept.inspect_err(|_| remove(&self.temporary)).at(&self.path)
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        if self.writer.take().is_some() {
            remove(&self.temporary);
        }
    }
}

/// Removes a file that failed; an error of the removal is ignored in favour of the first one.
fn remove(temporary: &Path) {
    let _ = disk::remove(temporary);
}

/// Writes a text file as [`write_file`] does.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn write_text(path: &Path, text: &str) -> Result<(), OutputError> {
    write_file(path, |writer| writer.write_all(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn whatever_has_the_temporary_name_of_a_file_stays_as_it_is() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let taken = |number: &str| path(&format!(".curve.csv.{}{number}.tmp", std::process::id()));
        fs::write(path("mine"), "mine").unwrap();
        symlink(path("mine"), taken("")).unwrap();
        fs::create_dir(taken(".2")).unwrap();
        fs::write(taken(".3"), "mine").unwrap();
        symlink(path("nothing"), taken(".4")).unwrap();
        write_text(&path("curve.csv"), "new").unwrap();
        assert_eq!(fs::read_to_string(path("curve.csv")).unwrap(), "new");
        assert!(
            taken("").is_symlink() && taken(".2").is_dir() && taken(".4").is_symlink() && !path("nothing").exists()
        );
        assert!(["mine"].iter().all(|name| fs::read_to_string(path(name)).unwrap() == "mine"));
        assert_eq!(fs::read_to_string(taken(".3")).unwrap(), "mine");
        // A link or a folder of the file's name stays too.
        for name in ["link", "folder"] {
            if name == "link" { symlink(path("mine"), path(name)) } else { fs::create_dir(path(name)) }.unwrap();
            assert!(write_text(&path(name), "new").unwrap_err().to_string().contains(&format!("it is a {name}")));
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 8, "nothing temporary is left");
    }
}
