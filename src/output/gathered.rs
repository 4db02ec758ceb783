//! What percoat itself puts where a result is gathered, by its names. Whatever else stands there is somebody else's: it
//! is neither published nor removed.

use super::OutputError;
use super::layout::{COARSER, COMBINATIONS, MARK, SWEEP_LOG, names, remove_folder};
use super::manifest::Writer;
use super::{checkpoint, steps_log};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Files that steps leave before they are published.
const STEPS: [&str; 8] = [
    "case.toml",
    steps_log::NAME,
    checkpoint::NAME,
    "summary.json",
    "curve.csv",
    "histograms.csv",
    "contact.npz",
    "stress.npz",
];
/// Those that combinations leave.
const ROWS: [&str; 3] = [SWEEP_LOG, "sweep.csv", "sweep.json"];

/// Whether fields of the steps wait in a folder of that name.
pub(super) fn is_partial(name: &str) -> bool {
    ["contact.partial", "stress.partial"].contains(&name)
}

/// Whether steps or combinations are gathered in a folder of that name.
fn is_gathered(name: &str) -> bool {
    name == COARSER || name == COMBINATIONS || name.len() >= 4 && name.bytes().all(|byte| byte.is_ascii_digit())
}

/// Whether a run leaves a file of that name before it publishes.
fn is_of_steps(name: &str) -> bool {
    let is_volume = name.starts_with("stress.") && name.ends_with(".vts");
    STEPS.contains(&name) || ROWS.contains(&name) || is_volume || is_temporary(name)
}

/// Whether what a grid leaves under that name moves aside with its steps, before their log, when a finer one begins.
pub(super) fn is_moved(name: &str) -> bool {
    let stays = [steps_log::NAME, checkpoint::NAME].contains(&name) || ROWS.contains(&name) || is_temporary(name);
    is_partial(name) || is_of_steps(name) && !stays
}

/// Whether a file of that name is one that was being written.
fn is_temporary(name: &str) -> bool {
    name.starts_with('.') && name.ends_with(".tmp")
}

/// Removes what a run was writing when it was killed.
pub(super) fn remove_temporary(folder: &Path) -> Result<(), OutputError> {
    for name in names(folder)? {
        let path = folder.join(&name);
        if is_partial(&name) && path.is_dir() {
            remove_temporary(&path)?;
        } else if is_temporary(&name) && path.is_file() {
            fs::remove_file(&path).map_err(|error| OutputError::new(&path, error))?;
        }
    }
    Ok(())
}

/// Removes where a writer has gathered its result; `also` are further names of its files. What is somebody else's in the
/// place that everybody sees stays, and the folder around it; returns whether nothing did.
pub(super) fn remove_gathered(folder: &Path, writer: Writer, also: &dyn Fn(&str) -> bool) -> Result<bool, OutputError> {
    match writer {
        Writer::Solve | Writer::Sweep => remove_own(folder, also),
        // They gather where percoat keeps what is its own.
        Writer::Check | Writer::Compare | Writer::Limit | Writer::Validate | Writer::Report => {
            remove_folder(folder).map(|()| true)
        }
    }
}

/// Removes a folder with all that percoat has put into it; `also` are further names of its files. What is somebody
/// else's stays, and the folder around it; returns whether nothing did.
pub(super) fn remove_own(folder: &Path, also: &dyn Fn(&str) -> bool) -> Result<bool, OutputError> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |error| OutputError::new(&path, error)
    };
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
        entries => entries.map_err(failed(folder))?,
    };
    let mut gone = true;
    for entry in entries {
        let entry = entry.map_err(failed(folder))?;
        let (path, name) = (entry.path(), entry.file_name());
        let is_folder = entry.file_type().map_err(failed(&path))?.is_dir();
        gone &= match name.to_str() {
            Some(name) if is_folder && is_gathered(name) => remove_own(&path, also)?,
            Some(name) if is_folder && is_partial(name) => remove_waiting(&path)?,
            // It goes last, so that a folder that is cleared halfway stays percoat's.
            Some(MARK) if !is_folder => true,
            Some(name) if !is_folder && (is_of_steps(name) || also(name)) => {
                fs::remove_file(&path).map_err(failed(&path))?;
                true
            }
            _ => false,
        };
    }
    if gone {
        let mark = folder.join(MARK);
        if mark.is_file() {
            fs::remove_file(&mark).map_err(failed(&mark))?;
        }
        fs::remove_dir(folder).map_err(failed(folder))?;
    }
    Ok(gone)
}

/// The same for a folder in which fields wait.
pub(super) fn remove_waiting(folder: &Path) -> Result<bool, OutputError> {
    remove_own(folder, &|name| name.ends_with(".npy"))
}

/// Moves a folder to `interrupted-1/` in the output folder, or the next free number.
pub(super) fn set_aside(folder: &Path, output: &Path) -> Result<Option<PathBuf>, OutputError> {
    let free = |number: usize| {
        let path = output.join(format!("interrupted-{number}"));
        fs::symlink_metadata(&path).is_err().then_some(path)
    };
    let aside = (1..).find_map(free);
    if let Some(aside) = &aside {
        fs::rename(folder, aside).map_err(|error| OutputError::new(aside, error))?;
    }
    Ok(aside)
}
