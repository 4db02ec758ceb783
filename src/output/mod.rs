//! The output folder: what a run leaves behind, and how it comes to be there.
//!
//! # The life of a folder
//!
//! Nothing a user owns is destroyed. A run replaces only files that percoat itself wrote there as a finished result and
//! that nobody has changed since, and only when the new result is complete. The folder may be a link that its user has made;
//! below it links are followed nowhere, and anything but a file or a folder itself in the place of percoat's own is refused
//! before it is opened. Only in a folder that percoat has marked are files percoat's by their names, and removed by those alone.
//!
//! 1. **Claim** ([`RunFolder::claim`]), before anything is solved. A name of the [`Plan`] that belongs to somebody else
//!    is refused; so is a folder in which another run is writing, which a lock on `.percoat/lock` tells: the system
//!    takes it away however a process ends.
//! 2. **Gather** ([`RunFolder::staging`]). `solve` writes into `unfinished/`, every file under a temporary name that is
//!    changed when it is complete. A [`Recording`] appends a line to `steps.jsonl` for each load step, with the checksums of
//!    the files that it has left and of the line itself; its fields
//!    stand as `.npy` files in `contact.partial/` and `stress.partial/` until `contact.npz` and `stress.npz` are made of
//!    them. Where a finer grid follows, the steps of the coarser one stand in `coarser/`. The result of an earlier run
//!    stays as it is all the while.
//! 3. **Publish** ([`RunFolder::publish`]). A list of the files with their checksums beside them decides; then each takes
//!    its place, those of the result before that have no successor go, the list becomes `.percoat/written.json`, and
//!    `unfinished/` goes in one move. At every moment the old result or the whole new
//!    one stands in one place, where files can have two names (hard links); elsewhere the new one moves file by file.
//!
//! A run that is killed leaves `unfinished/` with all steps it has finished, and in `checkpoint.npz` what the solver knew. The
//! next run into the folder completes a publication that was decided; otherwise it goes on from there if it is told to
//! ([`Plan::resumes`]) and all of it is [as it was written](finished()), or moves the folder to `interrupted-1/` or the next free number; without a finished step it is
//! cleared. Files in `unfinished/` that percoat did not write are not published and not removed: the folder is moved aside
//! like an interrupted run; what has the name of percoat's own there and is none (a link, a pipe) is refused by a run that goes
//! on. A power cut leaves what a kill leaves: content is on the disk before its name, and both before a line of a log, the
//! list or `written.json` says that they are finished. `compare`
//! gathers in `.percoat/compare/` and `validate` in `.percoat/validate/`; each command replaces its own files alone, and
//! a single study those of its own folder ([`Scope`]).

mod check;
mod checkpoint;
mod checksum;
mod clock;
pub mod columns;
mod comparison;
mod described;
pub(crate) mod disk;
mod fields;
mod files;
mod fingerprint;
mod finished;
mod folder;
mod gathered;
mod histograms;
#[cfg(test)]
pub(crate) mod journal;
mod kernel;
mod layout;
mod leftovers;
mod limit;
mod lock;
mod manifest;
mod npy;
mod npz;
mod number;
#[cfg(test)]
mod power_cut;
mod publication;
mod read_back;
mod recording;
mod scattered;
mod seal;
mod solved;
mod steps;
mod steps_log;
mod stranger;
mod stress;
pub mod summary;
pub mod table;
mod volume;

pub use check::{Check, CheckError, Roughness, Touches};
pub use checkpoint::{read_checkpoint, write_checkpoint};
pub use checksum::checksum;
pub use clock::{Clock, Phase, Timing};
pub use comparison::ComparisonFile;
pub use files::{Files, unlike_published};
pub use fingerprint::fingerprint;
pub use finished::{CannotGoOn, finished};
pub use folder::{Plan, RunFolder, is_released, release};
pub use histograms::histograms;
pub use kernel::{Traction, kernel};
pub use layout::{COMBINATIONS, FolderError, SWEEP_LOG, is_beside, is_gathering};
pub use limit::{FirstLimit, LimitFile};
pub use manifest::{Scope, Writer};
pub use npy::{npy_bytes, npy_shared};
pub use number::number;
pub(crate) use number::with_error;
pub use read_back::Unreadable;
pub use recording::Recording;
pub use seal::{Unsealed, seal, sealed, unsealed};
pub use solved::{solved_plan, write_scalars};
pub use steps_log::whole_lines;
pub use summary::{Summary, UnitNames};
pub use volume::write_volume;

use serde::Serialize;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Why an output could not be written: which path, and what the system says.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct OutputError {
    path: PathBuf,
    source: io::Error,
}

impl OutputError {
    pub(crate) fn new(path: &Path, source: io::Error) -> Self {
        Self { path: path.to_owned(), source }
    }
}

/// A record as indented JSON.
fn indented(record: &impl Serialize) -> String {
    serde_json::to_string_pretty(record).expect("a record is numbers and texts under names") + "\n"
}

/// Makes `folder` and what leads to it.
///
/// # Errors
/// [`OutputError`] with the path that cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), OutputError> {
    disk::make_folder(folder).map(|_| ()).map_err(|error| OutputError::new(folder, error))
}

/// Writes a file under a temporary name in its folder, then renames it: it is there whole or not at all, also after a power
/// cut. That its name is on the disk is left to who names it as finished, with the folder's other names.
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

/// A file under a temporary name in its folder, which gets its own when it is kept. Dropped, it leaves nothing behind.
#[derive(Debug)]
struct Draft {
    path: PathBuf,
    temporary: PathBuf,
    /// None once it is whole.
    writer: Option<BufWriter<fs::File>>,
}

impl Draft {
    fn new(path: &Path) -> Result<Self, OutputError> {
        /// Temporary names that may be taken, by a process of the same number that was killed.
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

    fn write(&mut self, content: impl FnOnce(&mut BufWriter<fs::File>) -> io::Result<()>) -> Result<(), OutputError> {
        self.writer.as_mut().map_or(Ok(()), content).map_err(|error| OutputError::new(&self.path, error))
    }

    /// Its content comes to the disk before its name.
    fn keep(mut self) -> Result<(), OutputError> {
        let temporary = self.temporary.clone();
        self.write(|writer| {
            writer.flush()?;
            disk::sync(writer.get_ref(), &temporary)
        })?;
        self.writer = None;
        let kept = disk::replace(&self.temporary, &self.path);
        kept.inspect_err(|_| remove(&self.temporary)).map_err(|error| OutputError::new(&self.path, error))
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        if self.writer.take().is_some() {
            remove(&self.temporary);
        }
    }
}

/// Removes what failed; a leftover that cannot be removed changes nothing about the first error.
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
        // What has its own name and is no file stays too.
        for name in ["link", "folder"] {
            if name == "link" { symlink(path("mine"), path(name)) } else { fs::create_dir(path(name)) }.unwrap();
            assert!(write_text(&path(name), "new").unwrap_err().to_string().contains(&format!("it is a {name}")));
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 8, "nothing temporary is left");
    }
}
