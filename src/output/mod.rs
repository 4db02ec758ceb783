//! The output folder: what a run leaves behind, and how it comes to be there.
//!
//! # The life of a folder
//!
//! Nothing a user owns is destroyed. A run replaces only files that percoat itself wrote there as a finished result and
//! that were not changed since, and only when the new result is complete. The output folder may be a link that its user has
//! made; below it no link is followed, and anything but a file or a folder itself in the place of percoat's own is refused
//! before it is opened. Only in a folder that percoat has marked are files percoat's by their names, and removed by those alone.
//!
//! 1. **Claim** ([`RunFolder::claim`]), before anything is solved. A name of the [`Plan`] that belongs to a user is refused; so
//!    is a folder into which another run writes, which a lock on `.percoat/lock` shows: the system releases it however a
//!    process ends.
//! 2. **Gather** in a staging folder ([`RunFolder::staging`]). `solve` writes into `unfinished/`, every file under a temporary
//!    name that is changed when it is complete. A [`Recording`] appends a line to `steps.jsonl` for each load step, with the
//!    checksums of the files that the step has left and of the line itself; its fields stand as `.npy` files in
//!    `contact.partial/` and `stress.partial/` until `contact.npz` and `stress.npz` are made of them. Where a finer grid
//!    follows, the steps of the coarser one stand in `coarser/`. The result of an earlier run stays as it is all the while.
//! 3. **Publish** ([`RunFolder::publish`]). A list of the files with their checksums beside them decides; then each takes
//!    its place, files of the result before that have no successor are removed, the list becomes `.percoat/written.json`, and
//!    `unfinished/` goes in one move. At every moment the old result or the whole new one stands in one folder, where files
//!    can have two names (hard links); elsewhere the new one moves file by file. The states and their order stand at the head
//!    of `publication.rs`.
//!
//! A run that is killed leaves `unfinished/` with all steps it has finished, and in `checkpoint.npz` the state of the solver.
//! The next run into the folder completes a publication that was decided. Otherwise it goes on from there if the plan
//! [resumes](Plan::resumes) and all of it is [as it was written](finished()), or moves the folder to `interrupted-1/` or the
//! next free number; a folder without a finished step is removed. Files in `unfinished/` that percoat did not write are neither
//! published nor removed: the folder is moved aside like that of an interrupted run. What has the name of percoat's own there and
//! is of another kind (a link, a pipe) is refused by a run that goes on. A power cut leaves what a kill leaves: content is on the
//! disk before its name, and both before a line of a log, the list or `written.json` says that they are finished.
//!
//! `compare` gathers in `.percoat/compare/` and `validate` in `.percoat/validate/`; each command replaces its own files alone,
//! and a single study those of its own folder ([`Scope`]).

mod check;
mod checkpoint;
mod checksum;
mod clock;
pub mod columns;
mod comparison;
mod described;
pub(crate) mod disk;
mod draft;
mod error;
mod fields;
mod files;
mod fingerprint;
mod finished;
mod folder;
mod folder_error;
mod foreign;
mod histograms;
#[cfg(test)]
mod image;
mod interrupted;
#[cfg(test)]
pub(crate) mod journal;
mod json;
mod kernel;
mod layout;
mod limit;
mod lock;
mod log;
mod manifest;
mod npy;
mod npz;
mod number;
mod plan;
#[cfg(test)]
mod power_cut;
mod publication;
mod recording;
mod release;
mod solved;
mod staging;
mod step_arrays;
mod steps_log;
mod stress;
pub mod summary;
pub mod table;
mod trailer;
mod unpack;
mod volume;
mod writer;

pub use check::{Check, CheckError, Roughness, Touches};
pub use checkpoint::{read_checkpoint, write_checkpoint};
pub use checksum::checksum;
pub use clock::{Clock, Phase, Timing};
pub use comparison::ComparisonFile;
pub use draft::{write_file, write_text};
pub use error::OutputError;
pub use files::Files;
pub use fingerprint::fingerprint;
pub use finished::{CannotGoOn, finished};
pub use folder::RunFolder;
pub use folder_error::FolderError;
pub use histograms::histograms;
pub use interrupted::{coarser, has_begun, has_solved_alone, staged_bytes};
pub use json::Unreadable;
pub use kernel::{Traction, kernel};
pub use layout::{COMBINATIONS, SWEEP_LOG, is_staging};
pub use limit::{FirstLimit, LimitFile};
pub(crate) use log::LineLog;
pub use log::whole_lines;
pub use manifest::{damaged_results, is_beside};
pub use number::number;
pub(crate) use number::with_error;
pub use plan::{Plan, Scope};
pub use recording::Recording;
pub use release::{is_released, release};
pub use solved::{solved_plan, write_scalars};
pub use summary::{Summary, UnitNames};
pub(crate) use trailer::Trailer;
pub use trailer::{TrailerError, digest, with_checksum, without_checksum};
pub use volume::write_volume;
pub use writer::Writer;

use error::At;
use std::path::Path;

/// Makes `folder` and what leads to it.
///
/// # Errors
/// [`OutputError`] with the path that cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), OutputError> {
    disk::make_folder(folder).map(|_| ()).at(folder)
}
