//! The output folder: the files of a run, and how they are written.
//!
//! # The life of a folder
//!
//! No file of a user is destroyed. A run replaces only files that percoat wrote there as a finished result and that were not
//! changed since, and only when the new result is complete. The output folder may be a symbolic link; below it no link is
//! followed, and anything but a regular file or folder in the place of percoat's own is refused before it is opened. Files are
//! recognised as percoat's by their names only in a folder that percoat has marked.
//!
//! 1. **Claim** ([`RunFolder::claim`]), before anything is solved. A name of the [`Plan`] that belongs to a user is refused; so
//!    is a folder into which another run writes, which a lock on `.percoat/lock` shows: the system releases it however a
//!    process ends.
//! 2. **Gather** in a staging folder ([`RunFolder::staging`]). `solve` writes into `unfinished/`, every file under a temporary
//!    name until it is complete. A [`Recording`] appends a line to `steps.jsonl` for each load step, with the checksums of the
//!    files of the step and of the line itself; fields are `.npy` files in `contact.partial/` and `stress.partial/` until
//!    `contact.npz` and `stress.npz` are made of them. While a finer grid is solved, the steps of the coarser one are in
//!    `coarser/`. The earlier result stays unchanged.
//! 3. **Publish** ([`RunFolder::publish`]). A list of the files with their checksums is written beside them; then each file is
//!    placed, files of the earlier result without a successor are removed, the list becomes `.percoat/written.json`, and
//!    `unfinished/` is removed in one move. At every moment the old result or the whole new one is in one folder, given hard
//!    links; without them the new one is moved file by file. `publication.rs` describes the states and their order.
//!
//! A killed run leaves `unfinished/` with its finished steps, and in `checkpoint.npz` the state of the solver. The next run into
//! the folder completes a publication that was decided. Otherwise it resumes the killed run if the plan [resumes](Plan::resumes)
//! and every file is [undamaged](finished()), or moves the folder to `interrupted-1/` or the next free number; a folder without a
//! finished step is removed. Foreign files in `unfinished/` are neither published nor removed: the folder is moved aside too. A
//! link or a pipe under one of percoat's names there is refused by a run that resumes. A power cut leaves what a kill leaves:
//! content is on the disk before its name, and both before a log line, the list or `written.json` lists them as finished.
//!
//! Commands that cannot be resumed gather in `.percoat/`, as `compare` in `.percoat/compare/` and `merge` in `.percoat/merge/`; what
//! they leave when they are killed is removed by the next run of the same command. Each command replaces its own files alone, and a
//! single study those of its own folder ([`Plan::within`]).

mod check;
mod checkpoint;
mod checksum;
mod clock;
pub mod columns;
mod comparison;
mod described;
pub mod disk;
mod draft;
mod error;
mod fields;
mod files;
mod fingerprint;
mod finished;
mod folder;
mod folder_error;
mod foreign;
mod head;
mod histograms;
mod identification;
mod interrupted;
mod json;
mod kernel;
mod layout;
mod life;
mod limit;
mod lock;
mod log;
mod manifest;
mod npy;
mod npz;
mod number;
mod plan;
#[cfg(all(test, unix))]
pub(crate) mod power_cut;
mod publication;
mod recording;
mod release;
mod solved;
mod staging;
mod step_arrays;
mod steps_log;
mod stress;
pub mod summary;
#[cfg(not(all(test, unix)))]
mod system;
pub mod table;
mod trailer;
mod unloading;
mod unpack;
mod volume;
mod writer;

pub use check::{Check, CheckError, Roughness, Touches};
pub use checkpoint::{read_checkpoint, write_checkpoint};
pub use checksum::checksum;
pub use clock::{Clock, Phase, Timing};
pub use comparison::ComparisonFile;
pub use draft::{remove_drafts, write_file, write_text};
pub use error::OutputError;
pub use files::Files;
pub use fingerprint::fingerprint;
pub use finished::{CannotGoOn, finished};
pub use folder::RunFolder;
pub use folder_error::FolderError;
pub use head::UnitNames;
pub use histograms::histograms;
pub use identification::{IdentificationFile, doubts, doubts_of_retraction, fitted, identified, trial};
pub use interrupted::{coarser, has_begun, has_solved_alone, staged_bytes};
pub use json::Unreadable;
pub use kernel::{Traction, kernel};
pub use layout::{COMBINATIONS, SWEEP_LOG, is_staging};
pub use life::{LifeFile, save_state, saved_state, write_damage};
pub use limit::{FirstLimit, LimitFile};
pub(crate) use log::LineLog;
pub use log::whole_lines;
pub use manifest::{damaged_results, is_beside};
pub(crate) use number::is_interval;
pub use number::{in_unit, number, passes_with_error, percent_with_error, shown, with_error, with_unit};
pub use plan::Plan;
pub use recording::Recording;
pub use release::{is_released, release};
pub use solved::{solved_plan, write_scalars};
pub use summary::Summary;
pub(crate) use trailer::Trailer;
pub use trailer::{TrailerError, digest, with_checksum, without_checksum};
pub use unloading::doubts_of_unloading;
pub use volume::write_volume;
pub use writer::Writer;

use error::AtPath;
#[cfg(all(test, unix))]
use power_cut::system;
use std::path::Path;

/// Makes `folder` and what leads to it.
///
/// # Errors
/// [`OutputError`] with the path that cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), OutputError> {
    disk::make_folder(folder).at(folder)
}
