//! The output folder: what a run leaves behind, and how it comes to be there.
//!
//! # The life of a folder
//!
//! Nothing a user owns is destroyed. A run replaces only files that percoat itself wrote there as a finished result and
//! that nobody has changed since, and only when the new result is complete.
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
//! like an interrupted run. `compare`
//! gathers in `.percoat/compare/` and `validate` in `.percoat/validate/`; each command replaces its own files alone, and
//! a single study those of its own folder ([`Scope`]).

mod check;
mod checkpoint;
mod checksum;
mod clock;
pub mod columns;
mod comparison;
mod described;
mod fields;
mod files;
mod fingerprint;
mod finished;
mod folder;
mod gathered;
mod histograms;
mod kernel;
mod layout;
mod limit;
mod manifest;
mod npy;
mod npz;
mod number;
mod publication;
mod recorded;
mod recording;
mod scattered;
mod seal;
mod solved;
mod steps;
mod steps_log;
mod stress;
pub mod summary;
pub mod table;
mod volume;

pub use check::{Check, CheckError, Roughness, Touches};
pub use checkpoint::{read_checkpoint, write_checkpoint};
pub use checksum::checksum;
pub use clock::{Clock, Phase, Timing};
pub use comparison::compare_json;
pub use files::{Files, unlike_published};
pub use fingerprint::fingerprint;
pub use finished::{CannotGoOn, finished};
pub use folder::{Plan, RunFolder, is_released, release};
pub use histograms::histograms;
pub use kernel::{Traction, kernel};
pub use layout::{COMBINATIONS, FolderError, SWEEP_LOG, is_beside};
pub use limit::{limit_json, limits_json};
pub use manifest::{Scope, Writer};
pub use npy::{npy_bytes, npy_shared};
pub use number::number;
pub(crate) use number::with_error;
pub use recorded::{Unreadable, limits_of, steps_of, timing_of};
pub use recording::Recording;
pub use seal::{Unsealed, seal, sealed, unsealed};
pub use solved::{solved_plan, write_scalars};
pub use steps_log::whole_lines;
pub use volume::write_volume;

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

/// Makes `folder` and what leads to it.
///
/// # Errors
/// [`OutputError`] with the path that cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(folder).map_err(|error| OutputError::new(folder, error))
}

/// Writes a file under a temporary name in its folder, then renames it: it is there whole or not at all.
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
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let temporary = path.with_file_name(format!(".{name}.{}.tmp", std::process::id()));
        let file = fs::File::create(&temporary).map_err(|error| OutputError::new(path, error))?;
        Ok(Self { path: path.to_owned(), temporary, writer: Some(BufWriter::new(file)) })
    }

    fn write(&mut self, content: impl FnOnce(&mut BufWriter<fs::File>) -> io::Result<()>) -> Result<(), OutputError> {
        self.writer.as_mut().map_or(Ok(()), content).map_err(|error| OutputError::new(&self.path, error))
    }

    fn keep(mut self) -> Result<(), OutputError> {
        self.write(|writer| writer.flush())?;
        self.writer = None;
        let kept = fs::rename(&self.temporary, &self.path);
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
    let _ = fs::remove_file(temporary);
}

/// Writes a text file as [`write_file`] does.
///
/// # Errors
/// [`OutputError`] with the path.
pub fn write_text(path: &Path, text: &str) -> Result<(), OutputError> {
    write_file(path, |writer| writer.write_all(text.as_bytes()))
}
