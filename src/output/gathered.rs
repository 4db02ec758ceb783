//! What percoat itself puts where a result is gathered, by its names. Whatever else stands there is somebody else's: it
//! is neither published nor removed.

use super::OutputError;
use super::disk;
use super::layout::{COARSER, COMBINATIONS, DECIDED, MARK, SWEEP_LOG, names};
use super::manifest::is_inside;
use super::{checkpoint, steps_log};
use std::collections::BTreeSet;
use std::io::{self, Write};
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

/// Whether steps or combinations are gathered in a folder of that name in `folder`: those of one combination by its number, below
/// that of all.
fn is_gathered(folder: &Path, name: &str) -> bool {
    name == COARSER || name == COMBINATIONS || is_number(name) && folder.ends_with(COMBINATIONS)
}

/// Whether a name is that of a combination.
pub(super) fn is_number(name: &str) -> bool {
    name.len() >= 4 && name.bytes().all(|byte| byte.is_ascii_digit())
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

/// Whether a file of that name is one that was being written: `.NAME.PROCESS.tmp`, or `.NAME.PROCESS.NUMBER.tmp`.
fn is_temporary(name: &str) -> bool {
    let middle =
        name.strip_prefix('.').and_then(|name| name.strip_suffix(".tmp")).and_then(|name| name.rsplit_once('.'));
    middle.is_some_and(|(name, number)| {
        !name.is_empty() && !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
    })
}

/// What percoat itself puts under a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    File,
    Folder,
}

impl Place {
    pub(super) fn in_words(self) -> &'static str {
        match self {
            Self::File => "a file",
            Self::Folder => "a folder",
        }
    }
}

/// What percoat puts under a name where a result is gathered; `None` for other names.
pub(super) fn place_of(name: &str) -> Option<Place> {
    match name {
        _ if is_known(name) => Some(Place::Folder),
        MARK | DECIDED => Some(Place::File),
        _ if is_of_steps(name) || name.ends_with(".npy") => Some(Place::File),
        _ => None,
    }
}

/// Whether percoat has a folder of that name there.
pub(super) fn is_known(name: &str) -> bool {
    is_partial(name) || name == COARSER || name == COMBINATIONS || is_number(name)
}

/// Marks a folder as one in which percoat gathers a result of the `planned` names.
pub(super) fn mark(folder: &Path, planned: &[String]) -> Result<(), OutputError> {
    let path = folder.join(MARK);
    let names = serde_json::to_string(planned).expect("names are texts");
    let version = env!("CARGO_PKG_VERSION");
    let written = disk::create(&path).and_then(|mut file| {
        writeln!(file, "A run of percoat {version} that is not finished.\n{names}")?;
        disk::sync(&file, &path)
    });
    written.map_err(|error| OutputError::new(&path, error))
}

/// The names that were planned where a folder was marked.
fn planned(folder: &Path) -> BTreeSet<String> {
    let text = disk::read_text(&folder.join(MARK)).unwrap_or_default();
    let names = text.split_once('\n').and_then(|(_, names)| serde_json::from_str::<Vec<String>>(names).ok());
    names.unwrap_or_default().into_iter().filter(|name| is_inside(name)).collect()
}

/// Removes what a run was writing when it was killed.
pub(super) fn remove_temporary(folder: &Path) -> Result<(), OutputError> {
    for name in names(folder)? {
        let path = folder.join(&name);
        if is_partial(&name) && disk::is_folder(&path) {
            remove_temporary(&path)?;
        } else if is_temporary(&name) && disk::is_file(&path) {
            disk::remove(&path).map_err(|error| OutputError::new(&path, error))?;
        }
    }
    Ok(())
}

/// Removes where a result was gathered, with the files that percoat has put there: those of its steps, those that were
/// planned when the folder was marked, and those that `also` names. What is somebody else's stays, and the folder around
/// it, as does all in a folder without a mark; returns whether nothing did.
pub(super) fn remove_gathered(folder: &Path, also: &dyn Fn(&str) -> bool) -> Result<bool, OutputError> {
    if !disk::is_folder(folder) {
        return Ok(disk::found(folder).is_ok_and(|found| found.is_none()));
    }
    if !disk::is_file(&folder.join(MARK)) && !names(folder)?.iter().all(|name| is_temporary(name)) {
        return Ok(false);
    }
    let planned = planned(folder);
    for name in planned.iter().filter(|name| name.contains('/')) {
        remove_below(folder, name)?;
    }
    remove_own(folder, &|name| planned.contains(name) || also(name))
}

/// Removes a file that was planned in a folder of its own, and the folders that it leaves empty.
fn remove_below(folder: &Path, name: &str) -> Result<(), OutputError> {
    let above =
        || Path::new(name).ancestors().skip(1).filter(|part| *part != Path::new("")).map(|part| folder.join(part));
    if !above().all(|part| disk::is_folder(&part)) {
        return Ok(());
    }
    let path = folder.join(name);
    if disk::is_file(&path) {
        disk::remove(&path).map_err(|error| OutputError::new(&path, error))?;
    }
    for part in above() {
        match disk::remove_folder(&part) {
            Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => break,
            removed => removed.map_err(|error| OutputError::new(&part, error))?,
        }
    }
    Ok(())
}

/// Removes a folder with all that percoat has put into it; `also` are further names of its files. What is somebody
/// else's stays, and the folder around it; returns whether nothing did.
pub(super) fn remove_own(folder: &Path, also: &dyn Fn(&str) -> bool) -> Result<bool, OutputError> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |error| OutputError::new(&path, error)
    };
    if disk::found(folder).map_err(failed(folder))?.is_none() {
        return Ok(true);
    }
    if !disk::is_folder(folder) {
        return Ok(false);
    }
    let mut gone = true;
    for entry in std::fs::read_dir(folder).map_err(failed(folder))? {
        let entry = entry.map_err(failed(folder))?;
        let (path, name, kind) = (entry.path(), entry.file_name(), entry.file_type());
        let kind = kind.map_err(failed(&path))?;
        gone &= match name.to_str() {
            Some(name) if kind.is_dir() && is_gathered(folder, name) => remove_own(&path, also)?,
            Some(name) if kind.is_dir() && is_partial(name) => remove_waiting(&path)?,
            // It goes last, so that a folder that is cleared halfway stays percoat's.
            Some(MARK) if kind.is_file() => true,
            Some(name) if kind.is_file() && (name == DECIDED || is_of_steps(name) || also(name)) => {
                disk::remove(&path).map_err(failed(&path))?;
                true
            }
            _ => false,
        };
    }
    if gone {
        let mark = folder.join(MARK);
        if disk::is_file(&mark) {
            disk::sync_folder(folder).map_err(failed(folder))?;
            disk::remove(&mark).map_err(failed(&mark))?;
        }
        disk::remove_folder(folder).map_err(failed(folder))?;
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
        std::fs::symlink_metadata(&path).is_err().then_some(path)
    };
    let aside = (1..).find_map(free);
    if let Some(aside) = &aside {
        let moved = disk::move_to(folder, aside).and_then(|()| disk::sync_folder(output));
        moved.map_err(|error| OutputError::new(aside, error))?;
    }
    Ok(aside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_that_percoat_gives_to_what_it_is_writing_are_temporary() {
        for (name, is) in [
            (".curve.csv.17.tmp", true),
            (".curve.csv.17.2.tmp", true),
            (".notes.tmp", false),
            (".17.tmp", false),
            (".notes.draft.tmp", false),
            ("curve.csv.17.tmp", false),
            (".curve.csv..tmp", false),
        ] {
            assert_eq!(is_temporary(name), is, "{name}");
        }
    }
}
