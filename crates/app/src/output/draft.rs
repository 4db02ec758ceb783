//! Files that are written under a temporary name and renamed when they are complete.
//!
//! A draft is locked until then. So a later run tells the draft of a killed process, which it removes, from one that is written.

use super::error::AtPath;
use super::{OutputError, disk};
use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

/// Writes a file under a temporary name in its folder, then renames it: it is complete or absent, also after a power cut. Its
/// name is synced later, with the folder's other names, before a log or list names it as finished.
///
/// # Errors
/// [`OutputError`] with the path; nothing is left behind.
pub fn write_file(
    path: &Path,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
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
    /// `None` once it is complete.
    writer: Option<BufWriter<File>>,
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
                Ok(file) if is_locked(&file, &temporary) => {
                    return Ok(Self { path: path.to_owned(), temporary, writer: Some(BufWriter::new(file)) });
                }
                Err(error) if error.kind() != io::ErrorKind::AlreadyExists || number >= TAKEN => {
                    return Err(OutputError::new(path, error));
                }
                _ => number += 1,
            }
        }
    }

    /// Appends to its content.
    pub(super) fn write(
        &mut self,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        self.writer.as_mut().map_or(Ok(()), content).at(&self.path)
    }

    /// Syncs its content to the disk and renames it.
    pub(super) fn keep(mut self) -> Result<(), OutputError> {
        self.write(|writer| {
            writer.flush()?;
            disk::sync(writer.get_ref())
        })?;
        let open = self.writer.take();
        let kept = disk::replace(&self.temporary, &self.path);
        drop(open);
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

/// Locks a draft that was just created; `false` where another process has just taken it for that of a killed one.
fn is_locked(file: &File, temporary: &Path) -> bool {
    // Some network file systems have no locks: there no draft is taken for that of a killed process.
    !matches!(file.try_lock(), Err(TryLockError::WouldBlock)) && disk::is_file(temporary)
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

/// Removes the drafts of a file that killed processes have left: those that begin as the file does, or end within this
/// `beginning`, and that no process writes.
pub fn remove_drafts(path: &Path, beginning: &str) {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let draft = folder.join(entry.file_name());
        let is_named_so = entry.file_name().to_str().is_some_and(|temporary| is_draft_of(&name, temporary));
        // Locked until it is removed.
        if let Some(file) = is_named_so.then(|| disk::open_to_change(&draft).ok()).flatten()
            && is_left(&file, beginning).unwrap_or(false)
        {
            remove(&draft);
        }
    }
}

/// Whether no process writes a draft, which is locked here, and it has one name and this beginning, or a part of that.
fn is_left(file: &File, beginning: &str) -> io::Result<bool> {
    let mut bytes = Vec::new();
    let is_alone = file.try_lock().is_ok() && !disk::has_other_name(file);
    file.take(beginning.len() as u64).read_to_end(&mut bytes)?;
    Ok(is_alone && beginning.as_bytes().starts_with(&bytes))
}

/// Whether a name is a temporary one of the file `name`: `.NAME.PROCESS.tmp`, or `.NAME.PROCESS.NUMBER.tmp`.
fn is_draft_of(name: &str, temporary: &str) -> bool {
    let rest =
        temporary.strip_prefix('.').and_then(|rest| rest.strip_prefix(name)?.strip_prefix('.')?.strip_suffix(".tmp"));
    rest.is_some_and(|numbers| {
        let (process, number) = numbers.split_once('.').unwrap_or((numbers, "1"));
        is_number(process) && is_number(number)
    })
}

/// Whether a name is the temporary one of any file.
pub(super) fn is_temporary(name: &str) -> bool {
    let middle = name.strip_prefix('.').and_then(|name| name.strip_suffix(".tmp")?.rsplit_once('.'));
    middle.is_some_and(|(name, number)| !name.is_empty() && is_number(number))
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_that_percoat_gives_to_what_it_is_writing_are_temporary() {
        for (name, is, of_the_curve) in [
            (".curve.csv.17.tmp", true, true),
            (".curve.csv.17.2.tmp", true, true),
            (".curve.csv.17.2.3.tmp", true, false),
            (".other.csv.17.tmp", true, false),
            (".notes.tmp", false, false),
            (".17.tmp", false, false),
            (".notes.draft.tmp", false, false),
            ("curve.csv.17.tmp", false, false),
            (".curve.csv..tmp", false, false),
            (".curve.csv.17..tmp", false, false),
        ] {
            assert_eq!((is_temporary(name), is_draft_of("curve.csv", name)), (is, of_the_curve), "{name}");
        }
    }

    #[test]
    fn the_drafts_of_killed_processes_are_removed_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let mut written = Draft::new(&path("curve.csv")).unwrap();
        written.write(|writer| writer.write_all(b"percoat's, begun").and_then(|()| writer.flush())).unwrap();
        for (name, content) in [
            (".curve.csv.17.tmp", "percoat's, left"),
            (".curve.csv.17.2.tmp", "percoat's, left"),
            (".curve.csv.18.tmp", "mine"),
            (".other.csv.17.tmp", "percoat's, of another file"),
            (".curve.csv.19.tmp", "percoat's, with a name of mine"),
        ] {
            fs::write(path(name), content).unwrap();
        }
        fs::hard_link(path(".curve.csv.19.tmp"), path("mine")).unwrap();
        remove_drafts(&path("curve.csv"), "percoat's");
        let mut left = super::super::layout::names(folder.path()).unwrap();
        left.retain(|name| !name.contains(&std::process::id().to_string()));
        assert_eq!(left, [".curve.csv.18.tmp", ".curve.csv.19.tmp", ".other.csv.17.tmp", "mine"]);
        written.keep().unwrap();
        assert_eq!(fs::read_to_string(path("curve.csv")).unwrap(), "percoat's, begun");
    }

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
